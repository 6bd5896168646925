//! Everything the window can be told to do. Panels, shortcuts, drops and scripts all end here.

use std::path::PathBuf;

use super::App;
use super::inspector::Pin;
use super::measuring;
use super::playback;
use super::reference::Order;
use super::screenshots::Format;
use crate::scene::OrbitCamera;
use crate::settings::{ConeTracing, Discretization, Lighting, Look, MotionSettings, Visibility};

#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Opens a file, or a built-in scene by its name.
    Open(PathBuf),
    /// Shows another scene of the file that is open, by its number.
    ShowScene(usize),
    /// Lets the desktop's dialog choose one.
    ChooseFile,
    CancelLoading,
    Discretize(Discretization),
    Look(Look),
    Light(Lighting),
    /// Other cones from surfaces.
    TraceCones(ConeTracing),
    /// What is done with the path tracer.
    Reference(Order),
    /// What is done with experiments.
    Measure(measuring::Order),
    /// Another node of the octree is looked at.
    Pin(Pin),
    /// Another clip or turn, or a scrub of the timeline.
    Move(MotionSettings),
    TogglePlaying,
    /// Pauses, and goes by so many steps of 1/30 s.
    Step(i32),
    Loop(bool),
    Speed(f64),
    /// The person moves the camera: coarse until it rests.
    Camera(OrbitCamera),
    /// A camera of the file, as it is posed now.
    SceneCamera(usize),
    /// Back to the camera that frames everything.
    FrameAll,
    /// Brings the selected node into view, everything where none is selected.
    Frame,
    /// A node of the scene tree, or none.
    Select(Option<usize>),
    /// Hides the selected node, or shows it again.
    ToggleShown,
    /// Shows the selected node alone.
    Isolate,
    ShowAll,
    ToggleTree,
    Undo,
    Redo,
    SaveScreenshot,
    /// The light of the surfaces that are shown, as it is.
    SaveLight,
    ClearLog,
}

impl App {
    /// Carries out one command. `clock_secs` is the window's clock.
    pub(super) fn apply(&mut self, ctx: &egui::Context, command: Command, clock_secs: f64) {
        match command {
            Command::Open(path) => self.open(ctx, path, None),
            Command::ShowScene(number) => self.show_another_scene(ctx, number),
            Command::ChooseFile => self.desk.choose_file(ctx),
            Command::CancelLoading => self.cancel_loading(),
            Command::Discretize(discretization) => self.settings.discretization = discretization,
            Command::Look(look) => self.settings.look = look,
            Command::Reference(order) => self.desk.reference.apply(order),
            Command::Measure(order) => self.measure(ctx, order),
            Command::Pin(pin) => self.desk.inspector.apply(pin),
            Command::Light(lighting) => self.settings.lighting = lighting,
            Command::TraceCones(cones) => self.settings.cone_tracing = cones,
            Command::Camera(camera) => {
                self.settings.look.camera = Some(camera);
                self.moved_at_secs = Some(clock_secs);
            }
            Command::SceneCamera(camera) => self.look_through(camera),
            Command::FrameAll => self.settings.look.camera = None,
            Command::Frame => self.frame_selected(),
            Command::Select(node) => self.select(node),
            Command::ToggleShown => self.toggle_shown(),
            Command::Isolate => self.isolate(),
            Command::ShowAll => self.settings.visibility = Visibility::default(),
            Command::Undo => self.undo_or_redo(true),
            Command::Redo => self.undo_or_redo(false),
            Command::ToggleTree => self.desk.unfolded.tree ^= true,
            Command::Move(motion) => {
                self.settings.motion = motion;
                self.restart_clock(clock_secs);
            }
            Command::TogglePlaying if self.playback.is_playing() => self.playback.pause(),
            Command::TogglePlaying => {
                self.playback.play(clock_secs, self.settings.motion.time_secs, self.clip_secs());
            }
            Command::Step(steps) => {
                self.playback.pause();
                let time_secs = self.settings.motion.time_secs;
                self.settings.motion.time_secs =
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
        }
    }

    /// Goes on playing from the time that is set now.
    fn restart_clock(&mut self, clock_secs: f64) {
        if self.playback.is_playing() {
            self.playback.play(clock_secs, self.settings.motion.time_secs, self.clip_secs());
        }
    }
}
