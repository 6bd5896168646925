// What the camera sees at a pixel: mirror of data::surface_image, which draws the layout. A kernel declares
// `view`, `surface_near` and `surface_stuff`.
#import shared/octahedral.wgsl
#import shared/view.wgsl

struct Surface {
    // False: the background, and nothing below is meant.
    is_there: bool,
    // From the eye along the pixel's ray, cells.
    distance: f32,
    // Cells from the grid's corner.
    position: vec3<f32>,
    // Unit vectors: as shaded, of the triangle on the eye's side, and from the eye.
    normal: vec3<f32>,
    face: vec3<f32>,
    from_eye: vec3<f32>,
    albedo: vec3<f32>,
    roughness: f32,
    metallic: f32,
    // Nits.
    emission: vec3<f32>,
}

fn surface_at(pixel: vec2<u32>) -> Surface {
    let near = textureLoad(surface_near, pixel, 0);
    let stuff = textureLoad(surface_stuff, pixel, 0);
    let ray = pixel_ray(pixel);
    var s: Surface;
    s.distance = bitcast<f32>(near.x);
    s.is_there = s.distance < NEVER;
    s.position = ray.origin + (s.distance - ray.start_cells) * ray.direction;
    s.normal = unpack_octahedral(near.y);
    s.face = unpack_octahedral(near.z);
    s.from_eye = ray.direction;
    let blue = unpack2x16unorm(stuff.x);
    s.albedo = vec3<f32>(unpack2x16unorm(near.w), blue.x);
    let bytes = unpack4x8unorm(stuff.x);
    s.roughness = bytes.z;
    s.metallic = bytes.w;
    s.emission = bitcast<vec3<f32>>(stuff.yzw);
    return s;
}
