//! How accessors are used: what glTF asks of one that holds positions, indices or key times, and
//! that reading them would not notice. Each defect is a warning.

use std::collections::{HashMap, HashSet};

use gltf::json::{
    Accessor, Index,
    accessor::{ComponentType, Type},
    mesh::{Primitive, Semantic},
    validation::Checked,
};

use super::{
    accessor::element_bytes,
    accessor_check::{declared_bytes, take},
    file_object::FileObject,
    json::Few,
    material::normal_tex_coord_set,
    source::Source,
    texture::tex_coord_set,
};
use crate::scene::Warning;

const QUANTIZATION: &str = "KHR_mesh_quantization";

pub(super) fn check(source: &Source, warnings: &mut Vec<Warning>) {
    let mut check = Check {
        source,
        few: Few::default(),
        vertex_accessors: HashMap::new(),
        indices: HashSet::new(),
        allowance_bytes: source.check_allowance_bytes(),
    };
    check.views();
    for (index, mesh) in source.root.meshes.iter().enumerate() {
        for (number, primitive) in mesh.primitives.iter().enumerate() {
            let object = FileObject::item("mesh", index, mesh.name.as_deref());
            check.primitive(&object.member(format_args!("primitive {number}")), primitive);
        }
    }
    check.samplers();
    check.few.append_to(warnings);
}

struct Check<'a> {
    source: &'a Source<'a>,
    few: Few,
    /// By buffer view: the first accessor of vertex data in it.
    vertex_accessors: HashMap<usize, usize>,
    /// Index accessors that were looked at, and what may be looked at yet.
    indices: HashSet<usize>,
    allowance_bytes: u64,
}

