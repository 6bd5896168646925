//! PNG files that know how they were made: the settings travel as JSON in an iTXt chunk, so that
//! a screenshot can be opened as settings.

use std::io::Cursor;
use std::path::Path;

use image::RgbaImage;

use super::{ExportError, write_file};
use crate::settings::Settings;

/// Keyword of the chunk that carries the settings.
const KEYWORD: &str = "octolume-settings";

/// Writes a picture with 8-bit sRGB colours and the settings that made it, its size among them.
pub fn write_png(file: &Path, picture: &RgbaImage, settings: &Settings) -> Result<(), ExportError> {
    write_file(file, &png_bytes(file, picture, settings)?)
}

/// The bytes of [`write_png`]; `file` stands for them in messages.
pub fn png_bytes(file: &Path, picture: &RgbaImage, settings: &Settings) -> Result<Vec<u8>, ExportError> {
    let mut settings = settings.clone();
    settings.shot.size_px = Some(picture.dimensions().into());
    let settings = settings.to_json().map_err(|error| ExportError::new(file, error))?;
    encode(picture, settings).map_err(|error| ExportError::new(file, error))
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

/// Reads settings from a JSON file or from a picture of [`write_png`]. Where a picture's settings do not tell its size,
/// as in format 1, they get it from the picture.
pub fn read_settings(file: &Path) -> Result<Settings, ExportError> {
    let failed = |cause: String| ExportError::new(file, cause);
    let bytes = std::fs::read(file).map_err(|error| failed(error.to_string()))?;
    let (json, size_px) = match bytes.starts_with(b"\x89PNG") {
        true => settings_of_png(&bytes).map_err(failed)?,
        false => (String::from_utf8(bytes).map_err(|_| failed("neither JSON nor PNG".to_owned()))?, None),
    };
    let mut settings = Settings::from_json(&json).map_err(failed)?;
    settings.shot.size_px = settings.shot.size_px.or(size_px);
    Ok(settings)
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
    use glam::DVec3;
    use image::Rgba;

    use super::*;
    use crate::scene::{LightKind, OrbitCamera, SceneIdentity};
    use crate::settings::lighting::{AddedLight, LightEdit, Shadows, SunShines};
    use crate::settings::{ColorBy, Filter, FitTo, View};

    fn picture() -> RgbaImage {
        RgbaImage::from_fn(5, 3, |x, y| Rgba([x as u8, y as u8, 7, 255]))
    }

    fn settings() -> Settings {
        let mut settings = Settings::default();
        settings.method.look.view = View::Ghost;
        settings.method.look.color = ColorBy::Occupancy;
        settings.shot.motion.clip = Some("Läufer".to_owned());
        settings.shot.motion.time_secs = 0.1;
        settings
    }

    #[test]
    fn a_picture_carries_its_settings() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("shot.png");
        write_png(&file, &picture(), &settings()).unwrap();
        let mut expected = settings();
        expected.shot.size_px = Some([5, 3]);
        assert_eq!(read_settings(&file).unwrap(), expected);
        assert_eq!(image::open(&file).unwrap().to_rgba8(), picture());
    }

    /// Every picture and JSON written so far opens: of each format one is kept.
    #[test]
    fn what_was_written_before_is_read_as_it_was_meant() {
        let saved = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/saved");
        let read = |name: &str| read_settings(&saved.join(name)).unwrap();
        let mut expected = Settings::default();
        (expected.method.discretization.grid, expected.method.discretization.dense_level) = (64, Some(3));
        expected.method.discretization.filter = Filter::Nearest;
        (expected.shot.motion.time_secs, expected.shot.motion.turn_degrees) = (1.25, [0.0, 20.0, 0.0]);
        (expected.method.look.color, expected.method.look.exposure_stops) = (ColorBy::Radiance, Some(-1.0));
        let (eye, target) = (DVec3::new(6.0, 4.0, 9.0), DVec3::new(0.0, 1.0, 0.0));
        expected.shot.camera = Some(OrbitCamera::new(eye, target, 45.0));
        let lighting = &mut expected.method.lighting;
        lighting.sun.shines = SunShines::Never;
        (lighting.sky_nits, lighting.shadows) = ([0.5, 0.7, 1.0], Shadows::March);
        let light = LightEdit { intensity: 80.0, ..LightEdit::new(LightKind::POINT) };
        let lamp = AddedLight { position: [0.0, 3.0, 0.0], light, ..AddedLight::new("light 1".to_owned(), light.kind) };
        lighting.added = vec![lamp];
        expected.shot.fit.to = FitTo::Scene;
        assert_eq!(read("format-1.json"), expected);
        expected.shot.size_px = Some([96, 54]);
        assert_eq!(read("format-1.png"), expected, "a picture tells its size");
        let digest = serde_json::from_str(r#""399fa1309a4732b56ca45a94d3cbcb00""#).unwrap();
        expected.shot.fit.to = FitTo::Clip;
        expected.shot.scene = Some(SceneIdentity { source: "courtyard".to_owned(), digest: Some(digest) });
        assert_eq!((read("format-2.json"), read("format-2.png")), (expected.clone(), expected));
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
