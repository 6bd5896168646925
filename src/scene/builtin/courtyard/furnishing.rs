//! What hangs and stands about: banners, lanterns, pots, lion heads, a cube on its corner.

use glam::{DQuat, DVec3};

use super::super::exact::{PI, TAU, at, atan2, cos, scaled, sin, smoothstep, turn, turned};
use super::super::glb::{ClipWriter, GlbPart, GlbWriter, Track};
use super::super::shapes::Shape;
use super::super::shapes::architecture::{Drape, cloth};
use super::super::shapes::round::{cylinder, lathe, torus};
use super::super::shapes::solid::{bevelled_block, icosphere, sphere};
use super::building::{ARCH_RADIUS, ARCH_THICKNESS, BACK_Z, BAY, SIDE_X, SPRING, WALL};
use super::fountain::turn_evenly;
use super::palette::Palette;
use super::walk::WALK_SECS;
use crate::scene::Trs;

pub fn add(glb: &mut GlbWriter, palette: &Palette, walk: &mut ClipWriter) {
    add_banners(glb, palette);
    add_lanterns(glb, palette, walk);
    add_pots(glb, palette);
    add_lions(glb, palette);
    add_cube(glb, palette, walk);
}

/// Where banners hang: name, x, z, turn about Y, which cloth.
fn banner_places() -> Vec<(&'static str, Trs, usize)> {
    let side = |x: f64, bay: f64| at(x, SPRING - 0.10, BACK_Z + BAY * (bay + 0.5));
    let left = |bay: f64| turned(side(-SIDE_X, bay), DVec3::Y, PI / 2.0);
    let right = |bay: f64| turned(side(SIDE_X, bay), DVec3::Y, -PI / 2.0);
    let back = |bay: f64| at(BAY * bay, SPRING - 0.10, BACK_Z);
    vec![
        ("banner left 1", left(0.0), 1),
        ("banner left 2", left(2.0), 2),
        ("banner right 1", right(0.0), 2),
        ("banner right 2", right(2.0), 0),
        ("banner back 1", back(-1.0), 0),
        ("banner back 2", back(1.0), 1),
    ]
}

fn add_banners(glb: &mut GlbWriter, palette: &Palette) {
    let group = glb.node(None, "banners", at(0.0, 0.0, 0.0));
    let rod =
        cylinder(0.022, 2.0 * ARCH_RADIUS + 0.2, 10).moved(0.0, -ARCH_RADIUS - 0.1, 0.0).turned(DVec3::Z, PI / 2.0);
    let rod = GlbPart::new(rod.shaded(40.0), palette.fittings.iron);
    let mut meshes = Vec::new();
    for (index, &material) in palette.banners.iter().enumerate() {
        let drape = Drape {
            width_m: 1.55,
            height_m: 1.95,
            folds: [5.0, 4.0, 6.0][index],
            fold_depth_m: [0.075, 0.09, 0.06][index],
            point_m: [0.22, 0.0, 0.30][index],
            phase: 1.3 * index as f64,
        };
        let sheet = GlbPart::new(cloth(&drape, 28, 8).moved(0.0, -0.02, 0.0).shaded(80.0), material);
        meshes.push(glb.mesh(["crimson banner", "teal banner", "ochre banner"][index], &[sheet, rod.clone()]));
    }
    for (name, place, cloth) in banner_places() {
        glb.show(Some(group), name, meshes[cloth], place);
    }
}

/// A lantern below its hook: chain, cap, glowing glass in a cage.
fn lantern(palette: &Palette, chain_m: f64) -> [GlbPart; 2] {
    let chain = cylinder(0.012, chain_m, 6).moved(0.0, -chain_m, 0.0);
    let cap = lathe(&[[0.15, -0.02], [0.16, 0.0], [0.10, 0.06], [0.05, 0.09], [0.03, 0.12], [0.0, 0.13]], 6);
    let base = lathe(&[[0.0, -0.06], [0.05, -0.05], [0.13, -0.01], [0.14, 0.02], [0.0, 0.02]], 6);
    let bars = (0..6).map(|index| {
        let angle = TAU * f64::from(index) / 6.0;
        cylinder(0.012, 0.34, 6).moved(0.13 * cos(angle), -chain_m - 0.45, -0.13 * sin(angle))
    });
    let cage = [chain, cap.moved(0.0, -chain_m - 0.12, 0.0), base.moved(0.0, -chain_m - 0.47, 0.0)];
    let glass = lathe(&[[0.10, 0.0], [0.115, 0.16], [0.10, 0.32]], 6).moved(0.0, -chain_m - 0.45, 0.0);
    [
        GlbPart::new(Shape::joined(cage.into_iter().chain(bars)).shaded(30.0), palette.fittings.iron),
        GlbPart::new(glass.shaded(30.0), palette.fittings.lamp),
    ]
}

