// Begins the sum of a pixel's light: what the surface emits, and whether there is one. In: the surface image.
// A thread a pixel.
#import shared/thread_pixel.wgsl
#import shared/surface.wgsl

@group(0) @binding(0) var<uniform> view: ViewParams;
@group(0) @binding(1) var surface_near: texture_2d<u32>;
@group(0) @binding(2) var surface_stuff: texture_2d<u32>;
// Nits, and 1 where a surface is.
@group(0) @binding(3) var<storage, read_write> direct: array<vec4<f32>>;

override WORKGROUP_SIZE: u32 = 64u;

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let pixel = view_pixel(id, groups);
    if !pixel.is_there {
        return;
    }
    let s = surface_at(pixel.at);
    direct[pixel.index] = select(vec4<f32>(0.0), vec4<f32>(s.emission, 1.0), s.is_there);
}
