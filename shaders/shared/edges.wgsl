// How much two pixels' surfaces have in common: near to one plane, and facing alike. What a joint bilateral
// filter weighs its pixels by.
#import shared/surface.wgsl

// Widths within which surfaces count as one, cells: of a voxel, or of the pixels between two of them.
fn plane_width(s: Surface, pixels: f32, view_ray: PixelRay) -> f32 {
    return max(1.0, pixels * (view_ray.width + (s.distance - view_ray.start_cells) * view_ray.widening));
}

fn alike(s: Surface, other: Surface, width_cells: f32) -> f32 {
    if !other.is_there {
        return 0.0;
    }
    let away = dot(other.position - s.position, s.face) / width_cells;
    let cosine = max(dot(s.normal, other.normal), 0.0);
    let square = cosine * cosine;
    return exp2(-away * away) * square * square;
}
