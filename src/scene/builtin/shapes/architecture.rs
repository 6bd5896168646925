//! Building parts: floors, arches, stairs, mouldings, roofs' sheets and hung cloth.

use glam::{DVec2, DVec3};

use super::Shape;
use crate::scene::builtin::exact::{PI, TAU, atan2, cos, sin, smoothstep};

/// A level sheet around the origin that faces up; UVs are metres.
pub fn plane(x: f64, z: f64, columns: usize, rows: usize) -> Shape {
    Shape::grid(columns, rows, |u, v| {
        let place = DVec3::new((u - 0.5) * x, 0.0, (0.5 - v) * z);
        (place, DVec2::new(place.x, place.z))
    })
}

/// A level floor between a circle around the origin and a rectangle (`low` to `high` in x, z).
/// `cells` counts the steps along each side; UVs are metres.
pub fn floor_around(radius: f64, low: DVec2, high: DVec2, cells: usize, rings: usize) -> Shape {
    let corners = [low, DVec2::new(low.x, high.y), high, DVec2::new(high.x, low.y), low];
    Shape::grid(4 * cells, rings, |u, v| {
        let along = u * 4.0;
        let side = (along as usize).min(3);
        let edge = corners[side].lerp(corners[side + 1], along - side as f64);
        let place = edge.normalize() * radius * (1.0 - v) + edge * v;
        (DVec3::new(place.x, 0.0, place.y), place)
    })
    .flipped()
}

/// A wall from y = 0 to `height`, pierced by a half circle whose centre is the origin. It is as
/// wide as its bay; top and sides are open because neighbours cover them. UVs are metres.
pub fn arch(width: f64, height: f64, radius: f64, thickness: f64, segments: usize) -> Shape {
    let corner = atan2(height, width / 2.0);
    let flank = segments / 4;
    let angle = |u: f64| {
        let step = u * segments as f64;
        let (flank, middle) = (flank as f64, (segments - 2 * flank) as f64);
        if step <= flank {
            corner * step / flank
        } else if step <= flank + middle {
            corner + (PI - 2.0 * corner) * (step - flank) / middle
        } else {
            PI - corner * (segments as f64 - step) / flank
        }
    };
    let outer = |angle: f64| {
        let (sine, cosine) = (sin(angle), cos(angle));
        let to_side = if cosine == 0.0 { f64::MAX } else { width / 2.0 / cosine.abs() };
        let to_top = if sine <= 0.0 { f64::MAX } else { height / sine };
        to_side.min(to_top)
    };
    let place = |angle: f64, reach: f64, z: f64| DVec3::new(reach * cos(angle), reach * sin(angle).max(0.0), z);
    let face = |z: f64| {
        Shape::grid(segments, 1, |u, v| {
            let angle = angle(u);
            let position = place(angle, radius + (outer(angle) - radius) * v, z);
            (position, DVec2::new(position.x, -position.y))
        })
    };
    let inside = Shape::grid(segments, 1, |u, v| {
        let angle = angle(u);
        (place(angle, radius, thickness * (0.5 - v)), DVec2::new(angle * radius, v * thickness))
    });
    let foot = width / 2.0 - radius;
    let feet =
        [-1.0, 1.0].map(|side| plane(foot, thickness, 1, 1).flipped().moved(side * (radius + foot / 2.0), 0.0, 0.0));
    Shape::joined([face(thickness / 2.0).flipped(), face(-thickness / 2.0), inside].into_iter().chain(feet))
}

/// Steps that rise towards −Z, the foot of the first at the origin, closed at the sides.
pub fn stairs(width: f64, rise: f64, run: f64, steps: usize) -> Shape {
    let depth = run * steps as f64;
    Shape::joined((0..steps).flat_map(|step| {
        let (y, z) = (rise * step as f64, -run * step as f64);
        let riser = Shape::polygon(&[
            DVec3::new(-width / 2.0, y, z),
            DVec3::new(width / 2.0, y, z),
            DVec3::new(width / 2.0, y + rise, z),
            DVec3::new(-width / 2.0, y + rise, z),
        ]);
        let tread = plane(width, run, 1, 1).moved(0.0, y + rise, z - run / 2.0);
        let cheek = |x: f64| {
            Shape::polygon(&[
                DVec3::new(x, y, z),
                DVec3::new(x, y, -depth),
                DVec3::new(x, y + rise, -depth),
                DVec3::new(x, y + rise, z),
            ])
        };
        [riser, tread, cheek(width / 2.0), cheek(-width / 2.0).flipped()]
    }))
    .box_mapped(1.0)
}

