//! What entries of every kind begin with.
//!
//! ```text
//! head         magic 8 | format version 4 | description bytes 4 | key 32 | hash 32
//! description  postcard: what follows
//! pieces       as in memory
//! ```
//!
//! The hash is of everything in the file but itself. It finds accidents, not intent: anybody can
//! write an entry with a right hash, so what it says is also checked against what it may say.

use std::io::{self, Write};

use bytemuck::{AnyBitPattern, NoUninit, Pod, Zeroable};
use serde::Serialize;

use super::content_key::ContentKey;

/// What an entry holds.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    pub magic: [u8; 8],
    /// Goes up with every change of the layout behind the head.
    pub format_version: u32,
    pub extension: &'static str,
}

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

impl Head {
    fn new(kind: &Kind, key: &ContentKey, description_bytes: u32) -> Self {
        Self {
            magic: kind.magic,
            format_version: kind.format_version.to_le_bytes(),
            description_bytes: description_bytes.to_le_bytes(),
            key: *key.bytes(),
            hash: [0; 32],
        }
    }

    /// The same with the hash of an entry that has these pieces behind its head.
    fn sealing(self, pieces: &[&[u8]]) -> Self {
        let Self { magic, format_version, description_bytes, key, hash: _ } = &self;
        let mut hasher = blake3::Hasher::new();
        for piece in [magic.as_slice(), format_version, description_bytes, key].iter().chain(pieces) {
            hasher.update(piece);
        }
        Self { hash: *hasher.finalize().as_bytes(), ..self }
    }
}

/// An entry ready to be written; its pieces are not copied.
pub struct Sealed<'a> {
    head: Head,
    description: Vec<u8>,
    pieces: Vec<&'a [u8]>,
}

impl<'a> Sealed<'a> {
    pub fn new(kind: &Kind, key: &ContentKey, description: &impl Serialize, pieces: Vec<&'a [u8]>) -> io::Result<Self> {
        let description = postcard::to_stdvec(description).map_err(io::Error::other)?;
        let description_bytes = u32::try_from(description.len()).map_err(io::Error::other)?;
        let all: Vec<&[u8]> = [description.as_slice()].into_iter().chain(pieces.iter().copied()).collect();
        let head = Head::new(kind, key, description_bytes).sealing(&all);
        Ok(Self { head, description, pieces })
    }

    /// Bytes of the file.
    pub fn bytes(&self) -> u64 {
        let pieces: usize = self.pieces.iter().map(|piece| piece.len()).sum();
        (size_of::<Head>() + self.description.len() + pieces) as u64
    }

    pub fn write(&self, file: &mut impl Write) -> io::Result<()> {
        file.write_all(bytemuck::bytes_of(&self.head))?;
        file.write_all(&self.description)?;
        self.pieces.iter().try_for_each(|piece| file.write_all(piece))
    }
}

/// Description and pieces of an entry; `None` where its head or its hash is wrong.
pub fn open<'a>(bytes: &'a [u8], kind: &Kind, key: &ContentKey) -> Option<(&'a [u8], &'a [u8])> {
    let (head, rest) = bytes.split_at_checked(size_of::<Head>())?;
    let head: Head = bytemuck::pod_read_unaligned(head);
    let description_bytes = u32::from_le_bytes(head.description_bytes);
    let expected = Head::new(kind, key, description_bytes).sealing(&[rest]);
    (bytemuck::bytes_of(&head) == bytemuck::bytes_of(&expected))
        .then(|| rest.split_at_checked(description_bytes as usize))?
}

/// The first `count` values of `bytes`, taken off; allocates nothing where there are fewer.
pub fn take<T: AnyBitPattern + NoUninit>(bytes: &mut &[u8], count: u64) -> Option<Vec<T>> {
    let needed = usize::try_from(count).ok()?.checked_mul(size_of::<T>())?;
    let (taken, rest) = bytes.split_at_checked(needed)?;
    *bytes = rest;
    Some(bytemuck::pod_collect_to_vec(taken))
}
