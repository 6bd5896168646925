//! `character`: one guard who walks, and turns. `dynamic`: any number of guards, each at another moment of its walk, and
//! as many rings and cubes that turn; all share their meshes.

use glam::DVec3;

use super::MakeError;
use super::character::gait::{Circle, wave};
use super::character::guard::Guards;
use super::character::skeleton::Pose;
use super::exact::{TAU, at, facing, turn};
use super::glb::{ClipWriter, GlbPart, GlbWriter, Paint, Track};
use super::shapes::round::torus;
use super::shapes::solid::block;

/// How many guards `dynamic` has at most.
pub const MOST: usize = 256;

/// The guards' walk: a lap, in which every foot is set down as often.
const LAP: Circle = Circle { radius_m: 0.75, lap_secs: 4.0, strides: 3.0, start_radians: 0.0 };
/// From one guard to the next.
const SPACING_M: f64 = 3.0;
/// A fraction of turns that never comes near a whole number of them soon.
const GOLDEN_TURN: f64 = 0.618_033_988_749_894_9;

pub fn character() -> Result<Vec<u8>, MakeError> {
    let mut glb = GlbWriter::default();
    let guard = Guards::new(&mut glb).add(&mut glb, "guard", &LAP.pose(0.0));
    let times = LAP.key_times();
    let (mut walk, mut turning) = (ClipWriter::new("walk"), ClipWriter::new("turn"));
    guard.animate(&mut walk, &times, |time| LAP.pose(time));
    guard.animate(&mut turning, &times, |time| {
        let turns = time / LAP.lap_secs;
        wave(DVec3::ZERO, TAU * (turns - turns.floor()), 0.0, 1.0)
    });
    glb.clip(walk);
    glb.clip(turning);
    add_sun(&mut glb);
    glb.finish("character")
}

/// `characters`: 1 to [`MOST`].
pub fn dynamic(characters: usize) -> Result<Vec<u8>, MakeError> {
    let mut glb = GlbWriter::default();
    let mut walk = ClipWriter::new("walk");
    let guards = Guards::new(&mut glb);
    let times = LAP.key_times();
    let side = (1..).find(|side| side * side >= characters).unwrap_or(1);
    let place = |number: usize| {
        let along = |cell: usize| SPACING_M * (cell as f64 - (side as f64 - 1.0) / 2.0);
        DVec3::new(along(number % side), 0.0, along(number / side))
    };
    for number in 0..characters {
        let pose = |time_secs| walking(number, characters, place(number), time_secs);
        guards.add(&mut glb, &format!("guard {}", number + 1), &pose(0.0)).animate(&mut walk, &times, pose);
    }
    add_movers(&mut glb, &mut walk, characters, place);
    glb.clip(walk);
    add_sun(&mut glb);
    glb.finish("dynamic")
}

/// No two are at the same moment of a stride, and each begins its lap elsewhere.
fn walking(number: usize, characters: usize, place: DVec3, time_secs: f64) -> Pose {
    let lap = Circle { start_radians: TAU * (GOLDEN_TURN * number as f64).fract(), ..LAP };
    let late_secs = LAP.lap_secs / LAP.strides * number as f64 / characters as f64;
    let mut pose = lap.pose(time_secs + late_secs);
    pose.root += place;
    pose
}

/// A ring or a cube above the middle of each guard's lap.
fn add_movers(glb: &mut GlbWriter, walk: &mut ClipWriter, count: usize, place: impl Fn(usize) -> DVec3) {
    let bronze = glb.material(
        "bronze",
        Paint { base_color: [0.86, 0.55, 0.24], roughness: 0.3, metallic: 1.0, ..Paint::default() },
    );
    let clay = glb.material("clay", Paint { base_color: [0.58, 0.23, 0.11], ..Paint::default() });
    let ring = glb.mesh("ring", &[GlbPart::new(torus(0.32, 0.10, 24, 12).shaded(50.0), bronze)]);
    let cube = glb.mesh("cube", &[GlbPart::new(block(0.42, 0.42, 0.42).shaded(30.0), clay)]);
    let quarters: Vec<f64> = (0..=4).map(|quarter| LAP.lap_secs * f64::from(quarter) / 4.0).collect();
    for number in 0..count {
        let (name, mesh) = if number % 2 == 0 { ("ring", ring) } else { ("cube", cube) };
        let above = place(number) + DVec3::Y * 2.3;
        let node = glb.show(None, &format!("{name} {}", number + 1), mesh, at(above.x, above.y, above.z));
        let axis = DVec3::new(1.0, GOLDEN_TURN * (number % 7) as f64, 0.5 * (number % 3) as f64).normalize();
        let begin = TAU * (GOLDEN_TURN * number as f64).fract();
        let turns = (0..=4).map(|quarter| turn(axis, begin + TAU * f64::from(quarter % 4) / 4.0)).collect();
        walk.track(node, &quarters, Track::Rotation(turns));
    }
}

fn add_sun(glb: &mut GlbWriter) {
    glb.sun("sun", facing(DVec3::new(6.5, 7.8, 4.6), DVec3::ZERO), [1.0, 0.96, 0.90], 10_000.0);
}
