// One level of the two mask pyramids, from the leaves up:
//   O(l) = parents of O(l+1)                                    truly occupied
//   A(l) = parents of A(l+1) ∪ parents of dilate(O(l+1))        its children are to be allocated
// dilate adds the backward neighbours {0, −1}³: the dummies that every interpolation from a cell
// rounded down needs (section 4.4, Fig. 5). O is dilated, never A, or dummies would breed dummies.
// A thread makes one word (4 x 4 x 2 nodes) from 2 x 2 x 2 child words and their forward halo.
#import shared/threads.wgsl
#import shared/octree.wgsl
#import shared/counter.wgsl

struct ReduceParams {
    // The level that is made; its children are read.
    level: u32,
}

@group(0) @binding(0) var<uniform> octree: OctreeParams;
@group(0) @binding(1) var<uniform> params: ReduceParams;
@group(0) @binding(2) var<storage, read> leaf_bits: array<u32>;
@group(0) @binding(3) var<storage, read_write> occupied: array<u32>;
@group(0) @binding(4) var<storage, read_write> blocks: array<u32>;
@group(0) @binding(5) var<storage, read_write> counters: array<atomic<u32>>;

override WORKGROUP_SIZE: u32 = 64u;
override DUMMIES: bool = true;

// O(l+1), word by word.
fn child_word(word: u32) -> u32 {
    if params.level + 1u == octree.depth {
        return leaf_bits[word];
    }
    return occupied[octree.levels[params.level + 1u].occupied_word + word];
}

// Key one word (4, 4 or 2 cells) further along an axis; carries ripple through that axis' bits only.
fn step_x(key: u32) -> u32 { return (((key | ~MORTON_X) + (1u << 6u)) & MORTON_X) | (key & ~MORTON_X); }
fn step_y(key: u32) -> u32 { return (((key | ~MORTON_Y) + (1u << 7u)) & MORTON_Y) | (key & ~MORTON_Y); }
fn step_z(key: u32) -> u32 { return (((key | ~MORTON_Z) + (1u << 5u)) & MORTON_Z) | (key & ~MORTON_Z); }

// Inside a word, x is bits 0 and 3 of the index, y bits 1 and 4, z bit 2.
fn dilate_x(word: u32, next: u32) -> u32 {
    return word | ((word >> 1u) & 0x55555555u) | ((word >> 7u) & 0x00aa00aau) | ((next << 9u) & 0xaa00aa00u);
}
fn dilate_y(word: u32, next: u32) -> u32 {
    return word | ((word >> 2u) & 0x33333333u) | ((word >> 14u) & 0x0000ccccu) | ((next << 18u) & 0xcccc0000u);
}
fn dilate_z(words: vec4<u32>, next: vec4<u32>) -> vec4<u32> {
    return words | ((words >> vec4(4u)) & vec4(0x0f0f0f0fu)) | ((next << vec4(4u)) & vec4(0xf0f0f0f0u));
}

// Whether a step from one key to the next has left the grid: keys of 10 bits an axis wrap to a
// smaller one, shorter ones outgrow their level.
fn leaves_grid(key: u32, next: u32) -> bool {
    return next < key || next >= (8u << (3u * params.level));
}

// Two words along x, dilated in x; a third is their halo.
fn dilated_row(key: u32, past: bool) -> vec2<u32> {
    if past {
        return vec2<u32>(0u);
    }
    let k1 = step_x(key);
    let k2 = step_x(k1);
    var w1 = 0u;
    var w2 = 0u;
    if !leaves_grid(key, k1) {
        w1 = child_word(k1 >> 5u);
        if !leaves_grid(k1, k2) {
            w2 = child_word(k2 >> 5u);
        }
    }
    return vec2<u32>(dilate_x(child_word(key >> 5u), w1), dilate_x(w1, w2));
}

// Two rows along y, dilated in x and y: words (x, y) = (0, 0), (1, 0), (0, 1), (1, 1) of a layer.
fn dilated_layer(key: u32, past: bool) -> vec4<u32> {
    if past {
        return vec4<u32>(0u);
    }
    let k1 = step_y(key);
    let k2 = step_y(k1);
    let past1 = leaves_grid(key, k1);
    let r0 = dilated_row(key, false);
    let r1 = dilated_row(k1, past1);
    let r2 = dilated_row(k2, past1 || leaves_grid(k1, k2));
    return vec4<u32>(dilate_y(r0.x, r1.x), dilate_y(r0.y, r1.y), dilate_y(r1.x, r2.x), dilate_y(r1.y, r2.y));
}

// The dilated words of the two layers, lower and upper, from `key` on.
struct DilatedWords {
    lower: vec4<u32>,
    upper: vec4<u32>,
}

fn dilated_words(key: u32) -> DilatedWords {
    let k1 = step_z(key);
    let k2 = step_z(k1);
    let past1 = leaves_grid(key, k1);
    let l0 = dilated_layer(key, false);
    let l1 = dilated_layer(k1, past1);
    let l2 = dilated_layer(k2, past1 || leaves_grid(k1, k2));
    return DilatedWords(dilate_z(l0, l1), dilate_z(l1, l2));
}

// Bit i: whether byte i of the word has any bit.
fn any_in_bytes(word: u32) -> u32 {
    var v = word | (word >> 4u);
    v |= v >> 2u;
    v = (v | (v >> 1u)) & 0x01010101u;
    return (v | (v >> 7u) | (v >> 14u) | (v >> 21u)) & 0xfu;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let thread = thread_index(id, groups);
    if thread >= threads.end {
        return;
    }
    // Levels 0 and 1 have fewer than 8 child words.
    let child_words = min(8u, max(1u, (8u << (3u * params.level)) >> 5u));
    let has_blocks = params.level >= octree.dense_level;
    let children_have_blocks = params.level + 1u < octree.depth;
    var dilated = DilatedWords();
    if has_blocks && DUMMIES {
        dilated = dilated_words(thread << 8u);
    }
    var occupied_bits = 0u;
    var block_bits = 0u;
    var leaves = 0u;
    for (var i = 0u; i < child_words; i += 1u) {
        let word = 8u * thread + i;
        let children = child_word(word);
        occupied_bits |= any_in_bytes(children) << (4u * i);
        if !children_have_blocks {
            leaves += countOneBits(children);
        }
        if has_blocks {
            // Of a word's number, bit 0 is its z, bit 1 its x, bit 2 its y.
            var below = children | select(dilated.lower[i >> 1u], dilated.upper[i >> 1u], (i & 1u) == 1u);
            if children_have_blocks {
                below |= blocks[octree.levels[params.level + 1u].blocks_word + word];
            }
            block_bits |= any_in_bytes(below) << (4u * i);
        }
    }
    occupied[octree.levels[params.level].occupied_word + thread] = occupied_bits;
    if has_blocks {
        blocks[octree.levels[params.level].blocks_word + thread] = block_bits;
    }
    if occupied_bits != 0u {
        atomicAdd(&counters[2u * (COUNTER_OCCUPIED + params.level)], countOneBits(occupied_bits));
    }
    if leaves != 0u {
        atomicAdd(&counters[2u * (COUNTER_OCCUPIED + octree.depth)], leaves);
    }
}
