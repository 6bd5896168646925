//! The middle of the window: which picture is wanted now, how coarse it may be, and what lies over it.

use egui::{Align2, Color32, FontId, Painter, Rect, Ui, vec2};

use super::command::Command;
use super::exact_job::Posed;
use super::journal::Severity;
use super::node_overlay::{self, Projection};
use super::pace::PROGRESS_STEP;
use super::screenshots::{Content, Format};
use super::{App, exact_job, legend, theme, viewport};
use crate::gpu::GpuTexture;
use crate::scene::OrbitCamera;
use crate::settings::{Settings, View};
use crate::stages::pixels::camera::PixelRays;

/// Narrower pictures have no room for all gestures beside their size.
const HINT_WIDTH: f32 = 520.0;

impl App {
    pub(super) fn picture_ui(&mut self, ui: &mut Ui, clock_secs: f64) {
        let rect = ui.available_rect_before_wrap();
        let full_px = viewport::size_px(ui, rect);
        self.view_px = full_px;
        let camera = self.camera(full_px);
        let (settings, size_px) = self.wanted_picture(ui, full_px, clock_secs);
        if self.scene.is_some()
            && let Err(error) = self.stage.advance(&settings, size_px, self.latency.is_under_input())
        {
            self.journal.tell(Severity::Error, error);
            self.screenshots.give_up();
        }
        for sentence in self.stage.take_newly_left_out() {
            self.journal.note(Severity::Warning, sentence);
        }
        self.follow_reference(ui.ctx(), &settings, full_px);
        self.follow_measuring(ui.ctx(), &settings);
        self.save_screenshot(ui.ctx(), &settings, full_px);
        let response = self.viewport.ui(ui, &self.render, self.stage.picture());
        let mut commands = viewport::commands(ui, &response, &camera);
        commands.extend(self.desk.reference.overlay_ui(ui, rect).map(Command::Reference));
        self.inspect(ui, &response);
        let moved = !commands.is_empty();
        commands.into_iter().for_each(|command| self.apply(ui.ctx(), command, clock_secs));
        if moved {
            // The picture of the new camera is asked for by the next frame.
            ui.ctx().request_repaint();
        }
        self.overlay_ui(ui, rect, size_px, full_px);
    }

    /// The camera that is set, else the one of the file that is looked through, else one that frames what
    /// is there when the clip begins.
    pub(super) fn camera(&self, full_px: [u32; 2]) -> OrbitCamera {
        let aspect = f64::from(full_px[0]) / f64::from(full_px[1]);
        let of_file = || {
            let prepared = self.prepared().filter(|_| self.settings.shot.file_camera.is_some())?;
            let pose = prepared.pose(&self.settings.shot.motion).ok()?;
            prepared.scene.camera_at(prepared.camera_index(&self.settings.shot).ok()??, &pose, aspect)
        };
        let first = || OrbitCamera::framing(self.prepared().and_then(|prepared| prepared.at_first), aspect);
        self.settings.shot.camera.or_else(of_file).unwrap_or_else(first)
    }

    /// The settings to draw: of the voxels that are there, in a pose whose exact set is there too.
    fn wanted_picture(&mut self, ui: &Ui, full_px: [u32; 2], clock_secs: f64) -> (Settings, [u32; 2]) {
        let mut settings = self.settings.clone();
        settings.shot.camera = Some(self.camera(full_px));
        if let Some(ready) = &self.scene {
            // The window decides how large it is.
            (settings.shot.scene, settings.shot.size_px) = (Some(ready.prepared.scene.identity()), None);
            ready.preparation.keep_in(&mut settings);
            let looked_at = settings.method.look.accuracy || settings.method.look.view == View::Ghost;
            let update = self.exact.update(ui.ctx(), &ready.prepared, &Posed::of(&settings), looked_at);
            (settings.shot.motion, settings.shot.visibility) = (update.posed.motion, update.posed.visibility);
            if let Some(exact) = update.exact {
                self.stage.offer_exact(exact);
            }
            for warning in update.warnings {
                self.journal.note(Severity::Warning, warning);
            }
        }
        let measured = (self.stage.results, self.stage.exposure);
        self.exposure.hold(&mut settings, self.playback.is_playing(), measured);
        let waits = self.screenshots.is_wanted() && !self.playback.is_playing();
        let coarse = self.is_moving(clock_secs) && !waits;
        let coarseness = if coarse { self.stage.moving_coarseness(full_px) } else { 1 };
        (settings, full_px.map(|edge| edge.div_ceil(coarseness)))
    }

