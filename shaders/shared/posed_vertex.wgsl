// Vertices that need their own triangle alone. A shader says what becomes of one: `Vertex`, and
// `placed(v, m)`. Entry points `rigid` and `skinned` differ in what moves it.
#import shared/posed_mesh.wgsl

@vertex
fn rigid(@builtin(vertex_index) number: u32) -> Vertex {
    return placed(vertices[vertex_of(number)], matrices[draw.first_matrix]);
}

@vertex
fn skinned(@builtin(vertex_index) number: u32) -> Vertex {
    let vertex = vertex_of(number);
    return placed(vertices[vertex], skinned_matrix(vertex));
}
