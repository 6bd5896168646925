//! PNG files that know how they were made: the settings travel as JSON in an iTXt chunk, so that
//! a screenshot can be opened as settings.

use std::io::Cursor;
use std::path::Path;

use image::RgbaImage;

use super::{ExportError, write_file};
use crate::settings::Settings;

/// Keyword of the chunk that carries the settings.
const KEYWORD: &str = "octolume-settings";

/// Writes a picture with 8-bit sRGB colours and the settings that made it.
pub fn write_png(file: &Path, picture: &RgbaImage, settings: &Settings) -> Result<(), ExportError> {
    let settings = serde_json::to_string(settings).map_err(|error| ExportError::new(file, error))?;
    let bytes = encode(picture, settings).map_err(|error| ExportError::new(file, error))?;
    write_file(file, &bytes)
}

fn encode(picture: &RgbaImage, settings: String) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, picture.width(), picture.height());
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.add_itxt_chunk(KEYWORD.to_owned(), settings)?;
    let mut writer = encoder.write_header()?;
    writer.write_image_data(picture.as_raw())?;
    writer.finish()?;
    Ok(bytes)
}

/// Reads settings from a JSON file or from a picture of [`write_png`], whose size in pixels comes
/// with them.
pub fn read_settings(file: &Path) -> Result<(Settings, Option<[u32; 2]>), ExportError> {
    let failed = |cause: String| ExportError::new(file, cause);
    let bytes = std::fs::read(file).map_err(|error| failed(error.to_string()))?;
    let (json, size_px) = match bytes.starts_with(b"\x89PNG") {
        true => settings_of_png(&bytes).map_err(failed)?,
        false => (String::from_utf8(bytes).map_err(|_| failed("neither JSON nor PNG".to_owned()))?, None),
    };
    let settings: Settings = serde_json::from_str(&json).map_err(|error| failed(format!("settings: {error}")))?;
    settings.check().map_err(failed)?;
    Ok((settings, size_px))
}

fn settings_of_png(bytes: &[u8]) -> Result<(String, Option<[u32; 2]>), String> {
    let reader = png::Decoder::new(Cursor::new(bytes)).read_info().map_err(|error| error.to_string())?;
    let info = reader.info();
    let chunk = info.utf8_text.iter().find(|chunk| chunk.keyword == KEYWORD);
    let chunk = chunk.ok_or_else(|| format!("this picture carries no \"{KEYWORD}\""))?;
    let json = chunk.get_text().map_err(|error| error.to_string())?;
    Ok((json, Some([info.width, info.height])))
}

#[cfg(test)]
mod tests {
    use image::Rgba;

    use super::*;
    use crate::settings::{ColorBy, View};

    fn picture() -> RgbaImage {
        RgbaImage::from_fn(5, 3, |x, y| Rgba([x as u8, y as u8, 7, 255]))
    }

    fn settings() -> Settings {
        let mut settings = Settings::default();
        settings.look.view = View::Ghost;
        settings.look.color = ColorBy::Occupancy;
        settings.motion.clip = Some("Läufer".to_owned());
        settings.motion.time_secs = 0.1;
        settings
    }

    #[test]
    fn a_picture_carries_its_settings() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("shot.png");
        write_png(&file, &picture(), &settings()).unwrap();
        assert_eq!(read_settings(&file).unwrap(), (settings(), Some([5, 3])));
        assert_eq!(image::open(&file).unwrap().to_rgba8(), picture());
    }

    #[test]
    fn a_json_file_sets_what_it_names() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("settings.json");
        std::fs::write(&file, r#"{"discretization": {"grid": 256}}"#).unwrap();
        let (settings, size_px) = read_settings(&file).unwrap();
        assert_eq!((settings.discretization.grid, size_px), (256, None));
        assert_eq!(settings.look, Settings::default().look);
    }

    #[test]
    fn bad_files_are_named() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("bad");
        let mut plain = Vec::new();
        let encoder = png::Encoder::new(&mut plain, 1, 1);
        encoder.write_header().unwrap().write_image_data(&[0]).unwrap();
        let contents: [(&[u8], &str); 5] = [
            (b"{", "settings: EOF"),
            (br#"{"grid": 256}"#, "unknown field `grid`"),
            (br#"{"discretization": {"grid": 100}}"#, "[64, 128, 256, 512, 1024]"),
            (&[0xff, 0xfe], "neither JSON nor PNG"),
            (&plain, "carries no"),
        ];
        for (bytes, cause) in contents {
            std::fs::write(&file, bytes).unwrap();
            let error = read_settings(&file).unwrap_err().to_string();
            assert!(error.contains("bad: ") && error.contains(cause), "{error}");
        }
        assert!(read_settings(&folder.path().join("missing")).unwrap_err().to_string().contains("missing"));
    }
}
