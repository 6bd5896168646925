//! The lights of a scene, as `info` tells of them.

use octolume::lights::{KnownLight, LightSource, Shines};
use octolume::prepare::Prepared;
use octolume::scene::LightKind;
use octolume::settings::Settings;
use serde::Serialize;

/// A light after all edits.
#[derive(Serialize)]
pub struct LightFacts {
    name: String,
    /// "scene", "sun" or "added".
    source: &'static str,
    /// The node that carries it, by name.
    node: Option<String>,
    kind: &'static str,
    intensity: f64,
    unit: &'static str,
    /// Linear RGB.
    color: [f64; 3],
    /// Scene units; none: as far as it goes.
    range: Option<f32>,
    /// Of spot lights: where it begins to fade, and where it ends, from its axis.
    cone_degrees: Option<[f32; 2]>,
    shines: bool,
    /// Why it does not, if so.
    cause: Option<&'static str>,
    /// Not as in the file.
    edited: bool,
}

/// Those of the scene in the order of its nodes, our own sun, then what was added.
pub fn lights(prepared: &Prepared, settings: &Settings) -> anyhow::Result<Vec<LightFacts>> {
    let known = prepared.known_lights(settings)?;
    let facts = known.into_iter().map(|light| LightFacts::new(light, prepared, settings));
    Ok(facts.collect())
}

impl LightFacts {
    fn new(known: KnownLight, prepared: &Prepared, settings: &Settings) -> Self {
        let KnownLight { source, name, light, shines, .. } = known;
        let nodes = &prepared.scene.nodes;
        let (source, node, edited) = match source {
            LightSource::Node(node) => ("scene", Some(node), settings.method.lighting.edits.contains_key(&node)),
            LightSource::Sun => ("sun", None, false),
            LightSource::Added(_) => ("added", None, false),
        };
        Self {
            name,
            source,
            node: node.map(|node| nodes[node].name.clone()),
            kind: light.kind.name(),
            intensity: light.intensity,
            unit: light.kind.unit(),
            color: light.color,
            range: light.kind.range(),
            cone_degrees: match light.kind {
                LightKind::Spot { inner_cone_radians, outer_cone_radians, .. } => {
                    Some([inner_cone_radians, outer_cone_radians].map(f32::to_degrees))
                }
                LightKind::Directional | LightKind::Point { .. } => None,
            },
            shines: shines == Shines::Yes,
            cause: cause(shines),
            edited,
        }
    }

    /// For a person.
    pub fn text(&self) -> String {
        let carried = self.node.as_ref().filter(|node| **node != self.name);
        let by = carried.map(|node| format!(" at node \"{node}\"")).unwrap_or_default();
        let name = match self.source {
            "sun" => "own sun".to_owned(),
            "added" => format!("added light \"{}\"", self.name),
            _ => format!("light \"{}\"{by}", self.name),
        };
        let color = self.color.map(|channel| format!("{channel:.3}")).join(",");
        let edited = if self.edited { ", changed" } else { "" };
        let state = self.cause.unwrap_or("on");
        format!("{name}: {}, {} {} of {color}, {state}{edited}", self.kind, self.intensity, self.unit)
    }
}

fn cause(shines: Shines) -> Option<&'static str> {
    match shines {
        Shines::Yes => None,
        Shines::Off => Some("off"),
        Shines::Black => Some("black"),
        Shines::Hidden => Some("its node is hidden"),
        Shines::Nowhere => Some("without a finite place or direction"),
    }
}
