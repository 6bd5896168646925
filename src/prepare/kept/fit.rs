//! Whether an entry can hold the voxels of an input: later stages rely on it. Joints exist, cells are
//! near, and everything is there that the input gives rise to. The hash of an entry says no such
//! thing, since anybody can compute one.

use glam::DVec3;

use crate::data::voxel_cache::{Tile, VoxelCache};
use crate::stages::voxelize::VoxelizeInput;

/// Can these be the voxels of `input`?
pub(super) fn fits(cache: &VoxelCache, input: &VoxelizeInput) -> bool {
    let has_voxels = !cache.voxels.is_empty();
    let primitives = || input.parts.iter().map(|part| part.primitive);
    let known = primitives().flat_map(|primitive| &primitive.joints).flatten().max().copied().unwrap_or(0);
    let used = cache.joints.iter().flat_map(|voxel| voxel.joints).max().unwrap_or(0);
    let positions = input.parts.iter().flat_map(|part| &part.positions_cells);
    let [min, max] = positions.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[min, max], &p| [min.min(p), max.max(p)]);
    let is_near = |tile: &Tile| {
        let origin = tile.origin.as_dvec3();
        origin.cmpge(min.floor() - 1.0).all() && origin.cmple(max + 1.0).all()
    };
    cache.report.triangles == input.triangle_count()
        && cache.joints.is_empty() != (input.joints.is_some() && has_voxels)
        && cache.emission.is_empty() != (input.emits() && has_voxels)
        && used <= known
        && cache.tiles.iter().all(is_near)
}

#[cfg(test)]
mod tests {

    use super::*;
    use crate::prepare::kept::entry::tests::cache;
    use crate::scene::{Material, Primitive};
    use crate::stages::voxelize::{TexturePyramids, VoxelizePart};

    #[test]
    fn voxels_that_cannot_be_the_inputs_are_refused() {
        let primitive =
            Primitive { joints: vec![[0, 2, 1, 0]; 3], triangles: vec![[0, 1, 2]; 2], ..Primitive::default() };
        let positions = [DVec3::new(-2.5, 4.5, 500.5), DVec3::new(-1.0, 6.0, 501.0), DVec3::new(-1.5, 4.0, 500.0)];
        let glows = Material { emissive: [1.0; 3], ..Default::default() };
        let textures = TexturePyramids::new(&[]);
        let part = |primitive, shift: f64| VoxelizePart {
            primitive,
            positions_cells: positions.map(|position| position + shift).to_vec(),
            normals: vec![DVec3::Z; 3],
        };
        let input = |part, with_joints: bool| VoxelizeInput {
            parts: vec![part],
            materials: std::slice::from_ref(&glows),
            textures: &textures,
            mode: Default::default(),
            joints: with_joints.then_some(Default::default()),
        };
        let lit = Primitive { material: Some(0), ..primitive.clone() };
        assert!(fits(&cache(), &input(part(&lit, 0.0), true)));
        assert!(!fits(&cache(), &input(part(&lit, 0.0), false)), "not skinned");
        assert!(!fits(&cache(), &input(part(&lit, 9.0), true)), "elsewhere");
        assert!(!fits(&cache(), &input(part(&primitive, 0.0), true)), "nothing emits");
        let fewer_joints = Primitive { joints: vec![[0, 1, 1, 0]; 3], ..lit.clone() };
        assert!(!fits(&cache(), &input(part(&fewer_joints, 0.0), true)), "no such joint");
        let longer = Primitive { triangles: vec![[0, 1, 2]; 3], ..lit.clone() };
        assert!(!fits(&cache(), &input(part(&longer, 0.0), true)), "other triangles");
    }
}
