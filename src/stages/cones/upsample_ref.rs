//! Reference of `upsample`: one pixel between the four of a small image around it, in f64.

use glam::DVec4;

use super::LEAST_WEIGHT;
use super::blur_ref::{FilterPoint, alike};

/// The pixel of the surfaces that pixel `i` of `small` along an axis belongs to.
pub fn source(i: u32, small: u32, large: u32) -> u32 {
    (f64::from(2 * i + 1) * f64::from(large) / f64::from(2 * small)).floor() as u32
}

/// Along an axis: the pixels of the small image around pixel `x`, and the share of the second.
pub fn around(x: u32, small: u32, large: u32) -> ([u32; 2], f64) {
    let before = (0..small).take_while(|i| source(*i, small, large) <= x).count() as u32;
    let (near, far) = (before.saturating_sub(1), before.min(small - 1));
    let (from, to) = (f64::from(source(near, small, large)), f64::from(source(far, small, large)));
    let share = if near == far { 0.0 } else { ((f64::from(x) - from) / (to - from)).clamp(0.0, 1.0) };
    ([near, far], share)
}

/// A pixel of the small image around: its part by distance alone, its surface, its value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Around {
    pub part: f64,
    pub point: Option<FilterPoint>,
    pub value: DVec4,
}

/// The value at a surface: weighted by parts and likeness; of the nearest in depth where no weight is left.
/// `None` where there is no surface around.
pub fn upsample(point: &FilterPoint, around: &[Around], width_cells: f64) -> Option<DVec4> {
    let there = || around.iter().filter_map(|a| Some((a, a.point?)));
    let weight = |(a, other): (&Around, FilterPoint)| {
        let w = a.part * alike(point, &other, width_cells);
        if w < LEAST_WEIGHT { 0.0 } else { w }
    };
    let weights: f64 = there().map(weight).sum();
    if weights > 0.0 {
        return Some(there().map(|(a, other)| a.value * weight((a, other))).sum::<DVec4>() / weights);
    }
    let away = |(_, other): &(&Around, FilterPoint)| (other.distance - point.distance).abs();
    there().min_by(|a, b| away(a).total_cmp(&away(b))).map(|(a, _)| a.value)
}
