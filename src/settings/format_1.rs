//! Settings of format 1, which had no shot and no method: its parts lay side by side, and the camera in the look.

use serde_json::{Map, Value, json};

use super::FitTo;

const OF_SHOT: [&str; 2] = ["motion", "visibility"];
const OF_METHOD: [&str; 4] = ["discretization", "lighting", "cone_tracing", "look"];
const CAMERA: &str = "camera";

/// The same settings as format 2 has them. A part that format 1 did not have is an error.
pub(super) fn to_format_2(mut written: Map<String, Value>) -> Result<Map<String, Value>, String> {
    let camera = written.get_mut("look").and_then(Value::as_object_mut).and_then(|look| look.remove(CAMERA));
    let mut part = |names: &[&str]| -> Map<String, Value> {
        names.iter().filter_map(|name| written.remove_entry(*name)).collect()
    };
    let (mut shot, method) = (part(&OF_SHOT), part(&OF_METHOD));
    shot.extend(camera.map(|camera| (CAMERA.to_owned(), camera)));
    // There was no choice: the grid enclosed everything at all times.
    shot.insert("fit".to_owned(), json!({ "to": FitTo::Scene }));
    if let Some(unknown) = written.keys().next() {
        let known = [&OF_SHOT[..], &OF_METHOD].concat().join("`, `");
        return Err(format!("unknown field `{unknown}`, expected one of `{known}`"));
    }
    Ok([("shot", shot), ("method", method)]
        .map(|(name, part)| (name.to_owned(), Value::Object(part)))
        .into_iter()
        .collect())
}

/// Where format 1 has what is at this place of format 2.
pub(super) fn place(in_format_2: &str) -> String {
    match in_format_2.strip_prefix("shot.") {
        Some(place) if place.starts_with(CAMERA) => format!("look.{place}"),
        Some(place) => place.to_owned(),
        None => in_format_2.strip_prefix("method.").unwrap_or(in_format_2).to_owned(),
    }
}
