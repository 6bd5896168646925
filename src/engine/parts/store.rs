//! What the GPU holds: a pool of every kind of part, found by the type of what it keeps. Nothing here knows a kind;
//! the list of them is in `kinds`.

use std::any::Any;
use std::collections::BTreeMap;
use std::ops::Range;

use super::likely::Likely;
use super::making::Making;
use crate::data::mesh::{MeshScene, PosedMesh};
use crate::data::octree::Slot;
use crate::engine::EngineError;
use crate::engine::pool::{Keeper, Pinned, Pool, Turn};
use crate::engine::times::PassTiming;
use crate::gpu::{Gpu, GpuBuffer, GpuError, Recorder};
use crate::plan::{Held, Key, Keys, Part, PlannedPart};
use crate::settings::Hidden;

/// Bytes that come back when the recording has run.
pub type Read = (GpuBuffer, Range<u64>);

/// What a recording is told beside what it makes.
pub type Telling<'a> = (&'a Turn, &'a Pinned);

/// A kind of part: its buffers, and how they are recorded into a frame, from the parts before it.
pub trait Made: Default + 'static {
    /// What a plan calls it. No other kind is called so.
    const PART: Part;

    fn record(&mut self, making: &Making<'_>, parts: &Parts, frame: &mut Recorder)
    -> Result<Option<Read>, EngineError>;

    /// The bytes that the recording asked for have come.
    fn received(&mut self, _: &Gpu, _: &[u8]) -> Result<(), GpuError> {
        Ok(())
    }
}

#[derive(Default)]
pub struct Parts {
    /// Each of the one kind that is called so.
    pools: BTreeMap<Part, Box<dyn Keeper>>,
    /// Triangles and textures of what was shown so far.
    pub mesh: Option<MeshScene>,
    pub likely: Likely,
}

impl Parts {
    /// Of these keys, where it is made, or recorded before in this frame.
    pub fn get<T: Made>(&self, keys: &Keys) -> Option<&T> {
        self.of_key(keys.get(T::PART)?)
    }

    /// The same, where somebody says that it must be there.
    pub fn made<T: Made>(&self, keys: &Keys) -> Result<&T, EngineError> {
        Ok(self.get(keys).ok_or_else(missing::<T>)?)
    }

    /// Of these keys, where it is made.
    pub fn finished<T: Made>(&self, keys: &Keys) -> Option<&T> {
        self.pool()?.finished(keys.get(T::PART)?)
    }

    pub fn of_key<T: Made>(&self, key: &Key) -> Option<&T> {
        self.pool()?.get(key)
    }

    /// The posed triangles of what is not hidden, in the space that is drawn in.
    pub fn posed_mesh(
        &self,
        making: &Making<'_>,
        matrices: &mut Slot,
        space_from_world: &glam::DMat4,
    ) -> Result<PosedMesh<'_>, EngineError> {
        self.posed_mesh_without(&making.request.shot.hidden, making, matrices, space_from_world)
    }

    /// The same of fewer objects.
    pub fn posed_mesh_without(
        &self,
        left_out: &Hidden,
        making: &Making<'_>,
        matrices: &mut Slot,
        space_from_world: &glam::DMat4,
    ) -> Result<PosedMesh<'_>, EngineError> {
        let mesh = self.mesh.as_ref().ok_or_else(|| GpuError::Missing { label: "mesh vertices".to_owned() })?;
        let posed = (&*making.request.shot.pose, left_out);
        Ok(PosedMesh::new(making.gpu, mesh, matrices, posed, space_from_world)?)
    }

    /// Records an instance, whose inputs are made or recorded before.
    pub fn record<T: Made>(
        &mut self,
        making: &Making<'_>,
        frame: &mut Recorder,
        (turn, pinned): Telling<'_>,
    ) -> Result<Option<Read>, EngineError> {
        let key = making.own_key()?;
        let mut content: T = self.pool_mut()?.begin(key, turn, pinned);
        let recorded = content.record(making, self, frame);
        self.pool_mut()?.put(key, content);
        recorded
    }

    /// Bytes that a part asked for have come.
    pub fn received<T: Made>(&mut self, planned: &PlannedPart, gpu: &Gpu, bytes: &[u8]) -> Result<(), EngineError> {
        let content: Option<&mut T> = self.pool_mut()?.get_mut(&planned.key);
        Ok(content.map_or(Ok(()), |content| content.received(gpu, bytes))?)
    }

    fn pool<T: Made>(&self) -> Option<&Pool<T>> {
        let pool: &dyn Any = &**self.pools.get(&T::PART)?;
        pool.downcast_ref()
    }

    /// An error where another kind is called the same.
    fn pool_mut<T: Made>(&mut self) -> Result<&mut Pool<T>, GpuError> {
        let pool = self.pools.entry(T::PART).or_insert_with(|| Box::new(Pool::<T>::default()));
        let pool: &mut dyn Any = &mut **pool;
        pool.downcast_mut().ok_or_else(missing::<T>)
    }
}

