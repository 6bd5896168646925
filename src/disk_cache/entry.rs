//! An entry as a file.
//!
//! ```text
//! head         magic 8 | format version 4 | description bytes 4 | key 32 | hash 32
//! description  postcard: tiles, report, numbers of voxels, emissions and joints
//! voxels       16 bytes each     ┐
//! emission     12 bytes each     ├ as in memory
//! joints       12 bytes each     ┘
//! ```
//!
//! The hash is of everything in the file but itself. It finds accidents, not intent: anybody can
//! write an entry with a right hash, so what it says is also checked against what it may say.
//! Reading allocates no more than twice the file's size.

use std::io::{self, Write};

use bytemuck::{AnyBitPattern, Pod, Zeroable};
use serde::{Deserialize, Serialize};

use super::key::ContentKey;
use crate::data::voxel_cache::{CacheVoxel, Tile, VoxelCache, VoxelJoints, VoxelizeReport};

const MAGIC: [u8; 8] = *b"OCTVOXEL";
/// Goes up with every change of the layout above.
const FORMAT_VERSION: u32 = 1;

/// Bytes alone, so that it needs no alignment. Numbers are little-endian.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Head {
    magic: [u8; 8],
    format_version: [u8; 4],
    description_bytes: [u8; 4],
    key: [u8; 32],
    hash: [u8; 32],
}

#[derive(Serialize, Deserialize)]
struct Description {
    tiles: Vec<Tile>,
    report: VoxelizeReport,
    voxels: u64,
    emissions: u64,
    joints: u64,
}

impl Head {
    fn new(key: &ContentKey, description_bytes: u32) -> Self {
        Self {
            magic: MAGIC,
            format_version: FORMAT_VERSION.to_le_bytes(),
            description_bytes: description_bytes.to_le_bytes(),
            key: *key.bytes(),
            hash: [0; 32],
        }
    }

    /// The hash of an entry with this head and these pieces behind it.
    fn hash_with(&self, pieces: &[&[u8]]) -> [u8; 32] {
        let Self { magic, format_version, description_bytes, key, hash: _ } = self;
        let mut hasher = blake3::Hasher::new();
        for piece in [magic.as_slice(), format_version, description_bytes, key].iter().chain(pieces) {
            hasher.update(piece);
        }
        *hasher.finalize().as_bytes()
    }
}

/// A cache ready to be written; its voxels are not copied.
pub(super) struct Encoded<'a> {
    head: Head,
    description: Vec<u8>,
    cache: &'a VoxelCache,
}

impl<'a> Encoded<'a> {
    pub fn new(key: &ContentKey, cache: &'a VoxelCache) -> io::Result<Self> {
        let VoxelCache { tiles, voxels, emission, joints, report } = cache;
        let description = Description {
            tiles: tiles.clone(),
            report: *report,
            voxels: voxels.len() as u64,
            emissions: emission.len() as u64,
            joints: joints.len() as u64,
        };
        let description = postcard::to_stdvec(&description).map_err(io::Error::other)?;
        let description_bytes = u32::try_from(description.len()).map_err(io::Error::other)?;
        let mut encoded = Self { head: Head::new(key, description_bytes), description, cache };
        encoded.head.hash = encoded.head.hash_with(&encoded.pieces());
        Ok(encoded)
    }

    pub fn len(&self) -> u64 {
        let pieces: usize = self.pieces().iter().map(|piece| piece.len()).sum();
        (size_of::<Head>() + pieces) as u64
    }

    pub fn write(&self, file: &mut impl Write) -> io::Result<()> {
        file.write_all(bytemuck::bytes_of(&self.head))?;
        self.pieces().iter().try_for_each(|piece| file.write_all(piece))
    }

    fn pieces(&self) -> [&[u8]; 4] {
        let VoxelCache { tiles: _, voxels, emission, joints, report: _ } = self.cache;
        [&self.description, bytemuck::cast_slice(voxels), bytemuck::cast_slice(emission), bytemuck::cast_slice(joints)]
    }
}

/// The cache in a file's bytes; `None` where anything about them is wrong.
pub(super) fn decode(bytes: &[u8], key: &ContentKey) -> Option<VoxelCache> {
    let (head, rest) = bytes.split_at_checked(size_of::<Head>())?;
    let head: Head = bytemuck::pod_read_unaligned(head);
    let description_bytes = u32::from_le_bytes(head.description_bytes);
    let mut expected = Head::new(key, description_bytes);
    expected.hash = expected.hash_with(&[rest]);
    if bytemuck::bytes_of(&head) != bytemuck::bytes_of(&expected) {
        return None;
    }
    let (description, mut rest) = rest.split_at_checked(description_bytes as usize)?;
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

/// The first `count` values of `bytes`, taken off; allocates nothing where there are fewer.
fn take<T: AnyBitPattern + bytemuck::NoUninit>(bytes: &mut &[u8], count: u64) -> Option<Vec<T>> {
    let needed = usize::try_from(count).ok()?.checked_mul(size_of::<T>())?;
    let (taken, rest) = bytes.split_at_checked(needed)?;
    *bytes = rest;
    Some(bytemuck::pod_collect_to_vec(taken))
}

#[cfg(test)]
pub(super) mod tests {
    use glam::IVec3;

    use super::*;
    use crate::disk_cache::TextureHashes;
    use crate::stages::voxelize::{TexturePyramids, VoxelizeInput};

    fn key() -> ContentKey {
        let textures = TexturePyramids::new(&[]);
        let input = VoxelizeInput {
            parts: Vec::new(),
            materials: &[],
            textures: &textures,
            mode: Default::default(),
            with_joints: false,
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

    fn bytes(encoded: &Encoded) -> Vec<u8> {
        let mut bytes = Vec::new();
        encoded.write(&mut bytes).expect("memory takes everything");
        bytes
    }

    /// Somebody who computes hashes rightly, and whose numbers are wrong.
    fn forged(forge: impl FnOnce(&mut Description)) -> Vec<u8> {
        let cache = cache();
        let mut encoded = Encoded::new(&key(), &cache).expect("encodes");
        let mut description: Description = postcard::from_bytes(&encoded.description).expect("decodes");
        forge(&mut description);
        encoded.description = postcard::to_stdvec(&description).expect("encodes");
        encoded.head = Head::new(&key(), encoded.description.len() as u32);
        encoded.head.hash = encoded.head.hash_with(&encoded.pieces());
        bytes(&encoded)
    }

    #[test]
    fn what_is_written_is_read_and_nothing_else() {
        let cache = cache();
        let encoded = Encoded::new(&key(), &cache).expect("encodes");
        let good = bytes(&encoded);
        assert_eq!(good.len() as u64, encoded.len());
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
        let description = postcard::to_stdvec(&u32::MAX).expect("encodes");
        let mut head = Head::new(&key(), description.len() as u32);
        head.hash = head.hash_with(&[&description]);
        assert_eq!(decode(&[bytemuck::bytes_of(&head), &description].concat(), &key()), None);
    }
}
