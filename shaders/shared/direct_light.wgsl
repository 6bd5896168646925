// One light at what the camera sees: adds BRDF · irradiance · visibility. A kernel declares `view`, the surface
// image, `light` and `direct`, and says `visibility(s)`.
#import shared/thread_pixel.wgsl
#import shared/brdf.wgsl
#import shared/light.wgsl

override WORKGROUP_SIZE: u32 = 64u;

// A light behind the triangle does not reach it, whatever its shading normal says.
fn arriving_radiance(s: Surface) -> vec3<f32> {
    let to = arrival(s.position, LIGHT_NEAR_CELLS);
    let cosine = dot(s.normal, to.direction);
    if min(cosine, dot(s.face, to.direction)) <= 0.0 || all(to.irradiance <= vec3<f32>(0.0)) {
        return vec3<f32>(0.0);
    }
    return brdf(s, to.direction) * cosine * to.irradiance * visibility(s);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let pixel = view_pixel(id, groups);
    if !pixel.is_there {
        return;
    }
    let s = surface_at(pixel.at);
    if s.is_there {
        direct[pixel.index] += vec4<f32>(arriving_radiance(s), 0.0);
    }
}
