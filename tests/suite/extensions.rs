//! What each extension of glTF adds to a scene. Compressed streams are written here.

use draco_gltf::{
    ComponentType, CompressionOptions, DracoPrimitiveEncoding, PackedAttribute, PackedGeometry, PackedIndices,
    PrimitiveMode,
};
use glam::{DVec3, Vec2, Vec3};
use octolume::scene::{LocalTransform, Property, Scene};
use serde_json::{Value, json};

use crate::document::{Document, F32};

fn opened(document: &Document) -> Scene {
    document.open().expect("opens")
}

/// A triangle whose material has these members.
fn with_material(extension: &str, material: Value) -> Document {
    let mut document = Document::with_triangle();
    document.json["extensionsUsed"] = json!([extension]);
    document.json["extensionsRequired"] = json!([extension]);
    document.add("materials", material);
    document.primitive()["material"] = json!(0);
    document
}

fn use_extension(document: &mut Document, extension: &str) {
    document.json["extensionsUsed"] = json!([extension]);
    document.json["extensionsRequired"] = json!([extension]);
}

#[test]
fn draco_streams_are_decoded() {
    let corners = [[0.0f32, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0], [0.0, 4.0, 0.0]];
    let bytes = corners.iter().flatten().flat_map(|lane| lane.to_le_bytes()).collect();
    let positions = PackedAttribute::new("POSITION", 4, 3, ComponentType::F32, false, bytes).expect("an attribute");
    let indices = PackedIndices::new(6, ComponentType::U8, vec![0, 1, 2, 0, 2, 3]).expect("indices");
    let geometry = PackedGeometry::new(PrimitiveMode::Triangles, vec![positions], Some(indices)).expect("a square");
    let encoded = DracoPrimitiveEncoding::encode(&geometry, &CompressionOptions::default()).expect("encodes");
    let mut document = Document::new();
    let view = document.view(encoded.bytes());
    let extension: Value = serde_json::from_slice(&encoded.extension(view).to_json().to_vec()).expect("JSON");
    let count = encoded.accessors()[0].count();
    let positions = document.add(
        "accessors",
        json!({ "componentType": F32, "type": "VEC3", "count": count, "min": [0, 0, 0], "max": [4, 4, 0] }),
    );
    let indices =
        document.add("accessors", json!({ "componentType": 5125, "type": "SCALAR", "count": encoded.index_count() }));
    document.mesh(
        "square",
        json!({
            "attributes": { "POSITION": positions }, "indices": indices,
            "extensions": { "KHR_draco_mesh_compression": extension },
        }),
    );
    document.add("nodes", json!({ "mesh": 0 }));
    use_extension(&mut document, "KHR_draco_mesh_compression");
    let scene = opened(&document);
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    let primitive = &scene.meshes[0].primitives[0];
    let area: f32 = primitive
        .triangles
        .iter()
        .map(|corner| {
            let [a, b, c] = corner.map(|vertex| primitive.positions[vertex as usize]);
            (b - a).cross(c - a).length() / 2.0
        })
        .sum();
    // 11 bits a coordinate: half a step of 4 / 2047 at each end of each edge.
    assert!((area - 16.0).abs() < 4.0 * 4.0 * 4.0 / 2047.0, "{area}");

    let length = document.json["bufferViews"][view]["byteLength"].as_u64().expect("a length");
    document.json["bufferViews"][view]["byteLength"] = json!(length / 2);
    let refusal = document.refusal();
    assert!(refusal.contains("mesh 0 \"square\", primitive 0, KHR_draco_mesh_compression"), "{refusal}");
}

/// The vertex codec of meshoptimizer, version 0, for at most 16 vertices: every byte of a vertex is
/// a group of literal differences to the vertex before, and the first vertex follows at the end.
fn meshopt_vertices(rows: &[Vec<u8>]) -> Vec<u8> {
    const LITERAL_GROUP: u8 = 3;
    let stride = rows[0].len();
    let mut bytes = vec![0xa0];
    for lane in 0..stride {
        bytes.push(LITERAL_GROUP);
        let difference = |row: usize| rows[row][lane].wrapping_sub(rows[row.saturating_sub(1)][lane]);
        let zigzag = |value: u8| value << 1 ^ if value & 0x80 != 0 { 0xff } else { 0 };
        bytes.extend((0..16).map(|row| if row < rows.len() { zigzag(difference(row)) } else { 0 }));
    }
    bytes.resize(bytes.len() + 32_usize.saturating_sub(stride), 0);
    bytes.extend(&rows[0]);
    bytes
}

