// A cone through the lit octree, front to back (section 4.5). Its diameter at distance t is
// max(1, t·widening) cells, the level sampled log2 of that; a step is as long as the diameter there times
// a factor, sampled in its middle, and stops 1 − (1 − α)^length of what comes from behind. A diameter
// stays at least a leaf's, so steps never vanish. What shared/sample.wgsl needs, the kernel says.
#import constants
#import shared/ray_walk.wgsl
#import shared/sample.wgsl
#import shared/transmittance.wgsl

struct ConeShape {
    // 2·tan(a / 2), a being the full apex angle.
    widening: f32,
    // From the surface to the apex, along the normal, cells.
    start_cells: f32,
    // Length of a step in diameters.
    step_diameters: f32,
    // Where a cone ends at the latest, cells.
    reach_cells: f32,
}

// Mean radiance along a cone, and the share of what lies behind that comes through.
struct ConeLight {
    radiance: vec3<f32>,
    through: f32,
    // The share that comes through up to the distance of occlusion.
    open: f32,
}

// A cone looks for light.
override RADIANCE: bool = true;
// A cone tells how open it is up to a distance; alone, it ends there.
override OCCLUSION: bool = false;

fn cone_diameter(cone: ConeShape, t: f32) -> f32 {
    return max(1.0, t * cone.widening);
}

// When a ray enters and leaves the grid.
fn grid_span(ray: Ray) -> vec2<f32> {
    let high = vec3<f32>(f32(grid_cells()));
    let low = vec3<f32>(0.0);
    let beside = !ray.moves & ((ray.origin < low) | (ray.origin >= high));
    if any(beside) {
        return vec2<f32>(0.0);
    }
    let near = select(vec3<f32>(0.0), plane_times(ray, select(high, low, ray.forward)), ray.moves);
    let far = select(vec3<f32>(NEVER), plane_times(ray, select(low, high, ray.forward)), ray.moves);
    return vec2<f32>(max(0.0, max(near.x, max(near.y, near.z))), min(far.x, min(far.y, far.z)));
}

fn trace_cone(cone: ConeShape, occlusion_cells: f32, apex: vec3<f32>, direction: vec3<f32>) -> ConeLight {
    let ray = ray_of(apex, direction);
    let span = grid_span(ray);
    let end = min(span.y, cone.reach_cells);
    var sum = ConeLight(vec3<f32>(0.0), 1.0, 1.0);
    var t = span.x;
    // Steps are LEAST_STEP cells or more, and no path through the grid is longer than 2N.
    let most = 2u * u32(f32(grid_cells()) / LEAST_STEP);
    for (var n = 0u; n < most && t < end && sum.through >= LEAST_LIGHT; n += 1u) {
        if !RADIANCE && t >= occlusion_cells {
            break;
        }
        let length = min(cone.step_diameters * cone_diameter(cone, t), end - t);
        let middle = t + 0.5 * length;
        let seen = sample_width(cone_diameter(cone, middle), ray_at(ray, middle), direction);
        if seen.w > 0.0 {
            if OCCLUSION && t < occlusion_cells {
                sum.open = sum.through * transmittance(seen.w, min(length, occlusion_cells - t));
            }
            let through = sum.through * transmittance(seen.w, length);
            if RADIANCE {
                sum.radiance += (sum.through - through) / seen.w * seen.xyz;
            }
            sum.through = through;
        }
        t += length;
    }
    return sum;
}
