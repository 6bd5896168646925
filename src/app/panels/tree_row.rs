//! A row of the scene tree: a node's name, what it carries in a word each, and its menu.

use egui::{Label, RichText, Ui};
use egui_ltreeview::NodeConfig;

use crate::app::command::Command;
use crate::app::outline::{self, Outline};
use crate::app::palette::Tone;
use crate::prepare::Prepared;
use crate::settings::Visibility;

/// What is shown; nothing here is kept.
#[derive(Clone, Copy)]
pub struct TreePanel<'a> {
    pub prepared: &'a Prepared,
    pub outline: &'a Outline,
    pub visibility: &'a Visibility,
}

/// What can be done with a node, by its buttons and its menu.
pub struct Offer {
    pub enabled: bool,
    pub name: &'static str,
    pub tip: &'static str,
    pub command: Command,
}

pub fn offers(panel: TreePanel<'_>, node: Option<usize>, is_shown: bool) -> [Offer; 4] {
    let has_objects = node.is_some_and(|node| panel.outline.contents[node].objects > 0);
    let (toggle, tip) = if is_shown {
        ("Hide", "Hides the node and everything below it: it costs nothing then (H).")
    } else {
        ("Show", "Shows the node again (H).")
    };
    let offer = |enabled, name, tip, command| Offer { enabled, name, tip, command };
    [
        offer(node.is_some(), toggle, tip, Command::ToggleShown),
        offer(has_objects, "Isolate", "Shows the node and everything below it alone (Shift+H).", Command::Isolate),
        offer(node.is_some(), "Frame", "Brings the node into view (F, or a double click).", Command::Frame),
        offer(!panel.visibility.shows_all(), "Show all", "Shows every node again (Alt+H).", Command::ShowAll),
    ]
}

/// Laid out only where it is on screen.
pub struct TreeRow<'a> {
    panel: TreePanel<'a>,
    node: usize,
    is_shown: bool,
    /// `None`: a leaf. Else whether it is unfolded at first.
    branch: Option<bool>,
    commands: &'a mut Vec<Command>,
}

impl<'a> TreeRow<'a> {
    /// A node without what is below it.
    pub fn leaf(panel: TreePanel<'a>, shown: &[bool], node: usize, commands: &'a mut Vec<Command>) -> Self {
        Self { panel, node, is_shown: shown.get(node).copied().unwrap_or(true), branch: None, commands }
    }

    /// A node that rows of its children follow.
    pub fn branch(
        panel: TreePanel<'a>,
        shown: &[bool],
        node: usize,
        is_unfolded: bool,
        commands: &'a mut Vec<Command>,
    ) -> Self {
        Self { branch: Some(is_unfolded), ..Self::leaf(panel, shown, node, commands) }
    }

    /// From right to left.
    fn tags(&self) -> impl Iterator<Item = (&'static str, Tone)> + use<> {
        let node = &self.panel.prepared.scene.nodes[self.node];
        let outline = self.panel.outline;
        let tags = [
            (outline.is_warned[self.node], "!", Tone::Warning),
            (node.light.is_some(), "light", Tone::Light),
            (node.camera.is_some(), "camera", Tone::Camera),
            (outline.is_joint[self.node], "joint", Tone::Joint),
            (node.skin.is_some(), "skin", Tone::Joint),
            (node.mesh.is_some(), "mesh", Tone::Accent),
        ];
        tags.into_iter().filter(|(is_there, ..)| *is_there).map(|(_, tag, color)| (tag, color))
    }
}

impl NodeConfig<usize> for TreeRow<'_> {
    fn id(&self) -> &usize {
        &self.node
    }

    fn is_dir(&self) -> bool {
        self.branch.is_some()
    }

    fn default_open(&self) -> bool {
        self.branch == Some(true)
    }

    fn activatable(&self) -> bool {
        true
    }

    fn label(&mut self, ui: &mut Ui) {
        let mut text = RichText::new(outline::name(&self.panel.prepared.scene, self.node));
        if !self.is_shown {
            text = text.color(Tone::Weak.of(ui)).strikethrough();
        }
        ui.add(Label::new(text).selectable(false).truncate());
    }

    fn accessory(&mut self, ui: &mut Ui) {
        ui.spacing_mut().item_spacing.x = 4.0;
        for (tag, color) in self.tags() {
            let color = if self.is_shown { color } else { Tone::Weak };
            ui.add(Label::new(RichText::new(tag).color(color.of(ui)).small()).selectable(false));
        }
    }

    fn has_context_menu(&self) -> bool {
        true
    }

    fn context_menu(&mut self, ui: &mut Ui) {
        for Offer { enabled, name, command, .. } in offers(self.panel, Some(self.node), self.is_shown) {
            if ui.add_enabled(enabled, egui::Button::new(name)).clicked() {
                self.commands.extend([Command::Select(Some(self.node)), command]);
                ui.close();
            }
        }
    }
}
