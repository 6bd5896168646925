//! What a scene holds in one pose, as far as a plan depends on it.

use crate::plan::SceneFacts;
use crate::prepare::Prepared;
use crate::scene::{Primitive, Scene};
use crate::settings::Hidden;

/// Counts a frame's voxels in the grid, and the triangles of what is not hidden. By part: whether it is there and moved,
/// and whether it is there and voxelized.
pub fn facts(
    prepared: &Prepared,
    [moved, voxelized]: [&[bool]; 2],
    hidden: &Hidden,
    glossy_roughness: f64,
) -> SceneFacts {
    let mut facts = SceneFacts::default();
    for (index, part) in prepared.parts.iter().enumerate().filter(|(index, _)| moved[*index] || voxelized[*index]) {
        let voxels = part.tile.voxels.len() as u64;
        if voxelized[index] {
            facts.voxelized += voxels
        } else if prepared.is_skinned(part) {
            facts.skinned_voxels += voxels
        } else {
            facts.rigid_voxels += voxels
        }
        if !prepared.caches[prepared.objects[part.object].cache].emission.is_empty() {
            facts.emissive_voxels += voxels;
        }
    }
    let shown = (0..).zip(&prepared.objects).filter(|(index, _)| !hidden.contains(*index));
    let scene = &prepared.scene;
    for (_, object) in shown {
        let mesh = &scene.meshes[object.object.mesh];
        facts.triangles += mesh.triangle_count() as u64;
        facts.glossy |= mesh.primitives.iter().any(|primitive| may_be_glossy(scene, primitive, glossy_roughness));
    }
    facts
}

/// What a texture makes of a roughness is known per pixel only.
fn may_be_glossy(scene: &Scene, primitive: &Primitive, glossy_roughness: f64) -> bool {
    let material = scene.material_of(primitive);
    let is_smooth = f64::from(material.roughness) <= glossy_roughness;
    !material.unlit && (is_smooth || material.metallic_roughness_texture.is_some())
}
