// The mean light of all that the octree holds: what pictures without a scale of their own are shown by. A kernel
// declares `light`, whose first entry is the root: light times opacity, opacity.
#import constants

fn luminance_of(light: vec3<f32>) -> f32 {
    return dot(light, vec3<f32>(LUMINANCE_RED, LUMINANCE_GREEN, LUMINANCE_BLUE));
}

// Its luminance; 0 where there is none.
fn mean_luminance() -> f32 {
    let root = light[0];
    if !(root.w > 0.0) {
        return 0.0;
    }
    return luminance_of(root.xyz) / root.w;
}
