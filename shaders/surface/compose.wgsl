// What is shown of the lit surfaces, a value a pixel: radiance of a term (nits), irradiance (lux), or a
// property as it is. In: the surface image, direct light, what diffuse and specular cones bring. Out:
// `shown`, whose last channel is 1 where a surface is.
#import shared/threads.wgsl
#import shared/surface.wgsl
#import shared/brdf.wgsl
#import shared/glossy.wgsl

override TERM: u32 = 0u;
// What was traced: otherwise `diffuse` and `specular` hold nothing.
override DIFFUSE: bool = false;
override SPECULAR: bool = false;

struct ComposeParams {
    // Radiance from all directions, nits.
    sky: vec3<f32>,
    glossy_roughness: f32,
    // Edge of a cell, scene units.
    span: f32,
    pad: u32,
    pad_end: vec2<u32>,
}

@group(0) @binding(0) var<uniform> view: ViewParams;
@group(0) @binding(1) var<uniform> params: ComposeParams;
@group(0) @binding(2) var surface_near: texture_2d<u32>;
@group(0) @binding(3) var surface_stuff: texture_2d<u32>;
@group(0) @binding(4) var<storage, read> direct: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read> diffuse: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read> specular: array<vec4<f32>>;
@group(0) @binding(7) var<storage, read_write> shown: array<vec4<f32>>;

override WORKGROUP_SIZE: u32 = 64u;

// Over the cosine-weighted hemisphere.
fn mean_radiance(i: u32) -> vec3<f32> {
    return select(vec3<f32>(0.0), diffuse[i].rgb, DIFFUSE);
}

fn reflectance(s: Surface) -> vec3<f32> {
    return specular_albedo(f0_of(s), s.roughness, max(dot(s.normal, -s.from_eye), 0.0));
}

fn diffuse_term(s: Surface, i: u32) -> vec3<f32> {
    return diffuse_color(s) * (1.0 - reflectance(s)) * mean_radiance(i);
}

// Surfaces that are not glossy reflect what their diffuse cones see.
fn specular_term(s: Surface, i: u32) -> vec3<f32> {
    if !is_glossy(s, params.glossy_roughness) {
        return reflectance(s) * mean_radiance(i);
    }
    return select(vec3<f32>(0.0), reflectance(s) * specular[i].rgb, SPECULAR);
}

fn term(s: Surface, i: u32) -> vec3<f32> {
    switch TERM {
        case TERM_DIRECT: { return direct[i].rgb; }
        case TERM_DIFFUSE: { return diffuse_term(s, i); }
        case TERM_SPECULAR: { return specular_term(s, i); }
        case TERM_AO: { return vec3<f32>(diffuse[i].a); }
        case TERM_IRRADIANCE: { return PI * mean_radiance(i); }
        case TERM_ALBEDO: { return s.albedo; }
        case TERM_NORMAL: { return s.normal; }
        case TERM_DEPTH: { return vec3<f32>(s.distance * params.span); }
        case TERM_ROUGHNESS: { return vec3<f32>(s.roughness); }
        default: { return direct[i].rgb + diffuse_term(s, i) + specular_term(s, i); }
    }
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = thread_index(id, groups);
    if i >= threads.end {
        return;
    }
    let s = surface_at(vec2<u32>(i % view.width_px, i / view.width_px));
    if s.is_there {
        shown[i] = vec4<f32>(term(s, i), 1.0);
        return;
    }
    let sees_sky = TERM == TERM_FINAL || TERM == TERM_DIRECT;
    shown[i] = vec4<f32>(select(vec3<f32>(0.0), params.sky, sees_sky), 0.0);
}
