//! 128 bits that stand for a content: two contents are equal where their digests are.

use std::fmt::{self, Display, Formatter};
use std::sync::atomic::{AtomicU64, Ordering};

use serde::de::{Error, Unexpected};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

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

    /// Of a file: the first half of what BLAKE3 makes of its bytes, as `b3sum` does.
    pub fn of_file(bytes: &[u8]) -> Self {
        Self::finished(blake3::Hasher::new().update(bytes))
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

/// 32 hexadecimal digits.
impl Display for Digest {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

impl Serialize for Digest {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Digest {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        let is_digest = text.len() == 32 && text.bytes().all(|digit| digit.is_ascii_hexdigit());
        let number = is_digest.then(|| u128::from_str_radix(&text, 16).ok()).flatten();
        let number = number.ok_or_else(|| D::Error::invalid_value(Unexpected::Str(&text), &"32 hexadecimal digits"))?;
        Ok(Self(number.to_be_bytes()))
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

    #[test]
    fn a_files_digest_is_written_as_b3sum_begins_and_read_again() {
        // b3sum of an empty file.
        let empty = "af1349b9f5f9a1a6a0404dea36dcc949";
        assert_eq!(Digest::of_file(b"").to_string(), empty);
        let json = serde_json::to_string(&Digest::of_file(b"glTF")).unwrap();
        assert_eq!(serde_json::from_str::<Digest>(&json).unwrap(), Digest::of_file(b"glTF"));
        for bad in ["\"af13\"", "\"+f1349b9f5f9a1a6a0404dea36dcc949\"", "7"] {
            assert!(serde_json::from_str::<Digest>(bad).is_err(), "{bad}");
        }
    }
}
