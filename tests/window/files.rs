//! Small files, written for one test each.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};

/// The one triangle that all meshes are: corners (0, 0, 0), (1, 0, 0), (0, 1, 0).
const TRIANGLE: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];

/// A file of these nodes, roots first by their numbers; mesh 0 is a triangle. `clip`: node 0 is at
/// these places at 0 and 1 s.
pub fn write(folder: &Path, name: &str, roots: &[usize], nodes: Vec<Value>, clip: Option<[[f32; 3]; 2]>) -> PathBuf {
    let mut floats = TRIANGLE.to_vec();
    let mut accessors = vec![accessor(0, "VEC3", 3, json!([0, 0, 0]), json!([1, 1, 0]))];
    let mut animations = Vec::new();
    if let Some(places) = clip {
        accessors.push(accessor(floats.len(), "SCALAR", 2, json!([0]), json!([1])));
        floats.extend([0.0, 1.0]);
        accessors.push(json!({ "bufferView": 0, "byteOffset": 4 * floats.len(), "componentType": 5126,
            "count": 2, "type": "VEC3" }));
        floats.extend(places.as_flattened());
        animations.push(json!({ "name": "fly", "samplers": [{ "input": 1, "output": 2 }],
            "channels": [{ "sampler": 0, "target": { "node": 0, "path": "translation" } }] }));
    }
    let bytes: Vec<u8> = floats.iter().flat_map(|float| float.to_le_bytes()).collect();
    let mut document = json!({
        "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": roots }], "nodes": nodes,
        "meshes": [{ "name": "triangle", "primitives": [{ "attributes": { "POSITION": 0 } }] }],
        "accessors": accessors,
        "bufferViews": [{ "buffer": 0, "byteLength": bytes.len() }],
        "buffers": [{ "byteLength": bytes.len(), "uri": format!("{name}.bin") }],
    });
    if !animations.is_empty() {
        document["animations"] = json!(animations);
    }
    std::fs::write(folder.join(format!("{name}.bin")), bytes).expect("written");
    let file = folder.join(format!("{name}.gltf"));
    std::fs::write(&file, document.to_string()).expect("written");
    file
}

fn accessor(first_float: usize, kind: &str, count: usize, min: Value, max: Value) -> Value {
    json!({ "bufferView": 0, "byteOffset": 4 * first_float, "componentType": 5126,
        "count": count, "type": kind, "min": min, "max": max })
}

/// A file that somebody drops on the window.
#[derive(Debug)]
pub struct Dropped(pub PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}
