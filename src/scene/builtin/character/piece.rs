//! What the meshes of a person are made of: shapes with a material and a rule that binds them to joints.

use glam::DVec3;
use gltf::json::{Index, Material};

use super::weights::{self, Rule};
use crate::scene::builtin::glb::GlbPart;
use crate::scene::builtin::shapes::Shape;
use crate::scene::builtin::shapes::round::{Ring, tube};

/// What a person wears. `cape` and `tunic` are seen from both sides.
#[derive(Clone, Copy, Debug)]
pub struct Cloths {
    pub skin: Index<Material>,
    pub hair: Index<Material>,
    pub tunic: Index<Material>,
    pub trim: Index<Material>,
    pub sleeves: Index<Material>,
    pub trousers: Index<Material>,
    pub leather: Index<Material>,
    pub cape: Index<Material>,
    pub dark: Index<Material>,
    pub metal: Index<Material>,
}

/// A shape with its material and the rule that binds it.
pub struct Piece {
    shape: Shape,
    material: Index<Material>,
    rule: Rule,
}

impl Piece {
    /// Whether any of it does.
    pub fn follows(&self, joint: usize) -> bool {
        self.shape.positions.iter().any(|&point| (self.rule)(point)[joint] > 0.0)
    }

    /// With four triangles for each.
    pub fn finer(self) -> Self {
        Self { shape: self.shape.split_in_four(), ..self }
    }

    /// The part as a file stores it: shaded, with the influences of every vertex.
    pub fn bound(self) -> GlbPart {
        let surface = self.shape.shaded(50.0);
        let influences = surface.positions.iter().map(|&point| weights::influence(&(self.rule)(point))).collect();
        GlbPart { influences, ..GlbPart::new(surface, self.material) }
    }
}

pub(super) fn piece(shape: Shape, material: Index<Material>, rule: Rule) -> Piece {
    Piece { shape, material, rule }
}

/// The same shape on the left and, mirrored, on the right.
pub(super) fn pair(left: Shape, material: Index<Material>, rule: Rule) -> [Piece; 2] {
    [piece(left.clone(), material, rule), piece(left.scaled(-1.0, 1.0, 1.0), material, rule)]
}

/// A cross-section that closes a tube.
pub(super) fn closed(ring: Ring) -> Ring {
    Ring { right: DVec3::ZERO, forward: DVec3::ZERO, ..ring }
}

pub(super) fn level_tube(levels: &[[f64; 4]], segments: usize) -> Shape {
    let rings: Vec<Ring> = levels.iter().map(|&[y, width, depth, z]| Ring::level(y, width, depth, z)).collect();
    tube(&rings, segments)
}
