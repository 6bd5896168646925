// How large the octree is, once the scan knows: the counts that all later kernels end at. One thread. In: what
// there is room for. Out: the truth where all levels and the leaves have room, else an octree without blocks, so
// that whatever follows writes nothing that has no place.
#import shared/threads.wgsl
#import shared/octree.wgsl

@group(0) @binding(0) var<uniform> room: OctreeParams;
@group(0) @binding(1) var<storage, read> ranks: array<u32>;
@group(0) @binding(2) var<storage, read> counters: array<u32>;
@group(0) @binding(3) var<storage, read_write> octree: OctreeParams;

override WORKGROUP_SIZE: u32 = 64u;

// Rank of a level's first block; behind the last level, how many blocks there are.
fn first_block(level: u32) -> u32 {
    if level < room.depth {
        return ranks[room.levels[level].blocks_word];
    }
    let last = room.depth - 1u;
    return ranks[room.levels[last].blocks_word + ((1u << (3u * last)) + 31u) / 32u];
}

fn room_for_blocks(level: u32) -> u32 {
    var end = room.block_count;
    if level + 1u < room.depth {
        end = room.levels[level + 1u].first_block;
    }
    return end - room.levels[level].first_block;
}

fn has_room(leaf_count: u32) -> bool {
    for (var level = room.dense_level; level < room.depth; level += 1u) {
        if first_block(level + 1u) - first_block(level) > room_for_blocks(level) {
            return false;
        }
    }
    return leaf_count <= room.leaf_count;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    if thread_index(id, groups) >= threads.end {
        return;
    }
    let leaf_count = counters[2u * (COUNTER_OCCUPIED + room.depth)];
    let fits = has_room(leaf_count);
    var made = room;
    made.leaf_count = select(0u, leaf_count, fits);
    made.inner_node_count = room.dense_node_count;
    var first = 0u;
    for (var level = room.dense_level; level < room.depth; level += 1u) {
        made.levels[level].first_block = first;
        if level > room.dense_level {
            made.levels[level].first_node = made.inner_node_count;
            made.inner_node_count = room.dense_node_count + 8u * first;
        }
        made.leaf_block_count = select(0u, first_block(level + 1u) - first, fits);
        first += made.leaf_block_count;
    }
    made.block_count = first;
    octree = made;
}
