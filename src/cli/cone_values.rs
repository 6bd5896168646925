//! What options of cones take.

use std::str::FromStr;

use serde::Deserialize;

use super::values::{Size, number};

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Switch {
    On,
    Off,
}

/// Scene units; `None` inside: a share of the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OcclusionDistance(pub Option<f64>);

impl FromStr for OcclusionDistance {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "auto" => Ok(Self(None)),
            length => number(length)
                .map(|length| Self(Some(length)))
                .map_err(|_| "a number of scene units, or `auto`, is wanted".to_owned()),
        }
    }
}

/// `None` inside: as large as the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IndirectSize(pub Option<[u32; 2]>);

impl FromStr for IndirectSize {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "picture" => Ok(Self(None)),
            size => {
                let Size(size_px) = size.parse().map_err(|error| format!("{error}, or `picture`"))?;
                Ok(Self(Some(size_px)))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_automatic_has_a_name() {
        assert_eq!("auto".parse(), Ok(OcclusionDistance(None)));
        assert_eq!("2.5".parse(), Ok(OcclusionDistance(Some(2.5))));
        assert!("far".parse::<OcclusionDistance>().is_err_and(|error| error.contains("`auto`")));
        assert_eq!("picture".parse(), Ok(IndirectSize(None)));
        assert_eq!("1280x720".parse(), Ok(IndirectSize(Some([1280, 720]))));
        assert!("half".parse::<IndirectSize>().is_err_and(|error| error.contains("`picture`")));
    }
}
