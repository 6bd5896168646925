// Which cells a triangle covers: stages::voxelize::coverage in f32. A triangle is looked at along the axis along which
// it looks largest, w; what runs through the grid there are columns of cells, (u, v).
//
// Differs from the exact predicates where a decision hangs on less than f32 resolves. A kernel declares what
// shared/triangle_list.wgsl asks for.
#import constants
#import shared/triangle_list.wgsl

override CONSERVATIVE: bool = false;

struct ColumnScan {
    axis: u32,
    // Which corner of the triangle each is, and its weights' order.
    order: array<u32, 3>,
    // In (u, v, w), sorted by place, so that neither winding nor numbers change a cell.
    corners: array<vec3<f32>, 3>,
    // Twice the signed areas of the projections along u, v and w.
    areas: vec3<f32>,
    // Inclusive range of cells inside the grid; empty where low exceeds high.
    low: vec3<i32>,
    high: vec3<i32>,
    // The bounds span one layer along w, in the grid or not.
    is_one_layer: bool,
}

fn to_uvw(p: vec3<f32>, axis: u32) -> vec3<f32> {
    switch axis {
        case 0u: { return p.yzx; }
        case 1u: { return p.zxy; }
        default: { return p; }
    }
}

fn from_uvw(cell: vec3<i32>, axis: u32) -> vec3<i32> {
    switch axis {
        case 0u: { return cell.zxy; }
        case 1u: { return cell.yzx; }
        default: { return cell; }
    }
}

fn lies_before(a: vec3<f32>, b: vec3<f32>) -> bool {
    return a.x < b.x || (a.x == b.x && (a.y < b.y || (a.y == b.y && a.z < b.z)));
}

fn swap_corners(scan: ptr<function, ColumnScan>, i: u32, j: u32) {
    if lies_before((*scan).corners[j], (*scan).corners[i]) {
        let corner = (*scan).corners[i];
        let order = (*scan).order[i];
        (*scan).corners[i] = (*scan).corners[j];
        (*scan).order[i] = (*scan).order[j];
        (*scan).corners[j] = corner;
        (*scan).order[j] = order;
    }
}

// Of equals z before y before x.
fn dominant_axis(areas: vec3<f32>) -> u32 {
    let size = abs(areas);
    if size.z >= size.x && size.z >= size.y {
        return 2u;
    }
    return select(0u, 1u, size.y >= size.x);
}

// Corners in cells from the grid's corner.
fn column_scan(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, grid_cells: u32) -> ColumnScan {
    var scan = ColumnScan();
    scan.order = array(0u, 1u, 2u);
    scan.corners = array(a, b, c);
    swap_corners(&scan, 0u, 1u);
    swap_corners(&scan, 1u, 2u);
    swap_corners(&scan, 0u, 1u);
    let areas = cross(scan.corners[1] - scan.corners[0], scan.corners[2] - scan.corners[0]);
    scan.axis = dominant_axis(areas);
    scan.areas = to_uvw(areas, scan.axis);
    scan.high = vec3<i32>(-1);
    // What is not finite compares with nothing.
    if !(abs(scan.areas.z) > 0.0) {
        return scan;
    }
    for (var i = 0u; i < 3u; i += 1u) {
        scan.corners[i] = to_uvw(scan.corners[i], scan.axis);
    }
    let least = floor(min(min(scan.corners[0], scan.corners[1]), scan.corners[2]));
    // A single integer belongs to the cell above it.
    let most = max(ceil(max(max(scan.corners[0], scan.corners[1]), scan.corners[2])) - 1.0, least);
    scan.is_one_layer = least.z == most.z;
    // As floats first: what is far does not fit an integer.
    let size = f32(grid_cells);
    scan.low = vec3<i32>(clamp(least, vec3<f32>(0.0), vec3<f32>(size)));
    scan.high = vec3<i32>(clamp(most, vec3<f32>(-1.0), vec3<f32>(size - 1.0)));
    return scan;
}

// Of a posed triangle of the batch.
fn posed_scan(triangle: u32) -> ColumnScan {
    let owner = entered_draw(triangle);
    return column_scan(posed_corner(owner, triangle, 0u), posed_corner(owner, triangle, 1u), posed_corner(owner, triangle, 2u), list.grid_cells);
}

fn column_count(scan: ColumnScan) -> u32 {
    if any(scan.low > scan.high) {
        return 0u;
    }
    let size = vec2<u32>(scan.high.xy - scan.low.xy + 1);
    return size.x * size.y;
}

