//! The vertex attributes of one primitive: from accessors or out of a Draco stream, morphed by the
//! mesh's weights, and read only at the vertices that its triangles use.

use glam::{Vec2, Vec3, Vec4};
use gltf::json::{
    Index,
    accessor::Accessor,
    mesh::{MorphTarget, Primitive, Semantic},
    validation::Checked,
};

use super::{
    accessor::Elements,
    draco,
    error::{About, Defect, counted},
    file_object::FileObject,
    source::Source,
};
use crate::scene::{self, Morph, Warning};

/// What one primitive of the file says about its vertices.
pub(super) struct Attributes<'a> {
    source: &'a Source<'a>,
    declared: &'a Primitive,
    draco: Option<draco::Decoded>,
    /// Morph targets that have weight.
    morphs: Vec<(&'a MorphTarget, f32)>,
    /// As messages name it.
    pub primitive: FileObject,
    /// Of the file, by vertex of the scene.
    pub vertices: Vec<u32>,
    /// How many the file has.
    declared_count: usize,
}

impl<'a> Attributes<'a> {
    /// `weights` are the mesh's, one a morph target; those that are missing are 0.
    pub fn new(
        source: &'a Source,
        primitive: FileObject,
        declared: &'a Primitive,
        weights: &[f32],
        warnings: &mut Vec<Warning>,
    ) -> Result<Self, Defect> {
        let targets = declared.targets.as_deref().unwrap_or_default();
        if !weights.is_empty() && weights.len() != targets.len() {
            let (weights, targets) = (weights.len(), counted(targets.len(), "morph target", "morph targets"));
            warnings.push(primitive.warning(format!("it has {targets}, and its mesh or node has {weights} weights")));
        }
        let draco = draco::Decoded::of(source, &primitive, declared)?;
        let morphs = targets.iter().zip(weights.iter().copied()).filter(|&(_, weight)| weight != 0.0).collect();
        let mut attributes =
            Self { source, declared, draco, morphs, primitive, vertices: Vec::new(), declared_count: 0 };
        attributes.declared_count = attributes.elements(&Semantic::Positions)?.map_or(0, |elements| elements.count);
        Ok(attributes)
    }

    pub fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    pub fn object(&self, semantic: &Semantic) -> FileObject {
        self.primitive.member(semantic.to_string())
    }

    pub fn is_morphed(&self) -> bool {
        !self.morphs.is_empty()
    }

    pub fn has(&self, semantic: Semantic) -> bool {
        self.declared.attributes.contains_key(&Checked::Valid(semantic))
    }

    fn elements(&self, semantic: &Semantic) -> Result<Option<Elements<'_>>, Defect> {
        if let Some(elements) = self.draco.as_ref().and_then(|draco| draco.elements(semantic)) {
            return elements.map(Some).about(|| self.object(semantic));
        }
        let accessor = self.declared.attributes.get(&Checked::Valid(semantic.clone()));
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

