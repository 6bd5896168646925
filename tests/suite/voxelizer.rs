//! Posed triangles to world voxels, kernel by kernel, beside the exact predicates and integers that never overflow.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::time::Duration;

use glam::{DVec3, IVec3, Vec2, Vec3};
use octolume::data::fragments::{AREA_BITS, AREA_ONE, FRAGMENT_WORDS, FragmentRoom, PosedTriangles, UNSHADED};
use octolume::data::grid::{Grid, morton_key};
use octolume::data::light::{EMISSION_MAX, pack_emission};
use octolume::data::mesh::{MeshScene, PosedMesh, Textures};
use octolume::data::octree::Slot;
use octolume::data::packing::unpack_normal;
use octolume::data::pages::{ListedVoxels, OBJECT_BY_VOXEL, WorkItem};
use octolume::gpu::GpuBuffer;
use octolume::scene::{AlphaMode, Material, Node, Primitive, Scene, Texture, TextureRef, Wrap};
use octolume::settings::{Hidden, VoxelizationMode, VoxelizerCells};
use octolume::stages::build::scan::{self, Scanned};
use octolume::stages::textures::halve::record_levels;
use octolume::stages::voxelize::count_ref::column_count;
use octolume::stages::voxelize::cover_ref::{Covered, cover};
use octolume::stages::voxelize::merge_ref::merge;
use octolume::stages::voxelize::shade_ref::{Shaded, Shading};
use octolume::stages::voxelize::{
    CellStore, CellStoreBuffers, SurfaceMaterials, TexturePyramids, count, cover as cover_kernel,
    merge as merge_kernel, shade,
};
use proptest::prelude::*;
use proptest::test_runner::TestRng;

use crate::device::gpu;
use crate::mesh_rig::node;
use crate::random::rng;
use crate::stage_rig::{buffer, fragment, read, run, upload};

const DEPTH: u32 = 5;
const CELLS: u32 = 1 << DEPTH;

/// World units are cells.
fn grid() -> Grid {
    Grid { anchor: DVec3::ZERO, offset_cells: IVec3::ZERO, span: 1.0, depth: DEPTH }
}

const CLIP: [IVec3; 2] = [IVec3::ZERO, IVec3::splat(CELLS as i32)];

/// What the kernels made of a scene.
struct Made {
    columns: Vec<u32>,
    /// As `cover` left them.
    covered: Vec<Vec<u32>>,
    shaded: Vec<Vec<u32>>,
    /// With the object of each.
    voxels: Vec<([u32; 4], u32)>,
}

struct Shape {
    mode: VoxelizationMode,
    cells: VoxelizerCells,
    /// Nits; 0: nothing emits.
    brightest: f32,
}

const THIN: Shape = Shape { mode: VoxelizationMode::Thin, cells: VoxelizerCells::Sparse, brightest: 0.0 };

