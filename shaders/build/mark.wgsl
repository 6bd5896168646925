// Marks the leaves that voxels touch, one bit a cell in Morton order, so that a byte is the child
// mask of a node. In: world voxels. Out: leaf bits, and the weight that fell outside the grid:
// kept + clipped = 2^24 a voxel, to the last unit.
#import shared/threads.wgsl
#import shared/work_list.wgsl
#import shared/world_voxel.wgsl
#import shared/octree.wgsl
#import shared/counter.wgsl

@group(0) @binding(0) var<uniform> octree: OctreeParams;
@group(0) @binding(1) var<storage, read> work_items: array<WorkItem>;
@group(0) @binding(2) var<storage, read> work_hints: array<u32>;
@group(0) @binding(3) var<storage, read> world_voxels: array<vec4<u32>>;
@group(0) @binding(4) var<storage, read_write> leaf_bits: array<atomic<u32>>;
@group(0) @binding(5) var<storage, read_write> counters: array<atomic<u32>>;

override WORKGROUP_SIZE: u32 = 64u;
override SPLIT: bool = true;

// Most bits are set already: reading first spares the atomic.
fn set_bits(word: u32, mask: u32) {
    if (atomicLoad(&leaf_bits[word]) & mask) != mask {
        atomicOr(&leaf_bits[word], mask);
    }
}

fn mark_nearest(q: vec3<i32>) -> u32 {
    let cell = nearest_cell(q);
    if !inside_grid(cell) {
        return FULL_WEIGHT;
    }
    let key = morton_key(vec3<u32>(cell));
    set_bits(key >> 5u, 1u << (key & 31u));
    return 0u;
}

// Key bits of the base layer and the one behind it along an axis; 0 weight leaves a layer out.
fn axis_keys(base: i32, shift: u32) -> vec2<u32> {
    return vec2<u32>(spread_bits(u32(max(base, 0))), spread_bits(u32(base + 1))) << vec2<u32>(shift);
}

// Corners that share a word are set by one atomic.
fn mark_split(q: vec3<i32>) -> u32 {
    let base = base_cell(q);
    let f = fraction(q);
    let x = axis_keys(base.x, 0u);
    let y = axis_keys(base.y, 1u);
    let z = axis_keys(base.z, 2u);
    // Weight of each layer, 0 outside the grid: a corner's is the product.
    let near = select(vec3<u32>(FRACTION_ONE) - f, vec3<u32>(0u), base < vec3<i32>(0));
    let far = select(f, vec3<u32>(0u), base + 1 >= vec3<i32>(grid_cells()));
    var kept = 0u;
    var word = 0u;
    var mask = 0u;
    for (var corner = 0u; corner < 8u; corner += 1u) {
        let offset = corner_offset(corner);
        let w = select(near, far, offset == vec3<u32>(1u));
        let weight = w.x * w.y * w.z;
        if weight == 0u {
            continue;
        }
        kept += weight;
        let key = x[offset.x] | y[offset.y] | z[offset.z];
        if (key >> 5u) != word {
            if mask != 0u {
                set_bits(word, mask);
            }
            word = key >> 5u;
            mask = 0u;
        }
        mask |= 1u << (key & 31u);
    }
    if mask != 0u {
        set_bits(word, mask);
    }
    return FULL_WEIGHT - kept;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let thread = thread_index(id, groups);
    if thread >= threads.end {
        return;
    }
    let voxel = world_voxels[slot_of(work_item(thread), thread)];
    if is_no_voxel(voxel) {
        return;
    }
    var clipped = FULL_WEIGHT;
    if voxel.x != OUTSIDE {
        let q = unpack_q(voxel.xy);
        if SPLIT {
            clipped = mark_split(q);
        } else {
            clipped = mark_nearest(q);
        }
    }
    if clipped != 0u {
        count64(COUNTER_CLIPPED, clipped);
    }
}
