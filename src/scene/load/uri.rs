//! What a URI of the document stands for: a `data:` URI or a file beside it. All that touches the
//! file system while a document is read is here.

use std::path::{Path, PathBuf};

use super::budget::Budget;

/// Where a URI leads.
pub(super) enum Target {
    Data(Vec<u8>),
    /// Its path, and its name in the document.
    File(PathBuf, String),
}

/// Bytes, and what was amiss with the way to them.
pub(super) struct Found {
    pub bytes: Vec<u8>,
    pub repair: Option<String>,
}

impl Target {
    /// `base_dir` is where relative URIs start.
    pub fn of(uri: &str, base_dir: Option<&Path>) -> Result<Self, String> {
        if let Some((scheme, data)) = uri.split_once(':')
            && scheme.eq_ignore_ascii_case("data")
        {
            return decode_data(data).map(Self::Data);
        }
        let scheme_end = uri.find(':').unwrap_or(usize::MAX);
        if scheme_end < uri.find('/').unwrap_or(uri.len()) {
            return Err(format!("has the URI {uri:?}, and only files beside the document and data URIs can be read"));
        }
        let relative = urlencoding::decode(uri).map_err(|_| format!("has the URI {uri:?}, which is not UTF-8"))?;
        match base_dir {
            Some(base_dir) => Ok(Self::File(base_dir.join(relative.as_ref()), relative.into_owned())),
            None => Err(format!("is in the file {relative:?}, but the document was opened from memory")),
        }
    }

    /// The bytes; a file must fit in what is left of `budget` before it is read. One that is not there is looked for
    /// with backslashes as slashes, and in any case.
    pub fn read(self, budget: &Budget) -> Result<Found, String> {
        let (path, name) = match self {
            Self::Data(bytes) => return Ok(Found { bytes, repair: None }),
            Self::File(path, name) => (path, name),
        };
        let other = if path.exists() { None } else { spelled_otherwise(&path) };
        let repair = other.as_ref().map(|other| format!("is named {name:?}, and {:?} is read", file_name(other)));
        let bytes = read_file(&other.unwrap_or(path), budget).map_err(|cause| format!("({name}) {cause}"))?;
        Ok(Found { bytes, repair })
    }
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// A file that is there, at a path that differs in case or in the kind of its slashes alone; of several the first by
/// name.
fn spelled_otherwise(path: &Path) -> Option<PathBuf> {
    let text = path.to_str()?.replace('\\', "/");
    let mut found = PathBuf::new();
    for part in Path::new(&text).components() {
        let next = found.join(part);
        found = if next.exists() { next } else { entry_in_any_case(&found, &part.as_os_str().to_string_lossy())? };
    }
    Some(found)
}

fn entry_in_any_case(folder: &Path, name: &str) -> Option<PathBuf> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let entries = std::fs::read_dir(folder).ok()?.filter_map(Result::ok).map(|entry| entry.path());
    entries.filter(|path| file_name(path).to_lowercase() == name.to_lowercase()).min()
}

/// A regular file that fits in what is left of `budget`. Errors are causes.
pub(super) fn read_file(path: &Path, budget: &Budget) -> Result<Vec<u8>, String> {
    let cannot = |error: std::io::Error| format!("cannot be read: {error}");
    let length = std::fs::metadata(path).and_then(|metadata| match metadata.is_file() {
        true => Ok(metadata.len()),
        false => Err(std::io::Error::other("it is not a file")),
    });
    budget.spend(length.map_err(cannot)?)?;
    std::fs::read(path).map_err(cannot)
}

/// What follows `data:`: `[type][;base64],payload`. Writers break long lines and percent-encode
/// what need not be, so blanks are skipped and escapes undone.
fn decode_data(data: &str) -> Result<Vec<u8>, String> {
    let Some((head, payload)) = data.split_once(',') else {
        return Err("has a data URI without a comma".to_owned());
    };
    let payload = urlencoding::decode_binary(payload.as_bytes());
    if !head.split(';').skip(1).any(|parameter| parameter.trim().eq_ignore_ascii_case("base64")) {
        return Ok(payload.into_owned());
    }
    // Some writers use the alphabet that is safe in URLs, and leave the padding away.
    let plain = |byte: u8| match byte {
        b'-' => b'+',
        b'_' => b'/',
        byte => byte,
    };
    let digits = payload.iter().copied().filter(|byte| !byte.is_ascii_whitespace()).map(plain);
    let mut digits: Vec<u8> = digits.collect();
    digits.resize(digits.len().next_multiple_of(4), b'=');
    base64::decode(digits).map_err(|error| format!("has a data URI that is not base64: {error}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_uris_are_read_as_they_are_written() {
        let decode = |uri| decode_data(uri).expect("decodes");
        assert_eq!(decode("application/octet-stream;base64,aGk+"), b"hi>");
        assert_eq!(decode(";charset=x; BASE64,aG\nk%2B "), b"hi>");
        assert_eq!(decode("text/plain,h%69 %E2%99%BB"), "hi ♻".as_bytes());
        assert_eq!(decode(";base64,-_8"), [0xfb, 0xff]);
        assert!(decode_data("base64").is_err() && decode_data(";base64,a?").is_err());
        assert!(matches!(Target::of("DATA:;base64,aGk=", None), Ok(Target::Data(bytes)) if bytes == b"hi"));
    }

    #[test]
    fn files_are_found_in_any_case_and_behind_backslashes() {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::create_dir(folder.path().join("Textures")).expect("written");
        std::fs::write(folder.path().join("Textures/wood.bin"), b"wood").expect("written");
        let read = |uri: &str| {
            let target = Target::of(uri, Some(folder.path())).expect("a file");
            target.read(&Budget::new(1 << 20)).map(|found| (found.bytes, found.repair))
        };
        assert_eq!(read("Textures/wood.bin"), Ok((b"wood".to_vec(), None)));
        for uri in ["textures/WOOD.bin", "Textures\\wood.bin", ".\\textures%5CWood.BIN"] {
            let (bytes, repair) = read(uri).expect("found");
            assert!(bytes == b"wood" && repair.is_some_and(|repair| repair.ends_with("\"wood.bin\" is read")), "{uri}");
        }
        assert!(read("textures/steel.bin").is_err());
    }
}
