//! `octolume node`: one node of the octree, what it holds, and where its pointers lead.

use std::path::PathBuf;

use anyhow::anyhow;
use clap::Args;
use octolume::engine::{NodeAddress, NodeFacts, StoredNode};
use octolume::settings::{ColorBy, View};

use super::options::{Common, Moment};
use super::session::{NO_PICTURE, Session};
use super::usage::Usage;
use super::{output, values};

/// Says what is stored of one node of the octree, and follows its pointers
#[derive(Debug, Args)]
pub struct Node {
    /// A .gltf or .glb file, or the name of a built-in scene
    scene: PathBuf,
    /// Level of the node, 0 is the root; otherwise the leaves
    #[arg(long, value_name = "LEVEL")]
    level: Option<u32>,
    /// Its cell, of 2 to the level's power along an axis
    #[arg(long, value_name = "X,Y,Z", value_parser = values::cell)]
    cell: [u32; 3],
    /// Prints JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    moment: Moment,
    #[command(flatten)]
    common: Common,
}

impl Node {
    pub fn run(&self) -> anyhow::Result<()> {
        let mut settings = self.common.settings()?;
        self.moment.apply(&mut settings);
        let look = &mut settings.method.look;
        // Light is computed where it is looked at.
        (look.view, look.color, look.pointers) = (View::Voxels, ColorBy::Radiance, true);
        settings.check().map_err(Usage)?;
        let depth = settings.method.discretization.depth();
        let address = NodeAddress { level: self.level.unwrap_or(depth), cell: self.cell };
        check(address, depth)?;
        let mut session = Session::open(&self.scene, &self.common, &mut settings)?;
        session.run(&settings, NO_PICTURE)?;
        let name = &session.prepared.scene.name;
        let facts = session.engine.node_facts(address)?;
        let facts = facts.ok_or_else(|| anyhow!("{name}: no node is stored at {address}: nothing is there"))?;
        if self.json { output::json(&facts) } else { output::result(&text(&facts)) }
    }
}

fn check(address: NodeAddress, depth: u32) -> Result<(), Usage> {
    if address.level > depth {
        return Err(Usage(format!("level {} is not one of 0 (the root) to {depth} (the leaves)", address.level)));
    }
    if !address.is_in(depth) {
        let last = (1_u32 << address.level) - 1;
        return Err(Usage(format!("{address} is outside the grid: its cells are 0 to {last} along an axis")));
    }
    Ok(())
}

fn text(facts: &NodeFacts) -> String {
    let place = match facts.block {
        Some(block) => format!("child {} of block {block}", facts.key & 7),
        None => "on a dense level".to_owned(),
    };
    let mut lines = vec![format!("node {}, {place}, key {}", stored(&facts.node), facts.key)];
    if !facts.node.is_dummy {
        let [albedo, normal] = [facts.albedo, facts.normal].map(vector);
        lines.push(format!("occupancy {:.6}, albedo {albedo}, normal {normal}", facts.occupancy));
    }
    if let Some(radiance) = facts.radiance {
        lines.push(format!("radiance {} nits", vector(radiance)));
    }
    let pointer = |node: &Option<StoredNode>| node.as_ref().map_or("none".to_owned(), stored);
    lines.push(format!("first child: {}", pointer(&facts.first_child)));
    for (axis, node) in ["x", "y", "z"].iter().zip(&facts.forward) {
        lines.push(format!("ahead along {axis}: {}", pointer(node)));
    }
    lines.join("\n")
}

fn stored(node: &StoredNode) -> String {
    let dummy = if node.is_dummy { ", a dummy" } else { "" };
    format!("{} ({}{dummy})", node.index, node.address)
}

fn vector(values: [f64; 3]) -> String {
    values.map(|value| format!("{value:.4}")).join(",")
}
