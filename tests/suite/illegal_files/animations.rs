//! Channels and samplers.

use serde_json::{Value, json};

use super::{Case, Opened, case, with};
use crate::document::Document;

pub fn cases() -> Vec<Case> {
    [targets(), samplers()].into_iter().flatten().collect()
}

/// The sliding triangle with its clip changed.
fn clip(change: impl FnOnce(&mut Document)) -> Vec<u8> {
    with(Document::with_triangle().with_clip(), change)
}

fn sampler(document: &mut Document) -> &mut Value {
    &mut document.json["animations"][0]["samplers"][0]
}

fn targets() -> Vec<Case> {
    vec![
        case(
            "ANIMATION_DUPLICATE_TARGETS",
            clip(|document| {
                let channels = &mut document.json["animations"][0]["channels"];
                let first = channels[0].clone();
                channels.as_array_mut().expect("a list").push(first);
            }),
            Opened(
                "translation of node 0 \"n\": it animates what another channel of the clip animates; it is left out",
            ),
        ),
        case(
            "ANIMATION_CHANNEL_TARGET_NODE_WEIGHTS_NO_MORPHS",
            clip(|document| {
                let weights = document.floats("SCALAR", &[0.0, 1.0]);
                sampler(document)["output"] = json!(weights);
                document.json["animations"][0]["channels"][0]["target"]["path"] = json!("weights");
            }),
            Opened("animation 0 \"slide\""),
        ),
        case(
            "KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_PATH",
            clip(|document| {
                document.json["extensionsUsed"] = json!(["KHR_animation_pointer"]);
                let pointer = json!({ "KHR_animation_pointer": { "pointer": "/nodes/0/translation" } });
                document.json["animations"][0]["channels"][0]["target"]["extensions"] = pointer;
            }),
            Opened("its path is not \"pointer\""),
        ),
    ]
}

fn samplers() -> Vec<Case> {
    let strided = clip(|document| {
        let mut spread = vec![0_u8; 8];
        spread[4..].copy_from_slice(&1.0_f32.to_le_bytes());
        let view = document.view(&spread);
        document.json["bufferViews"][view]["byteStride"] = json!(4);
        let input = json!({ "bufferView": view, "componentType": 5126, "type": "SCALAR", "count": 2,
                            "min": [0.0], "max": [1.0] });
        let input = document.add("accessors", input);
        sampler(document)["input"] = json!(input);
    });
    let unbounded = clip(|document| {
        let input = sampler(document)["input"].as_u64().expect("a number") as usize;
        document.json["accessors"][input].as_object_mut().expect("an object").remove("max");
    });
    let with_output = |shape: &'static str, numbers: usize| {
        clip(|document| {
            let output = document.floats(shape, &vec![0.0; numbers]);
            sampler(document)["output"] = json!(output);
        })
    };
    let of_bytes = clip(|document| {
        let input = document.accessor(crate::document::U8, "SCALAR", 2, &[0, 1]);
        sampler(document)["input"] = json!(input);
    });
    vec![
        case("ANIMATION_SAMPLER_ACCESSOR_WITH_BYTESTRIDE", strided, Opened("byteStride")),
        case("ANIMATION_SAMPLER_INPUT_ACCESSOR_WITHOUT_BOUNDS", unbounded, Opened("max")),
        case("ANIMATION_SAMPLER_INPUT_ACCESSOR_INVALID_FORMAT", of_bytes, Opened("input")),
        case(
            "ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_FORMAT",
            with_output("VEC4", 8),
            Opened("it has 4 components an element, and 3 are needed; it is left out"),
        ),
        case(
            "ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT",
            with_output("VEC3", 9),
            Opened("it has 9 numbers for 2 keys, which need 6; it is left out"),
        ),
    ]
}
