//! A guard: the traveller's body without its cape, in finer triangles, with armour on. Left and right are meshes of their
//! own, as in characters that are dressed piece by piece: 54 of them on 22 joints.

use gltf::json::{Index, Mesh};

use super::piece::{Cloths, Piece, level_tube, pair};
use super::skeleton::{CAPE, COUNT, Pose};
use super::{Person, body, weights};
use crate::scene::builtin::glb::{GlbPart, GlbWriter, Influence, Paint};
use crate::scene::builtin::shapes::Shape;
use crate::scene::builtin::shapes::round::{Ring, torus, tube};
use crate::scene::builtin::shapes::solid::{bevelled_block, sphere};

/// The meshes of a guard, which any number of them wear.
pub struct Guards {
    meshes: Vec<(String, Index<Mesh>)>,
    joints: Vec<usize>,
}

impl Guards {
    pub fn new(glb: &mut GlbWriter) -> Self {
        let joints: Vec<usize> = (0..COUNT).filter(|joint| !CAPE.contains(joint)).collect();
        let cloths = cloths(glb);
        let add = |(name, part): (String, GlbPart)| {
            let mesh = glb.mesh(&name, &[renumbered(part, &joints)]);
            (name, mesh)
        };
        let meshes = parts(&cloths).into_iter().map(add).collect();
        Self { meshes, joints }
    }

    /// Adds one that rests in a pose.
    pub fn add(&self, glb: &mut GlbWriter, name: &str, pose: &Pose) -> Person {
        let person = Person::new(glb, name, &self.joints, pose);
        self.meshes.iter().for_each(|(title, mesh)| person.wear(glb, title, *mesh));
        person
    }
}

fn cloths(glb: &mut GlbWriter) -> Cloths {
    let mut paint = |name: &str, base_color: [f32; 3], roughness: f32, metallic: f32| {
        glb.material(name, Paint { base_color, roughness, metallic, double_sided: true, ..Paint::default() })
    };
    let dark = paint("hair", [0.06, 0.04, 0.03], 0.7, 0.0);
    Cloths {
        skin: paint("skin", [0.55, 0.33, 0.23], 0.6, 0.0),
        hair: dark,
        tunic: paint("tunic", [0.07, 0.11, 0.32], 0.9, 0.0),
        trim: paint("scarf", [0.72, 0.10, 0.07], 0.9, 0.0),
        sleeves: paint("linen", [0.74, 0.70, 0.62], 0.9, 0.0),
        trousers: paint("trousers", [0.13, 0.11, 0.10], 0.9, 0.0),
        leather: paint("leather", [0.18, 0.08, 0.04], 0.5, 0.0),
        cape: paint("feather", [0.72, 0.10, 0.07], 0.8, 0.0),
        dark,
        metal: paint("steel", [0.56, 0.57, 0.60], 0.35, 1.0),
    }
}

/// Every piece with a name, those that lie on both sides as two.
fn parts(cloths: &Cloths) -> Vec<(String, GlbPart)> {
    let mut parts = Vec::new();
    for (title, pieces) in dressed(cloths) {
        for (number, piece) in pieces.into_iter().enumerate() {
            let halves = piece.bound().halves().into_iter().zip(["left", "right"]);
            let halves = halves.filter(|(half, _)| !half.surface.triangles.is_empty());
            parts.extend(halves.map(|(half, side)| (format!("{title} {} {side}", number + 1), half)));
        }
    }
    parts
}

fn dressed(cloths: &Cloths) -> Vec<(&'static str, Vec<Piece>)> {
    let names = ["guard torso", "guard arms", "guard legs", "guard head", "guard gear"];
    let mut dressed: Vec<_> =
        names.into_iter().zip(body::meshes(cloths).into_iter().map(|(_, pieces)| pieces)).collect();
    for (name, pieces) in &mut dressed {
        pieces.retain(|piece| !piece.follows(CAPE[0]));
        if *name != "guard head" {
            *pieces = std::mem::take(pieces).into_iter().map(Piece::finer).collect();
        }
    }
    dressed.push(("guard armour", armour(cloths)));
    dressed
}

/// Nine plates and straps for the left side, and their mirror images.
fn armour(cloths: &Cloths) -> Vec<Piece> {
    let plate =
        |x: f64, y: f64, z: f64, [wide, high, deep]: [f64; 3]| sphere(12, 8).scaled(wide, high, deep).moved(x, y, z);
    let bracer = [[0.50, 0.060], [0.53, 0.063], [0.57, 0.062], [0.60, 0.058]];
    let bracer = tube(&bracer.map(|[x, radius]| Ring::across(x, radius, radius)), 16).moved(0.0, 1.41, 0.0);
    let garter =
        level_tube(&[[0.585, 0.074, 0.076, 0.003], [0.60, 0.080, 0.082, 0.003], [0.62, 0.078, 0.08, 0.003]], 16);
    let metal: [(Shape, weights::Rule); 6] = [
        (plate(0.185, 1.435, 0.0, [0.085, 0.060, 0.090]), weights::arm),
        (plate(0.455, 1.41, -0.02, [0.055, 0.062, 0.055]), weights::arm),
        (bracer, weights::arm),
        (plate(0.09, 0.72, 0.035, [0.078, 0.110, 0.072]), weights::leg),
        (plate(0.09, 0.50, 0.030, [0.058, 0.060, 0.055]), weights::leg),
        (torus(0.022, 0.006, 12, 6).moved(0.09, 0.055, -0.085), weights::boot),
    ];
    let leather: [(Shape, weights::Rule); 3] = [
        (garter.moved(0.09, 0.0, 0.0), weights::leg),
        (bevelled_block(0.07, 0.09, 0.05, 0.012).split_in_four().moved(0.10, 0.93, 0.13), weights::pelvis),
        (torus(0.055, 0.012, 16, 6).turned(glam::DVec3::Z, 0.5).moved(0.115, 1.435, 0.0), weights::torso),
    ];
    let pairs = metal.into_iter().map(|(shape, rule)| pair(shape, cloths.metal, rule));
    pairs.chain(leather.into_iter().map(|(shape, rule)| pair(shape, cloths.leather, rule))).flatten().collect()
}

/// With the places of its joints in a list instead of their numbers.
fn renumbered(part: GlbPart, joints: &[usize]) -> GlbPart {
    let place = |joint: u8| joints.iter().position(|&known| known == usize::from(joint)).unwrap_or(0) as u8;
    let influences =
        part.influences.iter().map(|influence| Influence { joints: influence.joints.map(place), ..*influence });
    GlbPart { influences: influences.collect(), ..part }
}
