//! Why there is nothing in the picture, and what would bring something.

use super::App;
use crate::lights::LightSource;
use crate::settings::View;

impl App {
    pub(super) fn why_empty(&self) -> &'static str {
        if self.settings.method.look.view == View::ShadowMap && self.shining().is_empty() {
            return self.why_no_shadow_map();
        }
        if self.settings.shot.visibility.shows_all() {
            "Nothing of this scene is in the grid"
        } else {
            "What is shown is not in the grid; Alt+H shows everything"
        }
    }

    fn why_no_shadow_map(&self) -> &'static str {
        let known = self.prepared().and_then(|prepared| prepared.known_lights(&self.settings).ok());
        let is_there = |light: &crate::lights::KnownLight| light.source != LightSource::Sun;
        if known.unwrap_or_default().iter().any(is_there) {
            "No light casts a shadow here: all are off, black or hidden. The panel \"Light\" switches them on"
        } else {
            "The scene has no light that casts a shadow. The panel \"Light\" adds one, or our own sun"
        }
    }
}
