//! The picture that cones are measured against: a path tracer over the posed triangles, on all cores.
//!
//! In: a prepared scene and settings (pose, what is hidden, lights, sky, emission, camera). Out: a [`Film`]
//! that gets better by every step, with its own standard error. Written from the rendering equation and
//! glTF's BRDF; it shares no shading code with the shaders. Same options, same bits, whatever the threads.
//!
//! ```text
//! PosedTriangles ─ surface ─ brdf ┐
//!                  lights ────────┴ path ──► film
//!                  sampler, camera ┘
//! ```

mod brdf;
mod camera;
mod film;
mod kept;
mod key;
mod lights;
mod options;
mod path;
mod sampler;
mod surface;

use std::time::Instant;

use glam::DVec3;
use rayon::prelude::*;

pub use film::{Film, PixelSums, StandardError, Term};
pub use options::{Options, PixelSampling, Reflection};

use super::posed_triangles::{PosedSurface, PosedTriangles};
use crate::lights::posed_lights;
use crate::prepare::kept::TextureHashes;
use crate::prepare::{LightsError, Prepared};
use crate::progress::{Cancelled, Progress};
use crate::scene::Pose;
use crate::settings::Settings;
use camera::CameraRays;
use lights::{Emitters, Punctual};
use sampler::Sampler;
use surface::SurfaceReader;

/// All that paths need to know.
pub struct TracedScene<'a> {
    triangles: PosedTriangles<'a>,
    /// By surface of the triangles.
    readers: Vec<SurfaceReader<'a>>,
    punctual: Vec<Punctual>,
    emitters: Emitters,
    sky_nits: DVec3,
    /// What is farther occludes nothing.
    occlusion_cells: f64,
    rays: CameraRays,
    options: Options,
    /// What they hold, for [`Self::key`].
    textures: &'a TextureHashes,
}

impl<'a> TracedScene<'a> {
    /// Objects at no finite place are left out: [`Self::warnings`].
    pub fn new(prepared: &'a Prepared, settings: &Settings, options: Options) -> Result<Self, LightsError> {
        let pose = prepared.pose(&settings.shot.motion)?;
        let hidden = prepared.hidden(&settings.shot.visibility, &pose)?;
        let triangles = PosedTriangles::new(prepared, &settings.shot.motion, &hidden)?;
        let shown = prepared.shown_nodes(&settings.shot.visibility, &pose)?;
        let lighting = &settings.method.lighting;
        let readers = readers(prepared, &triangles, &pose, (lighting.emission, options.reflection));
        let lights = posed_lights(&prepared.scene, &pose, lighting, &shown, prepared.emits(lighting));
        let grid = &prepared.grid;
        let camera = prepared.camera(settings, &pose, options.size_px);
        Ok(Self {
            punctual: lights.iter().map(|light| Punctual::new(light, grid)).collect(),
            emitters: Emitters::new(triangles.tree(), &readers),
            sky_nits: DVec3::from_array(lighting.sky_nits),
            occlusion_cells: settings.method.cone_tracing.occlusion_cells(grid.cells(), grid.span),
            rays: CameraRays::new(&camera, grid, options.size_px),
            textures: prepared.texture_hashes(),
            triangles,
            readers,
            options,
        })
    }

    /// What is left out, a sentence each.
    pub fn warnings(&self) -> &[String] {
        &self.triangles.warnings
    }

    pub fn new_film(&self) -> Film {
        Film::new(self.options.size_px)
    }

    /// One more sample a pixel. Counts rows to `progress`; a film whose step was cancelled has rows that are
    /// a sample ahead, which the next step leaves alone.
    pub fn step(&self, film: &mut Film, progress: &Progress) -> Result<(), Cancelled> {
        let started = Instant::now();
        let width = film.size_px()[0] as usize;
        let index = film.samples();
        let rows = film.pixels.par_chunks_mut(width.max(1)).zip(&mut film.samples).enumerate();
        let result = rows.filter(|(_, (_, samples))| **samples == index).try_for_each(|(row, (pixels, samples))| {
            self.sample_row(row, index, pixels);
            *samples += 1;
            progress.advance(1)
        });
        film.secs += started.elapsed().as_secs_f64();
        result
    }

    /// As many samples a pixel as asked for, less those that the film has.
    pub fn trace(&self, film: &mut Film, samples: u32, progress: &Progress) -> Result<(), Cancelled> {
        let missing = samples.saturating_sub(film.samples());
        progress.add_total(u64::from(missing) * u64::from(film.size_px()[1]));
        (0..missing).try_for_each(|_| self.step(film, progress))
    }

    fn sample_row(&self, row: usize, index: u32, pixels: &mut [PixelSums]) {
        let first = row * pixels.len();
        for (column, sums) in pixels.iter_mut().enumerate() {
            let mut sampler = Sampler::new(self.options.seed, (first + column) as u64, u64::from(index));
            let [x, y] = match self.options.pixel {
                PixelSampling::Centre => [0.5; 2],
                PixelSampling::Area => {
                    let [x, y, _, _] = sampler.four();
                    [x, y]
                }
            };
            let ray = self.rays.through([column as f64 + x, row as f64 + y]);
            sums.add(&self.sample(ray, &mut sampler));
        }
    }
}

/// By surface.
fn readers<'a>(
    prepared: &'a Prepared,
    triangles: &PosedTriangles,
    pose: &Pose,
    (emission, reflection): (f64, Reflection),
) -> Vec<SurfaceReader<'a>> {
    let scene = &prepared.scene;
    let reader = |surface: &PosedSurface| {
        let object = &prepared.objects[surface.object].object;
        let primitive = &scene.meshes[object.mesh].primitives[surface.primitive];
        let material = scene.material_of(primitive);
        let is_bumpy = material.normal_texture.is_some();
        SurfaceReader {
            primitive,
            material,
            textures: &prepared.textures,
            tangents: if is_bumpy { scene.posed_tangents(object, surface.primitive, pose) } else { Vec::new() },
            emission,
            reflection,
        }
    };
    triangles.surfaces().iter().map(reader).collect()
}
