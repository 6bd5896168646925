//! Opening files: real scenes where they are at hand, small documents written here.

use std::path::Path;

use glam::DVec3;
use octolume::{
    progress::Progress,
    scene::{self, Scene, load::LoadError},
};
use serde_json::json;

use crate::document::Document;
use crate::real_scenes::real_scenes;

fn open(path: &Path) -> Result<Scene, LoadError> {
    scene::load::open(path, &Progress::default())
}

/// Triangles drawn (instances counted), objects, skins, distinct joints, clips.
fn counts(scene: &Scene) -> [usize; 5] {
    let objects = scene.objects();
    let triangles = objects.iter().map(|object| scene.meshes[object.mesh].triangle_count()).sum();
    let mut joints: Vec<usize> = scene.skins.iter().flat_map(|skin| skin.joints.iter().copied()).collect();
    joints.sort_unstable();
    joints.dedup();
    [triangles, objects.len(), scene.skins.len(), joints.len(), scene.own_clips().len()]
}

#[test]
fn real_scenes_hold_what_their_list_says() {
    let Some(folder) = real_scenes() else { return };
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
        let scene = open(&folder.join(path)).expect(path);
        assert_eq!(counts(&scene), expected, "{path}");
    }
}

/// Every file opens, or is refused with a sentence that names it.
#[test]
fn no_file_panics() {
    let Some(folder) = real_scenes() else { return };
    let mut folders = vec![folder];
    let mut opened = 0;
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            let extension = path.extension().unwrap_or_default().to_string_lossy().into_owned();
            if path.is_dir() {
                folders.push(path);
            } else if extension == "gltf" || extension == "glb" {
                match open(&path) {
                    Ok(scene) => opened += usize::from(scene.bounds_over_time().is_some()),
                    Err(error) => assert!(error.to_string().starts_with(&path.display().to_string()), "{error}"),
                }
            }
        }
    }
    assert!(opened > 40, "{opened} files with something in them");
}

#[test]
fn parents_come_before_children() {
    let mut document = Document::with_triangle();
    document.json["nodes"][0]["translation"] = json!([1, 0, 0]);
    document.add("nodes", json!({ "name": "middle", "children": [0], "translation": [10, 0, 0] }));
    document.add("nodes", json!({ "name": "root", "children": [1], "translation": [100, 0, 0] }));
    let scene = document.open().expect("opens");
    let names: Vec<&str> = scene.nodes.iter().map(|node| node.name.as_str()).collect();
    assert_eq!(names, ["root", "middle", "n"]);
    assert_eq!(scene.pose(None, 0.0).world_from_node[2].w_axis.truncate(), DVec3::new(111.0, 0.0, 0.0));
}

#[test]
fn references_that_lead_nowhere_are_taken_out_where_the_rest_makes_sense() {
    let mut document = Document::with_triangle();
    document.json["nodes"][0]["mesh"] = json!(7);
    document.json["nodes"][0]["skin"] = json!(8);
    document.json["meshes"][0]["primitives"][0]["material"] = json!(9);
    let scene = document.open().expect("opens");
    assert_eq!((scene.nodes[0].mesh, scene.nodes[0].skin), (None, None));
    assert_eq!(
        scene.warnings,
        [
            "node 0 \"n\", mesh: it leads to number 7 of 1 meshes; the node shows nothing",
            "node 0 \"n\", skin: it leads to number 8 of 0 skins; the node moves as a whole",
            "mesh 0 \"tri\", primitives[0].material: it leads to number 9 of 0 materials; the default material is shown",
        ]
    );
}

#[test]
fn the_scene_asked_for_is_shown() {
    let mut document = Document::with_triangle();
    document.add("nodes", json!({ "name": "other", "mesh": 0 }));
    document.json["scenes"] = json!([{ "nodes": [0], "name": "first" }, { "nodes": [1] }]);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("scenes.gltf");
    std::fs::write(&path, document.bytes()).expect("written");
    let open = |wanted: Option<&str>| {
        let options = scene::load::OpenOptions {
            scene: wanted.map(|name| scene::load::SceneChoice::Named(name.to_owned())),
            ..Default::default()
        };
        scene::load::open_with(&path, &options, &Progress::default())
    };
    for (asked, shown) in [(None, 0), (Some("first"), 0), (Some("1"), 1), (Some("scene 1"), 1)] {
        let scene = open(asked).expect("opens");
        assert_eq!(scene.scene_names, ["first", "scene 1"]);
        assert_eq!(scene.shown_scene, Some(shown));
        assert_eq!(scene.objects().iter().map(|object| object.node).collect::<Vec<_>>(), [shown]);
    }
    let refusal = open(Some("2")).expect_err("refused").to_string();
    assert!(refusal.ends_with("scenes: there is no \"2\"; the file holds \"first\", \"scene 1\""), "{refusal}");
}

#[test]
fn only_the_default_scene_is_drawn() {
    let mut document = Document::with_triangle();
    document.add("nodes", json!({ "name": "other", "mesh": 0 }));
    document.json["scenes"] = json!([{ "nodes": [0] }, { "nodes": [1] }]);
    document.json["scene"] = json!(1);
    let scene = document.open().expect("opens");
    assert_eq!(scene.objects().iter().map(|object| object.node).collect::<Vec<_>>(), [1]);
    assert_eq!(
        scene.warnings,
        ["the file holds 2 scenes; \"scene 1\" is shown", "1 node with a mesh is not in the scene that is shown"]
    );
}

#[test]
fn files_beside_the_document_are_found() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut document = Document::with_triangle();
    std::fs::write(folder.path().join("a b ♻.bin"), document.buffer()).expect("written");
    document.json["buffers"] = json!([{ "byteLength": document.buffer().len(), "uri": "a%20b%20%E2%99%BB.bin" }]);
    let path = folder.path().join("scene.gltf");
    std::fs::write(&path, document.bytes()).expect("written");
    let scene = open(&path).expect("opens");
    assert_eq!((scene.name.as_str(), scene.meshes[0].triangle_count()), ("scene", 1));
    assert!(document.refusal().contains("opened from memory"));
    std::fs::remove_file(folder.path().join("a b ♻.bin")).expect("removed");
    let refusal = open(&path).expect_err("refused").to_string();
    assert!(refusal.contains("buffer 0 (a b ♻.bin) cannot be read"), "{refusal}");
}

#[test]
fn opening_can_be_cancelled() {
    let progress = Progress::default();
    progress.cancel();
    let result = scene::load::open_bytes("test.gltf", &Document::with_triangle().bytes(), None, &progress);
    assert_eq!(result.expect_err("cancelled").to_string(), "test.gltf: opening was cancelled");
    let progress = Progress::default();
    scene::load::open_bytes("test.gltf", &Document::with_triangle().bytes(), None, &progress).expect("opens");
    assert_eq!(progress.fraction(), 1.0);
}
