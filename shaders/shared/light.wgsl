// What arrives from one light, by KHR_lights_punctual. A kernel declares `light`.
#import constants
#import shared/ray_walk.wgsl

struct LightParams {
    // Cells from the grid's corner.
    position: vec3<f32>,
    // LIGHT_*.
    kind: u32,
    // The way it shines, unit length.
    direction: vec3<f32>,
    // Beyond it there is no light; 0: no such place. Cells.
    range_cells: f32,
    // Lux; for point and spot lights candela over the squared span, so that distances are cells.
    strength: vec3<f32>,
    // How far above its surface a leaf looks for what hides the light.
    offset_cells: f32,
    // Spot: attenuation is (cosine · scale + offset)², clamped.
    angle_scale: f32,
    angle_offset: f32,
    pad: vec2<u32>,
}

struct Arrival {
    // Without cosine and visibility.
    irradiance: vec3<f32>,
    // Unit, to the light; how far, cells.
    direction: vec3<f32>,
    distance: f32,
}

// Nearer than `least_distance` (cells) counts as that far.
fn arrival(p: vec3<f32>, least_distance: f32) -> Arrival {
    if light.kind == LIGHT_DIRECTIONAL {
        return Arrival(light.strength, -light.direction, NEVER);
    }
    let to_light = light.position - p;
    let distance = max(length(to_light), least_distance);
    let direction = to_light / distance;
    var falloff = 1.0 / (distance * distance);
    if light.range_cells > 0.0 {
        let part = distance / light.range_cells;
        falloff *= clamp(1.0 - part * part * part * part, 0.0, 1.0);
    }
    if light.kind == LIGHT_SPOT {
        let inside = clamp(dot(light.direction, -direction) * light.angle_scale + light.angle_offset, 0.0, 1.0);
        falloff *= inside * inside;
    }
    return Arrival(light.strength * falloff, direction, distance);
}
