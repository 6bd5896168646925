//! The four outer walls with what is fixed to them: dado, copings, brackets, portals.

use glam::DVec3;
use gltf::json::{Index, Mesh};

use super::super::exact::{PI, TAU, at, cos, scaled, sin, turned};
use super::super::glb::{GlbWriter, Part};
use super::super::shapes::Shape;
use super::super::shapes::architecture::{bar, moulding, stairs};
use super::super::shapes::round::{cylinder, lathe_part, torus};
use super::super::shapes::solid::{bevelled_block, block};
use super::building::{ROOF_TOP, STEP, WALL};
use super::palette::Palette;

const TOP: f64 = 6.86;
const THICKNESS: f64 = 0.3;

/// The walls' turns about Y from the back wall, whose inside looks along +Z.
const SIDES: [(&str, f64); 4] = [("back", 0.0), ("left", 0.25), ("front", 0.5), ("right", 0.75)];

pub fn add(glb: &mut GlbWriter, palette: &Palette) {
    let group = glb.node(None, "walls", at(0.0, 0.0, 0.0));
    let paints = [palette.brick, palette.red_wall, palette.cream_wall, palette.blue_wall];
    let length = 2.0 * WALL + 2.0 * THICKNESS;
    let coping = moulding(
        &[
            [-0.02, -0.20],
            [0.05, -0.19],
            [0.12, -0.12],
            [0.14, -0.11],
            [0.14, 0.0],
            [0.0, 0.10],
            [-0.36, 0.10],
            [-0.36, -0.05],
        ],
        length,
        1,
    )
    .turned(DVec3::Y, -PI / 2.0)
    .moved(0.0, TOP, -WALL);
    let dado = moulding(&[[0.05, 0.0], [0.05, 0.44], [0.03, 0.50], [0.0, 0.51]], 2.0 * WALL, 1)
        .turned(DVec3::Y, -PI / 2.0)
        .moved(0.0, 0.0, -WALL);
    let trims = Part::new(Shape::joined([coping, dado]).box_mapped(1.0).shaded(25.0), palette.stone);
    let bracket = glb.mesh("bracket", &[Part::new(bracket().shaded(40.0), palette.stone)]);
    for ((name, turns), paint) in SIDES.into_iter().zip(paints) {
        let wall = block(length, TOP + 0.3, THICKNESS).moved(0.0, (TOP - 0.3) / 2.0, -WALL - THICKNESS / 2.0);
        let wall = Part::new(wall.box_mapped(if name == "back" { 1.0 } else { 3.0 }).shaded(30.0), paint);
        let mesh = glb.mesh(&format!("{name} wall"), &[wall, trims.clone()]);
        let side =
            glb.show(Some(group), &format!("{name} wall"), mesh, turned(at(0.0, 0.0, 0.0), DVec3::Y, TAU * turns));
        for index in 0..9 {
            let place = at(1.45 * (f64::from(index) - 4.0), TOP - 0.2, -WALL);
            // Brackets of the left half are mirror images of the right ones; the middle one is larger.
            let (mirror, size) = (if index < 4 { -1.0 } else { 1.0 }, if index == 4 { 1.25 } else { 1.0 });
            glb.show(
                Some(side),
                &format!("{name} bracket {}", index + 1),
                bracket,
                scaled(place, mirror * size, size, 1.0),
            );
        }
    }
    let portal = portal(glb, palette);
    glb.show(Some(group), "back portal", portal, at(0.0, STEP, -WALL));
    glb.show(Some(group), "front portal", portal, turned(at(0.0, 0.0, WALL), DVec3::Y, PI));
}

/// A console that carries the coping, its scroll rolled to the +X side; the wall is at z = 0.
fn bracket() -> Shape {
    let body = bar(
        &[
            [0.0, 0.0],
            [0.0, -0.42],
            [0.06, -0.43],
            [0.09, -0.28],
            [0.15, -0.18],
            [0.22, -0.08],
            [0.22, 0.0],
            [0.0, 0.0],
        ],
        0.14,
    )
    .turned(DVec3::Y, -PI / 2.0);
    let scroll = cylinder(0.06, 0.05, 8).turned(DVec3::Z, -PI / 2.0).moved(0.05, -0.09, 0.14);
    Shape::joined([body, scroll])
}

/// A closed door under a round arch, three steps high, for a wall at z = 0 that looks along +Z.
fn portal(glb: &mut GlbWriter, palette: &Palette) -> Index<Mesh> {
    let (half, spring, rise, steps) = (0.72, 2.35, 0.14, 3);
    let sill = rise * steps as f64;
    let door = Shape::grid(1, 1, |u, v| {
        (DVec3::new((2.0 * u - 1.0) * half, sill + (spring - sill) * v, 0.05), glam::DVec2::new(u * 1.6, 2.0 - v * 2.0))
    });
    let lunette = Shape::grid(16, 1, |u, v| {
        let (x, y) = (half * v * cos(PI * (1.0 - u)), half * v * sin(PI * (1.0 - u)));
        (DVec3::new(x, spring + y, 0.05), glam::DVec2::new(0.8 + x / 0.9, -y))
    });
    let jamb =
        |sign: f64| bevelled_block(0.24, spring - 0.0, 0.22, 0.02).moved(sign * (half + 0.10), spring / 2.0, 0.09);
    let hood = lathe_part(
        &[[half + 0.26, 0.0], [half + 0.24, 0.20], [half + 0.10, 0.17], [half - 0.02, 0.20], [half - 0.02, 0.03]],
        18,
        0.0,
        0.5,
    )
    .turned(DVec3::X, PI / 2.0)
    .moved(0.0, spring, 0.0);
    let key = bevelled_block(0.20, 0.36, 0.26, 0.03).moved(0.0, spring + half + 0.13, 0.12);
    let flight = stairs(2.3, rise, 0.30, steps).moved(0.0, 0.0, 0.30 * steps as f64 + 0.0);
    let landing_edge = Shape::joined([jamb(-1.0), jamb(1.0), key]);
    let straps = [0.75, 1.45, 2.15].map(|y| bevelled_block(2.0 * half - 0.10, 0.07, 0.03, 0.008).moved(0.0, y, 0.06));
    let leaf_gap = block(0.018, spring - sill, 0.02).moved(0.0, (spring + sill) / 2.0, 0.05);
    let knocker = torus(0.07, 0.014, 16, 6).turned(DVec3::X, PI / 2.0).moved(0.16, 1.60, 0.09);
    let stone = Shape::joined([landing_edge, hood, flight]);
    let iron = Shape::joined(straps.into_iter().chain([leaf_gap, knocker]));
    let parts = [
        Part::new(Shape::joined([door, lunette]).shaded(30.0), palette.wood),
        Part::new(stone.box_mapped(1.0).shaded(35.0), palette.stone),
        Part::new(iron.shaded(40.0), palette.iron),
    ];
    debug_assert!(spring + half < ROOF_TOP);
    glb.mesh("portal", &parts)
}
