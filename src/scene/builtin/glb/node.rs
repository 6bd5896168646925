//! Nodes of a file, and what they carry: meshes, skins, a sun, a camera.

use glam::{DQuat, DVec3};
use gltf::json::extensions::scene::khr_lights_punctual;
use gltf::json::validation::Checked::Valid;
use gltf::json::{Camera, Index, Mesh, Node, Skin, camera, scene};

use super::{GlbWriter, float3, float4};
use crate::scene::Trs;

impl GlbWriter {
    /// Adds a node under `parent`, or at the top of the scene.
    pub fn node(&mut self, parent: Option<Index<Node>>, name: &str, place: Trs) -> Index<Node> {
        let index = self.root.push(Node { name: Some(name.into()), ..placed(place) });
        match parent {
            Some(parent) => self.root.nodes[parent.value()].children.get_or_insert_default().push(index),
            None => self.top_nodes.push(index),
        }
        index
    }

    /// Adds a node that shows a mesh.
    pub fn show(&mut self, parent: Option<Index<Node>>, name: &str, mesh: Index<Mesh>, place: Trs) -> Index<Node> {
        let index = self.node(parent, name, place);
        self.root.nodes[index.value()].mesh = Some(mesh);
        index
    }

    /// Binds the mesh that a node shows to a skin.
    pub fn bind_skin(&mut self, node: Index<Node>, skin: Index<Skin>) {
        self.root.nodes[node.value()].skin = Some(skin);
    }

    /// A skin whose joints were bound at the given points, unturned.
    pub fn skin(&mut self, name: &str, joints: &[Index<Node>], bind_points: &[DVec3]) -> Index<Skin> {
        let joint_from_mesh: Vec<[f32; 16]> = bind_points
            .iter()
            .map(|&point| {
                let [x, y, z] = float3(-point);
                [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, x, y, z, 1.0]
            })
            .collect();
        let matrices = self.floats(&joint_from_mesh, None, false);
        self.root.push(Skin {
            name: Some(name.into()),
            joints: joints.to_vec(),
            inverse_bind_matrices: Some(matrices),
            skeleton: joints.first().copied(),
            extensions: None,
            extras: None,
        })
    }

    /// A sun that shines along the node's −Z. `illuminance_lux` is KHR_lights_punctual's unit.
    pub fn sun(&mut self, name: &str, place: Trs, color: [f32; 3], illuminance_lux: f32) -> Index<Node> {
        let light = khr_lights_punctual::Light {
            color,
            intensity: illuminance_lux,
            name: Some(name.into()),
            range: None,
            spot: None,
            type_: Valid(khr_lights_punctual::Type::Directional),
            extensions: None,
            extras: None,
        };
        let lights = &mut self.root.extensions.get_or_insert_default().khr_lights_punctual;
        let light = Index::push(&mut lights.get_or_insert_default().lights, light);
        let node = self.node(None, name, place);
        let extensions = self.root.nodes[node.value()].extensions.get_or_insert_default();
        extensions.khr_lights_punctual = Some(khr_lights_punctual::KhrLightsPunctual { light });
        self.use_extension("KHR_lights_punctual");
        node
    }

    /// A camera that looks along the node's −Z.
    pub fn camera(&mut self, name: &str, place: Trs, fov_y_radians: f32) -> Index<Node> {
        let camera = self.root.push(Camera {
            name: Some(name.into()),
            orthographic: None,
            perspective: Some(camera::Perspective {
                aspect_ratio: None,
                yfov: fov_y_radians,
                zfar: Some(100.0),
                znear: 0.05,
                extensions: None,
                extras: None,
            }),
            type_: Valid(camera::Type::Perspective),
            extensions: None,
            extras: None,
        });
        let node = self.node(None, name, place);
        self.root.nodes[node.value()].camera = Some(camera);
        node
    }
}

/// A node's transform; what is the default is left out.
fn placed(place: Trs) -> Node {
    Node {
        translation: (place.translation != DVec3::ZERO).then(|| float3(place.translation)),
        rotation: (place.rotation != DQuat::IDENTITY).then(|| scene::UnitQuaternion(float4(place.rotation))),
        scale: (place.scale != DVec3::ONE).then(|| float3(place.scale)),
        ..Node::default()
    }
}
