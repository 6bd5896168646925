// Radiance and opacity at a point, for a direction (sections 4.4 and 4.5). Results are
// (radiance · α, α), α being opacity per leaf cell of length:
//   isotropic    α = opacity of the node, whatever its level
//   DIRECTIONAL  1 − α = Π (1 − a_i)^(d_i² / width), a_i = opacity across the node along axis i
// The axes' optical depths mix, not their opacities: a wall across x then stops slanting rays too. (By
// opacities, 1 − Σ d_i² a_i, one-voxel walls lose half of what they stop at 45°.)
// Positions in cells from the grid's corner; cell i spans i … i + 1. Outside the grid all is zero.
//
// The kernel declares `light`, and says how nodes are found: `entry_of(level, node)`, and
// `corners_of(level, base)`; see shared/corners.wgsl.
#import shared/corners.wgsl

override DIRECTIONAL: bool = false;
// One of FILTER_*.
override FILTER: u32 = FILTER_QUADRILINEAR;

// Cells a node of a level spans.
fn node_width(level: u32) -> f32 {
    return f32(1u << (octree.depth - level));
}

// What one node holds. Leaves are alike along all axes.
fn light_at(entry: u32, direction: vec3<f32>, width: f32) -> vec4<f32> {
    if entry == NO_BLOCK {
        return vec4<f32>(0.0);
    }
    let stored = light[entry];
    if !DIRECTIONAL || entry >= octree.inner_node_count || stored.w == 0.0 {
        return stored;
    }
    let axes = light[octree.inner_node_count + octree.leaf_count + entry].xyz;
    // An f32 opacity knows no less than this; a wall that stops all has a finite depth, too.
    let through = max(1.0 - axes, vec3<f32>(LEAST_THROUGH));
    let alpha = 1.0 - exp2(dot(direction * direction, log2(through)) / width);
    return vec4<f32>(stored.xyz * (alpha / stored.w), alpha);
}

// The node that a point lies in.
fn sample_nearest(level: u32, p: vec3<f32>, direction: vec3<f32>) -> vec4<f32> {
    let width = node_width(level);
    let node = floor(p / width);
    if !(all(node >= vec3<f32>(0.0)) && all(node < vec3<f32>(f32(1u << level)))) {
        return vec4<f32>(0.0);
    }
    return light_at(entry_of(level, vec3<i32>(node)), direction, width);
}

fn sample_trilinear(level: u32, p: vec3<f32>, direction: vec3<f32>) -> vec4<f32> {
    let width = node_width(level);
    let lattice = p / width - 0.5;
    let base = floor(lattice);
    // Compared as floats first: far positions do not fit an integer.
    if !(all(base >= vec3<f32>(-1.0)) && all(base < vec3<f32>(f32(1u << level)))) {
        return vec4<f32>(0.0);
    }
    let f = lattice - base;
    let corners = corners_of(level, vec3<i32>(base));
    var sum = vec4<f32>(0.0);
    for (var j = 0u; j < 8u; j += 1u) {
        let w = select(1.0 - f, f, corner_offset(j) == vec3<u32>(1u));
        sum += w.x * w.y * w.z * light_at(corners.entries[j], direction, width);
    }
    return sum;
}

// Two neighbouring levels, blended by log2 of the width; widths clamp to a leaf and to the root.
fn sample_quadrilinear(width_cells: f32, p: vec3<f32>, direction: vec3<f32>) -> vec4<f32> {
    let rise = clamp(log2(max(width_cells, 1.0)), 0.0, f32(octree.depth));
    let steps = u32(rise);
    let blend = rise - f32(steps);
    let level = octree.depth - steps;
    let fine = sample_trilinear(level, p, direction);
    if blend == 0.0 {
        return fine;
    }
    return (1.0 - blend) * fine + blend * sample_trilinear(level - 1u, p, direction);
}

// What a cone of that width sees: without quadrilinear sampling, in the level of the nearest width.
fn sample_width(width_cells: f32, p: vec3<f32>, direction: vec3<f32>) -> vec4<f32> {
    if FILTER == FILTER_QUADRILINEAR {
        return sample_quadrilinear(width_cells, p, direction);
    }
    let level = octree.depth - u32(clamp(log2(max(width_cells, 1.0)) + 0.5, 0.0, f32(octree.depth)));
    if FILTER == FILTER_TRILINEAR {
        return sample_trilinear(level, p, direction);
    }
    return sample_nearest(level, p, direction);
}
