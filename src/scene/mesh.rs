//! Triangle meshes as loaded: one primitive per material.

use glam::{Vec2, Vec3, Vec4};

#[derive(Clone, Debug, Default)]
pub struct Mesh {
    pub name: String,
    pub primitives: Vec<Primitive>,
}

impl Mesh {
    /// A clip moves the weights of its morph targets.
    pub fn is_morphing(&self) -> bool {
        self.primitives.iter().any(|primitive| primitive.morph.is_some())
    }

    pub fn triangle_count(&self) -> usize {
        self.primitives.iter().map(|primitive| primitive.triangles.len()).sum()
    }
}

/// Per-vertex arrays are either empty (attribute absent) or as long as `positions`.
/// `normals` is never empty: where the file has none they are flat, vertices unshared.
#[derive(Clone, Debug, Default)]
pub struct Primitive {
    /// `None`: glTF's default material.
    pub material: Option<usize>,
    pub positions: Vec<Vec3>,
    pub normals: Vec<Vec3>,
    /// xyz and handedness; empty where the file has none.
    pub tangents: Vec<Vec4>,
    /// `TEXCOORD_0` and `TEXCOORD_1`.
    pub tex_coords: [Vec<Vec2>; 2],
    /// Linear `COLOR_0`.
    pub colors: Vec<Vec4>,
    /// Indices into the skin's joints, the four strongest.
    pub joints: Vec<[u16; 4]>,
    /// Sum to 1 at every vertex (renormalised on loading).
    pub weights: Vec<[f32; 4]>,
    pub triangles: Vec<[u32; 3]>,
    /// Where a clip moves the weights of its morph targets.
    pub morph: Option<Morph>,
}

/// Targets of one primitive, and the weights that its vertices already have.
#[derive(Clone, Debug, Default)]
pub struct Morph {
    pub targets: Vec<MorphTarget>,
    /// As many as the mesh has; vertices are given at these.
    pub weights: Vec<f64>,
    /// The file has no normals: those of the displaced triangles are.
    pub is_flat: bool,
}

/// Displacements of all vertices at weight 1; empty where the target has none.
#[derive(Clone, Debug, Default)]
pub struct MorphTarget {
    pub positions: Vec<Vec3>,
    pub normals: Vec<Vec3>,
    pub tangents: Vec<Vec3>,
}
