//! Settings as they are written: JSON with the number of their format, so that what an older program wrote is read as
//! it was meant, and what a newer one wrote is named instead of guessed at.

use serde::Serialize;
use serde_json::Value;

use super::Settings;

/// Goes up when a setting is renamed, moved or means something else; a new one with a default needs no new number.
/// Files without a number are of format 1.
pub const FORMAT: u64 = 1;

const KEY: &str = "format";

#[derive(Serialize)]
struct Written<'a> {
    format: u64,
    #[serde(flatten)]
    settings: &'a Settings,
}

impl Settings {
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string(&Written { format: FORMAT, settings: self })
    }

    /// Settings of any format so far; what the text does not name has its default. The error says which setting is
    /// unknown or out of range.
    pub fn from_json(text: &str) -> Result<Self, String> {
        let named = |error: &dyn std::fmt::Display| format!("settings: {error}");
        let mut value: Value = serde_json::from_str(text).map_err(|error| named(&error))?;
        let format = value.as_object_mut().and_then(|settings| settings.remove(KEY));
        match format.as_ref().map(Value::as_u64) {
            None | Some(Some(FORMAT)) => {}
            Some(Some(newer)) if newer > FORMAT => {
                return Err(format!(
                    "settings of format {newer} are of a newer Octolume; this one reads up to {FORMAT}"
                ));
            }
            Some(_) => return Err(format!("settings: {KEY} is {}, not a number from 1", format.unwrap_or_default())),
        }
        let settings: Self = serde_path_to_error::deserialize(value).map_err(|error| named(&error))?;
        settings.check()?;
        Ok(settings)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_with_its_number() {
        let mut settings = Settings::default();
        settings.motion.time_secs = 0.5;
        let json = settings.to_json().unwrap();
        assert!(json.starts_with(r#"{"format":1,"discretization":{"#), "{json}");
        assert_eq!(Settings::from_json(&json), Ok(settings));
    }

    #[test]
    fn files_without_a_number_are_the_oldest() {
        let settings = Settings::from_json(r#"{"discretization": {"grid": 256}}"#).unwrap();
        assert_eq!((settings.discretization.grid, settings.look), (256, Settings::default().look));
    }

    #[test]
    fn what_cannot_be_read_is_named() {
        let error = |text: &str| Settings::from_json(text).unwrap_err();
        assert_eq!(error(r#"{"format": 7}"#), "settings of format 7 are of a newer Octolume; this one reads up to 1");
        assert_eq!(error(r#"{"format": "new"}"#), "settings: format is \"new\", not a number from 1");
        assert_eq!(error(r#"{"format": 0}"#), "settings: format is 0, not a number from 1");
        assert!(error(r#"{"look": {"view": "inside"}}"#).starts_with("settings: look.view: unknown variant `inside`"));
        assert!(error(r#"{"discretization": {"grid": 100}}"#).contains("[64, 128, 256, 512, 1024]"));
    }
}
