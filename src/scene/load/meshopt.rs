//! EXT_meshopt_compression and KHR_meshopt_compression: buffer views that hold compressed bytes.

use draco_gltf::{MeshoptFilter, MeshoptMode, meshopt};
use gltf::json::buffer::View;
use serde::Deserialize;

use super::budget::Budget;

const EXTENSIONS: [&str; 2] = ["KHR_meshopt_compression", "EXT_meshopt_compression"];

/// What a view says about its compressed bytes; an error is a cause.
pub(super) struct Compressed(Result<Declared, String>);

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Declared {
    buffer: usize,
    #[serde(default)]
    byte_offset: u64,
    byte_length: u64,
    byte_stride: usize,
    count: usize,
    mode: String,
    filter: Option<String>,
}

impl Compressed {
    /// `None` where the view is a plain one.
    pub fn of(view: &View) -> Option<Self> {
        let extensions = &view.extensions.as_ref()?.others;
        let declared = EXTENSIONS.iter().find_map(|name| extensions.get(*name))?;
        Some(Self(Declared::deserialize(declared).map_err(|error| error.to_string())))
    }

    /// `bytes_of` gives the bytes of a buffer from a start, so many.
    pub fn decode<'a>(
        &self,
        bytes_of: impl Fn(usize, u64, u64) -> Result<&'a [u8], String>,
        budget: &Budget,
    ) -> Result<Vec<u8>, String> {
        let declared = self.0.as_ref().map_err(Clone::clone)?;
        let mode = MeshoptMode::from_name(&declared.mode).map_err(|error| error.to_string())?;
        let filter = declared.filter.as_deref().unwrap_or("NONE");
        let filter = MeshoptFilter::from_name(filter).map_err(|error| error.to_string())?;
        let packed = bytes_of(declared.buffer, declared.byte_offset, declared.byte_length)?;
        let (count, stride) = (declared.count, declared.byte_stride);
        budget.spend_on(count, stride)?;
        let mut bytes = vec![0; count * stride];
        meshopt::decode_buffer_view(&mut bytes, packed, mode, filter, count, stride)
            .map_err(|error| error.to_string())?;
        Ok(bytes)
    }
}