impl Check<'_> {
    fn accessor(&self, index: Index<Accessor>) -> &Accessor {
        &self.source.root.accessors[index.value()]
    }

    fn stride(&self, accessor: &Accessor) -> Option<usize> {
        let view = self.source.root.buffer_views.get(accessor.buffer_view?.value())?;
        view.byte_stride.map(|stride| stride.0)
    }

    /// Views lie in their buffers, and strides in their views.
    fn views(&mut self) {
        for (index, view) in self.source.root.buffer_views.iter().enumerate() {
            if let Err(cause) = self.source.bytes_of_view(Index::new(index as u32)) {
                self.few.add(|| FileObject::item("buffer view", index, None).warning(format!("it {cause}")));
            }
            if let Some(stride) = view.byte_stride.filter(|stride| stride.0 as u64 > view.byte_length.0) {
                let object = FileObject::item("buffer view", index, None).member("byteStride");
                self.few.add(|| object.warning(format!("it is {}, more than the view holds", stride.0)));
            }
        }
    }

    fn primitive(&mut self, object: &FileObject, primitive: &Primitive) {
        let compressed =
            primitive.extensions.as_ref().is_some_and(|e| e.others.contains_key("KHR_draco_mesh_compression"));
        for (semantic, &index) in &primitive.attributes {
            let Checked::Valid(semantic) = semantic else { continue };
            let object = object.member(semantic.to_string());
            if !compressed {
                self.vertex_data(&object, index);
            }
            self.attribute(&object, semantic, index);
        }
        for (number, target) in primitive.targets.iter().flatten().enumerate() {
            let displaced = [
                (Semantic::Positions, target.positions),
                (Semantic::Normals, target.normals),
                (Semantic::Tangents, target.tangents),
            ];
            for (semantic, index) in displaced {
                let Some(index) = index else { continue };
                let object = object.member(format_args!("morph target {number}, {}", semantic.to_string()));
                self.attribute(&object, &semantic, index);
                if !primitive.attributes.contains_key(&Checked::Valid(semantic)) {
                    self.few.add(|| object.warning("it displaces what the primitive has not"));
                }
            }
        }
        if let Some(indices) = primitive.indices {
            let object = object.member("indices");
            self.without_stride(&object, indices);
            self.restart(&object, indices);
        }
        self.tex_coords(object, primitive);
    }

    fn attribute(&mut self, object: &FileObject, semantic: &Semantic, index: Index<Accessor>) {
        let accessor = self.accessor(index);
        let lacks_bounds = accessor.min.is_none() || accessor.max.is_none();
        let is_float =
            matches!(accessor.component_type, Checked::Valid(component) if component.0 == ComponentType::F32);
        let quantizable = match semantic {
            Semantic::Positions | Semantic::Normals | Semantic::Tangents => true,
            Semantic::TexCoords(_) => !accessor.normalized,
            _ => false,
        };
        if *semantic == Semantic::Positions && lacks_bounds {
            self.few.add(|| object.warning("its accessor declares no min and max"));
        }
        let required = self.source.root.extensions_required.iter().any(|name| name == QUANTIZATION);
        if quantizable && !is_float && !required {
            self.few.add(|| object.warning(format!("it holds integers, and {QUANTIZATION} is not required")));
        }
    }

    /// Vertex data is aligned to 4 bytes, and a view of several accessors has a stride.
    fn vertex_data(&mut self, object: &FileObject, index: Index<Accessor>) {
        let accessor = self.accessor(index);
        let Some(view) = accessor.buffer_view else { return };
        let (offset, stride) = (accessor.byte_offset.unwrap_or_default().0, self.stride(accessor));
        let Some(size) = element_bytes(accessor) else { return };
        if !offset.is_multiple_of(4) || !stride.unwrap_or(size).is_multiple_of(4) {
            self.few.add(|| object.warning("its vertices do not start at multiples of 4 bytes"));
        }
        let first = *self.vertex_accessors.entry(view.value()).or_insert(index.value());
        if stride.is_none() && first != index.value() {
            self.few.add(|| {
                object.warning(format!("it shares buffer view {view} with accessor {first}, without a byteStride"))
            });
        }
    }

    fn without_stride(&mut self, object: &FileObject, index: Index<Accessor>) {
        if self.stride(self.accessor(index)).is_some() {
            self.few.add(|| object.warning("its buffer view has a byteStride, which is for vertices alone"));
        }
    }

    /// The largest index restarts a strip elsewhere; glTF has no such thing.
    fn restart(&mut self, object: &FileObject, index: Index<Accessor>) {
        let Checked::Valid(component) = self.accessor(index).component_type else { return };
        let restart = match component.0 {
            ComponentType::U8 => u32::from(u8::MAX),
            ComponentType::U16 => u32::from(u16::MAX),
            _ => u32::MAX,
        };
        let bytes = declared_bytes(self.accessor(index));
        if !self.indices.insert(index.value()) || !take(&mut self.allowance_bytes, bytes) {
            return;
        }
        let Ok(elements) = self.source.elements(index) else { return };
        let Ok(rows) = elements.unsigned::<1>(0..elements.count) else { return };
        if rows.contains(&[restart]) {
            self.few.add(|| {
                object.warning(format!("{restart} restarts a primitive elsewhere, and glTF does not allow it"))
            });
        }
    }

    /// The coordinates that its material reads.
    fn tex_coords(&mut self, object: &FileObject, primitive: &Primitive) {
        let Some(material) = primitive.material.and_then(|index| self.source.root.materials.get(index.value())) else {
            return;
        };
        let pbr = &material.pbr_metallic_roughness;
        let slots = [&pbr.base_color_texture, &pbr.metallic_roughness_texture, &material.emissive_texture];
        let sets = slots
            .into_iter()
            .flatten()
            .map(tex_coord_set)
            .chain(material.normal_texture.as_ref().map(normal_tex_coord_set));
        let missing =
            sets.filter(|&set| !primitive.attributes.contains_key(&Checked::Valid(Semantic::TexCoords(set)))).max();
        if let Some(set) = missing {
            self.few.add(|| object.warning(format!("its material reads TEXCOORD_{set}, which it has not")));
        }
    }

    fn samplers(&mut self) {
        for (index, animation) in self.source.root.animations.iter().enumerate() {
            for (number, sampler) in animation.samplers.iter().enumerate() {
                let object = FileObject::item("animation", index, animation.name.as_deref());
                let object = object.member(format_args!("sampler {number}"));
                let input = self.accessor(sampler.input);
                let scalar = matches!(input.type_, Checked::Valid(Type::Scalar));
                let float =
                    matches!(input.component_type, Checked::Valid(component) if component.0 == ComponentType::F32);
                let bounded = input.min.is_some() && input.max.is_some();
                if !(scalar && float) {
                    self.few.add(|| object.warning("its input must be scalar floats"));
                }
                if !bounded {
                    self.few.add(|| object.warning("its input declares no min and max"));
                }
                self.without_stride(&object.member("input"), sampler.input);
                self.without_stride(&object.member("output"), sampler.output);
            }
        }
    }
}