// Twice the signed area of (from, to, p): positive where p lies to the left.
fn side_of(from_: vec2<f32>, to: vec2<f32>, p: vec2<f32>) -> f32 {
    let along = to - from_;
    let at = p - from_;
    return along.x * at.y - along.y * at.x;
}

// The point of the square, or of the cross of its axes, that lies furthest inside an edge: is it inside?
fn edge_reaches(from_: vec2<f32>, to: vec2<f32>, cell: vec2<f32>) -> bool {
    let normal = vec2<f32>(from_.y - to.y, to.x - from_.x);
    let step = select(vec2<f32>(0.0), vec2<f32>(1.0), normal > vec2<f32>(0.0));
    if CONSERVATIVE {
        return side_of(from_, to, cell + step) > 0.0;
    }
    return side_of(from_, to, cell + vec2<f32>(step.x, 0.5)) >= 0.0 || side_of(from_, to, cell + vec2<f32>(0.5, step.y)) >= 0.0;
}

// A projection of the triangle reaches a cell of it. `area` is that of the projection: of none, all is reached.
fn projection_reaches(a: vec2<f32>, b: vec2<f32>, c: vec2<f32>, area: f32, cell: vec2<f32>) -> bool {
    if area == 0.0 {
        return true;
    }
    let second = select(c, b, area > 0.0);
    let third = select(b, c, area > 0.0);
    return edge_reaches(a, second, cell) && edge_reaches(second, third, cell) && edge_reaches(third, a, cell);
}

// Inside all edges, in the projection along w.
fn holds_point(scan: ColumnScan, p: vec2<f32>) -> bool {
    let turn = sign(scan.areas.z);
    let a = scan.corners[0].xy;
    let b = scan.corners[1].xy;
    let c = scan.corners[2].xy;
    return turn * side_of(a, b, p) > 0.0 && turn * side_of(b, c, p) > 0.0 && turn * side_of(c, a, p) > 0.0;
}

// Columns whose square, or centre, lies inside: there the plane alone decides.
fn is_surely_inside(scan: ColumnScan, column: vec2<f32>) -> bool {
    if CONSERVATIVE {
        return holds_point(scan, column) && holds_point(scan, column + vec2<f32>(1.0, 0.0)) && holds_point(scan, column + vec2<f32>(0.0, 1.0)) && holds_point(scan, column + 1.0);
    }
    return holds_point(scan, column + 0.5);
}

fn plane_height(scan: ColumnScan, slope: vec2<f32>, at: vec2<f32>) -> f32 {
    return scan.corners[0].z + dot(slope, at - scan.corners[0].xy);
}

// Cells of a column that the plane meets, inclusive; those of the bounds.
fn column_layers(scan: ColumnScan, column: vec2<f32>) -> vec2<i32> {
    if CONSERVATIVE && scan.is_one_layer {
        return vec2<i32>(scan.low.z, scan.high.z);
    }
    let slope = -scan.areas.xy / scan.areas.z;
    var lowest = vec2<f32>(0.5);
    if CONSERVATIVE {
        lowest = select(vec2<f32>(1.0), vec2<f32>(0.0), slope > vec2<f32>(0.0));
    }
    let bottom = plane_height(scan, slope, column + lowest);
    let top = plane_height(scan, slope, column + 1.0 - lowest);
    // Conservative: open cells. Thin: closed ones, of which a height between two meets both.
    let layers = select(vec2<f32>(ceil(bottom) - 1.0, floor(top)), vec2<f32>(floor(bottom), ceil(top) - 1.0), CONSERVATIVE);
    return clamp(vec2<i32>(layers), vec2<i32>(scan.low.z, -1), vec2<i32>(i32(1u << 20u), scan.high.z));
}

// The sides of the triangle reach the cell too.
fn sides_reach(scan: ColumnScan, cell: vec3<f32>) -> bool {
    let a = scan.corners[0];
    let b = scan.corners[1];
    let c = scan.corners[2];
    return projection_reaches(a.yz, b.yz, c.yz, scan.areas.x, cell.yz) && projection_reaches(a.zx, b.zx, c.zx, scan.areas.y, cell.zx);
}

fn column_reaches(scan: ColumnScan, column: vec2<f32>) -> bool {
    return projection_reaches(scan.corners[0].xy, scan.corners[1].xy, scan.corners[2].xy, scan.areas.z, column);
}