fn voxelized(scene: &Scene, shape: &Shape) -> Made {
    let gpu = gpu();
    let mut mesh = MeshScene::new(Arc::new(scene.clone()), (0..).zip(scene.objects()).collect(), record_levels);
    while !mesh.upload(gpu, (&Hidden::default(), Textures::None), Duration::ZERO).expect("fits") {}
    let of_pose = (&scene.pose(None, 0.0), &Hidden::default());
    let posed = PosedMesh::new(gpu, &mesh, &mut Slot::default(), of_pose, &grid().grid_from_world()).expect("fits");
    let triangles = posed.triangles(gpu, &mut Slot::default(), CELLS).expect("fits");
    let (columns, starts) = counted(&triangles, shape.mode);
    let counts: Vec<u32> = read(gpu, &columns, triangles.count.into());
    let total = counts.iter().sum::<u32>();
    let room = FragmentRoom { fragments: 3 * total + 1, voxels: 3 * total + 1, hints: 1, bucket_bits: 0 };
    let emits = shape.brightest > 0.0;
    let mut buffers = CellStoreBuffers::default();
    let store = CellStore::new(gpu, &mut buffers, (shape.cells, DEPTH), room, emits).expect("fits");
    let materials =
        SurfaceMaterials::new(scene, &TexturePyramids::new(&scene.textures), (CELLS, shape.brightest), |_| true);
    let materials = (upload(gpu, "materials", &materials.materials), upload(gpu, "texels", &materials.texels));
    run(gpu, |frame| {
        store.record_clear(frame);
        cover_kernel::record(gpu, frame, (&triangles, shape.mode), (total, &starts), &store);
    });
    let covered = fragments(&store, emits);
    let item = WorkItem { first_thread: 0, first_slot: 0, first_voxel: 1, part: 0, object: OBJECT_BY_VOXEL };
    let listed = ListedVoxels {
        work_items: upload(gpu, "work items", &[item, WorkItem { first_thread: u32::MAX, ..item }]),
        work_hints: buffer(gpu, "work hints", u64::from(1 + room.voxels)),
        parts: upload(gpu, "parts", &[0_u32; 8]),
        world_voxels: buffer(gpu, "world voxels", 4 * u64::from(room.voxels)),
        threads: room.voxels,
    };
    let voxel_count = buffer(gpu, "voxel count", 1);
    let emission = buffer(gpu, "emission", 2 * u64::from(room.voxels));
    run(gpu, |frame| {
        shade::record(gpu, frame, &triangles, (&materials.0, &materials.1), &store);
        merge_kernel::record(gpu, frame, &store, &listed, (&voxel_count, &emission));
    });
    let shaded = fragments(&store, emits);
    let count = u64::from(read::<u32>(gpu, &voxel_count, 1)[0]);
    let voxels: Vec<[u32; 4]> = read(gpu, &listed.world_voxels, count);
    let objects: Vec<u32> = read(gpu, &listed.work_hints, 1 + count);
    Made { columns: counts, covered, shaded, voxels: voxels.into_iter().zip(objects[1..].to_vec()).collect() }
}

fn counted(triangles: &PosedTriangles, mode: VoxelizationMode) -> (GpuBuffer, GpuBuffer) {
    let gpu = gpu();
    let columns = buffer(gpu, "columns", u64::from(triangles.count));
    let starts = buffer(gpu, "starts", u64::from(triangles.count) + 1);
    let total = buffer(gpu, "total", 2);
    run(gpu, |frame| {
        count::record(gpu, frame, (triangles, mode), (&columns, &total));
        let words = (Scanned::Words, triangles.count);
        scan::record(gpu, frame, words, &columns, &starts, &mut Vec::new()).expect("fits");
    });
    let counts: Vec<u32> = read(gpu, &columns, triangles.count.into());
    assert_eq!(read::<u32>(gpu, &total, 2), [counts.iter().sum::<u32>(), 0]);
    assert_eq!(read::<u32>(gpu, &starts, u64::from(triangles.count) + 1).last(), Some(&counts.iter().sum::<u32>()));
    (columns, starts)
}

fn fragments(store: &CellStore, emits: bool) -> Vec<Vec<u32>> {
    let gpu = gpu();
    let words = (FRAGMENT_WORDS + if emits { 2 } else { 0 }) as usize;
    let count = read::<u32>(gpu, &store.heads, 1)[0] as usize;
    let all: Vec<u32> = read(gpu, &store.fragments, (count * words) as u64);
    all.chunks(words).map(<[u32]>::to_vec).collect()
}

/// Triangle and Morton key.
fn place(covered: &[u32]) -> (u32, u32) {
    assert!(covered[0] & UNSHADED != 0);
    (covered[2], covered[0] & !UNSHADED)
}

/// Weights of the triangle's corners at the middle, and share of its area.
fn piece(covered: &[u32]) -> (DVec3, f64) {
    let [second, third] = [0, 16].map(|shift| f64::from(covered[4] >> shift & 0xffff) / 65535.0);
    (DVec3::new(1.0 - second - third, second, third), f64::from(f32::from_bits(covered[5])))
}

