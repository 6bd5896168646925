//! Round shapes: profiles turned about Y, rings, and tubes along a path.

use glam::{DVec2, DVec3};

use super::Shape;
use crate::scene::builtin::exact::{TAU, cos, sin};

/// Turns a profile of (radius, height) points about Y. Outside is to the right of the
/// profile's direction: list a column from its foot to its top. UVs are metres.
pub fn lathe(profile: &[[f64; 2]], segments: usize) -> Shape {
    lathe_part(profile, segments, 0.0, 1.0)
}

/// As [`lathe`], from one angle to another, in turns counter-clockwise from +X seen from above.
pub fn lathe_part(profile: &[[f64; 2]], segments: usize, from_turns: f64, to_turns: f64) -> Shape {
    let points: Vec<DVec2> = profile.iter().map(|&point| DVec2::from_array(point)).collect();
    let mut along = vec![0.0];
    for pair in points.windows(2) {
        along.push(along[along.len() - 1] + pair[0].distance(pair[1]));
    }
    let widest = points.iter().fold(0.0, |widest: f64, point| widest.max(point.x));
    let rows = points.len() - 1;
    Shape::grid(segments, rows, |u, v| {
        let row = (v * rows as f64).round() as usize;
        // The last angle of a full turn is the first again, to the bit.
        let turns = from_turns + (to_turns - from_turns) * u;
        let angle = TAU * if turns == 1.0 && from_turns == 0.0 { 0.0 } else { turns };
        let DVec2 { x: radius, y: height } = points[row];
        let uv = DVec2::new(u * (to_turns - from_turns) * TAU * widest, -along[row]);
        (DVec3::new(radius * cos(angle), height, -radius * sin(angle)), uv)
    })
}

/// A closed cylinder that stands on the origin.
pub fn cylinder(radius: f64, height: f64, segments: usize) -> Shape {
    lathe(&[[0.0, 0.0], [radius, 0.0], [radius, height], [0.0, height]], segments)
}

/// A ring about Y.
pub fn torus(major_radius: f64, minor_radius: f64, segments: usize, sides: usize) -> Shape {
    let profile: Vec<[f64; 2]> = (0..=sides)
        .map(|side| TAU * (side % sides) as f64 / sides as f64)
        .map(|angle| [major_radius + minor_radius * cos(angle), minor_radius * sin(angle)])
        .collect();
    lathe(&profile, segments)
}

/// One cross-section of a tube: an ellipse around `centre` with half axes `right`, `forward`.
#[derive(Clone, Copy, Debug)]
pub struct Ring {
    pub centre: DVec3,
    pub right: DVec3,
    pub forward: DVec3,
}

impl Ring {
    /// A cross-section of a tube along Y.
    pub fn level(y: f64, half_width: f64, half_depth: f64, z: f64) -> Self {
        Self { centre: DVec3::new(0.0, y, z), right: DVec3::X * half_width, forward: DVec3::Z * half_depth }
    }

    /// A cross-section of a tube along X.
    pub fn across(x: f64, half_height: f64, half_depth: f64) -> Self {
        Self { centre: DVec3::X * x, right: DVec3::Y * half_height, forward: DVec3::Z * half_depth }
    }

    /// A cross-section of a tube along Z.
    pub fn along(z: f64, half_width: f64, half_height: f64, y: f64) -> Self {
        Self { centre: DVec3::new(0.0, y, z), right: DVec3::X * half_width, forward: DVec3::Y * half_height }
    }
}

/// A skin over cross-sections, the right side out; end with a ring of zero size to close it.
pub fn tube(rings: &[Ring], segments: usize) -> Shape {
    let rows = rings.len() - 1;
    Shape::grid(segments, rows, |u, v| {
        let ring = &rings[(v * rows as f64).round() as usize];
        let angle = if u == 1.0 { 0.0 } else { u * TAU };
        (ring.centre + ring.right * cos(angle) + ring.forward * sin(angle), DVec2::new(u, v))
    })
    .outward()
}

/// A round rope of constant thickness along a closed curve that lies near a plane.
pub fn loop_rope(curve: impl Fn(f64) -> DVec3, radius: f64, segments: usize, sides: usize) -> Shape {
    let rings: Vec<Ring> = (0..=segments)
        .map(|index| {
            let turns = (index % segments) as f64 / segments as f64;
            let step = 0.5 / segments as f64;
            let tangent = (curve(turns + step) - curve(turns - step)).normalize();
            let aside = (curve(turns + 0.25) - curve(turns - 0.25)).cross(curve(turns) - curve(turns + 0.5));
            let right = aside.normalize() * radius;
            Ring { centre: curve(turns), right, forward: tangent.cross(right) }
        })
        .collect();
    tube(&rings, sides)
}
