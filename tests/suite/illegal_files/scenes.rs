//! Nodes, skins, cameras, lights and images.

use std::io::Cursor;

use image::{ImageFormat, RgbaImage};
use serde_json::json;

use super::{Case, Opened, Refused, case, skinned, triangle};
use crate::document::Document;

pub fn cases() -> Vec<Case> {
    [nodes(), skins(), sights(), images()].into_iter().flatten().collect()
}

fn nodes() -> Vec<Case> {
    vec![
        case(
            "SCENE_NON_ROOT_NODE",
            triangle(|document| {
                document.add("nodes", json!({ "children": [0] }));
                document.json["scenes"] = json!([{ "nodes": [0] }]);
            }),
            Opened("root"),
        ),
        case(
            "NODE_SKIN_NO_SCENE",
            skinned(|document| {
                document.json["scenes"] = json!([{ "nodes": [0] }]);
                document.json["scene"] = json!(0);
            }),
            Opened("scene"),
        ),
        case(
            "NODE_PARENT_OVERRIDE",
            triangle(|document| {
                document.add("nodes", json!({ "children": [0] }));
                document.add("nodes", json!({ "children": [0] }));
            }),
            Refused("is a child of node 1 and of node 2"),
        ),
        case(
            "NODE_MATRIX_TRS",
            triangle(|document| {
                document.json["nodes"][0]["matrix"] = json!(glam::Mat4::IDENTITY.to_cols_array());
                document.json["nodes"][0]["scale"] = json!([2, 2, 2]);
            }),
            Opened("node 0 \"n\": it has both matrix and scale"),
        ),
        case(
            "NODE_LOOP",
            triangle(|document| {
                document.add("nodes", json!({ "children": [2] }));
                document.add("nodes", json!({ "children": [1] }));
            }),
            Refused("is its own ancestor"),
        ),
    ]
}

fn skins() -> Vec<Case> {
    vec![
        case(
            "SKIN_NO_COMMON_ROOT",
            skinned(|document| {
                document.json["nodes"][3].as_object_mut().expect("an object").remove("children");
            }),
            Opened("root"),
        ),
        case(
            "SKIN_IBM_INVALID_FORMAT",
            skinned(|document| {
                let wrong = document.floats("VEC4", &[0.0; 8]);
                document.json["skins"][0]["inverseBindMatrices"] = json!(wrong);
            }),
            Refused("skin 0: accessor"),
        ),
        case(
            "INVALID_IBM_ACCESSOR_COUNT",
            skinned(|document| {
                let one = document.floats("MAT4", &glam::Mat4::IDENTITY.to_cols_array());
                document.json["skins"][0]["inverseBindMatrices"] = json!(one);
            }),
            Refused("skin 0: has 1 inverse bind matrices for 2 joints"),
        ),
    ]
}

fn sights() -> Vec<Case> {
    vec![
        case(
            "CAMERA_XMAG_YMAG_ZERO",
            triangle(|document| {
                let orthographic = json!({ "xmag": 0.0, "ymag": 1.0, "znear": 0.1, "zfar": 9.0 });
                document.json["cameras"] = json!([{ "type": "orthographic", "orthographic": orthographic }]);
            }),
            Opened("camera 0"),
        ),
        case(
            "KHR_LIGHTS_PUNCTUAL_LIGHT_SPOT_ANGLES",
            triangle(|document| {
                let spot = json!({ "innerConeAngle": 0.5, "outerConeAngle": 0.25 });
                document.json["extensionsUsed"] = json!(["KHR_lights_punctual"]);
                document.json["extensions"] =
                    json!({ "KHR_lights_punctual": { "lights": [{ "type": "spot", "spot": spot }] } });
            }),
            Opened("light 0"),
        ),
    ]
}

/// A picture of 2 x 2 pixels.
pub fn png() -> Vec<u8> {
    let mut file = Cursor::new(Vec::new());
    let image = RgbaImage::from_fn(2, 2, |x, y| image::Rgba([255 * x as u8, 255 * y as u8, 0, 255]));
    image.write_to(&mut file, ImageFormat::Png).expect("written to memory");
    file.into_inner()
}

fn images() -> Vec<Case> {
    let textured = |image: &[u8]| Document::with_triangle().with_texture(image, "image/png").bytes();
    let (whole, mut broken) = (png(), png());
    broken[16..20].copy_from_slice(&[0xff; 4]);
    vec![
        case("IMAGE_DATA_INVALID", textured(&broken), Opened("image 0")),
        case("IMAGE_UNEXPECTED_EOS", textured(&whole[..whole.len() / 2]), Opened("image 0")),
    ]
}
