// What a view writes of a pixel. A kernel declares `picture` and `depth`.
#import shared/view.wgsl

fn store_pixel(pixel: vec2<u32>, linear: vec3<f32>, depth_cells: f32) {
    textureStore(picture, pixel, vec4<f32>(gamma_from_linear(linear), 1.0));
    textureStore(depth, pixel, vec4<f32>(depth_cells, 0.0, 0.0, 1.0));
}
