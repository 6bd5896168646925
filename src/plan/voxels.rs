//! Rules of the parts that move voxels and build the octree.

use super::effects::{ConesAsked, marches_shadows};
use super::keys::{Keys, Wanted};
use super::{Asked, Key, KeyBuilder, Part, Pass, WantedFor};
use crate::settings::{ColorBy, Discretizer, Filter, Lookup, Stretching, View};

/// Why no octree is called for, if so.
pub(super) fn octree_skipped(asked: &Asked) -> Option<&'static str> {
    if asked.scene.voxels() == 0 {
        return Some("no voxels in the grid");
    }
    match asked.settings.method.look.view {
        _ if asked.compares() => None,
        View::Mesh => Some("the mesh view shows no voxels"),
        View::ShadowMap => Some("the shadow map shows no voxels"),
        View::Surfaces if !reads_octree(asked) => Some("no cone and no shadow asks the octree"),
        View::Surfaces | View::Voxels | View::Ghost | View::Slice => None,
    }
}

/// Something calls for an octree, and there is something to make it of.
pub fn builds_octree(asked: &Asked) -> bool {
    octree_skipped(asked).is_none()
}

fn reads_octree(asked: &Asked) -> bool {
    ConesAsked::new(asked).any() || marches_shadows(asked)
}

/// The key is made unless there is a reason against it.
pub(super) fn unless(skipped: Option<&'static str>) -> Result<(), &'static str> {
    skipped.map_or(Ok(()), Err)
}

/// Why no cached voxels are moved, if so.
fn moving_skipped(asked: &Asked) -> Option<&'static str> {
    let moved = asked.scene.rigid_voxels + asked.scene.skinned_voxels;
    (moved == 0).then_some(match asked.settings.method.discretization.discretizer {
        Discretizer::Voxelize => "voxels are made from the posed triangles",
        Discretizer::Transform => "every object stretches, and is voxelized",
    })
}

/// Why no posed triangles are voxelized, if so.
fn voxelizing_skipped(asked: &Asked) -> Option<&'static str> {
    let stretching = asked.settings.method.discretization.stretching;
    (asked.scene.voxelized == 0).then_some(match stretching {
        Stretching::Move => "voxels are moved, not made from triangles",
        Stretching::Voxelize => "no object stretches: voxels are moved, not made from triangles",
    })
}

pub(super) fn caches(asked: &Asked) -> Wanted {
    unless(octree_skipped(asked).or(moving_skipped(asked)))?;
    Ok(Key::of(Part::Caches).digest("new caches", asked.contents.caches).build())
}

pub(super) fn pages(asked: &Asked, keys: &Keys) -> Wanted {
    let key = Key::of(Part::Pages).input("new caches", Part::Caches, keys.wanted(Part::Caches)?);
    let key = key.digest("objects entered or left the grid", asked.contents.residents);
    Ok(key.method("another anchor", &asked.settings.method.discretization.anchor).build())
}

pub(super) fn rigid(asked: &Asked, keys: &Keys) -> Wanted {
    let pages = keys.wanted(Part::Pages)?;
    unless((asked.scene.rigid_voxels == 0).then_some("no rigid object in the grid"))?;
    let key = Key::of(Part::RigidVoxels).input("new voxels in the pages", Part::Pages, pages);
    Ok(key.digest("rigid motion", asked.contents.rigid).build())
}

pub(super) fn skinned(asked: &Asked, keys: &Keys) -> Wanted {
    let pages = keys.wanted(Part::Pages)?;
    unless((asked.scene.skinned_voxels == 0).then_some("no skin in the grid"))?;
    let key = Key::of(Part::SkinnedVoxels).input("new voxels in the pages", Part::Pages, pages);
    Ok(key.digest("skinned motion", asked.contents.skinned).build())
}

pub(super) fn materials(asked: &Asked) -> Wanted {
    unless(octree_skipped(asked).or(voxelizing_skipped(asked)))?;
    let discretization = &asked.settings.method.discretization;
    let key = Key::of(Part::Materials).digest("new materials", asked.contents.caches);
    let key = key.method("another grid", &discretization.grid);
    Ok(key.method("other objects", &(discretization.discretizer, discretization.stretching)).build())
}

pub(super) fn columns(asked: &Asked, keys: &Keys) -> Wanted {
    keys.wanted(Part::Materials)?;
    let discretization = &asked.settings.method.discretization;
    let key = Key::of(Part::Columns).digest("triangles moved", asked.contents.voxelized);
    let key = key.method("another grid", &(discretization.grid, discretization.mode));
    // How many there are is learnt by method.
    Ok(key.method("other objects", &(discretization.discretizer, discretization.stretching)).build())
}

pub(super) fn posed_voxels(asked: &Asked, keys: &Keys) -> Wanted {
    let key = Key::of(Part::PosedVoxels).input("triangles moved", Part::Columns, keys.wanted(Part::Columns)?);
    let key = key.input("new materials", Part::Materials, keys.wanted(Part::Materials)?);
    Ok(key.method("another way to find cells", &asked.settings.method.discretization.cells).build())
}

