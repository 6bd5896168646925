//! Reference of `place_emission.wgsl`: emission goes where its voxel goes, and marks that block.

/// `places`: leaf block and place in it of each voxel, `None` outside. Out: emission by sorted place, and
/// whether each block emits.
pub fn place_emission(
    emission: &[[u32; 3]],
    places: &[Option<(usize, usize)>],
    block_starts: &[usize],
) -> (Vec<[u32; 3]>, Vec<bool>) {
    let mut sorted = vec![[0; 3]; places.iter().flatten().count()];
    let mut emits = vec![false; block_starts.len()];
    for (emission, place) in emission.iter().zip(places) {
        if let Some((block, place)) = *place {
            sorted[block_starts[block] + place] = *emission;
            emits[block] |= *emission != [0; 3];
        }
    }
    (sorted, emits)
}
