// What both halves of a prefix sum read. A kernel declares `values`.
#import constants

struct ScanParams {
    count: u32,
}

// The set bits of values count, not the values.
override POPCOUNT: bool = false;
// Independent sequences, interleaved.
override CHANNELS: u32 = 1u;

fn value_at(i: u32, channel: u32) -> u32 {
    let value = values[i * CHANNELS + channel];
    return select(value, countOneBits(value), POPCOUNT);
}
