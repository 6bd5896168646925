//! Meshes: triangles from lists, strips and fans; only the vertices they use; flat normals where
//! the file has none. Every number is checked; errors name mesh, primitive and attribute.

use glam::{Vec3, Vec4};
use gltf::json::{
    self,
    mesh::{Mode, Semantic},
    validation::Checked,
};

use super::{
    attributes::Attributes,
    error::{Defect, counted},
    file_object::FileObject,
    source::Source,
    weights::Influences,
};
use crate::scene::{Mesh, Primitive, Warning, morph::flat_normals};

/// A mesh and how many of its primitives have no surface.
pub(super) struct Loaded {
    pub mesh: Mesh,
    pub without_surface: usize,
    pub warnings: Vec<Warning>,
}

/// `weights` are those of its morph targets: its own, or those of the node that shows it; with whether a clip moves them.
pub(super) fn load(source: &Source, index: usize, (weights, moves): (&[f32], bool)) -> Result<Loaded, Defect> {
    let mesh = &source.root.meshes[index];
    let name = FileObject::item("mesh", index, mesh.name.as_deref());
    let mut loaded = Loaded {
        mesh: Mesh { name: mesh.name.clone().unwrap_or_else(|| format!("mesh {index}")), primitives: Vec::new() },
        without_surface: 0,
        warnings: Vec::new(),
    };
    for (number, primitive) in mesh.primitives.iter().enumerate() {
        let object = name.member(format_args!("primitive {number}"));
        match primitive.mode {
            Checked::Valid(mode @ (Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan)) => {
                if !primitive.attributes.contains_key(&Checked::Valid(Semantic::Positions)) {
                    loaded.warnings.push(object.warning("it has no POSITION; it is left out"));
                    continue;
                }
                let attributes = Attributes::new(source, object, primitive, weights, &mut loaded.warnings)?;
                let as_drawn = (mode, moves.then_some(weights));
                loaded.mesh.primitives.push(load_primitive(attributes, primitive, as_drawn, &mut loaded.warnings)?);
            }
            Checked::Valid(_) => loaded.without_surface += 1,
            Checked::Invalid => return Err(Defect::new(object, "has a mode that glTF does not know")),
        }
    }
    Ok(loaded)
}

fn load_primitive(
    mut attributes: Attributes,
    primitive: &json::mesh::Primitive,
    (mode, moving_weights): (Mode, Option<&[f32]>),
    warnings: &mut Vec<Warning>,
) -> Result<Primitive, Defect> {
    let corners = attributes.corners()?;
    let mut triangles = triangles(&corners, mode);
    if mode == Mode::Triangles && corners.len() % 3 != 0 {
        let left_out = counted(corners.len() % 3, "vertex", "vertices");
        warnings.push(attributes.primitive.warning(format!("{left_out} left out: too few at its end for a triangle")));
    }
    let flat = !attributes.has(Semantic::Normals);
    attributes.vertices = if flat { unshare(&mut triangles) } else { compact(&mut triangles) };
    let positions: Vec<Vec3> = attributes.floats(&Semantic::Positions)?.into_iter().map(Vec3::from_array).collect();
    let normals = match flat {
        true => flat_normals(&positions),
        false => normals(&attributes, &positions, &triangles, warnings)?,
    };
    let tangents = match flat || !attributes.has(Semantic::Tangents) {
        true => Vec::new(), // glTF: tangents without normals are to be ignored
        // One that is zero is as none: the triangle's own stands in.
        false => {
            let tangents = attributes.repaired(&Semantic::Tangents, [0.0, 0.0, 0.0, 1.0], warnings)?;
            tangents.into_iter().map(Vec4::from_array).collect()
        }
    };
    let influences = Influences::of(&attributes, warnings)?;
    let (joints, weights) = influences.map(|i| (i.joints, i.weights)).unwrap_or_default();
    let morph = match moving_weights {
        Some(weights) => attributes.morph(weights, flat, warnings)?,
        None => None,
    };
    Ok(Primitive {
        material: primitive.material.map(|material| material.value()),
        normals,
        tangents,
        tex_coords: [attributes.tex_coords(0, warnings)?, attributes.tex_coords(1, warnings)?],
        colors: attributes.colors(warnings)?,
        joints,
        weights,
        positions,
        triangles,
        morph,
    })
}

/// glTF's section 3.7.2.1; all triangles keep the winding of the first.
fn triangles(corners: &[u32], mode: Mode) -> Vec<[u32; 3]> {
    match mode {
        Mode::TriangleStrip => corners
            .windows(3)
            .enumerate()
            .map(|(number, window)| match number % 2 {
                0 => [window[0], window[1], window[2]],
                _ => [window[0], window[2], window[1]],
            })
            .collect(),
        Mode::TriangleFan => corners.windows(2).skip(1).map(|window| [window[0], window[1], corners[0]]).collect(),
        _ => corners.chunks_exact(3).map(|corner| [corner[0], corner[1], corner[2]]).collect(),
    }
}

/// Gives every corner a vertex of its own; returns the file's vertex of each.
fn unshare(triangles: &mut [[u32; 3]]) -> Vec<u32> {
    let vertices = triangles.iter().flatten().copied().collect();
    for (corner, vertex) in (0..).zip(triangles.iter_mut().flatten()) {
        *vertex = corner;
    }
    vertices
}

/// Drops vertices no triangle uses: files share one vertex array among hundreds of meshes, and
/// what is not drawn must not widen the bounds. Returns the file's vertex of each that is left.
/// Takes time by the triangles alone: a vertex array shared by many small meshes costs nothing.
fn compact(triangles: &mut [[u32; 3]]) -> Vec<u32> {
    let mut vertices: Vec<u32> = triangles.iter().flatten().copied().collect();
    vertices.sort_unstable();
    vertices.dedup();
    for vertex in triangles.iter_mut().flatten() {
        *vertex = vertices.partition_point(|used| used < vertex) as u32;
    }
    vertices
}

/// Lengths that differ more from 1 than those of normalised bytes.
const UNIT_TOLERANCE: f32 = 0.01;

/// The file's normals; those that are not finite or zero become the mean of the triangles around them, others are
/// normalised.
fn normals(
    attributes: &Attributes,
    positions: &[Vec3],
    triangles: &[[u32; 3]],
    warnings: &mut Vec<Warning>,
) -> Result<Vec<Vec3>, Defect> {
    let read = attributes.repaired(&Semantic::Normals, [0.0; 3], &mut Vec::new())?;
    let mut normals: Vec<Vec3> = read.into_iter().map(Vec3::from_array).collect();
    let is_off = |normal: &Vec3| (normal.length() - 1.0).abs() > UNIT_TOLERANCE;
    let off: Vec<usize> = (0..normals.len()).filter(|vertex| is_off(&normals[*vertex])).collect();
    // Morphed ones are no unit vectors, and need not be.
    if off.is_empty() || attributes.is_morphed() {
        return Ok(normals);
    }
    let mut around = vec![Vec3::ZERO; normals.len()];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|vertex| positions[vertex as usize]);
        let doubled_area = (b - a).cross(c - a);
        triangle.iter().for_each(|&vertex| around[vertex as usize] += doubled_area);
    }
    for &vertex in &off {
        normals[vertex] = normals[vertex].try_normalize().unwrap_or_else(|| around[vertex].normalize_or_zero());
    }
    let count = counted(off.len(), "vertex", "vertices");
    let cause = format!("not unit vectors at {count}; they are normalised, or those of the triangles around");
    warnings.push(attributes.object(&Semantic::Normals).warning(cause));
    Ok(normals)
}
