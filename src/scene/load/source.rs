//! A document and the bytes it speaks of: files beside it, `data:` URIs, the binary chunk of a GLB,
//! decompressed buffer views.

use std::{borrow::Cow, collections::BTreeMap, path::Path};

use gltf::json::{Buffer, Index, Root, buffer::View};
use rayon::prelude::*;

use super::{budget::Budget, container::Container, error::Defect, file_object::FileObject, json, meshopt, uri::Target};
use crate::progress::Progress;
use crate::scene::Warning;

/// A document whose references all lead somewhere, and its bytes. A buffer or view that cannot be
/// had is an error only where something reads it.
pub(super) struct Source<'a> {
    pub root: Root,
    pub base_dir: Option<&'a Path>,
    pub budget: &'a Budget,
    buffers: Vec<Result<Cow<'a, [u8]>, String>>,
    /// Views that were compressed, by number.
    decoded: BTreeMap<usize, Result<Vec<u8>, String>>,
}

impl<'a> Source<'a> {
    /// `base_dir` is where relative URIs start.
    pub fn read(
        bytes: &'a [u8],
        base_dir: Option<&'a Path>,
        budget: &'a Budget,
        progress: &Progress,
        warnings: &mut Vec<Warning>,
    ) -> Result<Self, Defect> {
        let container = Container::read(bytes)?;
        warnings.extend(container.warnings);
        budget.spend(json::memory_bytes(container.json)).map_err(|cause| Defect::new("document", cause))?;
        let root = json::read(container.json, warnings)?;
        let mut source = Self { root, base_dir, budget, buffers: Vec::new(), decoded: BTreeMap::new() };
        for (index, buffer) in source.root.buffers.iter().enumerate() {
            let bytes = source.read_buffer(index, buffer, container.binary, warnings);
            if let (Err(cause), false) = (&bytes, source.is_fallback(index)) {
                warnings.push(Warning {
                    part: FileObject::item("buffer", index, None).part(),
                    ..Warning::new(cause.clone())
                });
            }
            source.buffers.push(bytes);
        }
        source.decode_views(progress)?;
        Ok(source)
    }

    fn read_buffer(
        &self,
        index: usize,
        buffer: &Buffer,
        binary: Option<&'a [u8]>,
        warnings: &mut Vec<Warning>,
    ) -> Result<Cow<'a, [u8]>, String> {
        let mut bytes: Cow<'a, [u8]> = match (&buffer.uri, binary) {
            (Some(uri), _) => {
                let found = Target::of(uri, self.base_dir).and_then(|target| target.read(self.budget));
                let found = found.map_err(|cause| format!("buffer {index} {cause}"))?;
                let object = FileObject::item("buffer", index, None);
                warnings.extend(found.repair.map(|repair| object.warning(format!("it {repair}"))));
                Cow::Owned(found.bytes)
            }
            (None, Some(binary)) if index == 0 => Cow::Borrowed(binary),
            (None, _) => return Err(format!("buffer {index} has no data")),
        };
        let declared = usize::try_from(buffer.byte_length.0).unwrap_or(usize::MAX);
        // The binary chunk of a GLB is padded to a multiple of 4 bytes. What lacks bytes is told where it is read.
        let padding = if buffer.uri.is_none() { 3 } else { 0 };
        if bytes.len() < declared || bytes.len() > declared.saturating_add(padding) {
            let cause = format!("it holds {} bytes and declares {declared}", bytes.len());
            warnings.push(FileObject::item("buffer", index, None).warning(cause));
        }
        match &mut bytes {
            Cow::Borrowed(bytes) => *bytes = &bytes[..declared.min(bytes.len())],
            Cow::Owned(bytes) => bytes.truncate(declared),
        }
        Ok(bytes)
    }

    /// What stands in where compression is not understood need not be there.
    fn is_fallback(&self, buffer: usize) -> bool {
        let mut views = self.root.buffer_views.iter().filter(|view| view.buffer.value() == buffer).peekable();
        views.peek().is_some() && views.all(|view| meshopt::Compressed::of(view).is_some())
    }

    fn decode_views(&mut self, progress: &Progress) -> Result<(), Defect> {
        let views = &self.root.buffer_views;
        let compressed: Vec<(usize, meshopt::Compressed)> = (views.iter().enumerate())
            .filter_map(|(index, view)| Some((index, meshopt::Compressed::of(view)?)))
            .collect();
        progress.add_total(compressed.len() as u64);
        let decoded = compressed.par_iter().map(|(index, compressed)| {
            let bytes =
                compressed.decode(|buffer, start, length| self.buffer_bytes(buffer, start, length), self.budget);
            progress.advance(1)?;
            Ok((*index, bytes))
        });
        self.decoded = decoded.collect::<Result<Vec<_>, Defect>>()?.into_iter().collect();
        Ok(())
    }

    /// Bytes that checks may look at beyond what reading the scene needs: accessors may overlap, and
    /// a small file can declare so many that looking at each takes hours.
    pub fn check_allowance_bytes(&self) -> u64 {
        const LOOKS_AT_EACH_BYTE: u64 = 16;
        const LEAST: u64 = 1 << 20;
        let stored = self.buffers.iter().flatten().map(|bytes| bytes.len() as u64);
        let decoded = self.decoded.values().flatten().map(|bytes| bytes.len() as u64);
        stored.chain(decoded).sum::<u64>().saturating_mul(LOOKS_AT_EACH_BYTE).max(LEAST)
    }

    /// Bytes of a buffer, from `start`; errors are causes.
    fn buffer_bytes(&self, buffer: usize, start: u64, length: u64) -> Result<&[u8], String> {
        let bytes = self.buffers.get(buffer).ok_or_else(|| format!("buffer {buffer} does not exist"))?;
        let bytes = bytes.as_ref().map_err(|cause| format!("needs data that is not there: {cause}"))?;
        let range = usize::try_from(start).ok().zip(start.checked_add(length).and_then(|end| end.try_into().ok()));
        range
            .and_then(|(start, end)| bytes.get(start..end))
            .ok_or_else(|| format!("ends outside buffer {buffer} ({} bytes)", bytes.len()))
    }

    /// All bytes of a buffer view, decompressed.
    pub fn view_bytes(&self, view: Index<View>) -> Result<&[u8], String> {
        self.bytes_of_view(view).map_err(|cause| format!("lies in buffer view {view}, which {cause}"))
    }

    /// [`Self::view_bytes`], with causes that leave the view's number out.
    pub fn bytes_of_view(&self, view: Index<View>) -> Result<&[u8], String> {
        if let Some(decoded) = self.decoded.get(&view.value()) {
            let cause = |cause: &String| format!("cannot be decompressed: {cause}");
            return decoded.as_ref().map(Vec::as_slice).map_err(cause);
        }
        let declared = self.root.buffer_views.get(view.value());
        let declared = declared.ok_or_else(|| "does not exist".to_owned())?;
        let start = declared.byte_offset.unwrap_or_default().0;
        self.buffer_bytes(declared.buffer.value(), start, declared.byte_length.0)
    }
}
