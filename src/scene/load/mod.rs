//! Opens glTF 2.0 files, .gltf and .glb.
//!
//! In: a path or bytes. Out: a [`Scene`] with everything in our words, or one sentence that names
//! file, object and cause. What can be read in part is read, and a warning says what was left out
//! or repaired. Only this folder knows the format.
//!
//! ```text
//! bytes ─► container ─► json (checked, repaired) ─► source (uri, meshopt) ─► accessor ─┬─► attributes, draco ─► mesh, skin
//!                                                                                      ├─► animation, instances
//!                                                   image ─► texture, spec_gloss ──────┴─► material, nodes, cameras, lights
//! ```

mod accessor;
mod accessor_check;
mod animation;
mod attributes;
mod budget;
mod cameras;
mod container;
mod draco;
mod error;
mod file_object;
mod image;
mod instances;
mod json;
mod keys;
mod lights;
mod material;
mod mesh;
mod meshopt;
mod nodes;
mod options;
mod shapes;
mod skin;
mod source;
mod spec_gloss;
mod subjects;
mod texture;
mod unique_names;
mod uri;
mod usage_check;
mod weights;

use std::path::Path;

use gltf::json::Root;

pub use error::LoadError;
pub use options::{OpenOptions, SceneChoice};

use self::{
    budget::Budget,
    error::{Defect, one_line},
    nodes::Hierarchy,
    shapes::Shapes,
    source::Source,
    texture::Textures,
    unique_names::UniqueNames,
};
use super::{Clip, Mesh, Node, Scene, Warning};
use crate::digest::Digest;
use crate::progress::Progress;

/// Opens a file. `progress` counts its images, meshes and clips, and can cancel.
pub fn open(path: &Path, progress: &Progress) -> Result<Scene, LoadError> {
    open_with(path, &OpenOptions::default(), progress)
}

/// [`open`], with choices.
pub fn open_with(path: &Path, options: &OpenOptions, progress: &Progress) -> Result<Scene, LoadError> {
    let file = path.display().to_string();
    let budget = Budget::new(options.memory_budget_bytes);
    let bytes = uri::read_file(path, &budget).map_err(|cause| LoadError::Unreadable { file: file.clone(), cause })?;
    let mut scene = read(&bytes, path.parent(), options, &budget, progress).map_err(|defect| defect.in_file(&file))?;
    scene.name = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    scene.source = Some(path.to_owned());
    Ok(scene)
}

/// Opens a file already in memory; `name` stands in for its path in messages. Without
/// `base_dir`, nothing beside it can be read.
pub fn open_bytes(name: &str, bytes: &[u8], base_dir: Option<&Path>, progress: &Progress) -> Result<Scene, LoadError> {
    open_bytes_with(name, bytes, base_dir, &OpenOptions::default(), progress)
}

/// [`open_bytes`], with choices.
pub fn open_bytes_with(
    name: &str,
    bytes: &[u8],
    base_dir: Option<&Path>,
    options: &OpenOptions,
    progress: &Progress,
) -> Result<Scene, LoadError> {
    let budget = Budget::new(options.memory_budget_bytes);
    let scene = read(bytes, base_dir, options, &budget, progress).map_err(|defect| defect.in_file(name))?;
    Ok(Scene { name: name.to_owned(), ..scene })
}

fn read(
    bytes: &[u8],
    base_dir: Option<&Path>,
    options: &OpenOptions,
    budget: &Budget,
    progress: &Progress,
) -> Result<Scene, Defect> {
    let mut warnings = Vec::new();
    let source = Source::read(bytes, base_dir, budget, progress, &mut warnings)?;
    let root = &source.root;
    accessor_check::check(&source, progress, &mut warnings)?;
    usage_check::check(&source, &mut warnings);
    let shown_scene = shown_scene(root, options, &mut warnings)?;
    let (cameras, camera_places) = cameras::load(root, &mut warnings);
    let (lights, light_places) = lights::load(root, &mut warnings);
    let hierarchy = Hierarchy::new(root)?;
    let shapes = Shapes::load(&source, progress, &mut warnings)?;
    let places = [&shapes.by_node[..], &camera_places, &light_places];
    let mut nodes = hierarchy.nodes(root, shown_scene, places, &mut warnings)?;
    let mut meshes = shapes.meshes;
    let skins = skin::load_all(&source, &hierarchy.rank, &mut warnings)?;
    skin::check_roots(&skins, &nodes, &mut warnings);
    skin::bind(&mut nodes, &mut meshes, &skins, &hierarchy, &mut warnings)?;
    let clips = read_clips(&source, &hierarchy, (&nodes, &meshes), progress, &mut warnings)?;
    instances::expand(&source, &hierarchy.rank, &mut nodes, &mut warnings)?;
    let mut textures = Textures::load(&source, progress, &mut warnings)?;
    let materials = material::load(&source, &mut textures, &mut warnings)?;
    let mut warnings = readable(warnings);
    subjects::find(&mut warnings, root, &hierarchy.rank);
    let mut scene = Scene {
        name: String::new(),
        source: None,
        digest: Some(Digest::of_file(bytes)),
        nodes,
        meshes,
        materials,
        textures: textures.list,
        skins,
        clips,
        clip_of_all: None,
        cameras,
        lights,
        scene_names: scene_names(root),
        shown_scene,
        memory_bytes: budget.spent_bytes(),
        extensions: root.extensions_used.clone(),
        warnings,
    };
    scene.add_clip_of_all();
    Ok(scene)
}

/// A line each, and not more than a person reads.
fn readable(mut warnings: Vec<Warning>) -> Vec<Warning> {
    const MOST: usize = 200;
    let more = warnings.len().saturating_sub(MOST);
    warnings.truncate(MOST);
    warnings.iter_mut().for_each(|warning| warning.sentence = one_line(&warning.sentence));
    if more > 0 {
        warnings.push(Warning::new(format!("{more} more warnings about the file")));
    }
    warnings
}

fn scene_names(root: &Root) -> Vec<String> {
    let scenes = root.scenes.iter().enumerate();
    scenes.map(|(index, scene)| scene.name.clone().unwrap_or_else(|| format!("scene {index}"))).collect()
}

fn shown_scene(root: &Root, options: &OpenOptions, warnings: &mut Vec<Warning>) -> Result<Option<usize>, Defect> {
    let names = scene_names(root);
    if let Some(wanted) = &options.scene {
        let known = names.iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", ");
        let cause =
            || format!("there is no {wanted}; the file holds {}", if known.is_empty() { "none" } else { &known });
        return wanted.among(&names).map(Some).ok_or_else(|| Defect::new("scenes", cause()));
    }
    let shown = root.scene.map(|scene| scene.value()).or((!names.is_empty()).then_some(0));
    if let Some(shown) = shown.filter(|_| names.len() > 1) {
        let sentence = format!("the file holds {} scenes; \"{}\" is shown", names.len(), names[shown]);
        warnings.push(Warning::new(sentence));
    }
    Ok(shown)
}

fn read_clips(
    source: &Source,
    hierarchy: &Hierarchy,
    shown: (&[Node], &[Mesh]),
    progress: &Progress,
    warnings: &mut Vec<Warning>,
) -> Result<Vec<Clip>, Defect> {
    let animations = &source.root.animations;
    let mut names = UniqueNames::default();
    progress.add_total(animations.len() as u64);
    let clips = animations.iter().enumerate().map(|(index, animation)| {
        let mut clip = animation::load(source, index, animation, &hierarchy.rank, shown, warnings)?;
        clip.name = names.of(clip.name);
        progress.advance(1)?;
        Ok(clip)
    });
    clips.collect()
}
