// Averages one level into the level above (section 4.4 end, "down to top"): occupancies add up as
// exact integers, albedo and normal are means weighted by occupancy. A thread a node; nodes without
// children, dummies among them, get exactly zero.
#import shared/threads.wgsl
#import shared/octree.wgsl
#import shared/node.wgsl

struct AverageParams {
    // The level that is written.
    level: u32,
}

@group(0) @binding(0) var<uniform> octree: OctreeParams;
@group(0) @binding(1) var<uniform> params: AverageParams;
@group(0) @binding(2) var<storage, read> first_child: array<u32>;
@group(0) @binding(3) var<storage, read_write> nodes: array<vec4<u32>>;

override WORKGROUP_SIZE: u32 = 64u;

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let thread = thread_index(id, groups);
    if thread >= min(threads.end, level_node_count(params.level)) {
        return;
    }
    let level = octree.levels[params.level];
    let node = level.first_node + thread;
    var child = first_child[node];
    if params.level < octree.dense_level {
        child = octree.levels[params.level + 1u].first_node + 8u * thread;
    }
    var sum = empty_sum();
    if child != 0u {
        for (var i = 0u; i < 8u; i += 1u) {
            let n = nodes[child + i];
            sum = add_child(sum, n.x, n.y, unpack_biased(n.z), unpack_biased(n.w));
        }
    }
    nodes[node] = finish_node(sum);
}
