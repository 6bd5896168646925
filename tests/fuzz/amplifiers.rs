//! Files that ask for far more than they hold: counts without data, one list read a thousand times,
//! pictures of a size nobody has, trees as deep as the file is long. None may take more memory or
//! time than any other file.

use serde_json::{Value, json};

use crate::document::{BINARY_CHUNK, Document, F32, JSON_CHUNK, U8, U16, glb};
use crate::oracle::{self, Turn};

/// Many of one thing.
const CROWD: usize = 100_000;

fn check(turn: &Turn, what: &str, document: &Document) {
    println!("{what}");
    oracle::check(turn, &document.glb());
}

/// An accessor of zeros that no buffer backs.
fn zeros(document: &mut Document, component: u32, shape: &str, count: u64) -> usize {
    document.add("accessors", json!({ "componentType": component, "type": shape, "count": count }))
}

fn crowd(of: impl Fn(usize) -> Value) -> Value {
    (0..CROWD).map(of).collect()
}

#[test]
fn counts_without_data() {
    let turn = oracle::turn();
    for count in [100_000, 10_000_000, u64::from(u32::MAX), u64::MAX] {
        let mut document = Document::with_triangle();
        let positions = zeros(&mut document, F32, "VEC3", count);
        document.primitive()["attributes"]["POSITION"] = json!(positions);
        check(&turn, "positions", &document);
        let indices = zeros(&mut document, U16, "SCALAR", count);
        document.primitive()["indices"] = json!(indices);
        check(&turn, "indices", &document);

        let mut document = Document::with_triangle();
        let places = zeros(&mut document, F32, "VEC3", count);
        document.json["extensionsUsed"] = json!(["EXT_mesh_gpu_instancing"]);
        document.json["nodes"][0]["extensions"] =
            json!({ "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": places } } });
        check(&turn, "instances", &document);

        let mut document = Document::with_triangle().with_clip();
        let values = zeros(&mut document, F32, "VEC3", count);
        document.json["animations"][0]["samplers"][0]["output"] = json!(values);
        check(&turn, "values", &document);

        let mut document = Document::with_skin(1, &[([0; 4], [1.0, 0.0, 0.0, 0.0])]);
        let matrices = zeros(&mut document, F32, "MAT4", count);
        document.json["skins"][0]["inverseBindMatrices"] = json!(matrices);
        check(&turn, "matrices", &document);
    }
}

#[test]
fn one_list_read_many_times() {
    let turn = oracle::turn();
    let numbers = 1 << 17;
    let mut document = Document::new();
    let positions = document.floats("VEC3", &vec![0.5; 3 * numbers]);
    let primitive = json!({ "attributes": { "POSITION": positions } });
    document.add("meshes", json!({ "primitives": vec![primitive; 1000] }));
    document.add("nodes", json!({ "mesh": 0 }));
    check(&turn, "primitives", &document);
    let morphed =
        json!({ "attributes": { "POSITION": positions }, "targets": vec![json!({ "POSITION": positions }); 1000] });
    document.json["meshes"] = json!([{ "primitives": [morphed] }]);
    check(&turn, "morph targets", &document);
    document.json["meshes"] = json!([{ "primitives": [{ "attributes": { "POSITION": positions } }] }]);
    let copies = vec![document.json["accessors"][0].clone(); 20_000];
    document.json["accessors"].as_array_mut().expect("a list").extend(copies);
    check(&turn, "accessors", &document);

    let mut document = Document::with_triangle().with_clip();
    let times: Vec<f32> = (0..numbers).map(|key| key as f32).collect();
    let (input, output) = (document.floats("SCALAR", &times), document.floats("VEC3", &vec![0.0; 3 * numbers]));
    document.json["nodes"] = vec![json!({}); 1000].into();
    let channel = |node: usize| json!({ "sampler": 0, "target": { "node": node, "path": "scale" } });
    let sampler = json!({ "input": input, "output": output });
    document.json["animations"] =
        json!([{ "samplers": [sampler], "channels": (0..1000).map(channel).collect::<Value>() }]);
    check(&turn, "channels", &document);
}

