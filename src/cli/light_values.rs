//! Lights as they are written on the command line: `NAME:PART:PART`, where a part is `off`, `on` or
//! `KEY=VALUE`. A name may hold colons, parts do not. A value out of range is an error that names the
//! range.

use octolume::scene::LightKind;
use octolume::settings::LightChange;
use octolume::settings::lighting::{AddedLight, LightPart, SunShines};

use super::values::{number, vector};

/// Keys that every light may have, as far as its kind has them.
const KEYS: &str = "lux, candela, color, range, inner, outer";

/// What `--sun` says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SunChoice {
    Lux(f64),
    As(SunShines),
}

pub fn sun(text: &str) -> Result<SunChoice, String> {
    match text {
        "off" => Ok(SunChoice::As(SunShines::Never)),
        "auto" => Ok(SunChoice::As(SunShines::Unlit)),
        lux => amount(lux).map(SunChoice::Lux).map_err(|error| format!("{error}, or `off`, or `auto`")),
    }
}

/// A finite number from 0.
pub fn amount(text: &str) -> Result<f64, String> {
    number(text).ok().filter(|amount| *amount >= 0.0).ok_or_else(|| "a finite number from 0 is wanted".to_owned())
}

/// Linear red, green, blue from 0.
pub fn color(text: &str) -> Result<[f64; 3], String> {
    let color = vector(text).ok().filter(|color| color.iter().all(|channel| *channel >= 0.0));
    color.ok_or_else(|| "three finite numbers from 0 as R,G,B are wanted".to_owned())
}

/// `NAME:PART…`: a light of the scene.
pub fn light_change(text: &str) -> Result<LightChange, String> {
    let mut name = text;
    let mut parts = Vec::new();
    while let Some((rest, last)) = name.rsplit_once(':') {
        match light_part(last) {
            Some(part) => parts.push(part?),
            None => break,
        }
        name = rest;
    }
    if parts.is_empty() || name.is_empty() {
        return Err(format!("wanted is NAME:off, NAME:on or NAME:KEY=VALUE, where KEY is one of {KEYS}"));
    }
    parts.reverse();
    Ok(LightChange { name: name.to_owned(), parts })
}

/// `KIND:PART…`: a light that is not in the file. Without a name it is called "".
pub fn added_light(text: &str) -> Result<AddedLight, String> {
    let (kind, parts) = text.split_once(':').unwrap_or((text, ""));
    let kind = match kind {
        "directional" => LightKind::Directional,
        "point" => LightKind::POINT,
        "spot" => LightKind::SPOT,
        other => return Err(format!("a light is directional, point or spot, not {other:?}")),
    };
    let mut added = AddedLight::new(String::new(), kind);
    let mut is_placed = kind == LightKind::Directional;
    for part in parts.split(':').filter(|part| !part.is_empty()) {
        match part.split_once('=') {
            Some(("name", name)) => added.name = name.to_owned(),
            Some(("at", place)) if kind != LightKind::Directional => {
                added.position = vector(place).map_err(|error| format!("at={place}: {error}"))?;
                is_placed = true;
            }
            Some(("to", way)) if kind != LightKind::POINT => {
                added.direction = vector(way).map_err(|error| format!("to={way}: {error}"))?;
            }
            _ => added.light.set(light_part(part).ok_or_else(|| unknown_part(kind, part))??)?,
        }
    }
    if !is_placed {
        return Err(format!("a {} light needs a place: at=X,Y,Z", kind.name()));
    }
    Ok(added)
}

fn unknown_part(kind: LightKind, part: &str) -> String {
    let places = match kind {
        LightKind::Directional => "to",
        LightKind::Point { .. } => "at",
        LightKind::Spot { .. } => "at, to",
    };
    format!("{part:?} is nothing that a {} light has; KEY is one of name, {places}, {KEYS}", kind.name())
}

