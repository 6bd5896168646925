//! The parts of a file in our words: meshes, materials, images, cameras, lights.

use glam::{Vec2, Vec3, Vec4};
use octolume::scene::{self, LightKind, Projection};
use serde_json::json;

use crate::document::{Document, I8, U8};

#[test]
fn missing_normals_are_flat_and_unshared() {
    let mut document = Document::new();
    let quad = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let (positions, indices) = (document.floats("VEC3", &quad), document.indices(&[0, 1, 2, 0, 3, 1, 2, 2, 2]));
    let mesh = document.mesh("m", json!({ "attributes": { "POSITION": positions }, "indices": indices }));
    document.add("nodes", json!({ "mesh": mesh }));
    let primitive = &document.open().expect("opens").meshes[0].primitives[0];
    assert_eq!(primitive.triangles, [[0, 1, 2], [3, 4, 5], [6, 7, 8]]);
    assert_eq!(primitive.normals[..6], [Vec3::Z, Vec3::Z, Vec3::Z, Vec3::Y, Vec3::Y, Vec3::Y]);
    assert_eq!(primitive.normals[6..], [Vec3::ZERO; 3], "no area, no direction");
}

#[test]
fn strips_and_fans_become_triangles_of_one_winding() {
    let open = |mode: u32| {
        let mut document = Document::with_triangle();
        let positions: Vec<f32> = (0..5).flat_map(|vertex| [vertex as f32, 0.0, 0.0]).collect();
        let positions = document.floats("VEC3", &positions);
        let primitive = &mut document.json["meshes"][0]["primitives"][0];
        primitive["attributes"] = json!({ "POSITION": positions, "NORMAL": positions });
        primitive["mode"] = json!(mode);
        document.open().expect("opens").meshes[0].primitives.first().map(|primitive| primitive.triangles.clone())
    };
    assert_eq!(open(5), Some(vec![[0, 1, 2], [1, 3, 2], [2, 3, 4]]));
    assert_eq!(open(6), Some(vec![[1, 2, 0], [2, 3, 0], [3, 4, 0]]));
    assert_eq!(open(4), Some(vec![[0, 1, 2]]));
    assert_eq!(open(1), None, "lines have no surface");
}

#[test]
fn points_and_lines_are_counted_in_a_warning() {
    let mut document = Document::with_triangle();
    document.json["meshes"][0]["primitives"][0]["mode"] = json!(0);
    let scene = document.open().expect("opens");
    assert_eq!(scene.warnings, ["1 primitive left out: points and lines have no surface"]);
    assert_eq!(scene.bounds_over_time(), None);
    assert_eq!(scene.objects().len(), 1);
}

#[test]
fn vertices_no_triangle_uses_are_dropped() {
    let mut document = Document::new();
    let positions: Vec<f32> = (0..6).flat_map(|vertex| [vertex as f32, 1.0, 2.0]).collect();
    let (positions, indices) = (document.floats("VEC3", &positions), document.indices(&[5, 1, 3]));
    let attributes = json!({ "POSITION": positions, "NORMAL": positions });
    let mesh = document.mesh("m", json!({ "attributes": attributes, "indices": indices }));
    document.add("nodes", json!({ "mesh": mesh }));
    let primitive = &document.open().expect("opens").meshes[0].primitives[0];
    assert_eq!(primitive.positions.iter().map(|position| position.x).collect::<Vec<_>>(), [1.0, 3.0, 5.0]);
    assert_eq!(primitive.triangles, [[2, 0, 1]]);
}

#[test]
fn attributes_of_every_component_type_are_read() {
    let mut document = Document::with_triangle();
    let uv0 = document.floats("VEC2", &[0.0, 0.25, 0.5, 0.75, 1.0, 2.0]);
    let uv1 = document.accessor(U8, "VEC2", 3, &[0, 255, 51, 102, 255, 0]);
    document.json["accessors"][uv1]["normalized"] = json!(true);
    let color = document.floats("VEC3", &[0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9]);
    let attributes = &mut document.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["TEXCOORD_0"] = json!(uv0);
    attributes["TEXCOORD_1"] = json!(uv1);
    attributes["COLOR_0"] = json!(color);
    let primitive = &document.open().expect("opens").meshes[0].primitives[0];
    assert_eq!(primitive.tex_coords[0][2], Vec2::new(1.0, 2.0));
    assert_eq!(primitive.tex_coords[1][1], Vec2::new(0.2, 0.4));
    assert_eq!(primitive.colors[1], Vec4::new(0.4, 0.5, 0.6, 1.0));
}

