//! What the voxels of a scene emit: the unit in which the GPU holds it.

use std::sync::Arc;

use crate::data::light::pack_emission;
use crate::data::voxel_cache::VoxelCache;
use crate::scene::{Scene, Warning};

/// Largest channel of any voxel and of what makes it emit, nits, and a warning where voxels are too dim to be held
/// beside it. A voxel that holds more of a lamp than those of the caches is as bright as its material.
pub fn brightest(scene: &Scene, caches: &[Arc<VoxelCache>]) -> (f32, Option<Warning>) {
    let of_voxels = caches.iter().flat_map(|cache| &cache.emission).flatten().copied().fold(0.0, f32::max);
    let materials = scene.meshes.iter().flat_map(|mesh| &mesh.primitives).map(|primitive| scene.material_of(primitive));
    let of_materials = materials.flat_map(|material| material.emissive).fold(0.0, f32::max);
    let brightest = if of_voxels > 0.0 { of_voxels.max(of_materials) } else { 0.0 };
    let is_lost = |voxel: &&[f32; 3]| **voxel != [0.0; 3] && pack_emission(**voxel, brightest) == [0; 2];
    let lost = caches.iter().flat_map(|cache| &cache.emission).filter(is_lost).count();
    let warning = (lost > 0).then(|| {
        Warning::new(format!(
            "{}: {lost} voxels emit less than a two-millionth of the brightest ({brightest} nits); they are dark",
            scene.name
        ))
    });
    (brightest, warning)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_brightest_is_the_unit_and_what_is_lost_beside_it_is_told() {
        let cache = |emission: Vec<[f32; 3]>| Arc::new(VoxelCache { emission, ..VoxelCache::default() });
        let lamp = Scene { name: "lamp".to_owned(), ..Scene::default() };
        assert_eq!(brightest(&lamp, &[cache(vec![])]), (0.0, None));
        assert_eq!(brightest(&lamp, &[cache(vec![[0.0, 2.0, 1.0]]), cache(vec![[0.0; 3]])]), (2.0, None));
        let (nits, warning) = brightest(&lamp, &[cache(vec![[4e6, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 4.0, 0.0]])]);
        assert_eq!(nits, 4e6);
        assert!(warning.is_some_and(|warning| warning.sentence.starts_with("lamp: 1 voxels emit less")));
    }
}
