//! Voxels as a file: see [`crate::disk_cache::Sealed`] for its head.
//!
//! ```text
//! description  tiles, report, numbers of voxels, emissions and joints
//! voxels       16 bytes each     ┐
//! emission     12 bytes each     ├ as in memory
//! joints       12 bytes each     ┘
//! ```
//!
//! Reading allocates no more than twice the file's size.

use std::io;

use serde::{Deserialize, Serialize};

use crate::data::voxel_cache::{CacheVoxel, Tile, VoxelCache, VoxelJoints, VoxelizeReport};
use crate::disk_cache::{ContentKey, Kind, Sealed, open, take};

pub(super) const KIND: Kind = Kind { magic: *b"OCTVOXEL", format_version: 1, extension: "voxels" };

#[derive(Serialize, Deserialize)]
struct Description {
    tiles: Vec<Tile>,
    report: VoxelizeReport,
    voxels: u64,
    emissions: u64,
    joints: u64,
}

/// A cache ready to be written; its voxels are not copied.
pub(super) fn encode<'a>(key: &ContentKey, cache: &'a VoxelCache) -> io::Result<Sealed<'a>> {
    let VoxelCache { tiles, voxels, emission, joints, report } = cache;
    let description = Description {
        tiles: tiles.clone(),
        report: *report,
        voxels: voxels.len() as u64,
        emissions: emission.len() as u64,
        joints: joints.len() as u64,
    };
    sealed(key, &description, cache)
}

fn sealed<'a>(key: &ContentKey, description: &Description, cache: &'a VoxelCache) -> io::Result<Sealed<'a>> {
    let VoxelCache { tiles: _, voxels, emission, joints, report: _ } = cache;
    let pieces: [&[u8]; 3] =
        [bytemuck::cast_slice(voxels), bytemuck::cast_slice(emission), bytemuck::cast_slice(joints)];
    Sealed::new(&KIND, key, description, pieces.to_vec())
}

/// The cache in a file's bytes; `None` where anything about them is wrong.
pub(super) fn decode(bytes: &[u8], key: &ContentKey) -> Option<VoxelCache> {
    let (description, mut rest) = open(bytes, &KIND, key)?;
    let (description, []) = postcard::take_from_bytes::<Description>(description).ok()? else { return None };
    let cache = VoxelCache {
        tiles: description.tiles,
        voxels: take::<CacheVoxel>(&mut rest, description.voxels)?,
        emission: take::<[f32; 3]>(&mut rest, description.emissions)?,
        joints: take::<VoxelJoints>(&mut rest, description.joints)?,
        report: description.report,
    };
    (rest.is_empty() && cache.validate().is_ok()).then_some(cache)
}

#[cfg(test)]
pub(super) mod tests {
    use glam::IVec3;

    use super::*;
    use crate::prepare::kept::TextureHashes;
    use crate::stages::voxelize::{TexturePyramids, VoxelizeInput};

    fn key() -> ContentKey {
        let textures = TexturePyramids::new(&[]);
        let input = VoxelizeInput {
            parts: Vec::new(),
            materials: &[],
            textures: &textures,
            mode: Default::default(),
            joints: None,
        };
        ContentKey::of(&input, &TextureHashes::new(&[]))
    }

    /// Three voxels with emission and joints.
    pub fn cache() -> VoxelCache {
        let voxel = |position| CacheVoxel { position, normal: 0, albedo: 7, surface: 9 };
        VoxelCache {
            tiles: vec![Tile { origin: IVec3::new(-3, 4, 500), voxels: 0..3 }],
            voxels: vec![voxel(0), voxel(1), voxel(1 << 10)],
            emission: vec![[0.25, 0.5, 3.0]; 3],
            joints: vec![VoxelJoints { joints: [2, 0, 1, 0], weights: [200, 50, 5, 0] }; 3],
            report: VoxelizeReport { triangles: 2, ..VoxelizeReport::default() },
        }
    }

    fn bytes(encoded: &Sealed) -> Vec<u8> {
        let mut bytes = Vec::new();
        encoded.write(&mut bytes).expect("memory takes everything");
        bytes
    }

    /// Somebody who computes hashes rightly, and whose numbers are wrong.
    fn forged(forge: impl FnOnce(&mut Description)) -> Vec<u8> {
        let cache = cache();
        let mut description = Description {
            tiles: cache.tiles.clone(),
            report: cache.report,
            voxels: cache.voxels.len() as u64,
            emissions: cache.emission.len() as u64,
            joints: cache.joints.len() as u64,
        };
        forge(&mut description);
        bytes(&sealed(&key(), &description, &cache).expect("encodes"))
    }

    #[test]
    fn what_is_written_is_read_and_nothing_else() {
        let cache = cache();
        let encoded = encode(&key(), &cache).expect("encodes");
        let good = bytes(&encoded);
        assert_eq!(good.len() as u64, encoded.bytes());
        assert_eq!(decode(&good, &key()), Some(cache));
        for cut in 0..good.len() {
            assert_eq!(decode(&good[..cut], &key()), None, "{cut} bytes");
        }
        for bit in 0..8 * good.len() {
            let mut flipped = good.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            assert_eq!(decode(&flipped, &key()), None, "bit {bit}");
        }
        assert_eq!(decode(&[good.as_slice(), &[0]].concat(), &key()), None);
    }

    #[test]
    fn forged_numbers_are_refused_before_anything_is_allocated() {
        assert_eq!(decode(&forged(|_| {}), &key()), Some(cache()));
        let forgeries: [fn(&mut Description); 7] = [
            |description| description.voxels = u64::MAX,
            |description| description.voxels = 1 << 60,
            |description| (description.voxels, description.emissions) = (2, 3),
            |description| description.joints = u64::MAX / 12 + 2,
            |description| description.tiles[0].voxels = 0..u32::MAX,
            |description| description.tiles.clear(),
            |description| description.tiles[0].origin = IVec3::MIN,
        ];
        for (number, forge) in forgeries.into_iter().enumerate() {
            assert_eq!(decode(&forged(forge), &key()), None, "{number}");
        }
        // A description that names four thousand million tiles and holds none.
        let promising = Sealed::new(&KIND, &key(), &u32::MAX, Vec::new()).expect("encodes");
        assert_eq!(decode(&bytes(&promising), &key()), None);
    }
}
