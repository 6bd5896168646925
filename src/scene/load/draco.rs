//! KHR_draco_mesh_compression: indices and attributes of a primitive out of one compressed stream.

use draco_gltf::{
    ComponentType as Component, DracoPrimitiveContract, DracoPrimitiveExtension, JsonValue, PackedGeometry,
};
use gltf::json::{
    Index,
    accessor::ComponentType,
    mesh::{Primitive, Semantic},
    validation::Checked,
};

use super::{
    accessor::{Elements, element_bytes},
    error::{About, Defect},
    file_object::FileObject,
    source::Source,
};

const EXTENSION: &str = "KHR_draco_mesh_compression";

/// What came out of a primitive's stream.
pub(super) struct Decoded(PackedGeometry);

impl Decoded {
    /// `None` where the primitive is not compressed.
    pub fn of(source: &Source, object: &FileObject, primitive: &Primitive) -> Result<Option<Self>, Defect> {
        let Some(extensions) = &primitive.extensions else { return Ok(None) };
        let Some(declared) = extensions.others.get(EXTENSION) else { return Ok(None) };
        decode(source, primitive, declared).map(|geometry| Some(Self(geometry))).about(|| object.member(EXTENSION))
    }

    /// An attribute, if the stream holds it.
    pub fn elements(&self, semantic: &Semantic) -> Option<Result<Elements<'_>, String>> {
        let name = semantic.to_string();
        let attribute = self.0.attributes().iter().find(|attribute| attribute.semantic() == name)?;
        Some(component_of(attribute.component_type()).map(|component| {
            Elements::packed(attribute.bytes(), component, attribute.components().into(), attribute.normalized())
        }))
    }

    pub fn indices(&self) -> Option<Result<Elements<'_>, String>> {
        let indices = self.0.indices()?;
        Some(
            component_of(indices.component_type())
                .map(|component| Elements::packed(indices.bytes(), component, 1, false)),
        )
    }
}

fn decode(source: &Source, primitive: &Primitive, declared: &serde_json::Value) -> Result<PackedGeometry, String> {
    let declared = JsonValue::parse(declared.to_string().as_bytes()).map_err(|error| error.to_string())?;
    let extension = DracoPrimitiveExtension::from_json(&declared).map_err(|error| error.to_string())?;
    let view = Index::new(u32::try_from(extension.buffer_view()).unwrap_or(u32::MAX));
    let payload = source.view_bytes(view)?;
    let mut contract = DracoPrimitiveContract::new();
    let accessor = |index: gltf::json::Index<gltf::json::Accessor>| &source.root.accessors[index.value()];
    for (semantic, &index) in &primitive.attributes {
        let Checked::Valid(semantic) = semantic else { continue };
        let (count, normalized) = (accessor(index).count.0, accessor(index).normalized);
        let bytes = element_bytes(accessor(index)).unwrap_or(0);
        source.budget.spend_on(usize::try_from(count).unwrap_or(usize::MAX), bytes)?;
        contract = contract.with_attribute(semantic.to_string(), count, normalized);
    }
    if let Some(indices) = primitive.indices {
        let count = accessor(indices).count.0;
        source.budget.spend_on(usize::try_from(count).unwrap_or(usize::MAX), size_of_val(&0_u32))?;
        contract = contract.with_indices(count);
    }
    extension.decode(payload, &contract).map_err(|error| error.to_string())
}

fn component_of(component: Component) -> Result<ComponentType, String> {
    match component {
        Component::I8 => Ok(ComponentType::I8),
        Component::U8 => Ok(ComponentType::U8),
        Component::I16 => Ok(ComponentType::I16),
        Component::U16 => Ok(ComponentType::U16),
        Component::U32 => Ok(ComponentType::U32),
        Component::F32 => Ok(ComponentType::F32),
        other => Err(format!("holds {other:?}, which glTF 2.0 has not")),
    }
}
