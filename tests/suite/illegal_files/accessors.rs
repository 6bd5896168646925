//! Where accessors lie, and the numbers in them.

use serde_json::json;

use super::{Case, Harmless, Opened, Refused, case, skinned, triangle, with};
use crate::document::{Document, F32};

pub fn cases() -> Vec<Case> {
    [places(), bounds(), numbers(), joints(), keys()].into_iter().flatten().collect()
}

fn places() -> Vec<Case> {
    let accessor =
        |member: &'static str, value: u64| triangle(|document| document.json["accessors"][0][member] = json!(value));
    vec![
        case("ACCESSOR_TOO_LONG", accessor("count", 4), Refused("accessor 0 reads past the end of its buffer view")),
        case(
            "ACCESSOR_SMALL_BYTESTRIDE",
            triangle(|document| document.json["bufferViews"][0]["byteStride"] = json!(8)),
            Refused("accessor 0 has a stride of 8 bytes for elements of 12"),
        ),
        case("ACCESSOR_OFFSET_ALIGNMENT", shifted(1, 0), Opened("accessor 0")),
        case("ACCESSOR_TOTAL_OFFSET_ALIGNMENT", shifted(0, 1), Opened("accessor 0")),
        case("ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE", sparse(4), Refused("sparse")),
        case(
            "ACCESSOR_NORMALIZED_INVALID",
            triangle(|document| document.json["accessors"][0]["normalized"] = json!(true)),
            Opened("normalized"),
        ),
        case(
            "ACCESSOR_USAGE_OVERRIDE",
            triangle(|document| {
                let shared = document.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"].clone();
                let channel = json!({ "sampler": 0, "target": { "node": 0, "path": "translation" } });
                let input = document.floats("SCALAR", &[0.0, 1.0, 2.0]);
                let sampler = json!({ "input": input, "output": shared });
                document.add("animations", json!({ "samplers": [sampler], "channels": [channel] }));
            }),
            Harmless("two readers of the same numbers do not disturb each other"),
        ),
    ]
}

/// Positions whose accessor and view start that many bytes off.
fn shifted(accessor_bytes: usize, view_bytes: usize) -> Vec<u8> {
    let mut document = Document::new();
    let mut bytes = vec![0; accessor_bytes + view_bytes];
    let rows = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0_f32];
    bytes.extend(rows.iter().flat_map(|number| number.to_le_bytes()));
    let view = document.view(&bytes);
    document.json["bufferViews"][view]["byteOffset"] = json!(view_bytes);
    document.json["bufferViews"][view]["byteLength"] = json!(bytes.len() - view_bytes);
    let positions = document.add(
        "accessors",
        json!({ "bufferView": view, "byteOffset": accessor_bytes, "componentType": F32, "type": "VEC3", "count": 3,
                "min": [0.0, 0.0, 0.0], "max": [1.0, 1.0, 1.0] }),
    );
    let mesh = document.mesh("tri", json!({ "attributes": { "POSITION": positions } }));
    document.add("nodes", json!({ "mesh": mesh }));
    document.bytes()
}

/// Replaces as many of the three positions as asked for by themselves.
fn sparse(count: usize) -> Vec<u8> {
    triangle(|document| {
        let indices: Vec<u8> = (0..count).flat_map(|index| (index as u16).to_le_bytes()).collect();
        let indices = document.view(&indices);
        let values = document.view(&vec![0; 12 * count]);
        document.json["accessors"][0]["sparse"] = json!({
            "count": count,
            "indices": { "bufferView": indices, "componentType": 5123 },
            "values": { "bufferView": values },
        });
    })
}

fn bounds() -> Vec<Case> {
    let bound = |member: &'static str, value: f64| {
        triangle(|document| document.json["accessors"][0][member] = json!([value, value, value]))
    };
    vec![
        case("ACCESSOR_MIN_MISMATCH", bound("min", -0.5), Opened("min")),
        case("ACCESSOR_MAX_MISMATCH", bound("max", 1.5), Opened("max")),
        case("ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND", bound("min", 0.5), Opened("min")),
        case("ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND", bound("max", 0.5), Opened("max")),
    ]
}

fn numbers() -> Vec<Case> {
    let indexed = |indices: &'static [u16]| {
        triangle(|document| {
            let indices = document.indices(indices);
            document.primitive()["indices"] = json!(indices);
        })
    };
    let not_finite = triangle(|document| {
        let positions = document.floats("VEC3", &[1.0, 0.0, 0.0, 0.0, f32::INFINITY, 0.0, 0.0, 0.0, 1.0]);
        document.primitive()["attributes"]["POSITION"] = json!(positions);
    });
    vec![
        case("ACCESSOR_INVALID_FLOAT", not_finite, Refused("POSITION: is not finite at vertex 1")),
        case("ACCESSOR_INDEX_OOB", indexed(&[0, 1, 3]), Refused("indices: index 2 names vertex 3 of 3")),
        case("ACCESSOR_INDEX_PRIMITIVE_RESTART", indexed(&[0, 1, 2, 65535, 0, 1]), Refused("names vertex 65535 of 3")),
    ]
}

fn joints() -> Vec<Case> {
    let bound = |joints: [u16; 4], weights: [f32; 4]| Document::with_skin(2, &[(joints, weights)]).bytes();
    vec![
        case(
            "ACCESSOR_JOINTS_INDEX_OOB",
            bound([0, 5, 0, 0], [0.5, 0.5, 0.0, 0.0]),
            Refused("joint 5 is out of range"),
        ),
        case("ACCESSOR_JOINTS_INDEX_DUPLICATE", bound([1, 1, 0, 0], [0.5, 0.5, 0.0, 0.0]), Opened("joint")),
        case("ACCESSOR_WEIGHTS_NEGATIVE", bound([0, 1, 0, 0], [1.5, -0.5, 0.0, 0.0]), Opened("negative joint weights")),
        case("ACCESSOR_WEIGHTS_NON_NORMALIZED", bound([0, 1, 0, 0], [0.5, 0.25, 0.0, 0.0]), Opened("weight")),
        case(
            "ACCESSOR_INVALID_IBM",
            skinned(|document| {
                let mut matrix = glam::Mat4::IDENTITY.to_cols_array();
                matrix[3] = 0.5;
                let inverse_bind = document.floats("MAT4", &matrix.repeat(2));
                document.json["skins"][0]["inverseBindMatrices"] = json!(inverse_bind);
            }),
            Opened("the fourth row of its matrix is not (0, 0, 0, 1)"),
        ),
    ]
}

fn keys() -> Vec<Case> {
    let clip = |path: &'static str, times: &[f32], shape: &str, values: &[f32]| {
        with(Document::with_triangle(), |document| {
            let (input, output) = (document.floats("SCALAR", times), document.floats(shape, values));
            let channel = json!({ "sampler": 0, "target": { "node": 0, "path": path } });
            document.add(
                "animations",
                json!({ "samplers": [{ "input": input, "output": output }], "channels": [channel] }),
            );
        })
    };
    vec![
        case(
            "ACCESSOR_ANIMATION_INPUT_NON_INCREASING",
            clip("translation", &[1.0, 1.0], "VEC3", &[0.0; 6]),
            Opened("1 key at the time of the one before"),
        ),
        case(
            "ACCESSOR_ANIMATION_SAMPLER_OUTPUT_NON_NORMALIZED_QUATERNION",
            clip("rotation", &[0.0, 1.0], "VEC4", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.5]),
            Opened("unit"),
        ),
    ]
}