#[test]
fn sparse_values_replace_dense_ones() {
    let mut document = Document::with_triangle();
    let (indices, values) = (document.view(&[2]), document.view(&[7.0f32, 8.0, 9.0].map(f32::to_le_bytes).concat()));
    document.json["accessors"][0]["sparse"] = json!({
        "count": 1, "indices": { "bufferView": indices, "componentType": U8 }, "values": { "bufferView": values },
    });
    let positions = |document: &Document| document.open().map(|scene| scene.meshes[0].primitives[0].positions.clone());
    assert_eq!(positions(&document).expect("opens"), [Vec3::X, Vec3::Y, Vec3::new(7.0, 8.0, 9.0)]);
    document.json["accessors"][0].as_object_mut().expect("an object").remove("bufferView");
    assert_eq!(positions(&document).expect("opens"), [Vec3::ZERO, Vec3::ZERO, Vec3::new(7.0, 8.0, 9.0)]);
    document.json["accessors"][0]["count"] = json!(1u64 << 40);
    assert!(document.refusal().contains("needs memory: 12.0 TiB"), "{}", document.refusal());
    document.json["accessors"][0]["count"] = json!(2);
    assert!(document.refusal().contains("sparse index 2, past its end"));
}

pub fn png(color: [u8; 4]) -> String {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let image = image::RgbaImage::from_pixel(2, 2, image::Rgba(color));
    image.write_to(&mut bytes, image::ImageFormat::Png).expect("written");
    format!("data:image/png;base64,{}", base64::encode(bytes.into_inner()))
}

#[test]
fn materials_and_their_images_are_read() {
    let mut document = Document::with_triangle();
    document.add("images", json!({ "uri": png([10, 20, 30, 40]) }));
    document.add("samplers", json!({ "magFilter": 9728, "wrapS": 33071, "wrapT": 33648 }));
    document.add("textures", json!({ "source": 0, "sampler": 0 }));
    document.json["extensionsUsed"] = json!(["KHR_materials_emissive_strength"]);
    document.add(
        "materials",
        json!({
            "pbrMetallicRoughness": { "baseColorTexture": { "index": 0, "texCoord": 1 }, "roughnessFactor": 0.25 },
            "emissiveFactor": [0.5, 1, 0], "alphaMode": "MASK", "alphaCutoff": 0.75, "doubleSided": true,
            "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 8 } },
        }),
    );
    document.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    let scene = document.open().expect("opens");
    let material = &scene.materials[0];
    assert_eq!(material.base_color_texture, Some(scene::TextureRef::new(0, 1)));
    assert_eq!((material.metallic, material.roughness, material.emissive), (1.0, 0.25, [4.0, 8.0, 0.0]));
    assert_eq!(material.alpha_mode, scene::AlphaMode::Mask { cutoff: 0.75 });
    assert_eq!(scene.textures[0].image.get_pixel(1, 1).0, [10, 20, 30, 40]);
    assert_eq!(scene.textures[0].wrap, [scene::Wrap::ClampToEdge, scene::Wrap::MirroredRepeat]);
    assert!(scene.textures[0].nearest);
    assert_eq!(scene.warnings, ["mesh 0 \"tri\", primitive 0: its material reads TEXCOORD_1, which it has not"]);
}

#[test]
fn a_broken_image_costs_its_textures_only() {
    let mut document = Document::with_triangle();
    document.add("images", json!({ "uri": "data:image/png;base64,AAAA" }));
    document.add("images", json!({ "uri": png([1, 2, 3, 4]) }));
    document.add("textures", json!({ "source": 0 }));
    document.add("textures", json!({ "source": 1 }));
    document.add(
        "materials",
        json!({
            "pbrMetallicRoughness": { "baseColorTexture": { "index": 1 } },
            "emissiveFactor": [1, 1, 1], "emissiveTexture": { "index": 0 },
        }),
    );
    let scene = document.open().expect("opens");
    assert_eq!(scene.textures.len(), 1);
    assert_eq!(scene.materials[0].base_color_texture, Some(scene::TextureRef::new(0, 0)));
    assert_eq!(scene.materials[0].emissive, [0.0; 3], "an emission whose mask is lost lights nothing");
    assert!(scene.warnings[0].sentence.starts_with("image 0 cannot be decoded"), "{:?}", scene.warnings);
}

