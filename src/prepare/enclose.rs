//! The box that the grid encloses.

use super::{Preparation, PrepareError, Prepared};
use crate::scene::bounds::{Aabb, ClipBoxes, union};
use crate::scene::{Object, Scene, Warning};
use crate::settings::FitTo;

/// Something lies apart if leaving it out makes the rest so many times smaller …
const APART: f64 = 8.0;
/// … while it is this many times smaller than the rest.
const SMALLER: f64 = 4.0;
/// More of them are a scene of small things.
const MOST_APART: usize = 8;

/// Boxes are `None` where there is nothing to see.
pub struct Enclosed {
    pub bounds: Option<Aabb>,
    /// What of it is there when the clip begins.
    pub at_first: Option<Aabb>,
    /// What small things far away are left out, one each.
    pub warnings: Vec<Warning>,
}

/// `clip`: which one the preparation's motion plays. `reach`: the box of the scene over time. `earlier`: the same at
/// another moment, whose clip begins alike.
pub fn enclosed(
    scene: &Scene,
    preparation: &Preparation,
    clip: Option<usize>,
    reach: Option<Aabb>,
    earlier: Option<&Prepared>,
) -> Result<Enclosed, PrepareError> {
    let objects: Vec<Object> = scene.mesh_nodes().collect();
    let begin = || scene.boxes_at(&objects, &scene.pose(clip, 0.0));
    let (boxes, at_first) = match preparation.fit.to {
        FitTo::Box { min, max } => {
            let bounds = Some(Aabb { min, max });
            return Ok(Enclosed { bounds, at_first: bounds, warnings: Vec::new() });
        }
        FitTo::Scene => {
            let at_first = earlier.map_or_else(|| begin().into_iter().fold(None, union), |earlier| earlier.at_first);
            return Ok(Enclosed { bounds: reach, at_first, warnings: Vec::new() });
        }
        FitTo::Clip => {
            let ClipBoxes { at_first, over } = scene.boxes_over_clip(&objects, clip);
            (over, Some(at_first))
        }
        FitTo::Pose => (scene.boxes_at(&objects, &scene.pose(clip, preparation.motion.time_secs)), None),
    };
    let shown = preparation.fit.counted.shown_nodes(scene)?;
    let counted = |boxes: &[Option<Aabb>]| -> Vec<(usize, Aabb)> {
        let counted = (0..objects.len()).filter(|&object| shown[objects[object].node]);
        counted.filter_map(|object| Some((object, boxes[object]?))).collect()
    };
    let mut enclosed = counted(&boxes);
    let leaves_out = preparation.fit.counted.only.is_empty();
    let apart = if leaves_out { take_apart(&mut enclosed) } else { Vec::new() };
    let at_first = match (at_first, earlier) {
        (Some(at_first), _) => enclosed.iter().map(|(object, _)| at_first[*object]).fold(None, union),
        (None, Some(earlier)) => earlier.at_first,
        (None, None) => {
            let mut at_first = counted(&begin());
            if leaves_out {
                take_apart(&mut at_first);
            }
            around(&at_first)
        }
    };
    let warnings = apart.into_iter().map(|(object, times)| left_out(&objects[object], times)).collect();
    Ok(Enclosed { bounds: around(&enclosed), at_first, warnings })
}

fn left_out(object: &Object, times: f64) -> Warning {
    let sentence = format!(
        "object \"{}\" lies {times:.0} times the size of the rest away; the grid does not enclose it unless it is fit to the scene",
        object.name
    );
    Warning::new(sentence).at(object.node)
}

/// Takes out what is small and far from the rest; returns how many times the size of the rest it makes of the whole.
fn take_apart(boxes: &mut Vec<(usize, Aabb)>) -> Vec<(usize, f64)> {
    let (mut rest, mut apart) = (boxes.clone(), Vec::new());
    while let Some(taken) = take_strays(&mut rest) {
        apart.extend(taken);
    }
    if apart.len() > MOST_APART {
        return Vec::new();
    }
    *boxes = rest;
    apart
}

