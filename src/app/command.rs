//! Everything the window can be told to do. Panels, shortcuts, drops and scripts all say it so.

use std::path::PathBuf;

use super::inspector::Pin;
use super::measuring;
use super::reference::Order;
use crate::scene::OrbitCamera;
use crate::settings::{ConeTracing, Discretization, Fit, Lighting, Look, MotionSettings};

#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Opens a file, or a built-in scene by its name.
    Open(PathBuf),
    /// Shows another scene of the file that is open, by its number.
    ShowScene(usize),
    /// Lets the desktop's dialog choose one.
    ChooseFile,
    /// Asks for a path in its field: there is no dialog.
    AskForPath,
    /// Takes a scene out of the recent ones.
    Forget(PathBuf),
    CancelLoading,
    Discretize(Discretization),
    /// Something else is enclosed by the grid.
    Fit(Fit),
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
    /// Back to the camera that the scene opened with.
    FrameAll,
    /// Brings the selected node into view, all that the moment shows where none is selected.
    Frame,
    /// A node of the scene tree, or none.
    Select(Option<usize>),
    /// Hides the selected node, or shows it again.
    ToggleShown,
    /// Shows the selected node alone.
    Isolate,
    ShowAll,
    ToggleTree,
    ToggleHelp,
    /// Dark, light, or as the desktop is.
    Theme(egui::ThemePreference),
    Undo,
    Redo,
    SaveScreenshot,
    /// The light of the surfaces that are shown, as it is.
    SaveLight,
    ClearLog,
    /// Into the clipboard.
    Copy(String),
}
