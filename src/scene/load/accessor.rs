//! Bounds-checked reading of accessors: any component type, stride, sparse overlay. Every number
//! of the file is checked against the bytes that are there before anything is allocated for it.

use std::borrow::Cow;

use gltf::json::{
    Index, Root,
    accessor::{Accessor, ComponentType, sparse::Sparse},
    buffer::View,
    validation::Checked,
};

use super::source::Source;

/// The elements of one accessor; `lanes` components each.
pub(super) struct Elements<'a> {
    bytes: Cow<'a, [u8]>,
    stride: usize,
    component: ComponentType,
    normalized: bool,
    pub count: usize,
    pub lanes: usize,
}

/// What an element takes; `None` where its type is none that glTF knows.
pub(super) fn element_bytes(accessor: &Accessor) -> Option<usize> {
    match (&accessor.component_type, &accessor.type_) {
        (Checked::Valid(component), Checked::Valid(shape)) => Some(component.0.size() * shape.multiplicity()),
        _ => None,
    }
}

impl Source<'_> {
    /// Errors are causes; the caller knows what the accessor is for.
    pub fn elements(&self, index: Index<Accessor>) -> Result<Elements<'_>, String> {
        let root = &self.root;
        let accessor = root.accessors.get(index.value()).ok_or_else(|| format!("accessor {index} does not exist"))?;
        self.elements_of(accessor).map_err(|cause| format!("accessor {index} {cause}"))
    }

    /// [`Self::elements`], with causes that leave the accessor's number out.
    pub fn elements_of(&self, accessor: &Accessor) -> Result<Elements<'_>, String> {
        let root = &self.root;
        let (Checked::Valid(component), Checked::Valid(shape)) = (&accessor.component_type, &accessor.type_) else {
            return Err("has an unknown type".to_owned());
        };
        let (component, lanes) = (component.0, shape.multiplicity());
        let (size, count) = (component.size() * lanes, to_usize(accessor.count.0)?);
        let (mut bytes, mut stride) = match accessor.buffer_view {
            Some(view) => {
                self.strided(root, view, to_usize(accessor.byte_offset.unwrap_or_default().0)?, count, size)?
            }
            None => {
                self.budget.spend_on(count, size)?;
                (Cow::Owned(vec![0; count * size]), size)
            }
        };
        if let Some(sparse) = &accessor.sparse {
            self.budget.spend_on(count, size)?;
            let mut packed = pack(&bytes, stride, count, size);
            self.overlay(root, sparse, &mut packed, size)?;
            (bytes, stride) = (Cow::Owned(packed), size);
        }
        Ok(Elements { bytes, stride, component, normalized: accessor.normalized, count, lanes })
    }

    /// The bytes from the first element to the end of the last, and the distance between two.
    fn strided(
        &self,
        root: &Root,
        view: Index<View>,
        offset: usize,
        count: usize,
        size: usize,
    ) -> Result<(Cow<'_, [u8]>, usize), String> {
        let declared = root.buffer_views.get(view.value()).and_then(|view| view.byte_stride);
        let stride = declared.map_or(size, |stride| if stride.0 == 0 { size } else { stride.0 });
        if stride < size {
            return Err(format!("has a stride of {stride} bytes for elements of {size}"));
        }
        let bytes = self.view_bytes(view)?;
        let end = match count {
            0 => Some(offset),
            _ => (count - 1).checked_mul(stride).and_then(|last| last.checked_add(offset)?.checked_add(size)),
        };
        let slice = end.and_then(|end| bytes.get(offset..end));
        slice.map(|slice| (Cow::Borrowed(slice), stride)).ok_or_else(|| {
            format!("reads past the end of its buffer view ({count} elements of {stride} bytes, {} there)", bytes.len())
        })
    }

    fn overlay(&self, root: &Root, sparse: &Sparse, packed: &mut [u8], size: usize) -> Result<(), String> {
        let Checked::Valid(index_type) = sparse.indices.component_type else {
            return Err("has sparse indices of an unknown type".to_owned());
        };
        let count = to_usize(sparse.count.0)?;
        let width = index_type.0.size();
        let offset = to_usize(sparse.indices.byte_offset.0)?;
        let (indices, stride) = self.strided(root, sparse.indices.buffer_view, offset, count, width)?;
        let indices = pack(&indices, stride, count, width);
        let offset = to_usize(sparse.values.byte_offset.0)?;
        let (values, stride) = self.strided(root, sparse.values.buffer_view, offset, count, size)?;
        let values = pack(&values, stride, count, size);
        for (index, value) in indices.chunks_exact(width).zip(values.chunks_exact(size)) {
            let index = unsigned(index, index_type.0).unwrap_or(u32::MAX) as usize;
            let target = index.checked_mul(size).and_then(|at| packed.get_mut(at..at + size));
            target.ok_or_else(|| format!("has the sparse index {index}, past its end"))?.copy_from_slice(value);
        }
        Ok(())
    }
}

