//! Reference of the copy kernel.

/// The first `words` are the original's, the rest stays as it was.
pub fn copy(original: &[u32], duplicate: &mut [u32], words: usize) {
    duplicate[..words].copy_from_slice(&original[..words]);
}
