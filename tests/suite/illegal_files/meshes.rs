//! Primitives: their attributes, indices and morph targets.

use serde_json::json;

use super::{Case, Opened, Refused, case, skinned, triangle, with};
use crate::document::{Document, F32, U16, U32};

pub fn cases() -> Vec<Case> {
    [layouts(), attributes(), morphs()].into_iter().flatten().collect()
}

fn layouts() -> Vec<Case> {
    let index_bytes: Vec<u8> = [0_u16, 1, 2].iter().flat_map(|index| index.to_le_bytes()).collect();
    vec![
        case(
            "MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS",
            triangle(|document| {
                document.json["accessors"][0].as_object_mut().expect("an object").remove("max");
            }),
            Opened("max"),
        ),
        case("MESH_PRIMITIVE_ACCESSOR_UNALIGNED", unaligned(), Opened("4")),
        case("MESH_PRIMITIVE_ACCESSOR_WITHOUT_BYTESTRIDE", shared_view(), Opened("byteStride")),
        case(
            "MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT",
            triangle(|document| {
                let indices = document.floats("SCALAR", &[0.0, 1.0, 2.0]);
                document.primitive()["indices"] = json!(indices);
            }),
            Refused("indices: holds F32, and unsigned integers are needed"),
        ),
        case(
            "MESH_PRIMITIVE_INDICES_ACCESSOR_WITH_BYTESTRIDE",
            triangle(|document| {
                let spread: Vec<u8> = index_bytes.chunks(2).flat_map(|index| [index[0], index[1], 0, 0]).collect();
                let view = document.view(&spread);
                document.json["bufferViews"][view]["byteStride"] = json!(4);
                let indices = json!({ "bufferView": view, "componentType": U16, "type": "SCALAR", "count": 3 });
                let indices = document.add("accessors", indices);
                document.primitive()["indices"] = json!(indices);
            }),
            Opened("byteStride"),
        ),
    ]
}

/// Texture coordinates of bytes without padding: 2 bytes a vertex, where glTF wants a multiple of 4.
fn unaligned() -> Vec<u8> {
    triangle(|document| {
        let uvs = document.accessor(crate::document::U8, "VEC2", 3, &[0, 255, 51, 102, 255, 0]);
        document.json["accessors"][uvs]["normalized"] = json!(true);
        document.primitive()["attributes"]["TEXCOORD_0"] = json!(uvs);
    })
}

/// Positions and normals of one view, which then needs a stride.
fn shared_view() -> Vec<u8> {
    with(Document::new(), |document| {
        let rows = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0_f32];
        let bytes: Vec<u8> = rows.iter().flat_map(|number| number.to_le_bytes()).collect();
        let view = document.view(&bytes.repeat(2));
        let mut half = |offset: usize| {
            document.add(
                "accessors",
                json!({ "bufferView": view, "byteOffset": offset, "componentType": F32, "type": "VEC3", "count": 3,
                        "min": [0.0, 0.0, 0.0], "max": [1.0, 1.0, 1.0] }),
            )
        };
        let attributes = json!({ "POSITION": half(0), "NORMAL": half(36) });
        let mesh = document.mesh("tri", json!({ "attributes": attributes }));
        document.add("nodes", json!({ "mesh": mesh }));
    })
}

fn attributes() -> Vec<Case> {
    let with_uvs = |uvs: &dyn Fn(&mut Document) -> usize| {
        triangle(|document| {
            let uvs = uvs(document);
            document.primitive()["attributes"]["TEXCOORD_0"] = json!(uvs);
        })
    };
    vec![
        case(
            "MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH",
            skinned(|document| {
                document.primitive()["attributes"].as_object_mut().expect("an object").remove("WEIGHTS_0");
            }),
            Refused("WEIGHTS_0: is missing"),
        ),
        case(
            "MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT",
            with_uvs(&|document| document.floats("VEC2", &[0.0; 4])),
            Refused("TEXCOORD_0"),
        ),
        case(
            "MESH_PRIMITIVE_INVALID_ATTRIBUTE",
            triangle(|document| {
                let shared = document.primitive()["attributes"]["POSITION"].clone();
                document.primitive()["attributes"]["TEMPERATURE"] = shared;
            }),
            Opened("TEMPERATURE"),
        ),
        case(
            "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_UNSIGNED_INT",
            with_uvs(&|document| document.accessor(U32, "VEC2", 3, &[0; 24])),
            Refused("TEXCOORD_0"),
        ),
        case(
            "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT",
            with_uvs(&|document| document.floats("VEC3", &[0.0; 9])),
            Refused("TEXCOORD_0: has 3 components an element, and 2 are needed"),
        ),
        case(
            "MESH_PRIMITIVE_TOO_FEW_TEXCOORDS",
            with(Document::with_triangle().with_texture(&super::scenes::png(), "image/png"), |document| {
                document.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = json!(1);
            }),
            Opened("TEXCOORD_1"),
        ),
    ]
}

fn morphs() -> Vec<Case> {
    let morphed = |change: &dyn Fn(&mut Document, usize)| {
        triangle(|document| {
            let moved = document.floats("VEC3", &[0.0, 0.0, 0.5, 0.0, 0.0, 0.5, 0.0, 0.0, 0.5]);
            document.primitive()["targets"] = json!([{ "POSITION": moved }]);
            document.json["meshes"][0]["weights"] = json!([1.0]);
            change(document, moved);
        })
    };
    let no_base = morphed(&|document, moved| document.primitive()["targets"] = json!([{ "TANGENT": moved }]));
    let wrong_count = morphed(&|document, _| document.json["meshes"][0]["weights"] = json!([0.5, 0.5]));
    vec![
        case("MESH_PRIMITIVE_MORPH_TARGET_NO_BASE_ACCESSOR", no_base, Opened("TANGENT")),
        case("MESH_INVALID_WEIGHTS_COUNT", wrong_count, Opened("weights")),
    ]
}