#[test]
fn meshopt_views_are_decompressed() {
    for extension in ["EXT_meshopt_compression", "KHR_meshopt_compression"] {
        let mut document = Document::with_triangle();
        let corners = [Vec3::new(1.0, 2.0, 3.0), Vec3::new(-4.0, 5.0, 0.25), Vec3::new(0.0, -7.5, 9.0)];
        let rows: Vec<Vec<u8>> =
            corners.iter().map(|corner| corner.to_array().map(f32::to_le_bytes).concat()).collect();
        let packed = document.view(&meshopt_vertices(&rows));
        let packed = document.json["bufferViews"][packed].clone();
        document.json["bufferViews"][0] = json!({
            "buffer": 1, "byteLength": 36, "byteStride": 12,
            "extensions": { extension: {
                "buffer": 0, "byteOffset": packed["byteOffset"], "byteLength": packed["byteLength"],
                "byteStride": 12, "count": 3, "mode": "ATTRIBUTES",
            } },
        });
        document.json["buffers"] =
            json!([null, { "byteLength": 36, "extensions": { extension: { "fallback": true } } }]);
        document.json["accessors"][0]["min"] = json!([-4, -7.5, 0.25]);
        document.json["accessors"][0]["max"] = json!([1, 5, 9]);
        use_extension(&mut document, extension);
        let scene = opened(&document);
        assert_eq!(scene.meshes[0].primitives[0].positions, corners);
        assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
        document.json["bufferViews"][0]["extensions"][extension]["count"] = json!(u64::MAX / 12);
        let refusal = document.refusal();
        assert!(refusal.contains("cannot be decompressed: needs memory"), "{refusal}");
    }
}

#[test]
fn webp_images_take_the_place_of_plain_ones() {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::RgbaImage::from_pixel(2, 1, image::Rgba([7, 8, 9, 255]))
        .write_to(&mut bytes, image::ImageFormat::WebP)
        .expect("written");
    let mut document = Document::with_triangle().with_texture(&bytes.into_inner(), "image/webp");
    document.json["textures"] = json!([{ "extensions": { "EXT_texture_webp": { "source": 0 } } }]);
    use_extension(&mut document, "EXT_texture_webp");
    let scene = opened(&document);
    assert_eq!(scene.textures[0].image.get_pixel(1, 0).0, [7, 8, 9, 255]);
    document.json["textures"][0] = json!({ "source": 0, "extensions": { "EXT_texture_webp": { "source": 5 } } });
    let scene = opened(&document);
    assert_eq!(scene.textures.len(), 1, "the plain image stands in");
    assert!(scene.warnings[0].sentence.contains("leads to number 5 of 1 images"), "{:?}", scene.warnings);
}

#[test]
fn hostile_ktx2_headers_are_refused_before_memory_is_taken() {
    let mut header = b"\xabKTX 20\xbb\r\n\x1a\n".to_vec();
    header.resize(200, 0);
    let mut with = |at: usize, value: u32| header[at..at + 4].copy_from_slice(&value.to_le_bytes());
    with(20, 1 << 31);
    with(24, 1 << 31);
    let warning = |bytes: &[u8]| {
        let document = Document::with_triangle().with_texture(bytes, "image/ktx2");
        opened(&document)
            .warnings
            .into_iter()
            .find(|warning| warning.sentence.starts_with("image 0"))
            .expect("a warning")
    };
    assert!(warning(&header).sentence.contains("has 2147483648 x 2147483648 texels"), "{}", warning(&header));
    let mut with = |at: usize, value: u32| header[at..at + 4].copy_from_slice(&value.to_le_bytes());
    with(20, 16);
    with(24, 16);
    with(80 + 20, 7);
    assert!(
        warning(&header).sentence.contains("unpacks to 30064771072 bytes for 16 x 16 texels"),
        "{}",
        warning(&header)
    );
    assert!(warning(&header[..30]).sentence.contains("is a truncated KTX2 file"));
}

#[test]
fn texture_transforms_scale_turn_and_move() {
    let mut document = with_material(
        "KHR_texture_transform",
        json!({
            "pbrMetallicRoughness": { "baseColorTexture": { "index": 0, "extensions": { "KHR_texture_transform": {
                "offset": [0.25, 0.5], "rotation": std::f64::consts::FRAC_PI_2, "scale": [2, 4], "texCoord": 1,
            } } } },
        }),
    )
    .with_texture(&png(), "image/png");
    document.json["materials"].as_array_mut().expect("a list").truncate(1);
    document.primitive()["material"] = json!(0);
    let slot = opened(&document).materials[0].base_color_texture.expect("a texture");
    assert_eq!(slot.tex_coord, 1);
    // Against the clock as seen with v downwards: u goes to −v, v to u.
    let close = |uv: Vec2, expected: Vec2| assert!((uv - expected).length() < 1e-6, "{uv}");
    close(slot.uv(Vec2::ZERO), Vec2::new(0.25, 0.5));
    close(slot.uv(Vec2::X), Vec2::new(0.25, 0.5 - 2.0));
    close(slot.uv(Vec2::Y), Vec2::new(0.25 + 4.0, 0.5));
}

