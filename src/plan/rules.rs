//! The rules of all parts in flow order: the key of each, or why nothing calls for it.

use super::keys::{Keys, Wanted};
use super::{Asked, Held, Part, light, surfaces, views, voxels};

impl Keys {
    pub(super) fn new(asked: &Asked, held: &Held) -> Self {
        let mut keys = Self::default();
        for part in Part::ALL {
            // In flow order, so that the keys of its inputs are there.
            let wanted = wanted(part, asked, &keys, held);
            keys.put(part, wanted);
        }
        keys
    }
}

/// The frame, part by part, in the order of section 4.1.
fn wanted(part: Part, asked: &Asked, keys: &Keys, held: &Held) -> Wanted {
    match part {
        Part::Caches => voxels::caches(asked),
        Part::Pages => voxels::pages(asked, keys),
        Part::RigidVoxels => voxels::rigid(asked, keys),
        Part::SkinnedVoxels => voxels::skinned(asked, keys),
        Part::Materials => voxels::materials(asked),
        Part::Columns => voxels::columns(asked, keys),
        Part::PosedVoxels => voxels::posed_voxels(asked, keys),
        Part::JoinedVoxels => voxels::joined(keys),
        Part::Masks => voxels::masks(asked, keys),
        Part::Topology => voxels::topology(keys),
        Part::Payload => voxels::payload(keys),
        Part::ObjectNumbers => voxels::object_numbers(asked, keys),
        Part::BlockLinks | Part::NodeLinks => voxels::links(part, asked, keys),
        Part::Emission => light::emission(asked, keys),
        Part::ShadowMaps => light::shadow_maps(asked),
        Part::Light => light::light(asked, keys, held),
        Part::Irradiance => light::irradiance(asked, keys),
        Part::SurfaceImage => surfaces::image(asked),
        Part::DirectLight => surfaces::direct(asked, keys),
        Part::DiffuseLight => surfaces::diffuse(asked, keys),
        Part::GlossyTiles => surfaces::glossy_tiles(asked, keys),
        Part::SpecularLight => surfaces::specular(asked, keys),
        Part::ComposedLight => surfaces::composed(asked, keys),
        Part::Exposure => surfaces::exposure(asked, keys),
        Part::ExactBits => views::exact_bits(asked),
        Part::ExactMasks => views::exact_masks(asked, keys),
        Part::Picture => views::picture(asked, keys),
        Part::Comparison => views::comparison(asked, keys),
    }
}
