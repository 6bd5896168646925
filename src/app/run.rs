//! Opens the window, and opens it again where its GPU is lost.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use anyhow::anyhow;

use super::rescue::{Kept, Rescue};
use super::{App, NoApp, Start, device, folders};
use crate::settings::NodeNames;

/// A device that is lost sooner than this after the last one is not replaced.
const WORTH_ANOTHER_DEVICE: Duration = Duration::from_secs(10);

const ICON: &[u8] = include_bytes!("../../assets/octolume.png");

/// Opens the window on a file, or on a built-in scene by its name, and returns when it is closed.
/// Without a display, or a GPU for it, the error is one sentence. When the GPU is lost, the window
/// is opened again on a new device, with scene and settings kept.
pub fn run(scene: &Path, start: Start, adapter: Option<&str>) -> anyhow::Result<()> {
    if !device::has_display() {
        return Err(anyhow!("there is no display to open a window on; the subcommands work without one"));
    }
    let rescue = Rescue::default();
    let mut opened = Instant::now();
    let remembered_in = start.host.remembered_in.clone();
    open_window(adapter, &rescue, &remembered_in, |context| App::new(context, scene, start))?;
    while let Some(kept) = rescue.take() {
        if opened.elapsed() < WORTH_ANOTHER_DEVICE {
            return Err(anyhow!("{}", kept.cause));
        }
        opened = Instant::now();
        open_window(adapter, &rescue, &remembered_in, |context| App::again(context, kept))?;
    }
    Ok(())
}

fn open_window(
    adapter: Option<&str>,
    rescue: &Rescue,
    remembered_in: &Option<PathBuf>,
    app: impl FnOnce(&eframe::CreationContext<'_>) -> Result<App, NoApp>,
) -> anyhow::Result<()> {
    let options = eframe::NativeOptions {
        viewport: viewport(),
        renderer: eframe::Renderer::Wgpu,
        // Where nothing is remembered, there is no file, and nothing is saved.
        persistence_path: Some(remembered_in.clone().unwrap_or_default()),
        persist_window: remembered_in.is_some(),
        wgpu_options: egui_wgpu::WgpuConfiguration { wgpu_setup: device::setup(adapter), ..Default::default() },
        ..Default::default()
    };
    let create: eframe::AppCreator<'_> = Box::new(move |context| {
        let mut app = app(context)?;
        app.rescue = rescue.clone();
        Ok(Box::new(app))
    });
    eframe::run_native(folders::NAME, options, create).map_err(|error| match error {
        eframe::Error::WinitEventLoop(_) => anyhow!("the display cannot be opened; the subcommands work without one"),
        error => anyhow!("no window can be opened: {error}"),
    })
}

/// The desktop knows the window by the name of `assets/octolume.desktop`.
fn viewport() -> egui::ViewportBuilder {
    let viewport = egui::ViewportBuilder::default().with_app_id("octolume");
    let viewport = viewport.with_inner_size([1440.0, 900.0]).with_min_inner_size([640.0, 400.0]);
    match eframe::icon_data::from_png_bytes(ICON) {
        Ok(icon) => viewport.with_icon(icon),
        Err(_) => viewport,
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
        let (settings, host) = (self.settings.clone(), self.host.clone());
        let start = Start { settings, names: NodeNames::default(), opening, disk, host };
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_window_has_a_name_and_an_icon() {
        let viewport = viewport();
        assert_eq!(viewport.app_id.as_deref(), Some("octolume"));
        let icon = viewport.icon.expect("an icon");
        assert_eq!((icon.width, icon.height), (256, 256));
        assert!(include_str!("../../assets/octolume.desktop").contains("StartupWMClass=octolume"));
    }
}
