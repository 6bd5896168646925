//! Scenes with a bit of everything: rigid and skinned motion, lamps, glow, gloss.

use std::sync::{Arc, LazyLock};

use glam::{DMat4, DQuat, DVec3};
use octolume::prepare::{Prepared, prepare};
use octolume::progress::Progress;
use octolume::scene::{Interpolation, Light, LightKind, Material, Mesh, Node, Property, Scene, Skin};
use octolume::settings::Discretization;
use octolume::settings::VoxelizationMode;

use crate::scenes::{at, channel, clip, cube, node, rotation, scaled, sliding_scene};

/// Every scene in every discretization that walks go through.
pub fn prepared() -> &'static [Arc<Prepared>] {
    static PREPARED: LazyLock<Vec<Arc<Prepared>>> = LazyLock::new(|| {
        let scenes = [busy(), sliding_scene(), stretching()].map(Arc::new);
        let grids = [(64, VoxelizationMode::Thin), (128, VoxelizationMode::Thin), (64, VoxelizationMode::Conservative)];
        let all = scenes.iter().flat_map(|scene| grids.map(|grid| (Arc::clone(scene), grid)));
        all.map(|(scene, (grid, mode))| prepare_one(scene, grid, mode)).collect()
    });
    &PREPARED
}

fn prepare_one(scene: Arc<Scene>, grid: u32, mode: VoxelizationMode) -> Arc<Prepared> {
    let discretization = Discretization { grid, mode, ..Discretization::default() };
    let prepared = prepare(scene, &discretization, None, &Progress::default());
    Arc::new(prepared.unwrap_or_else(|error| panic!("{error}")))
}

/// The busy scene, whose mirror and glowing box change their size too.
fn stretching() -> Scene {
    let mut scene = Scene { name: "stretching".to_owned(), ..busy() };
    for (node, to) in [(0, [0.6, 1.5, 1.0]), (2, [1.4, 0.5, 1.2])] {
        let grown = channel(Property::Scale, Interpolation::Linear, &[0.0, 1.0], &[[1.0; 3], to].concat());
        scene.clips[0].channels.push(octolume::scene::Channel { node, ..grown });
    }
    scene
}

/// A mirror that slides, a floor, a glowing box, a box that bends, two lamps of which one flies.
fn busy() -> Scene {
    let mut scene = Scene { name: "busy".to_owned(), ..Scene::default() };
    let material = |material: Material| Material { ..material };
    scene.materials = vec![
        material(Material { roughness: 0.1, metallic: 1.0, ..Material::default() }),
        material(Material { roughness: 1.0, metallic: 0.0, base_color: [0.2, 0.7, 0.4, 1.0], ..Material::default() }),
        material(Material { emissive: [5.0, 2.0, 0.5], ..Material::default() }),
    ];
    for material in 0..3 {
        let primitive = octolume::scene::Primitive { material: Some(material), ..cube() };
        scene.meshes.push(Mesh { name: "cube".to_owned(), primitives: vec![primitive] });
    }
    let mut bent = cube();
    (bent.joints, bent.weights) =
        (vec![[0, 1, 0, 0]; 8], (0..8).map(|i| [i as f32 / 7.0, 1.0 - i as f32 / 7.0, 0.0, 0.0]).collect());
    scene.meshes.push(Mesh { name: "bent".to_owned(), primitives: vec![bent] });
    scene.lights = vec![
        Light { name: "sun".to_owned(), kind: LightKind::Directional, color: [1.0, 0.9, 0.8], intensity: 3.0 },
        Light { name: "lamp".to_owned(), kind: LightKind::Point { range: None }, color: [1.0; 3], intensity: 20.0 },
    ];
    scene.nodes = vec![
        Node { mesh: Some(0), ..node(None, at(0.0, 1.5, 0.0)) },
        Node { mesh: Some(1), ..node(None, scaled(4.0, 0.2, 4.0)) },
        Node { mesh: Some(2), ..node(None, at(2.5, 1.0, -1.0)) },
        Node { mesh: Some(3), skin: Some(0), ..node(None, at(0.0, 0.0, 0.0)) },
        node(None, at(-2.0, 1.5, 1.0)),
        node(Some(4), at(0.0, 1.0, 0.0)),
        Node {
            light: Some(0),
            ..node(None, octolume::scene::Trs { rotation: DQuat::from_rotation_x(-1.2), ..at(0.0, 5.0, 0.0) })
        },
        Node { light: Some(1), ..node(None, at(1.0, 4.0, 2.0)) },
    ];
    scene.skins = vec![Skin {
        name: "skin".to_owned(),
        joints: vec![4, 5],
        inverse_bind: vec![DMat4::from_translation(DVec3::new(0.1, 0.0, 0.0)); 2],
    }];
    let of = |node: usize, channel: octolume::scene::Channel| octolume::scene::Channel { node, ..channel };
    let slide = |to: [f64; 3]| {
        channel(Property::Translation, Interpolation::Linear, &[0.0, 1.0], &[[0.0, 1.5, 0.0], to].concat())
    };
    let turn = rotation(Interpolation::Linear, &[DQuat::IDENTITY, DQuat::from_rotation_z(1.0)]);
    let move_all = vec![of(0, slide([2.0, 2.0, 1.0])), of(5, turn.clone()), of(7, slide([-2.0, 4.0, -2.0]))];
    let mut bend_alone = clip(vec![of(5, turn)]);
    bend_alone.name = "bend".to_owned();
    scene.clips = vec![clip(move_all), bend_alone];
    scene
}
