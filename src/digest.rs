//! 128 bits that stand for a content: two contents are equal where their digests are.

use std::sync::atomic::{AtomicU64, Ordering};

use serde::Serialize;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Digest([u8; 16]);

impl Digest {
    /// By value: floats by their bits. What cannot be written down is equal to nothing.
    pub fn of<T: Serialize + ?Sized>(value: &T) -> Self {
        match postcard::to_io(value, blake3::Hasher::new()) {
            Ok(hasher) => Self::finished(&hasher),
            Err(_) => Self::unlike_any(),
        }
    }

    /// Of several arrays, one after the other.
    pub fn of_bytes(parts: &[&[u8]]) -> Self {
        let mut hasher = blake3::Hasher::new();
        for part in parts {
            hasher.update(&(part.len() as u64).to_le_bytes()).update(part);
        }
        Self::finished(&hasher)
    }

    /// Equal to no other.
    pub fn unlike_any() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        Self::of_bytes(&[b"unlike any", &number.to_le_bytes()])
    }

    pub fn bytes(&self) -> &[u8] {
        &self.0
    }

    fn finished(hasher: &blake3::Hasher) -> Self {
        let mut digest = [0; 16];
        hasher.finalize_xof().fill(&mut digest);
        Self(digest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floats_count_by_their_bits_and_arrays_by_their_borders() {
        assert_ne!(Digest::of(&0.0_f64), Digest::of(&-0.0_f64));
        assert_eq!(Digest::of(&f64::NAN), Digest::of(&f64::NAN));
        assert_ne!(Digest::of_bytes(&[&[1, 2], &[3]]), Digest::of_bytes(&[&[1], &[2, 3]]));
        assert_ne!(Digest::unlike_any(), Digest::unlike_any());
    }
}
