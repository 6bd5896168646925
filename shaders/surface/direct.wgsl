// Adds one light to every pixel's direct light, hidden by a shadow map; one without layers hides nothing. In:
// the surface image, a light, its map. A thread a pixel.
#import shared/direct_light.wgsl
#import shared/shadow_map.wgsl

@group(0) @binding(0) var<uniform> view: ViewParams;
@group(0) @binding(1) var surface_near: texture_2d<u32>;
@group(0) @binding(2) var surface_stuff: texture_2d<u32>;
@group(0) @binding(3) var<storage, read_write> direct: array<vec4<f32>>;
@group(0) @binding(4) var<uniform> light: LightParams;
@group(0) @binding(5) var<uniform> shadow: ShadowParams;
@group(0) @binding(6) var shadow_map: texture_2d_array<f32>;

fn visibility(s: Surface) -> f32 {
    return lit_share_of_plane(s.position, s.face);
}
