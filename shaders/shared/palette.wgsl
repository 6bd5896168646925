// The colour of a value from 0 to 1. A kernel declares `palette`.
#import shared/view.wgsl

fn palette_value(value: f32) -> vec3<f32> {
    return palette.colors[u32(clamp(value, 0.0, 1.0) * 255.0 + 0.5)].rgb;
}
