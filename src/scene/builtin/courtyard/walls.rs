//! The four outer walls with what is fixed to them: dado, copings, brackets, portals.

use glam::{DVec2, DVec3};
use gltf::json::{Index, Mesh};

use super::super::exact::{PI, TAU, at, cos, scaled, sin, turned};
use super::super::glb::{GlbPart, GlbWriter};
use super::super::shapes::Shape;
use super::super::shapes::architecture::{bar, moulding, stairs};
use super::super::shapes::round::{cylinder, lathe_part, torus};
use super::super::shapes::solid::{bevelled_block, block};
use super::building::{STEP, WALL};
use super::palette::Palette;

const TOP: f64 = 6.86;
const THICKNESS: f64 = 0.3;

/// The walls' turns about Y from the back wall, whose inside looks along +Z.
const SIDES: [(&str, f64); 4] = [("back", 0.0), ("left", 0.25), ("front", 0.5), ("right", 0.75)];

pub fn add(glb: &mut GlbWriter, palette: &Palette) {
    let group = glb.node(None, "walls", at(0.0, 0.0, 0.0));
    let paints =
        [palette.masonry.brick, palette.masonry.red_wall, palette.masonry.cream_wall, palette.masonry.blue_wall];
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
    let trims = GlbPart::new(Shape::joined([coping, dado]).box_mapped(1.0).shaded(25.0), palette.masonry.stone);
    let bracket = glb.mesh("bracket", &[GlbPart::new(bracket().shaded(40.0), palette.masonry.stone)]);
    for ((name, turns), paint) in SIDES.into_iter().zip(paints) {
        let wall = block(length, TOP + 0.3, THICKNESS).moved(0.0, (TOP - 0.3) / 2.0, -WALL - THICKNESS / 2.0);
        let wall = GlbPart::new(wall.box_mapped(if name == "back" { 1.0 } else { 3.0 }).shaded(30.0), paint);
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
    let scroll = cylinder(0.06, 0.05, 6).turned(DVec3::Z, -PI / 2.0).moved(0.05, -0.09, 0.14);
    Shape::joined([body, scroll])
}

/// A portal's half width, the height where its arch springs, and its three steps.
const HALF: f64 = 0.72;
const PORTAL_SPRING: f64 = 2.35;
const RISE: f64 = 0.14;
const RUN: f64 = 0.30;
const STEPS: usize = 3;
/// Height of the door's foot.
const SILL: f64 = RISE * STEPS as f64;

/// A closed door under a round arch, three steps high, for a wall at z = 0 that looks along +Z.
fn portal(glb: &mut GlbWriter, palette: &Palette) -> Index<Mesh> {
    let parts = [
        GlbPart::new(door_leaves().shaded(30.0), palette.masonry.wood),
        GlbPart::new(portal_frame().box_mapped(1.0).shaded(35.0), palette.masonry.stone),
        GlbPart::new(door_irons().shaded(40.0), palette.fittings.iron),
    ];
    glb.mesh("portal", &parts)
}

fn door_leaves() -> Shape {
    let planked = |x: f64, y: f64| (DVec3::new(x, y, 0.05), DVec2::new(0.8 + x / 0.9, 2.0 - y));
    let door = Shape::grid(1, 1, |u, v| planked((2.0 * u - 1.0) * HALF, SILL + (PORTAL_SPRING - SILL) * v));
    let lunette = Shape::grid(16, 1, |u, v| {
        let angle = PI * (1.0 - u);
        planked(HALF * v * cos(angle), PORTAL_SPRING + HALF * v * sin(angle))
    });
    Shape::joined([door, lunette])
}

fn portal_frame() -> Shape {
    let jambs = [-1.0, 1.0].map(|side| {
        bevelled_block(0.24, PORTAL_SPRING, 0.22, 0.02).moved(side * (HALF + 0.10), PORTAL_SPRING / 2.0, 0.09)
    });
    let profile =
        [[HALF + 0.26, 0.0], [HALF + 0.24, 0.20], [HALF + 0.10, 0.17], [HALF - 0.02, 0.20], [HALF - 0.02, 0.03]];
    let hood = lathe_part(&profile, 18, 0.0, 0.5).turned(DVec3::X, PI / 2.0).moved(0.0, PORTAL_SPRING, 0.0);
    let keystone = bevelled_block(0.20, 0.36, 0.26, 0.03).moved(0.0, PORTAL_SPRING + HALF + 0.13, 0.12);
    let flight = stairs(2.3, RISE, RUN, STEPS).moved(0.0, 0.0, RUN * STEPS as f64);
    Shape::joined([hood, keystone, flight].into_iter().chain(jambs))
}

fn door_irons() -> Shape {
    let straps = [0.75, 1.45, 2.15].map(|y| bevelled_block(2.0 * HALF - 0.10, 0.07, 0.03, 0.008).moved(0.0, y, 0.06));
    let gap = block(0.018, PORTAL_SPRING - SILL, 0.02).moved(0.0, (PORTAL_SPRING + SILL) / 2.0, 0.05);
    let knocker = torus(0.07, 0.014, 16, 6).turned(DVec3::X, PI / 2.0).moved(0.16, 1.60, 0.075);
    Shape::joined(straps.into_iter().chain([gap, knocker]))
}
