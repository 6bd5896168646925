//! One light as a person wants it: a light of the scene with an edit, or one that is not in the file.
//! Lux for directional lights, candela for point and spot lights, lengths in scene units.

use serde::{Deserialize, Serialize};

use crate::scene::{Light, LightKind};

/// A light of the scene as it shall be. Place and direction stay those of its node.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LightEdit {
    pub on: bool,
    pub kind: LightKind,
    /// Linear RGB.
    pub color: [f64; 3],
    /// Lux or candela.
    pub intensity: f64,
}

/// A light that is not in the file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AddedLight {
    pub name: String,
    pub light: LightEdit,
    /// Scene units.
    pub position: [f64; 3],
    /// The way it shines; any length but 0.
    pub direction: [f64; 3],
}

/// One property of a light, and what it shall be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightPart {
    On(bool),
    Lux(f64),
    Candela(f64),
    /// Linear RGB.
    Color([f64; 3]),
    /// Scene units; `None`: as far as it goes.
    Range(Option<f64>),
    InnerDegrees(f64),
    OuterDegrees(f64),
}

impl LightPart {
    /// As a command line calls it.
    pub fn name(self) -> &'static str {
        match self {
            Self::On(_) => "on",
            Self::Lux(_) => "lux",
            Self::Candela(_) => "candela",
            Self::Color(_) => "color",
            Self::Range(_) => "range",
            Self::InnerDegrees(_) => "inner",
            Self::OuterDegrees(_) => "outer",
        }
    }
}

impl LightKind {
    pub const POINT: Self = Self::Point { range: None };
    /// glTF's default cone.
    pub const SPOT: Self =
        Self::Spot { range: None, inner_cone_radians: 0.0, outer_cone_radians: std::f32::consts::FRAC_PI_4 };

    pub fn name(&self) -> &'static str {
        match self {
            Self::Directional => "directional",
            Self::Point { .. } => "point",
            Self::Spot { .. } => "spot",
        }
    }

    /// Of its intensity.
    pub fn unit(&self) -> &'static str {
        match self {
            Self::Directional => "lux",
            Self::Point { .. } | Self::Spot { .. } => "candela",
        }
    }

    /// How far it reaches, scene units.
    pub fn range(&self) -> Option<f32> {
        match self {
            Self::Directional => None,
            Self::Point { range } | Self::Spot { range, .. } => *range,
        }
    }
}

impl LightEdit {
    /// Illuminance and intensity of a light nobody has set otherwise.
    pub const DIRECTIONAL_LUX: f64 = 10_000.0;
    pub const POINT_CANDELA: f64 = 1_000.0;

    /// A light of the file as it is without an edit.
    pub fn of(light: &Light) -> Self {
        let color = light.color.map(f64::from);
        Self { on: true, kind: light.kind, color, intensity: f64::from(light.intensity) }
    }

    /// White, on, as bright as lights of its kind are at first.
    pub fn new(kind: LightKind) -> Self {
        let intensity = match kind {
            LightKind::Directional => Self::DIRECTIONAL_LUX,
            LightKind::Point { .. } | LightKind::Spot { .. } => Self::POINT_CANDELA,
        };
        Self { on: true, kind, color: [1.0; 3], intensity }
    }

    /// The error says that a light of this kind has no such property.
    pub fn set(&mut self, part: LightPart) -> Result<(), String> {
        use LightKind::{Directional, Point, Spot};
        match (part, &mut self.kind) {
            (LightPart::On(on), _) => self.on = on,
            (LightPart::Color(color), _) => self.color = color,
            (LightPart::Lux(lux), Directional) => self.intensity = lux,
            (LightPart::Candela(candela), Point { .. } | Spot { .. }) => self.intensity = candela,
            (LightPart::Range(wanted), Point { range } | Spot { range, .. }) => {
                *range = wanted.map(|range| range as f32)
            }
            (LightPart::InnerDegrees(degrees), Spot { inner_cone_radians, .. }) => {
                *inner_cone_radians = degrees.to_radians() as f32;
            }
            (LightPart::OuterDegrees(degrees), Spot { outer_cone_radians, .. }) => {
                *outer_cone_radians = degrees.to_radians() as f32;
            }
            (part, kind) => {
                return Err(format!("a {} light has no {}; its unit is {}", kind.name(), part.name(), kind.unit()));
            }
        }
        Ok(())
    }

