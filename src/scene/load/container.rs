//! The container: plain JSON, or GLB with a JSON chunk and at most one binary chunk. What can be
//! read in spite of a defect is read, with a warning.

use super::{error::Defect, file_object::FileObject};
use crate::scene::Warning;

const HEADER_BYTES: usize = 12;
const CHUNK_HEADER_BYTES: usize = 8;
const JSON_CHUNK: u32 = u32::from_le_bytes(*b"JSON");
const BINARY_CHUNK: u32 = u32::from_le_bytes(*b"BIN\0");
const BYTE_ORDER_MARK: &[u8] = &[0xef, 0xbb, 0xbf];

/// The parts of a file.
#[derive(Debug, Default)]
pub(super) struct Container<'a> {
    pub json: &'a [u8],
    /// The binary chunk of a GLB.
    pub binary: Option<&'a [u8]>,
    pub warnings: Vec<Warning>,
}

impl<'a> Container<'a> {
    pub fn read(bytes: &'a [u8]) -> Result<Self, Defect> {
        if bytes.starts_with(b"glTF") {
            return Self::read_glb(bytes);
        }
        let mut container = Self { json: bytes, ..Self::default() };
        if let Some(json) = bytes.strip_prefix(BYTE_ORDER_MARK) {
            container.json = json;
            container.warnings.push(Warning::new("document: it starts with a byte order mark, which is ignored"));
        }
        Ok(container)
    }

    fn read_glb(bytes: &'a [u8]) -> Result<Self, Defect> {
        let word = |at: usize| bytes.get(at..at + 4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
        let (version, length) = (word(4).unwrap_or(0), word(8).unwrap_or(0) as usize);
        if version != 2 {
            return Err(Defect::new("GLB header", format!("has version {version}, and only glTF 2.0 can be read")));
        }
        if length < HEADER_BYTES || length > bytes.len() {
            return Err(Defect::new("GLB header", format!("declares {length} bytes in a file of {}", bytes.len())));
        }
        let mut container = Self::default();
        if length < bytes.len() {
            let rest = bytes.len() - length;
            container
                .warnings
                .push(Warning::new(format!("GLB header: {rest} bytes after the declared end are ignored")));
        }
        let mut rest = &bytes[HEADER_BYTES..length];
        for number in 0.. {
            if rest.is_empty() {
                break;
            }
            let (kind, data, after) = chunk(rest, number)?;
            container.take(number, kind, data)?;
            rest = after;
        }
        if let Some(end) = container.json.iter().rposition(|byte| *byte != 0)
            && end + 1 < container.json.len()
        {
            container.json = &container.json[..=end];
            container.warnings.push(Warning::new("GLB chunk 0: it is padded with zeros instead of blanks"));
        }
        if container.json.iter().all(u8::is_ascii_whitespace) {
            return Err(Defect::new("GLB chunk 0", "is an empty JSON chunk"));
        }
        Ok(container)
    }

    fn take(&mut self, number: usize, kind: u32, data: &'a [u8]) -> Result<(), Defect> {
        let object = FileObject::other(format!("GLB chunk {number}"));
        match (number, kind) {
            (0, JSON_CHUNK) => self.json = data,
            (0, kind) => return Err(Defect::new(object, format!("is of type {kind:#010x}, and JSON must come first"))),
            (_, JSON_CHUNK) => self.warnings.push(object.warning("a second JSON chunk, which is ignored")),
            (_, BINARY_CHUNK) if self.binary.is_some() => {
                self.warnings.push(object.warning("a second binary chunk, which is ignored"));
            }
            (_, BINARY_CHUNK) => {
                if number != 1 {
                    self.warnings.push(object.warning("the binary chunk, which should be chunk 1"));
                }
                self.binary = Some(data);
            }
            (_, kind) => self.warnings.push(object.warning(format!("of unknown type {kind:#010x}, which is ignored"))),
        }
        Ok(())
    }
}

/// Type and bytes of the first chunk, and what follows it.
fn chunk(rest: &[u8], number: usize) -> Result<(u32, &[u8], &[u8]), Defect> {
    let object = || format!("GLB chunk {number}");
    let header: &[u8; CHUNK_HEADER_BYTES] =
        rest.first_chunk().ok_or_else(|| Defect::new(object(), "has a truncated header"))?;
    let [a, b, c, d, kind @ ..] = *header;
    let length = u32::from_le_bytes([a, b, c, d]) as usize;
    let body = &rest[CHUNK_HEADER_BYTES..];
    match body.split_at_checked(length) {
        Some((data, after)) => Ok((u32::from_le_bytes(kind), data, after)),
        None => Err(Defect::new(object(), format!("declares {length} bytes, and {} are there", body.len()))),
    }
}
