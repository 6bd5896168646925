//! Warnings know what of the file they are about, and which nodes of the scene that is.

use octolume::scene::{FilePart, Scene};
use serde_json::json;

use crate::document::Document;

/// Part and nodes of the warning whose sentence has these words.
fn about(scene: &Scene, words: &str) -> (Option<FilePart>, Vec<usize>) {
    let found = scene.warnings.iter().find(|warning| warning.sentence.contains(words));
    let warning = found.unwrap_or_else(|| panic!("no warning has {words:?}: {:?}", scene.warnings));
    (warning.part, warning.nodes.clone())
}

fn part(kind: &'static str, index: usize) -> Option<FilePart> {
    Some(FilePart { kind, index })
}

/// Node 0 of the file shows the mesh; so do others, which a parent puts elsewhere in the scene's order.
fn shown_three_times() -> Document {
    let mut document = Document::with_triangle();
    document.json["scenes"] = json!([{ "nodes": [2, 0] }]);
    document.add("nodes", json!({ "name": "below", "mesh": 0 }));
    document.add("nodes", json!({ "name": "parent", "children": [1] }));
    document
}

#[test]
fn a_warning_about_a_mesh_is_about_the_nodes_that_show_it() {
    let mut document = shown_three_times();
    document.json["meshes"][0]["weights"] = json!([0.5]);
    document.json["nodes"][1]["weights"] = json!([0.25]);
    let scene = document.open().expect("opens");
    let shows = |node: &usize| scene.nodes[*node].mesh.is_some();
    let nodes: Vec<usize> = (0..scene.nodes.len()).filter(shows).collect();
    assert_eq!((nodes.len(), about(&scene, "0 morph targets")), (2, (part("mesh", 0), nodes)));
}

#[test]
fn a_warning_about_a_node_is_about_its_place_in_the_scene() {
    let mut document = shown_three_times();
    let sheared: Vec<f32> = (0..16).map(|at| if at % 5 == 0 || at == 3 { 1.0 } else { 0.0 }).collect();
    document.json["nodes"][1]["matrix"] = json!(sheared);
    let scene = document.open().expect("opens");
    let place = scene.nodes.iter().position(|node| node.name == "below").expect("the node");
    assert_eq!(about(&scene, "the fourth row of its matrix"), (part("node", 1), vec![place]));
}

#[test]
fn a_material_is_that_of_what_wears_it_and_an_image_of_none() {
    let mut document = shown_three_times();
    document.add("materials", json!({ "alphaMode": "GLASS" }));
    document.add("images", json!({ "uri": "data:image/png;base64,AAAA" }));
    document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    let scene = document.open().expect("opens");
    assert_eq!(about(&scene, "alpha mode").0, part("material", 0));
    assert_eq!(about(&scene, "alpha mode").1.len(), 2);
    assert_eq!(about(&scene, "image 0"), (part("image", 0), vec![]));
}

#[test]
fn names_within_names_are_not_taken_for_nodes() {
    let mut document = shown_three_times();
    document.json["nodes"][0]["name"] = json!("node 1 \"below\"");
    document.json["extensionsUsed"] = json!(["VENDOR_node 1"]);
    let scene = document.open().expect("opens");
    assert_eq!(about(&scene, "VENDOR_node 1"), (None, vec![]));
}
