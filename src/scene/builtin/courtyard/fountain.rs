//! The fountain in the middle, and the armillary sphere that turns on it.

use glam::{DQuat, DVec3};
use gltf::json::{Index, Node};

use super::super::exact::{PI, TAU, at, turn};
use super::super::glb::{ClipWriter, GlbPart, GlbWriter, Track};
use super::super::shapes::Shape;
use super::super::shapes::round::{cylinder, lathe, torus};
use super::super::shapes::solid::{bevelled_block, icosphere, sphere};
use super::palette::Palette;
use super::walk::WALK_SECS;

/// Centre of the armillary sphere above the ground.
const HEART: f64 = 2.36;
const RING: f64 = 0.60;

pub fn add(glb: &mut GlbWriter, palette: &Palette, walk: &mut ClipWriter) {
    let group = glb.node(None, "fountain", at(0.0, 0.0, 0.0));
    let basin = basin().shaded(38.0);
    let water = Shape::joined([lathe(&[[1.12, 0.44], [0.0, 0.44]], 40), lathe(&[[0.47, 1.275], [0.0, 1.275]], 24)]);
    let mesh = glb.mesh(
        "basin",
        &[GlbPart::new(basin, palette.masonry.stone), GlbPart::new(water.shaded(30.0), palette.fittings.water)],
    );
    glb.show(Some(group), "basin", mesh, at(0.0, 0.0, 0.0));
    add_armillary(glb, palette, group, walk);
}

fn basin() -> Shape {
    let step = lathe(&[[1.62, 0.0], [1.62, 0.11], [1.60, 0.13], [1.20, 0.13]], 40);
    let bowl = lathe(
        &[
            [1.26, 0.13],
            [1.28, 0.20],
            [1.20, 0.25],
            [1.19, 0.38],
            [1.24, 0.44],
            [1.32, 0.47],
            [1.34, 0.51],
            [1.32, 0.55],
            [1.17, 0.55],
            [1.14, 0.53],
            [1.12, 0.30],
            [0.0, 0.30],
        ],
        40,
    );
    let stem = lathe(
        &[
            [0.34, 0.30],
            [0.34, 0.48],
            [0.30, 0.52],
            [0.20, 0.56],
            [0.15, 0.66],
            [0.17, 0.82],
            [0.21, 0.92],
            [0.17, 1.00],
            [0.12, 1.04],
            [0.16, 1.08],
            [0.30, 1.12],
            [0.46, 1.20],
            [0.54, 1.30],
            [0.545, 1.325],
            [0.52, 1.335],
            [0.49, 1.325],
            [0.47, 1.24],
            [0.12, 1.24],
            [0.10, 1.40],
            [0.13, 1.44],
            [0.13, 1.48],
            [0.07, 1.52],
            [0.0, 1.52],
        ],
        24,
    );
    Shape::joined([step, bowl, stem])
}

