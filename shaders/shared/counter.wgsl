// 64-bit counters of two words: integer sums by atomics, the same in any order.

// Adds `value` to the counter at word 2·index of `counters`.
fn count64(index: u32, value: u32) {
    let before = atomicAdd(&counters[2u * index], value);
    if before + value < before {
        atomicAdd(&counters[2u * index + 1u], 1u);
    }
}
