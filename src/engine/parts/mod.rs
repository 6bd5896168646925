//! What the GPU holds: a file a kind of part, its buffers and how they are made. The frame is the list of
//! [`crate::plan::Part`]s in the order of section 4.1; the plan says which are made, and from what.

pub mod caches;
pub mod composed;
pub mod cones;
pub mod emission;
pub mod exact;
pub mod light;
pub mod links;
mod making;
pub mod masks;
pub mod object_numbers;
pub mod pages;
pub mod payload;
pub mod picture;
pub mod shadow_maps;
pub mod surfaces;
pub mod topology;
pub mod world_voxels;

use std::collections::HashMap;
use std::ops::Range;

pub use making::{Making, part_and_pass};

use super::EngineError;
use super::pool::{Keeper, Pinned, Pool, Turn};
use super::times::PassTiming;
use crate::data::mesh::MeshScene;
use crate::data::octree::OctreeParams;
use crate::digest::Digest;
use crate::gpu::{Gpu, GpuBuffer, GpuError, Recorder};
use crate::plan::{Held, Key, Part, PlannedPart};

/// Bytes that come back when the recording has run.
pub type Read = (GpuBuffer, Range<u64>);

/// A part that can be made: recorded into a frame, from the parts before it.
pub trait Made: Default {
    fn record(&mut self, making: &Making<'_>, parts: &Parts, frame: &mut Recorder)
    -> Result<Option<Read>, EngineError>;

    /// The bytes that the recording asked for have come.
    fn received(&mut self, _: &Gpu, _: &[u8]) -> Result<(), GpuError> {
        Ok(())
    }
}

/// One list of all parts: what is kept of each, and how it is found by its name.
macro_rules! parts {
    ($($part:ident => $pool:ident: $kind:ty),* $(,)?) => {
        #[derive(Debug, Default)]
        pub struct Parts {
            $(pub $pool: Pool<$kind>,)*
            /// Triangles and textures of what was shown so far.
            pub mesh: Option<MeshScene>,
            /// What was counted the last time, by method: what is likely the next time.
            last_sizes: HashMap<Digest, OctreeParams>,
            last_glossy_tiles: HashMap<Digest, u32>,
        }

        impl Parts {
            /// Records one part, whose inputs are made or recorded before.
            pub fn record(
                &mut self,
                making: &Making<'_>,
                frame: &mut Recorder,
                telling: Telling<'_>,
            ) -> Result<Option<Read>, EngineError> {
                self.forget_overwritten(making)?;
                match making.part {
                    $(Part::$part => make(self, |parts| &mut parts.$pool, making, frame, telling),)*
                }
            }

            /// Bytes that a part asked for have come.
            pub fn received(&mut self, planned: &PlannedPart, gpu: &Gpu, bytes: &[u8]) -> Result<(), GpuError> {
                match planned.part {
                    $(Part::$part => receive(&mut self.$pool, planned, gpu, bytes),)*
                }?;
                self.remember_counts(planned);
                Ok(())
            }

            pub fn pool(&mut self, part: Part) -> &mut dyn Keeper {
                match part {
                    $(Part::$part => &mut self.$pool,)*
                }
            }

            fn kept(&self, part: Part) -> &dyn Keeper {
                match part {
                    $(Part::$part => &self.$pool,)*
                }
            }
        }
    };
}

parts! {
    Caches => caches: caches::Caches,
    Pages => pages: pages::Pages,
    RigidVoxels => rigid: world_voxels::RigidVoxels,
    SkinnedVoxels => skinned: world_voxels::SkinnedVoxels,
    Masks => masks: masks::Masks,
    Topology => topology: topology::Topology,
    Payload => payload: payload::Payload,
    ObjectNumbers => object_numbers: object_numbers::ObjectNumbers,
    BlockLinks => block_links: links::Links,
    NodeLinks => node_links: links::Links,
    Emission => emission: emission::LeafEmission,
    ShadowMaps => shadow_maps: shadow_maps::ShadowMaps,
    Light => light: light::Light,
    Irradiance => irradiance: light::Irradiance,
    SurfaceImage => surfaces: surfaces::Surfaces,
    DirectLight => direct: surfaces::DirectLight,
    DiffuseLight => diffuse: cones::DiffuseLight,
    GlossyTiles => glossy_tiles: cones::GlossyTiles,
    SpecularLight => specular: cones::SpecularLight,
    ComposedLight => composed: composed::ComposedLight,
    Exposure => exposure: composed::Exposure,
    ExactBits => exact_bits: exact::ExactBits,
    ExactMasks => exact_masks: exact::ExactMasks,
    Picture => pictures: picture::Drawn,
    Comparison => comparisons: exact::Comparison,
}

/// What a recording is told beside what it makes.
type Telling<'a> = (&'a Turn, &'a Pinned);

fn make<T: Made>(
    parts: &mut Parts,
    pool: fn(&mut Parts) -> &mut Pool<T>,
    making: &Making<'_>,
    frame: &mut Recorder,
    (turn, pinned): Telling<'_>,
) -> Result<Option<Read>, EngineError> {
    let key = making.own_key()?;
    let mut content = pool(parts).begin(key, turn, pinned);
    let recorded = content.record(making, parts, frame);
    pool(parts).put(key, content);
    recorded
}

fn receive<T: Made>(pool: &mut Pool<T>, planned: &PlannedPart, gpu: &Gpu, bytes: &[u8]) -> Result<(), GpuError> {
    pool.get_mut(&planned.key).map_or(Ok(()), |content| content.received(gpu, bytes))
}

impl Parts {
    /// Voxels that lie in pages which are written anew, or that are moved again in the same pages.
    fn forget_overwritten(&mut self, making: &Making<'_>) -> Result<(), EngineError> {
        if matches!(making.part, Part::Pages | Part::RigidVoxels) {
            let pages = making.key(Part::Pages)?;
            self.rigid.forget_made_from(pages);
        }
        if matches!(making.part, Part::Pages | Part::SkinnedVoxels) {
            let pages = making.key(Part::Pages)?;
            self.skinned.forget_made_from(pages);
        }
        Ok(())
    }

