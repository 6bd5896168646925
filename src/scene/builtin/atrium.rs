//! `atrium`: a hall of 30 by 13 m between colonnades of two storeys, about 262 thousand triangles in about 390 objects. A
//! guard patrols it, and nine things turn, swing and rise. Clip: `patrol`.

use glam::DVec3;
use gltf::json::{Index, Material, Mesh, Node};

use super::MakeError;
use super::character::gait::Circle;
use super::character::guard::Guards;
use super::exact::{PI, TAU, at, facing, sin, turn};
use super::glb::{ClipWriter, GlbPart, GlbWriter, Paint, Track};
use super::shapes::Shape;
use super::shapes::architecture::{Drape, arch, cloth, moulding};
use super::shapes::round::{cylinder, lathe, torus};
use super::shapes::solid::{bevelled_block, block, icosphere};
use super::textures;

const BAYS: usize = 10;
const BAY: f64 = 3.0;
/// Column axes lie this far from the middle.
const SIDE: f64 = 4.5;
/// Depth of the galleries behind them.
const GALLERY: f64 = 2.0;
const STOREY: f64 = 5.2;
const COLUMN: f64 = 3.4;
const PATROL: Circle = Circle { radius_m: 3.0, lap_secs: 12.0, strides: 13.0, start_radians: 0.4 };
/// Keys of what swings and rises.
const KEYS: u32 = 48;

struct Paints {
    stone: Index<Material>,
    floor: Index<Material>,
    wall: Index<Material>,
    wood: Index<Material>,
    bronze: Index<Material>,
    lamp: Index<Material>,
    leaves: Index<Material>,
    banners: [Index<Material>; 2],
}

pub fn make() -> Result<Vec<u8>, MakeError> {
    let mut glb = GlbWriter::default();
    let paints = Paints::new(&mut glb)?;
    let mut patrol = ClipWriter::new("patrol");
    add_hall(&mut glb, &paints);
    for storey in 0..2 {
        add_storey(&mut glb, &paints, storey);
    }
    add_furniture(&mut glb, &paints);
    add_movers(&mut glb, &paints, &mut patrol);
    let guard = Guards::new(&mut glb).add(&mut glb, "guard", &PATROL.pose(0.0));
    guard.animate(&mut patrol, &PATROL.key_times(), |time| PATROL.pose(time));
    glb.clip(patrol);
    glb.sun("sun", facing(DVec3::new(4.0, 14.0, 6.0), DVec3::ZERO), [1.0, 0.96, 0.88], 20_000.0);
    glb.camera("view", facing(DVec3::new(-11.5, 2.2, 1.6), DVec3::new(6.0, 3.0, -0.6)), 1.05);
    glb.finish("atrium")
}

impl Paints {
    fn new(glb: &mut GlbWriter) -> Result<Self, MakeError> {
        let travertine = Some(glb.texture("travertine", &textures::travertine()?));
        let tiles = Some(glb.texture("stone tiles", &textures::stone_tiles()?));
        let brick = Some(glb.texture("brick", &textures::brick()?));
        let planks = Some(glb.texture("wood", &textures::wood()?));
        let banners = [
            ("crimson banner", textures::woven_banner([0.70, 0.11, 0.13], [0.95, 0.76, 0.36])?),
            ("teal banner", textures::woven_banner([0.05, 0.43, 0.45], [0.93, 0.90, 0.78])?),
        ];
        let mut paint = |name: &str, paint: Paint| glb.material(name, paint);
        let textured = |base_color_texture, roughness| Paint { base_color_texture, roughness, ..Paint::default() };
        let metal = Paint { base_color: [0.86, 0.55, 0.24], roughness: 0.3, metallic: 1.0, ..Paint::default() };
        let lamp = Paint { emissive: [1.0, 0.6, 0.25], emissive_strength: 500.0, ..Paint::default() };
        let leaves = Paint { base_color: [0.055, 0.17, 0.045], ..Paint::default() };
        Ok(Self {
            stone: paint("travertine", textured(travertine, 0.7)),
            floor: paint("floor", textured(tiles, 0.45)),
            wall: paint("brick", textured(brick, 0.9)),
            wood: paint("wood", textured(planks, 0.65)),
            bronze: paint("bronze", metal),
            lamp: paint("lamp", lamp),
            leaves: paint("leaves", leaves),
            banners: banners.map(|(name, png)| {
                let cloth = Some(glb.texture(name, &png));
                glb.material(name, Paint { double_sided: true, ..textured(cloth, 0.9) })
            }),
        })
    }
}

/// Middles of the bays along the hall.
fn bays() -> impl Iterator<Item = f64> {
    (0..BAYS).map(|bay| BAY * (bay as f64 + 0.5 - BAYS as f64 / 2.0))
}

/// Places of the columns along the hall.
fn axes() -> impl Iterator<Item = f64> {
    (0..=BAYS).map(|axis| BAY * (axis as f64 - BAYS as f64 / 2.0))
}

/// A mesh of one part that is shown many times.
fn part(glb: &mut GlbWriter, name: &str, shape: &Shape, crease_degrees: f64, paint: Index<Material>) -> Index<Mesh> {
    glb.mesh(name, &[GlbPart::new(shape.shaded(crease_degrees), paint)])
}

