//! The node hierarchy, reordered so that parents come before children; cameras and lights.

use glam::{DMat4, DQuat, DVec3, DVec4};
use gltf::json::{self, Root, camera::Type as CameraType, validation::Checked};

use super::error::{Defect, counted, label};
use crate::scene::{Light, LightKind, LocalTransform, Node, Projection, SceneCamera, Trs};

/// Where each node of the file ends up.
pub(super) struct Hierarchy {
    /// Scene order to file order.
    order: Vec<usize>,
    /// File order to scene order.
    pub rank: Vec<usize>,
    /// By file order.
    parents: Vec<Option<usize>>,
}

impl Hierarchy {
    /// Depth first, in the file's order; a node reached twice or never has no place in a forest.
    pub fn new(root: &Root) -> Result<Self, Defect> {
        let name = |node: usize| label("node", node, root.nodes[node].name.as_deref());
        let mut parents = vec![None; root.nodes.len()];
        for (parent, node) in root.nodes.iter().enumerate() {
            for child in node.children.iter().flatten().map(|child| child.value()) {
                if let Some(other) = parents[child].replace(parent) {
                    let cause = format!("is a child of {} and of {}", name(other), name(parent));
                    return Err(Defect::new(name(child), cause));
                }
            }
        }
        let mut order = Vec::with_capacity(root.nodes.len());
        let mut rank = vec![usize::MAX; root.nodes.len()];
        let mut stack: Vec<usize> = (0..root.nodes.len()).rev().filter(|&node| parents[node].is_none()).collect();
        while let Some(node) = stack.pop() {
            rank[node] = order.len();
            order.push(node);
            stack.extend(root.nodes[node].children.iter().flatten().rev().map(|child| child.value()));
        }
        match rank.iter().position(|&rank| rank == usize::MAX) {
            Some(node) => Err(Defect::new(name(node), "is its own ancestor")),
            None => Ok(Self { order, rank, parents }),
        }
    }

    /// All nodes; those outside the drawn scene keep their transform (joints may be among them) but show nothing.
    pub fn nodes(
        &self,
        root: &Root,
        cameras: &[Option<usize>],
        warnings: &mut Vec<String>,
    ) -> Result<Vec<Node>, Defect> {
        let drawn = self.drawn(root);
        let hidden = self.order.iter().filter(|&&node| !drawn[node] && root.nodes[node].mesh.is_some()).count();
        if hidden > 0 {
            let left_out = counted(hidden, "node with a mesh", "nodes with a mesh");
            warnings.push(format!("{left_out} left out: only the default scene is drawn"));
        }
        self.order
            .iter()
            .map(|&index| {
                let node = &root.nodes[index];
                let object = || label("node", index, node.name.as_deref());
                let local = local_transform(node, &object, warnings)?;
                let shown = drawn[index];
                Ok(Node {
                    name: node.name.clone().unwrap_or_else(|| format!("node {index}")),
                    parent: self.parents[index].map(|parent| self.rank[parent]),
                    local,
                    mesh: node.mesh.filter(|_| shown).map(|mesh| mesh.value()),
                    skin: node.skin.filter(|_| shown && node.mesh.is_some()).map(|skin| skin.value()),
                    camera: node.camera.filter(|_| shown).and_then(|camera| cameras[camera.value()]),
                    light: light_of(node).filter(|_| shown),
                })
            })
            .collect()
    }

    /// By file order: is the node part of the default scene (else the first, else everything)?
    fn drawn(&self, root: &Root) -> Vec<bool> {
        let scene = root.scene.map_or(0, |scene| scene.value());
        let Some(scene) = root.scenes.get(scene) else { return vec![true; root.nodes.len()] };
        let mut drawn = vec![false; root.nodes.len()];
        for node in &scene.nodes {
            drawn[node.value()] = true;
        }
        for &node in &self.order {
            drawn[node] |= self.parents[node].is_some_and(|parent| drawn[parent]);
        }
        drawn
    }
}

fn local_transform(
    node: &json::Node,
    object: &dyn Fn() -> String,
    warnings: &mut Vec<String>,
) -> Result<LocalTransform, Defect> {
    let local = match &node.matrix {
        Some(columns) => LocalTransform::Matrix(affine(&columns.map(f64::from), object, warnings)),
        None => {
            let [x, y, z, w] = node.rotation.unwrap_or_default().0.map(f64::from);
            LocalTransform::Trs(Trs {
                translation: DVec3::from_array(node.translation.unwrap_or([0.0; 3]).map(f64::from)),
                rotation: unit_quaternion([x, y, z, w])
                    .ok_or_else(|| Defect::new(object(), "has a rotation that is zero or not finite"))?,
                scale: DVec3::from_array(node.scale.unwrap_or([1.0; 3]).map(f64::from)),
            })
        }
    };
    if local.matrix().is_finite() {
        Ok(local)
    } else {
        Err(Defect::new(object(), "has a transform that is not finite"))
    }
}

