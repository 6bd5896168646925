//! GLB containers, and the text in them.

use super::{Case, Opened, Refused, case};
use crate::document::{BINARY_CHUNK, Document, JSON_CHUNK, glb};

const EMPTY_DOCUMENT: &[u8] = br#"{"asset":{"version":"2.0"}}"#;
const UNKNOWN_CHUNK: u32 = u32::from_le_bytes(*b"WHAT");

/// A triangle as GLB with some of its bytes changed.
fn triangle_glb(change: impl FnOnce(&mut Vec<u8>)) -> Vec<u8> {
    let mut bytes = Document::with_triangle().glb();
    change(&mut bytes);
    bytes
}

fn set_length(bytes: &mut [u8], length: usize) {
    bytes[8..12].copy_from_slice(&(length as u32).to_le_bytes());
}

pub fn cases() -> Vec<Case> {
    vec![
        case("GLB_CHUNK_TOO_BIG", triangle_glb(|bytes| bytes[15] = 0x7f), Refused("GLB chunk 0: declares")),
        case(
            "GLB_DUPLICATE_CHUNK",
            glb(&[(JSON_CHUNK, EMPTY_DOCUMENT), (BINARY_CHUNK, &[1; 4]), (BINARY_CHUNK, &[2; 4])]),
            Opened("GLB chunk 2: a second binary chunk"),
        ),
        case(
            "GLB_DUPLICATE_CHUNK",
            glb(&[(JSON_CHUNK, EMPTY_DOCUMENT), (JSON_CHUNK, EMPTY_DOCUMENT)]),
            Opened("GLB chunk 1: a second JSON chunk"),
        ),
        case("GLB_EMPTY_CHUNK", glb(&[(JSON_CHUNK, b"")]), Refused("GLB chunk 0: is an empty JSON chunk")),
        case("GLB_INVALID_MAGIC", triangle_glb(|bytes| bytes[0] = b'X'), Refused("document: is not JSON")),
        case(
            "GLB_LENGTH_MISMATCH",
            triangle_glb(|bytes| bytes.extend([0; 8])),
            Opened("GLB header: 8 bytes after the declared end"),
        ),
        case(
            "GLB_LENGTH_TOO_SMALL",
            triangle_glb(|bytes| set_length(bytes, 11)),
            Refused("GLB header: declares 11 bytes"),
        ),
        case(
            "GLB_UNEXPECTED_BIN_CHUNK",
            glb(&[(JSON_CHUNK, EMPTY_DOCUMENT), (UNKNOWN_CHUNK, b""), (BINARY_CHUNK, &[1; 4])]),
            Opened("GLB chunk 2: the binary chunk, which should be chunk 1"),
        ),
        case(
            "GLB_UNEXPECTED_END_OF_CHUNK_DATA",
            triangle_glb(|bytes| bytes.truncate(bytes.len() - 1)),
            Refused("GLB header: declares"),
        ),
        case(
            "GLB_UNEXPECTED_FIRST_CHUNK",
            glb(&[(BINARY_CHUNK, &[1; 4]), (JSON_CHUNK, EMPTY_DOCUMENT)]),
            Refused("GLB chunk 0: is of type 0x004e4942, and JSON must come first"),
        ),
        case("INVALID_JSON", b"{\"asset\":".to_vec(), Refused("document: is not JSON")),
    ]
}