fn random_point(rng: &mut TestRng, from: f32, to: f32) -> Vec3 {
    Vec3::from_array(std::array::from_fn(|_| rng.random_range(from..to)))
}

/// Triangles of every size around the grid, some of them outside.
fn random_primitive(rng: &mut TestRng, triangles: u32, material: Option<usize>) -> Primitive {
    let mut primitive = Primitive { material, ..Primitive::default() };
    for triangle in 0..triangles {
        let size = [0.5, 3.0, 20.0][triangle as usize % 3];
        let center = random_point(rng, -2.0, CELLS as f32 + 2.0);
        for _ in 0..3 {
            primitive.positions.push(center + random_point(rng, -size, size));
            primitive.normals.push(random_point(rng, -1.0, 1.0).normalize());
            primitive.tex_coords[0].push(Vec2::new(rng.random_range(-1.0..2.0), rng.random_range(-1.0..2.0)));
        }
        primitive.triangles.push([0, 1, 2].map(|corner| 3 * triangle + corner));
    }
    primitive
}

fn scene(primitives: Vec<Vec<Primitive>>, materials: Vec<Material>, textures: Vec<Texture>) -> Scene {
    let meshes = primitives.into_iter().map(|primitives| octolume::scene::Mesh { name: "mesh".to_owned(), primitives });
    let meshes: Vec<_> = meshes.collect();
    let nodes = (0..meshes.len()).map(|mesh| Node { mesh: Some(mesh), ..node("node", DVec3::ZERO) });
    Scene { nodes: nodes.collect(), meshes, materials, textures, ..Scene::default() }
}

/// By triangle in the order of draws.
fn corners(scene: &Scene) -> Vec<[DVec3; 3]> {
    let primitives = scene.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let of = |primitive: &Primitive| -> Vec<[DVec3; 3]> {
        let corner = |vertex: u32| primitive.positions[vertex as usize].as_dvec3();
        primitive.triangles.iter().map(|triangle| triangle.map(corner)).collect()
    };
    primitives.flat_map(of).collect()
}

type Cells = BTreeMap<(u32, u32), Covered>;

/// By triangle and Morton key.
fn expected(scene: &Scene, mode: VoxelizationMode) -> Cells {
    let of = |(triangle, corners): (u32, [DVec3; 3])| {
        let key = |cell: IVec3| morton_key(cell.to_array().map(|c| c as u32));
        cover(corners, mode, CLIP).into_iter().map(move |covered| ((triangle, key(covered.cell)), covered))
    };
    (0_u32..).zip(corners(scene)).flat_map(of).collect()
}

#[test]
fn columns_are_those_of_the_bounds_inside_the_grid() {
    let mut rng = rng(7);
    let scene = scene(vec![vec![random_primitive(&mut rng, 500, None)]], vec![], vec![]);
    let made = voxelized(&scene, &THIN);
    let expected: Vec<u32> = corners(&scene).into_iter().map(|corners| column_count(corners, CELLS)).collect();
    assert_eq!(made.columns, expected);
    assert_eq!(column_count([DVec3::ZERO, DVec3::new(4.0, 0.0, 0.0), DVec3::new(0.0, 3.0, 0.0)], CELLS), 12);
}

