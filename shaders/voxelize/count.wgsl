// How many columns of cells each triangle of a batch may cover: those of its bounds along its dominant axis, inside the
// grid. In: posed triangles. Out: a number a triangle, and their sum in two words.
#import shared/threads.wgsl
#import shared/column_scan.wgsl
#import shared/counter.wgsl

@group(0) @binding(0) var<uniform> list: TriangleList;
@group(0) @binding(1) var<storage, read> draws: array<TriangleDraw>;
@group(0) @binding(2) var<storage, read> indices: array<u32>;
@group(0) @binding(3) var<storage, read> vertices: array<MeshVertex>;
@group(0) @binding(4) var<storage, read> vertex_joints: array<VertexJoints>;
@group(0) @binding(5) var<storage, read> matrices: array<MeshMatrix>;
@group(0) @binding(6) var<storage, read_write> columns: array<u32>;
@group(0) @binding(7) var<storage, read_write> counters: array<atomic<u32>>;

var<private> draw: DrawParams;

override WORKGROUP_SIZE: u32 = 64u;

@compute @workgroup_size(WORKGROUP_SIZE)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let thread = thread_index(id, groups);
    if thread >= threads.end {
        return;
    }
    let triangle = list.first_triangle + thread;
    let scan = posed_scan(triangle);
    let count = column_count(scan);
    columns[triangle] = count;
    if count != 0u {
        count64(0u, count);
    }
}
