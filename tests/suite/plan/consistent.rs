//! What holds of any plan.

use octolume::digest::Digest;
use octolume::plan::{Asked, Contents, FramePlan, Held, Key, Part, Pass, SceneFacts, plan};
use octolume::settings::{Settings, View};
use proptest::prelude::*;

use super::{RIGID, other};

const VIEWS: [View; 6] = [View::Voxels, View::Mesh, View::Ghost, View::Slice, View::ShadowMap, View::Surfaces];
/// The passes that draw the picture.
const PICTURES: [Pass; 7] = [
    Pass::ShowSurfaces,
    Pass::MarchVoxels,
    Pass::MarchLight,
    Pass::SliceOctree,
    Pass::ShowShadowMap,
    Pass::DrawMesh,
    Pass::MarchGhost,
];

proptest! {
    /// What runs is never skipped by another rule: no view without its octree, no gather twice. What runs is made from
    /// what is held or runs before it.
    #[test]
    fn plans_are_consistent(
        bits in 0_u32..1 << 9,
        view in 0_usize..6,
        before in 0_usize..6,
        accuracy: bool,
        rigid in 0_u64..2,
        skinned in 0_u64..2,
        voxelized in 0_u64..2,
        lights in 0_u32..2,
    ) {
        let digest = |index: u32| Digest::of(&(bits >> index & 1));
        let scene = SceneFacts { rigid_voxels: rigid, skinned_voxels: skinned, voxelized, lights, ..RIGID };
        let mut settings = Settings::default();
        settings.method.look.view = VIEWS[before];
        let mut held = Held::default();
        held.hold_all(&plan(&[Asked::new(scene, settings.clone())], &held));
        settings.method.look.view = VIEWS[view];
        settings.method.look.accuracy = accuracy;
        let mut asked = Asked::new(scene, settings);
        asked.contents = Contents {
            caches: digest(0), residents: digest(1), rigid: digest(2), skinned: digest(3), placed: digest(4),
            voxelized: digest(4), lights: digest(5), shadow_maps: digest(6), camera: digest(7), exact: (bits >> 8 == 1).then(other),
        };
        let plan = plan(&[asked], &held);
        let runs = |pass| plan.runs(pass);
        prop_assert!(PICTURES.into_iter().filter(|&pass| runs(pass)).count() <= 1);
        prop_assert!(!(runs(Pass::GatherNearest) && runs(Pass::GatherSplit)));
        prop_assert_eq!(runs(Pass::MarkLeaves), runs(Pass::AverageNodes));
        prop_assert!(!(runs(Pass::TransformRigid) || runs(Pass::TransformSkinned)) || runs(Pass::MarkLeaves));
        let moves = runs(Pass::TransformRigid) || runs(Pass::TransformSkinned);
        prop_assert!(!runs(Pass::JoinVoxels) || (rigid + skinned > 0 && voxelized > 0));
        prop_assert!(!(moves && runs(Pass::VoxelizeTriangles)) || runs(Pass::JoinVoxels));
        for planned in plan.to_run() {
            for (part, key) in planned.key.inputs() {
                held_or_before(&plan, &held, (planned.part, part), key)?;
            }
        }
    }
}

fn held_or_before(plan: &FramePlan, held: &Held, (made, from): (Part, Part), key: &Key) -> Result<(), TestCaseError> {
    let runs = plan.to_run().iter().any(|planned| planned.part == from && planned.key == *key);
    prop_assert!(from < made && (runs || held.holds(from, key)), "{made:?} from {from:?}");
    Ok(())
}
