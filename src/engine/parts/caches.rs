//! The voxels of every object, each cache once however many objects use it (section 3.1).

use super::{Made, Making, Parts, Read};
use crate::data::light::pack_emission;
use crate::data::octree::NO_BLOCK;
use crate::engine::EngineError;
use crate::gpu::{GpuBuffer, Recorder};
use crate::plan::Part;

#[derive(Debug, Default)]
pub struct Caches {
    pub voxels: Option<GpuBuffer>,
    /// Where any object has a skin.
    pub joints: Option<GpuBuffer>,
    /// In units of the brightest; made only where something emits.
    pub emission: Option<GpuBuffer>,
    starts: Vec<CacheStart>,
}

/// Where a cache begins among all that is uploaded.
#[derive(Clone, Copy, Debug)]
pub struct CacheStart {
    pub first_voxel: u32,
    /// Distance from the cache's first joint record.
    pub joints_skew: u32,
    /// Distance from its first emission record; [`NO_BLOCK`] without any.
    pub emission_skew: u32,
}

impl Caches {
    pub fn start(&self, cache: usize) -> CacheStart {
        self.starts[cache]
    }
}

impl Made for Caches {
    const PART: Part = Part::Caches;

    fn record(&mut self, making: &Making<'_>, _: &Parts, _: &mut Recorder) -> Result<Option<Read>, EngineError> {
        let prepared = &making.request.prepared;
        let (mut voxels, mut joints, mut emission) = (Vec::new(), Vec::new(), Vec::new());
        self.starts.clear();
        for cache in &prepared.caches {
            let no_emission = cache.emission.is_empty();
            self.starts.push(CacheStart {
                first_voxel: voxels.len() as u32,
                joints_skew: (voxels.len() - joints.len()) as u32,
                emission_skew: if no_emission { NO_BLOCK } else { (voxels.len() - emission.len()) as u32 },
            });
            voxels.extend_from_slice(&cache.voxels);
            joints.extend_from_slice(&cache.joints);
            emission.extend(cache.emission.iter().map(|voxel| pack_emission(*voxel, prepared.brightest_emission)));
        }
        let gpu = making.gpu;
        self.voxels = Some(gpu.upload("cache voxels", &voxels)?);
        self.joints = if joints.is_empty() { None } else { Some(gpu.upload("cache joints", &joints)?) };
        self.emission = if emission.is_empty() { None } else { Some(gpu.upload("cache emission", &emission)?) };
        Ok(None)
    }
}
