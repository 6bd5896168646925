// The diffuse cones of a surface: distinct directions, equal weights, dense where the cosine is large.
// Mirror of stages::light::gather_ref.
#import constants

// Direction i of `count` around +z: Vogel's sunflower fills the unit disc evenly, and a disc lifted to
// the hemisphere is distributed by the cosine, so that each direction weighs 1 / count.
fn cosine_direction(i: u32, count: u32) -> vec3<f32> {
    let square = (f32(i) + 0.5) / f32(count);
    // Turns wrap around as integers do, so that late directions are as exact as early ones.
    let angle = f32(bitcast<i32>(i * GOLDEN_TURN)) * TURN_ANGLE;
    return vec3<f32>(sqrt(square) * vec2<f32>(cos(angle), sin(angle)), sqrt(1.0 - square));
}

// Turns +z to the unit vector n; orthonormal for every n (Duff et al. 2017).
fn basis_of(n: vec3<f32>) -> mat3x3<f32> {
    let side = select(-1.0, 1.0, n.z >= 0.0);
    let a = -1.0 / (side + n.z);
    let b = n.x * n.y * a;
    let x = vec3<f32>(1.0 + side * n.x * n.x * a, side * b, -side * n.x);
    let y = vec3<f32>(b, side + n.y * n.y * a, -n.y);
    return mat3x3<f32>(x, y, n);
}

// A direction below a surface, mirrored to above it. Normal maps tilt the hemisphere, faces end it.
fn above_face(direction: vec3<f32>, face: vec3<f32>) -> vec3<f32> {
    return direction - 2.0 * min(dot(direction, face), 0.0) * face;
}
