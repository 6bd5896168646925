//! Which nodes of the scene the warnings about parts of the file concern.

use gltf::json::{Node, Root};

use super::nodes::light_of;
use crate::scene::{FilePart, Warning};

/// Finds the nodes of each warning that names a part and no node yet; `rank` leads from the file's nodes to the
/// scene's.
pub(super) fn find(warnings: &mut [Warning], root: &Root, rank: &[usize]) {
    for warning in warnings.iter_mut().filter(|warning| warning.nodes.is_empty()) {
        let Some(part) = warning.part else { continue };
        let concerned = root.nodes.iter().enumerate().filter(|&(index, node)| concerns(root, part, index, node));
        warning.nodes = concerned.map(|(index, _)| rank[index]).collect();
        warning.nodes.sort_unstable();
    }
}

/// Is the part the node, or something that the node shows, carries or follows?
fn concerns(root: &Root, FilePart { kind, index: part }: FilePart, index: usize, node: &Node) -> bool {
    let mesh = node.mesh.map(|mesh| mesh.value());
    match kind {
        "node" => index == part,
        "mesh" => mesh == Some(part),
        "skin" => node.skin.is_some_and(|skin| skin.value() == part),
        "camera" => node.camera.is_some_and(|camera| camera.value() == part),
        "light" => light_of(node) == Some(part),
        "material" => mesh.is_some_and(|mesh| {
            let mut primitives = root.meshes[mesh].primitives.iter();
            primitives.any(|primitive| primitive.material.is_some_and(|material| material.value() == part))
        }),
        _ => false,
    }
}
