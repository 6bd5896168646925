//! Opening files: real scenes where they are at hand, small documents written here.

use std::path::{Path, PathBuf};

use glam::{DVec3, Vec2, Vec3, Vec4};
use octolume::{
    progress::Progress,
    scene::{self, LightKind, Projection, Scene, load::LoadError},
};
use serde_json::json;

use crate::document::{Document, U8};

/// The folder of real scenes, where there is one; tests pass without it.
pub fn shared_gltf() -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    ["../shared/gltf", "../../shared/gltf"].map(|path| root.join(path)).into_iter().find(|path| path.is_dir())
}

fn open(path: &Path) -> Result<Scene, LoadError> {
    scene::load::open(path, &Progress::default())
}

/// Triangles drawn (instances counted), objects, skins, distinct joints, clips.
fn counts(scene: &Scene) -> [usize; 5] {
    let objects = scene.objects();
    let triangles = objects.iter().map(|object| scene.meshes[object.mesh].triangle_count()).sum();
    let mut joints: Vec<usize> = scene.skins.iter().flat_map(|skin| skin.joints.iter().copied()).collect();
    joints.sort_unstable();
    joints.dedup();
    [triangles, objects.len(), scene.skins.len(), joints.len(), scene.clips.len()]
}

#[test]
fn real_scenes_hold_what_their_list_says() {
    let Some(folder) = shared_gltf() else { return };
    let expected = [
        ("Fox/Fox.glb", [576, 1, 1, 24, 3]),
        ("CesiumMan/CesiumMan.glb", [4_672, 1, 1, 19, 1]),
        ("KayKit-Knight/Knight.glb", [6_952, 15, 1, 41, 76]),
        ("RobotExpressive/robot.glb", [3_238, 14, 1, 43, 14]),
        ("Mannequiny/mannequiny.glb", [13_832, 1, 1, 45, 10]),
        ("RecursiveSkeletons/RecursiveSkeletons.glb", [6_384, 84, 84, 840, 1]),
        ("Sponza/Sponza_objects.gltf", [262_267, 398, 0, 0, 0]),
        ("InterpolationTest/InterpolationTest.glb", [110, 10, 0, 0, 9]),
        ("MeshPrimitiveModes/MeshPrimitiveModes.gltf", [16, 7, 0, 0, 0]),
        ("Box With Spaces/Box With Spaces.gltf", [12, 1, 0, 0, 0]),
        ("Unicode❤♻Test/Unicode❤♻Test.gltf", [2, 1, 0, 0, 0]),
        ("BoxTextured/BoxTextured.gltf", [12, 1, 0, 0, 0]),
        ("BoxInterleaved/BoxInterleaved.gltf", [12, 1, 0, 0, 0]),
        ("SimpleSparseAccessor/SimpleSparseAccessor.gltf", [12, 1, 0, 0, 0]),
    ];
    for (path, expected) in expected {
        let scene = open(&folder.join(path)).expect(path);
        assert_eq!(counts(&scene), expected, "{path}");
    }
}

/// Every file opens, or is refused with a sentence that names it.
#[test]
fn no_file_panics() {
    let Some(folder) = shared_gltf() else { return };
    let mut folders = vec![folder];
    let mut opened = 0;
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            let extension = path.extension().unwrap_or_default().to_string_lossy().into_owned();
            if path.is_dir() {
                folders.push(path);
            } else if extension == "gltf" || extension == "glb" {
                match open(&path) {
                    Ok(scene) => opened += usize::from(scene.bounds_over_time().is_some()),
                    Err(error) => assert!(error.to_string().starts_with(&path.display().to_string()), "{error}"),
                }
            }
        }
    }
    assert!(opened > 40, "{opened} files with something in them");
}

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
    assert_eq!(scene.warnings, ["1 primitives are points or lines, which have no surface; left out"]);
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
fn bad_numbers_are_refused_by_name() {
    let mut document = Document::new();
    let positions = document.floats("VEC3", &[0.0, 0.0, 0.0, 1.0, f32::NAN, 0.0, 0.0, 0.0, 1.0]);
    document.mesh("broken", json!({ "attributes": { "POSITION": positions } }));
    let refusal = document.refusal();
    assert!(
        refusal.starts_with("test.gltf: mesh 0 \"broken\", primitive 0, POSITION: is not finite at vertex 1"),
        "{refusal}"
    );

    let mut document = Document::with_triangle();
    let indices = document.indices(&[0, 1, 3]);
    document.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
    let refusal = document.refusal();
    assert!(refusal.ends_with("mesh 0 \"tri\", primitive 0, indices: index 2 names vertex 3 of 3"), "{refusal}");

    let mut document = Document::with_triangle();
    document.json["nodes"][0]["translation"] = json!([1e300, 0, 0]);
    assert_eq!(document.refusal(), "test.gltf: node 0 \"n\": has a transform that is not finite");
}

