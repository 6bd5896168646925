// A light's share that the octree lets through. A kernel declares `light`, `octree`, `leaf_bits`,
// `occupied`, `blocks`, `ranks`, `block_starts` and `leaves`.
#import shared/light.wgsl
#import shared/occupied_nodes.wgsl
#import shared/leaf_slot.wgsl
#import shared/transmittance.wgsl
#import shared/empty_space.wgsl

fn leaf_occupancy(key: u32) -> f32 {
    return f32(leaves[3u * leaf_slot(key)]) / f32(FULL_WEIGHT);
}

// Share of the light that comes through the leaves between `from` and `end` cells along a direction:
// 1 − α a cell of length.
fn light_through(origin: vec3<f32>, direction: vec3<f32>, end: f32) -> f32 {
    let cells = grid_cells();
    let ray = ray_of(origin, direction);
    var walk = enter_lattice(ray, cells);
    var through = 1.0;
    var hint = 0u;
    for (var n = 0; n <= 3 * cells && walk.inside && walk.t < end; n += 1) {
        let key = morton_key(vec3<u32>(walk.cell));
        let level = empty_level(octree.depth, key, hint);
        hint = min(level, octree.depth);
        let shift = octree.depth - hint;
        let low = (walk.cell >> vec3<u32>(shift)) << vec3<u32>(shift);
        let exit = leave_box(ray, low, 1i << shift);
        let length = min(exit.t, end) - walk.t;
        if level > octree.depth && length > 0.0 {
            through *= transmittance(leaf_occupancy(key), length);
            if through < LEAST_LIGHT {
                return 0.0;
            }
        }
        walk = walk_on(walk, ray, low, 1i << shift, exit, cells);
    }
    return through;
}

// From the light to `start`. At the light itself any direction will do: `unit` is.
fn light_from(start: vec3<f32>, unit: vec3<f32>) -> f32 {
    if light.kind == LIGHT_DIRECTIONAL {
        return light_through(start, -light.direction, NEVER);
    }
    let direction = normalize(light.position - start + 1e-6 * unit);
    return light_through(start, direction, distance(light.position, start));
}
