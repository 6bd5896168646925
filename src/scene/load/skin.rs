//! Skins, and the check that meshes and skins fit together.

use glam::DMat4;
use gltf::json;

use super::{
    error::{About, Defect},
    file_object::FileObject,
    nodes::{Hierarchy, affine},
    source::Source,
};
use crate::scene::{Mesh, Node, Skin, Warning};

pub(super) fn load_all(source: &Source, rank: &[usize], warnings: &mut Vec<Warning>) -> Result<Vec<Skin>, Defect> {
    let skins = source.root.skins.iter().enumerate();
    skins.map(|(index, skin)| load(source, index, skin, rank, warnings)).collect()
}

fn load(
    source: &Source,
    index: usize,
    skin: &json::Skin,
    rank: &[usize],
    warnings: &mut Vec<Warning>,
) -> Result<Skin, Defect> {
    let object = || FileObject::item("skin", index, skin.name.as_deref());
    let joints: Vec<usize> = skin.joints.iter().map(|joint| rank[joint.value()]).collect();
    if joints.is_empty() {
        return Err(Defect::new(object(), "has no joints"));
    }
    let inverse_bind = match skin.inverse_bind_matrices {
        None => vec![DMat4::IDENTITY; joints.len()],
        Some(accessor) => {
            let elements = source.elements(accessor).about(object)?;
            if elements.count < joints.len() {
                let cause = format!("has {} inverse bind matrices for {} joints", elements.count, joints.len());
                return Err(Defect::new(object(), cause));
            }
            let columns: Vec<[f32; 16]> = elements
                .floats(0..joints.len())
                .map_err(|cause| format!("accessor {accessor} of its inverse bind matrices {cause}"))
                .about(object)?;
            columns.into_iter().map(|columns| affine(&columns.map(f64::from), &object, warnings)).collect()
        }
    };
    match inverse_bind.iter().position(|matrix| !matrix.is_finite()) {
        Some(joint) => Err(Defect::new(object(), format!("has an inverse bind matrix ({joint}) that is not finite"))),
        None => {
            let name = skin.name.clone().unwrap_or_else(|| format!("skin {index}"));
            Ok(Skin { name, joints, inverse_bind })
        }
    }
}

/// glTF wants the joints of a skin below one node; they pose as well without.
pub(super) fn check_roots(skins: &[Skin], nodes: &[Node], warnings: &mut Vec<Warning>) {
    let mut roots: Vec<usize> = Vec::with_capacity(nodes.len());
    for (index, node) in nodes.iter().enumerate() {
        roots.push(node.parent.map_or(index, |parent| roots[parent]));
    }
    for (index, skin) in skins.iter().enumerate() {
        if skin.joints.iter().any(|&joint| roots[joint] != roots[skin.joints[0]]) {
            warnings.push(FileObject::item("skin", index, Some(&skin.name)).warning("its joints have no common root"));
        }
    }
}

/// Refuses joints out of range; a skin without any weights, or weights without a skin, is undone
/// with a warning.
pub(super) fn bind(
    nodes: &mut [Node],
    meshes: &mut [Mesh],
    skins: &[Skin],
    hierarchy: &Hierarchy,
    warnings: &mut Vec<Warning>,
) -> Result<(), Defect> {
    for (index, node) in nodes.iter_mut().enumerate() {
        let (Some(mesh_index), Some(skin_index)) = (node.mesh, node.skin) else { continue };
        let (mesh, skin) = (&mut meshes[mesh_index], &skins[skin_index]);
        let object = FileObject::item("node", hierarchy.file_node(index), Some(&node.name));
        if mesh.primitives.iter().all(|primitive| primitive.joints.is_empty()) {
            warnings.push(
                object.warning("it has a skin, but its mesh has no joint weights; it moves as a whole").at(index),
            );
            node.skin = None;
            continue;
        }
        for (number, primitive) in mesh.primitives.iter_mut().enumerate() {
            let mesh_object = FileObject::item("mesh", mesh_index, Some(&mesh.name));
            let place = mesh_object.member(format_args!("primitive {number}"));
            if primitive.joints.is_empty() {
                warnings.push(place.warning("it has no joint weights in a skinned mesh; it follows joint 0").at(index));
                primitive.joints = vec![[0; 4]; primitive.positions.len()];
                primitive.weights = vec![[1.0, 0.0, 0.0, 0.0]; primitive.positions.len()];
            }
            let out_of_range = primitive.joints.iter().flatten().find(|&&joint| joint as usize >= skin.joints.len());
            if let Some(joint) = out_of_range {
                let cause = format!("joint {joint} is out of range: skin \"{}\" has {}", skin.name, skin.joints.len());
                return Err(Defect::new(place.member("JOINTS_0"), cause));
            }
        }
    }
    Ok(())
}
