//! The plan of a frame: a graph of parts, each with the key it would be made from. A part runs where nobody holds
//! that key, is reused where somebody does, and is skipped where nothing calls for it; nothing is decided twice.
//! The panel, `octolume plan` and the engine read the same rows.
//!
//! ```text
//! Asked (a method of a request) ─► Keys ─┐
//! Held (what is on the GPU) ─────────────┴─► FramePlan: what runs in flow order, and a row a pass
//! ```
//!
//! Static scenes, and what nobody looks at, cost nothing.

mod asked;
mod effects;
mod held;
mod key;
mod keys;
mod light;
mod part;
mod pass;
mod planned;
mod row;
mod rows;
mod rules;
mod surfaces;
mod views;
mod voxels;

use std::collections::BTreeSet;

use crate::digest::Digest;

pub use asked::{Asked, Contents, SceneFacts, WantedFor};
pub use effects::{ConesAsked, only_opacity};
pub use held::Held;
pub use key::{Key, KeyBuilder};
pub use keys::Keys;
pub use light::makes_shadow_maps;
pub use part::Part;
pub use pass::Pass;
pub use planned::{FramePlan, PlannedPart};
pub use row::{Row, State};
pub use views::{light_shown, shows_light, tells_mean_light};
pub use voxels::builds_octree;

/// Decides a frame. Pure: the same arguments give the same plan. The first method is the one that is shown.
pub fn plan(methods: &[Asked], held: &Held) -> FramePlan {
    let keys: Vec<Keys> = methods.iter().map(|asked| Keys::new(asked, held)).collect();
    let to_run = to_run(methods, &keys, held);
    let rows = rows::rows(methods, &keys, (&to_run, held));
    FramePlan { rows, to_run, keys }
}

/// Consumers before what they are made from: a part that is not there is made only for somebody who runs, or who
/// looks at it.
fn to_run(methods: &[Asked], keys: &[Keys], held: &Held) -> Vec<PlannedPart> {
    let mut needed: BTreeSet<(Part, Digest)> = BTreeSet::new();
    let mut to_run: Vec<PlannedPart> = Vec::new();
    for part in Part::ALL.into_iter().rev() {
        let mut made: Vec<PlannedPart> = Vec::new();
        for (method, (asked, keys)) in methods.iter().zip(keys).enumerate() {
            let Some(key) = keys.get(part) else { continue };
            let is_called_for = is_looked_at(part, asked) || needed.contains(&(part, key.digest()));
            if is_called_for && !held.holds(part, key) && !made.iter().any(|planned| planned.key == *key) {
                needed.extend(key.inputs().map(|(input, key)| (input, key.digest())));
                made.push(PlannedPart { part, key: key.clone(), method });
            }
        }
        to_run.extend(made.into_iter().rev());
    }
    to_run.reverse();
    to_run
}

/// Whether a part that is made needs this pass of it.
pub fn calls_for(pass: Pass, asked: &Asked) -> bool {
    rows::left_out(pass, asked).is_none()
}

/// Shown or reported itself, not only through what is made from it: counts of masks, words of the node under the
/// cursor, the exposure of a picture. Where it was dropped for want of memory, it is made again.
fn is_looked_at(part: Part, asked: &Asked) -> bool {
    match part {
        Part::Masks | Part::Topology | Part::Payload | Part::Comparison | Part::Picture => true,
        Part::ComposedLight | Part::Exposure | Part::GlossyTiles => true,
        Part::Light | Part::Irradiance => part == light_shown(asked) && tells_mean_light(asked),
        Part::BlockLinks | Part::NodeLinks => voxels::links_are_shown(part, asked),
        _ => false,
    }
}
