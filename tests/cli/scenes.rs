//! Small scenes as .gltf and .bin files: a box that turns, and one bent by two joints.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use tempfile::TempDir;

/// Triangles of a box.
pub const BOX_TRIANGLES: u64 = 12;
/// Length of the clip "Turn".
pub const TURN_SECS: f64 = 2.0;

const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;

/// A folder that goes away with the test.
pub struct Scenes {
    folder: TempDir,
}

impl Scenes {
    pub fn new() -> Self {
        Self { folder: TempDir::new().expect("a temporary folder") }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Nothing moves it.
    pub fn still_box(&self) -> PathBuf {
        let mut file = Writer::default();
        let attributes = file.box_attributes();
        file.write(&self.path("still.gltf"), attributes, json!([{ "name": "Crate", "mesh": 0 }]), None, None)
    }

    /// Two nodes of one name.
    pub fn twins(&self) -> PathBuf {
        let mut file = Writer::default();
        let attributes = file.box_attributes();
        let twin = json!({ "name": "Twin", "mesh": 0 });
        file.write(&self.path("twins.gltf"), attributes, json!([{ "children": [1, 2] }, twin, twin]), None, None)
    }

    /// Turns by 90° about y in [`TURN_SECS`].
    pub fn turning_box(&self) -> PathBuf {
        let mut file = Writer::default();
        let attributes = file.box_attributes();
        let animation = file.quarter_turn(0);
        file.write(&self.path("box.gltf"), attributes, json!([{ "name": "Crate", "mesh": 0 }]), None, Some(animation))
    }

    /// The box hangs between two joints; "Turn" turns the upper one.
    pub fn bent_box(&self) -> PathBuf {
        let mut file = Writer::default();
        let mut attributes = file.box_attributes();
        let upper = |vertex: usize| vertex & 2 != 0;
        let joints: Vec<u16> = (0..8).flat_map(|vertex| [u16::from(upper(vertex)), 0, 0, 0]).collect();
        let weights: Vec<f32> = (0..8).flat_map(|_| [1.0, 0.0, 0.0, 0.0]).collect();
        attributes["JOINTS_0"] = file.accessor(bytemuck::cast_slice(&joints), UNSIGNED_SHORT, "VEC4", 8, None);
        attributes["WEIGHTS_0"] = file.accessor(bytemuck::cast_slice(&weights), FLOAT, "VEC4", 8, None);
        let nodes = json!([
            { "name": "Sleeve", "mesh": 0, "skin": 0 },
            { "name": "Lower", "children": [2] },
            { "name": "Upper" },
        ]);
        let animation = file.quarter_turn(2);
        file.write(&self.path("sleeve.gltf"), attributes, nodes, Some(json!([{ "joints": [1, 2] }])), Some(animation))
    }
}

/// A document and its buffer.
#[derive(Default)]
struct Writer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Writer {
    fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize, range: Option<[Value; 2]>) -> Value {
        let offset = self.bytes.len();
        self.bytes.extend_from_slice(bytes);
        self.views.push(json!({ "buffer": 0, "byteOffset": offset, "byteLength": bytes.len() }));
        let view = self.views.len() - 1;
        let mut accessor = json!({ "bufferView": view, "componentType": component, "type": kind, "count": count });
        if let Some([min, max]) = range {
            (accessor["min"], accessor["max"]) = (min, max);
        }
        self.accessors.push(accessor);
        json!(self.accessors.len() - 1)
    }

    /// A box of 2 x 3 x 1 units, its corners numbered by the bits of x, y, z.
    fn box_attributes(&mut self) -> Value {
        let corner = |vertex: usize| [(vertex & 1) as f32 * 2.0, (vertex >> 1 & 1) as f32 * 3.0, (vertex >> 2) as f32];
        let positions: Vec<f32> = (0..8).flat_map(corner).collect();
        let range = Some([json!([0.0, 0.0, 0.0]), json!([2.0, 3.0, 1.0])]);
        let positions = self.accessor(bytemuck::cast_slice(&positions), FLOAT, "VEC3", 8, range);
        json!({ "POSITION": positions })
    }

    fn quarter_turn(&mut self, node: usize) -> Value {
        let times = [0.0, TURN_SECS as f32];
        let half = std::f32::consts::FRAC_1_SQRT_2;
        let rotations = [0.0, 0.0, 0.0, 1.0, 0.0, half, 0.0, half];
        let range = Some([json!([0.0]), json!([TURN_SECS])]);
        let input = self.accessor(bytemuck::cast_slice(&times), FLOAT, "SCALAR", 2, range);
        let output = self.accessor(bytemuck::cast_slice(&rotations), FLOAT, "VEC4", 2, None);
        json!([{
            "name": "Turn",
            "samplers": [{ "input": input, "output": output }],
            "channels": [{ "sampler": 0, "target": { "node": node, "path": "rotation" } }],
        }])
    }

    fn write(
        mut self,
        file: &Path,
        attributes: Value,
        nodes: Value,
        skins: Option<Value>,
        clips: Option<Value>,
    ) -> PathBuf {
        let faces: [[u16; 4]; 6] = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let indices: Vec<u16> = faces.iter().flat_map(|&[a, b, c, d]| [a, b, c, a, c, d]).collect();
        let indices = self.accessor(bytemuck::cast_slice(&indices), UNSIGNED_SHORT, "SCALAR", indices.len(), None);
        let bin = file.with_extension("bin");
        let roots: &[u32] = if skins.is_some() { &[0, 1] } else { &[0] };
        let mut document = json!({
            "asset": { "version": "2.0" },
            "scene": 0,
            "scenes": [{ "nodes": roots }],
            "nodes": nodes,
            "meshes": [{ "primitives": [{ "attributes": attributes, "indices": indices, "material": 0 }] }],
            "materials": [{ "pbrMetallicRoughness": { "baseColorFactor": [0.8, 0.2, 0.1, 1.0] } }],
            "buffers": [{ "uri": bin.file_name().and_then(|name| name.to_str()), "byteLength": self.bytes.len() }],
            "bufferViews": self.views,
            "accessors": self.accessors,
        });
        for (name, part) in [("skins", skins), ("animations", clips)] {
            if let Some(part) = part {
                document[name] = part;
            }
        }
        fs::write(bin, &self.bytes).expect("written");
        fs::write(file, document.to_string()).expect("written");
        file.to_owned()
    }
}
