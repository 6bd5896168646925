// First half of an exclusive prefix sum: each thread sums SCAN_CHUNK consecutive values (or the set
// bits of them) into one. Serial inside a chunk: barriers cost more than they save on few cores.
#import shared/threads.wgsl
#import shared/scan.wgsl

@group(0) @binding(0) var<uniform> params: ScanParams;
@group(0) @binding(1) var<storage, read> values: array<u32>;
@group(0) @binding(2) var<storage, read_write> sums: array<u32>;

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
        var sum = 0u;
        for (var i = first; i < end; i += 1u) {
            sum += value_at(i, channel);
        }
        sums[thread * CHANNELS + channel] = sum;
    }
}