#[test]
fn crowds() {
    let turn = oracle::turn();
    let mut document = Document::with_triangle();
    document.json["nodes"] = crowd(|_| json!({}));
    check(&turn, "nodes", &document);
    document.json["nodes"] = crowd(|_| json!({ "mesh": 0 }));
    check(&turn, "nodes of one mesh", &document);
    document.json["nodes"] = crowd(|_| json!({ "children": [] }));
    check(&turn, "empty lists", &document);
    document.json["nodes"] =
        crowd(|node| json!({ "children": if node + 1 < CROWD { json!([node + 1]) } else { json!(null) } }));
    check(&turn, "nodes in nodes", &document);
    document.json["nodes"] = json!([{ "children": (0..CROWD).collect::<Value>() }]);
    check(&turn, "children that are not there", &document);

    let mut document = Document::with_triangle().with_clip();
    document.json["nodes"] = crowd(|_| json!({}));
    document.json["animations"][0]["channels"] =
        crowd(|node| json!({ "sampler": 0, "target": { "node": node, "path": "scale" } }));
    check(&turn, "channels", &document);
    document.json["animations"][0]["channels"] =
        crowd(|_| json!({ "sampler": 0, "target": { "node": 0, "path": "scale" } }));
    check(&turn, "channels of one node", &document);

    let mut document = Document::with_skin(1, &[([0; 4], [1.0, 0.0, 0.0, 0.0])]);
    document.json["skins"][0]["joints"] = crowd(|_| json!(1));
    check(&turn, "joints", &document);
    document.json["skins"] = json!(vec![json!({ "joints": vec![1; 1000] }); 100]);
    check(&turn, "skins", &document);
    document.json["scenes"] = json!([{ "nodes": crowd(|_| json!(0)) }]);
    check(&turn, "roots", &document);
    document.json["materials"] = crowd(|_| json!({}));
    check(&turn, "materials", &document);
    document.json["extensionsUsed"] = crowd(|number| json!(format!("X{number}")));
    check(&turn, "extensions", &document);
}

