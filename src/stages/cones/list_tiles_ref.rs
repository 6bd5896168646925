//! Reference of `list_tiles`: the numbers of the marked ones.

pub fn list_tiles(is_marked: &[bool]) -> Vec<u32> {
    (0..).zip(is_marked).filter(|(_, is_marked)| **is_marked).map(|(tile, _)| tile).collect()
}
