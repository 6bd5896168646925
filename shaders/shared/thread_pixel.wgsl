// The pixel of a thread. Images are walked in tiles (shared/view.wgsl), the last of which reach beyond them. A kernel
// declares `view` and WORKGROUP_SIZE.
#import shared/threads.wgsl
#import shared/view.wgsl

struct ThreadPixel {
    // False: the thread has nothing to do.
    is_there: bool,
    at: vec2<u32>,
    // In an array of the image's pixels, rows from the top.
    index: u32,
}

fn image_pixel(id: vec3<u32>, groups: vec3<u32>, size_px: vec2<u32>) -> ThreadPixel {
    let thread = thread_index(id, groups);
    let at = pixel_of_tile(size_px.x, thread / 64u, thread % 64u);
    return ThreadPixel(thread < threads.end && all(at < size_px), at, at.y * size_px.x + at.x);
}

// Of an image as large as the view.
fn view_pixel(id: vec3<u32>, groups: vec3<u32>) -> ThreadPixel {
    return image_pixel(id, groups, vec2<u32>(view.width_px, view.height_px));
}