#[test]
fn cameras_and_lights_are_read() {
    let mut document = Document::with_triangle();
    document.add(
        "cameras",
        json!({ "type": "orthographic", "orthographic": { "xmag": 0, "ymag": 0, "znear": 0, "zfar": 1 } }),
    );
    document.add("cameras", json!({ "type": "perspective", "perspective": { "yfov": 0.5, "znear": 0.1 } }));
    document.json["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    document.json["extensions"] = json!({ "KHR_lights_punctual": { "lights": [
        { "type": "directional", "intensity": 3, "color": [1, 0.5, 0.25] },
        { "type": "spot", "spot": { "outerConeAngle": 0.5 }, "range": 7 },
    ] } });
    document.json["nodes"][0]["camera"] = json!(0);
    document.add("nodes", json!({ "camera": 1, "extensions": { "KHR_lights_punctual": { "light": 1 } } }));
    let scene = document.open().expect("opens");
    assert_eq!((scene.nodes[0].camera, scene.nodes[1].camera, scene.nodes[1].light), (None, Some(0), Some(1)));
    let fov_y_radians = f64::from(0.5f32);
    assert_eq!(
        scene.cameras[0].projection,
        Projection::Perspective { fov_y_radians, aspect: None, near: f64::from(0.1f32), far: None }
    );
    let spot = LightKind::Spot { range: Some(7.0), inner_cone_radians: 0.0, outer_cone_radians: 0.5 };
    assert_eq!((scene.lights[0].kind, scene.lights[1].kind), (LightKind::Directional, spot));
    let warned = "camera 0: its projection makes no sense; it is left out";
    assert!(scene.warnings.iter().any(|warning| warning.sentence == *warned), "{:?}", scene.warnings);
    document.json["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = json!(2);
    assert_eq!(document.open().expect("opens").nodes[1].light, None);
}

#[test]
fn static_morph_weights_are_baked() {
    let mut document = Document::with_triangle();
    let up = document.floats("VEC3", &[0.0, 0.0, 2.0, 0.0, 0.0, 2.0, 0.0, 0.0, 4.0]);
    document.json["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": up }]);
    document.json["meshes"][0]["weights"] = json!([0.5]);
    document.add("nodes", json!({ "name": "flat", "mesh": 0, "weights": [0.0] }));
    document.add("nodes", json!({ "name": "same", "mesh": 0, "weights": [0.5] }));
    let scene = document.open().expect("opens");
    assert_eq!(scene.nodes.iter().map(|node| node.mesh).collect::<Vec<_>>(), [Some(0), Some(1), Some(0)]);
    let positions = |mesh: usize| scene.meshes[mesh].primitives[0].positions.clone();
    assert_eq!(positions(0), [Vec3::X + Vec3::Z, Vec3::Y + Vec3::Z, Vec3::Z * 3.0]);
    assert_eq!(positions(1), [Vec3::X, Vec3::Y, Vec3::Z]);
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
}

/// KHR_mesh_quantization: integers as they are, or as fractions, in elements padded to four bytes.
#[test]
fn quantized_meshes_are_read() {
    let mut document = Document::with_triangle();
    let positions = document.accessor(U8, "VEC3", 3, &[5, 0, 0, 0, 0, 7, 0, 0, 0, 0, 9]);
    let normals = document.accessor(I8, "VEC3", 3, &[127, 0, 0, 0, 0, 129, 0, 0, 0, 0, 127]);
    for accessor in [positions, normals] {
        let view = document.json["accessors"][accessor]["bufferView"].as_u64().expect("a view") as usize;
        document.json["bufferViews"][view]["byteStride"] = json!(4);
    }
    document.json["accessors"][positions]["max"] = json!([5, 7, 9]);
    document.json["accessors"][normals]["normalized"] = json!(true);
    for bound in ["min", "max"] {
        document.json["accessors"][normals].as_object_mut().expect("an object").remove(bound);
    }
    document.json["meshes"][0]["primitives"][0]["attributes"] = json!({ "POSITION": positions, "NORMAL": normals });
    document.json["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
    document.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    let scene = document.open().expect("opens");
    let primitive = &scene.meshes[0].primitives[0];
    assert_eq!(primitive.positions, [Vec3::X * 5.0, Vec3::Y * 7.0, Vec3::Z * 9.0]);
    assert_eq!(primitive.normals, [Vec3::X, Vec3::NEG_Y, Vec3::Z]);
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
}
