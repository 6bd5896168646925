//! The node hierarchy, reordered so that parents come before children.

use glam::{DMat4, DQuat, DVec3, DVec4};
use gltf::json::{self, Root};

use super::{
    error::{Defect, counted},
    file_object::{FileObject, label},
};
use crate::scene::{LocalTransform, Node, Trs, Warning};

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

    /// The file's number of a node of the scene.
    pub fn file_node(&self, node: usize) -> usize {
        self.order[node]
    }

    /// All nodes; those outside the shown scene keep their transform (joints may be among them) but show nothing.
    /// `meshes` are by the file's nodes, the others by the file's cameras and lights.
    pub fn nodes(
        &self,
        root: &Root,
        shown_scene: Option<usize>,
        [meshes, cameras, lights]: [&[Option<usize>]; 3],
        warnings: &mut Vec<Warning>,
    ) -> Result<Vec<Node>, Defect> {
        let drawn = self.drawn(root, shown_scene);
        for (index, scene) in root.scenes.iter().enumerate() {
            for node in scene.nodes.iter().map(|node| node.value()).filter(|&node| self.parents[node].is_some()) {
                let scene = FileObject::item("scene", index, scene.name.as_deref());
                let cause = format!("node {node} is not a root of its tree, and is drawn with what is below it");
                warnings.push(scene.warning(cause).at(self.rank[node]));
            }
        }
        let hidden = self.order.iter().filter(|&&node| !drawn[node] && root.nodes[node].mesh.is_some()).count();
        if hidden > 0 {
            let left_out = counted(hidden, "node with a mesh is", "nodes with a mesh are");
            warnings.push(Warning::new(format!("{left_out} not in the scene that is shown")));
        }
        self.order
            .iter()
            .map(|&index| {
                let node = &root.nodes[index];
                let object = || FileObject::item("node", index, node.name.as_deref());
                let local = local_transform(node, &object, warnings)?;
                let shown = drawn[index];
                let joints = node.skin.iter().flat_map(|skin| &root.skins[skin.value()].joints);
                if shown && joints.clone().any(|joint| !drawn[joint.value()]) {
                    warnings.push(object().warning("joints of its skin are not in the scene that is shown"));
                }
                Ok(Node {
                    name: node.name.clone().unwrap_or_else(|| format!("node {index}")),
                    parent: self.parents[index].map(|parent| self.rank[parent]),
                    local,
                    mesh: meshes[index].filter(|_| shown),
                    skin: node.skin.filter(|_| shown && node.mesh.is_some()).map(|skin| skin.value()),
                    camera: node.camera.filter(|_| shown).and_then(|camera| cameras[camera.value()]),
                    is_visible: is_visible(node),
                    light: light_of(node).filter(|_| shown).and_then(|light| lights.get(light).copied().flatten()),
                })
            })
            .collect()
    }

    /// By file order: is the node part of the scene? Without scenes, everything is shown.
    fn drawn(&self, root: &Root, scene: Option<usize>) -> Vec<bool> {
        let Some(scene) = scene.and_then(|scene| root.scenes.get(scene)) else { return vec![true; root.nodes.len()] };
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
    object: &dyn Fn() -> FileObject,
    warnings: &mut Vec<Warning>,
) -> Result<LocalTransform, Defect> {
    let local = match &node.matrix {
        Some(columns) => LocalTransform::Matrix(affine(&columns.map(f64::from), object, warnings)),
        None => {
            let [x, y, z, w] = node.rotation.unwrap_or_default().0.map(f64::from);
            LocalTransform::Trs(Trs {
                translation: DVec3::from_array(node.translation.unwrap_or([0.0; 3]).map(f64::from)),
                rotation: rotation([x, y, z, w], object, warnings),
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

/// Extension of nodes, and where an animation keeps the channels that change it.
pub(super) const VISIBILITY: &str = "KHR_node_visibility";

/// Quaternions of normalised bytes are this far from unit length.
pub(super) const UNIT_TOLERANCE: f64 = 0.01;

/// A node's own rotation; one that is none turns nothing.
fn rotation(xyzw: [f64; 4], object: &dyn Fn() -> FileObject, warnings: &mut Vec<Warning>) -> DQuat {
    let length = DQuat::from_array(xyzw).length();
    let unit = unit_quaternion(xyzw);
    if unit.is_none() {
        warnings.push(object().warning("its rotation is zero or not finite; it is not turned"));
    } else if (length - 1.0).abs() > UNIT_TOLERANCE {
        warnings.push(
            object().warning(format!("its rotation is no unit quaternion (length {length:.3}); it is normalised")),
        );
    }
    unit.unwrap_or(DQuat::IDENTITY)
}

/// Files store 32-bit quaternions; without this their length would leak into the scale.
pub(super) fn unit_quaternion(xyzw: [f64; 4]) -> Option<DQuat> {
    let unit = DQuat::from_array(xyzw).normalize();
    unit.is_finite().then_some(unit)
}

/// Column-major; a fourth row other than (0, 0, 0, 1) has no meaning in glTF.
pub(super) fn affine(columns: &[f64; 16], object: &dyn Fn() -> FileObject, warnings: &mut Vec<Warning>) -> DMat4 {
    let mut matrix = DMat4::from_cols_array(columns);
    if matrix.row(3) != DVec4::W {
        warnings.push(object().warning("the fourth row of its matrix is not (0, 0, 0, 1) and is ignored"));
        matrix = DMat4::from_cols_array_2d(&std::array::from_fn(|column| {
            let [x, y, z, _] = matrix.col(column).to_array();
            [x, y, z, if column == 3 { 1.0 } else { 0.0 }]
        }));
    }
    matrix
}

/// KHR_node_visibility.
fn is_visible(node: &json::Node) -> bool {
    let declared = node.extensions.as_ref().and_then(|extensions| extensions.others.get(VISIBILITY)?.get("visible"));
    declared.and_then(serde_json::Value::as_bool).unwrap_or(true)
}

pub(super) fn light_of(node: &json::Node) -> Option<usize> {
    Some(node.extensions.as_ref()?.khr_lights_punctual.as_ref()?.light.value())
}
