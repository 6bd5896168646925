//! The document's own rules: types, required members, references, extensions, buffers and views.

use serde_json::json;

use super::{Case, Harmless, Opened, Refused, case, triangle};
use crate::document::{Document, F32};

pub fn cases() -> Vec<Case> {
    [members(), extensions(), buffers(), views()].into_iter().flatten().collect()
}

fn members() -> Vec<Case> {
    vec![
        case(
            "ARRAY_LENGTH_NOT_IN_LIST",
            triangle(|document| document.json["nodes"][0]["translation"] = json!([1, 2])),
            Refused("node 0 \"n\", translation"),
        ),
        case(
            "ARRAY_TYPE_MISMATCH",
            triangle(|document| document.json["scenes"] = json!([{ "nodes": ["first"] }])),
            Refused("scene 0, nodes[0]"),
        ),
        case("TYPE_MISMATCH", triangle(|document| document.json["scene"] = json!("hello")), Refused("scene")),
        case(
            "UNDEFINED_PROPERTY",
            triangle(|document| {
                document.json["accessors"][0].as_object_mut().expect("an object").remove("count");
            }),
            Refused("accessor 0: cannot be read: missing field `count`"),
        ),
        case(
            "EMPTY_ENTITY",
            triangle(|document| document.json["materials"] = json!([])),
            Opened("materials: it is empty"),
        ),
        case(
            "VALUE_NOT_IN_RANGE",
            triangle(|document| {
                document.json["materials"] = json!([{ "pbrMetallicRoughness": { "metallicFactor": 1.5 } }]);
            }),
            Opened("material 0, pbrMetallicRoughness.metallicFactor: it is 1.5, and must be 0 to 1"),
        ),
        case(
            "PATTERN_MISMATCH",
            triangle(|document| document.json["asset"]["version"] = json!("two")),
            Refused("version \"two\""),
        ),
        case(
            "UNKNOWN_ASSET_MAJOR_VERSION",
            triangle(|document| document.json["asset"]["version"] = json!("1.0")),
            Refused("version \"1.0\", and only 2.0 can be read"),
        ),
        case(
            "ONE_OF_MISMATCH",
            triangle(|document| {
                let perspective = json!({ "yfov": 1.0, "znear": 0.1 });
                let orthographic = json!({ "xmag": 1.0, "ymag": 1.0, "znear": 0.1, "zfar": 9.0 });
                let both = json!({ "type": "perspective", "perspective": perspective, "orthographic": orthographic });
                document.json["cameras"] = json!([both]);
            }),
            Opened("camera 0: it has both perspective and orthographic"),
        ),
        case(
            "UNRESOLVED_REFERENCE",
            triangle(|document| document.json["nodes"][0]["mesh"] = json!(7)),
            Opened("node 0 \"n\", mesh: it leads to number 7 of 1 meshes"),
        ),
        case(
            "UNSATISFIED_DEPENDENCY",
            triangle(|document| {
                document.add("nodes", json!({ "weights": [1.0] }));
            }),
            Opened("node 1: its weights means nothing without a mesh"),
        ),
    ]
}

fn extensions() -> Vec<Case> {
    const UNLIT: &str = "KHR_materials_unlit";
    vec![
        case(
            "UNDECLARED_EXTENSION",
            triangle(|document| document.json["materials"] = json!([{ "extensions": { UNLIT: {} } }])),
            Opened("extensionsUsed: KHR_materials_unlit is missing"),
        ),
        case(
            "UNEXPECTED_EXTENSION_OBJECT",
            triangle(|document| {
                document.json["extensionsUsed"] = json!([UNLIT]);
                document.json["nodes"][0]["extensions"] = json!({ UNLIT: {} });
            }),
            Opened("node 0 \"n\": KHR_materials_unlit does not belong there"),
        ),
        case(
            "UNUSED_EXTENSION_REQUIRED",
            triangle(|document| document.json["extensionsRequired"] = json!([UNLIT])),
            Opened("extensionsRequired: KHR_materials_unlit is missing from extensionsUsed"),
        ),
        case("NON_REQUIRED_EXTENSION", quantized(), Opened("KHR_mesh_quantization")),
    ]
}

/// Positions of bytes, which only an extension allows, and only where it is required.
fn quantized() -> Vec<u8> {
    triangle(|document| {
        let rows = [100, 0, 0, 0, 0, 100, 0, 0, 0, 0, 100, 0];
        let positions = document.accessor(crate::document::U8, "VEC3", 3, &rows);
        let bounds = json!({ "min": [0, 0, 0], "max": [100, 100, 100] });
        for bound in ["min", "max"] {
            document.json["accessors"][positions][bound] = bounds[bound].clone();
        }
        let view = document.json["accessors"][positions]["bufferView"].as_u64().expect("a number") as usize;
        document.json["bufferViews"][view]["byteStride"] = json!(4);
        document.primitive()["attributes"]["POSITION"] = json!(positions);
        document.json["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
    })
}

fn buffers() -> Vec<Case> {
    let with_uri = |uri: &'static str| {
        triangle(|document| document.json["buffers"] = json!([{ "byteLength": document.buffer().len(), "uri": uri }]))
    };
    vec![
        case("IO_ERROR", with_uri("missing.bin"), Refused("missing.bin")),
        case("INVALID_URI", with_uri(":"), Refused("the URI \":\"")),
        case("INVALID_URI", with_uri("data:nothing"), Refused("a data URI without a comma")),
        case("INVALID_URI", with_uri("data:;base64,`"), Refused("a data URI that is not base64")),
        case("BUFFER_BYTE_LENGTH_MISMATCH", with_uri("data:;base64,AAAA"), Refused("ends outside buffer 0 (3 bytes)")),
    ]
}

fn views() -> Vec<Case> {
    let view = |member: &'static str, value: u64| {
        triangle(|document: &mut Document| document.json["bufferViews"][0][member] = json!(value))
    };
    vec![
        case("BUFFER_VIEW_TOO_LONG", view("byteLength", 37), Refused("ends outside buffer 0 (36 bytes)")),
        case("BUFFER_VIEW_INVALID_BYTE_STRIDE", view("byteStride", 13), Refused("elements of 13 bytes")),
        case(
            "BUFFER_VIEW_TOO_BIG_BYTE_STRIDE",
            triangle(|document| {
                let view = document.view(&[0; 12]);
                document.json["bufferViews"][view]["byteStride"] = json!(16);
                document
                    .add("accessors", json!({ "bufferView": view, "componentType": F32, "type": "VEC3", "count": 1 }));
            }),
            Opened("byteStride: it is 16"),
        ),
        case(
            "BUFFER_VIEW_TARGET_OVERRIDE",
            triangle(|document| {
                let indices = document.indices(&[0, 1, 2]);
                let view = document.json["accessors"][indices]["bufferView"].clone();
                document.json["bufferViews"][view.as_u64().expect("a number") as usize]["target"] = json!(34962);
                document.primitive()["indices"] = json!(indices);
            }),
            Harmless("the target of a view is a hint for graphics interfaces; what reads it decides"),
        ),
    ]
}