fn show_all(glb: &mut GlbWriter, name: &str, mesh: Index<Mesh>, places: impl IntoIterator<Item = [f64; 3]>) {
    let group = glb.node(None, &format!("{name}s"), at(0.0, 0.0, 0.0));
    for (number, [x, y, z]) in places.into_iter().enumerate() {
        glb.show(Some(group), &format!("{name} {}", number + 1), mesh, at(x, y, z));
    }
}

fn add_hall(glb: &mut GlbWriter, paints: &Paints) {
    let (long, wide) = (BAYS as f64 * BAY, 2.0 * (SIDE + GALLERY));
    let slab = part(glb, "slab", &bevelled_block(BAY, 0.2, wide / 5.0, 0.01).box_mapped(BAY), 20.0, paints.floor);
    let rows = (0..5).map(|row| wide / 5.0 * (f64::from(row) - 2.0));
    show_all(glb, "slab", slab, rows.flat_map(|z| bays().map(move |x| [x, -0.1, z])));
    let high = 2.0 * STOREY + 1.0;
    let walls = [("long wall", long, 0.3, 0.0, wide / 2.0 + 0.15), ("end wall", 0.3, wide, long / 2.0 + 0.15, 0.0)];
    for (name, x_size, z_size, x, z) in walls {
        let shape = block(x_size, high, z_size).box_mapped(1.5);
        let mesh = part(glb, name, &shape, 30.0, paints.wall);
        show_all(glb, name, mesh, [[x, high / 2.0, z], [-x, high / 2.0, -z]]);
    }
    let beam = part(glb, "beam", &bevelled_block(0.25, 0.35, 2.0 * SIDE, 0.03).box_mapped(2.0), 30.0, paints.wood);
    show_all(glb, "beam", beam, axes().map(|x| [x, 2.0 * STOREY + 0.4, 0.0]));
}

/// Turned about Y: x against height.
const COLUMN_PROFILE: [[f64; 2]; 16] = [
    [0.32, 0.0],
    [0.33, 0.06],
    [0.30, 0.12],
    [0.25, 0.15],
    [0.27, 0.20],
    [0.24, 0.26],
    [0.225, 0.32],
    [0.228, 0.90],
    [0.222, 1.60],
    [0.208, 2.30],
    [0.190, 2.95],
    [0.212, 2.98],
    [0.200, 3.04],
    [0.215, 3.12],
    [0.270, 3.22],
    [0.330, COLUMN],
];

const BALUSTER_PROFILE: [[f64; 2]; 13] = [
    [0.07, 0.0],
    [0.07, 0.05],
    [0.045, 0.08],
    [0.05, 0.12],
    [0.08, 0.22],
    [0.085, 0.28],
    [0.06, 0.42],
    [0.04, 0.56],
    [0.035, 0.64],
    [0.05, 0.68],
    [0.045, 0.72],
    [0.07, 0.76],
    [0.07, 0.80],
];

fn add_storey(glb: &mut GlbWriter, paints: &Paints, storey: usize) {
    let floor = STOREY * storey as f64;
    let name = |what: &str| format!("{} {what}", if storey == 0 { "lower" } else { "upper" });
    let sides = [-SIDE, SIDE];
    let column = part(glb, &name("column"), &lathe(&COLUMN_PROFILE, 40), 38.0, paints.stone);
    show_all(glb, &name("column"), column, sides.into_iter().flat_map(|z| axes().map(move |x| [x, floor, z])));
    let spandrel = arch(BAY, STOREY - COLUMN - 0.2, 1.2, 0.5, 48).box_mapped(1.0);
    let moulded = torus(1.22, 0.07, 64, 10);
    let moulded = Shape { triangles: behind(&moulded), ..moulded }.turned(DVec3::X, PI / 2.0);
    let rims = [-0.25, 0.25].map(|z| moulded.clone().moved(0.0, 0.0, z));
    let arch = part(glb, &name("arch"), &Shape::joined([spandrel].into_iter().chain(rims)), 35.0, paints.stone);
    show_all(glb, &name("arch"), arch, sides.into_iter().flat_map(|z| bays().map(move |x| [x, floor + COLUMN, z])));
    let profile = [[-0.3, 0.0], [0.3, 0.0], [0.36, 0.08], [0.36, 0.2], [-0.36, 0.2], [-0.36, 0.08], [-0.3, 0.0]];
    let cornice = moulding(&profile, BAYS as f64 * BAY, 20).turned(DVec3::Y, PI / 2.0);
    let cornice = part(glb, &name("cornice"), &cornice, 25.0, paints.stone);
    show_all(glb, &name("cornice"), cornice, sides.map(|z| [0.0, floor + STOREY - 0.2, z]));
}

/// The triangles of a ring about Y that are above when it is set upright.
fn behind(ring: &Shape) -> Vec<[usize; 3]> {
    let is_behind = |corners: &&[usize; 3]| corners.iter().all(|&corner| ring.positions[corner].z <= 1e-9);
    ring.triangles.iter().filter(is_behind).copied().collect()
}