/// A fixed hoop; in it a ring that turns about upright pins; in that a heart that turns about a
/// level axle. A vane on top points to another of twelve marks every second.
fn add_armillary(glb: &mut GlbWriter, palette: &Palette, group: Index<Node>, walk: &mut ClipWriter) {
    let fittings = &palette.fittings;
    let hoop = glb.mesh("hoop", &[GlbPart::new(hoop().shaded(40.0), fittings.iron)]);
    let hoop = glb.show(Some(group), "hoop", hoop, at(0.0, HEART, 0.0));

    let axle = cylinder(0.018, 2.0 * RING, 10).moved(0.0, -RING, 0.0).turned(DVec3::Z, PI / 2.0).shaded(40.0);
    let ring = [GlbPart::new(ring().shaded(40.0), fittings.bronze), GlbPart::new(axle, fittings.iron)];
    let ring = glb.mesh("turning ring", &ring);
    let ring = glb.show(Some(hoop), "turning ring", ring, at(0.0, 0.0, 0.0));
    turn_evenly(walk, ring, DVec3::Y, 2);

    let heart = icosphere(0).scaled(0.31, 0.31, 0.31).shaded(20.0);
    let collar = cylinder(0.05, 0.60, 16).moved(0.0, -0.30, 0.0).turned(DVec3::Z, PI / 2.0).shaded(40.0);
    let heart = glb.mesh("heart", &[GlbPart::new(heart, fittings.silver), GlbPart::new(collar, fittings.bronze)]);
    let heart = glb.show(Some(ring), "heart", heart, at(0.0, 0.0, 0.0));
    turn_evenly(walk, heart, DVec3::X, 3);

    let vane = glb.mesh("vane", &[GlbPart::new(vane().shaded(40.0), fittings.bronze)]);
    let vane = glb.show(Some(hoop), "vane", vane, at(0.0, RING + 0.37, 0.0));
    let marks = [0, 3, 5, 4, 8, 11, 10, 6, 7, 2, 0];
    let times: Vec<f64> = (0..marks.len()).map(|mark| WALK_SECS * mark as f64 / (marks.len() - 1) as f64).collect();
    let keys = marks.iter().map(|&mark| turn(DVec3::Y, TAU * f64::from(mark) / 12.0)).collect();
    walk.track(vane, &times, Track::SteppedRotation(keys));
}

/// The fixed hoop with its foot, the pins for the ring and the rod for the vane.
fn hoop() -> Shape {
    let hoop = torus(RING + 0.13, 0.035, 40, 8).turned(DVec3::X, PI / 2.0);
    let pins = [-1.0, 1.0].map(|side| cylinder(0.022, 0.14, 10).moved(0.0, side * (RING + 0.06) - 0.07, 0.0));
    let foot = lathe(&[[0.10, -0.86], [0.05, -RING - 0.20], [0.06, -RING - 0.15]], 16);
    let rod = cylinder(0.018, 0.22, 8).moved(0.0, RING + 0.14, 0.0);
    Shape::joined([hoop, foot, rod].into_iter().chain(pins))
}

/// A ring with studs, so that one sees it turn.
fn ring() -> Shape {
    let ring = torus(RING, 0.05, 40, 10).turned(DVec3::X, PI / 2.0);
    let studs = (0..8).map(|index| {
        let angle = TAU * (f64::from(index) + 0.5) / 8.0;
        sphere(6, 4).scaled(0.035, 0.035, 0.075).moved(RING, 0.0, 0.0).turned(DVec3::Z, angle)
    });
    Shape::joined([ring].into_iter().chain(studs))
}

/// An arrow that points along +X.
fn vane() -> Shape {
    let shaft = bevelled_block(0.42, 0.02, 0.03, 0.006).moved(0.05, 0.0, 0.0);
    let tip = lathe(&[[0.0, 0.0], [0.05, 0.0], [0.0, 0.14]], 4).scaled(1.0, 1.0, 0.4);
    let tail = bevelled_block(0.12, 0.10, 0.014, 0.005).moved(-0.17, 0.0, 0.0);
    let knob = sphere(12, 8).scaled(0.04, 0.04, 0.04);
    Shape::joined([shaft, tip.turned(DVec3::Z, -PI / 2.0).moved(0.25, 0.0, 0.0), tail, knob])
}

/// Whole turns over the clip, in eighths that LINEAR interpolation joins without a kink.
pub fn turn_evenly(clip: &mut ClipWriter, node: Index<Node>, axis: DVec3, rounds: u32) {
    let steps = rounds * 8;
    let times: Vec<f64> = (0..=steps).map(|step| WALK_SECS * f64::from(step) / f64::from(steps)).collect();
    let keys: Vec<DQuat> = (0..=steps).map(|step| turn(axis, TAU * f64::from(step % 8) / 8.0)).collect();
    clip.track(node, &times, Track::Rotation(keys));
}
