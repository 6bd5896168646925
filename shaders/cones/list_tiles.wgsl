// Lists the marked tiles in order, behind their number. A thread a tile. `ranks`: set bits of `tiles` before each
// word, and of all.
#import shared/threads.wgsl

struct ListParams {
    tiles: u32,
}

@group(0) @binding(0) var<storage, read> tiles: array<u32>;
@group(0) @binding(1) var<storage, read> ranks: array<u32>;
@group(0) @binding(2) var<storage, read_write> list: array<u32>;
@group(0) @binding(3) var<uniform> params: ListParams;

override WORKGROUP_SIZE: u32 = 64u;

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let tile = thread_index(id, groups);
    if tile >= threads.end {
        return;
    }
    if tile == 0u {
        list[0] = ranks[(params.tiles + 31u) / 32u];
    }
    let word = tiles[tile >> 5u];
    let bit = 1u << (tile & 31u);
    if (word & bit) != 0u {
        list[1u + ranks[tile >> 5u] + countOneBits(word & (bit - 1u))] = tile;
    }
}
