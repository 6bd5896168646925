//! The list of all kinds of parts, and what depends on which of them a part is. It imports every kind, and none of
//! them imports it.

use super::caches::Caches;
use super::columns::Columns;
use super::composed::{ComposedLight, Exposure};
use super::cones::{DiffuseLight, GlossyTiles, SpecularLight};
use super::emission::LeafEmission;
use super::exact::{Comparison, ExactBits, ExactMasks};
use super::joined_voxels::JoinedVoxels;
use super::light::{Irradiance, Light};
use super::links::{BlockLinks, NodeLinks};
use super::making::Making;
use super::masks::Masks;
use super::materials::Materials;
use super::object_numbers::ObjectNumbers;
use super::pages::Pages;
use super::payload::Payload;
use super::picture::Drawn;
use super::posed_voxels::PosedVoxels;
use super::shadow_maps::ShadowMaps;
use super::store::{Made, Parts, Read, Telling};
use super::surfaces::{DirectLight, Surfaces};
use super::topology::Topology;
use super::world_voxels::{RigidVoxels, SkinnedVoxels};
use crate::engine::EngineError;
use crate::gpu::{Gpu, Recorder};
use crate::plan::{Key, Part, PlannedPart};

type Recorded = Result<Option<Read>, EngineError>;

/// What is done by a kind of its own.
struct Kind {
    record: fn(&mut Parts, &Making<'_>, &mut Recorder, Telling<'_>) -> Recorded,
    received: fn(&mut Parts, &PlannedPart, &Gpu, &[u8]) -> Result<(), EngineError>,
}

impl Kind {
    const fn of<T: Made>() -> Self {
        Self { record: Parts::record::<T>, received: Parts::received::<T> }
    }
}

/// Finds the kind that a part is by what the kinds are called: the compiler sees to it that none is missing, and that
/// no two are called the same.
macro_rules! kinds {
    ($($kind:ident),* $(,)?) => {
        fn kind_of(part: Part) -> Kind {
            match part {
                $($kind::PART => Kind::of::<$kind>(),)*
            }
        }
    };
}

kinds! {
    Caches, Pages, RigidVoxels, SkinnedVoxels, Materials, Columns, PosedVoxels, JoinedVoxels,
    Masks, Topology, Payload, ObjectNumbers, BlockLinks, NodeLinks, LeafEmission,
    ShadowMaps, Light, Irradiance,
    Surfaces, DirectLight, DiffuseLight, GlossyTiles, SpecularLight, ComposedLight, Exposure,
    ExactBits, ExactMasks, Drawn, Comparison,
}

/// Records one part, whose inputs are made or recorded before.
pub fn record(parts: &mut Parts, making: &Making<'_>, frame: &mut Recorder, telling: Telling<'_>) -> Recorded {
    forget_overwritten(parts, making)?;
    (kind_of(making.part).record)(parts, making, frame, telling)
}

/// Voxels that lie in pages which are written anew, or that are moved again in the same pages.
fn forget_overwritten(parts: &mut Parts, making: &Making<'_>) -> Result<(), EngineError> {
    for moved in [Part::RigidVoxels, Part::SkinnedVoxels] {
        if making.part == Part::Pages || making.part == moved {
            parts.forget_made_from(moved, making.key(Part::Pages)?);
        }
    }
    Ok(())
}

/// Bytes that a part asked for have come.
pub fn received(parts: &mut Parts, planned: &PlannedPart, gpu: &Gpu, bytes: &[u8]) -> Result<(), EngineError> {
    (kind_of(planned.part).received)(parts, planned, gpu, bytes)?;
    let method = planned.key.method();
    if planned.part == Part::Masks
        && let Some(counted) = parts.of_key::<Masks>(&planned.key).and_then(|masks| masks.counts.as_ref())
    {
        parts.likely.note_sizes(method, counted.params);
    }
    if planned.part == Part::PosedVoxels
        && let Some(voxels) = parts.of_key::<PosedVoxels>(&planned.key)
        && let Some(needed) = voxels.needed()
        && let Some((_, columns)) = planned.key.inputs().find(|(part, _)| *part == Part::Columns)
    {
        let lacked_room = voxels.has_outgrown();
        parts.likely.note_fragments(columns.method(), needed, lacked_room);
    }
    if planned.part == Part::GlossyTiles
        && let Some(count) = parts.of_key::<GlossyTiles>(&planned.key).and_then(|tiles| tiles.count)
    {
        parts.likely.note_glossy_tiles(method, count);
    }
    Ok(())
}

/// Whether a part counted more than what is behind it had room for.
pub fn has_outgrown(parts: &Parts, planned: &PlannedPart) -> bool {
    match planned.part {
        Part::Columns => parts.of_key(&planned.key).is_some_and(Columns::has_outgrown),
        Part::PosedVoxels => parts.of_key(&planned.key).is_some_and(PosedVoxels::has_outgrown),
        Part::Masks => parts.of_key(&planned.key).is_some_and(Masks::has_outgrown),
        Part::GlossyTiles => parts.of_key(&planned.key).is_some_and(GlossyTiles::has_outgrown),
        _ => false,
    }
}

/// Whether a part lacks some of what it is, for want of room.
pub fn is_incomplete(parts: &Parts, planned: &PlannedPart) -> bool {
    planned.part == Part::PosedVoxels && has_outgrown(parts, planned)
}

/// Whether a part can be recorded: how large its inputs are is known, or likely.
pub fn is_ready(parts: &Parts, planned: &PlannedPart) -> bool {
    let is_sized = |(part, key): (Part, &Key)| match part {
        Part::Columns => parts.of_key::<Columns>(key).is_none_or(|columns| columns.count().is_some()),
        Part::Masks if planned.part == Part::Comparison => true,
        Part::Masks => parts.of_key::<Masks>(key).is_none_or(|masks| masks.sizes().is_some()),
        Part::GlossyTiles => parts.of_key::<GlossyTiles>(key).is_none_or(|tiles| tiles.room().is_some()),
        _ => true,
    };
    planned.key.inputs().all(is_sized)
}
