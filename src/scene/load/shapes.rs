//! The meshes that nodes show: each mesh of the file at its own morph weights, and once more for
//! every node that gives it others. Static weights are baked.

use std::collections::HashMap;

use gltf::json::Root;
use rayon::prelude::*;

use super::{
    error::{Defect, counted},
    mesh,
    source::Source,
};
use crate::scene::Warning;
use crate::{progress::Progress, scene::Mesh};

/// All meshes, and for each node of the file which one it shows.
pub(super) struct Shapes {
    pub meshes: Vec<Mesh>,
    pub by_node: Vec<Option<usize>>,
}

/// A mesh of the file at some weights.
struct Shape<'a> {
    mesh: usize,
    weights: &'a [f32],
}

impl Shapes {
    pub fn load(source: &Source, progress: &Progress, warnings: &mut Vec<Warning>) -> Result<Self, Defect> {
        let (shapes, by_node) = list(&source.root);
        progress.add_total(shapes.len() as u64);
        let results: Vec<Result<mesh::Loaded, Defect>> = (shapes.par_iter())
            .map(|shape| {
                let loaded = mesh::load(source, shape.mesh, shape.weights)?;
                progress.advance(1)?;
                Ok(loaded)
            })
            .collect();
        let mut meshes = Vec::with_capacity(results.len());
        let mut without_surface = 0;
        for (index, loaded) in results.into_iter().enumerate() {
            let loaded = loaded?;
            meshes.push(loaded.mesh);
            // A mesh at other weights has nothing new to say.
            if index < source.root.meshes.len() {
                without_surface += loaded.without_surface;
                warnings.extend(loaded.warnings);
            }
        }
        if without_surface > 0 {
            let left_out = counted(without_surface, "primitive", "primitives");
            warnings.push(Warning::new(format!("{left_out} left out: points and lines have no surface")));
        }
        Ok(Self { meshes, by_node })
    }
}

/// Shape n is mesh n at its own weights, for all meshes of the file; the others follow.
fn list(root: &Root) -> (Vec<Shape<'_>>, Vec<Option<usize>>) {
    let own = |mesh: usize| root.meshes[mesh].weights.as_deref().unwrap_or_default();
    let mut shapes: Vec<Shape> = (0..root.meshes.len()).map(|mesh| Shape { mesh, weights: own(mesh) }).collect();
    let mut others: HashMap<(usize, Vec<u32>), usize> = HashMap::new();
    let by_node = root.nodes.iter().map(|node| {
        let mesh = node.mesh?.value();
        let weights = node.weights.as_deref().unwrap_or(own(mesh));
        if weights == own(mesh) {
            return Some(mesh);
        }
        let key = (mesh, weights.iter().map(|weight| weight.to_bits()).collect());
        Some(*others.entry(key).or_insert_with(|| {
            shapes.push(Shape { mesh, weights });
            shapes.len() - 1
        }))
    });
    let by_node = by_node.collect();
    (shapes, by_node)
}
