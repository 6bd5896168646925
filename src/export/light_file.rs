//! Linear light as OpenEXR files: f32 channels as they are, nothing clamped.

use std::io::Cursor;
use std::path::Path;

use image::{ImageFormat, Rgba32FImage};

use super::{ExportError, write_file};

/// Writes four channels a pixel, rows from the top: linear red, green and blue, and 1 where a surface is.
pub fn write_exr(file: &Path, [width, height]: [u32; 2], pixels: &[[f32; 4]]) -> Result<(), ExportError> {
    let failed = |cause: &dyn ToString| ExportError::new(file, cause.to_string());
    let picture = Some(pixels.as_flattened().to_vec())
        .filter(|_| pixels.len() as u64 == u64::from(width) * u64::from(height))
        .and_then(|values| Rgba32FImage::from_raw(width, height, values))
        .ok_or_else(|| failed(&format!("{} pixels are not {width} x {height}", pixels.len())))?;
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::OpenExr).map_err(|error| failed(&error))?;
    write_file(file, bytes.get_ref())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_comes_back_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("light.exr");
        let pixels: Vec<[f32; 4]> = (0..15).map(|i| [i as f32 * 1e4, 1e-7, -0.25 * i as f32, 1.0]).collect();
        write_exr(&file, [5, 3], &pixels).unwrap();
        let read = image::open(&file).unwrap().into_rgba32f();
        assert_eq!((read.dimensions(), read.as_raw().as_slice()), ((5, 3), pixels.as_flattened()));
        assert!(write_exr(&file, [4, 3], &pixels).unwrap_err().to_string().contains("15 pixels are not 4 x 3"));
    }
}
