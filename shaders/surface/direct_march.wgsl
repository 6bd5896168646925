// Adds one light to every pixel's direct light, hidden by the octree's leaves. In: the surface image, a light,
// the built octree. A thread a pixel.
#import shared/direct_light.wgsl
#import shared/light_through.wgsl

@group(0) @binding(0) var<uniform> view: ViewParams;
@group(0) @binding(1) var surface_near: texture_2d<u32>;
@group(0) @binding(2) var surface_stuff: texture_2d<u32>;
@group(0) @binding(3) var<storage, read_write> direct: array<vec4<f32>>;
@group(0) @binding(4) var<uniform> light: LightParams;
@group(0) @binding(5) var<uniform> octree: OctreeParams;
@group(0) @binding(6) var<storage, read> leaf_bits: array<u32>;
@group(0) @binding(7) var<storage, read> occupied: array<u32>;
@group(0) @binding(8) var<storage, read> blocks: array<u32>;
@group(0) @binding(9) var<storage, read> ranks: array<u32>;
@group(0) @binding(10) var<storage, read> block_starts: array<u32>;
@group(0) @binding(11) var<storage, read> leaves: array<u32>;

// Out of the leaf that stands for the surface itself.
fn visibility(s: Surface) -> f32 {
    return light_from(s.position + light.offset_cells * s.face, s.face);
}
