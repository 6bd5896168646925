//! Lights of the scene by name, as a command line gives them: by the name of the light or of the node
//! that carries it. In: names, changes and a scene. Out: edits in a [`Lighting`], and a sentence for
//! each name that several lights share.

use std::collections::BTreeSet;

use super::Lighting;
use super::lighting::{LightEdit, LightPart};
use super::listed_names::listed;
use crate::scene::Scene;

/// What is to become of the lights that have a name.
#[derive(Clone, Debug, PartialEq)]
pub struct LightChange {
    /// Of a light or a node. A name that several lights share means all of them.
    pub name: String,
    /// Carried out one after the other.
    pub parts: Vec<LightPart>,
}

#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LightError {
    #[error("{scene} has no light called \"{name}\"; {known}")]
    UnknownName { scene: String, name: String, known: String },
    #[error("{scene}: node {node} has no light that could be changed; {known}")]
    UnknownNode { scene: String, node: usize, known: String },
    #[error("{scene}: light \"{name}\" cannot be changed: {cause}")]
    Impossible { scene: String, name: String, cause: String },
}

impl Lighting {
    /// Adds changes to the edits, or changes nothing. Returns a sentence for each name that is not the
    /// name of one light alone. An edit of a light that the scene does not have is an error too.
    pub fn change(&mut self, scene: &Scene, changes: &[LightChange]) -> Result<Vec<String>, LightError> {
        if let Some(&node) = self.edits.keys().find(|node| light_of(scene, **node).is_none()) {
            return Err(LightError::UnknownNode { scene: scene.name.clone(), node, known: known(scene) });
        }
        let mut notes = Vec::new();
        let mut edits = self.edits.clone();
        for change in changes {
            let impossible = |cause| {
                let (scene, name) = (scene.name.clone(), change.name.clone());
                LightError::Impossible { scene, name, cause }
            };
            let nodes = carriers(scene, &change.name)?;
            if nodes.len() > 1 {
                let (name, count) = (&change.name, nodes.len());
                notes.push(format!("{}: {count} lights are called \"{name}\"; all of them are changed", scene.name));
            }
            for (node, light) in nodes {
                let edit = edits.entry(node).or_insert_with(|| LightEdit::of(light));
                for part in &change.parts {
                    edit.set(*part).map_err(impossible)?;
                }
                edit.check(&format!("light \"{}\"", change.name)).map_err(impossible)?;
            }
        }
        self.edits = edits;
        Ok(notes)
    }
}

fn light_of(scene: &Scene, node: usize) -> Option<&crate::scene::Light> {
    scene.lights.get(scene.nodes.get(node)?.light?)
}

/// Nodes that carry a light of this name, or have the name and carry any.
fn carriers<'a>(scene: &'a Scene, name: &str) -> Result<Vec<(usize, &'a crate::scene::Light)>, LightError> {
    let lights = (0..scene.nodes.len()).filter_map(|node| Some((node, light_of(scene, node)?)));
    let called: Vec<_> = lights.filter(|(node, light)| light.name == name || scene.nodes[*node].name == name).collect();
    if called.is_empty() {
        let (scene_name, name) = (scene.name.clone(), name.to_owned());
        return Err(LightError::UnknownName { scene: scene_name, name, known: known(scene) });
    }
    Ok(called)
}

/// The lights that can be changed.
fn known(scene: &Scene) -> String {
    let lights = (0..scene.nodes.len()).filter_map(|node| light_of(scene, node));
    let names: BTreeSet<&str> = lights.map(|light| &*light.name).collect();
    listed("its lights are", "it has no lights", &names)
}

#[cfg(test)]
mod tests {
    use super::super::visibility::tests::scene;
    use super::*;
    use crate::scene::{Light, LightKind};

    /// The village with a light "bulb" at roof and lamp, and a "sun" at the tree.
    fn village() -> Scene {
        let mut scene = scene();
        let light = |name: &str, kind| Light { name: name.to_owned(), kind, color: [1.0; 3], intensity: 2.0 };
        scene.lights = vec![light("bulb", LightKind::POINT), light("sun", LightKind::Directional)];
        for (node, light) in [(1, 0), (4, 1), (5, 0)] {
            scene.nodes[node].light = Some(light);
        }
        scene
    }

    fn change(name: &str, parts: &[LightPart]) -> LightChange {
        LightChange { name: name.to_owned(), parts: parts.to_vec() }
    }

    #[test]
    fn lights_are_called_like_themselves_or_their_node() {
        let scene = village();
        let mut lighting = Lighting::default();
        let notes = lighting.change(&scene, &[change("bulb", &[LightPart::Candela(7.0)])]);
        assert_eq!(notes, Ok(vec!["village: 2 lights are called \"bulb\"; all of them are changed".to_owned()]));
        let notes = lighting.change(&scene, &[change("lamp", &[LightPart::On(false), LightPart::Color([0.5; 3])])]);
        assert_eq!(notes, Ok(Vec::new()));
        assert_eq!(lighting.edits.keys().collect::<Vec<_>>(), [&1, &5]);
        assert!(lighting.edits[&1].on && lighting.edits[&1].intensity == 7.0);
        assert!(!lighting.edits[&5].on && lighting.edits[&5].intensity == 7.0, "changes add up");
    }

    #[test]
    fn what_cannot_be_changed_is_named_and_nothing_is() {
        let scene = village();
        let mut lighting = Lighting::default();
        let mut refused = |changes: &[LightChange]| {
            let error = lighting.change(&scene, changes).expect_err("a refusal").to_string();
            assert!(lighting.edits.is_empty());
            error
        };
        let dim = change("bulb", &[LightPart::Candela(1.0)]);
        let error = refused(&[dim.clone(), change("Bulb", &[])]);
        assert_eq!(error, "village has no light called \"Bulb\"; its lights are \"bulb\", \"sun\"");
        let error = refused(&[dim, change("tree", &[LightPart::Candela(1.0)])]);
        assert_eq!(
            error,
            "village: light \"tree\" cannot be changed: a directional light has no candela; its unit is lux"
        );
        let error = refused(&[change("sun", &[LightPart::Lux(-1.0)])]);
        assert!(error.contains("must be finite and not negative"), "{error}");
        let error = Lighting::default().change(&super::super::visibility::tests::scene(), &[change("sun", &[])]);
        let error = error.expect_err("none").to_string();
        assert_eq!(error, "village has no light called \"sun\"; it has no lights");
    }

    #[test]
    fn edits_of_another_scene_are_refused() {
        let mut lighting = Lighting::default();
        lighting.change(&village(), &[change("sun", &[LightPart::On(false)])]).expect("known");
        let error = lighting.change(&scene(), &[]).expect_err("another scene").to_string();
        assert_eq!(error, "village: node 4 has no light that could be changed; it has no lights");
    }
}