/// `None`: the text is no part of a light.
fn light_part(text: &str) -> Option<Result<LightPart, String>> {
    let (key, value) = match text {
        "off" => return Some(Ok(LightPart::On(false))),
        "on" => return Some(Ok(LightPart::On(true))),
        text => text.split_once('=')?,
    };
    let part = match key {
        "lux" => amount(value).map(LightPart::Lux),
        "candela" => amount(value).map(LightPart::Candela),
        "color" => color(value).map(LightPart::Color),
        "range" if value == "none" => Ok(LightPart::Range(None)),
        "range" => range(value).map(|range| LightPart::Range(Some(range))),
        "inner" => degrees(value).map(LightPart::InnerDegrees),
        "outer" => degrees(value).map(LightPart::OuterDegrees),
        _ => return None,
    };
    Some(part.map_err(|error| format!("{text}: {error}")))
}

fn range(text: &str) -> Result<f64, String> {
    let range = number(text).ok().filter(|range| *range > 0.0);
    range.ok_or_else(|| "a finite number above 0, or `none`, is wanted".to_owned())
}

fn degrees(text: &str) -> Result<f64, String> {
    let degrees = number(text).ok().filter(|degrees| (0.0..=90.0).contains(degrees));
    degrees.ok_or_else(|| "0 to 90 degrees are possible".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_of_a_light_are_a_name_and_parts() {
        let change = |name: &str, parts: &[LightPart]| Ok(LightChange { name: name.to_owned(), parts: parts.to_vec() });
        assert_eq!(light_change("Lamp:off"), change("Lamp", &[LightPart::On(false)]));
        let parts = [LightPart::Candela(5.0), LightPart::Color([1.0, 0.5, 0.0])];
        assert_eq!(light_change("Lamp:candela=5:color=1,0.5,0"), change("Lamp", &parts));
        assert_eq!(light_change("rig:left:range=none"), change("rig:left", &[LightPart::Range(None)]));
        for (bad, cause) in [
            ("Lamp", "NAME:KEY=VALUE"),
            (":off", "NAME:off"),
            ("Lamp:watts=3", "one of lux, candela"),
            ("Lamp:lux=-1", "lux=-1: a finite number from 0"),
            ("Lamp:color=1,2", "as R,G,B"),
            ("Lamp:range=0", "above 0"),
            ("Lamp:outer=91", "0 to 90 degrees"),
        ] {
            let error = light_change(bad).expect_err(bad);
            assert!(error.contains(cause), "{bad}: {error}");
        }
    }

    #[test]
    fn added_lights_have_what_their_kind_has() {
        let spot = added_light("spot:at=1,2,3:to=0,-1,1:candela=50:inner=10:outer=20:name=torch").expect("a spot");
        assert_eq!((spot.name.as_str(), spot.position, spot.direction), ("torch", [1.0, 2.0, 3.0], [0.0, -1.0, 1.0]));
        assert_eq!((spot.light.intensity, spot.light.kind.name()), (50.0, "spot"));
        assert!(added_light("directional").is_ok());
        for (bad, cause) in [
            ("lamp:at=0,0,0", "directional, point or spot, not \"lamp\""),
            ("point", "needs a place"),
            ("point:at=0,0", "at=0,0: three finite numbers"),
            ("point:at=0,0,0:to=0,1,0", "nothing that a point light has"),
            ("directional:at=0,0,0", "one of name, to, lux"),
            ("directional:candela=4", "no candela; its unit is lux"),
            ("point:at=0,0,0:watts=4", "\"watts=4\" is nothing"),
        ] {
            let error = added_light(bad).expect_err(bad);
            assert!(error.contains(cause), "{bad}: {error}");
        }
    }

    #[test]
    fn a_sun_is_lux_off_or_auto() {
        assert_eq!(sun("500"), Ok(SunChoice::Lux(500.0)));
        assert_eq!(sun("off"), Ok(SunChoice::As(SunShines::Never)));
        assert!(sun("-5").is_err_and(|error| error.contains("`auto`")));
    }
}
