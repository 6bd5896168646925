//! Writes small glTF documents for tests: JSON with one buffer in a data URI.

use octolume::{
    progress::Progress,
    scene::{Scene, load},
};
use serde_json::{Value, json};

pub const F32: u32 = 5126;
pub const U16: u32 = 5123;
pub const U8: u32 = 5121;
pub const I8: u32 = 5120;

pub struct Document {
    pub json: Value,
    bytes: Vec<u8>,
}

impl Document {
    pub fn new() -> Self {
        let json = json!({
            "asset": { "version": "2.0" }, "accessors": [], "bufferViews": [], "nodes": [], "meshes": [],
        });
        Self { json, bytes: Vec::new() }
    }

    /// Appends to a top-level list; returns the index.
    pub fn add(&mut self, list: &str, value: Value) -> usize {
        let list = &mut self.json[list];
        if list.is_null() {
            *list = json!([]);
        }
        let list = list.as_array_mut().expect("a list");
        list.push(value);
        list.len() - 1
    }

    pub fn view(&mut self, bytes: &[u8]) -> usize {
        let offset = self.bytes.len();
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.add("bufferViews", json!({ "buffer": 0, "byteOffset": offset, "byteLength": bytes.len() }))
    }

    pub fn accessor(&mut self, component: u32, shape: &str, count: usize, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        let mut accessor = json!({
            "bufferView": view, "componentType": component, "type": shape, "count": count, "normalized": false,
            "min": [0.0, 0.0, 0.0], "max": [0.0, 0.0, 0.0],
        });
        if shape != "VEC3" {
            accessor.as_object_mut().expect("an object").retain(|key, _| key != "min" && key != "max");
        }
        self.add("accessors", accessor)
    }

    pub fn floats(&mut self, shape: &str, rows: &[f32]) -> usize {
        let lanes = ["SCALAR", "VEC2", "VEC3", "VEC4"].iter().position(|&name| name == shape).map_or(16, |at| at + 1);
        let bytes: Vec<u8> = rows.iter().flat_map(|value| value.to_le_bytes()).collect();
        self.accessor(F32, shape, rows.len() / lanes, &bytes)
    }

    pub fn indices(&mut self, indices: &[u16]) -> usize {
        let bytes: Vec<u8> = indices.iter().flat_map(|value| value.to_le_bytes()).collect();
        self.accessor(U16, "SCALAR", indices.len(), &bytes)
    }

    /// A mesh of one primitive.
    pub fn mesh(&mut self, name: &str, primitive: Value) -> usize {
        self.add("meshes", json!({ "name": name, "primitives": [primitive] }))
    }

    /// One triangle with corners on the axes, without normals, on a node of its own.
    pub fn with_triangle() -> Self {
        let mut document = Self::new();
        let positions = document.floats("VEC3", &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
        let mesh = document.mesh("tri", json!({ "attributes": { "POSITION": positions } }));
        document.add("nodes", json!({ "name": "n", "mesh": mesh }));
        document
    }

    /// [`Self::with_triangle`] bound to as many joints as asked for, each moved to (joint, 0, 0);
    /// `sets` are JOINTS_n and WEIGHTS_n, the same at each corner.
    pub fn with_skin(joint_count: usize, sets: &[([u16; 4], [f32; 4])]) -> Self {
        let mut document = Self::with_triangle();
        for (set, (joints, weights)) in sets.iter().enumerate() {
            let bytes: Vec<u8> = joints.repeat(3).iter().flat_map(|joint| joint.to_le_bytes()).collect();
            let joints = document.accessor(U16, "VEC4", 3, &bytes);
            let weights = document.floats("VEC4", &weights.repeat(3));
            let attributes = &mut document.json["meshes"][0]["primitives"][0]["attributes"];
            attributes[format!("JOINTS_{set}")] = json!(joints);
            attributes[format!("WEIGHTS_{set}")] = json!(weights);
        }
        let joints: Vec<usize> =
            (0..joint_count).map(|joint| document.add("nodes", json!({ "translation": [joint, 0, 0] }))).collect();
        document.add("skins", json!({ "joints": joints }));
        document.json["nodes"][0]["skin"] = json!(0);
        document
    }

    pub fn bytes(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        if !self.bytes.is_empty() && json["buffers"].is_null() {
            let uri = format!("data:application/octet-stream;base64,{}", base64::encode(&self.bytes));
            json["buffers"] = json!([{ "byteLength": self.bytes.len(), "uri": uri }]);
        }
        json.to_string().into_bytes()
    }

    pub fn buffer(&self) -> &[u8] {
        &self.bytes
    }

    pub fn open(&self) -> Result<Scene, load::LoadError> {
        load::open_bytes("test.gltf", &self.bytes(), None, &Progress::default())
    }

    /// The sentence of the refusal.
    pub fn refusal(&self) -> String {
        match self.open() {
            Ok(scene) => panic!("opened, with warnings {:?}", scene.warnings),
            Err(error) => error.to_string(),
        }
    }
}