fn add_lanterns(glb: &mut GlbWriter, palette: &Palette, walk: &mut ClipWriter) {
    let group = glb.node(None, "lanterns", at(0.0, 0.0, 0.0));
    let short = glb.mesh("lantern", &lantern(palette, 0.42));
    let crown = SPRING + ARCH_RADIUS;
    let swinging = glb.show(Some(group), "swinging lantern", short, at(0.0, crown, BACK_Z));
    let x = (WALL + SIDE_X + ARCH_THICKNESS / 2.0) / 2.0;
    for (name, sign) in [("left lantern", -1.0), ("right lantern", 1.0)] {
        // Under the beam in the middle of the second bay.
        glb.show(Some(group), name, short, at(sign * x, 4.14, BACK_Z + 1.5 * BAY));
    }

    // A pendulum by its turning points: zero tangents there make a smooth swing.
    let swings = 8;
    let times: Vec<f64> = (0..=swings).map(|key| WALK_SECS * f64::from(key) / f64::from(swings)).collect();
    let still = DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0);
    let keys = (0..=swings).map(|key| {
        let tilt = if key % 2 == 0 { 0.16 } else { -0.16 };
        [still, turn(DVec3::X, tilt), still]
    });
    walk.track(swinging, &times, Track::SplineRotation(keys.collect()));
}

fn add_pots(glb: &mut GlbWriter, palette: &Palette) {
    let group = glb.node(None, "pots", at(0.0, 0.0, 0.0));
    let pot = lathe(
        &[
            [0.0, 0.0],
            [0.17, 0.0],
            [0.18, 0.03],
            [0.22, 0.14],
            [0.275, 0.30],
            [0.28, 0.38],
            [0.26, 0.44],
            [0.30, 0.46],
            [0.31, 0.50],
            [0.29, 0.52],
            [0.25, 0.50],
            [0.24, 0.44],
            [0.0, 0.44],
        ],
        18,
    );
    let pot = GlbPart::new(pot.shaded(40.0), palette.fittings.clay);
    let tree = Shape::grid(12, 10, |u, v| {
        let (angle, up) = (TAU * if u == 1.0 { 0.0 } else { u }, v);
        let bump = 1.0 + 0.09 * sin(5.0 * angle + 9.0 * up) * sin(16.0 * up + 2.0 * angle);
        let radius = 0.25 * bump * smoothstep(-0.02, 0.22, up) * smoothstep(1.06, 0.2, up);
        (DVec3::new(radius * cos(angle), 0.46 + 1.25 * up, -radius * sin(angle)), glam::DVec2::new(u, up))
    });
    let trunk = cylinder(0.03, 0.2, 8).moved(0.0, 0.40, 0.0);
    let mesh = glb.mesh(
        "cypress",
        &[
            pot,
            GlbPart::new(tree.shaded(60.0), palette.fittings.leaves),
            GlbPart::new(trunk.shaded(40.0), palette.masonry.wood),
        ],
    );
    let places = [(-3.45, 5.9, 1.0), (-3.5, -3.75, 1.15), (3.5, -3.75, 1.0), (3.45, 2.0, 0.9)];
    for (index, (x, z, height)) in places.into_iter().enumerate() {
        glb.show(Some(group), &format!("cypress {}", index + 1), mesh, scaled(at(x, 0.0, z), 1.0, height, 1.0));
    }
}