    fn is_moving(&self, clock_secs: f64) -> bool {
        let rest_secs = exact_job::REST.as_secs_f64();
        self.playback.is_playing() || self.moved_at_secs.is_some_and(|moved| clock_secs - moved < rest_secs)
    }

    fn save_screenshot(&mut self, ctx: &egui::Context, settings: &Settings, full_px: [u32; 2]) {
        if !self.screenshots.is_wanted() {
            return;
        }
        let Some(ready) = &self.scene else { return self.screenshots.give_up() };
        let scene = ready.prepared.scene.name.clone();
        if self.playback.is_playing() {
            return self.save_at_once(ctx, &scene);
        }
        if self.stage.working().is_some() {
            return;
        }
        let ready_px = self.stage.picture().map(GpuTexture::size_px);
        let is_ready = ready_px == Some(full_px) || self.stage.engine.shows_nothing();
        if !is_ready || self.exact.fraction().is_some() || self.desk.reference.is_behind() {
            return;
        }
        let content = match self.screenshots.wanted() {
            Some(Format::Light) => self.shown_light(full_px),
            Some(Format::Picture) | None => self.shown_picture(settings),
        };
        match content {
            Ok(content) => self.screenshots.save(ctx, content, &scene),
            Err(error) => self.give_up_screenshot(&error),
        }
    }

    /// While a clip plays, the frame on screen, as it is there.
    fn save_at_once(&mut self, ctx: &egui::Context, scene: &str) {
        let engine = &self.stage.engine;
        // Before the first picture there is nothing to save yet.
        let Some(settings) = engine.settings_on_screen().cloned() else { return };
        let content = match (self.screenshots.wanted(), self.stage.picture()) {
            (Some(Format::Light), Some(picture)) => self.shown_light(picture.size_px()),
            _ => engine.read_image().map(|picture| Content::Picture(picture, Box::new(settings))).map_err(Into::into),
        };
        match content {
            Ok(content) => self.screenshots.save(ctx, content, scene),
            Err(error) => self.give_up_screenshot(&error),
        }
    }

    fn give_up_screenshot(&mut self, error: &anyhow::Error) {
        self.screenshots.give_up();
        self.journal.tell(Severity::Error, format!("no screenshot: {error}"));
    }

    fn shown_picture(&self, settings: &Settings) -> anyhow::Result<Content> {
        let mut picture = self.stage.engine.read_image()?;
        self.desk.reference.lay_over(&mut picture);
        Ok(Content::Picture(picture, Box::new(settings.clone())))
    }

    fn shown_light(&self, size_px: [u32; 2]) -> anyhow::Result<Content> {
        let light = self.stage.engine.read_surfaces()?;
        let mut light = light.ok_or_else(|| anyhow::anyhow!("no lit surfaces are shown"))?;
        self.desk.reference.lay_light_over(&mut light);
        Ok(Content::Light(light, size_px))
    }

