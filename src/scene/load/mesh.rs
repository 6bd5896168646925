//! Meshes: triangles from lists, strips and fans; only the vertices they use; flat normals where
//! the file has none. Every number is checked; errors name mesh, primitive and attribute.

use std::collections::BTreeMap;

use glam::{Vec2, Vec3, Vec4};
use gltf::json::{
    self, Index,
    accessor::Accessor,
    mesh::{Mode, Semantic},
    validation::Checked,
};

use super::{
    accessor::Elements,
    error::{About, Defect, counted, label},
    source::Source,
    weights::Influences,
};
use crate::scene::{Mesh, Primitive};

/// The attributes of one primitive, read at the vertices its triangles use.
pub(super) struct Attributes<'a> {
    source: &'a Source,
    pub accessors: &'a BTreeMap<Checked<Semantic>, Index<Accessor>>,
    /// As messages name it.
    pub primitive: String,
    /// Of the file, by vertex of the scene.
    vertices: Vec<u32>,
    /// How many the file has.
    declared_count: usize,
}

/// A mesh and how many of its primitives have no surface.
pub(super) struct Loaded {
    pub mesh: Mesh,
    pub without_surface: usize,
    pub warnings: Vec<String>,
}

pub(super) fn load(source: &Source, index: usize, mesh: &json::Mesh) -> Result<Loaded, Defect> {
    let name = label("mesh", index, mesh.name.as_deref());
    let mut loaded = Loaded {
        mesh: Mesh { name: mesh.name.clone().unwrap_or_else(|| format!("mesh {index}")), primitives: Vec::new() },
        without_surface: 0,
        warnings: Vec::new(),
    };
    for (number, primitive) in mesh.primitives.iter().enumerate() {
        let Checked::Valid(mode @ (Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan)) = primitive.mode else {
            loaded.without_surface += 1;
            continue;
        };
        let object = format!("{name}, primitive {number}");
        loaded.mesh.primitives.push(load_primitive(source, object, primitive, mode, &mut loaded.warnings)?);
    }
    if mesh.primitives.iter().any(|primitive| primitive.targets.as_ref().is_some_and(|targets| !targets.is_empty())) {
        loaded.warnings.push(format!("{name}: morph targets are not applied; its base shape is shown"));
    }
    Ok(loaded)
}

fn load_primitive(
    source: &Source,
    object: String,
    primitive: &json::mesh::Primitive,
    mode: Mode,
    warnings: &mut Vec<String>,
) -> Result<Primitive, Defect> {
    let mut attributes = Attributes {
        source,
        accessors: &primitive.attributes,
        primitive: object,
        vertices: Vec::new(),
        declared_count: 0,
    };
    attributes.declared_count = attributes.elements(&Semantic::Positions)?.map_or(0, |elements| elements.count);
    let corners = attributes.corners(primitive.indices)?;
    let mut triangles = triangles(&corners, mode);
    if mode == Mode::Triangles && corners.len() % 3 != 0 {
        let left_out = counted(corners.len() % 3, "vertex", "vertices");
        warnings.push(format!("{}: {left_out} left out: too few at its end for a triangle", attributes.primitive));
    }
    let flat = !attributes.has(Semantic::Normals);
    attributes.vertices =
        if flat { unshare(&mut triangles) } else { compact(&mut triangles, attributes.declared_count) };
    let positions: Vec<Vec3> = attributes.floats(&Semantic::Positions)?.into_iter().map(Vec3::from_array).collect();
    let normals = match flat {
        true => flat_normals(&positions),
        false => attributes.floats(&Semantic::Normals)?.into_iter().map(Vec3::from_array).collect(),
    };
    let tangents = match flat || !attributes.has(Semantic::Tangents) {
        true => Vec::new(), // glTF: tangents without normals are to be ignored
        false => attributes.floats(&Semantic::Tangents)?.into_iter().map(Vec4::from_array).collect(),
    };
    let influences = Influences::of(&attributes, warnings)?;
    let (joints, weights) = influences.map(|i| (i.joints, i.weights)).unwrap_or_default();
    Ok(Primitive {
        material: primitive.material.map(|material| material.value()),
        normals,
        tangents,
        tex_coords: [attributes.tex_coords(0)?, attributes.tex_coords(1)?],
        colors: attributes.colors()?,
        joints,
        weights,
        positions,
        triangles,
    })
}

