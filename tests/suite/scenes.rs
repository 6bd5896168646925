//! Small scenes for tests, made in memory.

use glam::{DMat4, DQuat, DVec3, Vec3};
use octolume::scene::{
    Channel, Clip, Interpolation, LocalTransform, Mesh, Node, Pose, Primitive, Property, Scene, Skin, Trs,
};

pub fn channel(property: Property, interpolation: Interpolation, times_secs: &[f64], values: &[f64]) -> Channel {
    Channel { node: 0, property, interpolation, times_secs: times_secs.to_vec(), values: values.to_vec() }
}

pub fn node(parent: Option<usize>, trs: Trs) -> Node {
    Node {
        name: "node".to_owned(),
        parent,
        local: LocalTransform::Trs(trs),
        mesh: None,
        skin: None,
        camera: None,
        light: None,
        is_visible: true,
    }
}

pub fn at(x: f64, y: f64, z: f64) -> Trs {
    Trs { translation: DVec3::new(x, y, z), ..Trs::default() }
}

pub fn scaled(x: f64, y: f64, z: f64) -> Trs {
    Trs { scale: DVec3::new(x, y, z), ..Trs::default() }
}

pub fn clip(channels: Vec<Channel>) -> Clip {
    let duration_secs = channels.iter().flat_map(|channel| &channel.times_secs).copied().fold(0.0, f64::max);
    Clip { name: "clip".to_owned(), duration_secs, channels }
}

/// The corners of the cube from −1 to 1 as two triangles each of no particular sense.
pub fn cube() -> Primitive {
    let corners =
        (0..8).map(|corner| Vec3::from_array([0, 1, 2].map(|axis| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 })));
    Primitive {
        positions: corners.collect(),
        normals: vec![Vec3::Z; 8],
        triangles: vec![[0, 1, 2], [5, 6, 7]],
        ..Primitive::default()
    }
}

/// A cube on node 0.
pub fn cube_scene(trs: Trs) -> Scene {
    let mut scene = Scene::default();
    scene.meshes.push(Mesh { name: "cube".to_owned(), primitives: vec![cube()] });
    scene.nodes.push(Node { mesh: Some(0), ..node(None, trs) });
    scene
}

/// A cube on node 0 whose vertices follow `joints[i]` with `weights[i]`; joint k is node k + 1.
pub fn skinned_scene(joints: [u16; 4], weights: [f32; 4], poses: &[Trs], inverse_bind: &[DMat4]) -> Scene {
    let mut scene = cube_scene(Trs::default());
    let primitive = &mut scene.meshes[0].primitives[0];
    primitive.joints = vec![joints; 8];
    primitive.weights = vec![weights; 8];
    scene.nodes[0].skin = Some(0);
    scene.nodes.extend(poses.iter().map(|&trs| node(None, trs)));
    let joints = (1..=poses.len()).collect();
    scene.skins.push(Skin { name: "skin".to_owned(), joints, inverse_bind: inverse_bind.to_vec() });
    scene
}

pub fn positions(scene: &Scene, pose: &Pose) -> Vec<DVec3> {
    scene.posed_positions(&scene.objects()[0], 0, pose)
}

pub fn rotation(interpolation: Interpolation, keys: &[DQuat]) -> Channel {
    let times: Vec<f64> = (0..keys.len()).map(|key| key as f64).collect();
    let values: Vec<f64> = keys.iter().flat_map(|key| key.to_array()).collect();
    channel(Property::Rotation, interpolation, &times, &values)
}

pub fn sliding_scene() -> Scene {
    let mut scene = cube_scene(Trs::default());
    let slide = channel(
        Property::Translation,
        Interpolation::Linear,
        &[0.0, 0.3, 1.7],
        &[0.0, 0.0, 0.0, 1.0, 2.0, 3.0, -1.0, 5.0, 0.1],
    );
    let turn = rotation(Interpolation::Linear, &[DQuat::IDENTITY, DQuat::from_rotation_y(2.0)]);
    scene.clips.push(clip(vec![slide, turn]));
    scene
}
