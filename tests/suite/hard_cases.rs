//! The index of hard cases: every case of a finished section names tests that exist and run.
//!
//! `tests/hard_cases/*.tsv`: section, case, tests as `file::function`, comma-separated.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Sections whose cases must all have tests, and how many cases each has at least.
const SECTIONS: [(&str, usize); 9] = [
    ("Voxelization", 9),
    ("Transform and split", 12),
    ("Skinning and animation", 9),
    ("Accumulation", 8),
    ("Octree and neighbour pointers", 9),
    ("Averaging", 4),
    ("Light", 9),
    ("Rays and cones", 15),
    ("Camera, window, device", 16),
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn files_below(folder: &Path, extension: &str, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display())) {
        let path = entry.expect("a folder entry").path();
        if path.is_dir() {
            files_below(&path, extension, found);
        } else if path.extension().is_some_and(|found| found == extension) {
            found.push(path);
        }
    }
}

/// `file::function` of every test that runs, in the sources and in tests/.
fn known_tests() -> BTreeSet<String> {
    let mut files = Vec::new();
    files_below(&root().join("src"), "rs", &mut files);
    files_below(&root().join("tests"), "rs", &mut files);
    let mut tests = BTreeSet::new();
    for file in files {
        let stem = match file.file_stem().and_then(|stem| stem.to_str()) {
            Some("mod" | "main") => file.parent().and_then(|folder| folder.file_name()).and_then(|name| name.to_str()),
            stem => stem,
        };
        let text = fs::read_to_string(&file).unwrap_or_default();
        let mut is_test = false;
        let mut in_proptest = false;
        for line in text.lines().map(str::trim) {
            in_proptest |= line.starts_with("proptest!");
            is_test |= line.starts_with("#[test]");
            if line.starts_with("#[ignore") {
                is_test = false;
            }
            if let Some(rest) = line.strip_prefix("fn ") {
                if is_test || in_proptest {
                    let name: String = rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
                    tests.insert(format!("{}::{name}", stem.unwrap_or_default()));
                }
                is_test = false;
            }
        }
    }
    tests
}

/// Section, case and tests of every row.
fn rows() -> Vec<(String, String, Vec<String>)> {
    let mut files = Vec::new();
    files_below(&root().join("tests/hard_cases"), "tsv", &mut files);
    let text = files.iter().map(|file| fs::read_to_string(file).expect("an index file")).collect::<String>();
    let row = |line: &str| {
        let fields: Vec<&str> = line.split('\t').collect();
        let [section, case, tests] = fields[..] else { panic!("three fields, separated by tabs: {line}") };
        (section.to_owned(), case.to_owned(), tests.split(", ").map(|test| test.trim().to_owned()).collect())
    };
    text.lines().filter(|line| !line.trim().is_empty()).map(row).collect()
}

#[test]
fn every_case_names_tests_that_exist_and_are_not_ignored() {
    let known = known_tests();
    let missing: Vec<String> = rows()
        .into_iter()
        .flat_map(|(_, case, tests)| tests.into_iter().map(move |test| (case.clone(), test)))
        .filter(|(_, test)| !known.contains(test))
        .map(|(case, test)| format!("{test} (for \"{case}\")"))
        .collect();
    assert!(missing.is_empty(), "no such test, or ignored: {missing:#?}");
}

#[test]
fn no_section_has_a_gap() {
    let mut cases: BTreeMap<String, usize> = BTreeMap::new();
    for (section, _, tests) in rows() {
        assert!(!tests.is_empty());
        *cases.entry(section).or_default() += 1;
    }
    for (section, least) in SECTIONS {
        let found = cases.get(section).copied().unwrap_or(0);
        assert!(found >= least, "section \"{section}\" has {found} cases with tests, and {least} are known");
    }
}