/// Pulls a profile of (x, y) points along Z, centred. Outside is to the right of the profile's
/// direction seen from +Z. UVs are metres.
pub fn moulding(profile: &[[f64; 2]], length: f64, cells: usize) -> Shape {
    let rows = profile.len() - 1;
    Shape::grid(cells, rows, |u, v| {
        let [x, y] = profile[(v * rows as f64).round() as usize];
        (DVec3::new(x, y, (0.5 - u) * length), DVec2::ZERO)
    })
    .box_mapped(1.0)
}

/// A moulding closed at both ends, for convex profiles that end where they began.
pub fn bar(profile: &[[f64; 2]], length: f64) -> Shape {
    let end = |z: f64| {
        let mut corners: Vec<DVec3> = profile[1..].iter().map(|&[x, y]| DVec3::new(x, y, z)).collect();
        corners.reverse();
        Shape::polygon(&corners).box_mapped(1.0)
    };
    Shape::joined([moulding(profile, length, 1), end(-length / 2.0), end(length / 2.0).flipped()]).outward()
}

/// How a cloth hangs.
#[derive(Clone, Copy, Debug)]
pub struct Drape {
    pub width_m: f64,
    pub height_m: f64,
    /// Whole waves across the width.
    pub folds: f64,
    /// Depth of a fold at the hem; at the rod it is a third of it.
    pub fold_depth_m: f64,
    /// How far the middle of the hem hangs below its sides.
    pub point_m: f64,
    /// Shifts the folds, so that no two cloths are alike.
    pub phase: f64,
}

/// A cloth in the XY plane that hangs down from the origin; UVs are 0 to 1, v downwards.
pub fn cloth(drape: &Drape, columns: usize, rows: usize) -> Shape {
    Shape::grid(columns, rows, |u, v| {
        let down = 1.0 - v;
        let depth = drape.fold_depth_m * (0.33 + 0.67 * smoothstep(0.0, 0.8, down));
        let wave = sin(TAU * drape.folds * u + drape.phase + 0.6 * sin(2.2 * down + drape.phase));
        let slow = 0.5 * sin(TAU * 0.5 * drape.folds * u - 1.7 * down + 2.0 * drape.phase);
        let edge = (2.0 * u - 1.0).abs();
        let drop = drape.height_m - drape.point_m * edge;
        // The rod gathers the cloth; it spreads to its width further down.
        let spread = 0.93 + 0.07 * smoothstep(0.0, 0.5, down);
        let place = DVec3::new((u - 0.5) * drape.width_m * spread, -drop * down, depth * (wave + slow * down));
        (place, DVec2::new(u, down))
    })
}

/// A lean-to roof of round tiles over `x` from `-half_wall` to `half_wall`, from a wall at
/// z = 0 down to an eave at z = `depth`. Each end is cut along a valley to the eave's corner
/// (`low_end`, `high_end` in x). UVs are metres.
pub fn tiled_roof(half_wall: f64, low_end: f64, high_end: f64, depth: f64, drop: f64, tile_width: f64) -> Shape {
    let tiles = (2.0 * half_wall / tile_width).round();
    let arc = [0.0, 0.68, 0.97, 0.97, 0.68];
    let columns = tiles as usize * arc.len();
    Shape::grid(columns, 1, |u, v| {
        let x = (2.0 * u - 1.0) * half_wall;
        let reach = if x < low_end {
            (x + half_wall) / (low_end + half_wall)
        } else if x > high_end {
            (half_wall - x) / (half_wall - high_end)
        } else {
            1.0
        };
        let bulge = 0.3 * tile_width * arc[(u * columns as f64).round() as usize % arc.len()];
        let down = reach * (1.0 - v);
        (DVec3::new(x, bulge - drop * down, depth * down), DVec2::new(x, down * depth))
    })
}