fn png() -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::RgbaImage::new(1, 1).write_to(&mut bytes, image::ImageFormat::Png).expect("written");
    bytes.into_inner()
}

#[test]
fn unlit_and_specular_glossiness_become_materials() {
    let scene = opened(&with_material("KHR_materials_unlit", json!({ "extensions": { "KHR_materials_unlit": {} } })));
    assert!(scene.materials[0].unlit);
    let gold = json!({ "extensions": { "KHR_materials_pbrSpecularGlossiness": {
        "diffuseFactor": [0, 0, 0, 1], "specularFactor": [1.0, 0.75, 0.25], "glossinessFactor": 0.75,
    } } });
    let material = &opened(&with_material("KHR_materials_pbrSpecularGlossiness", gold)).materials[0];
    assert!((material.metallic - 1.0).abs() < 1e-3 && (material.roughness - 0.25).abs() < 1e-6, "{material:?}");
    assert!((Vec3::from_slice(&material.base_color) - Vec3::new(1.0, 0.75, 0.25)).length() < 1e-2, "{material:?}");
}

#[test]
fn what_a_material_cannot_show_is_noted() {
    for (extension, members, note) in [
        ("KHR_materials_transmission", json!({ "transmissionFactor": 1 }), "shown as opaque"),
        ("KHR_materials_volume", json!({ "thicknessFactor": 1 }), "shown as opaque"),
        ("KHR_materials_clearcoat", json!({ "clearcoatFactor": 1 }), "shown without its coat"),
        ("KHR_materials_sheen", json!({}), "shown without its sheen"),
        ("KHR_materials_iridescence", json!({}), "shown without its film"),
        ("KHR_materials_anisotropy", json!({}), "shown as isotropic"),
        ("KHR_materials_specular", json!({}), "shown with its full reflection at normal incidence"),
        ("KHR_materials_ior", json!({ "ior": 1.4 }), "shown with an index of refraction of 1.5"),
    ] {
        let scene = opened(&with_material(extension, json!({ "extensions": { extension: members } })));
        assert_eq!(scene.warnings, [format!("{extension}: 1 object, {note}")]);
    }
}

#[test]
fn instances_become_nodes() {
    let mut document = Document::with_triangle();
    let places = document.floats("VEC3", &[1.0, 0.0, 0.0, 0.0, 5.0, 0.0]);
    let scales = document.floats("VEC3", &[1.0, 1.0, 1.0, 2.0, 2.0, 2.0]);
    document.json["nodes"][0]["extensions"] =
        json!({ "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": places, "SCALE": scales } } });
    document.json["nodes"][0]["translation"] = json!([10, 0, 0]);
    use_extension(&mut document, "EXT_mesh_gpu_instancing");
    let scene = opened(&document);
    assert_eq!(scene.objects().len(), 2);
    assert_eq!(scene.nodes[2].name, "n #1");
    let pose = scene.pose(None, 0.0);
    assert_eq!(pose.world_from_node[1].w_axis.truncate(), DVec3::new(11.0, 0.0, 0.0));
    assert_eq!(pose.world_from_node[2].transform_point3(DVec3::X), DVec3::new(12.0, 5.0, 0.0));
}

#[test]
fn pointers_to_transforms_are_channels() {
    let mut document = Document::with_triangle().with_clip();
    document.json["animations"][0]["channels"][0]["target"] = json!({
        "path": "pointer", "extensions": { "KHR_animation_pointer": { "pointer": "/nodes/0/scale" } },
    });
    use_extension(&mut document, "KHR_animation_pointer");
    let scene = opened(&document);
    assert_eq!((scene.clips[0].channels[0].node, scene.clips[0].channels[0].property), (0, Property::Scale));
    assert!(matches!(scene.nodes[0].local, LocalTransform::Trs(_)));
}

#[test]
fn variants_show_the_base_look() {
    let mut document = with_material("KHR_materials_variants", json!({ "name": "base" }));
    document.add("materials", json!({ "name": "other" }));
    document.json["extensions"] = json!({ "KHR_materials_variants": { "variants": [{ "name": "night" }] } });
    document.primitive()["extensions"] =
        json!({ "KHR_materials_variants": { "mappings": [{ "material": 1, "variants": [0] }] } });
    let scene = opened(&document);
    assert_eq!(scene.meshes[0].primitives[0].material, Some(0));
    assert_eq!(scene.warnings, ["KHR_materials_variants: 2 objects, the base look is shown"]);
}
