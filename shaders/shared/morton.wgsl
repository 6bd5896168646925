// Morton keys: bit 3i of a key is bit i of x, then y, then z. Mirror of data::grid::morton_key.

const MORTON_X: u32 = 0x09249249u;
const MORTON_Y: u32 = 0x12492492u;
const MORTON_Z: u32 = 0x24924924u;

fn spread_bits(value: u32) -> u32 {
    var v = value & 0x3ffu;
    v = (v | (v << 16u)) & 0x030000ffu;
    v = (v | (v << 8u)) & 0x0300f00fu;
    v = (v | (v << 4u)) & 0x030c30c3u;
    return (v | (v << 2u)) & MORTON_X;
}

fn compact_bits(key: u32) -> u32 {
    var v = key & MORTON_X;
    v = (v | (v >> 2u)) & 0x030c30c3u;
    v = (v | (v >> 4u)) & 0x0300f00fu;
    v = (v | (v >> 8u)) & 0x030000ffu;
    return (v | (v >> 16u)) & 0x3ffu;
}

fn morton_key(cell: vec3<u32>) -> u32 {
    return spread_bits(cell.x) | (spread_bits(cell.y) << 1u) | (spread_bits(cell.z) << 2u);
}

fn morton_cell(key: u32) -> vec3<u32> {
    return vec3<u32>(compact_bits(key), compact_bits(key >> 1u), compact_bits(key >> 2u));
}

// The key one cell further along an axis. Past the last cell of a level it outgrows the level's keys.
fn forward_key(key: u32, axis: u32) -> u32 {
    let mask = MORTON_X << axis;
    return (((key | ~mask) + (1u << axis)) & mask) | (key & ~mask);
}

// Of child, corner or source `j` of eight: bit 0 is x, bit 1 y, bit 2 z.
fn corner_offset(j: u32) -> vec3<u32> {
    return (vec3<u32>(j) >> vec3<u32>(0u, 1u, 2u)) & vec3<u32>(1u);
}
