// A tile of an object's cache and what moves it; the work list names it.

struct Part {
    // Added to cache positions before the matrix: parts of one skin share their joints' matrices.
    origin: vec3<i32>,
    first_matrix: u32,
    // Cache voxel minus joint record index; skinned parts only.
    joints_skew: u32,
    // Object number in the scene.
    object: u32,
    // Cache voxel minus emission record index; NO_BLOCK where nothing emits.
    emission_skew: u32,
    pad: u32,
}