    /// Are all values in range? If not, the sentence names value and range.
    pub(super) fn check(&self, name: &str) -> Result<(), String> {
        check_intensity(name, self.color, self.intensity)?;
        if let Some(range) = self.kind.range().filter(|range| !(range.is_finite() && *range > 0.0)) {
            return Err(format!("the range of {name} is {range}; it must be a finite number above 0"));
        }
        match self.kind {
            LightKind::Spot { inner_cone_radians: inner, outer_cone_radians: outer, .. }
                if !(0.0 <= inner && inner <= outer && outer <= std::f32::consts::FRAC_PI_2) =>
            {
                let [inner, outer] = [inner, outer].map(f32::to_degrees);
                Err(format!("the cone of {name} goes from {inner}° to {outer}°; it must grow from 0° to at most 90°"))
            }
            _ => Ok(()),
        }
    }
}

impl AddedLight {
    /// At the world's origin; shines down.
    pub fn new(name: String, kind: LightKind) -> Self {
        Self { name, light: LightEdit::new(kind), position: [0.0; 3], direction: [0.0, -1.0, 0.0] }
    }

    pub(super) fn check(&self) -> Result<(), String> {
        let name = format!("light \"{}\"", self.name);
        self.light.check(&name)?;
        check_direction(&name, self.direction)?;
        if !self.position.iter().all(|coordinate| coordinate.is_finite()) {
            return Err(format!("the position {:?} of {name} is not finite", self.position));
        }
        Ok(())
    }
}

pub(super) fn check_intensity(name: &str, color: [f64; 3], intensity: f64) -> Result<(), String> {
    let is_amount = |value: &f64| value.is_finite() && *value >= 0.0;
    if color.iter().chain([&intensity]).all(is_amount) {
        return Ok(());
    }
    Err(format!("colour {color:?} and intensity {intensity} of {name} must be finite and not negative"))
}

pub(super) fn check_direction(name: &str, direction: [f64; 3]) -> Result<(), String> {
    let length = glam::DVec3::from_array(direction).length();
    if length.is_finite() && length > 0.0 {
        return Ok(());
    }
    Err(format!("{name} shines along {direction:?}, which is no direction"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_light_has_the_properties_of_its_kind() {
        let mut spot = LightEdit::new(LightKind::SPOT);
        for part in [LightPart::Candela(5.0), LightPart::Range(Some(3.0)), LightPart::OuterDegrees(90.0)] {
            assert_eq!(spot.set(part), Ok(()), "{part:?}");
        }
        let outer_cone_radians = std::f32::consts::FRAC_PI_2;
        let kind = LightKind::Spot { range: Some(3.0), inner_cone_radians: 0.0, outer_cone_radians };
        assert_eq!(spot, LightEdit { on: true, kind, color: [1.0; 3], intensity: 5.0 });
        assert_eq!(spot.check("spot"), Ok(()));
        let mut sun = LightEdit::new(LightKind::Directional);
        for part in [LightPart::Candela(5.0), LightPart::Range(None), LightPart::InnerDegrees(1.0)] {
            let error = sun.set(part).expect_err("not of its kind");
            assert_eq!(error, format!("a directional light has no {}; its unit is lux", part.name()));
        }
    }

    #[test]
    fn values_out_of_range_are_named() {
        let error = |part| {
            let mut spot = LightEdit::new(LightKind::SPOT);
            spot.set(part).expect("of its kind");
            spot.check("light 7").expect_err("out of range")
        };
        assert!(error(LightPart::OuterDegrees(91.0)).contains("from 0° to 91°"));
        assert!(error(LightPart::InnerDegrees(46.0)).contains("grow from 0° to at most 90°"));
        assert!(error(LightPart::Range(Some(0.0))).contains("the range of light 7 is 0"));
        assert!(error(LightPart::Range(Some(1e300))).contains("a finite number above 0"));
        assert!(error(LightPart::Candela(f64::NAN)).contains("light 7 must be finite and not negative"));
        let nowhere = AddedLight { direction: [0.0; 3], ..AddedLight::new("lamp".to_owned(), LightKind::POINT) };
        assert!(nowhere.check().expect_err("no direction").contains("light \"lamp\" shines along"));
    }
}
