//! What does not decide the geometry is repaired when a file is opened, with one warning that counts.

use std::fs;

use glam::{DQuat, Vec2, Vec3, Vec4};
use octolume::progress::Progress;
use octolume::scene::load::open;
use octolume::scene::{LightKind, LocalTransform, Scene, Warning};
use serde_json::json;

use crate::document::Document;

/// The only warning.
fn only_warning(scene: &Scene) -> &str {
    assert_eq!(scene.warnings.len(), 1, "{:?}", scene.warnings);
    &scene.warnings[0].sentence
}

fn with_attribute(name: &str, shape: &str, numbers: &[f32]) -> Scene {
    let mut document = Document::with_triangle();
    let accessor = document.floats(shape, numbers);
    document.primitive()["attributes"][name] = json!(accessor);
    document.open().expect("opens")
}

#[test]
fn normals_that_are_none_are_those_of_the_triangles() {
    let [x, y, z] = [Vec3::X, Vec3::Y, Vec3::Z];
    let face = (y - x).cross(z - x).normalize();
    for bad in [[f32::NAN, 0.0, 1.0], [0.0; 3]] {
        let numbers = [[1.0, 0.0, 0.0], bad, [0.0, 0.0, 2.0]].concat();
        let scene = with_attribute("NORMAL", "VEC3", &numbers);
        let expected = "mesh 0 \"tri\", primitive 0, NORMAL: not unit vectors at 2 vertices; they are normalised, or those \
                        of the triangles around";
        assert_eq!(only_warning(&scene), expected);
        let normals = &scene.meshes[0].primitives[0].normals;
        assert_eq!((normals[0], normals[2]), (Vec3::X, Vec3::Z));
        assert!((normals[1].abs() - face.abs()).length() < 1e-6, "{normals:?}");
    }
}

#[test]
fn coordinates_colours_and_weights_that_are_not_finite_are_replaced() {
    let scene = with_attribute("TEXCOORD_0", "VEC2", &[0.5, 0.5, f32::NAN, 0.0, 1.0, 1.0]);
    assert!(only_warning(&scene).ends_with("TEXCOORD_0: not finite at 1 vertex; [0.0, 0.0] stands in"));
    assert_eq!(scene.meshes[0].primitives[0].tex_coords[0][1], Vec2::ZERO);
    let scene = with_attribute("COLOR_0", "VEC3", &[0.5, 0.5, 0.5, f32::NAN, 0.0, 0.0, 1.0, 1.0, 1.0]);
    assert!(only_warning(&scene).ends_with("COLOR_0: not finite at 1 vertex; [1.0, 1.0, 1.0] stands in"));
    assert_eq!(scene.meshes[0].primitives[0].colors[1], Vec4::ONE);
    let scene = Document::with_skin(2, &[([1, 0, 0, 0], [f32::NAN, 0.5, 0.0, 0.0])]).open().expect("opens");
    let counted = |warning: &Warning| warning.sentence.contains("WEIGHTS_0: not finite at 3 vertices");
    assert!(scene.warnings.iter().any(counted), "{:?}", scene.warnings);
}

#[test]
fn a_rotation_that_is_none_turns_nothing() {
    let mut document = Document::with_triangle();
    document.json["nodes"][0]["rotation"] = json!([0, 0, 0, 0]);
    let scene = document.open().expect("opens");
    assert_eq!(only_warning(&scene), "node 0 \"n\": its rotation is zero or not finite; it is not turned");
    assert_eq!(scene.warnings[0].nodes, [0]);
    let LocalTransform::Trs(trs) = scene.nodes[0].local else { panic!("parts") };
    assert_eq!(trs.rotation, DQuat::IDENTITY);
    document.json["nodes"][0]["rotation"] = json!([0, 0, 0, 2]);
    let scene = document.open().expect("opens");
    assert!(only_warning(&scene).contains("no unit quaternion (length 2.000)"));
}

