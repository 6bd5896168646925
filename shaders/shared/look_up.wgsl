// Sampling with the way to the nodes as a choice: ranks, or pointers as in the paper. The kernel
// declares `blocks`, `ranks`, `first_child`, `neighbours`, `leaf_bits`, `block_starts` and `light`.
#import shared/corners_ranked.wgsl
#import shared/corners_linked.wgsl
#import shared/sample.wgsl

override LINKED: bool = false;

fn entry_of(level: u32, node: vec3<i32>) -> u32 {
    if LINKED {
        return linked_entry(level, node);
    }
    return ranked_entry(level, node);
}

fn corners_of(level: u32, base: vec3<i32>) -> Corners {
    if LINKED {
        return linked_corners(level, base);
    }
    return ranked_corners(level, base);
}

// `at` is the level, or for quadrilinear sampling the width in cells.
fn sample_by_filter(at: f32, p: vec3<f32>, direction: vec3<f32>) -> vec4<f32> {
    if FILTER == FILTER_QUADRILINEAR {
        return sample_quadrilinear(at, p, direction);
    }
    if FILTER == FILTER_TRILINEAR {
        return sample_trilinear(u32(at), p, direction);
    }
    return sample_nearest(u32(at), p, direction);
}
