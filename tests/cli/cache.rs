//! Voxels kept from one run of the program to the next, and `octolume cache`.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Output;

use octolume::disk_cache::FOLDER_VARIABLE;
use serde_json::{Value, json};
use tempfile::TempDir;

use crate::scenes::Scenes;
use crate::{fields, program, small_grid};

/// A folder for a cache, and a scene to fill it with.
struct Kept {
    scenes: Scenes,
    folder: TempDir,
}

impl Kept {
    fn new() -> Self {
        Self { scenes: Scenes::new(), folder: TempDir::new().expect("a temporary folder") }
    }

    fn folder(&self) -> PathBuf {
        self.folder.path().join("voxels")
    }

    fn run<S: AsRef<OsStr>>(&self, folder: &Path, arguments: impl IntoIterator<Item = S>) -> Output {
        let mut command = program();
        command.env(FOLDER_VARIABLE, folder).args(arguments);
        command.output().expect("the program starts")
    }

    /// Standard output and standard error of a program that succeeds.
    fn succeed(&self, arguments: &[&str]) -> (String, String) {
        let output = self.run(&self.folder(), arguments);
        let [out, err] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).expect("UTF-8"));
        assert!(output.status.success(), "{err}");
        (out, err)
    }

    fn info(&self, options: &[&str]) -> (String, String) {
        let scene = self.scenes.turning_box();
        let arguments = ["info", scene.to_str().expect("UTF-8"), "--json"].map(str::to_owned);
        let arguments: Vec<String> =
            arguments.into_iter().chain(small_grid()).chain(options.iter().map(|text| (*text).to_owned())).collect();
        self.succeed(&arguments.iter().map(String::as_str).collect::<Vec<_>>())
    }

    fn cache(&self, options: &[&str]) -> Value {
        let arguments: Vec<&str> = ["cache", "--json"].into_iter().chain(options.iter().copied()).collect();
        serde_json::from_str(&self.succeed(&arguments).0).expect("JSON")
    }
}

#[test]
fn a_second_run_voxelizes_nothing_and_prints_the_same() {
    let kept = Kept::new();
    let (first, first_messages) = kept.info(&[]);
    let (second, second_messages) = kept.info(&[]);
    assert!(first_messages.contains("voxelized 1 object, 0 read from the disk cache"), "{first_messages}");
    assert!(second_messages.contains("voxelized 0 objects, 1 read from the disk cache"), "{second_messages}");
    assert_eq!(first, second);
    let (plain, messages) = kept.info(&["--no-cache"]);
    assert_eq!(plain, first);
    assert!(!messages.contains("cache"), "{messages}");
}

#[test]
fn the_cache_is_seen_capped_and_cleared() {
    let kept = Kept::new();
    let empty = kept.cache(&[]);
    assert_eq!(fields(&empty), ["bytes", "cap_bytes", "entries", "folder", "removed"]);
    assert_eq!((&empty["entries"], &empty["bytes"], &empty["cap_bytes"]), (&json!(0), &json!(0), &json!(4_u64 << 30)));
    assert_eq!(empty["folder"], json!(kept.folder()));
    assert!(!kept.folder().exists(), "looking makes nothing");
    kept.info(&[]);
    let full = kept.cache(&[]);
    let bytes = full["bytes"].as_u64().expect("a number");
    assert!(full["entries"] == 1 && bytes > 1000, "{full}");
    let text = kept.succeed(&["cache"]).0;
    assert!(text.contains("1 entry, ") && text.contains(" KiB, 4.0 GiB at most"), "{text}");
    // A cap that is too small removes at once, and holds for what comes.
    let capped = kept.cache(&["--cap", "1KiB"]);
    assert_eq!((&capped["entries"], &capped["cap_bytes"]), (&json!(0), &json!(1024)));
    assert_eq!(capped["removed"], json!({ "entries": 1, "bytes": bytes }));
    kept.info(&[]);
    assert_eq!(kept.cache(&[])["entries"], 0);
    kept.cache(&["--cap", "1 GB"]);
    kept.info(&[]);
    let cleared = kept.cache(&["clear"]);
    assert_eq!(cleared["removed"], json!({ "entries": 1, "bytes": bytes }));
    assert_eq!((&cleared["entries"], &cleared["cap_bytes"]), (&json!(0), &json!(1_000_000_000)));
    assert!(kept.info(&[]).1.contains("voxelized 1 object"));
}

#[test]
fn a_folder_that_takes_nothing_is_a_warning() {
    let kept = Kept::new();
    let file = kept.folder.path().join("file");
    std::fs::write(&file, "").expect("written");
    let scene = kept.scenes.still_box();
    let arguments = ["info".into(), scene.into_os_string()].into_iter().chain(small_grid().into_iter().map(Into::into));
    let output = kept.run(&file.join("voxels"), arguments.collect::<Vec<std::ffi::OsString>>());
    let errors = String::from_utf8(output.stderr).expect("UTF-8");
    assert!(output.status.success(), "{errors}");
    let warnings: Vec<&str> = errors.lines().filter(|line| line.starts_with("warning: voxels are not kept")).collect();
    assert!(matches!(warnings[..], [warning] if warning.contains("file/voxels cannot be written")), "{errors}");
    let output = kept.run(&file.join("voxels"), ["cache"]);
    let errors = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!((output.status.code(), errors.lines().count()), (Some(1), 1), "{errors}");
    assert!(errors.starts_with("error: ") && errors.contains("file/voxels"), "{errors}");
}

#[test]
fn an_empty_variable_is_no_cache() {
    let kept = Kept::new();
    let output = kept.run(Path::new(""), ["cache"]);
    let errors = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!(output.status.code(), Some(1));
    assert!(errors.starts_with("error: there is no disk cache: OCTOLUME_CACHE_DIR is empty"), "{errors}");
}

#[test]
fn processes_share_a_folder() {
    let kept = Kept::new();
    let outputs: Vec<String> = std::thread::scope(|scope| {
        let runs: Vec<_> = (0..3).map(|_| scope.spawn(|| kept.info(&[]).0)).collect();
        runs.into_iter().map(|run| run.join().expect("succeeds")).collect()
    });
    assert!(outputs.iter().all(|output| *output == outputs[0]));
    assert_eq!(kept.cache(&[])["entries"], 1);
    assert!(kept.info(&[]).1.contains("voxelized 0 objects"));
}
