//! Folders of the person, and paths as a person types them.

use std::path::{Path, PathBuf};

use directories::{BaseDirs, UserDirs};

/// Of the program, where the desktop asks for it.
pub const NAME: &str = "Octolume";

/// In the folder for pictures, or at home, or where the program was started.
pub fn screenshots() -> PathBuf {
    let user = UserDirs::new();
    let pictures = user.as_ref().map(|user| user.picture_dir().unwrap_or(user.home_dir()));
    pictures.unwrap_or(Path::new(".")).join(NAME)
}

/// A path as it was typed or pasted: `~` is home, and quotes around all of it are not part of it.
pub fn typed(text: &str) -> PathBuf {
    let base = BaseDirs::new();
    typed_at(text, base.as_ref().map(BaseDirs::home_dir))
}

fn typed_at(text: &str, home: Option<&Path>) -> PathBuf {
    let text = text.trim();
    let unquoted = ['"', '\''].into_iter().find_map(|quote| text.strip_prefix(quote)?.strip_suffix(quote));
    let text = unquoted.unwrap_or(text);
    let below_home = text.strip_prefix('~').filter(|rest| rest.is_empty() || rest.starts_with(std::path::is_separator));
    match home.zip(below_home) {
        Some((home, rest)) => home.join(rest.trim_start_matches(std::path::is_separator)),
        None => PathBuf::from(text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn home_and_quotes_are_understood_in_typed_paths() {
        let home = Some(Path::new("/home/ada"));
        for (text, expected) in [
            (" models/Fox.glb ", "models/Fox.glb"),
            ("~/Fox.glb", "/home/ada/Fox.glb"),
            ("~", "/home/ada"),
            ("\"/a b/Fox.glb\"", "/a b/Fox.glb"),
            ("'~/a b'", "/home/ada/a b"),
            ("~other/Fox.glb", "~other/Fox.glb"),
            ("\"half", "\"half"),
            ("'", "'"),
        ] {
            assert_eq!(typed_at(text, home), PathBuf::from(expected), "{text}");
        }
        assert_eq!(typed_at("~/Fox.glb", None), PathBuf::from("~/Fox.glb"));
    }

    #[test]
    fn screenshots_have_a_folder_of_their_own() {
        assert!(screenshots().ends_with("Octolume"));
    }
}
