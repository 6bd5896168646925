//! Files that are refused, with a sentence that names file, object and cause.

use std::path::Path;

use octolume::progress::Progress;
use octolume::scene;
use serde_json::json;

use crate::document::Document;

#[test]
fn bad_numbers_are_refused_by_name() {
    let mut document = Document::new();
    let positions = document.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, f32::NAN, 0.0, 0.0, 0.0, 1.0]);
    document.mesh("broken", json!({ "attributes": { "POSITION": positions } }));
    let refusal = document.refusal();
    assert!(
        refusal.starts_with("test.gltf: mesh 0 \"broken\", primitive 0, POSITION: is not finite at vertex 1"),
        "{refusal}"
    );

    let mut document = Document::with_triangle();
    let indices = document.indices(&[0, 1, 3]);
    document.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
    let refusal = document.refusal();
    assert!(refusal.ends_with("mesh 0 \"tri\", primitive 0, indices: index 2 names vertex 3 of 3"), "{refusal}");

    let mut document = Document::with_triangle();
    document.json["nodes"][0]["translation"] = json!([1e300, 0, 0]);
    assert_eq!(document.refusal(), "test.gltf: node 0 \"n\": has a transform that is not finite");
}

#[test]
fn structure_that_does_not_hold_is_refused() {
    let refusal = |change: &dyn Fn(&mut Document)| {
        let mut document = Document::with_triangle();
        change(&mut document);
        document.refusal()
    };
    let says = |text: &str, change: &dyn Fn(&mut Document)| {
        let refusal = refusal(change);
        assert!(refusal.starts_with("test.gltf: ") && refusal.contains(text), "{refusal}");
    };
    says("reads past the end of its buffer view", &|document| document.json["accessors"][0]["count"] = json!(4));
    says("reads past the end", &|document| document.json["accessors"][0]["count"] = json!(u64::MAX / 12));
    says("ends outside buffer 0", &|document| document.json["bufferViews"][0]["byteOffset"] = json!(u64::MAX));
    says("stride of 4", &|document| document.json["bufferViews"][0]["byteStride"] = json!(4));
    says("primitives[0].attributes.POSITION: leads to number 9 of 1 accessors", &|document| {
        document.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = json!(9)
    });
    says("ACME_rockets cannot be read", &|document| {
        document.json["extensionsRequired"] = json!(["KHR_draco_mesh_compression", "ACME_rockets"]);
        document.json["extensionsUsed"] = json!(["KHR_draco_mesh_compression", "ACME_rockets"]);
    });
    says("version \"1.0\"", &|document| document.json["asset"]["version"] = json!("1.0"));
    says("is its own ancestor", &|document| {
        document.add("nodes", json!({ "children": [2] }));
        document.add("nodes", json!({ "children": [1] }));
    });
    says("is a child of node 1 and of node 2", &|document| {
        document.add("nodes", json!({ "children": [0] }));
        document.add("nodes", json!({ "children": [0] }));
    });
}

#[test]
fn binary_headers_are_checked() {
    let refusal = |bytes: &[u8]| {
        scene::load::open_bytes("a.glb", bytes, None, &Progress::default()).expect_err("refused").to_string()
    };
    assert_eq!(refusal(b"glTF\x02\0\0\0\0\0\0\0"), "a.glb: GLB header: declares 0 bytes in a file of 12");
    assert_eq!(refusal(b"glTF"), "a.glb: GLB header: has version 0, and only glTF 2.0 can be read");
    assert!(refusal(b"glTF\x02\0\0\0\xff\xff\xff\xff").contains("declares 4294967295 bytes"));
    assert!(refusal(b"").starts_with("a.glb: document: is not JSON: "));
    let missing = scene::load::open(Path::new("no/such.glb"), &Progress::default()).expect_err("refused").to_string();
    assert!(missing.starts_with("no/such.glb: cannot be read: "), "{missing}");
}

/// Whatever allocates by a number of the file asks the budget first, however often data is shared.
#[test]
fn what_would_take_too_much_is_refused_before_it_does() {
    let options = scene::load::OpenOptions { memory_budget_bytes: 16 << 20, ..Default::default() };
    let refusal = |document: &Document| {
        let opened = scene::load::open_bytes_with("a.gltf", &document.bytes(), None, &options, &Progress::default());
        opened.expect_err("refused").to_string()
    };
    let mut document = Document::with_triangle();
    let times: Vec<f32> = (0..4096).map(|key| key as f32).collect();
    let (input, output) = (document.floats("SCALAR", &times), document.floats("VEC3", &times.repeat(3)));
    let channels: Vec<_> = (0..400)
        .map(|_| json!({ "sampler": 0, "target": { "node": document.add("nodes", json!({})), "path": "scale" } }))
        .collect();
    document.add("animations", json!({ "samplers": [{ "input": input, "output": output }], "channels": channels }));
    assert!(refusal(&document).contains("needs memory"), "{}", refusal(&document));

    let mut document = Document::with_triangle();
    document.json["materials"] = json!([[]]);
    assert_eq!(document.refusal(), "test.gltf: material 0: cannot be read: invalid type, expected an object");

    let mut document = Document::with_triangle();
    let ones = document.view(&1.0_f32.to_le_bytes().repeat(3 << 16));
    for _ in 0..64 {
        document.add(
            "accessors",
            json!({ "bufferView": ones, "componentType": 5126, "type": "VEC3", "count": 1 << 16, "max": [1, 1, 1] }),
        );
    }
    let scene = document.open().expect("opens");
    assert_eq!(scene.warnings, ["accessors: they overlap so often that not all of their values were checked"]);
}
