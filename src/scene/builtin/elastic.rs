//! `elastic`: what no rigid motion of voxels can show, beside what one can. A heart whose joints scale, a ball that
//! morph targets reshape, a block that is squeezed, and a ring that only turns.

use glam::DVec3;

use super::MakeError;
use super::exact::{PI, TAU, at, cos, facing, sin, turn};
use super::glb::{ClipWriter, GlbPart, GlbWriter, Influence, Paint, Track};
use super::shapes::Shape;
use super::shapes::round::torus;
use super::shapes::solid::{block, icosphere};

/// A beat, a squeeze and a turn.
const LOOP_SECS: f64 = 2.0;

pub fn make() -> Result<Vec<u8>, MakeError> {
    let mut glb = GlbWriter::default();
    let mut clip = ClipWriter::new("loop");
    let stone = glb.material("stone", Paint { base_color: [0.55, 0.52, 0.47], ..Paint::default() });
    let floor = glb.mesh("floor", &[GlbPart::new(block(6.4, 0.2, 2.4).shaded(30.0), stone)]);
    glb.show(None, "floor", floor, at(0.0, -0.1, 0.0));
    add_heart(&mut glb, &mut clip);
    add_ball(&mut glb, &mut clip);
    add_block(&mut glb, &mut clip);
    add_ring(&mut glb, &mut clip);
    glb.clip(clip);
    glb.sun("sun", facing(DVec3::new(3.5, 6.0, 5.0), DVec3::ZERO), [1.0, 0.96, 0.90], 10_000.0);
    glb.camera("view", facing(DVec3::new(0.9, 2.1, 6.2), DVec3::new(0.0, 0.75, 0.0)), 0.72);
    glb.finish("elastic")
}

/// Moments of a loop, the first and the last alike.
fn moments(count: usize) -> Vec<f64> {
    (0..=count).map(|moment| LOOP_SECS * moment as f64 / count as f64).collect()
}

/// A curve through its two lobes and its tip, and round about: 1.6 wide, 1.5 high and 0.8 deep about its middle.
fn heart() -> Shape {
    let curve = |t: f64| {
        let side = sin(t);
        let height = 13.0 * cos(t) - 5.0 * cos(2.0 * t) - 2.0 * cos(3.0 * t) - cos(4.0 * t);
        DVec3::new(0.8 * side * side * side, height / 20.0, 0.0)
    };
    let point = |u: f64, v: f64| {
        let around = curve(TAU * u) * sin(PI * v);
        (around + DVec3::Z * (0.4 * cos(PI * v)), glam::DVec2::new(u, v))
    };
    Shape::grid(64, 24, point).outward()
}

/// Its lower and its upper half hang on a joint each; both swell, one after the other.
fn add_heart(glb: &mut GlbWriter, clip: &mut ClipWriter) {
    let red = glb.material("red", Paint { base_color: [0.72, 0.04, 0.07], roughness: 0.35, ..Paint::default() });
    let surface = heart().shaded(60.0);
    let influences = surface.positions.iter().map(|position| {
        let upper = ((position.y + 0.4).clamp(0.0, 0.8) / 0.8 * 255.0).round() as u8;
        Influence { joints: [0, 1, 0, 0], weights: [255 - upper, upper, 0, 0] }
    });
    let influences = influences.collect();
    let mesh = glb.mesh("heart", &[GlbPart { influences, ..GlbPart::new(surface, red) }]);
    let root = glb.node(None, "heart's place", at(-1.9, 0.95, 0.0));
    let binds = [DVec3::new(0.0, -0.4, 0.0), DVec3::new(0.0, 0.3, 0.0)];
    let names = ["tip", "lobes"];
    let joints = [0, 1].map(|joint| {
        let DVec3 { x, y, z } = binds[joint];
        glb.node(Some(root), names[joint], at(x, y, z))
    });
    let times = moments(8);
    for (late, joint) in joints.into_iter().enumerate() {
        let size = |time: f64| 0.75 + 0.5 * sin(TAU * time / LOOP_SECS - 0.8 * late as f64);
        clip.track(joint, &times, Track::Scale(times.iter().map(|&time| DVec3::splat(size(time))).collect()));
    }
    let skin = glb.skin("heart", &joints, &binds);
    let node = glb.show(None, "heart", mesh, at(0.0, 0.0, 0.0));
    glb.bind_skin(node, skin);
}

/// From a ball to a pear and to a cube, and back.
fn add_ball(glb: &mut GlbWriter, clip: &mut ClipWriter) {
    let blue = glb.material("blue", Paint { base_color: [0.08, 0.25, 0.62], roughness: 0.5, ..Paint::default() });
    let surface = icosphere(4).scaled(0.5, 0.5, 0.5).shaded(60.0);
    let pear = |p: DVec3| DVec3::new(p.x, 0.0, p.z) * (-0.9 * (p.y + 0.5)) + DVec3::Y * (0.6 * (p.y + 0.5));
    let cube = |p: DVec3| p * (0.5 / p.abs().max_element() - 1.0);
    let targets = [pear, cube].map(|displaced: fn(DVec3) -> DVec3| {
        let moved = surface.positions.iter().map(|&position| displaced(position));
        moved.collect()
    });
    let mesh = glb.mesh("ball", &[GlbPart { targets: targets.to_vec(), ..GlbPart::new(surface, blue) }]);
    let node = glb.show(None, "ball", mesh, at(-0.45, 0.55, 0.0));
    let times = moments(4);
    let weights = [[0.0, 0.0], [1.0, 0.0], [0.0, 0.0], [0.0, 1.0], [0.0, 0.0]];
    clip.track(node, &times, Track::MorphWeights(weights.as_flattened().to_vec()));
}

/// Squeezed as a whole, and turned meanwhile: each alone would be no rigid motion of its voxels.
fn add_block(glb: &mut GlbWriter, clip: &mut ClipWriter) {
    let green = glb.material("green", Paint { base_color: [0.10, 0.42, 0.14], ..Paint::default() });
    let mesh = glb.mesh("block", &[GlbPart::new(block(0.8, 0.8, 0.8).shaded(30.0), green)]);
    let node = glb.show(None, "block", mesh, at(0.85, 0.6, 0.0));
    let times = moments(8);
    let squeezed = times.iter().map(|&time| {
        let wave = 0.45 * sin(TAU * time / LOOP_SECS);
        DVec3::new(1.0 + wave, 1.0 - wave, 1.0)
    });
    clip.track(node, &times, Track::Scale(squeezed.collect()));
    clip.track(
        node,
        &times,
        Track::Rotation(times.iter().map(|&time| turn(DVec3::Y, PI * time / LOOP_SECS)).collect()),
    );
}

fn add_ring(glb: &mut GlbWriter, clip: &mut ClipWriter) {
    let bronze = Paint { base_color: [0.86, 0.55, 0.24], roughness: 0.3, metallic: 1.0, ..Paint::default() };
    let bronze = glb.material("bronze", bronze);
    let mesh = glb.mesh("ring", &[GlbPart::new(torus(0.42, 0.14, 48, 24).shaded(50.0), bronze)]);
    let node = glb.show(None, "ring", mesh, at(2.2, 0.65, 0.0));
    let times = moments(4);
    let axis = DVec3::new(1.0, 0.4, 0.2).normalize();
    clip.track(node, &times, Track::Rotation(times.iter().map(|&time| turn(axis, TAU * time / LOOP_SECS)).collect()));
}
