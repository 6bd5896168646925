// Second half of an exclusive prefix sum: each thread writes the prefixes of its SCAN_CHUNK values,
// starting from the prefix of its chunk. The thread of the last chunk appends the total.
#import shared/threads.wgsl
#import shared/scan.wgsl

@group(0) @binding(0) var<uniform> params: ScanParams;
@group(0) @binding(1) var<storage, read> values: array<u32>;
// Exclusive prefixes of the chunk sums; not read where there is one chunk only.
@group(0) @binding(2) var<storage, read> chunk_prefixes: array<u32>;
@group(0) @binding(3) var<storage, read_write> prefixes: array<u32>;

override WORKGROUP_SIZE: u32 = 64u;

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let thread = thread_index(id, groups);
    if thread >= threads.end {
        return;
    }
    let first = thread * SCAN_CHUNK;
    let end = min(first + SCAN_CHUNK, params.count);
    for (var channel = 0u; channel < CHANNELS; channel += 1u) {
        var prefix = 0u;
        if thread > 0u {
            prefix = chunk_prefixes[thread * CHANNELS + channel];
        }
        for (var i = first; i < end; i += 1u) {
            prefixes[i * CHANNELS + channel] = prefix;
            prefix += value_at(i, channel);
        }
        if end == params.count {
            prefixes[end * CHANNELS + channel] = prefix;
        }
    }
}