/// Coordinates are at no place where f32 could decide otherwise than exact predicates, but by chance.
#[test]
fn covered_cells_and_pieces_are_those_of_the_exact_predicates() {
    for (seed, mode) in [(1, VoxelizationMode::Thin), (2, VoxelizationMode::Conservative)] {
        let mut rng = rng(seed);
        let scene = scene(vec![vec![random_primitive(&mut rng, 600, None)]], vec![], vec![]);
        for cells in [VoxelizerCells::Sparse, VoxelizerCells::Dense] {
            let made = voxelized(&scene, &Shape { mode, cells, ..THIN });
            let expected = expected(&scene, mode);
            let found: BTreeSet<(u32, u32)> = made.covered.iter().map(|words| place(words)).collect();
            assert_eq!(found.len(), made.covered.len(), "no cell twice");
            let apart = found.iter().filter(|key| !expected.contains_key(key)).count()
                + expected.keys().filter(|key| !found.contains(key)).count();
            assert!(expected.len() > 10_000 && apart * 5_000 < expected.len(), "{apart} of {}", expected.len());
            for words in &made.covered {
                let Some(covered) = expected.get(&place(words)) else { continue };
                // f32 in (s, t) of triangles of up to 40 cells: 40² · 2^-23 of a cell², and a unit of rounding.
                let area = f64::from(words[3]) / f64::from(AREA_ONE);
                assert!((area - covered.area).abs() < 1e-3, "{area} is not {}", covered.area);
                let (weights, share) = piece(words);
                assert!((share - covered.share).abs() < 1e-3);
                if covered.area > 0.01 {
                    assert!((weights - covered.weights).abs().max_element() < 1e-2, "{weights}");
                }
            }
        }
    }
}

/// What lies in a plane between cells covers those above, and what crosses at 45° through their edges both.
#[test]
fn planes_between_cells_cover_what_the_exact_predicates_say() {
    let quad = |corners: [[f32; 3]; 4]| Primitive {
        positions: corners.map(Vec3::from_array).to_vec(),
        normals: vec![Vec3::Y; 4],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Primitive::default()
    };
    let flat = quad([[2.0, 8.0, 2.0], [18.0, 8.0, 2.0], [18.0, 8.0, 18.0], [2.0, 8.0, 18.0]]);
    let slanted = quad([[4.0, 4.0, 20.0], [12.0, 12.0, 20.0], [12.0, 12.0, 28.0], [4.0, 4.0, 28.0]]);
    for primitive in [flat, slanted] {
        let scene = scene(vec![vec![primitive]], vec![], vec![]);
        let made = voxelized(&scene, &THIN);
        let found: BTreeSet<(u32, u32)> = made.covered.iter().map(|words| place(words)).collect();
        assert_eq!(found, expected(&scene, THIN.mode).into_keys().collect());
    }
}

/// A chequered image whose alpha goes from 0.3 to 1.
fn texture(wrap: Wrap, nearest: bool) -> Texture {
    let mut image = image::RgbaImage::new(24, 16);
    for (x, y, texel) in image.enumerate_pixels_mut() {
        let on = (x / 3 + y / 2) % 2 == 0;
        *texel = image::Rgba([if on { 220 } else { 30 }, (10 * x) as u8, (15 * y) as u8, (77 + 7 * x) as u8]);
    }
    Texture { image: Arc::new(image), wrap: [wrap; 2], nearest, name: "cheque".to_owned() }
}

fn textured(texture: usize, alpha_mode: AlphaMode) -> Material {
    let base_color_texture = Some(TextureRef::new(texture, 0));
    Material { base_color: [0.9, 0.8, 1.0, 1.0], base_color_texture, alpha_mode, ..Material::default() }
}

fn shaded(words: &[u32]) -> Shaded {
    let roots = [0, 10, 20].map(|shift| words[4] >> shift & 0x3ff);
    let area = words[3] & ((1 << AREA_BITS) - 1);
    Shaded { area, opacity: words[3] >> AREA_BITS, roots, normal: words[5] }
}

