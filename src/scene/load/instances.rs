//! EXT_mesh_gpu_instancing: each instance of a node's mesh becomes a node of its own below it.

use glam::{DQuat, DVec3};
use gltf::json::{Index, Node as FileNode, accessor::Accessor};
use serde_json::Value;

use super::{
    error::{About, Defect, counted},
    file_object::FileObject,
    nodes::unit_quaternion,
    source::Source,
};
use crate::scene::{LocalTransform, Node, Trs, Warning};

const EXTENSION: &str = "EXT_mesh_gpu_instancing";

/// Adds the instances of every node that has them; `rank` leads from the file's nodes to ours.
pub(super) fn expand(
    source: &Source,
    rank: &[usize],
    nodes: &mut Vec<Node>,
    warnings: &mut Vec<Warning>,
) -> Result<(), Defect> {
    for (index, file_node) in source.root.nodes.iter().enumerate() {
        let place = rank[index];
        let Some(attributes) = declared(file_node) else { continue };
        let object = || FileObject::item("node", index, file_node.name.as_deref()).member(EXTENSION);
        if nodes[place].skin.is_some() {
            warnings.push(object().warning("it is ignored, for a skinned mesh stands where its joints are"));
            continue;
        }
        let Some(mesh) = nodes[place].mesh.take() else { continue };
        let (transforms, unturned) = read(source, attributes).about(object)?;
        if unturned > 0 {
            let count = counted(unturned, "instance", "instances");
            warnings
                .push(object().warning(format!("{count} with a rotation that is zero or not finite are not turned")));
        }
        source.budget.spend_on(transforms.len(), size_of::<Node>()).about(object)?;
        let name = nodes[place].name.clone();
        nodes.extend(transforms.into_iter().enumerate().map(|(number, trs)| Node {
            name: format!("{name} #{number}"),
            parent: Some(place),
            local: LocalTransform::Trs(trs),
            mesh: Some(mesh),
            skin: None,
            camera: None,
            light: None,
            is_visible: true,
        }));
    }
    Ok(())
}

fn declared(node: &FileNode) -> Option<&Value> {
    node.extensions.as_ref()?.others.get(EXTENSION)?.get("attributes")
}

/// The transforms, and how many of them lack a rotation that is one.
fn read(source: &Source, attributes: &Value) -> Result<(Vec<Trs>, usize), String> {
    let translations = rows::<3>(source, attributes, "TRANSLATION")?;
    let rotations = rows::<4>(source, attributes, "ROTATION")?;
    let scales = rows::<3>(source, attributes, "SCALE")?;
    let counts = [translations.as_ref().map(Vec::len), rotations.as_ref().map(Vec::len), scales.as_ref().map(Vec::len)];
    let count = counts.into_iter().flatten().next().unwrap_or(0);
    if counts.into_iter().flatten().any(|other| other != count) {
        return Err("has attributes of different lengths".to_owned());
    }
    let vector = |rows: &Option<Vec<[f32; 3]>>, instance: usize, default: DVec3| {
        rows.as_ref().map_or(default, |rows| DVec3::from_array(rows[instance].map(f64::from)))
    };
    let mut unturned = 0;
    let transforms: Result<Vec<Trs>, String> = (0..count)
        .map(|instance| {
            let rotation = match &rotations {
                // What is no rotation turns nothing.
                Some(rows) => unit_quaternion(rows[instance].map(f64::from)).unwrap_or_else(|| {
                    unturned += 1;
                    DQuat::IDENTITY
                }),
                None => DQuat::IDENTITY,
            };
            let translation = vector(&translations, instance, DVec3::ZERO);
            let trs = Trs { translation, rotation, scale: vector(&scales, instance, DVec3::ONE) };
            match trs.matrix().is_finite() {
                true => Ok(trs),
                false => Err(format!("has a transform at instance {instance} that is not finite")),
            }
        })
        .collect();
    Ok((transforms?, unturned))
}

fn rows<const N: usize>(source: &Source, attributes: &Value, name: &str) -> Result<Option<Vec<[f32; N]>>, String> {
    let Some(index) = attributes.get(name) else { return Ok(None) };
    let index = index.as_u64().and_then(|index| u32::try_from(index).ok());
    let index: Index<Accessor> = Index::new(index.ok_or_else(|| format!("has a {name} that is no accessor"))?);
    let elements = source.elements(index)?;
    elements.floats(0..elements.count).map(Some)
}
