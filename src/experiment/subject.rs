//! What an experiment is made with.

use std::sync::Arc;

use crate::prepare::Prepared;
use crate::settings::Settings;

/// What is measured, and how often.
#[derive(Clone)]
pub struct Subject {
    pub prepared: Arc<Prepared>,
    pub settings: Settings,
    /// Frames measured.
    pub runs: u32,
}
