// Marks the tiles of 8 x 8 pixels of the specular image that need specular cones. A thread a tile. `tiles`: one
// bit a tile, cleared before.
#import shared/threads.wgsl
#import shared/image.wgsl
#import shared/glossy.wgsl

struct GlossyParams {
    size_px: vec2<u32>,
    tiles: u32,
    // Rougher surfaces need none.
    most_roughness: f32,
}

@group(0) @binding(0) var<uniform> view: ViewParams;
@group(0) @binding(1) var<uniform> params: GlossyParams;
@group(0) @binding(2) var surface_near: texture_2d<u32>;
@group(0) @binding(3) var surface_stuff: texture_2d<u32>;
@group(0) @binding(4) var<storage, read_write> tiles: array<atomic<u32>>;

override WORKGROUP_SIZE: u32 = 64u;

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let tile = thread_index(id, groups);
    if tile >= threads.end {
        return;
    }
    var found = false;
    for (var i = 0u; i < 64u && !found; i += 1u) {
        let pixel = pixel_of_tile(params.size_px.x, tile, i);
        if all(pixel < params.size_px) {
            found = is_glossy(surface_at(source_pixel(pixel, params.size_px)), params.most_roughness);
        }
    }
    if found {
        atomicOr(&tiles[tile >> 5u], 1u << (tile & 31u));
    }
}
