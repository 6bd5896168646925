// Which threads of a kernel this dispatch runs. Long passes are cut into ranges, and more than
// 65535 workgroups are folded into y; a kernel sees neither:
//
//     let i = thread_index(id, groups);
//     if (i >= threads.end) { return; }
//
// Needs `override WORKGROUP_SIZE: u32` in the kernel. Ranges start at whole workgroups.

struct Threads {
    first: u32,
    end: u32,
}

@group(1) @binding(0) var<uniform> threads: Threads;

fn thread_index(id: vec3<u32>, groups: vec3<u32>) -> u32 {
    return threads.first + id.y * (groups.x * WORKGROUP_SIZE) + id.x;
}