fn missing<T: Made>() -> GpuError {
    GpuError::Missing { label: format!("{:?}", T::PART) }
}

/// What is done with all kinds alike.
impl Parts {
    /// The keys of all that is made, the most recently used last. Moved voxels are where their pages are, and gone
    /// with them.
    pub fn held(&self) -> Held {
        let mut held = Held::default();
        for (&part, pool) in &self.pools {
            let mut keys = pool.keys();
            if matches!(part, Part::RigidVoxels | Part::SkinnedVoxels) {
                keys.retain(|(_, key)| key.inputs().all(|(pages, key)| held.holds(pages, key)));
            }
            keys.sort_by_key(|(used, _)| *used);
            keys.into_iter().for_each(|(_, key)| held.hold(part, key));
        }
        held
    }

    pub fn timings(&self, part: Part, key: &Key) -> &[PassTiming] {
        self.pools.get(&part).map_or(&[], |pool| pool.timings(key))
    }

    /// A frame called for it.
    pub fn touch(&mut self, part: Part, key: &Key, frame: u64) {
        if let Some(pool) = self.pools.get_mut(&part) {
            pool.touch(key, frame);
        }
    }

    /// It is written completely.
    pub fn finish(&mut self, planned: &PlannedPart, timings: Vec<PassTiming>) {
        if let Some(pool) = self.pools.get_mut(&planned.part) {
            pool.finish(&planned.key, timings);
        }
    }

    /// Nothing of this part holds any more.
    pub fn forget(&mut self, part: Part) {
        if let Some(pool) = self.pools.get_mut(&part) {
            pool.forget();
        }
    }

    /// The same of what was made from this input.
    pub fn forget_made_from(&mut self, part: Part, input: &Key) {
        if let Some(pool) = self.pools.get_mut(&part) {
            pool.forget_made_from(input);
        }
    }

    /// Drops what was used least recently and is not pinned; whether there was anything.
    pub fn drop_oldest(&mut self, pinned: &Pinned) -> bool {
        let oldest = self.pools.values_mut().filter_map(|pool| Some((pool.oldest(pinned)?, pool)));
        oldest.min_by_key(|(used, _)| *used).map(|(_, pool)| pool.drop_oldest(pinned)).is_some()
    }

    /// What failed on its way holds nothing.
    pub fn fail(&mut self) {
        self.pools.values_mut().for_each(|pool| pool.fail());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, Default)]
    struct Kind;

    #[derive(Debug, Default)]
    struct CalledTheSame;

    impl Made for Kind {
        const PART: Part = Part::Masks;

        fn record(&mut self, _: &Making<'_>, _: &Parts, _: &mut Recorder) -> Result<Option<Read>, EngineError> {
            Ok(None)
        }
    }

    impl Made for CalledTheSame {
        const PART: Part = Part::Masks;

        fn record(&mut self, _: &Making<'_>, _: &Parts, _: &mut Recorder) -> Result<Option<Read>, EngineError> {
            Ok(None)
        }
    }

    #[test]
    fn a_second_kind_of_the_same_name_is_an_error() {
        let (mut parts, key) = (Parts::default(), Key::of(Part::Masks).build());
        let turn = Turn { frame: 1, moment: Default::default(), has_room: true };
        parts.pool_mut::<Kind>().expect("its pool").begin(&key, &turn, &Pinned::new());
        assert!(parts.of_key::<Kind>(&key).is_some() && parts.of_key::<CalledTheSame>(&key).is_none());
        let error = parts.pool_mut::<CalledTheSame>().expect_err("the pool of another");
        assert_eq!(error, GpuError::Missing { label: "Masks".to_owned() });
    }
}
