//! What a part was made from: a digest of all of it, and each input by name, so that a plan can say which differs.
//!
//! ```text
//! settings, poses, sizes ─► Digest ─┐
//! keys of the inputs ───────────────┴─► Key
//! ```
//!
//! Two keys are equal where all that went into them is. What belongs to the method (how it is computed) is told
//! apart from what belongs to the shot (what is looked at): times of one method stay together while a clip plays.

use std::sync::Arc;

use serde::Serialize;

use super::Part;
use crate::digest::Digest;

/// Shared: keys hold those of their inputs.
#[derive(Clone, Debug)]
pub struct Key(Arc<Ingredients>);

#[derive(Debug)]
struct Ingredients {
    digest: Digest,
    /// Of what belongs to the method alone.
    method: Digest,
    inputs: Vec<Input>,
}

#[derive(Clone, Debug)]
struct Input {
    /// What a plan says where it differs.
    changed: &'static str,
    digest: Digest,
    from: Option<(Part, Key)>,
}

impl PartialEq for Key {
    fn eq(&self, other: &Self) -> bool {
        self.digest() == other.digest()
    }
}

impl Eq for Key {}

impl Key {
    pub fn of(part: Part) -> KeyBuilder {
        KeyBuilder { part, inputs: Vec::new(), method: Vec::new() }
    }

    pub fn digest(&self) -> Digest {
        self.0.digest
    }

    /// Of what belongs to the method: the same while a clip plays.
    pub fn method(&self) -> Digest {
        self.0.method
    }

    /// The parts that it is made from.
    pub fn inputs(&self) -> impl Iterator<Item = (Part, &Key)> {
        self.0.inputs.iter().filter_map(|input| input.from.as_ref().map(|(part, key)| (*part, key)))
    }

    /// One of these keys is that of an input, or of an input's.
    pub fn is_made_from(&self, keys: &[Key]) -> bool {
        self.inputs().any(|(_, input)| keys.contains(input) || input.is_made_from(keys))
    }

    /// The first thing that differs from the key before, looked for in the inputs of inputs too.
    pub fn difference(&self, before: &Key) -> &'static str {
        let twin = |input: &Input| {
            let is_twin = |other: &&Input| {
                let parts = [input, *other].map(|input| input.from.as_ref().map(|(part, _)| *part));
                other.changed == input.changed && parts[0] == parts[1]
            };
            before.0.inputs.iter().find(is_twin).cloned()
        };
        for input in &self.0.inputs {
            match twin(input) {
                Some(other) if other.digest == input.digest => {}
                Some(other) => {
                    return match (&input.from, &other.from) {
                        (Some((_, now)), Some((_, before))) => now.difference(before),
                        _ => input.changed,
                    };
                }
                None => return input.changed,
            }
        }
        "less is asked for"
    }
}

/// Takes down what a part is made from, in the order in which a plan looks for differences.
pub struct KeyBuilder {
    part: Part,
    inputs: Vec<Input>,
    method: Vec<Digest>,
}

impl KeyBuilder {
    /// Something of the shot; `changed`: what a plan says where it differs.
    pub fn shot<T: Serialize + ?Sized>(self, changed: &'static str, value: &T) -> Self {
        self.digest(changed, Digest::of(value))
    }

    /// The same, of a content that has a digest.
    pub fn digest(mut self, changed: &'static str, digest: Digest) -> Self {
        self.inputs.push(Input { changed, digest, from: None });
        self
    }

    /// Something of the method.
    pub fn method<T: Serialize + ?Sized>(mut self, changed: &'static str, value: &T) -> Self {
        let digest = Digest::of(value);
        self.method.extend([Digest::of(changed), digest]);
        self.digest(changed, digest)
    }

    /// Another part. `changed` is said where the part was no input before; else what differs in it.
    pub fn input(mut self, changed: &'static str, part: Part, key: &Key) -> Self {
        self.method.push(key.method());
        self.inputs.push(Input { changed, digest: key.digest(), from: Some((part, key.clone())) });
        self
    }

    pub fn build(self) -> Key {
        let part = [self.part as u8];
        // The words tell inputs apart that only some keys of a part have.
        let inputs = self.inputs.iter().flat_map(|input| [input.changed.as_bytes(), input.digest.bytes()]);
        let digest = Digest::of_bytes(&[&part[..]].into_iter().chain(inputs).collect::<Vec<_>>());
        let method = self.method.iter().map(Digest::bytes);
        let method = Digest::of_bytes(&[&part[..]].into_iter().chain(method).collect::<Vec<_>>());
        Key(Arc::new(Ingredients { digest, method, inputs: self.inputs }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn voxels(pose: u32, anchor: u32) -> Key {
        Key::of(Part::RigidVoxels).shot("the pose", &pose).method("the anchor", &anchor).build()
    }

    fn masks(pose: u32, anchor: u32, filter: u32) -> Key {
        let key = Key::of(Part::Masks).input("the voxels", Part::RigidVoxels, &voxels(pose, anchor));
        key.method("the filter", &filter).build()
    }

    #[test]
    fn keys_are_equal_where_all_that_went_in_is() {
        assert_eq!(masks(1, 2, 3), masks(1, 2, 3));
        assert_ne!(masks(1, 2, 3), masks(4, 2, 3));
        assert_ne!(masks(1, 2, 3), masks(1, 2, 4));
        assert_ne!(Key::of(Part::Masks).build(), Key::of(Part::Topology).build());
    }

    #[test]
    fn the_first_difference_is_found_in_inputs_of_inputs() {
        let before = masks(1, 2, 3);
        assert_eq!(masks(4, 2, 5).difference(&before), "the pose");
        assert_eq!(masks(1, 2, 5).difference(&before), "the filter");
        let more =
            Key::of(Part::Masks).input("the voxels", Part::RigidVoxels, &voxels(1, 2)).method("the filter", &3_u32);
        let more = more.method("the level", &1_u32).build();
        assert_eq!(more.difference(&before), "the level");
        assert_eq!(before.difference(&more), "less is asked for");
    }

    #[test]
    fn the_method_does_not_follow_the_shot() {
        assert_eq!(masks(1, 2, 3).method(), masks(9, 2, 3).method());
        assert_ne!(masks(1, 2, 3).method(), masks(1, 2, 4).method());
        assert_ne!(masks(1, 2, 3).method(), masks(1, 7, 3).method());
    }
}
