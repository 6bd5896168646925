//! Scenes of walls, written to a folder: a white plane, two banners, and KayKit's Knight in a room whose floor is glossy,
//! left wall red and right wall green, open towards the camera.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};

/// Half of the room's width and depth; it is as high as wide. The Knight is 2.4 high.
const HALF: f32 = 2.0;

/// Corners of a wall counterclockwise from inside, its normal, and its material: colour and roughness.
pub type Wall = ([[f32; 3]; 4], [f32; 3], ([f32; 3], f32));

fn walls() -> [Wall; 5] {
    let (h, top) = (HALF, 2.0 * HALF);
    let white = [0.73; 3];
    [
        ([[-h, 0.0, h], [h, 0.0, h], [h, 0.0, -h], [-h, 0.0, -h]], [0.0, 1.0, 0.0], (white, 0.25)),
        ([[-h, top, -h], [h, top, -h], [h, top, h], [-h, top, h]], [0.0, -1.0, 0.0], (white, 1.0)),
        ([[-h, 0.0, -h], [h, 0.0, -h], [h, top, -h], [-h, top, -h]], [0.0, 0.0, 1.0], (white, 1.0)),
        ([[-h, 0.0, h], [-h, 0.0, -h], [-h, top, -h], [-h, top, h]], [1.0, 0.0, 0.0], ([0.65, 0.06, 0.05], 1.0)),
        ([[h, 0.0, -h], [h, 0.0, h], [h, top, h], [h, top, -h]], [-1.0, 0.0, 0.0], ([0.14, 0.45, 0.09], 1.0)),
    ]
}

/// Two units wide, around the origin, facing up; reflects all light, as rough as can be.
pub fn white_plane(folder: &Path) -> PathBuf {
    let corners = [[-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [-1.0, 0.0, -1.0]];
    write(&folder.join("plane.gltf"), &document(&[(corners, [0.0, 1.0, 0.0], ([1.0; 3], 1.0))]))
}

/// A square unit of `left` and one of `right`, side by side in the plane z = 0 above y = 0, meeting at x = 0; they face
/// z and are as rough as can be.
pub fn banners(left: [f32; 3], right: [f32; 3]) -> Value {
    let banner = |x: f32| [[x, 0.0, 0.0], [x + 1.0, 0.0, 0.0], [x + 1.0, 1.0, 0.0], [x, 1.0, 0.0]];
    let wall = |x: f32, color: [f32; 3]| (banner(x), [0.0, 0.0, 1.0], (color, 1.0));
    document(&[wall(-1.0, left), wall(0.0, right)])
}

fn document(walls: &[Wall]) -> Value {
    let mut document = json!({
        "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [] }],
        "nodes": [], "meshes": [], "materials": [], "accessors": [], "bufferViews": [], "buffers": [],
    });
    walls.iter().enumerate().for_each(|(number, wall)| add_wall(&mut document, number, wall));
    document
}

pub fn write(file: &Path, document: &Value) -> PathBuf {
    std::fs::write(file, document.to_string()).expect("writable");
    file.to_owned()
}

/// Writes the scene below `folder`; `None` where there is no Knight.
pub fn knight_in_a_room(folder: &Path) -> Option<PathBuf> {
    let knight = std::fs::read(crate::real_scenes::real_scenes()?.join("KayKit-Knight/Knight.glb")).ok()?;
    let (json, binary) = chunks(&knight);
    let mut document: Value = serde_json::from_slice(json).expect("JSON");
    std::fs::write(folder.join("Knight.bin"), binary).expect("writable");
    document["buffers"][0]["uri"] = json!("Knight.bin");
    for (number, wall) in walls().iter().enumerate() {
        add_wall(&mut document, number, wall);
    }
    Some(write(&folder.join("knight-room.gltf"), &document))
}

/// JSON and binary chunk of a .glb file.
fn chunks(glb: &[u8]) -> (&[u8], &[u8]) {
    let length = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().expect("4 bytes")) as usize;
    let end = 20 + length(12);
    (&glb[20..end], &glb[end + 8..end + 8 + length(end)])
}

fn push(document: &mut Value, list: &str, entry: Value) -> usize {
    let list = document[list].as_array_mut().expect("a list");
    list.push(entry);
    list.len() - 1
}

fn add_wall(document: &mut Value, number: usize, (corners, normal, (color, roughness)): &Wall) {
    let floats = corners.as_flattened().iter().chain(std::iter::repeat_n(normal, 4).flatten());
    let mut bytes: Vec<u8> = floats.flat_map(|value| value.to_le_bytes()).collect();
    bytes.extend([0_u16, 1, 2, 0, 2, 3].iter().flat_map(|index| index.to_le_bytes()));
    let uri = format!("data:application/octet-stream;base64,{}", base64::encode(&bytes));
    let buffer = push(document, "buffers", json!({ "byteLength": bytes.len(), "uri": uri }));
    let mut accessor = |offset: usize, length: usize, rest: Value| {
        let view = json!({ "buffer": buffer, "byteOffset": offset, "byteLength": length });
        let view = push(document, "bufferViews", view);
        let mut accessor = rest;
        accessor["bufferView"] = json!(view);
        push(document, "accessors", accessor)
    };
    let bound = |pick: fn(f32, f32) -> f32| {
        [0, 1, 2].map(|axis| corners.iter().map(|corner| corner[axis]).reduce(pick).expect("four"))
    };
    let vectors = json!({ "componentType": 5126, "count": 4, "type": "VEC3" });
    let mut positions = vectors.clone();
    (positions["min"], positions["max"]) = (json!(bound(f32::min)), json!(bound(f32::max)));
    let position = accessor(0, 48, positions);
    let normal = accessor(48, 48, vectors);
    let indices = accessor(96, 12, json!({ "componentType": 5123, "count": 6, "type": "SCALAR" }));
    let [r, g, b] = color;
    let surface = json!({ "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": roughness });
    let material = push(document, "materials", json!({ "name": "wall", "pbrMetallicRoughness": surface }));
    let attributes = json!({ "POSITION": position, "NORMAL": normal });
    let primitive = json!({ "attributes": attributes, "indices": indices, "material": material });
    let mesh = push(document, "meshes", json!({ "name": format!("wall {number}"), "primitives": [primitive] }));
    let node = push(document, "nodes", json!({ "name": format!("wall {number}"), "mesh": mesh }));
    document["scenes"][0]["nodes"].as_array_mut().expect("a list").push(json!(node));
}
