//! What an entry is found by: a hash of everything that the work reads.

use std::fmt;

use blake3::Hash;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ContentKey(Hash);

impl ContentKey {
    /// `content`: of everything that the work reads, and of its version.
    pub fn new(content: Hash) -> Self {
        Self(content)
    }

    pub(super) fn bytes(&self) -> &[u8; 32] {
        self.0.as_bytes()
    }
}

/// In hexadecimal.
impl fmt::Display for ContentKey {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.0.to_hex())
    }
}
