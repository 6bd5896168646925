//! Opening files: real scenes where they are at hand, small documents written here.

use std::path::{Path, PathBuf};

use octolume::{
    progress::Progress,
    scene::{self, Scene},
};

/// The folder of real scenes, where there is one; tests pass without it.
pub fn shared_gltf() -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    ["../shared/gltf", "../../shared/gltf"].map(|path| root.join(path)).into_iter().find(|path| path.is_dir())
}

/// Triangles drawn (instances counted), objects, skins, distinct joints, clips.
fn counts(scene: &Scene) -> [usize; 5] {
    let objects = scene.objects();
    let triangles = objects.iter().map(|object| scene.meshes[object.mesh].triangle_count()).sum();
    let mut joints: Vec<usize> = scene.skins.iter().flat_map(|skin| skin.joints.iter().copied()).collect();
    joints.sort_unstable();
    joints.dedup();
    [triangles, objects.len(), scene.skins.len(), joints.len(), scene.clips.len()]
}

#[test]
fn real_scenes_hold_what_their_list_says() {
    let Some(folder) = shared_gltf() else { return };
    let expected = [
        ("Fox/Fox.glb", [576, 1, 1, 24, 3]),
        ("CesiumMan/CesiumMan.glb", [4_672, 1, 1, 19, 1]),
        ("KayKit-Knight/Knight.glb", [6_952, 15, 1, 41, 76]),
        ("RobotExpressive/robot.glb", [3_238, 14, 1, 43, 14]),
        ("Mannequiny/mannequiny.glb", [13_832, 1, 1, 45, 10]),
        ("RecursiveSkeletons/RecursiveSkeletons.glb", [6_384, 84, 84, 840, 1]),
        ("Sponza/Sponza_objects.gltf", [262_267, 398, 0, 0, 0]),
        ("InterpolationTest/InterpolationTest.glb", [110, 10, 0, 0, 9]),
        ("MeshPrimitiveModes/MeshPrimitiveModes.gltf", [16, 7, 0, 0, 0]),
        ("Box With Spaces/Box With Spaces.gltf", [12, 1, 0, 0, 0]),
        ("Unicode❤♻Test/Unicode❤♻Test.gltf", [2, 1, 0, 0, 0]),
        ("BoxTextured/BoxTextured.gltf", [12, 1, 0, 0, 0]),
        ("BoxInterleaved/BoxInterleaved.gltf", [12, 1, 0, 0, 0]),
        ("SimpleSparseAccessor/SimpleSparseAccessor.gltf", [12, 1, 0, 0, 0]),
    ];
    for (path, expected) in expected {
        let scene = scene::load::open(&folder.join(path), &Progress::default()).expect(path);
        assert_eq!(counts(&scene), expected, "{path}");
    }
}