#[test]
fn cones_that_make_no_sense_are_narrowed_and_light() {
    let opened = |spot: serde_json::Value| {
        let mut document = Document::with_triangle();
        document.json["extensionsUsed"] = json!(["KHR_lights_punctual"]);
        document.json["extensions"] =
            json!({ "KHR_lights_punctual": { "lights": [{ "type": "spot", "spot": spot }] } });
        document.open().expect("opens")
    };
    let kind = |inner_cone_radians, outer_cone_radians| LightKind::Spot {
        range: None,
        inner_cone_radians,
        outer_cone_radians,
    };
    let equal = opened(json!({ "innerConeAngle": 0.5, "outerConeAngle": 0.5 }));
    assert_eq!((equal.lights[0].kind, equal.warnings.len()), (kind(0.5, 0.5), 0), "a hard edge is a cone");
    for (spot, expected) in [
        (json!({ "innerConeAngle": 0.9 }), kind(std::f32::consts::FRAC_PI_4, std::f32::consts::FRAC_PI_4)),
        (json!({ "innerConeAngle": 0.1, "outerConeAngle": 3.0 }), kind(0.1, std::f32::consts::FRAC_PI_2)),
    ] {
        let scene = opened(spot);
        assert_eq!(scene.lights[0].kind, expected);
        assert!(
            scene.warnings.iter().any(|warning| warning.sentence.contains("must grow from 0")),
            "{:?}",
            scene.warnings
        );
    }
}

#[test]
fn a_buffer_that_is_shorter_than_it_says_is_read_as_far_as_it_goes() {
    let document = Document::with_triangle();
    let (mut json, binary) = document.parts();
    json["buffers"][0]["byteLength"] = json!(4000);
    let glb = crate::document::glb(&[
        (crate::document::JSON_CHUNK, json.to_string().as_bytes()),
        (crate::document::BINARY_CHUNK, binary),
    ]);
    let scene = octolume::scene::load::open_bytes("short.glb", &glb, None, &Progress::default()).expect("opens");
    let sentence = only_warning(&scene);
    assert!(
        sentence.starts_with("buffer 0: it holds ") && sentence.ends_with(" bytes and declares 4000"),
        "{sentence}"
    );
}

#[test]
fn json_may_be_padded_with_zeros() {
    let mut glb = Document::with_triangle().glb();
    let length = u32::from_le_bytes([glb[12], glb[13], glb[14], glb[15]]) as usize;
    glb.splice(20 + length..20 + length, [0; 4]);
    let total = glb.len() as u32;
    glb[8..12].copy_from_slice(&total.to_le_bytes());
    glb[12..16].copy_from_slice(&(length as u32 + 4).to_le_bytes());
    let scene = octolume::scene::load::open_bytes("padded.glb", &glb, None, &Progress::default()).expect("opens");
    assert_eq!(only_warning(&scene), "GLB chunk 0: it is padded with zeros instead of blanks");
}

#[test]
fn textures_are_found_in_any_case_and_behind_backslashes() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::create_dir(folder.path().join("Textures")).expect("written");
    image::RgbaImage::from_pixel(1, 1, image::Rgba([9, 8, 7, 255]))
        .save(folder.path().join("Textures/Wood.PNG"))
        .expect("written");
    let mut document = Document::with_triangle();
    document.add("images", json!({ "uri": "textures\\wood.png" }));
    document.add("textures", json!({ "source": 0 }));
    document.add("materials", json!({ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }));
    let path = folder.path().join("scene.gltf");
    fs::write(&path, document.bytes()).expect("written");
    let scene = open(&path, &Progress::default()).expect("opens");
    assert_eq!(scene.textures[0].image.get_pixel(0, 0).0, [9, 8, 7, 255]);
    assert_eq!(only_warning(&scene), "image 0: it is named \"textures\\\\wood.png\", and \"Wood.PNG\" is read");
}

#[test]
fn a_normal_texture_that_is_told_its_coordinates_twice_reads_those_of_its_transform() {
    let mut document = Document::with_triangle();
    document.add("images", json!({ "uri": crate::parts::png([128, 128, 255, 255]) }));
    document.add("textures", json!({ "source": 0 }));
    let coordinates = document.floats("VEC2", &[0.0; 6]);
    document.primitive()["attributes"]["TEXCOORD_1"] = json!(coordinates);
    let transform = json!({ "KHR_texture_transform": { "texCoord": 1 } });
    document.add("materials", json!({ "normalTexture": { "index": 0, "texCoord": 0, "extensions": transform } }));
    document.primitive()["material"] = json!(0);
    document.json["extensionsUsed"] = json!(["KHR_texture_transform"]);
    assert_eq!(document.open().expect("opens").warnings, [""; 0]);
}
