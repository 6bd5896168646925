//! One image: PNG, JPEG, WebP, or KTX2 with a Basis Universal payload (KHR_texture_basisu). The
//! content decides which: declared types are wrong in files that everything else opens.

use std::io::Cursor;

use basisu::{DecodeFlags, TargetFormat, Transcoder};
use image::{ImageReader, Limits, RgbaImage};

use super::budget::Budget;

/// Texels along an edge; GPUs and renderers end here too.
const MAX_EDGE_TEXELS: u32 = 16_384;
const RGBA_BYTES: u64 = 4;
/// Samples of 16 bits, before they are brought to 8.
const WIDEST_TEXEL_BYTES: u64 = 8;

/// Size first, then memory, then texels. Errors are causes.
pub(super) fn decode(bytes: &[u8], budget: &Budget) -> Result<RgbaImage, String> {
    if bytes.starts_with(&ktx2::IDENTIFIER) {
        return ktx2::decode(bytes, budget);
    }
    let undecodable = |error: image::ImageError| format!("cannot be decoded: {error}");
    let reader = || ImageReader::new(Cursor::new(bytes)).with_guessed_format().map_err(|error| error.to_string());
    let (width, height) = reader()?.into_dimensions().map_err(undecodable)?;
    let texels = check_size(width, height)?;
    budget.spend(texels * RGBA_BYTES)?;
    let mut reader = reader()?;
    let mut limits = Limits::default();
    limits.max_alloc = Some((texels * WIDEST_TEXEL_BYTES).max(Limits::default().max_alloc.unwrap_or_default()));
    reader.limits(limits);
    Ok(reader.decode().map_err(undecodable)?.into_rgba8())
}

/// The number of texels.
fn check_size(width: u32, height: u32) -> Result<u64, String> {
    match width.max(height) <= MAX_EDGE_TEXELS && width.min(height) > 0 {
        true => Ok(u64::from(width) * u64::from(height)),
        false => Err(format!("has {width} x {height} texels, and 1 to {MAX_EDGE_TEXELS} along an edge can be read")),
    }
}

/// A header is checked before the transcoder sees it, for it allocates by what the header says.
mod ktx2 {
    use super::*;

    pub const IDENTIFIER: [u8; 12] = *b"\xabKTX 20\xbb\r\n\x1a\n";
    const LEVEL_INDEX_START: usize = 80;
    /// A block of UASTC or ETC1S covers 4 x 4 texels in at most this many bytes.
    const BLOCK_BYTES: u64 = 16;

    pub fn decode(bytes: &[u8], budget: &Budget) -> Result<RgbaImage, String> {
        let word = |at: usize| bytes.get(at..at + 4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
        let field = |at: usize| word(at).ok_or_else(|| "is a truncated KTX2 file".to_owned());
        let (width, height) = (field(20)?, field(24)?);
        let texels = check_size(width, height)?;
        let (layers, faces) = (field(32)?, field(36)?);
        if layers > 1 || faces > 1 {
            return Err(format!("is a KTX2 file of {layers} layers and {faces} faces, and one image is needed"));
        }
        let blocks = u64::from(width.div_ceil(4)) * u64::from(height.div_ceil(4));
        let unpacked = u64::from(field(LEVEL_INDEX_START + 16)?) | u64::from(field(LEVEL_INDEX_START + 20)?) << 32;
        if unpacked > blocks * BLOCK_BYTES {
            return Err(format!("is a KTX2 file that unpacks to {unpacked} bytes for {width} x {height} texels"));
        }
        budget.spend(texels * RGBA_BYTES)?;
        let undecodable = |error: basisu::Error| format!("cannot be decoded: {error:?}");
        let transcoder = Transcoder::new(bytes).map_err(undecodable)?;
        let rgba = transcoder.transcode(0, TargetFormat::Rgba32, DecodeFlags::NONE).map_err(undecodable)?;
        RgbaImage::from_raw(width, height, rgba).ok_or_else(|| "has too few texels".to_owned())
    }
}
