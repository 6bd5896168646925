//! Opens glTF 2.0 files, .gltf and .glb.
//!
//! In: a path or bytes. Out: a [`Scene`] with everything in our words, or one sentence that names
//! file, object and cause. What can be read in part is read, and a warning says what was left out
//! or repaired. Only this folder knows the format: `source` and `accessor` turn the file into
//! checked numbers, the others turn those into the parts of a scene.

mod accessor;
mod animation;
mod error;
mod material;
mod mesh;
mod nodes;
mod skin;
mod source;
mod weights;

use std::path::Path;

use rayon::prelude::*;

pub use error::LoadError;

use self::{
    error::{Defect, counted},
    material::Textures,
    nodes::Hierarchy,
    source::{SUPPORTED_EXTENSIONS, Source},
};
use super::{Clip, Mesh, Node, Scene};
use crate::progress::Progress;

/// Opens a file. `progress` counts its images, meshes and clips, and can cancel.
pub fn open(path: &Path, progress: &Progress) -> Result<Scene, LoadError> {
    let file = path.display().to_string();
    let bytes = match std::fs::read(path) {
        Ok(bytes) => bytes,
        Err(source) => return Err(LoadError::Unreadable { file, source }),
    };
    let mut scene = read(&bytes, path.parent(), progress).map_err(|defect| defect.in_file(&file))?;
    scene.name = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    scene.source = Some(path.to_owned());
    Ok(scene)
}

/// Opens a file already in memory; `name` stands in for its path in messages. Without
/// `base_dir`, nothing beside it can be read.
pub fn open_bytes(name: &str, bytes: &[u8], base_dir: Option<&Path>, progress: &Progress) -> Result<Scene, LoadError> {
    let scene = read(bytes, base_dir, progress).map_err(|defect| defect.in_file(name))?;
    Ok(Scene { name: name.to_owned(), ..scene })
}

fn read(bytes: &[u8], base_dir: Option<&Path>, progress: &Progress) -> Result<Scene, Defect> {
    let source = source::parse(bytes, base_dir)?;
    let root = source.document.as_json();
    let mut warnings = Vec::new();
    warn_of_extensions(&root.extensions_used, &mut warnings);
    let (cameras, camera_places) = nodes::cameras(root, &mut warnings);
    let lights = nodes::lights(root)?;
    let hierarchy = Hierarchy::new(root)?;
    let mut nodes = hierarchy.nodes(root, &camera_places, &mut warnings)?;
    nodes::check_lights(&nodes, lights.len())?;
    let mut meshes = read_meshes(&source, progress, &mut warnings)?;
    let skins = skin::load_all(&source, &hierarchy.rank, &mut warnings)?;
    skin::bind(&mut nodes, &mut meshes, &skins, &mut warnings)?;
    let clips = read_clips(&source, &hierarchy, &nodes, progress, &mut warnings)?;
    let textures = Textures::load(&source, base_dir, progress, &mut warnings)?;
    let materials = material::load(&source, &textures, &mut warnings)?;
    Ok(Scene {
        name: String::new(),
        source: None,
        nodes,
        meshes,
        materials,
        textures: textures.list,
        skins,
        clips,
        cameras,
        lights,
        extensions: root.extensions_used.clone(),
        warnings,
    })
}

fn warn_of_extensions(used: &[String], warnings: &mut Vec<String>) {
    let unknown: Vec<&str> =
        used.iter().map(String::as_str).filter(|name| !SUPPORTED_EXTENSIONS.contains(name)).collect();
    if !unknown.is_empty() {
        warnings.push(format!("extensions that are not read: {}", unknown.join(", ")));
    }
}

fn read_meshes(source: &Source, progress: &Progress, warnings: &mut Vec<String>) -> Result<Vec<Mesh>, Defect> {
    let declared = &source.document.as_json().meshes;
    progress.add_total(declared.len() as u64);
    let results: Vec<Result<mesh::Loaded, Defect>> = declared
        .par_iter()
        .enumerate()
        .map(|(index, declared)| {
            let loaded = mesh::load(source, index, declared)?;
            progress.advance(1)?;
            Ok(loaded)
        })
        .collect();
    let mut meshes = Vec::with_capacity(results.len());
    let mut without_surface = 0;
    for loaded in results {
        let loaded = loaded?;
        meshes.push(loaded.mesh);
        without_surface += loaded.without_surface;
        warnings.extend(loaded.warnings);
    }
    if without_surface > 0 {
        let left_out = counted(without_surface, "primitive", "primitives");
        warnings.push(format!("{left_out} left out: points and lines have no surface"));
    }
    Ok(meshes)
}

fn read_clips(
    source: &Source,
    hierarchy: &Hierarchy,
    nodes: &[Node],
    progress: &Progress,
    warnings: &mut Vec<String>,
) -> Result<Vec<Clip>, Defect> {
    let animations = &source.document.as_json().animations;
    progress.add_total(animations.len() as u64);
    let clips = animations.iter().enumerate().map(|(index, animation)| {
        let clip = animation::load(source, index, animation, &hierarchy.rank, nodes, warnings)?;
        progress.advance(1)?;
        Ok(clip)
    });
    clips.collect()
}
