//! Paving, galleries, colonnades and their roofs.
//!
//! The court lies between x = ±[`SIDE_X`] and from z = [`BACK_Z`] to the front wall; galleries
//! one step higher run along three sides, behind columns a bay apart.

use glam::{DVec2, DVec3};
use gltf::json::{Index, Node};

use super::super::exact::{PI, at, turned};
use super::super::glb::{GlbPart, GlbWriter};
use super::super::shapes::Shape;
use super::super::shapes::architecture::{arch, floor_around, moulding, plane, tiled_roof};
use super::super::shapes::round::{lathe, lathe_part};
use super::super::shapes::solid::{bevelled_block, block};
use super::palette::Palette;

/// Inner faces of the outer walls, in x and z.
pub const WALL: f64 = 7.0;
/// Column axes.
pub const SIDE_X: f64 = 4.35;
pub const BACK_Z: f64 = -4.6;
/// Distance of column axes, and places of the columns along a side and along the back.
pub const BAY: f64 = 2.9;
/// Height of the gallery floor.
pub const STEP: f64 = 0.16;
const COLUMN_HEIGHT: f64 = 2.5;
/// Where arches spring, and what lies above.
pub const SPRING: f64 = STEP + COLUMN_HEIGHT;
pub const ARCH_RADIUS: f64 = 1.2;
const ARCH_HEIGHT: f64 = 1.72;
pub const ARCH_THICKNESS: f64 = 0.44;
const CORNICE: f64 = SPRING + ARCH_HEIGHT;
/// Where roofs meet the walls.
pub const ROOF_TOP: f64 = 5.72;
/// The edge of the galleries towards the court lies this far in front of the column axes.
const KERB: f64 = 0.32;
/// Width of the stones along that edge.
const KERB_TOP: f64 = 0.3;
/// Radii of the polished ring that the traveller walks on.
const RING: [f64; 2] = [1.82, 2.62];

pub fn add(glb: &mut GlbWriter, palette: &Palette) {
    add_floor(glb, palette);
    let group = glb.node(None, "colonnade", at(0.0, 0.0, 0.0));
    add_columns(glb, palette, group);
    add_arches(glb, palette, group);
    add_cornices(glb, palette, group);
    add_roofs(glb, palette);
}

fn add_floor(glb: &mut GlbWriter, palette: &Palette) {
    let (x, back) = (SIDE_X - KERB, BACK_Z + KERB);
    let outer = floor_around(RING[1], DVec2::new(-x, back), DVec2::new(x, WALL), 18, 3);
    let inner = lathe(&[[RING[0], 0.0], [0.0, 0.0]], 72);
    // Four squares of the texture to 2.9 m: a tile is 0.725 m.
    let paving = Shape::joined([outer.box_mapped(BAY), inner.box_mapped(BAY)]).shaded(30.0);
    let ring = lathe(&[[RING[1], 0.0], [RING[0], 0.0]], 72).shaded(30.0);
    let court =
        glb.mesh("court", &[GlbPart::new(paving, palette.masonry.paving), GlbPart::new(ring, palette.masonry.inlay)]);
    glb.show(None, "court", court, at(0.0, 0.0, 0.0));

    let (aside, depth) = (WALL - x - KERB_TOP, WALL + back - KERB_TOP);
    let side = |sign: f64| plane(aside, 2.0 * WALL, 1, 1).moved(sign * (WALL - aside / 2.0), STEP, 0.0);
    let behind = plane(2.0 * (x + KERB_TOP), depth, 1, 1).moved(0.0, STEP, -WALL + depth / 2.0);
    let floor = Shape::joined([side(-1.0), side(1.0), behind]).box_mapped(1.8).shaded(30.0);
    let kerb = |length: f64| moulding(&[[0.0, 0.0], [0.0, STEP - 0.02], [-0.02, STEP], [-KERB_TOP, STEP]], length, 1);
    // The side stones run on into the corners.
    let along = WALL - back + KERB_TOP;
    let sides = [1.0, -1.0].map(|sign| {
        let turn = if sign > 0.0 { PI } else { 0.0 };
        kerb(along).turned(DVec3::Y, turn).moved(sign * x, 0.0, WALL - along / 2.0)
    });
    let rear = kerb(2.0 * x).turned(DVec3::Y, -PI / 2.0).moved(0.0, 0.0, back);
    let kerbs = Shape::joined(sides.into_iter().chain([rear])).box_mapped(1.0).shaded(30.0);
    let gallery = glb.mesh(
        "gallery floor",
        &[GlbPart::new(floor, palette.masonry.gallery_floor), GlbPart::new(kerbs, palette.masonry.stone)],
    );
    glb.show(None, "gallery floor", gallery, at(0.0, 0.0, 0.0));
}