fn add_furniture(glb: &mut GlbWriter, paints: &Paints) {
    let baluster = part(glb, "baluster", &lathe(&BALUSTER_PROFILE, 14), 40.0, paints.stone);
    let along = || bays().flat_map(|x| (0..6).map(move |step| x + 0.4 * (f64::from(step) - 2.5)));
    let sides = [-SIDE, SIDE];
    show_all(glb, "baluster", baluster, sides.into_iter().flat_map(|z| along().map(move |x| [x, STOREY, z])));
    for (number, paint) in paints.banners.into_iter().enumerate() {
        let drape =
            Drape { width_m: 1.1, height_m: 2.6, folds: 3.0, fold_depth_m: 0.09, point_m: 0.25, phase: number as f64 };
        let name = if number == 0 { "crimson banner" } else { "teal banner" };
        let mesh = part(glb, name, &cloth(&drape, 28, 26), 60.0, paint);
        let z = sides[number] - sides[number].signum() * 0.45;
        show_all(glb, name, mesh, bays().map(|x| [x, STOREY + COLUMN, z]));
    }
    let shade = lathe(&[[0.0, 0.0], [0.10, 0.02], [0.13, 0.12], [0.10, 0.24], [0.0, 0.26]], 24);
    let cage = Shape::joined([
        torus(0.14, 0.012, 24, 6),
        torus(0.11, 0.012, 24, 6).moved(0.0, 0.25, 0.0),
        cylinder(0.008, 1.1, 8).moved(0.0, 0.26, 0.0),
    ]);
    let lamp = [GlbPart::new(shade.shaded(60.0), paints.lamp), GlbPart::new(cage.shaded(40.0), paints.bronze)];
    let lamp = glb.mesh("lamp", &lamp);
    show_all(glb, "lamp", lamp, sides.into_iter().flat_map(|z| bays().map(move |x| [x, 3.2, z * 1.22])));
    let pot = lathe(&[[0.0, 0.0], [0.20, 0.0], [0.26, 0.2], [0.30, 0.42], [0.33, 0.46], [0.28, 0.46], [0.0, 0.40]], 32);
    let tree = icosphere(3).scaled(0.42, 0.62, 0.42).moved(0.0, 1.0, 0.0);
    let plant = [GlbPart::new(pot.shaded(40.0), paints.stone), GlbPart::new(tree.shaded(15.0), paints.leaves)];
    let plant = glb.mesh("plant", &plant);
    let places = axes().skip(2).take(7).flat_map(|x| sides.map(|z| [x, 0.0, z - z.signum() * 0.75]));
    show_all(glb, "plant", plant, places);
}

/// Three that turn, three that swing, three that rise and fall.
fn add_movers(glb: &mut GlbWriter, paints: &Paints, clip: &mut ClipWriter) {
    let ring = Shape::joined([torus(0.7, 0.09, 64, 16), icosphere(2).scaled(0.22, 0.22, 0.22)]);
    let ring = part(glb, "turning ring", &ring, 40.0, paints.bronze);
    let bell = lathe(&[[0.0, -0.9], [0.36, -1.15], [0.30, -0.8], [0.16, -0.45], [0.0, -0.4]], 40);
    let bell = Shape::joined([bell, cylinder(0.02, 0.5, 10).moved(0.0, -0.45, 0.0)]);
    let bell = part(glb, "swinging bell", &bell, 40.0, paints.bronze);
    let stone = part(glb, "rising stone", &bevelled_block(0.9, 0.9, 0.9, 0.08).split_in_four(), 20.0, paints.stone);
    let times: Vec<f64> = (0..=KEYS).map(|key| PATROL.lap_secs * f64::from(key) / f64::from(KEYS)).collect();
    let phase = |key: u32, number: usize| TAU * (f64::from(key % KEYS) / f64::from(KEYS) * 3.0 + number as f64 / 3.0);
    for number in 0..3 {
        let x = 7.5 * (number as f64 - 1.0);
        let node = show_moving(glb, "turning ring", ring, number, DVec3::new(x, 6.6, 0.0));
        let turns = (0..=KEYS).map(|key| turn(DVec3::X, phase(key, number))).collect();
        clip.track(node, &times, Track::Rotation(turns));
        let node = show_moving(glb, "swinging bell", bell, number, DVec3::new(x + 3.0, 2.0 * STOREY, 0.0));
        let swings = (0..=KEYS).map(|key| turn(DVec3::Z, 0.5 * sin(phase(key, number)))).collect();
        clip.track(node, &times, Track::Rotation(swings));
        let place = |key: u32| DVec3::new(x - 3.0, 1.2 + 0.7 * sin(phase(key, number)), -3.0);
        let node = show_moving(glb, "rising stone", stone, number, place(0));
        clip.track(node, &times, Track::Translation((0..=KEYS).map(place).collect()));
    }
}

fn show_moving(glb: &mut GlbWriter, name: &str, mesh: Index<Mesh>, number: usize, place: DVec3) -> Index<Node> {
    glb.show(None, &format!("{name} {}", number + 1), mesh, at(place.x, place.y, place.z))
}