#[test]
fn structure_that_does_not_hold_is_refused() {
    let refusal = |change: &dyn Fn(&mut Document)| {
        let mut document = Document::with_triangle();
        change(&mut document);
        document.refusal()
    };
    let says = |text: &str, change: &dyn Fn(&mut Document)| {
        let refusal = refusal(change);
        assert!(refusal.starts_with("test.gltf: ") && refusal.contains(text), "{refusal}");
    };
    says("reads past the end of its buffer view", &|document| document.json["accessors"][0]["count"] = json!(4));
    says("reads past the end", &|document| document.json["accessors"][0]["count"] = json!(u64::MAX / 12));
    says("ends outside buffer 0", &|document| document.json["bufferViews"][0]["byteOffset"] = json!(u64::MAX));
    says("stride of 4", &|document| document.json["bufferViews"][0]["byteStride"] = json!(4));
    says("names accessor 9", &|document| {
        document.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = json!(9)
    });
    says("KHR_draco_mesh_compression cannot be read", &|document| {
        document.json["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
        document.json["extensionsUsed"] = json!(["KHR_draco_mesh_compression"]);
    });
    says("version \"1.0\"", &|document| document.json["asset"]["version"] = json!("1.0"));
    says("is its own ancestor", &|document| {
        document.add("nodes", json!({ "children": [2] }));
        document.add("nodes", json!({ "children": [1] }));
    });
    says("is a child of node 1 and of node 2", &|document| {
        document.add("nodes", json!({ "children": [0] }));
        document.add("nodes", json!({ "children": [0] }));
    });
    says("rotation that is zero", &|document| document.json["nodes"][0]["rotation"] = json!([0, 0, 0, 0]));
}

#[test]
fn binary_headers_are_checked() {
    let refusal = |bytes: &[u8]| {
        scene::load::open_bytes("a.glb", bytes, None, &Progress::default()).expect_err("refused").to_string()
    };
    assert_eq!(refusal(b"glTF\x02\0\0\0\0\0\0\0"), "a.glb: GLB header: declares 0 bytes in a file of 12");
    assert_eq!(refusal(b"glTF"), "a.glb: GLB header: has version 0, and only glTF 2.0 can be read");
    assert!(refusal(b"glTF\x02\0\0\0\xff\xff\xff\xff").contains("declares 4294967295 bytes"));
    assert!(refusal(b"").starts_with("a.glb: document: is not glTF: "));
    let missing = scene::load::open(Path::new("no/such.glb"), &Progress::default()).expect_err("refused").to_string();
    assert!(missing.starts_with("no/such.glb: cannot be read: "), "{missing}");
}

#[test]
fn parents_come_before_children() {
    let mut document = Document::with_triangle();
    document.json["nodes"][0]["translation"] = json!([1, 0, 0]);
    document.add("nodes", json!({ "name": "middle", "children": [0], "translation": [10, 0, 0] }));
    document.add("nodes", json!({ "name": "root", "children": [1], "translation": [100, 0, 0] }));
    let scene = document.open().expect("opens");
    let names: Vec<&str> = scene.nodes.iter().map(|node| node.name.as_str()).collect();
    assert_eq!(names, ["root", "middle", "n"]);
    assert_eq!(scene.pose(None, 0.0).world_from_node[2].w_axis.truncate(), DVec3::new(111.0, 0.0, 0.0));
}

#[test]
fn only_the_default_scene_is_drawn() {
    let mut document = Document::with_triangle();
    document.add("nodes", json!({ "name": "other", "mesh": 0 }));
    document.json["scenes"] = json!([{ "nodes": [0] }, { "nodes": [1] }]);
    document.json["scene"] = json!(1);
    let scene = document.open().expect("opens");
    assert_eq!(scene.objects().iter().map(|object| object.node).collect::<Vec<_>>(), [1]);
    assert_eq!(scene.warnings, ["1 nodes with a mesh belong to no drawn scene; they are left out"]);
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
    assert!(document.refusal().contains("without a buffer view"));
    document.json["accessors"][0]["count"] = json!(2);
    assert!(document.refusal().contains("sparse index 2, past its end"));
}

#[test]
fn files_beside_the_document_are_found() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut document = Document::with_triangle();
    std::fs::write(folder.path().join("a b ♻.bin"), document.buffer()).expect("written");
    document.json["buffers"] = json!([{ "byteLength": document.buffer().len(), "uri": "a%20b%20%E2%99%BB.bin" }]);
    let path = folder.path().join("scene.gltf");
    std::fs::write(&path, document.bytes()).expect("written");
    let scene = open(&path).expect("opens");
    assert_eq!((scene.name.as_str(), scene.meshes[0].triangle_count()), ("scene", 1));
    assert!(document.refusal().contains("opened from memory"));
    std::fs::remove_file(folder.path().join("a b ♻.bin")).expect("removed");
    let refusal = open(&path).expect_err("refused").to_string();
    assert!(refusal.contains("buffer 0 (a b ♻.bin) cannot be read"), "{refusal}");
}