#[test]
fn fragments_look_as_those_of_the_caches_and_merge_exactly() {
    let mut rng = rng(3);
    let modes = [AlphaMode::Opaque, AlphaMode::Blend, AlphaMode::Mask { cutoff: 0.6 }, AlphaMode::Opaque];
    let materials: Vec<Material> = (0..4).map(|i| textured(i, modes[i])).collect();
    let wraps = [Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge, Wrap::Repeat];
    let textures: Vec<Texture> = (0..4).map(|i| texture(wraps[i], i == 3)).collect();
    let primitives = (0..4).map(|i| vec![random_primitive(&mut rng, 120, Some(i))]).collect();
    let scene = scene(primitives, materials, textures);
    let made = voxelized(&scene, &THIN);
    assert_shaded(&scene, &made);
    let fragments = made.shaded.iter().map(|words| (words[0], words[2], shaded(words)));
    let mut merged = merge(fragments);
    assert!(made.voxels.len() > 5_000);
    for (words, object) in &made.voxels {
        let found = fragment(*words).expect("in the grid");
        let cell = found.q.map(|q| (q >> 8) as u32);
        assert_eq!(found.q.map(|q| q & 255), [0; 3], "it lies wholly in its cell");
        let [normal, color] = merged.remove(&(morton_key(cell), *object)).expect("a voxel that is due, once");
        // The last division is one of floats: a code next to a half may go the other way.
        let bytes = |word: u32| word.to_le_bytes().map(i32::from);
        let apart = bytes(color).into_iter().zip(bytes(words[3])).map(|(a, b)| (a - b).abs()).max();
        assert!(apart <= Some(1), "{color:08x} {:08x}", words[3]);
        let apart = (unpack_normal(normal) - unpack_normal(words[2])).length();
        assert!(apart < 3.0 / 511.0, "{apart}");
    }
    assert!(merged.is_empty(), "{} voxels lack", merged.len());
}

/// Colours are read from texels of 8 bits of a root, twice, from a premultiplied one.
fn assert_shaded(scene: &Scene, made: &Made) {
    let textures = TexturePyramids::new(&scene.textures);
    let normals: Vec<Vec<DVec3>> = scene
        .meshes
        .iter()
        .map(|mesh| mesh.primitives[0].normals.iter().map(|normal| normal.as_dvec3()).collect())
        .collect();
    let mut apart = 0;
    for (covered, found) in made.covered.iter().zip(&made.shaded) {
        let object = found[2] as usize;
        let primitive = &scene.meshes[object].primitives[0];
        let material = &scene.materials[object];
        let shading = Shading { primitive, material, textures: &textures, normals: &normals[object] };
        let triangle = primitive.triangles[covered[2] as usize - 120 * object];
        let (weights, share) = piece(covered);
        let area = f64::from(covered[3]) / f64::from(AREA_ONE);
        let (expected, found) = (shading.shade(triangle, (area, share), weights), shaded(found));
        assert_eq!(found.area, expected.area);
        let differs = |a: u32, b: u32, by: u32| a.abs_diff(b) > by;
        // Four steps of a code of 10 bits are one of a texel's.
        let is_apart = (0..3).any(|axis| differs(found.roots[axis], expected.roots[axis], 6))
            || differs(found.opacity, expected.opacity, 12);
        apart += usize::from(is_apart);
        let turned = (unpack_normal(found.normal) - unpack_normal(expected.normal)).length();
        assert!(turned < 3.0 / 511.0, "{found:?} {expected:?}");
    }
    // Between texels of a mask f32 may cut where f64 does not.
    assert!(apart * 200 < made.covered.len(), "{apart} of {} differ", made.covered.len());
}

#[test]
fn lamps_emit_what_their_material_says() {
    let lamp = Material { emissive: [3.0, 2.0, 0.5], ..Material::default() };
    let mut rng = rng(5);
    let scene = scene(vec![vec![random_primitive(&mut rng, 30, Some(0))]], vec![lamp], vec![]);
    let made = voxelized(&scene, &Shape { brightest: 3.0, ..THIN });
    let expected = pack_emission([3.0, 2.0, 0.5], 3.0);
    assert!(made.shaded.len() > 500 && expected[0] & EMISSION_MAX == EMISSION_MAX);
    assert!(made.shaded.iter().all(|words| words[6..8] == expected));
}
