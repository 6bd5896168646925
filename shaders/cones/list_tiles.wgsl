// Lists the marked tiles in order. A thread a tile. `ranks`: set bits of `tiles` before each word.
#import shared/threads.wgsl

@group(0) @binding(0) var<storage, read> tiles: array<u32>;
@group(0) @binding(1) var<storage, read> ranks: array<u32>;
@group(0) @binding(2) var<storage, read_write> list: array<u32>;

override WORKGROUP_SIZE: u32 = 64u;

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let tile = thread_index(id, groups);
    if tile >= threads.end {
        return;
    }
    let word = tiles[tile >> 5u];
    let bit = 1u << (tile & 31u);
    if (word & bit) != 0u {
        list[ranks[tile >> 5u] + countOneBits(word & (bit - 1u))] = tile;
    }
}