/// A column of unit instance: square plinth, round base, shaft with entasis, capital, abacus.
fn column() -> Shape {
    let plinth = bevelled_block(0.50, 0.14, 0.50, 0.015).moved(0.0, 0.07, 0.0);
    let abacus = bevelled_block(0.54, 0.12, 0.54, 0.02).moved(0.0, COLUMN_HEIGHT - 0.06, 0.0);
    let turned = lathe(
        &[
            [0.235, 0.138],
            [0.252, 0.170],
            [0.248, 0.210],
            [0.212, 0.235],
            [0.206, 0.265],
            [0.220, 0.300],
            [0.194, 0.335],
            [0.182, 0.370],
            [0.183, 0.800],
            [0.180, 1.250],
            [0.171, 1.700],
            [0.159, 2.080],
            [0.180, 2.100],
            [0.174, 2.126],
            [0.158, 2.136],
            [0.164, 2.210],
            [0.205, 2.270],
            [0.248, 2.382],
        ],
        16,
    );
    Shape::joined([plinth.box_mapped(1.0), turned, abacus.box_mapped(1.0)])
}

/// Places of the columns: four and a half along each side, two between them at the back.
fn column_places() -> Vec<DVec3> {
    let mut places = Vec::new();
    for x in [-SIDE_X, SIDE_X] {
        places.extend((0..5).map(|bay| DVec3::new(x, STEP, BACK_Z + BAY * f64::from(bay))));
    }
    places.extend([-BAY / 2.0, BAY / 2.0].map(|x| DVec3::new(x, STEP, BACK_Z)));
    places
}

fn add_columns(glb: &mut GlbWriter, palette: &Palette, group: Index<Node>) {
    let mesh = glb.mesh("column", &[GlbPart::new(column().shaded(38.0), palette.masonry.stone)]);
    for (index, place) in column_places().into_iter().enumerate() {
        glb.show(Some(group), &format!("column {}", index + 1), mesh, at(place.x, place.y, place.z));
    }
}

fn add_arches(glb: &mut GlbWriter, palette: &Palette, group: Index<Node>) {
    let wall = arch(BAY, ARCH_HEIGHT, ARCH_RADIUS, ARCH_THICKNESS, 20).box_mapped(1.0).shaded(35.0);
    let (inner, face) = (ARCH_RADIUS - 0.012, ARCH_THICKNESS / 2.0);
    let profile = [[inner + 0.19, face], [inner + 0.17, face + 0.045], [inner, face + 0.03], [inner, face - 0.03]];
    let ring = lathe_part(&profile, 20, 0.0, 0.5).turned(DVec3::X, PI / 2.0);
    let rings = Shape::joined([ring.clone(), ring.turned(DVec3::Y, PI)]).shaded(35.0);
    let mesh =
        glb.mesh("arch", &[GlbPart::new(wall, palette.masonry.cream_wall), GlbPart::new(rings, palette.masonry.stone)]);
    for (index, offset) in [-BAY, 0.0, BAY].into_iter().enumerate() {
        glb.show(Some(group), &format!("back arch {}", index + 1), mesh, at(offset, SPRING, BACK_Z));
    }
    for (name, x, turn) in [("left", -SIDE_X, PI / 2.0), ("right", SIDE_X, -PI / 2.0)] {
        for bay in 0..4 {
            let place = at(x, SPRING, BACK_Z + BAY * (f64::from(bay) + 0.5));
            glb.show(Some(group), &format!("{name} arch {}", bay + 1), mesh, turned(place, DVec3::Y, turn));
        }
    }
    // Where two colonnades meet, a pier carries the corner.
    let pier = block(0.48, ARCH_HEIGHT, 0.48).moved(0.0, ARCH_HEIGHT / 2.0, 0.0).shaded(30.0);
    let pier = glb.mesh("corner pier", &[GlbPart::new(pier, palette.masonry.cream_wall)]);
    for (name, x) in [("left corner", -SIDE_X), ("right corner", SIDE_X)] {
        glb.show(Some(group), name, pier, at(x, SPRING, BACK_Z));
    }
}