pub(super) fn joined(keys: &Keys) -> Wanted {
    let key = from_moved(Key::of(Part::JoinedVoxels), keys)?;
    Ok(key.input("triangles moved", Part::PosedVoxels, keys.wanted(Part::PosedVoxels)?).build())
}

/// World voxels: moved in their pages, as far as there are any, or made from the posed triangles, or both.
pub(super) fn from_voxels(key: KeyBuilder, keys: &Keys) -> Result<KeyBuilder, &'static str> {
    if let Some(voxels) = keys.get(Part::JoinedVoxels) {
        return Ok(key.input("voxels moved", Part::JoinedVoxels, voxels));
    }
    if let Some(voxels) = keys.get(Part::PosedVoxels) {
        return Ok(key.input("voxels are made from the posed triangles", Part::PosedVoxels, voxels));
    }
    from_moved(key, keys)
}

fn from_moved(key: KeyBuilder, keys: &Keys) -> Result<KeyBuilder, &'static str> {
    let key = key.input("voxels moved", Part::Pages, keys.wanted(Part::Pages)?);
    let halves = [Part::RigidVoxels, Part::SkinnedVoxels].into_iter().filter_map(|part| Some((part, keys.get(part)?)));
    Ok(halves.fold(key, |key, (part, voxels)| key.input("voxels moved", part, voxels)))
}

/// What readers bind of an octree.
pub(super) fn from_octree(key: KeyBuilder, changed: &'static str, keys: &Keys) -> Result<KeyBuilder, &'static str> {
    let parts = [Part::Masks, Part::Topology, Part::Payload];
    parts.into_iter().try_fold(key, |key, part| Ok(key.input(changed, part, keys.wanted(part)?)))
}

pub(super) fn masks(asked: &Asked, keys: &Keys) -> Wanted {
    let discretization = &asked.settings.method.discretization;
    let key = from_voxels(Key::of(Part::Masks), keys)?.method("another filter", &discretization.filter);
    Ok(key.method("another dense level", &(discretization.depth(), discretization.deepest_dense())).build())
}

pub(super) fn topology(keys: &Keys) -> Wanted {
    Ok(Key::of(Part::Topology).input("voxels moved", Part::Masks, keys.wanted(Part::Masks)?).build())
}

pub(super) fn payload(keys: &Keys) -> Wanted {
    let key = Key::of(Part::Payload).input("voxels moved", Part::Masks, keys.wanted(Part::Masks)?);
    let key = key.input("voxels moved", Part::Topology, keys.wanted(Part::Topology)?);
    Ok(from_voxels(key, keys)?.build())
}

pub(super) fn object_numbers(asked: &Asked, keys: &Keys) -> Wanted {
    let octree = from_octree(Key::of(Part::ObjectNumbers), "colour by object", keys)?;
    let is_looked_at = asked.shows(View::Voxels) && asked.settings.method.look.color == ColorBy::Object;
    unless((!is_looked_at).then_some("colour is not by object"))?;
    Ok(from_voxels(octree, keys)?.build())
}

/// The pointers that a look-up follows, which must then be linked.
pub(super) fn followed(lookup: Lookup) -> Option<Part> {
    match lookup {
        Lookup::Ranks => None,
        Lookup::BlockPointers => Some(Part::BlockLinks),
        Lookup::NodePointers => Some(Part::NodeLinks),
    }
}

/// The way of look-up whose pointers the picture follows.
pub(super) fn lookup(asked: &Asked) -> Lookup {
    match asked.settings.method.look.view {
        View::Slice => asked.settings.method.look.slice.lookup,
        View::Surfaces if ConesAsked::new(asked).any() => asked.settings.method.cone_tracing.lookup,
        View::Surfaces | View::Voxels | View::Mesh | View::Ghost | View::ShadowMap => Lookup::Ranks,
    }
}

/// The window draws and follows pointers of this part.
pub(super) fn links_are_shown(part: Part, asked: &Asked) -> bool {
    part == Part::BlockLinks && asked.settings.method.look.pointers && asked.wanted_for == WantedFor::Picture
}

pub(super) fn links(part: Part, asked: &Asked, keys: &Keys) -> Wanted {
    let masks = keys.wanted(Part::Masks)?;
    let is_followed = followed(lookup(asked)) == Some(part) && asked.wanted_for == WantedFor::Picture;
    unless((!is_followed && !links_are_shown(part, asked)).then_some("no pointer is followed or shown"))?;
    let changed = "pointers are followed or shown";
    let key = Key::of(part).input(changed, Part::Masks, masks);
    Ok(key.input(changed, Part::Topology, keys.wanted(Part::Topology)?).build())
}

/// Why a pass of a part that is made is left out, if so.
pub(super) fn left_out(pass: Pass, asked: &Asked) -> Option<&'static str> {
    let filter = asked.settings.method.discretization.filter;
    match pass {
        Pass::GatherNearest => (filter != Filter::Nearest).then_some("the filter is split"),
        Pass::GatherSplit => (filter != Filter::Split).then_some("the filter is nearest"),
        _ => None,
    }
}
