//! The path tracer beside the cones (section 5.2): traces the picture that is shown, lays it over that, and
//! measures how far the two are apart.
//!
//! ```text
//! Seen ─► Tracing ─► Traced ┐
//! Engine ─► ConePicture ────┼─► Pictures ─► Overlay (paths, wipe, difference)
//! Engine ─► ConeParts ──────┴─► Measured (errors of every part)
//! ```
//!
//! All of it has threads of its own; what is of another picture is kept, but not laid over this one.

mod follow;
mod latest;
mod measuring;
mod order;
mod overlay;
mod pictures;
mod seen;
mod stopped;
mod tracing;

use std::sync::Arc;

use image::RgbaImage;

pub use self::follow::ShownSurfaces;
use self::latest::Latest;
pub use self::measuring::MeasuredPart;
use self::measuring::{ConeParts, OfParts};
pub use self::order::{Comparison, Order};
use self::overlay::Overlay;
use self::pictures::{ConePicture, OfPicture, Pictures};
pub use self::seen::Seen;
use self::stopped::{Cause, Stopped};
use self::tracing::Tracing;
pub use self::tracing::{PARTS, Traced};
use crate::accuracy::path_tracer::Film;
use crate::accuracy::picture_error::CompareError;

pub struct Reference {
    /// Its panel is unfolded.
    pub is_open: bool,
    pub comparison: Comparison,
    pub divider: f32,
    pub samples: u32,
    /// Traces what is shown, whenever that is another picture.
    pub restarts: bool,
    is_ordered: bool,
    /// A person wants a reference, and has not stopped it since.
    is_wanted: bool,
    /// Waits for the picture that is to be traced next.
    is_restart_due: bool,
    /// What was traced, or is being; whether that is what is shown.
    seen: Option<Seen>,
    is_of_shown: bool,
    /// It is, and a part of it is shown that paths tell apart.
    is_compared: bool,
    run: Option<Tracing>,
    /// Samples that the last run was to end with.
    asked: u32,
    /// Why the run was told to stop.
    stopping: Option<Cause>,
    stopped: Option<Stopped>,
    kept: Option<Film>,
    traced: Option<Arc<Traced>>,
    /// What the engine shows, and which of its results that is.
    cones: Option<(u64, Arc<ConePicture>)>,
    parts: Option<(u64, Arc<ConeParts>)>,
    pictures: Latest<OfPicture, Pictures>,
    measured: Latest<OfParts, Result<Vec<MeasuredPart>, CompareError>>,
    overlay: Option<Overlay>,
    /// Something is still to be read, drawn or measured.
    is_behind: bool,
}

impl Default for Reference {
    fn default() -> Self {
        Self {
            is_open: false,
            comparison: Comparison::default(),
            divider: 0.5,
            samples: 64,
            restarts: false,
            is_ordered: false,
            is_wanted: false,
            is_restart_due: false,
            seen: None,
            is_of_shown: false,
            is_compared: false,
            run: None,
            asked: 0,
            stopping: None,
            stopped: None,
            kept: None,
            traced: None,
            cones: None,
            parts: None,
            pictures: Latest::default(),
            measured: Latest::default(),
            overlay: None,
            is_behind: false,
        }
    }
}

impl Reference {
    pub const SAMPLES: std::ops::RangeInclusive<u32> = 1..=65_536;

    pub fn apply(&mut self, order: Order) {
        match order {
            Order::Start => (self.is_ordered, self.is_wanted) = (true, true),
            Order::Stop => {
                self.is_wanted = false;
                self.stop(Cause::Person);
            }
            Order::Restart(restarts) => self.restarts = restarts,
            Order::Samples(samples) => self.samples = samples,
            Order::Compare(comparison) => self.comparison = comparison,
            Order::Divide(divider) => self.divider = divider,
        }
    }

    /// How far a run is that goes on, between 0 and 1.
    pub fn fraction(&self) -> Option<f32> {
        self.run.as_ref().map(Tracing::fraction)
    }

    /// How long a run will take that goes on, by what it took so far.
    pub fn secs_left(&self) -> Option<f64> {
        self.run.as_ref().and_then(Tracing::secs_left)
    }

    /// What the last run was stopped at, if it was.
    pub fn stopped(&self) -> Option<String> {
        let stopped = self.stopped.filter(|stopped| stopped.cause == Cause::PictureGone || self.is_of_shown);
        stopped.map(|stopped| stopped.sentence())
    }

    /// What paths have said so far, whatever is shown now.
    pub fn traced(&self) -> Option<&Traced> {
        self.traced.as_deref()
    }

    /// Whether what was traced is what is shown.
    pub fn is_of_shown(&self) -> bool {
        self.is_of_shown
    }

    /// Of the picture that is shown; while it is measured, of that before.
    pub fn measured(&self) -> &[MeasuredPart] {
        let measured = self.measured.get().filter(|_| self.is_of_shown);
        measured.and_then(|(_, measured)| measured.as_deref().ok()).unwrap_or_default()
    }

    /// Work that goes on, or waits for the picture or for a person to rest.
    pub fn is_busy(&self) -> bool {
        self.is_ordered || self.run.is_some() || self.is_restart_due || self.is_behind()
    }

    /// What is laid over the picture is not of its last state.
    pub fn is_behind(&self) -> bool {
        self.is_looked_at() && self.is_behind
    }

    fn is_looked_at(&self) -> bool {
        self.is_open || self.comparison != Comparison::Cones
    }

    /// The difference that has the last colour of the scale, where differences are shown.
    pub fn most_difference(&self) -> Option<f64> {
        let (_, pictures) = self.overlaid().filter(|_| self.comparison == Comparison::Difference)?;
        Some(pictures.most_difference)
    }

    /// What lies over the picture, if anything: it is of the same picture, and of the same part.
    fn overlaid(&self) -> Option<&(OfPicture, Pictures)> {
        let (_, shown) = self.cones.as_ref().filter(|_| self.is_compared && self.comparison != Comparison::Cones)?;
        let is_same = |cones: &ConePicture| cones.part == shown.part && cones.size_px == shown.size_px;
        self.pictures.get().filter(|(of, _)| is_same(&of.cones))
    }

    /// Paints it. Returns where the divider was dragged to.
    pub fn overlay_ui(&self, ui: &mut egui::Ui, rect: egui::Rect) -> Option<Order> {
        self.overlaid()?;
        let divider = self.overlay.as_ref()?.ui(ui, rect, self.comparison, self.divider)?;
        Some(Order::Divide(divider))
    }

    /// The same over the pixels of the picture.
    pub fn lay_over(&self, picture: &mut RgbaImage) {
        if let Some((of, pictures)) = self.overlaid()
            && of.cones.size_px == [picture.width(), picture.height()]
        {
            overlay::lay_over(picture, pictures, self.comparison, self.divider);
        }
    }

    /// The light that is shown, over that of cones, which `pixels` holds.
    pub fn lay_light_over(&self, pixels: &mut [[f32; 4]]) {
        if let Some((of, _)) = self.overlaid() {
            overlay::lay_light_over(pixels, of, self.comparison, self.divider);
        }
    }
}
