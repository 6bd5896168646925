//! What outlives a lost GPU. The window itself paints on that GPU, so it cannot ask whether to go on:
//! it closes, and is opened again with what it kept.

use std::sync::{Arc, Mutex, PoisonError};

use super::loader::Ready;
use super::{App, Start};
use crate::settings::NodeNames;

/// Scene and settings of a window that lost its GPU.
pub struct Kept {
    pub(super) start: Start,
    pub(super) scene: Option<Ready>,
    /// One sentence.
    pub(super) cause: String,
}

/// Where a window leaves what the next one goes on with.
#[derive(Clone, Default)]
pub struct Rescue(Arc<Mutex<Option<Kept>>>);

impl Rescue {
    pub fn take(&self) -> Option<Kept> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    fn leave(&self, kept: Kept) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(kept);
    }
}

impl App {
    /// Closes the window if its GPU is lost; whether it is. Nothing is painted then: egui-wgpu panics
    /// when it uploads anything to a lost device.
    pub(super) fn close_if_lost(&mut self, ctx: &egui::Context) -> bool {
        // A loss is told to those who poll; what else this returns is of no use here.
        let _ = self.gpu().device.poll(wgpu::PollType::Poll);
        if !self.gpu().is_lost() {
            return false;
        }
        let cause = "the GPU was lost".to_owned();
        let (opening, disk) = self.loader.choices();
        let start = Start { settings: self.settings.clone(), names: NodeNames::default(), opening, disk };
        self.rescue.leave(Kept { start, scene: self.scene.clone(), cause });
        ctx.graphics_mut(|painted| *painted = Default::default());
        ctx.send_viewport_cmd(egui::ViewportCommand::Close);
        true
    }

    /// What the next window goes on with, if this one lost its GPU.
    pub fn rescued(&self) -> Option<Kept> {
        self.rescue.take()
    }
}
