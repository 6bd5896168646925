// A ray through a cubic lattice of unit cells, box by box: exactly the cells it crosses, in order.
//
// The cell is kept as integers that only ever move along the ray, so t never decreases, no cell
// comes twice, and a walk through N³ cells ends after 3N steps, whatever rounding does to t. Cells
// are half-open; one that is only touched (edge, corner, face) is crossed with length zero.

// Later than anything: planes that a ray runs along are never reached.
const NEVER: f32 = 3.0e38;
// Slower than this along an axis is not at all (its inverse would overflow).
const STANDSTILL: f32 = 1.0e-30;

struct Ray {
    origin: vec3<f32>,
    // Unit length, or zero.
    direction: vec3<f32>,
    inverse: vec3<f32>,
    moves: vec3<bool>,
    forward: vec3<bool>,
}

// Where a walk is: inside `cell` since `t`, entered through the faces across `entered`.
struct Walk {
    cell: vec3<i32>,
    t: f32,
    entered: vec3<bool>,
    inside: bool,
}

// A way through a box.
struct Exit {
    t: f32,
    across: vec3<bool>,
}

fn ray_of(origin: vec3<f32>, direction: vec3<f32>) -> Ray {
    let moves = abs(direction) > vec3<f32>(STANDSTILL);
    let inverse = 1.0 / select(vec3<f32>(1.0), direction, moves);
    return Ray(origin, direction, inverse, moves, direction > vec3<f32>(STANDSTILL));
}

fn ray_at(ray: Ray, t: f32) -> vec3<f32> {
    return ray.origin + t * ray.direction;
}

// When the ray crosses a plane of each axis.
fn plane_times(ray: Ray, planes: vec3<f32>) -> vec3<f32> {
    return (planes - ray.origin) * ray.inverse;
}

// The cell at a point, that ahead of it when the point lies on a face.
fn cell_ahead(ray: Ray, p: vec3<f32>) -> vec3<i32> {
    return vec3<i32>(select(floor(p), ceil(p) - 1.0, ray.moves & !ray.forward));
}

// Into the lattice of `cells`³, from wherever the ray starts.
fn enter_lattice(ray: Ray, cells: i32) -> Walk {
    let high = vec3<f32>(f32(cells));
    let low = vec3<f32>(0.0);
    let near = select(vec3<f32>(-NEVER), plane_times(ray, select(high, low, ray.forward)), ray.moves);
    let far = select(vec3<f32>(NEVER), plane_times(ray, select(low, high, ray.forward)), ray.moves);
    let start = max(0.0, max(near.x, max(near.y, near.z)));
    let end = min(far.x, min(far.y, far.z));
    let beside = !ray.moves & ((ray.origin < low) | (ray.origin >= high));
    let entered = (near == vec3<f32>(start)) & vec3<bool>(start > 0.0);
    let first = select(vec3<i32>(cells - 1), vec3<i32>(0), ray.forward);
    let inner = clamp(cell_ahead(ray, ray_at(ray, start)), vec3<i32>(0), vec3<i32>(cells - 1));
    let inside = any(ray.moves) && !any(beside) && start < end;
    return Walk(select(inner, first, entered), start, entered, inside);
}

// Out of the box of `size`³ cells whose lowest is `low`. Of faces reached together, the first.
fn leave_box(ray: Ray, low: vec3<i32>, size: i32) -> Exit {
    let planes = vec3<f32>(select(low, low + size, ray.forward));
    let times = select(vec3<f32>(NEVER), plane_times(ray, planes), ray.moves);
    let t = min(times.x, min(times.y, times.z));
    if times.x == t {
        return Exit(t, vec3<bool>(true, false, false));
    }
    return Exit(t, vec3<bool>(false, times.y == t, times.y != t));
}

// Into the cell behind that exit. The box's extent along the ray bounds the rounding of t.
fn walk_on(walk: Walk, ray: Ray, low: vec3<i32>, size: i32, exit: Exit, cells: i32) -> Walk {
    let t = max(walk.t, exit.t);
    let lower = select(low, walk.cell, ray.forward);
    let upper = select(walk.cell, low + size - 1, ray.forward);
    let aside = select(walk.cell, clamp(cell_ahead(ray, ray_at(ray, t)), lower, upper), ray.moves);
    let behind = select(low - 1, low + size, ray.forward);
    let cell = select(aside, behind, exit.across);
    return Walk(cell, t, exit.across, all(cell >= vec3<i32>(0)) && all(cell < vec3<i32>(cells)));
}
