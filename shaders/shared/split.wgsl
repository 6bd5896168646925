// The 8-neighbour split (section 3.3): eight integer weights that sum to exactly 2^24.
#import shared/world_voxel.wgsl

// Weight of the corner at `offset` (0 or 1 an axis) from the base cell: the share of a unit cube
// at `fraction` that lies in that cell.
fn split_weight(f: vec3<u32>, offset: vec3<u32>) -> u32 {
    let w = select(vec3<u32>(FRACTION_ONE) - f, f, offset == vec3<u32>(1u));
    return w.x * w.y * w.z;
}