    fn picked(&self) -> impl Iterator<Item = usize> + '_ {
        self.vertices.iter().map(|&vertex| vertex as usize)
    }

    /// The attribute at every vertex, all finite.
    pub fn floats<const N: usize>(&self, semantic: &Semantic) -> Result<Vec<[f32; N]>, Defect> {
        let rows = self.rows(semantic)?;
        match rows.iter().position(|row| !is_finite(row)) {
            Some(bad) => {
                let cause = format!("is not finite at vertex {}: {:?}", self.vertices[bad], rows[bad]);
                Err(Defect::new(self.object(semantic), cause))
            }
            None => Ok(rows),
        }
    }

    /// The attribute at every vertex, with `instead` where it is not finite, which a warning counts.
    pub fn repaired<const N: usize>(
        &self,
        semantic: &Semantic,
        instead: [f32; N],
        warnings: &mut Vec<Warning>,
    ) -> Result<Vec<[f32; N]>, Defect> {
        let mut rows = self.rows(semantic)?;
        let mut count = 0;
        for row in rows.iter_mut().filter(|row| !is_finite(&**row)) {
            *row = instead;
            count += 1;
        }
        if count > 0 {
            let count = counted(count, "vertex", "vertices");
            warnings.push(self.object(semantic).warning(format!("not finite at {count}; {instead:?} stands in")));
        }
        Ok(rows)
    }

    /// The attribute at every vertex as it is in the file, morphed.
    fn rows<const N: usize>(&self, semantic: &Semantic) -> Result<Vec<[f32; N]>, Defect> {
        let elements = self.required(semantic)?;
        self.source.budget.spend_on(self.vertices.len(), size_of::<[f32; N]>()).about(|| self.object(semantic))?;
        let mut rows: Vec<[f32; N]> = elements.floats(self.picked()).about(|| self.object(semantic))?;
        for (target, weight) in &self.morphs {
            self.add_target(semantic, target, *weight, &mut rows)?;
        }
        Ok(rows)
    }

    /// Displacements have three components; the handedness of a tangent is not displaced.
    fn add_target<const N: usize>(
        &self,
        semantic: &Semantic,
        target: &MorphTarget,
        weight: f32,
        rows: &mut [[f32; N]],
    ) -> Result<(), Defect> {
        for (row, step) in rows.iter_mut().zip(self.displacements(semantic, target)?) {
            row.iter_mut().zip(step).for_each(|(lane, step)| *lane += weight * step);
        }
        Ok(())
    }

    /// By vertex; none where the target does not displace the attribute.
    fn displacements(&self, semantic: &Semantic, target: &MorphTarget) -> Result<Vec<[f32; 3]>, Defect> {
        let Some(accessor) = displacements(target, semantic) else { return Ok(Vec::new()) };
        let object = || self.object(semantic).member("morph target");
        let elements = self.source.elements(accessor).about(object)?;
        if elements.count != self.declared_count {
            let cause = format!("has {} elements, and POSITION has {}", elements.count, self.declared_count);
            return Err(Defect::new(object(), cause));
        }
        self.source.budget.spend_on(self.vertices.len(), size_of::<[f32; 3]>()).about(object)?;
        elements.floats(self.picked()).about(object)
    }

    /// What a clip moves: displacements at all vertices, beside the weights that are baked. `None` without targets.
    /// What of a target cannot be read displaces nothing, which a warning tells.
    pub fn morph(&self, weights: &[f32], is_flat: bool, warnings: &mut Vec<Warning>) -> Result<Option<Morph>, Defect> {
        let targets = self.declared.targets.as_deref().unwrap_or_default();
        let mut read = Vec::with_capacity(targets.len());
        for target in targets {
            let mut of = |semantic| self.repaired_displacements(&semantic, target, warnings);
            let positions = of(Semantic::Positions)?;
            // Normals of the displaced triangles stand in for those that the file does not have.
            let [normals, tangents] = match is_flat {
                true => [Vec::new(), Vec::new()],
                false => [of(Semantic::Normals)?, of(Semantic::Tangents)?],
            };
            read.push(scene::MorphTarget { positions, normals, tangents });
        }
        let weights = (0..read.len()).map(|target| weights.get(target).copied().unwrap_or(0.0).into()).collect();
        Ok((!read.is_empty()).then_some(Morph { targets: read, weights, is_flat }))
    }

    fn repaired_displacements(
        &self,
        semantic: &Semantic,
        target: &MorphTarget,
        warnings: &mut Vec<Warning>,
    ) -> Result<Vec<Vec3>, Defect> {
        let object = || self.object(semantic).member("morph target");
        let mut rows = match self.displacements(semantic, target) {
            Ok(rows) => rows,
            Err(Defect::Invalid { cause, .. }) if !self.source.budget.is_exceeded() => {
                warnings.push(object().warning(format!("it {cause}; it displaces nothing")));
                return Ok(Vec::new());
            }
            Err(defect) => return Err(defect),
        };
        let mut count = 0;
        for row in rows.iter_mut().filter(|row| !is_finite(&**row)) {
            *row = [0.0; 3];
            count += 1;
        }
        if count > 0 {
            let count = counted(count, "vertex", "vertices");
            warnings.push(object().warning(format!("not finite at {count}, which it does not displace")));
        }
        Ok(rows.into_iter().map(Vec3::from_array).collect())
    }

    pub fn unsigned<const N: usize>(&self, semantic: &Semantic) -> Result<Vec<[u32; N]>, Defect> {
        self.required(semantic)?.unsigned(self.picked()).about(|| self.object(semantic))
    }

    pub fn tex_coords(&self, set: u32, warnings: &mut Vec<Warning>) -> Result<Vec<Vec2>, Defect> {
        let semantic = Semantic::TexCoords(set);
        match self.elements(&semantic)? {
            Some(elements) if elements.is_u32() => Err(Defect::new(
                self.object(&semantic),
                "holds 32-bit integers, and floats or normalised integers are needed",
            )),
            Some(_) => Ok(self.repaired(&semantic, [0.0; 2], warnings)?.into_iter().map(Vec2::from_array).collect()),
            None => Ok(Vec::new()),
        }
    }

    pub fn colors(&self, warnings: &mut Vec<Warning>) -> Result<Vec<Vec4>, Defect> {
        let semantic = Semantic::Colors(0);
        match self.elements(&semantic)?.map(|elements| elements.lanes) {
            None => Ok(Vec::new()),
            Some(3) => {
                let colors = self.repaired(&semantic, [1.0; 3], warnings)?;
                Ok(colors.into_iter().map(|rgb| Vec3::from_array(rgb).extend(1.0)).collect())
            }
            Some(_) => Ok(self.repaired(&semantic, [1.0; 4], warnings)?.into_iter().map(Vec4::from_array).collect()),
        }
    }

    /// Vertex numbers in drawing order, all in range.
    pub fn corners(&self) -> Result<Vec<u32>, Defect> {
        let object = || self.primitive.member("indices");
        let count = u32::try_from(self.declared_count)
            .map_err(|_| Defect::new(self.object(&Semantic::Positions), "has more than 2^32 vertices"))?;
        let budget = |corners: usize| self.source.budget.spend_on(corners, size_of::<u32>()).about(object);
        let elements = match self.draco.as_ref().and_then(draco::Decoded::indices) {
            Some(decoded) => Some(decoded.about(object)?),
            None => self.declared.indices.map(|indices| self.source.elements(indices)).transpose().about(object)?,
        };
        let Some(elements) = elements else {
            budget(self.declared_count)?;
            return Ok((0..count).collect());
        };
        budget(elements.count)?;
        let rows = elements.unsigned::<1>(0..elements.count).about(object)?;
        match rows.iter().position(|[vertex]| *vertex >= count) {
            Some(at) => {
                let cause = format!("index {at} names vertex {} of {count}", rows[at][0]);
                Err(Defect::new(object(), cause))
            }
            None => Ok(rows.into_iter().flatten().collect()),
        }
    }

    /// Sets 0, 1, … that have joints or weights; a lone one of the two is reported on reading.
    pub fn joint_sets(&self) -> u32 {
        (0..).take_while(|&set| self.has(Semantic::Joints(set)) || self.has(Semantic::Weights(set))).count() as u32
    }
}

fn is_finite(row: &[f32]) -> bool {
    row.iter().all(|value| value.is_finite())
}

fn displacements(target: &MorphTarget, semantic: &Semantic) -> Option<Index<Accessor>> {
    match semantic {
        Semantic::Positions => target.positions,
        Semantic::Normals => target.normals,
        Semantic::Tangents => target.tangents,
        _ => None,
    }
}
