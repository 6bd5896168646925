//! Reference of shading: the material as the caches' voxelization reads it, rounded once.

use glam::DVec3;

use super::TexturePyramids;
use super::surface::SurfaceReader;
use crate::data::albedo::ALBEDO_CODE_ONE;
use crate::data::fragments::{AREA_ONE, OPACITY_ONE};
use crate::data::packing::pack_normal;
use crate::scene::{Material, Primitive};

/// A fragment's values as integers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Shaded {
    /// 2^-20 cells².
    pub area: u32,
    /// Of [`OPACITY_ONE`].
    pub opacity: u32,
    /// Roots of linear channels, of [`ALBEDO_CODE_ONE`].
    pub roots: [u32; 3],
    /// Packed.
    pub normal: u32,
}

/// What is shaded: a piece of a triangle of a primitive.
#[derive(Clone, Copy, Debug)]
pub struct Shading<'a> {
    pub primitive: &'a Primitive,
    pub material: &'a Material,
    pub textures: &'a TexturePyramids,
    /// Posed, a vertex each.
    pub normals: &'a [DVec3],
}

impl Shading<'_> {
    /// `area` in cells², `weights` of the corners at the middle, `share` of the triangle's area.
    pub fn shade(&self, vertices: [u32; 3], (area, share): (f64, f64), weights: DVec3) -> Shaded {
        let surface = SurfaceReader::new(self.primitive, self.material, self.textures).read(vertices, weights, share);
        let corner = |i: usize| self.normals[vertices[i] as usize] * weights[i];
        let normal = (corner(0) + corner(1) + corner(2)).normalize_or_zero();
        Shaded {
            area: ((area * f64::from(AREA_ONE)).round() as u32).max(1),
            opacity: (surface.opacity * f64::from(OPACITY_ONE)).round() as u32,
            roots: surface.color.map(|channel| (channel.sqrt() * f64::from(ALBEDO_CODE_ONE)).round() as u32),
            normal: pack_normal(normal),
        }
    }
}