fn add_cornices(glb: &mut GlbWriter, palette: &Palette, group: Index<Node>) {
    // Towards the court at +X, from the wall's face up and out to the eave.
    let profile = [
        [-0.02, 0.00],
        [0.05, 0.00],
        [0.06, 0.05],
        [0.10, 0.07],
        [0.17, 0.14],
        [0.19, 0.15],
        [0.19, 0.23],
        [0.15, 0.27],
        [-0.30, 0.27],
    ];
    let face = ARCH_THICKNESS / 2.0;
    let side_length = WALL - BACK_Z;
    let side = moulding(&profile, side_length, 1).moved(face, CORNICE, 0.0);
    let left = side.clone().moved(-SIDE_X, 0.0, BACK_Z + side_length / 2.0);
    let right = side.turned(DVec3::Y, PI).moved(SIDE_X, 0.0, BACK_Z + side_length / 2.0);
    let back = moulding(&profile, 2.0 * SIDE_X, 1).moved(face, CORNICE, 0.0).turned(DVec3::Y, -PI / 2.0);
    let whole = Shape::joined([left, right, back.moved(0.0, 0.0, BACK_Z)]).box_mapped(1.0).shaded(25.0);
    let mesh = glb.mesh("cornice", &[GlbPart::new(whole, palette.masonry.stone)]);
    glb.show(Some(group), "cornice", mesh, at(0.0, 0.0, 0.0));
}

fn add_roofs(glb: &mut GlbWriter, palette: &Palette) {
    let group = glb.node(None, "roofs", at(0.0, 0.0, 0.0));
    let eave = CORNICE + 0.25;
    let (drop, aside, behind) = (ROOF_TOP - eave, WALL - SIDE_X + 0.5, WALL + BACK_Z + 0.5);
    // Seen along its wall, each roof ends in a valley at the back and runs into the front wall.
    let left = tiled_roof(WALL, -WALL, WALL - behind, aside, drop, 0.35);
    let right = tiled_roof(WALL, behind - WALL, WALL, aside, drop, 0.35);
    let back = tiled_roof(WALL, aside - WALL, WALL - aside, behind, drop, 0.35);
    let left = left.turned(DVec3::Y, PI / 2.0).moved(-WALL, ROOF_TOP, 0.0);
    let right = right.turned(DVec3::Y, -PI / 2.0).moved(WALL, ROOF_TOP, 0.0);
    let tiles = Shape::joined([left, right, back.moved(0.0, ROOF_TOP, -WALL)]).shaded(50.0);
    let mesh = glb.mesh("roof", &[GlbPart::new(tiles, palette.masonry.roof)]);
    glb.show(Some(group), "roof", mesh, at(0.0, 0.0, 0.0));

    let (height, thick) = (CORNICE - 0.06, 0.06);
    let (side_width, side_length) = (WALL - SIDE_X, 2.0 * WALL);
    let slab = |sign: f64| block(side_width, thick, side_length).moved(sign * (SIDE_X + side_width / 2.0), height, 0.0);
    let depth = WALL + BACK_Z;
    let rear = block(2.0 * SIDE_X, thick, depth).moved(0.0, height, -WALL + depth / 2.0);
    let ceiling = Shape::joined([slab(-1.0), slab(1.0), rear]).box_mapped(2.0).shaded(30.0);
    let mesh = glb.mesh("ceiling", &[GlbPart::new(ceiling, palette.masonry.cream_wall)]);
    glb.show(Some(group), "ceiling", mesh, at(0.0, 0.0, 0.0));
    add_beams(glb, palette, group, height - thick / 2.0);
}

/// One beam of a metre, stretched to each gallery's depth; its UVs lie within one plank.
fn add_beams(glb: &mut GlbWriter, palette: &Palette, group: Index<Node>, under: f64) {
    use super::super::exact::scaled;
    let mesh = glb.mesh(
        "beam",
        &[GlbPart::new(
            block(1.0, 1.0, 1.0).moved(0.6, 0.6, 0.6).box_mapped(5.0).moved(-0.6, -0.6, -0.6).shaded(30.0),
            palette.masonry.wood,
        )],
    );
    let inner = ARCH_THICKNESS / 2.0;
    let side = WALL - SIDE_X - inner;
    for (name, sign) in [("left", -1.0), ("right", 1.0)] {
        for index in 0..8 {
            let z = BACK_Z + 0.5 * BAY * f64::from(index);
            let place = at(sign * (WALL - side / 2.0), under - 0.08, z);
            glb.show(Some(group), &format!("{name} beam {}", index + 1), mesh, scaled(place, side, 0.16, 0.14));
        }
    }
    let depth = WALL + BACK_Z - inner;
    for index in 0..5 {
        let x = 0.5 * BAY * (f64::from(index) - 2.0);
        let place = at(x, under - 0.08, -WALL + depth / 2.0);
        glb.show(Some(group), &format!("back beam {}", index + 1), mesh, scaled(place, 0.14, 0.16, depth));
    }
}
