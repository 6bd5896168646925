//! Keys of a clip that make no sense: what can be read without them is read.

use super::nodes::{UNIT_TOLERANCE, unit_quaternion};
use crate::scene::{Channel, Interpolation, Property};

/// What was done to the keys of one channel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct KeyRepairs {
    /// Keys left out: their time or value is not finite, or their rotation is zero.
    left_out: usize,
    /// Keys that stood before an earlier one.
    moved: usize,
    /// Keys at the time of the one before.
    together: usize,
    /// By how much the length of a rotation differs from 1, at most.
    off_unit: f64,
}

/// Leaves out, sorts and normalises; as many values as keys must be there.
pub(super) fn repair(channel: &mut Channel) -> KeyRepairs {
    let width = channel.numbers_a_key();
    let rotates = channel.property == Property::Rotation;
    // The value of a spline's key lies between its tangents.
    let value = match channel.interpolation {
        Interpolation::CubicSpline => channel.property.width()..2 * channel.property.width(),
        _ => 0..width,
    };
    let mut keys: Vec<(f64, Vec<f64>)> =
        channel.times_secs.iter().copied().zip(channel.values.chunks_exact(width).map(<[f64]>::to_vec)).collect();
    let count = keys.len();
    keys.retain(|(time, numbers)| {
        let is_finite = time.is_finite() && numbers.iter().all(|number| number.is_finite());
        is_finite && (!rotates || length(&numbers[value.clone()]) > 0.0)
    });
    let left_out = count - keys.len();
    let moved = keys.windows(2).filter(|pair| pair[0].0 > pair[1].0).count();
    // Keys of one time stay in order: the value jumps there.
    keys.sort_by(|a, b| a.0.total_cmp(&b.0));
    let together = keys.windows(2).filter(|pair| pair[0].0 == pair[1].0).count();
    let mut off_unit: f64 = 0.0;
    for (_, numbers) in keys.iter_mut().filter(|_| rotates) {
        off_unit = off_unit.max((length(&numbers[value.clone()]) - 1.0).abs());
        // Splines are normalised after interpolation.
        if channel.interpolation != Interpolation::CubicSpline
            && let Some(unit) = unit_quaternion([numbers[0], numbers[1], numbers[2], numbers[3]])
        {
            numbers.copy_from_slice(&unit.to_array());
        }
    }
    channel.times_secs = keys.iter().map(|(time, _)| *time).collect();
    channel.values = keys.into_iter().flat_map(|(_, numbers)| numbers).collect();
    KeyRepairs { left_out, moved, together, off_unit }
}

fn length(numbers: &[f64]) -> f64 {
    numbers.iter().map(|number| number * number).sum::<f64>().sqrt()
}

impl KeyRepairs {
    /// What was done, in words.
    pub fn told(&self) -> Option<String> {
        let keys = |count| super::error::counted(count, "key", "keys");
        let mut parts = Vec::new();
        if self.left_out > 0 {
            parts.push(format!("{} without a finite time, value or rotation left out", keys(self.left_out)));
        }
        if self.moved > 0 {
            parts.push(format!("{} out of order; they are sorted by time", keys(self.moved)));
        }
        if self.together > 0 {
            parts.push(format!("{} at the time of the one before; the value jumps there", keys(self.together)));
        }
        if self.off_unit > UNIT_TOLERANCE {
            let off = self.off_unit;
            parts.push(format!("its rotations are not unit quaternions (off by {off:.3}); they are normalised"));
        }
        (!parts.is_empty()).then(|| parts.join("; "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn channel(times: &[f64], values: &[f64], property: Property) -> Channel {
        let (times_secs, values) = (times.to_vec(), values.to_vec());
        Channel { node: 0, property, interpolation: Interpolation::Linear, times_secs, values }
    }

    #[test]
    fn keys_that_make_sense_are_left_as_they_are() {
        let values = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0];
        let mut sound = channel(&[0.0, 1.0, 2.0], &values, Property::Scale);
        assert_eq!(repair(&mut sound).told(), None);
        assert_eq!((sound.times_secs, sound.values), (vec![0.0, 1.0, 2.0], values.to_vec()));
    }

    #[test]
    fn two_keys_of_one_time_are_a_jump() {
        let mut jump = channel(&[0.0, 1.0, 1.0], &[1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 9.0, 0.0, 0.0], Property::Translation);
        let told = repair(&mut jump).told();
        assert_eq!(told.as_deref(), Some("1 key at the time of the one before; the value jumps there"));
        let at = |time| jump.sample_vector(time).x;
        assert_eq!([at(0.0), at(0.5), at(1.0), at(2.0)], [1.0, 1.5, 9.0, 9.0]);
    }

    #[test]
    fn keys_without_a_number_go_and_others_are_sorted() {
        let values = [1.0, 1.0, 1.0, 2.0, 2.0, 2.0, f64::NAN, 0.0, 0.0, 3.0, 3.0, 3.0];
        let mut mixed = channel(&[0.0, 2.0, 1.5, 1.0], &values, Property::Translation);
        let told = repair(&mut mixed).told();
        let expected =
            "1 key without a finite time, value or rotation left out; 1 key out of order; they are sorted by time";
        assert_eq!(told.as_deref(), Some(expected));
        assert_eq!((mixed.times_secs, mixed.values[3]), (vec![0.0, 1.0, 2.0], 3.0));
    }

    #[test]
    fn rotations_are_made_unit_and_none_of_length_zero_is_kept() {
        let mut turns = channel(&[0.0, 1.0], &[0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0], Property::Rotation);
        let told = repair(&mut turns).told().expect("something is done");
        assert!(told.starts_with("1 key without") && told.ends_with("(off by 0.500); they are normalised"), "{told}");
        assert_eq!(turns.values, [0.0, 0.0, 0.0, 1.0]);
    }
}
