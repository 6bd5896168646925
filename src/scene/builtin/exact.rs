//! Arithmetic whose last bit is the same on every machine, so that generated files are too.
//!
//! Sine, cosine and arctangent come from the `libm` crate (plain Rust) because the system's
//! differ between platforms; `+ − × ÷ √` are exact by IEEE 754. What is written to a file is
//! rounded to a fixed step ([`rounded`]). Of glam's f64 types only operations without
//! trigonometry are used.

use glam::{DMat3, DQuat, DVec3};

use crate::scene::Trs;

pub use std::f64::consts::{PI, TAU};

/// Steps a unit of length or normal has in a generated file.
pub const STEPS: f64 = 8192.0;
/// Steps of quaternion components: finer, because they must stay unit.
pub const ROTATION_STEPS: f64 = 1_048_576.0;

pub fn sin(radians: f64) -> f64 {
    libm::sin(radians)
}

pub fn cos(radians: f64) -> f64 {
    libm::cos(radians)
}

pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// Rounds to a whole number of steps; `-0` becomes `0`.
pub fn rounded(value: f64, steps: f64) -> f32 {
    ((value * steps).round() / steps + 0.0) as f32
}

/// Turn about a unit axis.
pub fn turn(axis: DVec3, radians: f64) -> DQuat {
    let (sine, cosine) = (sin(radians / 2.0), cos(radians / 2.0));
    DQuat::from_xyzw(axis.x * sine, axis.y * sine, axis.z * sine, cosine)
}

/// Turns about X, then Y, then Z of the fixed frame.
pub fn turns(x: f64, y: f64, z: f64) -> DQuat {
    turn(DVec3::Z, z) * turn(DVec3::Y, y) * turn(DVec3::X, x)
}

/// Shortest normalised blend of two rotations; `share` 0 gives `a`, 1 gives `b`.
pub fn blend(a: DQuat, b: DQuat, share: f64) -> DQuat {
    let b = if a.dot(b) < 0.0 { -b } else { b };
    (a * (1.0 - share) + b * share).normalize()
}

/// 0 below `from`, 1 above `to`, smooth between.
pub fn smoothstep(from: f64, to: f64, value: f64) -> f64 {
    let t = ((value - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// A place without turn or scale.
pub fn at(x: f64, y: f64, z: f64) -> Trs {
    Trs { translation: DVec3::new(x, y, z), ..Trs::default() }
}

/// A place at `eye` whose −Z looks at `target`, as lights and cameras do.
pub fn facing(eye: DVec3, target: DVec3) -> Trs {
    let back = (eye - target).normalize();
    let right = DVec3::Y.cross(back).normalize();
    let rotation = DQuat::from_mat3(&DMat3::from_cols(right, back.cross(right), back)).normalize();
    Trs { rotation, ..at(eye.x, eye.y, eye.z) }
}

/// A place turned about an axis.
pub fn turned(place: Trs, axis: DVec3, radians: f64) -> Trs {
    Trs { rotation: turn(axis, radians), ..place }
}

/// A place with a scale, mirrored where a factor is negative.
pub fn scaled(place: Trs, x: f64, y: f64, z: f64) -> Trs {
    Trs { scale: DVec3::new(x, y, z), ..place }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sines_have_the_same_bits_everywhere() {
        assert_eq!(sin(1.0).to_bits(), 0x3FEA_ED54_8F09_0CEE);
        assert_eq!(cos(1.0).to_bits(), 0x3FE1_4A28_0FB5_068C);
        assert_eq!(atan2(1.0, 3.0).to_bits(), 0x3FD4_978F_A326_9EE1);
    }

    #[test]
    fn rounding_gives_whole_steps_and_no_negative_zero() {
        assert_eq!(rounded(0.1, 8192.0), 819.0 / 8192.0);
        assert_eq!(rounded(-1e-9, 8192.0).to_bits(), 0.0_f32.to_bits());
    }
}