    fn remember_counts(&mut self, planned: &PlannedPart) {
        let method = planned.key.method();
        if let Some(counts) = self.masks.get(&planned.key).and_then(|masks| masks.counts.as_ref()) {
            self.last_sizes.insert(method, counts.params);
        }
        if let Some(count) = self.glossy_tiles.get(&planned.key).and_then(|tiles| tiles.count) {
            self.last_glossy_tiles.insert(method, count);
        }
    }

    /// Room for an octree of about the size of the last one of this method; a share of that, where estimates are
    /// forced to be too small.
    fn likely_sizes(&self, method: Digest, share: f64) -> Option<OctreeParams> {
        let roomy = self.last_sizes.get(&method)?.with_room();
        Some(if share < 1.0 { roomy.with_each(|count| (f64::from(count) * share) as u32) } else { roomy })
    }

    fn likely_glossy_tiles(&self, method: Digest, share: f64) -> Option<u32> {
        // None needs no kernel; a few more than last time otherwise.
        let roomy = |&count: &u32| if count == 0 { 0 } else { count + count / 8 + 8 };
        self.last_glossy_tiles.get(&method).map(roomy).map(|count| (f64::from(count) * share) as u32)
    }

    /// Whether a part counted more than what is behind it had room for.
    pub fn has_outgrown(&self, planned: &PlannedPart) -> bool {
        match planned.part {
            Part::Masks => self.masks.get(&planned.key).is_some_and(masks::Masks::has_outgrown),
            Part::GlossyTiles => self.glossy_tiles.get(&planned.key).is_some_and(cones::GlossyTiles::has_outgrown),
            _ => false,
        }
    }

    /// Whether a part can be recorded: how large its inputs are is known, or likely.
    pub fn is_ready(&self, planned: &PlannedPart) -> bool {
        let is_sized = |(part, key): (Part, &Key)| match part {
            Part::Masks if planned.part == Part::Comparison => true,
            Part::Masks => self.masks.get(key).is_none_or(|masks| masks.sizes().is_some()),
            Part::GlossyTiles => self.glossy_tiles.get(key).is_none_or(|tiles| tiles.room().is_some()),
            _ => true,
        };
        planned.key.inputs().all(is_sized)
    }

    /// The keys of all that is made, the most recently used last. Moved voxels are where their pages are, and gone
    /// with them.
    pub fn held(&self) -> Held {
        let mut held = Held::default();
        for part in Part::ALL {
            let mut keys = self.kept(part).keys();
            if matches!(part, Part::RigidVoxels | Part::SkinnedVoxels) {
                keys.retain(|(_, key)| key.inputs().all(|(pages, key)| held.holds(pages, key)));
            }
            keys.sort_by_key(|(used, _)| *used);
            keys.into_iter().for_each(|(_, key)| held.hold(part, key));
        }
        held
    }

    pub fn timings(&self, part: Part, key: &Key) -> &[PassTiming] {
        self.kept(part).timings(key)
    }

    /// Drops what was used least recently and is not pinned; whether there was anything.
    pub fn drop_oldest(&mut self, pinned: &Pinned) -> bool {
        let oldest = Part::ALL.into_iter().filter_map(|part| Some((self.kept(part).oldest(pinned)?, part))).min();
        oldest.map(|(_, part)| self.pool(part).drop_oldest(pinned)).is_some()
    }

    /// What failed on its way holds nothing.
    pub fn fail(&mut self) {
        Part::ALL.into_iter().for_each(|part| self.pool(part).fail());
    }
}
