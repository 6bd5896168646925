//! Reference of `list_tiles`: how many are marked, then their numbers.

pub fn list_tiles(is_marked: &[bool]) -> Vec<u32> {
    let count = is_marked.iter().filter(|is_marked| **is_marked).count() as u32;
    let marked = (0..).zip(is_marked).filter(|(_, is_marked)| **is_marked).map(|(tile, _)| tile);
    [count].into_iter().chain(marked).collect()
}