impl Attributes<'_> {
    pub fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    pub fn object(&self, semantic: &Semantic) -> String {
        format!("{}, {}", self.primitive, semantic.to_string())
    }

    fn has(&self, semantic: Semantic) -> bool {
        self.accessors.contains_key(&Checked::Valid(semantic))
    }

    fn elements(&self, semantic: &Semantic) -> Result<Option<Elements<'_>>, Defect> {
        let accessor = self.accessors.get(&Checked::Valid(semantic.clone()));
        accessor.map(|&accessor| self.source.elements(accessor)).transpose().about(|| self.object(semantic))
    }

    /// An attribute that must be there, as long as POSITION.
    fn required(&self, semantic: &Semantic) -> Result<Elements<'_>, Defect> {
        let elements = self.elements(semantic)?;
        let elements = elements.ok_or_else(|| Defect::new(self.object(semantic), "is missing"))?;
        if elements.count != self.declared_count {
            let cause = format!("has {} elements, and POSITION has {}", elements.count, self.declared_count);
            return Err(Defect::new(self.object(semantic), cause));
        }
        Ok(elements)
    }

    pub fn floats<const N: usize>(&self, semantic: &Semantic) -> Result<Vec<[f32; N]>, Defect> {
        let rows = self.required(semantic)?.floats(self.vertices.iter().map(|&vertex| vertex as usize));
        let rows: Vec<[f32; N]> = rows.about(|| self.object(semantic))?;
        match rows.iter().position(|row| row.iter().any(|value| !value.is_finite())) {
            Some(bad) => {
                let cause = format!("is not finite at vertex {}: {:?}", self.vertices[bad], rows[bad]);
                Err(Defect::new(self.object(semantic), cause))
            }
            None => Ok(rows),
        }
    }

    pub fn unsigned<const N: usize>(&self, semantic: &Semantic) -> Result<Vec<[u32; N]>, Defect> {
        let rows = self.required(semantic)?.unsigned(self.vertices.iter().map(|&vertex| vertex as usize));
        rows.about(|| self.object(semantic))
    }

    fn tex_coords(&self, set: u32) -> Result<Vec<Vec2>, Defect> {
        match self.has(Semantic::TexCoords(set)) {
            true => Ok(self.floats(&Semantic::TexCoords(set))?.into_iter().map(Vec2::from_array).collect()),
            false => Ok(Vec::new()),
        }
    }

    fn colors(&self) -> Result<Vec<Vec4>, Defect> {
        let semantic = Semantic::Colors(0);
        match self.elements(&semantic)?.map(|elements| elements.lanes) {
            None => Ok(Vec::new()),
            Some(3) => Ok(self.floats(&semantic)?.into_iter().map(|rgb| Vec3::from_array(rgb).extend(1.0)).collect()),
            Some(_) => Ok(self.floats(&semantic)?.into_iter().map(Vec4::from_array).collect()),
        }
    }

    /// Vertex numbers in drawing order, all in range.
    fn corners(&self, indices: Option<Index<Accessor>>) -> Result<Vec<u32>, Defect> {
        let object = || format!("{}, indices", self.primitive);
        let count = u32::try_from(self.declared_count)
            .map_err(|_| Defect::new(self.object(&Semantic::Positions), "has more than 2^32 vertices"))?;
        let Some(indices) = indices else { return Ok((0..count).collect()) };
        let elements = self.source.elements(indices).about(object)?;
        let rows = elements.unsigned::<1>(0..elements.count).about(object)?;
        match rows.iter().position(|[vertex]| *vertex >= count) {
            Some(at) => {
                let cause = format!("index {at} names vertex {} of {count}", rows[at][0]);
                Err(Defect::new(object(), cause))
            }
            None => Ok(rows.into_iter().map(|[vertex]| vertex).collect()),
        }
    }
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
fn compact(triangles: &mut [[u32; 3]], count: usize) -> Vec<u32> {
    const UNUSED: u32 = u32::MAX;
    let mut place = vec![UNUSED; count];
    for &vertex in triangles.iter().flatten() {
        place[vertex as usize] = 0;
    }
    let mut vertices = Vec::new();
    for (vertex, place) in (0..).zip(&mut place) {
        if *place != UNUSED {
            *place = vertices.len() as u32;
            vertices.push(vertex);
        }
    }
    for vertex in triangles.iter_mut().flatten() {
        *vertex = place[*vertex as usize];
    }
    vertices
}

/// Unit face normals of unshared triangles; zero where a triangle has no area.
fn flat_normals(positions: &[Vec3]) -> Vec<Vec3> {
    positions
        .chunks_exact(3)
        .flat_map(|corner| {
            let [a, b, c] = [corner[0].as_dvec3(), corner[1].as_dvec3(), corner[2].as_dvec3()];
            [(b - a).cross(c - a).normalize_or_zero().as_vec3(); 3]
        })
        .collect()
}
