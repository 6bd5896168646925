// Marches a ray through the octree's masks and blends what it crosses, front to back. A kernel says
// what there is: `node_occupied(level, key)`, and `seen(key, ray, walk)`, the lit colour and the
// occupancy of an occupied cell of the shown level. It declares `picture` and `depth`.
#import shared/octree.wgsl
#import shared/empty_space.wgsl
#import shared/store_pixel.wgsl
#import shared/thread_pixel.wgsl
#import shared/view.wgsl

// All of a ray, at the shown level.
fn march(pixel: PixelRay) -> Blend {
    // Leaf cells a walked cell.
    let scale = exp2(f32(octree.depth - view.level));
    let cells = i32(1u << view.level);
    let ray = ray_of(pixel.origin / scale, pixel.direction);
    var walk = enter_lattice(ray, cells);
    var light = Blend(vec3<f32>(0.0), 1.0, NEVER);
    var hint = 0u;
    for (var n = 0; n <= 3 * cells && walk.inside; n += 1) {
        let key = morton_key(vec3<u32>(walk.cell));
        let level = empty_level(view.level, key, hint);
        hint = min(level, view.level);
        let shift = view.level - hint;
        let low = (walk.cell >> vec3<u32>(shift)) << vec3<u32>(shift);
        let exit = leave_box(ray, low, 1i << shift);
        if level > view.level && exit.t > walk.t {
            let voxel = seen(key, ray, walk);
            let width = pixel.width / scale + walk.t * pixel.widening;
            let color = edged(voxel.rgb, ray_at(ray, walk.t), walk, width);
            let alpha = voxel_alpha(voxel.a, (exit.t - walk.t) * scale);
            light = blended(light, color, alpha, pixel.start_cells + walk.t * scale);
            if light.through < LEAST_LIGHT {
                break;
            }
        }
        walk = walk_on(walk, ray, low, 1i << shift, exit, cells);
    }
    return light;
}

fn show(pixel: vec2<u32>) {
    let light = march(pixel_ray(pixel));
    let color = light.color + light.through * view.background;
    store_pixel(pixel, color, light.depth_cells);
}
