//! The documentation's tables are those of the measurements in `assets/measured`, and its links lead somewhere.
//!
//! ```text
//! <!-- table: FILE.json… NAME -->
//! what NAME makes of the files, and how they came about
//! <!-- end -->
//! ```
//!
//! `OCTOLUME_WRITE_TABLES=1 cargo test --test suite doc_tables` writes the tables into the pages instead.

mod accuracy;
mod bench;
mod cones;
mod discretizers;
mod forms;
mod links;
mod markdown;
pub mod measured;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use octolume::data::fragments::FRAGMENT_WORDS;
use octolume::data::light::pack_emission;
use octolume::data::pages::WORLD_VOXEL_BYTES;
use octolume::data::voxel_cache::{CacheVoxel, VoxelJoints};

use markdown::Table;
use measured::Files;

const WRITE: &str = "OCTOLUME_WRITE_TABLES";
const BEGIN: &str = "<!-- table: ";
const BEGIN_END: &str = " -->\n";
const END: &str = "<!-- end -->";
/// Of README.md: more is no front page.
const MOST_LINES: usize = 150;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All that is written for readers.
fn pages() -> Vec<PathBuf> {
    let docs = fs::read_dir(root().join("docs")).expect("docs");
    let docs = docs.map(|entry| entry.expect("an entry").path()).filter(|path| path.extension() == Some("md".as_ref()));
    let mut pages: Vec<_> = ["README.md", "ARCHITECTURE.md"].map(|page| root().join(page)).into_iter().collect();
    pages.extend(docs);
    pages
}

fn text(page: &Path) -> String {
    fs::read_to_string(page).unwrap_or_else(|error| panic!("{}: {error}", page.display()))
}

/// What a marker names: files and a table.
struct Marker<'a> {
    files: Vec<&'a str>,
    name: &'a str,
}

impl<'a> Marker<'a> {
    fn new(words: &'a str) -> Self {
        let mut files: Vec<_> = words.split_whitespace().collect();
        let name = files.pop().unwrap_or_else(|| panic!("a table without a name"));
        Self { files, name }
    }

    fn render(&self) -> String {
        let files = Files::read(&self.files);
        let table: Table = match self.name {
            "voxels" => accuracy::voxels(&files),
            "discretizers" => discretizers::discretizers(&files),
            "shadows" => accuracy::shadows(&files),
            "rebuild" => bench::rebuild(&files),
            "light" => bench::light(&files),
            "samples" => bench::samples(&files),
            "node-bytes" => bench::node_bytes(&files),
            "passes" => bench::passes(&files),
            "parts" => cones::parts(&files),
            "race" => cones::race(&files),
            "leaks" => forms::leaks(&files),
            "furnace" => forms::furnace(&files),
            "walls" => forms::walls(&files),
            "holes" => forms::holes(&files),
            name => panic!("no table is called {name}"),
        };
        format!("{table}\n{}\n", files.provenance())
    }
}

/// The page with every table made anew, and the files it took.
fn rendered<'a>(page: &Path, text: &'a str) -> (String, BTreeSet<&'a str>) {
    let (mut made, mut files) = (String::new(), BTreeSet::new());
    let mut rest = text;
    while let Some((before, behind)) = rest.split_once(BEGIN) {
        let whole = behind.split_once(BEGIN_END).and_then(|(words, body)| Some((words, body.split_once(END)?.1)));
        let (words, after) = whole.unwrap_or_else(|| panic!("{}: a table without an end", page.display()));
        let marker = Marker::new(words);
        made += &format!("{before}{BEGIN}{words}{BEGIN_END}\n{}\n{END}", marker.render());
        files.extend(marker.files);
        rest = after;
    }
    (made + rest, files)
}

#[test]
fn every_table_is_what_was_measured() {
    for page in pages() {
        let text = text(&page);
        let (made, _) = rendered(&page, &text);
        if std::env::var_os(WRITE).is_some() {
            fs::write(&page, made).unwrap_or_else(|error| panic!("{}: {error}", page.display()));
            continue;
        }
        let differing = made.lines().zip(text.lines()).find(|(made, text)| made != text);
        let (made_line, text_line) = differing.unwrap_or_default();
        assert!(
            made == text,
            "{}: {text_line:?} should be {made_line:?}; {WRITE}=1 writes the tables anew",
            page.display()
        );
    }
}

#[test]
fn every_measured_file_is_in_a_table() {
    let texts: Vec<_> = pages().into_iter().map(|page| (text(&page), page)).collect();
    let used: BTreeSet<_> = texts.iter().flat_map(|(text, page)| rendered(page, text).1).collect();
    for name in measured::names() {
        assert!(used.contains(name.as_str()), "{name} is in no table");
    }
}

#[test]
fn bytes_of_voxels_are_those_of_their_structs() {
    let page = text(&root().join("docs/discretizers.md"));
    let rows = [
        ("a cached voxel", size_of::<CacheVoxel>() as u64),
        ("its joints, where it is skinned", size_of::<VoxelJoints>() as u64),
        ("its emission, where its object emits", size_of_val(&pack_emission([1.0; 3], 1.0)) as u64),
        ("a moved voxel in a page", WORLD_VOXEL_BYTES),
        ("a part of a triangle in a cell, of the voxelizer", 4 * u64::from(FRAGMENT_WORDS)),
    ];
    rows.iter().for_each(|(what, bytes)| assert!(page.contains(&format!("| {what} | {bytes} |")), "{what}: {bytes}"));
}

#[test]
fn the_front_page_is_short() {
    let lines = text(&root().join("README.md")).lines().count();
    assert!(lines <= MOST_LINES, "README.md has {lines} lines");
}
