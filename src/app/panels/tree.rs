//! The scene tree: every node of the file, what it carries, and whether it is shown. Only the rows on
//! screen are laid out, so ten thousand nodes cost a frame little more than ten.

use egui::{RichText, ScrollArea, TextEdit, Ui};
use egui_ltreeview::{Action, TreeView, TreeViewBuilder, TreeViewState};

use super::tree_row::{Offer, TreePanel, TreeRow, offers};
use super::{node_facts, nothing};
use crate::app::command::Command;
use crate::app::outline;
use crate::app::palette::Tone;
use crate::scene::Scene;

/// What a person has selected, searched and unfolded.
#[derive(Default)]
pub struct TreeState {
    pub selected: Option<usize>,
    search: String,
    /// The last search and the nodes it found; `None` where nothing is searched.
    found: Option<(String, Vec<usize>)>,
    unfolded: TreeViewState<usize>,
    unfolded_found: TreeViewState<usize>,
}

/// Space for the facts of the selected node below the tree.
const FACTS_HEIGHT: f32 = 290.0;

/// Of the widget that has the keyboard's focus while a person walks the tree.
pub fn focus_id() -> egui::Id {
    egui::Id::unique("scene tree")
}

impl TreeState {
    /// Selects a node and unfolds what it is folded into.
    pub fn select(&mut self, scene: &Scene, node: Option<usize>) {
        self.selected = node;
        let parent = |&node: &usize| scene.nodes.get(node)?.parent;
        for ancestor in std::iter::successors(node.as_ref().and_then(parent), parent) {
            self.unfolded.set_openness(ancestor, true);
        }
    }

    /// Looks up the nodes searched for, if the search has changed.
    fn find(&mut self, scene: &Scene) {
        if self.found.as_ref().is_none_or(|(search, _)| *search != self.search) {
            self.found = outline::found(scene, &self.search).map(|nodes| (self.search.clone(), nodes));
        }
    }
}

pub fn ui(ui: &mut Ui, panel: TreePanel<'_>, state: &mut TreeState) -> Vec<Command> {
    let mut commands = Vec::new();
    // Nodes that the scene does not have were refused when it was opened.
    let shown = panel.visibility.shown_nodes(&panel.prepared.scene).unwrap_or_default();
    egui::Panel::bottom("node facts").default_size(FACTS_HEIGHT).size_range(120.0..=700.0).resizable(true).show(
        ui,
        |ui| {
            commands.extend(buttons_ui(ui, panel, &shown, state.selected));
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| match state.selected {
                Some(node) => node_facts::ui(ui, panel, node),
                None => nothing(ui, "No node is selected."),
            });
        },
    );
    egui::CentralPanel::no_frame().show(ui, |ui| {
        ui.horizontal(|ui| {
            let name = ui.label(RichText::new("Find").color(Tone::Weak.of(ui)));
            let field =
                TextEdit::singleline(&mut state.search).hint_text("part of a name").desired_width(f32::INFINITY);
            ui.add(field).labelled_by(name.id).on_hover_text("Lists the nodes whose names hold this.");
        });
        commands.extend(rows_ui(ui, panel, &shown, state));
    });
    commands
}

fn buttons_ui(ui: &mut Ui, panel: TreePanel<'_>, shown: &[bool], selected: Option<usize>) -> Vec<Command> {
    let mut commands = Vec::new();
    ui.add_space(3.0);
    ui.horizontal(|ui| {
        let is_shown = selected.is_none_or(|node| shown.get(node).copied().unwrap_or(true));
        for Offer { enabled, name, tip, command } in offers(panel, selected, is_shown) {
            if ui.add_enabled(enabled, egui::Button::new(name)).on_hover_text(tip).clicked() {
                commands.push(command);
            }
        }
    });
    ui.separator();
    commands
}

fn rows_ui(ui: &mut Ui, panel: TreePanel<'_>, shown: &[bool], state: &mut TreeState) -> Vec<Command> {
    let scene = &panel.prepared.scene;
    state.find(scene);
    let found = state.found.as_ref().map(|(_, nodes)| nodes);
    if scene.nodes.is_empty() || found.is_some_and(Vec::is_empty) {
        nothing(ui, if found.is_some() { "No node is called like this." } else { "The file holds no nodes." });
        return Vec::new();
    }
    let view = if found.is_some() { &mut state.unfolded_found } else { &mut state.unfolded };
    if view.selected().first() != state.selected.as_ref() {
        view.set_selected(state.selected.into_iter().collect());
    }
    let mut commands = Vec::new();
    let (width, height) = (ui.available_width(), ui.available_height());
    let actions = ScrollArea::vertical().id_salt(found.is_some()).auto_shrink(false).show(ui, |ui| {
        let tree = TreeView::new(focus_id()).allow_multi_selection(false).allow_drag_and_drop(false);
        let tree = tree.fill_available_height(false).min_height(height).max_width(width).override_indent(Some(12.0));
        let (response, actions) = tree.show_state(ui, view, |rows| match found {
            Some(found) => {
                for &node in found {
                    rows.node(TreeRow::leaf(panel, shown, node, &mut commands));
                }
            }
            None => add_rows(rows, panel, shown, &mut commands),
        });
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Tree, true, "Scene tree"));
        actions
    });
    commands.extend(actions.inner.into_iter().flat_map(asked));
    commands
}

fn asked(action: Action<usize>) -> Vec<Command> {
    match action {
        Action::SetSelected(nodes) => vec![Command::Select(nodes.first().copied())],
        Action::Activate(activated) => vec![Command::Select(activated.selected.first().copied()), Command::Frame],
        _ => Vec::new(),
    }
}

/// What is left to do on the way through the tree; not by recursion, for files nest as deep as they like.
enum Step {
    Enter { node: usize, depth: usize },
    Leave,
}

fn add_rows(rows: &mut TreeViewBuilder<'_, usize>, panel: TreePanel<'_>, shown: &[bool], commands: &mut Vec<Command>) {
    let enter = |depth: usize| move |&node: &usize| Step::Enter { node, depth };
    let mut steps: Vec<Step> = panel.outline.roots.iter().rev().map(enter(0)).collect();
    while let Some(step) = steps.pop() {
        match step {
            Step::Leave => rows.close_dir(),
            Step::Enter { node, depth } => {
                let children = &panel.outline.children[node];
                if children.is_empty() {
                    rows.node(TreeRow::leaf(panel, shown, node, commands));
                    continue;
                }
                let is_unfolded = depth < panel.outline.unfolded_depth;
                steps.push(Step::Leave);
                if rows.node(TreeRow::branch(panel, shown, node, is_unfolded, commands)) {
                    steps.extend(children.iter().rev().map(enter(depth + 1)));
                }
            }
        }
    }
}
