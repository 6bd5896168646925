//! Writes small glTF documents for tests: JSON with one buffer in a data URI.

use octolume::{
    progress::Progress,
    scene::{Scene, load},
};
use serde_json::{Value, json};

pub const F32: u32 = 5126;
pub const U32: u32 = 5125;
pub const U16: u32 = 5123;
pub const U8: u32 = 5121;
pub const I8: u32 = 5120;

pub const JSON_CHUNK: u32 = u32::from_le_bytes(*b"JSON");
pub const BINARY_CHUNK: u32 = u32::from_le_bytes(*b"BIN\0");

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
        let lanes = lanes_of(shape);
        let numbers = numbers(component, bytes);
        let of_lane =
            |lane: usize| numbers.iter().skip(lane).step_by(lanes).copied().filter(|number| number.is_finite());
        let min: Vec<f64> = (0..lanes).map(|lane| of_lane(lane).reduce(f64::min).unwrap_or(0.0)).collect();
        let max: Vec<f64> = (0..lanes).map(|lane| of_lane(lane).reduce(f64::max).unwrap_or(0.0)).collect();
        let accessor = json!({
            "bufferView": view, "componentType": component, "type": shape, "count": count, "min": min, "max": max,
        });
        self.add("accessors", accessor)
    }

    pub fn floats(&mut self, shape: &str, rows: &[f32]) -> usize {
        let lanes = lanes_of(shape);
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

    /// The first primitive of the first mesh.
    pub fn primitive(&mut self) -> &mut Value {
        &mut self.json["meshes"][0]["primitives"][0]
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
            let attributes = &mut document.primitive()["attributes"];
            attributes[format!("JOINTS_{set}")] = json!(joints);
            attributes[format!("WEIGHTS_{set}")] = json!(weights);
        }
        let joints: Vec<usize> =
            (0..joint_count).map(|joint| document.add("nodes", json!({ "translation": [joint, 0, 0] }))).collect();
        document.add("nodes", json!({ "name": "root", "children": &joints }));
        document.add("skins", json!({ "joints": joints }));
        document.json["nodes"][0]["skin"] = json!(0);
        document
    }

    /// Its nodes slide along x for a second in the clip "slide".
    pub fn with_clip(mut self) -> Self {
        let input = self.floats("SCALAR", &[0.0, 1.0]);
        let output = self.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
        let target = json!({ "node": 0, "path": "translation" });
        self.add(
            "animations",
            json!({
                "name": "slide",
                "samplers": [{ "input": input, "output": output }],
                "channels": [{ "sampler": 0, "target": target }],
            }),
        );
        self
    }

    /// A material that shows an image of the document's buffer.
    pub fn with_texture(mut self, image: &[u8], mime_type: &str) -> Self {
        let uvs = self.floats("VEC2", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
        self.primitive()["attributes"]["TEXCOORD_0"] = json!(uvs);
        self.primitive()["material"] = json!(0);
        let view = self.view(image);
        self.add("images", json!({ "bufferView": view, "mimeType": mime_type }));
        self.add("textures", json!({ "source": 0 }));
        self.add("materials", json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }));
        self
    }

    /// As a .gltf file. Lists that stayed empty are left out, as glTF wants it.
    pub fn bytes(&self) -> Vec<u8> {
        let uri = format!("data:application/octet-stream;base64,{}", base64::encode(&self.bytes));
        self.with_buffer(json!({ "byteLength": self.bytes.len(), "uri": uri })).to_string().into_bytes()
    }

    /// As a .glb file.
    pub fn glb(&self) -> Vec<u8> {
        let (json, binary) = self.parts();
        let json = json.to_string();
        let chunks = [(JSON_CHUNK, json.as_bytes()), (BINARY_CHUNK, binary)];
        glb(&chunks[..if binary.is_empty() { 1 } else { 2 }])
    }

    /// The JSON of [`Self::glb`], and its binary chunk.
    pub fn parts(&self) -> (Value, &[u8]) {
        (self.with_buffer(json!({ "byteLength": self.bytes.len() })), &self.bytes)
    }

    fn with_buffer(&self, buffer: Value) -> Value {
        let mut json = self.json.clone();
        // A null among given buffers is the place of this one.
        match json["buffers"].as_array_mut() {
            Some(buffers) => {
                buffers.iter_mut().filter(|place| place.is_null()).for_each(|place| *place = buffer.clone())
            }
            None if self.bytes.is_empty() => {}
            None => json["buffers"] = json!([buffer]),
        }
        for list in ["accessors", "bufferViews", "nodes", "meshes"] {
            if self.json[list] == json!([]) {
                json.as_object_mut().expect("an object").remove(list);
            }
        }
        json
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

/// A GLB file of these chunks, each padded to a multiple of 4 bytes.
pub fn glb(chunks: &[(u32, &[u8])]) -> Vec<u8> {
    let mut body = Vec::new();
    for &(kind, data) in chunks {
        let length = data.len().next_multiple_of(4);
        body.extend((length as u32).to_le_bytes());
        body.extend(kind.to_le_bytes());
        body.extend(data);
        body.resize(body.len() + length - data.len(), if kind == JSON_CHUNK { b' ' } else { 0 });
    }
    let header = [u32::from_le_bytes(*b"glTF"), 2, 12 + body.len() as u32];
    header.into_iter().flat_map(u32::to_le_bytes).chain(body).collect()
}

fn lanes_of(shape: &str) -> usize {
    ["SCALAR", "VEC2", "VEC3", "VEC4"].iter().position(|&name| name == shape).map_or(16, |at| at + 1)
}

fn numbers(component: u32, bytes: &[u8]) -> Vec<f64> {
    match component {
        F32 => bytes.as_chunks().0.iter().map(|&bytes| f32::from_le_bytes(bytes).into()).collect(),
        U32 => bytes.as_chunks().0.iter().map(|&bytes| u32::from_le_bytes(bytes).into()).collect(),
        U16 => bytes.as_chunks().0.iter().map(|&bytes| u16::from_le_bytes(bytes).into()).collect(),
        U8 => bytes.iter().map(|&byte| byte.into()).collect(),
        _ => bytes.iter().map(|&byte| (byte as i8).into()).collect(),
    }
}
