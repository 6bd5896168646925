//! The parts of a person in the bind pose: five meshes, each of several parts.

use glam::{DVec2, DVec3};

use super::limbs;
use super::piece::{Cloths, Piece, level_tube, piece};
use super::weights;
use crate::scene::builtin::exact::{PI, TAU, cos, sin, smoothstep};
use crate::scene::builtin::shapes::Shape;
use crate::scene::builtin::shapes::round::{Ring, lathe, loop_rope, torus, tube};
use crate::scene::builtin::shapes::solid::{bevelled_block, sphere};

/// The meshes by name.
pub fn meshes(cloths: &Cloths) -> Vec<(&'static str, Vec<Piece>)> {
    vec![
        ("traveller torso", torso(cloths)),
        ("traveller arms", limbs::arms(cloths)),
        ("traveller legs", limbs::legs(cloths)),
        ("traveller head", head(cloths)),
        ("traveller gear", gear(cloths)),
    ]
}

fn torso(cloths: &Cloths) -> Vec<Piece> {
    let trunk = level_tube(
        &[
            [0.93, 0.150, 0.108, 0.0],
            [0.97, 0.150, 0.108, 0.0],
            [1.03, 0.142, 0.103, 0.0],
            [1.09, 0.143, 0.102, 0.0],
            [1.15, 0.152, 0.106, 0.002],
            [1.22, 0.165, 0.112, 0.004],
            [1.29, 0.176, 0.116, 0.004],
            [1.35, 0.180, 0.112, 0.0],
            [1.40, 0.172, 0.100, -0.004],
            [1.44, 0.140, 0.084, -0.008],
            [1.475, 0.085, 0.066, -0.008],
            [1.495, 0.056, 0.055, -0.004],
        ],
        22,
    );
    let hem = Shape::grid(36, 6, |u, v| {
        let (down, angle) = (1.0 - v, if u == 1.0 { 0.0 } else { TAU * u });
        let flare = 1.0 + 0.10 * smoothstep(0.2, 1.0, down) * cos(9.0 * angle);
        let (width, depth) = (0.153 + 0.075 * down, 0.110 + 0.085 * down);
        let place = DVec3::new(width * flare * cos(angle), 1.0 - 0.36 * down, -depth * flare * sin(angle));
        (place, DVec2::new(2.0 * u, down))
    });
    let belt = torus(1.0, 0.14, 22, 6).scaled(0.148, 0.18, 0.109).moved(0.0, 0.99, 0.0);
    let buckle = bevelled_block(0.055, 0.05, 0.02, 0.006).moved(0.0, 0.99, 0.122);
    vec![
        piece(trunk, cloths.tunic, weights::torso),
        piece(hem, cloths.tunic, weights::skirt),
        piece(belt, cloths.leather, weights::pelvis),
        piece(buckle, cloths.metal, weights::pelvis),
    ]
}

fn head(cloths: &Cloths) -> Vec<Piece> {
    let neck = level_tube(&[[1.45, 0.054, 0.056, -0.006], [1.52, 0.050, 0.054, 0.0], [1.58, 0.052, 0.058, 0.008]], 16);
    let skull = sphere(20, 14).mapped(|point| {
        // The jaw is narrower than the brow, the chin comes forward.
        let jaw = smoothstep(0.1, -0.9, point.y);
        let (width, depth) = (0.078 - 0.022 * jaw, 0.096 - 0.012 * jaw);
        DVec3::new(point.x * width, point.y * 0.118, point.z * depth + 0.014 * jaw)
    });
    let nose = sphere(8, 6).scaled(0.013, 0.022, 0.020).moved(0.0, -0.012, 0.098);
    let ears = [-1.0, 1.0].map(|side| sphere(8, 6).scaled(0.010, 0.026, 0.018).moved(side * 0.077, 0.0, -0.005));
    let face = Shape::joined([skull, nose].into_iter().chain(ears)).moved(0.0, 1.655, 0.012);
    let hair = sphere(18, 10).scaled(0.088, 0.118, 0.104).moved(0.0, 1.672, -0.012);
    let eyes = [-1.0, 1.0].map(|side| sphere(8, 6).scaled(0.009, 0.011, 0.006).moved(side * 0.030, 1.668, 0.104));
    let hat = lathe(
        &[
            [0.08, 0.000],
            [0.20, -0.008],
            [0.208, 0.000],
            [0.20, 0.006],
            [0.12, 0.012],
            [0.101, 0.03],
            [0.098, 0.075],
            [0.084, 0.105],
            [0.05, 0.115],
            [0.0, 0.108],
        ],
        24,
    );
    let band = lathe(&[[0.106, 0.012], [0.108, 0.016], [0.104, 0.044], [0.099, 0.046]], 24);
    let tilted = |shape: Shape| shape.turned(DVec3::X, -0.10).turned(DVec3::Z, 0.05).moved(0.0, 1.728, -0.004);
    let feather = tube(
        &[0.0, 0.15, 0.35, 0.55, 0.75, 0.9, 1.0].map(|t: f64| Ring {
            centre: DVec3::new(0.103, 0.02 + 0.15 * t, -0.02 - 0.20 * t * t),
            right: DVec3::new(0.004 * (1.0 - t), 0.0, 0.0),
            forward: DVec3::new(0.0, 0.010, 0.024) * sin(PI * (0.08 + 0.92 * t)).max(0.0),
        }),
        8,
    );
    vec![
        piece(neck, cloths.skin, weights::head),
        piece(face, cloths.skin, weights::head),
        piece(hair, cloths.hair, weights::head),
        piece(Shape::joined(eyes), cloths.dark, weights::head),
        piece(tilted(hat), cloths.leather, weights::head),
        piece(tilted(band), cloths.trim, weights::head),
        piece(tilted(feather), cloths.cape, weights::head),
    ]
}

fn gear(cloths: &Cloths) -> Vec<Piece> {
    let scarf = torus(0.078, 0.030, 20, 8).scaled(1.0, 0.9, 0.95).turned(DVec3::X, 0.15).moved(0.0, 1.495, 0.0);
    let across = DVec3::new(0.165, -0.25, 0.0);
    let strap = |turns: f64| {
        let angle = TAU * turns;
        DVec3::new(0.03, 1.185, 0.0) + across * cos(angle) + DVec3::Z * 0.128 * sin(angle)
    };
    let strap = loop_rope(strap, 0.012, 32, 5);
    let satchel = bevelled_block(0.075, 0.20, 0.22, 0.02).turned(DVec3::Z, 0.12).moved(0.235, 0.86, -0.02);
    let flap = bevelled_block(0.02, 0.11, 0.225, 0.008).turned(DVec3::Z, 0.12).moved(0.272, 0.91, -0.02);
    let cape = Shape::grid(22, 12, |u, v| {
        let (down, around) = (1.0 - v, (u - 0.5) * (2.5 - 0.5 * (1.0 - v)));
        let out = smoothstep(0.0, 0.16, down);
        let fold = 0.014 * smoothstep(0.1, 1.0, down) * cos(TAU * 4.0 * u);
        let (width, depth) = (0.085 + 0.125 * out + 0.07 * down, 0.066 + 0.068 * out + 0.09 * down + fold);
        let place = DVec3::new(width * sin(around), 1.475 - 0.055 * out - 0.62 * down, -depth * cos(around));
        (place, DVec2::new(u, down))
    })
    .flipped();
    vec![
        piece(scarf, cloths.trim, weights::torso),
        piece(strap, cloths.leather, weights::torso),
        piece(Shape::joined([satchel, flap]), cloths.leather, weights::pelvis),
        piece(cape, cloths.cape, weights::cape),
    ]
}