/// Takes out the fewest boxes whose absence leaves so much less, each far smaller than what is left: several, as two
/// on opposite sides hide each other. `None` where there are none such.
fn take_strays(boxes: &mut Vec<(usize, Aabb)>) -> Option<Vec<(usize, f64)>> {
    let extent = |bounds: &Aabb| bounds.size().max_element();
    let whole = extent(&around(boxes)?);
    let (mut rest, mut taken) = (boxes.clone(), Vec::<(usize, Aabb)>::new());
    while rest.len() > 1 && taken.len() <= MOST_APART {
        let left: Vec<f64> = unions_without(&rest).iter().map(extent).collect();
        let is_small = |place: &usize| left[*place] > 0.0 && SMALLER * extent(&rest[*place].1) <= left[*place];
        let least = |a: &usize, b: &usize| left[*a].total_cmp(&left[*b]);
        let place = (0..rest.len()).filter(is_small).min_by(least)?;
        taken.push(rest.remove(place));
        let all_are_small = taken.iter().all(|(_, bounds)| SMALLER * extent(bounds) <= left[place]);
        if all_are_small && whole >= APART * left[place] {
            *boxes = rest;
            return Some(taken.into_iter().map(|(object, _)| (object, whole / left[place])).collect());
        }
    }
    None
}

fn around(boxes: &[(usize, Aabb)]) -> Option<Aabb> {
    boxes.iter().fold(None, |all, (_, bounds)| union(all, Some(*bounds)))
}

/// Of each box: the box around all others. There are at least two.
fn unions_without(boxes: &[(usize, Aabb)]) -> Vec<Aabb> {
    let so_far = |all: &mut Option<Aabb>, bounds: &Aabb| {
        let before = *all;
        *all = union(*all, Some(*bounds));
        Some(before)
    };
    let before: Vec<Option<Aabb>> = boxes.iter().map(|(_, b)| b).scan(None, so_far).collect();
    let mut after: Vec<Option<Aabb>> = boxes.iter().rev().map(|(_, b)| b).scan(None, so_far).collect();
    after.reverse();
    before.into_iter().zip(after).filter_map(|(before, after)| union(before, after)).collect()
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    fn at(place: f64, size: f64) -> Aabb {
        Aabb { min: DVec3::splat(place), max: DVec3::splat(place + size) }
    }

    fn apart(boxes: &[Aabb]) -> Vec<usize> {
        let mut boxes = boxes.iter().copied().enumerate().collect();
        take_apart(&mut boxes).into_iter().map(|(object, _)| object).collect()
    }

    #[test]
    fn small_things_far_away_lie_apart_and_nothing_else_does() {
        assert_eq!(apart(&[at(0.0, 1.0), at(1000.0, 0.01)]), [1]);
        assert_eq!(apart(&[at(-500.0, 0.1), at(0.0, 1.0), at(1000.0, 0.01)]), [2, 0]);
        assert_eq!(apart(&[at(1e4, 100.0), at(0.0, 1.0), at(-5e3, 0.01)]), [0; 0], "no stray is larger than the rest");
        assert_eq!(apart(&[at(0.0, 1.0), at(1000.0, 1.0)]), [0; 0], "two of a kind");
        assert_eq!(apart(&[at(0.0, 1.0), at(5.0, 0.01)]), [0; 0], "near enough");
        assert_eq!(apart(&[at(0.0, 1.0), at(-500.0, 1000.0)]), [0; 0], "a sky around it");
        assert_eq!(apart(&[at(0.0, 1.0)]), [0; 0]);
        assert_eq!(apart(&[at(0.0, 0.0), at(0.0, 0.0), at(9.0, 0.0)]), [0; 0], "points have no size");
        let dust: Vec<Aabb> = (0..20).map(|grain| at(1000.0 * f64::from(grain * grain * grain), 0.01)).collect();
        assert_eq!(apart(&[&[at(0.0, 1.0)], &dust[1..]].concat()), [0; 0], "a scene of small things");
    }
}
