//! One node of the octree, its pointers as links that lead to the nodes they point to.

use egui::{Button, Grid, Link, RichText, Role, Ui, WidgetInfo};

use super::{fact, grouped, nothing};
use crate::app::command::Command;
use crate::app::inspector::{Inspector, Pin};
use crate::app::numbers::{fixed, short};
use crate::app::palette::Tone;
use crate::engine::{NodeAddress, NodeFacts, StoredNode};
use crate::settings::Look;

/// Why there is no value: what is said instead, and its tip.
#[derive(Clone, Copy)]
struct Absent(&'static str, &'static str);

const NONE: Absent = Absent("none", "Nothing is there.");
const NO_POINTERS: Absent = Absent("not stored", "\"Draw pointers\" stores it.");
const NO_LIGHT: Absent = Absent("not stored", "Light is stored while it is shown.");

pub fn ui(ui: &mut Ui, inspector: &Inspector, look: &Look) -> Vec<Command> {
    let mut commands = Vec::new();
    ui.horizontal(|ui| {
        let mut look = *look;
        let tip = "Stores the octree's forward pointers, and draws those of this node over the picture: x red, y \
                   green, z blue, dummies dashed and hollow, and the eight nodes that interpolation reads.";
        if ui.checkbox(&mut look.pointers, "Draw pointers").on_hover_text(tip).changed() {
            commands.push(Command::Look(look));
        }
        let back = ui.add_enabled(inspector.can_go_back(), Button::new("Back"));
        if back.on_hover_text("To the node looked at before.").clicked() {
            commands.push(Command::Pin(Pin::Back));
        }
        let release = ui.add_enabled(inspector.is_pinned(), Button::new("Release"));
        if release.on_hover_text("Follows the pointer again.").clicked() {
            commands.push(Command::Pin(Pin::Release));
        }
    });
    match (inspector.address(), inspector.facts()) {
        (None, _) => nothing(ui, "Point at the picture; Alt+click stays with a node."),
        (Some(address), None) => nothing(ui, &format!("{address}: not read yet.")),
        (Some(address), Some(None)) => nothing(ui, &format!("{address}: no node is stored, nothing is there.")),
        (Some(_), Some(Some(facts))) => commands.extend(facts_ui(ui, facts)),
    }
    commands
}

fn facts_ui(ui: &mut Ui, facts: &NodeFacts) -> Option<Command> {
    let mut chosen = None;
    let node = facts.node;
    Grid::new("one node").num_columns(2).spacing([10.0, 2.0]).show(ui, |ui| {
        let dummy = if node.is_dummy { ", a dummy" } else { "" };
        fact(
            ui,
            "Node",
            &format!("{}{dummy}", grouped(node.index.into())),
            "Among all stored nodes, dense levels first.",
        );
        fact(ui, "Place", &format!("{}, key {}", node.address, facts.key), "Cells of its level; the Morton key.");
        let block = match facts.block {
            Some(block) => format!("{}, child {}", grouped(block.into()), facts.key & 7),
            None => "none: a dense level".to_owned(),
        };
        fact(ui, "Block", &block, "Sparse nodes are stored in blocks of the eight children of a node.");
        payload_ui(ui, facts);
        let ahead_unless = if facts.has_pointers { NONE } else { NO_POINTERS };
        let mut link = |ui: &mut Ui, name, node: Option<StoredNode>, unless| {
            chosen = chosen.or(link_ui(ui, name, node, unless));
        };
        link(ui, "First child", facts.first_child, NONE);
        for (name, ahead) in ["Ahead x", "Ahead y", "Ahead z"].into_iter().zip(facts.forward) {
            link(ui, name, ahead, ahead_unless);
        }
        chosen = chosen.or(parent_ui(ui, node.address.parent()));
    });
    if !facts.has_pointers {
        nothing(ui, "Its forward pointers are not stored; \"Draw pointers\" stores them.");
    }
    chosen.map(|address| Command::Pin(Pin::To(address)))
}

fn payload_ui(ui: &mut Ui, facts: &NodeFacts) {
    if facts.node.is_dummy {
        return;
    }
    let vector = |values: [f64; 3]| values.map(|value| fixed(value, 3)).join("  ");
    fact(ui, "Occupancy", &format!("{:.6}", facts.occupancy), "The occupied share of its volume.");
    fact(ui, "Albedo", &vector(facts.albedo), "Linear red, green, blue: the mean of what is in it.");
    fact(ui, "Normal", &vector(facts.normal), "Mean: short where normals disagree.");
    match facts.radiance {
        Some(radiance) => {
            let text = format!("{} nits", radiance.map(short).join("  "));
            fact(ui, "Radiance", &text, "Linear red, green, blue of the light that leaves it.");
        }
        None => absent_ui(ui, "Radiance", NO_LIGHT),
    }
}

/// `unless`: said where there is no node to lead to.
fn link_ui(ui: &mut Ui, name: &str, node: Option<StoredNode>, unless: Absent) -> Option<NodeAddress> {
    let text = node.map(|node| {
        let [x, y, z] = node.address.cell;
        let dummy = if node.is_dummy { ", a dummy" } else { "" };
        format!("{} at {x},{y},{z}{dummy}", grouped(node.index.into()))
    });
    row_ui(ui, name, text, unless).then_some(node?.address)
}

fn parent_ui(ui: &mut Ui, parent: Option<NodeAddress>) -> Option<NodeAddress> {
    row_ui(ui, "Above", parent.map(|parent| parent.to_string()), NONE).then_some(parent?)
}

/// A name and a link; whether it was clicked.
fn row_ui(ui: &mut Ui, name: &str, text: Option<String>, unless: Absent) -> bool {
    let Some(text) = text else {
        absent_ui(ui, name, unless);
        return false;
    };
    ui.label(RichText::new(name).color(Tone::Weak.of(ui)));
    let link = ui.add(Link::new(text));
    link.widget_info(|| WidgetInfo::labeled(Role::Link, true, name));
    ui.end_row();
    link.on_hover_text("Looks at that node.").clicked()
}

/// A name without a value.
fn absent_ui(ui: &mut Ui, name: &str, Absent(text, tip): Absent) {
    ui.label(RichText::new(name).color(Tone::Weak.of(ui)));
    ui.label(RichText::new(text).color(Tone::Weak.of(ui))).on_hover_text(tip);
    ui.end_row();
}
