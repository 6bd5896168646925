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

impl Target {
    /// `base_dir` is where relative URIs start.
    pub fn of(uri: &str, base_dir: Option<&Path>) -> Result<Self, String> {
        if let Some(data) = uri.strip_prefix("data:") {
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

    /// The bytes; a file must fit in what is left of `budget` before it is read.
    pub fn read(self, budget: &Budget) -> Result<Vec<u8>, String> {
        match self {
            Self::Data(bytes) => Ok(bytes),
            Self::File(path, name) => read_file(&path, budget).map_err(|cause| format!("({name}) {cause}")),
        }
    }
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
    let digits: Vec<u8> = payload.iter().copied().filter(|byte| !byte.is_ascii_whitespace()).collect();
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
        assert!(decode_data("base64").is_err() && decode_data(";base64,a?").is_err());
    }
}