/// Files store 32-bit quaternions; without this their length would leak into the scale.
pub(super) fn unit_quaternion(xyzw: [f64; 4]) -> Option<DQuat> {
    let unit = DQuat::from_array(xyzw).normalize();
    unit.is_finite().then_some(unit)
}

/// Column-major; a fourth row other than (0, 0, 0, 1) has no meaning in glTF.
pub(super) fn affine(columns: &[f64; 16], object: &dyn Fn() -> String, warnings: &mut Vec<String>) -> DMat4 {
    let mut matrix = DMat4::from_cols_array(columns);
    if matrix.row(3) != DVec4::W {
        warnings.push(format!("{}: the fourth row of its matrix is not (0, 0, 0, 1) and is ignored", object()));
        matrix = DMat4::from_cols_array_2d(&std::array::from_fn(|column| {
            let [x, y, z, _] = matrix.col(column).to_array();
            [x, y, z, if column == 3 { 1.0 } else { 0.0 }]
        }));
    }
    matrix
}

/// The cameras that make sense, and for each of the file where it went.
pub(super) fn cameras(root: &Root, warnings: &mut Vec<String>) -> (Vec<SceneCamera>, Vec<Option<usize>>) {
    let mut cameras = Vec::new();
    let places = root.cameras.iter().enumerate().map(|(index, camera)| match projection(camera) {
        Some(projection) => {
            let name = camera.name.clone().unwrap_or_else(|| format!("camera {index}"));
            cameras.push(SceneCamera { name, projection });
            Some(cameras.len() - 1)
        }
        None => {
            let object = label("camera", index, camera.name.as_deref());
            warnings.push(format!("{object}: its projection makes no sense; it is left out"));
            None
        }
    });
    let places = places.collect();
    (cameras, places)
}

fn projection(camera: &json::Camera) -> Option<Projection> {
    let positive = |value: f32| (value.is_finite() && value > 0.0).then_some(f64::from(value));
    match camera.type_ {
        Checked::Valid(CameraType::Perspective) => {
            let lens = camera.perspective.as_ref()?;
            let far = match lens.zfar {
                Some(far) => Some(positive(far).filter(|_| far > lens.znear)?),
                None => None,
            };
            let fov_y_radians = positive(lens.yfov).filter(|&fov| fov < std::f64::consts::PI)?;
            Some(Projection::Perspective { fov_y_radians, near: positive(lens.znear)?, far })
        }
        Checked::Valid(CameraType::Orthographic) => {
            let lens = camera.orthographic.as_ref()?;
            let near = Some(f64::from(lens.znear)).filter(|&near| near >= 0.0)?;
            let far = positive(lens.zfar).filter(|&far| far > near)?;
            // Negative magnifications are discouraged, not forbidden; they mirror the image.
            let (half_width, half_height) = (positive(lens.xmag.abs())?, positive(lens.ymag.abs())?);
            Some(Projection::Orthographic { half_width, half_height, near, far })
        }
        Checked::Invalid => None,
    }
}

fn light_of(node: &json::Node) -> Option<usize> {
    Some(node.extensions.as_ref()?.khr_lights_punctual.as_ref()?.light.value())
}

/// KHR_lights_punctual.
pub(super) fn lights(root: &Root) -> Result<Vec<Light>, Defect> {
    use json::extensions::scene::khr_lights_punctual::Type;
    let declared = root.extensions.as_ref().and_then(|extensions| extensions.khr_lights_punctual.as_ref());
    let mut lights = Vec::new();
    for (index, light) in declared.iter().flat_map(|lights| &lights.lights).enumerate() {
        let object = || label("light", index, light.name.as_deref());
        let range = light.range;
        let kind = match (&light.type_, &light.spot) {
            (Checked::Valid(Type::Directional), _) => LightKind::Directional,
            (Checked::Valid(Type::Point), _) => LightKind::Point { range },
            (Checked::Valid(Type::Spot), Some(spot)) => LightKind::Spot {
                range,
                inner_cone_radians: spot.inner_cone_angle,
                outer_cone_radians: spot.outer_cone_angle,
            },
            (Checked::Valid(Type::Spot), None) => return Err(Defect::new(object(), "is a spot light without a cone")),
            (Checked::Invalid, _) => return Err(Defect::new(object(), "is of an unknown type")),
        };
        if !light.intensity.is_finite() || !light.color.iter().all(|channel| channel.is_finite()) {
            return Err(Defect::new(object(), "has a colour or intensity that is not finite"));
        }
        let name = light.name.clone().unwrap_or_else(|| format!("light {index}"));
        lights.push(Light { name, kind, color: light.color, intensity: light.intensity });
    }
    Ok(lights)
}

/// Lights are checked by index here: the validator does not always see the extension.
pub(super) fn check_lights(nodes: &[Node], lights: usize) -> Result<(), Defect> {
    match nodes.iter().enumerate().find(|(_, node)| node.light.is_some_and(|light| light >= lights)) {
        Some((index, node)) => {
            Err(Defect::new(label("node", index, Some(&node.name)), "names a light that does not exist"))
        }
        None => Ok(()),
    }
}
