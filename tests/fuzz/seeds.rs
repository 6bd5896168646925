//! Small sound documents, which together use everything that is read.

use image::ImageFormat;
use serde_json::{Value, json};

use crate::document::{Document, I8, U8, U16};
use crate::looks::{materials, sights, textured};

/// An octahedron with normals and texture coordinates as a Draco stream, coded sequentially and by edge breaker.
const DRACO: [&str; 2] = [
    "445241434f020201000000080601000204020104010304030004020005010205030105000305010300090300000109030001030902000202030200010100090701201301200300689001ffffc2bf3f0002f0ef0f0200000000ff00000000030101013f011077552577ad0a04ca50f45a3f0000001f000000000101000703ad0a55150b012003eba36cc12fbf8fc00f000000003f000000000080bf000080bf000080bf00000040080600000000000000000000803f06",
    "445241434f02020101000000060802070000026f15010110ff02cc40ff02cc4003ff0000000000010000010009030000020101090300010301030902000202010101010180025515ffffffef1d07039123056f3532035900000000ff000000000080bf000080bf000080bf000000400800030101023f55157705205505735505052192f7b2823f0000001f000000060101010101400110ef550503ad2a0435edbf92000000003f00000000000000000000000000803f06",
];
/// Corners and triangles of the same octahedron as meshopt streams.
const MESHOPT_CORNERS: &str = "a00000010c000000ff013c000000ff820000010cc00000ffff010fc000007eff8200000100c00000ff0100f000007eff00000000000000000000000000000000000000000000803f0000000000000000";
const MESHOPT_TRIANGLES: &str = "e0fe100f048f021115ff04040104007687566778a9866589689801690000";

pub fn all() -> Vec<Document> {
    let mut seeds = vec![
        Document::with_triangle(),
        moving(),
        skinned(),
        sparse(),
        morphed(),
        quantized(),
        instanced(),
        strips(),
        meshopt(),
        sights(),
        materials(),
    ];
    seeds.extend(DRACO.map(draco));
    seeds.extend([
        textured(ImageFormat::Png, "image/png"),
        textured(ImageFormat::Jpeg, "image/jpeg"),
        textured(ImageFormat::WebP, "image/webp"),
    ]);
    seeds
}

fn unhex(text: &str) -> Vec<u8> {
    (0..text.len()).step_by(2).map(|at| u8::from_str_radix(&text[at..at + 2], 16).expect("hex")).collect()
}

pub fn require(document: &mut Document, extension: &str) {
    document.json["extensionsUsed"] = json!([extension]);
    document.json["extensionsRequired"] = json!([extension]);
}

/// Every property and interpolation.
fn moving() -> Document {
    let mut document = Document::with_triangle().with_clip();
    let times = document.floats("SCALAR", &[0.0, 0.5]);
    let turns = document.floats("VEC4", &[0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0]);
    let splines = document.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, 1.0, 1.0].repeat(3));
    let animation = &mut document.json["animations"][0];
    animation["samplers"] = json!([
        animation["samplers"][0],
        { "input": times, "output": turns, "interpolation": "STEP" },
        { "input": times, "output": splines, "interpolation": "CUBICSPLINE" },
    ]);
    for (sampler, path) in [(1, "rotation"), (2, "scale")] {
        let channels = animation["channels"].as_array_mut().expect("a list");
        channels.push(json!({ "sampler": sampler, "target": { "node": 0, "path": path } }));
    }
    document
}

fn skinned() -> Document {
    let sets = [([0, 1, 2, 0], [0.25, 0.25, 0.25, 0.0]), ([3, 0, 0, 0], [0.25, 0.0, 0.0, 0.0])];
    let mut document = Document::with_skin(4, &sets).with_clip();
    document.json["animations"][0]["channels"][0]["target"]["node"] = json!(2);
    let mut matrix = [0.0; 16];
    (0..4).for_each(|lane| matrix[5 * lane] = 1.0);
    let inverse_bind = document.floats("MAT4", &matrix.repeat(4));
    document.json["skins"][0]["inverseBindMatrices"] = json!(inverse_bind);
    document.json["skins"][0]["skeleton"] = json!(5);
    document
}

fn sparse() -> Document {
    let mut document = Document::with_triangle();
    let indices = document.view(&[0, 2]);
    let values = document.view(&[0; 24]);
    document.json["accessors"][0]["sparse"] = json!({
        "count": 2,
        "indices": { "bufferView": indices, "componentType": U8 },
        "values": { "bufferView": values },
    });
    document.json["accessors"][0]["max"] = json!([0.0, 1.0, 0.0]);
    document
}

fn morphed() -> Document {
    let mut document = Document::with_triangle();
    let moved = document.floats("VEC3", &[0.0, 0.0, 0.5, 0.0, 0.0, 0.5, 0.0, 0.0, 0.5]);
    let normals = document.floats("VEC3", &[0.0, 0.0, 1.0].repeat(3));
    document.primitive()["attributes"]["NORMAL"] = json!(normals);
    document.primitive()["targets"] = json!([{ "POSITION": moved }, { "POSITION": moved, "NORMAL": normals }]);
    document.json["meshes"][0]["weights"] = json!([0.5, 0.25]);
    document.json["nodes"][0]["weights"] = json!([1.0, 0.0]);
    document
}