impl<'a> Elements<'a> {
    /// Elements without gaps, as many as there are bytes for.
    pub fn packed(bytes: &'a [u8], component: ComponentType, lanes: usize, normalized: bool) -> Self {
        let stride = component.size() * lanes;
        Self { bytes: Cow::Borrowed(bytes), stride, component, normalized, count: bytes.len() / stride.max(1), lanes }
    }

    /// Components of all elements.
    pub fn number_count(&self) -> usize {
        self.count.saturating_mul(self.lanes)
    }

    pub fn is_u32(&self) -> bool {
        self.component == ComponentType::U32
    }

    /// Chosen elements as floats; normalised integers become fractions. `N` must be `lanes`.
    pub fn floats<const N: usize>(&self, pick: impl IntoIterator<Item = usize>) -> Result<Vec<[f32; N]>, String> {
        self.expect_lanes(N)?;
        let decode = float_decoder(self.component, self.normalized);
        Ok(pick.into_iter().map(|element| self.row(element, decode)).collect())
    }

    /// Chosen elements as unsigned integers.
    pub fn unsigned<const N: usize>(&self, pick: impl IntoIterator<Item = usize>) -> Result<Vec<[u32; N]>, String> {
        self.expect_lanes(N)?;
        let component = self.component;
        if unsigned(&[0; 4], component).is_none() {
            return Err(format!("holds {component:?}, and unsigned integers are needed"));
        }
        Ok(pick.into_iter().map(|element| self.row(element, |b| unsigned(b, component).unwrap_or(0))).collect())
    }

    /// `element` must be below `count`.
    fn row<T, const N: usize>(&self, element: usize, decode: impl Fn(&[u8]) -> T) -> [T; N] {
        let width = self.component.size();
        let start = element * self.stride;
        std::array::from_fn(|lane| decode(&self.bytes[start + lane * width..start + (lane + 1) * width]))
    }

    /// The smallest, or largest, value of every component, as stored: integers are not normalised.
    pub fn reduce(&self, better: fn(f64, f64) -> f64) -> Vec<f64> {
        let width = self.component.size();
        let decode = float_decoder(self.component, false);
        let lane = |element: usize, lane: usize| {
            let start = element * self.stride + lane * width;
            f64::from(decode(&self.bytes[start..start + width]))
        };
        (0..self.lanes).filter_map(|l| (0..self.count).map(|element| lane(element, l)).reduce(better)).collect()
    }

    fn expect_lanes(&self, lanes: usize) -> Result<(), String> {
        if self.lanes == lanes {
            Ok(())
        } else {
            Err(format!("has {} components an element, and {lanes} are needed", self.lanes))
        }
    }
}

/// glTF's rules for normalised integers (its section 3.6.2).
fn float_decoder(component: ComponentType, normalized: bool) -> fn(&[u8]) -> f32 {
    match (component, normalized) {
        (ComponentType::F32, _) => |b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]),
        (ComponentType::U32, _) => |b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as f32,
        (ComponentType::U8, true) => |b| f32::from(b[0]) / 255.0,
        (ComponentType::U8, false) => |b| f32::from(b[0]),
        (ComponentType::U16, true) => |b| f32::from(u16::from_le_bytes([b[0], b[1]])) / 65535.0,
        (ComponentType::U16, false) => |b| f32::from(u16::from_le_bytes([b[0], b[1]])),
        (ComponentType::I8, true) => |b| (f32::from(b[0] as i8) / 127.0).max(-1.0),
        (ComponentType::I8, false) => |b| f32::from(b[0] as i8),
        (ComponentType::I16, true) => |b| (f32::from(i16::from_le_bytes([b[0], b[1]])) / 32767.0).max(-1.0),
        (ComponentType::I16, false) => |b| f32::from(i16::from_le_bytes([b[0], b[1]])),
    }
}

fn unsigned(b: &[u8], component: ComponentType) -> Option<u32> {
    match component {
        ComponentType::U8 => Some(u32::from(b[0])),
        ComponentType::U16 => Some(u32::from(u16::from_le_bytes([b[0], b[1]]))),
        ComponentType::U32 => Some(u32::from_le_bytes([b[0], b[1], b[2], b[3]])),
        _ => None,
    }
}

fn pack(bytes: &[u8], stride: usize, count: usize, size: usize) -> Vec<u8> {
    (0..count).flat_map(|element| &bytes[element * stride..element * stride + size]).copied().collect()
}

fn to_usize(value: u64) -> Result<usize, String> {
    usize::try_from(value).map_err(|_| format!("has the size {value}"))
}
