//! The window: panels around a picture, over the same engine and settings as the command line.
//!
//! ```text
//! input ─► panels, shortcuts, drops ─► Command ─► Settings ─► Stage ─► Engine ─► picture
//!                                                   ▲
//!                         Loader, ExactJob ─────────┘  (threads of their own)
//! ```
//!
//! A frame of the window never waits: the engine gets a slice of GPU time, files and voxelization
//! have threads. A still scene asks for no repaint.

mod background;
mod apply;
mod coarseness;
mod command;
mod desk;
mod device;
mod exact_job;
mod folders;
mod folding;
mod follow;
mod gestures;
mod help;
mod history;
mod inspector;
mod host;
mod journal;
mod latency;
mod layout;
mod legend;
mod loader;
mod measuring;
mod node_overlay;
mod numbers;
mod opening;
mod outline;
mod pace;
mod palette;
mod panel_places;
mod panels;
mod picture;
mod playback;
mod quick_clicks;
mod reference;
mod remembered;
mod rescue;
mod revealing;
mod run;
mod scale_ticks;
mod restored;
mod restoring;
mod screenshots;
mod selection;
mod shortcuts;
mod stage;
mod start;
mod steady;
mod theme;
mod toasts;
mod undo;
mod viewport;
mod why_empty;

use std::path::Path;
use std::sync::Arc;

use self::desk::Desk;
use self::exact_job::ExactJob;
use self::folding::Folding;
pub use self::host::{Choice, Host};
use self::journal::{Journal, Severity};
pub use self::latency::Latency;
use self::loader::{Loader, Ready};
pub use self::pace::Pace;
use self::playback::Playback;
use self::quick_clicks::QuickClicks;
pub use self::rescue::Kept;
use self::rescue::Rescue;
use self::restored::Restored;
pub use self::run::run;
use self::screenshots::Screenshots;
use self::stage::Stage;
pub use self::start::Start;
use self::steady::SteadyExposure;
use self::undo::Undo;
use self::viewport::Viewport;
use crate::engine::Engine;
use crate::gpu::Gpu;
use crate::prepare::Prepared;
use crate::scene::Clip;
use crate::settings::{NodeNames, Settings};
use crate::stages::SHADERS;

/// Why a window has no app.
type NoApp = Box<dyn std::error::Error + Send + Sync>;

/// The whole window.
pub struct App {
    settings: Settings,
    scene: Option<Ready>,
    playback: Playback,
    stage: Stage,
    loader: Loader,
    exact: ExactJob,
    viewport: Viewport,
    screenshots: Screenshots,
    desk: Desk,
    folding: Folding,
    /// The list of keys and gestures is shown.
    is_help_open: bool,
    undo: Undo,
    /// What a picture has set, until its scene is open.
    restored: Option<Restored>,
    /// What the first scene is to hide, by name.
    names: NodeNames,
    journal: Journal,
    latency: Latency,
    /// Pixels of the picture.
    view_px: [u32; 2],
    render: egui_wgpu::RenderState,
    /// When the camera was moved last, on the window's clock.
    moved_at_secs: Option<f64>,
    rescue: Rescue,
    exposure: SteadyExposure,
    host: Host,
}

impl App {
    /// Takes the window's device, and starts to open the scene. Fails without a GPU.
    pub fn new(context: &eframe::CreationContext<'_>, scene: &Path, start: Start) -> Result<Self, NoApp> {
        let shown = start.opening.scene.clone();
        let mut app = Self::empty(context, start)?;
        app.open(&context.egui_ctx, scene.to_owned(), shown);
        Ok(app)
    }

    /// Takes the window's device after another was lost, and goes on where that one ended.
    pub fn again(context: &eframe::CreationContext<'_>, kept: Kept) -> Result<Self, NoApp> {
        let mut app = Self::empty(context, kept.start)?;
        if let Some(scene) = kept.scene {
            app.name_window(&context.egui_ctx, &scene.prepared);
            app.stage.set_prepared(&scene.prepared);
            app.scene = Some(scene);
        }
        app.journal.tell(Severity::Warning, format!("{}; everything goes on with a new device", kept.cause));
        Ok(app)
    }

    fn empty(context: &eframe::CreationContext<'_>, start: Start) -> Result<Self, NoApp> {
        let render = context.wgpu_render_state.clone().ok_or("the window has no GPU")?;
        let gpu = Arc::new(Gpu::from_wgpu(&SHADERS, &render.adapter, render.device.clone(), render.queue.clone()));
        let is_chosen = context.storage.is_some_and(|storage| storage.get_string(host::EGUI_KEY).is_some());
        theme::apply(&context.egui_ctx, is_chosen);
        context.egui_ctx.add_plugin(QuickClicks::default());
        let stage = Stage::new(Arc::clone(&gpu));
        let room = stage.engine.room();
        let mut app = Self {
            settings: start.settings,
            scene: None,
            playback: Playback::default(),
            stage,
            loader: Loader::new(start.opening, start.disk, room),
            exact: ExactJob::default(),
            viewport: Viewport::default(),
            screenshots: Screenshots::new(start.host.screenshots.clone()),
            desk: Desk::default(),
            folding: Folding::default(),
            is_help_open: false,
            undo: Undo::default(),
            restored: None,
            names: start.names,
            view_px: [1, 1],
            journal: Journal::new(start.host.tell_error),
            latency: Latency::new(render.device.clone()),
            render,
            moved_at_secs: None,
            rescue: Rescue::default(),
            exposure: SteadyExposure::default(),
            host: start.host,
        };
        app.remember(context.storage);
        gpu.warnings().into_iter().for_each(|warning| app.journal.tell(Severity::Warning, warning));
        Ok(app)
    }

    /// How long the window takes from an input to its frame.
    pub fn latency(&self) -> &Latency {
        &self.latency
    }

    /// What the engine runs on.
    pub fn gpu(&self) -> &Gpu {
        self.stage.engine.gpu()
    }

    /// What draws the picture, and knows what is on screen.
    pub fn engine(&self) -> &Engine {
        &self.stage.engine
    }

    /// Another pace than that of a person at the window.
    pub fn set_pace(&mut self, pace: Pace) {
        (self.stage.pace, self.exact.pace) = (pace, pace);
    }

    /// The exact voxels of a pose are being made.
    pub fn is_voxelizing(&self) -> bool {
        self.exact.is_at_work()
    }

    /// What the person has set.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Nothing is being opened, voxelized, built, drawn, traced or compared.
    pub fn is_settled(&self) -> bool {
        let loading = self.loader.progress().is_some() || self.exact.is_behind();
        !loading
            && self.stage.working().is_none()
            && !self.screenshots.is_busy()
            && !self.desk.is_busy()
            && !self.desk.has_dialog()
    }

    fn prepared(&self) -> Option<&Arc<Prepared>> {
        self.scene.as_ref().map(|ready| &ready.prepared)
    }

    /// The clip that the settings name; `None` for the rest pose.
    fn clip(&self) -> Option<&Clip> {
        let prepared = self.prepared()?;
        let index = prepared.clip_index(&self.settings.shot.motion).ok()??;
        prepared.scene.clips.get(index)
    }

    fn clip_secs(&self) -> f64 {
        self.clip().map_or(0.0, |clip| clip.duration_secs)
    }
}
