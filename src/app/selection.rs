//! What becomes of the node that is selected in the scene tree: hidden, shown alone, framed.

use super::App;
use super::journal::Severity;
use super::outline;

impl App {
    pub(super) fn select(&mut self, node: Option<usize>) {
        let Some(ready) = &self.scene else { return };
        let nodes = ready.prepared.scene.nodes.len();
        self.desk.tree.select(&ready.prepared.scene, node.filter(|node| *node < nodes));
    }

    /// Hides the selected node, or shows it again.
    pub(super) fn toggle_shown(&mut self) {
        let (Some(ready), Some(node)) = (&self.scene, self.desk.tree.selected) else { return };
        let (scene, visibility) = (&ready.prepared.scene, &mut self.settings.shot.visibility);
        match visibility.shown_nodes(scene) {
            Ok(shown) if shown[node] => visibility.hide(node),
            Ok(_) => visibility.show(scene, node),
            Err(error) => self.journal.tell(Severity::Error, error.to_string()),
        }
    }

    /// Shows the selected node alone, if anything of it can be seen.
    pub(super) fn isolate(&mut self) {
        let (Some(ready), Some(node)) = (&self.scene, self.desk.tree.selected) else { return };
        let scene = &ready.prepared.scene;
        if ready.outline.contents[node].objects > 0 {
            self.settings.shot.visibility.isolate(scene, node);
        } else {
            let name = outline::name(scene, node);
            self.journal
                .tell(Severity::Warning, format!("Nothing of \"{name}\" could be shown alone: it has no mesh."));
        }
    }

    /// Brings the selected node into view, all that the moment shows where none is selected; from the side that
    /// the camera looks from now.
    pub(super) fn frame_selected(&mut self) {
        let Some(ready) = &self.scene else { return };
        let bounds = match self.desk.tree.selected {
            None => ready.prepared.bounds_shown(&self.settings.shot),
            Some(node) => match ready.prepared.bounds_below(node, &self.settings.shot.motion) {
                Ok(Some(bounds)) => Some(bounds),
                Ok(None) => {
                    let name = outline::name(&ready.prepared.scene, node);
                    return self
                        .journal
                        .tell(Severity::Warning, format!("\"{name}\" is at no finite place in this pose."));
                }
                Err(error) => return self.journal.tell(Severity::Error, error.to_string()),
            },
        };
        if bounds.is_some() {
            let mut camera = self.camera(self.view_px);
            camera.frame(bounds, f64::from(self.view_px[0]) / f64::from(self.view_px[1]));
            self.settings.shot.camera = Some(camera);
        }
    }
}
