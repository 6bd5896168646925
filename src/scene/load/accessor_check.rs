//! Accessors as a whole, whether something reads them or not: whether their bytes are there and
//! lie where glTF has them, and whether they hold what they declare. Each defect is a warning;
//! where something reads a broken accessor, reading it is an error of its own.

use gltf::json::{Accessor, accessor::Type, validation::Checked};
use rayon::prelude::*;
use serde_json::Value;

use super::{accessor::element_bytes, error::Defect, file_object::FileObject, json::Few, source::Source};
use crate::progress::Progress;
use crate::scene::Warning;

pub(super) fn check(source: &Source, progress: &Progress, warnings: &mut Vec<Warning>) -> Result<(), Defect> {
    let accessors = &source.root.accessors;
    progress.add_total(accessors.len() as u64);
    let mut allowance = source.check_allowance_bytes();
    let checked: Vec<bool> = accessors.iter().map(|accessor| take(&mut allowance, declared_bytes(accessor))).collect();
    if checked.contains(&false) {
        let sentence = "accessors: they overlap so often that not all of their values were checked";
        warnings.push(Warning::new(sentence));
    }
    let found: Vec<Result<Vec<Warning>, Defect>> = (accessors.par_iter().enumerate())
        .map(|(index, accessor)| {
            let defects = defects(source, accessor, checked[index]);
            progress.advance(1)?;
            let object = FileObject::item("accessor", index, accessor.name.as_deref());
            Ok(defects.into_iter().map(|defect| object.warning(format!("it {defect}"))).collect())
        })
        .collect();
    let mut few = Few::default();
    for defect in found.into_iter().collect::<Result<Vec<_>, _>>()?.into_iter().flatten() {
        few.add(|| defect);
    }
    few.append_to(warnings);
    Ok(())
}

/// Whether so much of the allowance is left; it is gone then.
pub(super) fn take(allowance: &mut u64, bytes: u64) -> bool {
    let rest = allowance.checked_sub(bytes);
    *allowance = rest.unwrap_or(*allowance);
    rest.is_some()
}

/// What all its elements take, whether they are there or not.
pub(super) fn declared_bytes(accessor: &Accessor) -> u64 {
    accessor.count.0.saturating_mul(element_bytes(accessor).unwrap_or(0) as u64)
}

fn defects(source: &Source, accessor: &Accessor, with_values: bool) -> Vec<String> {
    let mut defects: Vec<String> = misplaced(source, accessor).into_iter().collect();
    let is_stored = accessor.buffer_view.is_some() || accessor.sparse.is_some();
    if !is_stored || !with_values {
        return defects; // all zero, or out of a Draco stream
    }
    let elements = match source.elements_of(accessor) {
        Ok(elements) => elements,
        Err(cause) => {
            defects.push(format!("cannot be read: {cause}"));
            return defects;
        }
    };
    for (name, declared, better) in
        [("min", &accessor.min, f64::min as fn(f64, f64) -> f64), ("max", &accessor.max, f64::max)]
    {
        let Some(declared) = declared.as_ref().and_then(Value::as_array) else { continue };
        let actual = elements.reduce(better);
        let differs = |(lane, declared): (usize, &Value)| {
            let declared = declared.as_f64()? as f32;
            let actual = *actual.get(lane)? as f32;
            (declared != actual).then(|| format!("declares the {name} {declared} and holds {actual}"))
        };
        defects.extend(declared.iter().enumerate().find_map(differs));
    }
    defects
}

/// Offsets must be multiples of the component's size, strides leave room for an element.
fn misplaced(source: &Source, accessor: &Accessor) -> Option<String> {
    let (Checked::Valid(component), Checked::Valid(shape)) = (&accessor.component_type, &accessor.type_) else {
        return Some("has a type that glTF does not know".to_owned());
    };
    let size = component.0.size() as u64;
    let offset = accessor.byte_offset.unwrap_or_default().0;
    let view = accessor.buffer_view.and_then(|view| source.root.buffer_views.get(view.value()));
    let start = view.map_or(0, |view| view.byte_offset.unwrap_or_default().0);
    if !offset.is_multiple_of(size) || !start.wrapping_add(offset).is_multiple_of(size) {
        return Some(format!("starts at byte {offset} of a view at byte {start}, not a multiple of {size}"));
    }
    if accessor.normalized && size == 4 {
        return Some("is normalized, which its component type cannot be".to_owned());
    }
    match &accessor.sparse {
        Some(sparse) if sparse.count.0 > accessor.count.0 => {
            Some(format!("replaces {} of its {} elements", sparse.count.0, accessor.count.0))
        }
        _ => (matches!(shape, Type::Scalar)
            && view.is_some_and(|view| view.byte_stride.is_some_and(|s| (s.0 as u64) < size)))
        .then(|| "has a stride below its element's size".to_owned()),
    }
}