#[test]
fn texts() {
    let turn = oracle::turn();
    let json = |text: String| oracle::check(&turn, &glb(&[(JSON_CHUNK, text.as_bytes())]));
    let document = |member: &str| json(format!(r#"{{"asset":{{"version":"2.0"}},{member}}}"#));
    for (open, close) in [("[", "]"), (r#"{"a":"#, "}")] {
        for depth in [100, 127, 1000, CROWD] {
            document(&format!(r#""extras":{}1{}"#, open.repeat(depth), close.repeat(depth)));
        }
    }
    for item in ["0,", "{},", r#"{"":0},"#, "[],", r#""","#, "null,", "1e999,"] {
        let items = item.repeat(CROWD);
        let items = items.trim_end_matches(',');
        for list in ["nodes", "accessors", "materials", "extras", "buffers", "bufferViews", "images", "meshes"] {
            println!("{list} of {item}");
            document(&format!(r#""{list}":[{items}]"#));
        }
    }
    document(&format!(r#""nodes":[{{"name":"{}"}}]"#, "n".repeat(1 << 20)));
    document(&format!(r#""buffers":[{{"byteLength":1,"uri":"data:;base64,{}"}}]"#, "A".repeat(1 << 20)));
    document(&format!(r#""buffers":[{{"byteLength":1,"uri":"{}"}}]"#, "../".repeat(1 << 16)));
}

/// A PNG, a WebP and a KTX2 that claim sizes far beyond what is in them.
#[test]
fn pictures() {
    let turn = oracle::turn();
    let mut png = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR".to_vec();
    png.extend([0, 0, 0xff, 0xff, 0, 0, 0xff, 0xff, 8, 6, 0, 0, 0]);
    let crc = crc32(&png[12..]);
    png.extend(crc.to_be_bytes());
    png.extend(b"\0\0\0\x0aIDAT\x78\x9c\x03\0\0\0\0\x01\0\0\0\0");
    check(&turn, "PNG", &Document::with_triangle().with_texture(&png, "image/png"));

    let mut webp = b"RIFF\x20\0\0\0WEBPVP8L\x10\0\0\0\x2f\xff\xff\xff\x0f".to_vec();
    webp.extend([0; 12]);
    check(&turn, "WebP", &Document::with_triangle().with_texture(&webp, "image/webp"));

    let mut ktx = b"\xabKTX 20\xbb\r\n\x1a\n".to_vec();
    ktx.extend([0, 1, 0x4000, 0x4000, 0, 0, 1, 1, 0, 104, 0, 0, 0].into_iter().flat_map(u32::to_le_bytes));
    ktx.extend([0; 16]);
    ktx.extend([104_u64, 16, 1 << 40].into_iter().flat_map(u64::to_le_bytes));
    ktx.extend([0; 64]);
    let mut document = Document::with_triangle().with_texture(&ktx, "image/ktx2");
    document.json["textures"] = json!([{ "extensions": { "KHR_texture_basisu": { "source": 0 } } }]);
    document.json["extensionsUsed"] = json!(["KHR_texture_basisu"]);
    check(&turn, "KTX2", &document);
}

/// One picture of 4 MB that a thousand materials would each convert into others.
#[test]
fn one_picture_in_many_materials() {
    let turn = oracle::turn();
    let mut png = std::io::Cursor::new(Vec::new());
    let picture = image::RgbaImage::from_pixel(1024, 1024, image::Rgba([200, 100, 50, 128]));
    picture.write_to(&mut png, image::ImageFormat::Png).expect("written to memory");
    let mut document = Document::with_triangle().with_texture(png.get_ref(), "image/png");
    let slot = json!({ "index": 0 });
    let look = |number: usize| {
        let glossiness = number as f64 / 1000.0;
        json!({ "diffuseTexture": slot, "specularGlossinessTexture": slot, "glossinessFactor": glossiness })
    };
    let materials =
        (0..1000).map(|number| json!({ "extensions": { "KHR_materials_pbrSpecularGlossiness": look(number) } }));
    document.json["materials"] = materials.collect();
    document.json["extensionsUsed"] = json!(["KHR_materials_pbrSpecularGlossiness"]);
    check(&turn, "specular and glossiness", &document);
    document.json["textures"] = vec![json!({ "source": 0 }); 1000].into();
    check(&turn, "textures", &document);
}

/// As PNG has it.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 })
    })
}

/// Streams of a few bytes that are to become millions.
#[test]
fn compressed_streams() {
    let turn = oracle::turn();
    for count in [0_u64, 3, 1_000_000, u64::from(u32::MAX), u64::MAX / 12] {
        for mode in ["ATTRIBUTES", "TRIANGLES", "INDICES"] {
            let mut document = Document::with_triangle();
            let stream = json!({ "buffer": 0, "byteLength": 36, "byteStride": 12, "count": count, "mode": mode });
            document.json["bufferViews"][0]["extensions"] = json!({ "EXT_meshopt_compression": stream });
            document.json["extensionsUsed"] = json!(["EXT_meshopt_compression"]);
            check(&turn, "meshopt", &document);
        }
        for mut document in crate::seeds::all() {
            let accessors = document.json["accessors"].as_array_mut().expect("a list");
            accessors.iter_mut().for_each(|accessor| accessor["count"] = json!(count));
            check(&turn, "counts of a seed", &document);
        }
    }
    let sparse = json!({ "count": u32::MAX, "indices": { "bufferView": 0, "componentType": U8 }, "values": { "bufferView": 0 } });
    let mut document = Document::with_triangle();
    document.json["accessors"][0]["sparse"] = sparse;
    check(&turn, "sparse", &document);
    oracle::check(&turn, &glb(&[(JSON_CHUNK, b"{}"), (BINARY_CHUNK, &[])]));
}
