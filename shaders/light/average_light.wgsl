// Averages one level's light into the level above (section 4.4 end, "down to top"), apart from its
// occupancy: light times opacity is a mean over the eight children, floats throughout; opacity is the
// occupied share, from the exact sum. With DIRECTIONAL, opacity along an axis too: of two children one
// behind the other, what the first lets through meets the second; the four such pairs average.
#import shared/threads.wgsl
#import shared/octree.wgsl
#import shared/leaf_mask.wgsl
#import shared/wide.wgsl

struct AverageLightParams {
    // The level that is written.
    level: u32,
}

@group(0) @binding(0) var<uniform> octree: OctreeParams;
@group(0) @binding(1) var<uniform> params: AverageLightParams;
@group(0) @binding(2) var<storage, read> first_child: array<u32>;
@group(0) @binding(3) var<storage, read> leaf_bits: array<u32>;
@group(0) @binding(4) var<storage, read> block_keys: array<u32>;
@group(0) @binding(5) var<storage, read> block_starts: array<u32>;
@group(0) @binding(6) var<storage, read> nodes: array<vec4<u32>>;
// Inner nodes, leaves; with DIRECTIONAL, opacity of inner nodes along x, y, z.
@group(0) @binding(7) var<storage, read_write> light: array<vec4<f32>>;

override WORKGROUP_SIZE: u32 = 64u;
override DIRECTIONAL: bool = false;

struct Children {
    // Light times opacity, summed.
    light: vec3<f32>,
    // Opacity along x, y, z of child x + 2y + 4z.
    opacity: array<vec3<f32>, 8>,
}

// Children that are leaves: occupied ones have a slot, in order.
fn leaf_children(child: u32) -> Children {
    let block = (child - octree.dense_node_count) / 8u;
    let key = block_keys[block];
    let mask = leaf_mask(key);
    var slot = octree.inner_node_count + block_starts[2u * (block - octree.levels[octree.depth - 1u].first_block) + 1u];
    var children = Children();
    for (var i = 0u; i < 8u; i += 1u) {
        if ((mask >> i) & 1u) != 0u {
            children.light += light[slot].xyz;
            children.opacity[i] = vec3<f32>(light[slot].w);
            slot += 1u;
        }
    }
    return children;
}

fn node_children(child: u32) -> Children {
    var children = Children();
    for (var i = 0u; i < 8u; i += 1u) {
        children.light += light[child + i].xyz;
        if DIRECTIONAL {
            children.opacity[i] = light[octree.inner_node_count + octree.leaf_count + child + i].xyz;
        }
    }
    return children;
}

fn behind(near: f32, far: f32) -> f32 {
    return 1.0 - (1.0 - near) * (1.0 - far);
}

fn axis_opacity(o: array<vec3<f32>, 8>) -> vec3<f32> {
    let x = behind(o[0].x, o[1].x) + behind(o[2].x, o[3].x) + behind(o[4].x, o[5].x) + behind(o[6].x, o[7].x);
    let y = behind(o[0].y, o[2].y) + behind(o[1].y, o[3].y) + behind(o[4].y, o[6].y) + behind(o[5].y, o[7].y);
    let z = behind(o[0].z, o[4].z) + behind(o[1].z, o[5].z) + behind(o[2].z, o[6].z) + behind(o[3].z, o[7].z);
    return vec3<f32>(x, y, z) / 4.0;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let thread = thread_index(id, groups);
    if thread >= min(threads.end, level_node_count(params.level)) {
        return;
    }
    let node = octree.levels[params.level].first_node + thread;
    var child = first_child[node];
    if params.level < octree.dense_level {
        child = octree.levels[params.level + 1u].first_node + 8u * thread;
    }
    var children = Children();
    if child != 0u {
        if params.level + 1u == octree.depth {
            children = leaf_children(child);
        } else {
            children = node_children(child);
        }
    }
    let occupied = wide_to_float(nodes[node].xy);
    let full = f32(FULL_WEIGHT) * exp2(3.0 * f32(octree.depth - params.level));
    light[node] = vec4<f32>(children.light / 8.0, occupied / full);
    if DIRECTIONAL {
        light[octree.inner_node_count + octree.leaf_count + node] = vec4<f32>(axis_opacity(children.opacity), 0.0);
    }
}
