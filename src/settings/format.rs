//! Settings as they are written: JSON with the number of their format, so that what an older program wrote is read as
//! it was meant, and what a newer one wrote is named instead of guessed at.

use std::fmt::Display;

use serde::{Deserialize, Serialize, Serializer};
use serde_json::{Map, Value};

use super::{MethodSettings, Settings, ShotSettings, format_1};

/// Goes up when a setting is renamed, moved or means something else; a new one with a default needs no new number.
/// Files without a number are of format 1.
pub const FORMAT: u64 = 2;

const KEY: &str = "format";

#[derive(Serialize)]
struct Written<'a> {
    format: u64,
    shot: &'a ShotSettings,
    method: &'a MethodSettings,
}

/// What is behind the number.
#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Numbered {
    shot: ShotSettings,
    method: MethodSettings,
}

/// As [`Settings::from_json`] reads them, wherever they are written.
impl Serialize for Settings {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Written { format: FORMAT, shot: &self.shot, method: &self.method }.serialize(serializer)
    }
}

impl Settings {
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string(self)
    }

    /// Settings of any format so far; what the text does not name has its default. The error says which setting is
    /// unknown or out of range.
    pub fn from_json(text: &str) -> Result<Self, String> {
        let named = |error: &dyn Display| format!("settings: {error}");
        let mut written: Map<String, Value> = serde_json::from_str(text).map_err(|error| named(&error))?;
        let format = format_of(written.remove(KEY))?;
        if format == 1 {
            written = format_1::to_format_2(written).map_err(|error| named(&error))?;
        }
        let Numbered { shot, method } = serde_path_to_error::deserialize(Value::Object(written)).map_err(|error| {
            let place = error.path().to_string();
            let place = if format == 1 { format_1::place(&place) } else { place };
            named(&if place == "." { error.inner().to_string() } else { format!("{place}: {}", error.inner()) })
        })?;
        let settings = Self { shot, method };
        settings.check()?;
        Ok(settings)
    }
}

/// 1 to [`FORMAT`].
fn format_of(written: Option<Value>) -> Result<u64, String> {
    let Some(written) = written else { return Ok(1) };
    match written.as_u64() {
        Some(format @ 1..=FORMAT) => Ok(format),
        Some(newer) if newer > FORMAT => {
            Err(format!("settings of format {newer} are of a newer Octolume; this one reads up to {FORMAT}"))
        }
        _ => Err(format!("settings: {KEY} is {written}, not a number from 1")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::OrbitCamera;
    use crate::settings::FitTo;

    #[test]
    fn what_is_written_is_read_with_its_number() {
        let mut settings = Settings::default();
        settings.shot.motion.time_secs = 0.5;
        let json = settings.to_json().unwrap();
        assert!(json.starts_with(r#"{"format":2,"shot":{"motion":{"#), "{json}");
        assert_eq!(Settings::from_json(&json), Ok(settings));
    }

    #[test]
    fn files_without_a_number_are_the_oldest() {
        let text = r#"{"discretization": {"grid": 256}, "motion": {"time_secs": 2}, "look": {"shaded": false,
                       "camera": {"eye": [1, 2, 3], "target": [0, 0, 0], "fov_y_degrees": 50}}}"#;
        let numbered = text.replacen('{', r#"{"format": 1, "#, 1);
        let mut expected = Settings::default();
        (expected.method.discretization.grid, expected.method.look.shaded) = (256, false);
        expected.shot.motion.time_secs = 2.0;
        expected.shot.fit.to = FitTo::Scene;
        expected.shot.camera = Some(OrbitCamera::new([1.0, 2.0, 3.0].into(), [0.0; 3].into(), 50.0));
        assert_eq!(Settings::from_json(text), Ok(expected.clone()));
        assert_eq!(Settings::from_json(&numbered), Ok(expected));
        let mut empty = Settings::default();
        empty.shot.fit.to = FitTo::Scene;
        assert_eq!(Settings::from_json("{}"), Ok(empty));
    }

    #[test]
    fn what_cannot_be_read_is_named() {
        let error = |text: &str| Settings::from_json(text).unwrap_err();
        assert_eq!(error(r#"{"format": 7}"#), "settings of format 7 are of a newer Octolume; this one reads up to 2");
        assert_eq!(error(r#"{"format": "new"}"#), "settings: format is \"new\", not a number from 1");
        assert_eq!(error(r#"{"format": 0}"#), "settings: format is 0, not a number from 1");
        let begins = |text: &str, with: &str| assert!(error(text).starts_with(with), "{}", error(text));
        begins(r#"{"format": 2, "grid": 9}"#, "settings: grid: unknown field `grid`, expected `shot` or `method`");
        begins(r#"{"format": 2, "look": {}}"#, "settings: look: unknown field `look`");
        begins(
            r#"{"format": 2, "method": {"look": {"view": "in"}}}"#,
            "settings: method.look.view: unknown variant `in`",
        );
        let shot = r#"{"format": 2, "shot": {"look": {}}}"#;
        begins(shot, "settings: shot.look: unknown field `look`, expected one of `motion`, `visibility`, `fit`");
    }

    #[test]
    fn what_format_1_did_not_have_is_named_as_it_was_written() {
        let error = |text: &str| Settings::from_json(text).unwrap_err();
        let begins = |text: &str, with: &str| assert!(error(text).starts_with(with), "{}", error(text));
        begins(r#"{"look": {"view": "inside"}}"#, "settings: look.view: unknown variant `inside`");
        begins(r#"{"look": {"size": 1}}"#, "settings: look.size: unknown field `size`");
        begins(r#"{"look": {"camera": {"eye": 1}}}"#, "settings: look.camera.eye: invalid type");
        begins(r#"{"motion": {"speed": 1}}"#, "settings: motion.speed: unknown field `speed`");
        begins(
            r#"{"shot": {}}"#,
            "settings: unknown field `shot`, expected one of `motion`, `visibility`, `discretization`",
        );
        assert!(error(r#"{"discretization": {"grid": 100}}"#).contains("[64, 128, 256, 512, 1024]"));
    }
}
