//! From bytes to a validated JSON document and its buffers: GLB chunks, files beside the
//! document, percent-encoded and `data:` URIs. All that touches the file system is here.

use std::path::Path;

use gltf::json;

use super::error::Defect;

/// Extensions whose content is understood; a file that requires any other is refused.
pub(super) const SUPPORTED_EXTENSIONS: [&str; 3] =
    ["KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_mesh_quantization"];

/// A document and its bytes. A buffer that cannot be had is an error only where something reads it.
pub(super) struct Source {
    pub document: gltf::Document,
    pub buffers: Vec<Result<Vec<u8>, String>>,
}

/// Parses and validates. `base_dir` is where relative URIs start.
pub(super) fn parse(bytes: &[u8], base_dir: Option<&Path>) -> Result<Source, Defect> {
    if bytes.starts_with(b"glTF") {
        check_glb_header(bytes)?;
    }
    let gltf = gltf::Gltf::from_slice_without_validation(bytes)
        .map_err(|error| Defect::new("document", format!("is not glTF: {error}")))?;
    let blob = gltf.blob;
    let mut root = gltf.document.into_json();
    check_version(&root)?;
    check_required_extensions(&root)?;
    check_position_accessors(&root)?;
    // Checked above, against what is read here; the validator knows fewer.
    root.extensions_required.clear();
    let document = gltf::Document::from_json(root).map_err(first_of)?;
    let buffers = document
        .as_json()
        .buffers
        .iter()
        .enumerate()
        .map(|(index, buffer)| read_buffer(index, buffer, blob.as_deref(), base_dir))
        .collect();
    Ok(Source { document, buffers })
}

/// One sentence for what may be a long list.
fn first_of(error: gltf::Error) -> Defect {
    match &error {
        gltf::Error::Validation(errors) if !errors.is_empty() => {
            let (path, first) = &errors[0];
            let more = if errors.len() > 1 { format!(" (and {} more)", errors.len() - 1) } else { String::new() };
            Defect::new(path.to_string(), format!("{}{more}", first.to_string().to_lowercase()))
        }
        _ => Defect::new("document", error.to_string()),
    }
}

/// The parser subtracts the header's size from the declared length unchecked.
fn check_glb_header(bytes: &[u8]) -> Result<(), Defect> {
    const HEADER_BYTES: usize = 12;
    let word =
        |at: usize| bytes.get(at..at + 4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as usize).unwrap_or(0);
    let (version, length) = (word(4), word(8));
    if version != 2 {
        return Err(Defect::new("GLB header", format!("has version {version}, and only glTF 2.0 can be read")));
    }
    if length <= HEADER_BYTES || length > bytes.len() {
        return Err(Defect::new("GLB header", format!("declares {length} bytes in a file of {}", bytes.len())));
    }
    Ok(())
}

fn check_version(root: &json::Root) -> Result<(), Defect> {
    let needed = root.asset.min_version.as_ref().unwrap_or(&root.asset.version);
    let supported = match root.asset.min_version {
        Some(_) => needed == "2.0",
        None => needed.starts_with("2."),
    };
    if supported {
        Ok(())
    } else {
        Err(Defect::new("asset", format!("needs glTF version \"{needed}\", and only 2.0 can be read")))
    }
}

fn check_required_extensions(root: &json::Root) -> Result<(), Defect> {
    let unknown: Vec<&str> = root
        .extensions_required
        .iter()
        .map(String::as_str)
        .filter(|name| !SUPPORTED_EXTENSIONS.contains(name))
        .collect();
    if unknown.is_empty() {
        Ok(())
    } else {
        Err(Defect::new("extensionsRequired", format!("{} cannot be read", unknown.join(", "))))
    }
}

/// The validator indexes the accessor of POSITION before it has checked that it exists.
fn check_position_accessors(root: &json::Root) -> Result<(), Defect> {
    for (mesh_index, mesh) in root.meshes.iter().enumerate() {
        for (primitive_index, primitive) in mesh.primitives.iter().enumerate() {
            for accessor in primitive.attributes.values() {
                if accessor.value() >= root.accessors.len() {
                    return Err(Defect::new(
                        format!("mesh {mesh_index}, primitive {primitive_index}"),
                        format!("names accessor {accessor}, which does not exist"),
                    ));
                }
            }
        }
    }
    Ok(())
}

fn read_buffer(
    index: usize,
    buffer: &json::Buffer,
    blob: Option<&[u8]>,
    base_dir: Option<&Path>,
) -> Result<Vec<u8>, String> {
    let mut bytes = match (&buffer.uri, blob) {
        (Some(uri), _) => read_uri(uri, base_dir).map_err(|cause| format!("buffer {index} {cause}"))?,
        (None, Some(blob)) if index == 0 => blob.to_vec(),
        (None, _) => return Err(format!("buffer {index} has no data")),
    };
    let declared = usize::try_from(buffer.byte_length.0).unwrap_or(usize::MAX);
    if bytes.len() < declared {
        return Err(format!("buffer {index} holds {} bytes and declares {declared}", bytes.len()));
    }
    bytes.truncate(declared);
    Ok(bytes)
}

/// The bytes behind a URI of the document: a `data:` URI or a file beside it.
pub(super) fn read_uri(uri: &str, base_dir: Option<&Path>) -> Result<Vec<u8>, String> {
    if let Some(data) = uri.strip_prefix("data:") {
        return decode_data_uri(data);
    }
    let scheme_end = uri.find(':').unwrap_or(usize::MAX);
    if scheme_end < uri.find('/').unwrap_or(uri.len()) {
        return Err(format!("has the URI {uri:?}, and only files beside the document and data URIs can be read"));
    }
    let relative = urlencoding::decode(uri).map_err(|_| format!("has the URI {uri:?}, which is not UTF-8"))?;
    let Some(base_dir) = base_dir else {
        return Err(format!("is in the file {relative:?}, but the document was opened from memory"));
    };
    std::fs::read(base_dir.join(relative.as_ref())).map_err(|error| format!("({relative}) cannot be read: {error}"))
}

/// What follows `data:`: `[type][;base64],payload`.
fn decode_data_uri(data: &str) -> Result<Vec<u8>, String> {
    let Some((head, payload)) = data.split_once(',') else {
        return Err("has a data URI without a comma".to_owned());
    };
    if head.ends_with(";base64") {
        base64::decode(payload).map_err(|error| format!("has a data URI that is not base64: {error}"))
    } else {
        Ok(urlencoding::decode_binary(payload.as_bytes()).into_owned())
    }
}
