//! The window.

/// Opens the window on a scene.
pub fn run(
    _scene: &std::path::Path,
    _settings: crate::settings::Settings,
    _adapter: Option<&str>,
) -> anyhow::Result<()> {
    anyhow::bail!("no window")
}
