//! What the engine really dispatches and allocates for lit surfaces, counted against the plan.

use octolume::plan::Pass;
use octolume::scene::{Light, LightKind, Material, Node, OrbitCamera, Scene, Trs};
use octolume::settings::lighting::{LightEdit, Shadows, SunShines};
use octolume::settings::{Filter, Lookup, MethodSettings, SurfaceView, View};

use crate::plan::{Counted, running};
use crate::scenes::{cube_scene, node};

const CONES: [Pass; 6] = [
    Pass::TraceDiffuse,
    Pass::BlurDiffuse,
    Pass::UpsampleDiffuse,
    Pass::ListGlossyTiles,
    Pass::TraceSpecular,
    Pass::UpsampleSpecular,
];

/// A cube of a roughness, under a light that shines straight down on it or none.
fn counted(roughness: f32, lit: bool) -> Counted {
    let mut scene: Scene = cube_scene(Trs::default());
    scene.materials.push(Material { roughness, metallic: 0.0, ..Material::default() });
    scene.meshes[0].primitives[0].material = Some(0);
    if lit {
        let light = Light { name: "lamp".to_owned(), kind: LightKind::Directional, color: [1.0; 3], intensity: 10.0 };
        scene.lights.push(light);
        scene.nodes.push(Node { light: Some(0), ..node(None, Trs::default()) });
    }
    let mut counted = Counted::new(scene);
    let discretization = counted.settings.method.discretization;
    counted.settings.method = MethodSettings { discretization, ..MethodSettings::default() };
    counted.settings.method.look.view = View::Surfaces;
    counted.settings.method.lighting.sun.shines = SunShines::Never;
    counted
}

fn traced(counted: &mut Counted) -> Vec<Pass> {
    let (plan, _) = counted.frame();
    CONES.into_iter().filter(|pass| plan.runs(*pass)).collect()
}

fn labels(counted: &Counted) -> Vec<String> {
    counted.engine.memory().into_iter().map(|buffer| buffer.label).collect()
}

#[test]
fn without_light_there_are_surfaces_and_no_cone_no_octree_and_no_buffer_of_either() {
    let mut dark = counted(0.1, false);
    assert_eq!(traced(&mut dark), []);
    let made = labels(&dark);
    assert!(made.iter().all(|label| !label.contains("cones") && !label.contains("leaf bits")), "{made:?}");
}

#[test]
fn a_matte_cube_under_a_lamp_sends_out_diffuse_cones_and_a_glossy_one_both() {
    let mut matte = counted(1.0, true);
    assert_eq!(traced(&mut matte), [Pass::TraceDiffuse, Pass::BlurDiffuse, Pass::UpsampleDiffuse]);
    assert!(labels(&matte).iter().all(|label| !label.contains("specular") && !label.contains("glossy")));
    let glossy = traced(&mut counted(0.1, true));
    assert!(glossy.contains(&Pass::ListGlossyTiles) && glossy.contains(&Pass::TraceSpecular));
}

#[test]
fn nothing_is_dispatched_when_still_and_cones_alone_when_they_change() {
    let mut counted = counted(0.1, true);
    counted.frame();
    let (still, made) = counted.frame();
    assert!(still.is_idle());
    assert_eq!((made.pipelines, made.buffers), (0, 0));
    counted.settings.method.cone_tracing.cones = 2;
    let shown = [Pass::ComposeSurfaces, Pass::MeasureExposure, Pass::ShowSurfaces];
    let diffuse = [Pass::TraceDiffuse, Pass::BlurDiffuse, Pass::UpsampleDiffuse];
    assert_eq!(running(&counted.frame().0), [&diffuse[..], &shown].concat());
    counted.settings.method.cone_tracing.specular = false;
    assert_eq!(running(&counted.frame().0), shown, "without the term that is off");
    counted.settings.method.cone_tracing.specular = true;
    assert_eq!(running(&counted.frame().0), [], "what was traced, and the picture of it, is still there");
}

#[test]
fn a_moved_camera_lights_no_voxel_and_a_changed_light_draws_no_surface() {
    let mut counted = counted(1.0, true);
    counted.frame();
    counted.settings.shot.camera = Some(OrbitCamera::default());
    let moved = counted.frame().0;
    assert!(moved.runs(Pass::DrawSurfaces) && moved.runs(Pass::TraceDiffuse));
    assert!(!moved.runs(Pass::InjectLight) && !moved.runs(Pass::DrawShadows) && !moved.runs(Pass::MarkLeaves));
    let edit = LightEdit { on: true, kind: LightKind::Directional, color: [1.0, 0.5, 0.0], intensity: 3.0 };
    counted.settings.method.lighting.edits.insert(1, edit);
    let lit = counted.frame().0;
    assert!(!lit.runs(Pass::DrawSurfaces) && !lit.runs(Pass::DrawShadows));
    assert!(lit.runs(Pass::InjectLight) && lit.runs(Pass::LightSurfaces) && lit.runs(Pass::TraceDiffuse));
}

#[test]
fn occlusion_alone_reads_opacity_that_light_did_not_touch() {
    let mut counted = counted(1.0, true);
    counted.settings.method.look.surface = SurfaceView::Ao;
    let first = counted.frame().0;
    assert!(first.runs(Pass::TraceDiffuse) && first.runs(Pass::AverageLight));
    assert!(!first.runs(Pass::Illuminate) && !first.runs(Pass::LightSurfaces) && !first.runs(Pass::DrawShadows));
    counted.settings.method.look.surface = SurfaceView::Final;
    assert!(counted.frame().0.runs(Pass::Illuminate), "now light is looked at");
    assert!(counted.frame().0.is_idle());
}

#[test]
fn whole_resolution_makes_no_target_to_upsample() {
    let mut counted = counted(1.0, true);
    counted.settings.method.cone_tracing.half_resolution = false;
    counted.settings.method.cone_tracing.pattern_px = 1;
    assert_eq!(traced(&mut counted), [Pass::TraceDiffuse]);
    assert!(labels(&counted).iter().all(|label| label != "diffuse light" && label != "blurred cones"));
}

#[test]
fn cones_that_hop_by_pointers_find_them_linked() {
    let mut counted = counted(1.0, true);
    counted.frame();
    let by_ranks = counted.engine.read_surfaces().expect("readable");
    for lookup in [Lookup::BlockPointers, Lookup::NodePointers] {
        counted.settings.method.cone_tracing.lookup = lookup;
        assert!(counted.frame().0.runs(Pass::LinkNodes));
        assert_eq!(counted.engine.read_surfaces().expect("readable"), by_ranks, "{lookup:?}");
    }
}

#[test]
fn shadows_that_were_marched_through_other_leaves_are_marched_again() {
    let mut counted = counted(1.0, true);
    counted.settings.method.lighting.shadows = Shadows::March;
    counted.settings.method.look.surface = SurfaceView::Direct;
    assert!(counted.frame().0.runs(Pass::LightByMarching));
    counted.settings.method.look.view = View::Voxels;
    counted.settings.method.discretization.filter = Filter::Nearest;
    assert!(counted.frame().0.runs(Pass::MarkLeaves));
    counted.settings.method.look.view = View::Surfaces;
    assert!(counted.frame().0.runs(Pass::LightByMarching));
}
