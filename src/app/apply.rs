//! What the window does when it is told.

use super::App;
use super::command::Command;
use super::folding::Side;
use super::measuring::Order;
use super::playback;
use super::screenshots::{Content, Format};
use crate::settings::{Settings, Visibility};

impl App {
    /// Carries out one command. `clock_secs` is the window's clock.
    pub(super) fn apply(&mut self, ctx: &egui::Context, command: Command, clock_secs: f64) {
        match command {
            Command::Open(path) => self.open(ctx, path, None),
            Command::ShowScene(number) => self.show_another_scene(ctx, number),
            Command::ChooseFile => self.desk.choose_file(ctx, self.host.choose_file),
            Command::AskForPath => self.ask_for_path(ctx),
            Command::Forget(path) => self.desk.forget(&path),
            Command::CancelLoading => self.cancel_loading(),
            Command::Discretize(discretization) => self.settings.method.discretization = discretization,
            Command::Fit(fit) => self.settings.shot.fit = fit,
            Command::Look(look) => self.settings.method.look = look,
            Command::Reference(order) => self.desk.reference.apply(order),
            Command::Measure(order) => self.measure(ctx, order),
            Command::Pin(pin) => self.desk.inspector.apply(pin),
            Command::Light(lighting) => self.settings.method.lighting = lighting,
            Command::TraceCones(cones) => self.settings.method.cone_tracing = cones,
            Command::Camera(camera) => {
                self.settings.shot.camera = Some(camera);
                self.moved_at_secs = Some(clock_secs);
            }
            Command::SceneCamera(camera) => self.look_through(camera),
            Command::FrameAll => (self.settings.shot.camera, self.settings.shot.file_camera) = (None, None),
            Command::Frame => self.frame_selected(),
            Command::Select(node) => self.select(node),
            Command::ToggleShown => self.toggle_shown(),
            Command::Isolate => self.isolate(),
            Command::ShowAll => self.settings.shot.visibility = Visibility::default(),
            Command::Undo => self.undo_or_redo(true),
            Command::Redo => self.undo_or_redo(false),
            Command::ToggleHelp => self.is_help_open ^= true,
            Command::Theme(theme) => ctx.set_theme(theme),
            Command::ToggleTree => self.folding.toggle(&mut self.desk.unfolded, Side::Tree),
            Command::Move(motion) => {
                self.settings.shot.motion = motion;
                self.restart_clock(clock_secs);
            }
            Command::TogglePlaying if self.playback.is_playing() => self.playback.pause(),
            Command::TogglePlaying => {
                self.playback.play(clock_secs, self.settings.shot.motion.time_secs, self.clip_secs());
            }
            Command::Step(steps) => {
                self.playback.pause();
                let time_secs = self.settings.shot.motion.time_secs;
                self.settings.shot.motion.time_secs =
                    playback::stepped(time_secs, steps, self.clip_secs(), self.playback.looped);
            }
            Command::Loop(looped) => {
                self.playback.looped = looped;
                self.restart_clock(clock_secs);
            }
            Command::Speed(speed) => {
                self.playback.speed = speed;
                self.restart_clock(clock_secs);
            }
            Command::SaveScreenshot => self.screenshots.want(Format::Picture),
            Command::SaveLight => self.screenshots.want(Format::Light),
            Command::ClearLog => self.journal.clear(),
            Command::Copy(text) => ctx.copy_text(text),
        }
    }

    /// Goes on playing from the time that is set now.
    fn restart_clock(&mut self, clock_secs: f64) {
        if self.playback.is_playing() {
            self.playback.play(clock_secs, self.settings.shot.motion.time_secs, self.clip_secs());
        }
    }

    fn measure(&mut self, ctx: &egui::Context, order: Order) {
        let measuring = &mut self.desk.measuring;
        match order {
            Order::Choose(measure) => measuring.measure = measure,
            Order::Runs(runs) => measuring.runs = runs,
            Order::Start => measuring.start(),
            Order::Cancel => measuring.cancel(),
            Order::Copy => measuring.json().into_iter().for_each(|json| ctx.copy_text(json)),
            Order::Save => {
                if let Some((name, json)) = measuring.name().zip(measuring.json()) {
                    self.screenshots.save(ctx, Content::Report(json), &name);
                }
            }
        }
    }

    fn undoable(&self) -> Settings {
        let mut settings = self.settings.clone();
        settings.shot.motion.time_secs = 0.0;
        settings
    }

    pub(super) fn note_for_undo(&mut self, clock_secs: f64) {
        let now = self.undoable();
        self.undo.note(now, clock_secs);
    }

    fn undo_or_redo(&mut self, back: bool) {
        let now = self.undoable();
        if let Some(mut settings) = self.undo.step(&now, back) {
            settings.shot.motion.time_secs = self.settings.shot.motion.time_secs;
            self.settings = settings;
        }
    }
}
