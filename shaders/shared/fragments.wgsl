// What a triangle leaves in a cell: data::fragments draws its words. A kernel declares `room` and `fragments`.
#import constants

struct FragmentRoom {
    fragments: u32,
    voxels: u32,
    // log2 of how many buckets there are.
    bucket_bits: u32,
    // Hints of the work list, behind which the voxels' objects lie.
    hints: u32,
}

// How many there are, as the GPU has counted.
struct FragmentCounts {
    columns: u32,
    fragments: u32,
    voxels: u32,
    pad: u32,
}

// A bucket is a cell, or all cells with one hash.
override DENSE: bool = false;
override EMITS: bool = false;

fn fragment_start(number: u32) -> u32 {
    return number * (FRAGMENT_WORDS + select(0u, EMISSION_WORDS, EMITS));
}

// Of the heads: the first word counts the fragments.
fn bucket_word(key: u32) -> u32 {
    if DENSE {
        return 1u + key;
    }
    // Fibonacci hashing: the upper bits of the product depend on all bits of the key.
    return 1u + ((key * 2654435769u) >> (32u - room.bucket_bits));
}
