//! Values as they are written on the command line. A value out of range is an error that names
//! the range.

use std::ops::RangeInclusive;
use std::str::FromStr;

use glam::DVec3;
use octolume::settings::{FitTo, ShotSettings};
use serde::de::value::Error as NameError;
use serde::de::{DeserializeOwned, IntoDeserializer};

pub use super::cone_values::{IndirectSize, OcclusionDistance, Switch};
pub use super::view_values::{Exposure, SliceChoice, SliceScale, ViewChoice};

const FRAMES_PER_SEC: RangeInclusive<f64> = 0.001..=1000.0;

/// A choice by the name that settings files use too.
pub fn name<T: DeserializeOwned>(text: &str) -> Result<T, NameError> {
    T::deserialize(text.into_deserializer())
}

/// A finite number.
pub fn number(text: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok().filter(|number: &f64| number.is_finite());
    number.ok_or_else(|| "a finite number is wanted".to_owned())
}

pub fn frames_per_sec(text: &str) -> Result<f64, String> {
    number(text)
        .ok()
        .filter(|rate| FRAMES_PER_SEC.contains(rate))
        .ok_or_else(|| format!("{} to {} frames a second are possible", FRAMES_PER_SEC.start(), FRAMES_PER_SEC.end()))
}

/// `X,Y,Z`, finite numbers.
pub fn vector(text: &str) -> Result<[f64; 3], String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(number).collect();
    numbers
        .ok()
        .and_then(|numbers| <[f64; 3]>::try_from(numbers).ok())
        .ok_or_else(|| "three finite numbers as X,Y,Z are wanted".to_owned())
}

/// `X,Y,Z`, a cell of a grid.
pub fn cell(text: &str) -> Result<[u32; 3], String> {
    let numbers: Option<Vec<u32>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    numbers
        .and_then(|numbers| <[u32; 3]>::try_from(numbers).ok())
        .ok_or_else(|| "three whole numbers from 0 as X,Y,Z are wanted".to_owned())
}

/// What the grid encloses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FitChoice(pub FitTo);

impl FromStr for FitChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let corners = |text: &str| {
            let (min, max) = text.split_once(':')?;
            Some([vector(min).ok()?, vector(max).ok()?].map(DVec3::from_array))
        };
        match text {
            "scene" => Ok(Self(FitTo::Scene)),
            // What counts beside is what is shown.
            "clip" | "selection" => Ok(Self(FitTo::Clip)),
            "pose" => Ok(Self(FitTo::Pose)),
            other => {
                let [min, max] = corners(other).ok_or("scene, clip, pose, selection or a box X,Y,Z:X,Y,Z is wanted")?;
                Ok(Self(FitTo::Box { min, max }))
            }
        }
    }
}

/// A picture's size in pixels, written `WxH`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size(pub [u32; 2]);

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let sides_px = ShotSettings::SIDES_PX;
        let side = |text: &str| text.parse().ok().filter(|px| sides_px.contains(px));
        text.split_once('x')
            .and_then(|(width, height)| Some(Self([side(width)?, side(height)?])))
            .ok_or_else(|| format!("a size is WxH, both {} to {} pixels", sides_px.start(), sides_px.end()))
    }
}

/// Frames `A:B`, both included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frames {
    pub first: u32,
    pub last: u32,
}

impl Frames {
    const MAX: u32 = 99_999;
}

impl FromStr for Frames {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let frame = |text: &str| text.parse().ok().filter(|frame| *frame <= Self::MAX);
        text.split_once(':')
            .and_then(|(first, last)| Some(Self { first: frame(first)?, last: frame(last)? }))
            .filter(|frames| frames.first <= frames.last)
            .ok_or_else(|| format!("frames are A:B, A not above B, both 0 to {}", Self::MAX))
    }
}

/// Takes a value that was given.
pub fn set<T>(place: &mut T, given: Option<T>) {
    if let Some(value) = given {
        *place = value;
    }
}

#[cfg(test)]
mod tests {
    use octolume::settings::{ColorBy, Filter};

    use super::*;

    #[test]
    fn names_are_those_of_settings_files() {
        assert_eq!(name::<Filter>("nearest").unwrap(), Filter::Nearest);
        assert_eq!(name::<ColorBy>("occupancy").unwrap(), ColorBy::Occupancy);
        let error = name::<Filter>("both").unwrap_err().to_string();
        assert!(error.contains("`nearest`") && error.contains("`split`"), "{error}");
    }

    #[test]
    fn numbers_are_finite() {
        for bad in ["NaN", "inf", "", "1e999", "one"] {
            assert!(number(bad).is_err(), "{bad}");
        }
        assert_eq!(number(" -1e-3"), Ok(-0.001));
        assert!(frames_per_sec("0").unwrap_err().contains("0.001 to 1000"));
    }

    #[test]
    fn vectors_have_three_finite_numbers() {
        assert_eq!(vector("-1,2.5,1e3"), Ok([-1.0, 2.5, 1000.0]));
        for bad in ["1,2", "1,2,3,4", "1,,3", "1,2,inf", "a,b,c"] {
            assert!(vector(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn sizes_and_frames_are_checked() {
        assert_eq!("640x480".parse(), Ok(Size([640, 480])));
        assert!("640".parse::<Size>().is_err() && "0x9".parse::<Size>().is_err() && "9000x9".parse::<Size>().is_err());
        assert_eq!("2:5".parse(), Ok(Frames { first: 2, last: 5 }));
        assert!("5:2".parse::<Frames>().is_err() && "5".parse::<Frames>().is_err());
    }
}
