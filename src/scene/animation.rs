//! Clips and channels, sampled in f64 as glTF defines it (appendix C of its specification).
//!
//! A time on a key gives the stored value as it is; before the first and after the last key the
//! value stays. Rotations take the shorter way, so that q and −q are the same key.

use std::array;

use glam::{DQuat, DVec3};

#[derive(Clone, Debug)]
pub struct Clip {
    pub name: String,
    /// Largest key time over its channels.
    pub duration_secs: f64,
    pub channels: Vec<Channel>,
}

impl Clip {
    /// Its key times and the moments half-way between, ascending; evenly picked, with the first and
    /// the last, where there are more than `limit` (at least 2).
    pub fn sample_times(&self, limit: usize) -> Vec<f64> {
        let mut keys: Vec<f64> = self.channels.iter().flat_map(|channel| &channel.times_secs).copied().collect();
        keys.sort_by(f64::total_cmp);
        keys.dedup();
        let halves = keys.windows(2).map(|pair| pair[0].midpoint(pair[1]));
        let mut times: Vec<f64> = keys.iter().copied().chain(halves).collect();
        times.sort_by(f64::total_cmp);
        if times.len() <= limit {
            return times;
        }
        (0..limit).map(|pick| times[pick * (times.len() - 1) / (limit - 1)]).collect()
    }
}

#[derive(Clone, Debug)]
pub struct Channel {
    pub node: usize,
    pub property: Property,
    pub interpolation: Interpolation,
    /// Seconds, never decreasing; at the time of several keys the value jumps.
    pub times_secs: Vec<f64>,
    /// Per key as many numbers as [`Property::width`] says; for CUBICSPLINE in-tangent, value, out-tangent.
    /// STEP and LINEAR rotations are unit quaternions, xyzw.
    pub values: Vec<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Property {
    Translation,
    Rotation,
    Scale,
    /// Of the node with all that is below it: 0 hides it.
    Visibility,
    /// One a morph target of the mesh that the node shows: no other node shows it.
    MorphWeights {
        mesh: usize,
        targets: usize,
    },
}

impl Property {
    /// As glTF calls it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Translation => "translation",
            Self::Rotation => "rotation",
            Self::Scale => "scale",
            Self::Visibility => "visibility",
            Self::MorphWeights { .. } => "morph weights",
        }
    }

    /// Numbers a value has.
    pub fn width(self) -> usize {
        match self {
            Self::Rotation => 4,
            Self::Translation | Self::Scale => 3,
            Self::Visibility => 1,
            Self::MorphWeights { targets, .. } => targets,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    Step,
    Linear,
    CubicSpline,
}

/// Where a time falls among the keys.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Place {
    At(usize),
    /// Between a key and the next: the fraction of the way and the interval's length in seconds.
    After {
        key: usize,
        fraction: f64,
        interval_secs: f64,
    },
}

/// Below this angle between two quaternions (radians on the unit sphere) their arc is straight to
/// far less than an f64 rounding, and the division by its sine loses more than it gains.
const STRAIGHT_ARC_RADIANS: f64 = 1e-6;

/// A spline through quaternions that is shorter than this has no direction left.
const SHORTEST_QUATERNION: f64 = 1e-9;

impl Channel {
    /// What sampling relies on; the cause in words where it does not hold.
    pub fn check(&self) -> Result<(), String> {
        self.check_count()?;
        if self.times_secs.is_empty() {
            return Err("has no keys".to_owned());
        }
        if let Some(key) = self.times_secs.iter().position(|time| !time.is_finite()) {
            return Err(format!("has a time at key {key} that is not finite"));
        }
        if let Some(key) = self.times_secs.windows(2).position(|pair| pair[0] > pair[1]) {
            let [before, after] = [self.times_secs[key], self.times_secs[key + 1]];
            return Err(format!("has key times that decrease: {before} s, then {after} s at key {}", key + 1));
        }
        match self.values.iter().position(|value| !value.is_finite()) {
            Some(at) => Err(format!("has a value at key {} that is not finite", at / self.numbers_a_key())),
            None => Ok(()),
        }
    }

    /// A value a key, or the cause in words.
    pub fn check_count(&self) -> Result<(), String> {
        let (keys, numbers) = (self.times_secs.len(), self.values.len());
        let expected = keys * self.numbers_a_key();
        match numbers == expected {
            true => Ok(()),
            false => Err(format!("has {numbers} numbers for {keys} keys, which need {expected}")),
        }
    }

    /// Translation or scale at a time; at the time of several keys the last one's.
    pub fn sample_vector(&self, time_secs: f64) -> DVec3 {
        let value = match self.place(time_secs) {
            Place::At(key) => self.value(key),
            Place::After { key, fraction, interval_secs } => match self.interpolation {
                Interpolation::Step => self.value(key),
                Interpolation::Linear => {
                    DVec3::from_array(self.value(key)).lerp(DVec3::from_array(self.value(key + 1)), fraction).to_array()
                }
                Interpolation::CubicSpline => self.spline(key, fraction, interval_secs),
            },
        };
        DVec3::from_array(value)
    }

