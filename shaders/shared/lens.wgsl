// From where triangles are seen, in the camera's axes: x right, y up, z backward. An orthographic camera, which leaves w
// at 1, sees all of them along −z.

fn is_orthographic(clip_from_camera: mat4x4<f32>) -> bool {
    return clip_from_camera[3].w == 1.0;
}

// Unit length.
fn direction_of_sight(clip_from_camera: mat4x4<f32>, position: vec3<f32>) -> vec3<f32> {
    return select(normalize(position), vec3<f32>(0.0, 0.0, -1.0), is_orthographic(clip_from_camera));
}

// Along the line of sight from the eye, or from its plane.
fn distance_seen(clip_from_camera: mat4x4<f32>, position: vec3<f32>) -> f32 {
    return select(length(position), -position.z, is_orthographic(clip_from_camera));
}
