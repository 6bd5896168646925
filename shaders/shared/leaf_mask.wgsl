// Which leaves are occupied, eight at a time. A kernel declares `leaf_bits`.

// Bit by child of the leaves below node `key` of the level above them.
fn leaf_mask(key: u32) -> u32 {
    return (leaf_bits[key >> 2u] >> (8u * (key & 3u))) & 0xffu;
}
