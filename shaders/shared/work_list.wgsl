// Which voxel a thread moves: runs of slots, without padding threads between them.
// The kernel declares `work_items` (one sentinel at the end) and `work_hints`, the item of every
// WORK_HINT_THREADS-th thread, from which a short walk finds the thread's own.
#import constants

struct WorkItem {
    first_thread: u32,
    first_slot: u32,
    first_voxel: u32,
    part: u32,
    // Object number in the scene, or OBJECT_BY_VOXEL.
    object: u32,
}

fn work_item(thread: u32) -> WorkItem {
    var item = work_hints[thread / WORK_HINT_THREADS];
    while work_items[item + 1u].first_thread <= thread {
        item += 1u;
    }
    return work_items[item];
}

fn slot_of(item: WorkItem, thread: u32) -> u32 {
    return item.first_slot + thread - item.first_thread;
}

fn object_of(item: WorkItem, thread: u32) -> u32 {
    if item.object == OBJECT_BY_VOXEL {
        return work_hints[item.first_voxel + thread - item.first_thread];
    }
    return item.object;
}