/// A lion's head that looks a little to +X, a ring in its mouth; the wall is at z = 0.
fn lion(palette: &Palette) -> [GlbPart; 2] {
    let lump = |x: f64, y: f64, z: f64, size: [f64; 3]| {
        icosphere(if size[0] > 0.12 { 2 } else { 1 }).scaled(size[0], size[1], size[2]).moved(x, y, z)
    };
    // Two layers of rounded locks, the inner one between those of the outer.
    let mane = |reach: f64, z: f64, phase: f64| {
        sphere(36, 5).turned(DVec3::X, PI / 2.0).mapped(|point| {
            let radius = point.truncate().length();
            let lock = 1.0 + 0.13 * radius * sin(9.0 * atan2(point.y, point.x) + phase);
            DVec3::new(point.x * reach * lock, point.y * reach * lock - 0.01, z + 0.08 * point.z)
        })
    };
    let brow = |side: f64| {
        lump(0.0, 0.0, 0.0, [0.062, 0.024, 0.035]).turned(DVec3::Z, side * 0.35).moved(side * 0.075, 0.085, 0.205)
    };
    let face = Shape::joined([
        lump(0.0, 0.03, 0.13, [0.165, 0.165, 0.10]),
        lump(0.0, 0.02, 0.215, [0.042, 0.105, 0.045]),
        lump(0.0, -0.045, 0.262, [0.050, 0.026, 0.030]),
        lump(-0.050, -0.085, 0.220, [0.068, 0.052, 0.062]),
        lump(0.050, -0.085, 0.220, [0.068, 0.052, 0.062]),
        lump(0.0, -0.150, 0.180, [0.060, 0.040, 0.065]),
        lump(-0.070, 0.045, 0.205, [0.026, 0.020, 0.020]),
        lump(0.070, 0.045, 0.205, [0.026, 0.020, 0.020]),
        lump(-0.150, 0.160, 0.125, [0.052, 0.058, 0.030]),
        lump(0.150, 0.160, 0.125, [0.052, 0.058, 0.030]),
        brow(-1.0),
        brow(1.0),
    ])
    .turned(DVec3::Y, 0.30);
    let ring = torus(0.095, 0.015, 16, 6).turned(DVec3::X, PI / 2.0 - 0.25).moved(0.06, -0.205, 0.20);
    let stone = Shape::joined([mane(0.285, 0.03, 0.0), mane(0.225, 0.09, PI), face]);
    [GlbPart::new(stone.shaded(70.0), palette.masonry.stone), GlbPart::new(ring.shaded(60.0), palette.fittings.bronze)]
}

fn add_lions(glb: &mut GlbWriter, palette: &Palette) {
    let mesh = glb.mesh("lion", &lion(palette));
    let z = BACK_Z + ARCH_THICKNESS / 2.0;
    let place = |x: f64| at(x, SPRING + 0.98, z);
    glb.show(None, "lion", mesh, scaled(place(-BAY / 2.0), 1.0, 1.1, 1.0));
    glb.show(None, "mirrored lion", mesh, scaled(place(BAY / 2.0), -1.0, 1.1, 1.0));
}

fn add_cube(glb: &mut GlbWriter, palette: &Palette, walk: &mut ClipWriter) {
    let plinth = [
        bevelled_block(0.62, 0.12, 0.62, 0.02).moved(0.0, 0.06, 0.0),
        bevelled_block(0.48, 0.62, 0.48, 0.02).moved(0.0, 0.42, 0.0),
        bevelled_block(0.58, 0.09, 0.58, 0.025).moved(0.0, 0.765, 0.0),
        cylinder(0.03, 0.10, 10).moved(0.0, 0.79, 0.0),
    ];
    let plinth = glb.mesh(
        "plinth",
        &[GlbPart::new(Shape::joined(plinth).box_mapped(1.0).shaded(40.0), palette.masonry.dark_stone)],
    );
    let plinth = glb.show(None, "plinth", plinth, at(-3.2, 0.0, 1.95));
    let edge = 0.40;
    // From its resting corner the cube's diagonal rises straight up.
    let lean = DQuat::from_rotation_arc(DVec3::ONE.normalize(), DVec3::Y);
    let cube = bevelled_block(edge, edge, edge, 0.03).mapped(|point| lean * point);
    let cube = glb.mesh("cube", &[GlbPart::new(cube.shaded(20.0), palette.fittings.bronze)]);
    let cube = glb.show(Some(plinth), "cube", cube, at(0.0, 0.87 + edge * 3.0_f64.sqrt() / 2.0 - 0.03, 0.0));
    turn_evenly(walk, cube, DVec3::Y, 1);
}
