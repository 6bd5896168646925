//! `octolume render --reference`: the picture of light that the path tracer makes, on the CPU.

use std::path::Path;

use clap::Args;
use octolume::accuracy::path_tracer::{Film, Options, PixelSampling, Term};
use octolume::accuracy::picture_error::Display;
use octolume::disk_cache::DiskCache;
use octolume::experiment::{Traced, traced};
use octolume::export;
use octolume::prepare::Prepared;
use octolume::settings::lighting::Lighting;
use octolume::settings::{Settings, SurfaceView, View};

use super::output;
use super::usage::Usage;

const SAMPLES: u32 = 64;

/// The path tracer in place of cones.
#[derive(Debug, Args)]
#[command(next_help_heading = "Reference")]
pub struct ReferenceOptions {
    /// Traces paths through the triangles instead, on the CPU: what cones are measured against. Shows
    /// --view final, direct, diffuse, specular or ao, with --bounces 0 the first bounce and else all
    #[arg(long)]
    pub reference: bool,
    /// Paths a pixel and lobe; otherwise 64
    #[arg(long, value_name = "N", requires = "reference", value_parser = clap::value_parser!(u32).range(1..))]
    samples: Option<u32>,
    /// Another number, other noise; otherwise 0
    #[arg(long, value_name = "N", requires = "reference")]
    seed: Option<u64>,
    /// Spreads a pixel's paths over all of it, so that edges are smooth; otherwise all go through its centre
    #[arg(long, requires = "reference")]
    smooth_edges: bool,
}

impl ReferenceOptions {
    /// Is the view one that paths show? `is_named`: by an option, not by settings.
    pub fn choose_view(&self, settings: &mut Settings, is_named: bool) -> Result<(), Usage> {
        let look = &mut settings.method.look;
        if look.view != View::Surfaces && !is_named {
            (look.view, look.surface) = (View::Surfaces, SurfaceView::Final);
        }
        let is_light = look.view == View::Surfaces && Term::of(look.surface, 0).is_some();
        let possible = || Usage("paths show --view final, direct, diffuse, specular or ao".to_owned());
        if is_light { Ok(()) } else { Err(possible()) }
    }

    /// Traces a picture, writes it, and says how far off it may be. Returns what its light was multiplied by.
    pub fn draw(
        &self,
        (prepared, disk): (&Prepared, Option<&DiskCache>),
        settings: &Settings,
        (size_px, file, is_transparent): ([u32; 2], &Path, bool),
    ) -> anyhow::Result<f64> {
        let pixel = if self.smooth_edges { PixelSampling::Area } else { PixelSampling::Centre };
        let options = Options { seed: self.seed.unwrap_or(0), pixel, ..Options::new(size_px) };
        let paths = (options, self.samples.unwrap_or(SAMPLES));
        let Traced { film, warnings } =
            output::with_progress("tracing paths", |progress| traced((prepared, disk), settings, paths, progress))?;
        output::warnings(&warnings);
        output::message(&summary(&film, settings));
        write(&film, settings, file, is_transparent)
    }
}

fn summary(film: &Film, settings: &Settings) -> String {
    let term = Term::of(settings.method.look.surface, settings.method.lighting.bounces);
    let error = term.map(|term| film.standard_error(term)).unwrap_or_default();
    let percent = |share: f64| 100.0 * share;
    format!(
        "{} samples a pixel in {:.1} s; standard error {:.2} % of the mean (root mean square over the pixels), {:.3} % of the whole picture",
        film.samples(),
        film.secs(),
        percent(error.relative),
        percent(error.relative_of_mean)
    )
}

fn write(film: &Film, settings: &Settings, file: &Path, is_transparent: bool) -> anyhow::Result<f64> {
    let part = settings.method.look.surface;
    // What lies behind a pixel that is covered in part must not tint it.
    let sky_nits = if is_transparent { [0.0; 3] } else { settings.method.lighting.sky_nits };
    let light = film.shown(part, &Lighting { sky_nits, ..settings.method.lighting.clone() }).unwrap_or_default();
    if output::is_exr(file) {
        export::write_exr(file, film.size_px(), &light)?;
        return Ok(1.0);
    }
    let display = Display::new(&settings.method.look, part, &light);
    let picture = if is_transparent {
        display.cut_out(&light, film.size_px())
    } else {
        image::DynamicImage::from(display.picture(&light, film.size_px())).into_rgba8()
    };
    if settings.method.look.is_exposed() {
        output::message(&format!("exposure {:+.2} stops", display.exposure.log2()));
    }
    output::picture(file, &picture, settings)?;
    Ok(display.exposure)
}