fn png(color: [u8; 4]) -> String {
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
    assert_eq!(material.base_color_texture, Some(scene::TextureRef { texture: 0, tex_coord: 1 }));
    assert_eq!((material.metallic, material.roughness, material.emissive), (1.0, 0.25, [4.0, 8.0, 0.0]));
    assert_eq!(material.alpha_mode, scene::AlphaMode::Mask { cutoff: 0.75 });
    assert_eq!(scene.textures[0].image.get_pixel(1, 1).0, [10, 20, 30, 40]);
    assert_eq!(scene.textures[0].wrap, [scene::Wrap::ClampToEdge, scene::Wrap::MirroredRepeat]);
    assert!(scene.textures[0].nearest && scene.warnings.is_empty());
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
    assert_eq!(scene.materials[0].base_color_texture, Some(scene::TextureRef { texture: 0, tex_coord: 0 }));
    assert_eq!(scene.materials[0].emissive, [0.0; 3], "an emission whose mask is lost lights nothing");
    assert!(scene.warnings[0].starts_with("image 0 cannot be decoded"), "{:?}", scene.warnings);
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
        Projection::Perspective { fov_y_radians, near: f64::from(0.1f32), far: None }
    );
    let spot = LightKind::Spot { range: Some(7.0), inner_cone_radians: 0.0, outer_cone_radians: 0.5 };
    assert_eq!((scene.lights[0].kind, scene.lights[1].kind), (LightKind::Directional, spot));
    assert_eq!(scene.warnings, ["camera 0: its projection makes no sense; it is left out"]);
    document.json["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = json!(2);
    document.refusal();
}

#[test]
fn morph_targets_and_unread_extensions_are_named() {
    let mut document = Document::with_triangle();
    document.json["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": 0 }]);
    document.json["extensionsUsed"] = json!(["KHR_texture_transform"]);
    let (times, weights) = (document.floats("SCALAR", &[0.0]), document.floats("SCALAR", &[1.0]));
    document.add(
        "animations",
        json!({
            "name": "a", "samplers": [{ "input": times, "output": weights }],
            "channels": [{ "sampler": 0, "target": { "node": 0, "path": "weights" } }],
        }),
    );
    assert_eq!(
        document.open().expect("opens").warnings,
        [
            "extensions that are not read: KHR_texture_transform",
            "mesh 0 \"tri\": morph targets are not applied; its base shape is shown",
            "animation 0 \"a\": 1 channels animate morph targets; they are left out",
        ]
    );
}

#[test]
fn opening_can_be_cancelled() {
    let progress = Progress::default();
    progress.cancel();
    let result = scene::load::open_bytes("test.gltf", &Document::with_triangle().bytes(), None, &progress);
    assert_eq!(result.expect_err("cancelled").to_string(), "test.gltf: opening was cancelled");
    let progress = Progress::default();
    scene::load::open_bytes("test.gltf", &Document::with_triangle().bytes(), None, &progress).expect("opens");
    assert_eq!(progress.fraction(), 1.0);
}
