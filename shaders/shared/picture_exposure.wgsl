// What a picture of surfaces is exposed by: set, or measured.

struct PictureExposure {
    // Light is multiplied by it.
    factor: f32,
    // What it was measured from, nits or lux; 0 where nothing shines.
    bright: f32,
    pad: vec2<u32>,
}
