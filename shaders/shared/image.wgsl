// An image beside that of the surfaces, as large or smaller: an array of pixels, rows from the top. Each pixel
// belongs to one of the surfaces' pixels, no two to the same. A kernel declares `view`, of the surfaces.
#import shared/view.wgsl

// The surface pixel of a pixel: where its middle lies.
fn source_pixel(pixel: vec2<u32>, size_px: vec2<u32>) -> vec2<u32> {
    return (2u * pixel + 1u) * vec2<u32>(view.width_px, view.height_px) / (2u * size_px);
}