fn quantized() -> Document {
    let mut document = Document::with_triangle();
    let mut padded = |component: u32, rows: &[u8]| {
        let accessor = document.accessor(component, "VEC3", rows.len() / 4, rows);
        let view = document.json["accessors"][accessor]["bufferView"].as_u64().expect("a number") as usize;
        document.json["bufferViews"][view]["byteStride"] = json!(4);
        document.json["accessors"][accessor]["normalized"] = json!(true);
        accessor
    };
    let (positions, normals) =
        (padded(U8, &[255, 0, 0, 0, 0, 255, 0, 0, 0, 0, 255, 0]), padded(I8, &[0, 0, 127, 0].repeat(3)));
    document.json["accessors"][positions]["min"] = json!([0, 0, 0]);
    document.json["accessors"][positions]["max"] = json!([255, 255, 255]);
    document.json["accessors"][normals]
        .as_object_mut()
        .expect("an object")
        .retain(|key, _| key != "min" && key != "max");
    document.primitive()["attributes"] = json!({ "POSITION": positions, "NORMAL": normals });
    require(&mut document, "KHR_mesh_quantization");
    document
}

fn instanced() -> Document {
    let mut document = Document::with_triangle();
    let places = document.floats("VEC3", &[0.0, 0.0, 0.0, 3.0, 0.0, 0.0]);
    let turns = document.floats("VEC4", &[0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0]);
    let attributes = json!({ "TRANSLATION": places, "ROTATION": turns, "SCALE": places });
    document.json["nodes"][0]["extensions"] = json!({ "EXT_mesh_gpu_instancing": { "attributes": attributes } });
    require(&mut document, "EXT_mesh_gpu_instancing");
    document
}

/// A strip and a fan, with and without indices, and two scenes of nodes in nodes.
fn strips() -> Document {
    let mut document = Document::with_triangle();
    let indices = document.indices(&[0, 1, 2, 0]);
    let positions = document.primitive()["attributes"]["POSITION"].clone();
    let primitive = |mode: u32| json!({ "attributes": { "POSITION": positions }, "mode": mode, "indices": indices });
    document.add("meshes", json!({ "primitives": [primitive(5), primitive(6)] }));
    document.add("nodes", json!({ "mesh": 1, "scale": [-1.0, 2.0, 1.0] }));
    document.add("nodes", json!({ "children": [0, 1], "translation": [1e6, 0.0, 0.0] }));
    document.json["scenes"] = json!([{ "nodes": [2] }]);
    document.json["scene"] = json!(0);
    document
}

fn octahedron(document: &mut Document, attributes: &Value, index_type: u32) -> usize {
    let indices = document.add("accessors", json!({ "componentType": index_type, "type": "SCALAR", "count": 24 }));
    let mesh = document.mesh("octahedron", json!({ "attributes": attributes, "indices": indices }));
    document.add("nodes", json!({ "mesh": mesh }));
    mesh
}

fn corners(document: &mut Document, shape: &str) -> usize {
    let mut accessor = json!({ "componentType": 5126, "type": shape, "count": 6 });
    if shape == "VEC3" {
        (accessor["min"], accessor["max"]) = (json!([-1.0, -1.0, -1.0]), json!([1.0, 1.0, 1.0]));
    }
    document.add("accessors", accessor)
}

fn draco(stream: &str) -> Document {
    const EXTENSION: &str = "KHR_draco_mesh_compression";
    let mut document = Document::new();
    let view = document.view(&unhex(stream));
    let (positions, normals) = (corners(&mut document, "VEC3"), corners(&mut document, "VEC3"));
    let uvs = corners(&mut document, "VEC2");
    let attributes = json!({ "POSITION": positions, "NORMAL": normals, "TEXCOORD_0": uvs });
    octahedron(&mut document, &attributes, U16);
    let numbers = json!({ "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 });
    document.primitive()["extensions"] = json!({ EXTENSION: { "bufferView": view, "attributes": numbers } });
    require(&mut document, EXTENSION);
    document
}

fn meshopt() -> Document {
    const EXTENSION: &str = "EXT_meshopt_compression";
    let mut document = Document::new();
    let positions = corners(&mut document, "VEC3");
    octahedron(&mut document, &json!({ "POSITION": positions }), U16);
    let streams = [(0, MESHOPT_CORNERS, 12, 6, "ATTRIBUTES"), (1, MESHOPT_TRIANGLES, 2, 24, "TRIANGLES")];
    for (accessor, stream, stride, count, mode) in streams {
        let view = document.view(&unhex(stream));
        let packed = document.json["bufferViews"][view].clone();
        document.json["bufferViews"][view] = json!({
            "buffer": 1, "byteLength": stride * count,
            "extensions": { EXTENSION: {
                "buffer": 0, "byteOffset": packed["byteOffset"], "byteLength": packed["byteLength"],
                "byteStride": stride, "count": count, "mode": mode,
            } },
        });
        document.json["accessors"][accessor]["bufferView"] = json!(view);
    }
    let fallback = json!({ "byteLength": 120, "extensions": { EXTENSION: { "fallback": true } } });
    document.json["buffers"] = json!([{ "byteLength": document.buffer().len() }, fallback]);
    require(&mut document, EXTENSION);
    document
}
