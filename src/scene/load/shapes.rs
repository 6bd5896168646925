//! The meshes that nodes show: each mesh of the file at its own morph weights, and once more for
//! every node that gives it others, or whose weights a clip moves. Weights are baked; those that move keep what they
//! displace beside it.

use std::collections::{HashMap, HashSet};

use gltf::json::{Root, animation::Property, validation::Checked};
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
    /// A clip moves them: one node shows it.
    moves: bool,
}

impl Shapes {
    pub fn load(source: &Source, progress: &Progress, warnings: &mut Vec<Warning>) -> Result<Self, Defect> {
        let (shapes, by_node) = list(&source.root);
        progress.add_total(shapes.len() as u64);
        let results: Vec<Result<mesh::Loaded, Defect>> = (shapes.par_iter())
            .map(|shape| {
                let loaded = mesh::load(source, shape.mesh, (shape.weights, shape.moves))?;
                progress.advance(1)?;
                Ok(loaded)
            })
            .collect();
        let mut meshes = Vec::with_capacity(results.len());
        let (mut without_surface, mut of_others) = (0, Vec::new());
        for (index, loaded) in results.into_iter().enumerate() {
            let loaded = loaded?;
            meshes.push(loaded.mesh);
            if index < source.root.meshes.len() {
                without_surface += loaded.without_surface;
                warnings.extend(loaded.warnings);
            } else {
                of_others.extend(loaded.warnings);
            }
        }
        // A mesh at other weights has little new to say: what its targets do, where they move.
        let mut said: HashSet<Warning> = warnings.iter().cloned().collect();
        warnings.extend(of_others.into_iter().filter(|warning| said.insert(warning.clone())));
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
    let still = |mesh, weights| Shape { mesh, weights, moves: false };
    let mut shapes: Vec<Shape> = (0..root.meshes.len()).map(|mesh| still(mesh, own(mesh))).collect();
    let mut others: HashMap<(usize, Vec<u32>), usize> = HashMap::new();
    let morphing = morphing_nodes(root);
    let by_node = root.nodes.iter().enumerate().map(|(index, node)| {
        let mesh = node.mesh?.value();
        let weights = node.weights.as_deref().unwrap_or(own(mesh));
        if morphing.contains(&index) {
            shapes.push(Shape { moves: true, ..still(mesh, weights) });
            return Some(shapes.len() - 1);
        }
        if weights == own(mesh) {
            return Some(mesh);
        }
        let key = (mesh, weights.iter().map(|weight| weight.to_bits()).collect());
        Some(*others.entry(key).or_insert_with(|| {
            shapes.push(still(mesh, weights));
            shapes.len() - 1
        }))
    });
    let by_node = by_node.collect();
    (shapes, by_node)
}

/// Nodes of the file whose weights some clip moves.
fn morphing_nodes(root: &Root) -> HashSet<usize> {
    let channels = root.animations.iter().flat_map(|animation| &animation.channels);
    let moved = channels.filter(|channel| channel.target.path == Checked::Valid(Property::MorphTargetWeights));
    moved.map(|channel| channel.target.node.value()).collect()
}
