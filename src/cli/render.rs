//! `octolume render`: pictures, one or a sequence.

use std::path::{Path, PathBuf};

use clap::Args;
use octolume::export;
use octolume::prepare::Stores;
use octolume::settings::{Settings, View};

use super::look_options::LookOptions;
use super::options::{Common, Moment};
use super::output::{self, Told};
use super::reference::ReferenceOptions;
use super::session::{self, Session};
use super::usage::Usage;
use super::values::{self, Frames, Size};

/// Size of a picture where neither option nor settings tell.
const SIZE_PX: [u32; 2] = [1280, 720];

/// Draws a scene into a .png file, which carries its settings, or an .exr file of linear light
#[derive(Debug, Args)]
pub struct Render {
    /// A .gltf or .glb file, or the name of a built-in scene
    scene: PathBuf,
    /// The .png file to write, or with a view of surfaces .exr: linear, unclamped; with --frames, -0000 and so
    /// on goes before its extension; - writes a PNG to standard output
    #[arg(short, long, value_name = "OUT.png|OUT.exr")]
    output: PathBuf,
    /// Pixels; otherwise as --settings says, or 1280x720
    #[arg(long, value_name = "WxH")]
    size: Option<Size>,
    /// Draws frames A to B, both included, of the animation
    #[arg(long, value_name = "A:B", requires = "fps", conflicts_with = "time")]
    frames: Option<Frames>,
    /// Frames a second: frame k is at k / FPS seconds
    #[arg(long, value_name = "FPS", value_parser = values::frames_per_sec, requires = "frames")]
    fps: Option<f64>,
    /// Leaves the background of a PNG transparent, and the sky
    #[arg(long)]
    transparent: bool,
    #[command(flatten)]
    reference: ReferenceOptions,
    #[command(flatten)]
    look: LookOptions,
    #[command(flatten)]
    moment: Moment,
    #[command(flatten)]
    common: Common,
}

impl Render {
    pub fn run(&self) -> anyhow::Result<()> {
        let mut settings = self.settings()?;
        let size_px = self.size_px(&settings);
        if self.reference.reference {
            return self.trace(&mut settings, size_px);
        }
        let mut session = Session::open(&self.scene, &self.common, &mut settings)?;
        for (file, time_secs) in self.pictures(&settings) {
            settings.shot.motion.time_secs = time_secs;
            self.draw(&mut session, &settings, size_px, &file)?;
            if settings.method.look.is_exposed() && settings.method.look.exposure_stops.is_none() {
                let stops = session.engine.exposure().log2();
                output::message(&format!("exposure {stops:+.2} stops"));
                settings.method.look.exposure_stops = Some(stops);
            }
        }
        Ok(())
    }

    fn draw(&self, session: &mut Session, settings: &Settings, size_px: [u32; 2], file: &Path) -> anyhow::Result<()> {
        if settings.method.look.view == View::Ghost {
            session.take_exact(settings)?;
        }
        session.run(settings, size_px)?;
        if output::is_exr(file) {
            // Where nothing is to be seen, all of it is black.
            let nothing = || vec![[0.0; 4]; size_px[0] as usize * size_px[1] as usize];
            let light = session.engine.read_surfaces()?.unwrap_or_else(nothing);
            return Ok(export::write_exr(file, size_px, &light)?);
        }
        let picture = if self.transparent { session.engine.read_cut_out() } else { session.engine.read_image() };
        output::picture(file, &picture?, settings)
    }

    /// Pictures of the path tracer, which needs no GPU.
    fn trace(&self, settings: &mut Settings, size_px: [u32; 2]) -> anyhow::Result<()> {
        let disk = self.common.disk_cache();
        let prepared = session::prepare_only(
            &self.scene,
            &self.common,
            Stores { disk: disk.as_ref(), ..Stores::default() },
            settings,
        )?;
        let mut told = Told::default();
        for (file, time_secs) in self.pictures(settings) {
            settings.shot.motion.time_secs = time_secs;
            told.tell(&prepared.past_clip(&settings.shot.motion));
            let to = (size_px, file.as_path(), self.transparent);
            let exposure = self.reference.draw((&prepared, disk.as_ref()), settings, to)?;
            if settings.method.look.is_exposed() {
                settings.method.look.exposure_stops.get_or_insert(exposure.log2());
            }
        }
        Ok(())
    }

    fn settings(&self) -> anyhow::Result<Settings> {
        let mut settings = self.common.settings()?;
        self.moment.apply(&mut settings);
        self.look.apply(&mut settings.method.look);
        settings.check().map_err(Usage)?;
        if self.reference.reference {
            self.reference.choose_view(&mut settings, self.look.names_view())?;
        }
        self.check_output()?;
        if output::is_exr(&self.output) && self.transparent {
            return Err(
                Usage("an .exr file tells by its alpha where nothing is; --transparent is for PNG".to_owned()).into()
            );
        }
        if output::is_exr(&self.output) && settings.method.look.view != View::Surfaces {
            let cause = "an .exr file holds linear light, which only views of surfaces give, such as --view final";
            return Err(Usage(cause.to_owned()).into());
        }
        Ok(settings)
    }

    /// A picture is PNG or OpenEXR, by its name; `-` is standard output.
    fn check_output(&self) -> Result<(), Usage> {
        let file = self.output.display();
        let is_png = self.output.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png"));
        match output::is_standard(&self.output) {
            true if self.frames.is_some() => Err(Usage("frames need a file each, and - is standard output".to_owned())),
            false if !is_png && !output::is_exr(&self.output) => {
                Err(Usage(format!("{file} ends in neither .png nor .exr")))
            }
            _ => Ok(()),
        }
    }

    fn size_px(&self, settings: &Settings) -> [u32; 2] {
        self.size.map(|Size(size_px)| size_px).or(settings.shot.size_px).unwrap_or(SIZE_PX)
    }

    /// Files to write, each with its time in seconds.
    fn pictures(&self, settings: &Settings) -> Vec<(PathBuf, f64)> {
        match (self.frames, self.fps) {
            (Some(Frames { first, last }), Some(fps)) => {
                (first..=last).map(|frame| (numbered(&self.output, frame), f64::from(frame) / fps)).collect()
            }
            _ => vec![(self.output.clone(), settings.shot.motion.time_secs)],
        }
    }
}

/// `walk.png` → `walk-0007.png`.
fn numbered(file: &Path, frame: u32) -> PathBuf {
    let mut name = file.file_stem().unwrap_or_default().to_owned();
    name.push(format!("-{frame:04}"));
    if let Some(extension) = file.extension() {
        name.push(".");
        name.push(extension);
    }
    file.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_numbered_before_the_extension() {
        assert_eq!(numbered(Path::new("a/walk.png"), 7), Path::new("a/walk-0007.png"));
        assert_eq!(numbered(Path::new("walk.v2.png"), 12_345), Path::new("walk.v2-12345.png"));
    }
}
