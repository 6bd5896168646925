// One layer of a shadow map: how it sees the grid.

struct ShadowFrame {
    clip_from_grid: mat4x4<f32>,
    // Distance along the layer's axis, cells: dot with (p, 1).
    distance: vec4<f32>,
}