    /// Asks for the next frame of the window where something goes on; whether at once.
    pub(super) fn wake_again(&self, ctx: &egui::Context, clock_secs: f64) -> bool {
        if self.loader.progress().is_some() || self.exact.fraction().is_some() {
            ctx.request_repaint_after(PROGRESS_STEP);
        }
        if self.desk.reference.is_busy() {
            ctx.request_repaint_after(PROGRESS_STEP);
        }
        let now = self.stage.working().is_some() || self.playback.is_playing() || self.screenshots.is_wanted();
        if now {
            ctx.request_repaint();
        } else if self.is_moving(clock_secs) {
            ctx.request_repaint_after(exact_job::REST);
        }
        now
    }

    fn overlay_ui(&self, ui: &Ui, rect: Rect, size_px: [u32; 2], full_px: [u32; 2]) {
        let painter = ui.painter_at(rect);
        if let Some(error) = self.stage.error() {
            in_the_middle(&painter, rect, error, theme::ERROR);
        } else if self.scene.is_none() {
            let text = if self.loader.progress().is_some() { "Opening…" } else { "No scene is open" };
            in_the_middle(&painter, rect, text, theme::WEAK);
        } else if self.stage.engine.shows_nothing() {
            in_the_middle(&painter, rect, self.why_empty(), theme::WEAK);
        } else if self.ghost_is_on_its_way() {
            let text = "The ghost of this pose is on its way";
            painter.text(
                rect.center_top() + vec2(0.0, legend::HEIGHT),
                Align2::CENTER_TOP,
                text,
                FontId::proportional(13.0),
                theme::WARNING,
            );
        }
        let is_wide = rect.width() >= HINT_WIDTH;
        let hint =
            if is_wide { "drag: orbit   right drag: pan   wheel: zoom   F: frame   F1: help" } else { "F1: help" };
        legend::caption(&painter, rect.left_bottom() + vec2(14.0, -10.0), Align2::LEFT_BOTTOM, hint);
        let coarse = if size_px == full_px { "" } else { ", coarse" };
        let size = format!("{} × {} px{coarse}", size_px[0], size_px[1]);
        legend::caption(&painter, rect.right_bottom() + vec2(-14.0, -10.0), Align2::RIGHT_BOTTOM, &size);
        let values = legend::Values { exposure: self.stage.exposure, range: self.stage.value_range };
        self.paint_node(&painter, rect, full_px);
        match self.desk.reference.most_difference() {
            Some(most) => legend::differences(&painter, rect, self.settings.method.look.surface, most),
            None if self.stage.engine.shows_nothing() => {}
            None => legend::paint(&painter, rect, &self.settings.method.look, values),
        }
    }

    /// The picture on screen is not the ghost of the pose that is asked for.
    fn ghost_is_on_its_way(&self) -> bool {
        let engine = &self.stage.engine;
        let of_pose = engine.settings_on_screen().is_some_and(|shown| {
            shown.method.look.view == View::Ghost && shown.shot.motion == self.settings.shot.motion
        });
        self.settings.method.look.view == View::Ghost && !of_pose
    }

    /// The node that is looked at, over the picture, where its pointers are wanted.
    fn paint_node(&self, painter: &Painter, rect: Rect, full_px: [u32; 2]) {
        let inspector = &self.desk.inspector;
        let is_wanted = inspector.is_open && self.settings.method.look.pointers && !full_px.contains(&0);
        let facts = inspector.facts().flatten().filter(|_| is_wanted);
        if let (Some(facts), Some(prepared)) = (facts, self.prepared()) {
            let rays = PixelRays::new(&self.camera(full_px), &prepared.grid, full_px);
            let projection = Projection { rays, rect, depth: prepared.grid.depth };
            node_overlay::paint(painter, &projection, facts);
        }
    }
}

/// A text over the picture, within its width.
fn in_the_middle(painter: &Painter, rect: Rect, text: &str, color: Color32) {
    let galley = painter.layout(text.to_owned(), FontId::proportional(15.0), color, (rect.width() - 40.0).max(0.0));
    painter.galley(Align2::CENTER_CENTER.align_size_within_rect(galley.size(), rect).min, galley, color);
}
