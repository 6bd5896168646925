// Radiance and opacity at a point, for a direction (sections 4.4 and 4.5). Results are
// (radiance · α, α), α being opacity per leaf cell of length:
//   isotropic    α = opacity of the node, whatever its level
//   DIRECTIONAL  1 − α = Π (1 − a_i)^(d_i² / width), a_i = opacity across the node along axis i
// The axes' optical depths mix, not their opacities: a wall across x then stops slanting rays too. (By
// opacities, 1 − Σ d_i² a_i, one-voxel walls lose half of what they stop at 45°.)
// Positions in cells from the grid's corner; cell i spans i … i + 1. Outside the grid all is zero.
//
// Beside a surface, HORIZON leaves out the nodes that its own plane may cut: a wide cone would take the surface
// that it looks up from for something in its way. A node counts by how far it lies above the horizon, in full
// from HORIZON_FADE of its width on, and the others' weights make up for it down to HORIZON_SHARE of all.
//
// The kernel declares `light`, and says how nodes are found: `entry_of(level, node)`, and
// `corners_of(level, base)`; see shared/corners.wgsl.
#import shared/corners.wgsl

override DIRECTIONAL: bool = false;
// One of FILTER_*.
override FILTER: u32 = FILTER_QUADRILINEAR;
override HORIZON: bool = false;

// The plane below which nodes do not count: its unit normal n, and n · p of its points p. The kernel sets it.
var<private> horizon: vec4<f32>;

fn set_horizon(position: vec3<f32>, face: vec3<f32>) {
    horizon = vec4<f32>(face, dot(face, position) + HORIZON_CELLS);
}

// Height above the horizon of a node's lowest point, in widths of the node.
fn node_height(node: vec3<f32>, width: f32) -> f32 {
    let n = horizon.xyz;
    return dot(n, node + 0.5) - 0.5 * dot(abs(n), vec3<f32>(1.0)) - horizon.w / width;
}

// The part for which a node of that height counts.
fn part_above(height: f32) -> f32 {
    return clamp(height / HORIZON_FADE, 0.0, 1.0);
}

// From the weighted sum over nodes and the share of weight that counted.
fn made_up(sum: vec4<f32>, share: f32) -> vec4<f32> {
    return sum / max(share, HORIZON_SHARE);
}

// Cells a node of a level spans.
fn node_width(level: u32) -> f32 {
    return f32(1u << (octree.depth - level));
}

// What a node holds that is there. Leaves are alike along all axes.
fn light_at(entry: u32, direction: vec3<f32>, width: f32) -> vec4<f32> {
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
    let entry = entry_of(level, vec3<i32>(node));
    if entry == NO_BLOCK {
        return vec4<f32>(0.0);
    }
    let seen = light_at(entry, direction, width);
    if !HORIZON {
        return seen;
    }
    let part = part_above(node_height(node, width));
    return made_up(part * seen, part);
}

fn sample_trilinear(level: u32, p: vec3<f32>, direction: vec3<f32>) -> vec4<f32> {
    let width = node_width(level);
    let lattice = p / width - 0.5;
    let base = floor(lattice);
    // Compared as floats first: far positions do not fit an integer.
    if !(all(base >= vec3<f32>(-1.0)) && all(base < vec3<f32>(f32(1u << level)))) {
        return vec4<f32>(0.0);
    }
    let corners = corners_of(level, vec3<i32>(base));
    var weights = corner_weights(lattice - base);
    if !HORIZON {
        return weighted_light(corners, weights, direction, width);
    }
    let height = node_height(base, width);
    var share = 0.0;
    for (var j = 0u; j < 8u; j += 1u) {
        weights[j] *= part_above(height + dot(horizon.xyz, vec3<f32>(corner_offset(j))));
        share += weights[j];
    }
    return made_up(weighted_light(corners, weights, direction, width), share);
}

fn corner_weights(f: vec3<f32>) -> array<f32, 8> {
    var weights: array<f32, 8>;
    for (var j = 0u; j < 8u; j += 1u) {
        let w = select(1.0 - f, f, corner_offset(j) == vec3<u32>(1u));
        weights[j] = w.x * w.y * w.z;
    }
    return weights;
}

fn weighted_light(corners: Corners, weights: array<f32, 8>, direction: vec3<f32>, width: f32) -> vec4<f32> {
    var sum = vec4<f32>(0.0);
    for (var j = 0u; j < 8u; j += 1u) {
        // Many corners are empty, or below the horizon: a branch costs less than a look at memory.
        if weights[j] > 0.0 && corners.entries[j] != NO_BLOCK {
            sum += weights[j] * light_at(corners.entries[j], direction, width);
        }
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
