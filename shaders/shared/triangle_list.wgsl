// The posed triangles of all that is shown, by number. A kernel declares what shared/posed_mesh.wgsl asks for, its
// `draw` as a private variable, and `list` and `draws`: a dispatch goes through the draws of one batch.
#import shared/posed_mesh.wgsl

struct TriangleDraw {
    first_triangle: u32,
    first_index: u32,
    first_vertex: u32,
    first_matrix: u32,
    object: u32,
    material: u32,
    is_skinned: u32,
    pad: u32,
}

struct TriangleList {
    first_draw: u32,
    end_draw: u32,
    first_triangle: u32,
    end_triangle: u32,
    // N, cells along an axis.
    grid_cells: u32,
}

// The draw of a triangle of the batch.
fn draw_of(triangle: u32) -> u32 {
    var low = list.first_draw;
    var high = list.end_draw;
    while high - low > 1u {
        let middle = (low + high) / 2u;
        if draws[middle].first_triangle <= triangle {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

// The same, from here on read by shared/posed_mesh.wgsl.
fn entered_draw(triangle: u32) -> TriangleDraw {
    let owner = draws[draw_of(triangle)];
    draw.first_index = owner.first_index;
    draw.first_vertex = owner.first_vertex;
    draw.first_matrix = owner.first_matrix;
    return owner;
}

fn vertex_matrix(owner: TriangleDraw, vertex: u32) -> MeshMatrix {
    if owner.is_skinned != 0u {
        return skinned_matrix(vertex);
    }
    return matrices[owner.first_matrix];
}

// Cells from the grid's corner.
fn posed_corner(owner: TriangleDraw, triangle: u32, corner: u32) -> vec3<f32> {
    let vertex = vertex_of(3u * (triangle - owner.first_triangle) + corner);
    return moved_position(vertices[vertex].position, vertex_matrix(owner, vertex));
}
