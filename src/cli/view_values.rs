//! Views, slices and exposure as they are written on the command line.

use std::str::FromStr;

use octolume::settings::{ColorBy, SliceAxis, SurfaceView, View};
use serde::Deserialize;

use super::values::{name, number};

/// What `--view` says: a view, and behind a colon the octree level or the light it is of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ViewChoice {
    pub view: View,
    /// `None`: as it is set.
    pub color: Option<ColorBy>,
    /// `None`: the leaves.
    pub level: Option<u32>,
    /// `None`: as it is set.
    pub shadow_map: Option<usize>,
    /// `None`: as it is set.
    pub surface: Option<SurfaceView>,
}

impl FromStr for ViewChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (view, of) = text.split_once(':').map_or((text, None), |(view, of)| (view, Some(of)));
        let level =
            || of.map(number_of::<u32>).transpose().map_err(|()| "a level is a number, 0 is the root".to_owned());
        let colored = |color| Ok(Self { color: Some(color), level: level()?, ..Self::default() });
        match (view, of) {
            ("level", Some(_)) => Ok(Self { level: level()?, ..Self::default() }),
            ("radiance", _) => colored(ColorBy::Radiance),
            ("irradiance", _) => colored(ColorBy::Irradiance),
            ("shadow-map", Some(light)) => {
                let light = number_of(light).map_err(|()| "a light is a number, 0 is the first".to_owned())?;
                Ok(Self { view: View::ShadowMap, shadow_map: Some(light), ..Self::default() })
            }
            ("surfaces", Some(part)) => {
                let part = name(part).map_err(|error| error.to_string())?;
                Ok(Self { view: View::Surfaces, surface: Some(part), ..Self::default() })
            }
            _ => named(text),
        }
    }
}

/// A view by its name, or by that of a part of the lit surfaces that no other view is called by.
fn named(text: &str) -> Result<ViewChoice, String> {
    let others = "`level:N`, `radiance`, `radiance:N`, `irradiance`, `irradiance:N`, `shadow-map:N`, `surfaces:PART`, or \
                  a part: `final`, `direct`, `diffuse`, `specular`, `ao`, `albedo`, `normal`, `depth`, `roughness` \
                  (`surfaces:irradiance`)";
    let choice = ViewChoice::default();
    match name(text) {
        Ok(part) => Ok(ViewChoice { view: View::Surfaces, surface: Some(part), ..choice }),
        Err(_) => {
            let view = name(text).map_err(|error| format!("{error}, or one of {others}"))?;
            Ok(ViewChoice { view, ..choice })
        }
    }
}

fn number_of<T: FromStr>(text: &str) -> Result<T, ()> {
    text.parse().map_err(|_| ())
}

/// What `--slice` says: `AXIS:HEIGHT`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SliceChoice {
    pub axis: SliceAxis,
    pub height: f64,
}

impl FromStr for SliceChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let height = |text: &str| number(text).ok().filter(|height| (0.0..=1.0).contains(height));
        let parts = text.split_once(':').and_then(|(axis, at)| Some((name(axis).ok()?, height(at)?)));
        let (axis, height) = parts.ok_or_else(|| "a slice is x, y or z, a colon, and 0 to 1 of the grid".to_owned())?;
        Ok(Self { axis, height })
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SliceScale {
    Linear,
    Logarithmic,
}

/// What `--exposure` says; `None` inside: what the light asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exposure(pub Option<f64>);

impl FromStr for Exposure {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "auto" => Ok(Self(None)),
            stops => number(stops)
                .map(|stops| Self(Some(stops)))
                .map_err(|_| "a number of stops, or `auto`, is wanted".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn views_are_of_a_level_or_a_light() {
        let voxels = ViewChoice::default();
        for (text, choice) in [
            ("ghost", ViewChoice { view: View::Ghost, ..voxels }),
            ("slice", ViewChoice { view: View::Slice, ..voxels }),
            ("level:3", ViewChoice { level: Some(3), ..voxels }),
            ("radiance", ViewChoice { color: Some(ColorBy::Radiance), ..voxels }),
            ("irradiance:2", ViewChoice { color: Some(ColorBy::Irradiance), level: Some(2), ..voxels }),
            ("shadow-map", ViewChoice { view: View::ShadowMap, ..voxels }),
            ("surfaces", ViewChoice { view: View::Surfaces, ..voxels }),
            ("final", ViewChoice { view: View::Surfaces, surface: Some(SurfaceView::Final), ..voxels }),
            (
                "surfaces:irradiance",
                ViewChoice { view: View::Surfaces, surface: Some(SurfaceView::Irradiance), ..voxels },
            ),
            ("shadow-map:1", ViewChoice { view: View::ShadowMap, shadow_map: Some(1), ..voxels }),
        ] {
            assert_eq!(text.parse(), Ok(choice), "{text}");
        }
        for bad in
            ["glass", "level", "level:leaf", "level:-1", "radiance:", "slice:2", "shadow-map:sun", "surfaces:glass", ""]
        {
            assert!(bad.parse::<ViewChoice>().is_err(), "{bad}");
        }
        assert!(
            "glass".parse::<ViewChoice>().is_err_and(|error| error.contains("`mesh`") && error.contains("`level:N`"))
        );
    }

    #[test]
    fn slices_and_exposures_are_checked() {
        assert_eq!("x:0.25".parse(), Ok(SliceChoice { axis: SliceAxis::X, height: 0.25 }));
        for bad in ["x", "w:0.5", "x:1.5", "x:-0.1", "x:NaN", ":1"] {
            assert!(bad.parse::<SliceChoice>().is_err_and(|error| error.contains("0 to 1")), "{bad}");
        }
        assert_eq!("auto".parse(), Ok(Exposure(None)));
        assert_eq!("-2.5".parse(), Ok(Exposure(Some(-2.5))));
        assert!("bright".parse::<Exposure>().is_err_and(|error| error.contains("`auto`")));
    }
}