    /// Morph weights at a time; at the time of several keys the last one's.
    pub fn sample_weights(&self, time_secs: f64) -> Vec<f64> {
        let width = self.property.width();
        let numbers = |key: usize, offset: usize| &self.values[key * self.numbers_a_key() + offset..][..width];
        let value = |key| numbers(key, if self.interpolation == Interpolation::CubicSpline { width } else { 0 });
        let (key, fraction, interval_secs) = match self.place(time_secs) {
            Place::At(key) => return value(key).to_vec(),
            Place::After { key, fraction, interval_secs } => (key, fraction, interval_secs),
        };
        let ends = value(key).iter().zip(value(key + 1));
        match self.interpolation {
            Interpolation::Step => value(key).to_vec(),
            Interpolation::Linear => ends.map(|(from, to)| from + (to - from) * fraction).collect(),
            Interpolation::CubicSpline => {
                let tangents = numbers(key, 2 * width).iter().zip(numbers(key + 1, 0));
                let lanes = ends.zip(tangents);
                lanes
                    .map(|((&from, &to), (&out, &into))| hermite([from, to], [out, into], fraction, interval_secs))
                    .collect()
            }
        }
    }

    /// The number of the last key: 0 where it hides. Steps, whatever lies between.
    pub fn sample_number(&self, time_secs: f64) -> f64 {
        let (Place::At(key) | Place::After { key, .. }) = self.place(time_secs);
        let [number] = self.value(key);
        number
    }

    /// Rotation at a time, of unit length.
    pub fn sample_rotation(&self, time_secs: f64) -> DQuat {
        let stored = |key| DQuat::from_array(self.value(key));
        match (self.place(time_secs), self.interpolation) {
            (Place::At(key) | Place::After { key, .. }, Interpolation::Step) => stored(key),
            (Place::At(key), Interpolation::Linear) => stored(key),
            (Place::At(key), Interpolation::CubicSpline) => unit(stored(key), DQuat::IDENTITY),
            (Place::After { key, fraction, .. }, Interpolation::Linear) => {
                slerp(stored(key), stored(key + 1), fraction)
            }
            (Place::After { key, fraction, interval_secs }, Interpolation::CubicSpline) => {
                let spline = DQuat::from_array(self.spline(key, fraction, interval_secs));
                unit(spline, unit(stored(key), DQuat::IDENTITY))
            }
        }
    }

    fn place(&self, time_secs: f64) -> Place {
        let times = &self.times_secs;
        let last = times.len() - 1;
        if time_secs.is_nan() || time_secs < times[0] {
            return Place::At(0);
        }
        if time_secs >= times[last] {
            return Place::At(last);
        }
        let key = times.partition_point(|&time| time <= time_secs) - 1;
        if times[key] == time_secs {
            return Place::At(key);
        }
        let interval_secs = times[key + 1] - times[key];
        Place::After { key, fraction: (time_secs - times[key]) / interval_secs, interval_secs }
    }

    pub fn numbers_a_key(&self) -> usize {
        match self.interpolation {
            Interpolation::CubicSpline => 3 * self.property.width(),
            _ => self.property.width(),
        }
    }

    /// The value of a key without its tangents.
    fn value<const N: usize>(&self, key: usize) -> [f64; N] {
        let tangent = if self.interpolation == Interpolation::CubicSpline { N } else { 0 };
        self.numbers(key, tangent)
    }

    fn numbers<const N: usize>(&self, key: usize, offset: usize) -> [f64; N] {
        let start = key * self.numbers_a_key() + offset;
        array::from_fn(|lane| self.values[start + lane])
    }

    /// A spline between a key and the next.
    fn spline<const N: usize>(&self, key: usize, t: f64, interval_secs: f64) -> [f64; N] {
        let (from, to): ([f64; N], [f64; N]) = (self.value(key), self.value(key + 1));
        let out_tangent: [f64; N] = self.numbers(key, 2 * N);
        let in_tangent: [f64; N] = self.numbers(key + 1, 0);
        array::from_fn(|lane| hermite([from[lane], to[lane]], [out_tangent[lane], in_tangent[lane]], t, interval_secs))
    }
}

/// Between two values with tangents, per second, out of the first and into the second.
fn hermite([from, to]: [f64; 2], [out_tangent, in_tangent]: [f64; 2], t: f64, interval_secs: f64) -> f64 {
    let (t2, t3) = (t * t, t * t * t);
    (2.0 * t3 - 3.0 * t2 + 1.0) * from
        + interval_secs * (t3 - 2.0 * t2 + t) * out_tangent
        + (-2.0 * t3 + 3.0 * t2) * to
        + interval_secs * (t3 - t2) * in_tangent
}

/// Spherical interpolation along the shorter arc. The same pose for `a` or −`a`, `b` or −`b`.
fn slerp(a: DQuat, b: DQuat, fraction: f64) -> DQuat {
    let b = b * nearer_sign(a, b);
    // Twice the angle of an isosceles triangle: exact near 0, where the arc cosine is not.
    let angle = 2.0 * (b - a).length().atan2((b + a).length());
    if angle < STRAIGHT_ARC_RADIANS {
        return unit(a * (1.0 - fraction) + b * fraction, a);
    }
    let sine = angle.sin();
    unit(a * (((1.0 - fraction) * angle).sin() / sine) + b * ((fraction * angle).sin() / sine), a)
}

/// +1 or −1 for `b`. Both ways round are equally long where the dot product is zero (a turn of
/// 180°); there the signs of the first components decide, so that q and −q stay one pose.
fn nearer_sign(a: DQuat, b: DQuat) -> f64 {
    let dot = a.dot(b);
    if dot != 0.0 {
        return dot.signum();
    }
    let leading_sign = |q: DQuat| q.to_array().into_iter().find(|&component| component != 0.0).map_or(1.0, f64::signum);
    leading_sign(a) * leading_sign(b)
}

fn unit(q: DQuat, fallback: DQuat) -> DQuat {
    let length = q.length();
    if length > SHORTEST_QUATERNION { q / length } else { fallback }
}
