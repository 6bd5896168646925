//! What a window is opened with.

use super::host::Host;
use crate::disk_cache::DiskCache;
use crate::scene::load::OpenOptions;
use crate::settings::{NodeNames, Settings};

/// What a window starts with.
#[derive(Clone, Debug, Default)]
pub struct Start {
    pub settings: Settings,
    /// What is hidden or shown alone, looked up in the first scene.
    pub names: NodeNames,
    /// How files are opened; the scene that is asked for is one of the first file.
    pub opening: OpenOptions,
    /// Where voxels are kept; `None`: nowhere.
    pub disk: Option<DiskCache>,
    pub host: Host,
}
