//! Every shader has its Rust file, every kernel its reference in the same folder, and every reference a test
//! that calls it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use wgpu::naga;

use crate::shaders::programs;

/// Paths below the repository, with `/`, and texts.
type Files = BTreeMap<String, String>;

/// Modules whose folders have shaders in folders of the same names.
const HOMES: [&str; 2] = ["stages", "experiment"];

/// What lacks, a sentence each. `shaders`: folder and name of each, and whether it is a kernel.
fn lacking(shaders: &[(&str, &str, bool)], sources: &Files, tests: &Files) -> Vec<String> {
    let tests: Vec<TestFile> = tests.values().map(|text| TestFile::new(text)).collect();
    let mut lacking = Vec::new();
    for (folder, name, is_kernel) in shaders {
        let has_folder = |home: &&str| sources.keys().any(|file| file.starts_with(&format!("src/{home}/{folder}/")));
        let homes: Vec<&str> = HOMES.into_iter().filter(has_folder).collect();
        let &[home] = &homes[..] else {
            lacking.push(format!("{folder}/{name}.wgsl: {} of {HOMES:?} have a folder {folder}", homes.len()));
            continue;
        };
        let rust = format!("src/{home}/{folder}/{name}.rs");
        if !sources.contains_key(&rust) {
            lacking.push(format!("{folder}/{name}.wgsl: no {rust}"));
        }
        if !is_kernel {
            continue;
        }
        let file = format!("src/{home}/{folder}/{name}_ref.rs");
        let module = format!("octolume::{home}::{folder}::{name}_ref");
        match sources.get(&file) {
            None => lacking.push(format!("{folder}/{name}.wgsl: no {file}")),
            Some(text) if !tests.iter().any(|test| test.calls(&module, text)) => {
                lacking.push(format!("{file}: no test calls a function of it"));
            }
            Some(_) => {}
        }
    }
    lacking
}

/// A test's imports, one path each, and the rest of its text.
struct TestFile {
    imports: BTreeSet<String>,
    body: String,
}

impl TestFile {
    fn new(text: &str) -> Self {
        let (mut imports, mut body) = (BTreeSet::new(), String::new());
        let lines = text.lines().filter(|line| !line.trim_start().starts_with("//"));
        let text = lines.collect::<Vec<_>>().join("\n");
        for statement in text.split_inclusive(';') {
            match statement.trim_start().strip_prefix("use ") {
                Some(import) => expand(import.trim_end_matches(';').trim(), &mut imports),
                None => body.push_str(statement),
            }
        }
        Self { imports, body }
    }

    /// Whether it calls a public function of the module or a public method of one of its types.
    fn calls(&self, module: &str, reference: &str) -> bool {
        let short = module.rsplit("::").next().unwrap_or(module);
        let has_module = self.imports.contains(module);
        let has_item = self.imports.iter().any(|import| import.starts_with(&format!("{module}::")));
        reference.lines().any(|line| {
            let Some(name) = line.trim_start().strip_prefix("pub fn ") else { return false };
            let name = name.split(['(', '<']).next().unwrap_or(name);
            let is_method = line.starts_with(' ');
            has_module && self.has(&format!("{short}::{name}"))
                || self.imports.contains(&format!("{module}::{name}")) && self.has(name)
                || is_method && (has_module || has_item) && self.body.contains(&format!(".{name}("))
        })
    }

    /// As whole words.
    fn has(&self, words: &str) -> bool {
        let is_inside = |c: char| c.is_alphanumeric() || c == '_';
        self.body.match_indices(words).any(|(at, _)| {
            !self.body[..at].ends_with(is_inside) && !self.body[at + words.len()..].starts_with(is_inside)
        })
    }
}

/// `a::{b, c::{self, d}}` as `a::b`, `a::c`, `a::c::d`.
fn expand(import: &str, into: &mut BTreeSet<String>) {
    let Some((stem, rest)) = import.split_once('{') else {
        let path = import.split(" as ").next().unwrap_or(import).trim();
        into.insert(path.strip_suffix("::self").unwrap_or(path).to_owned());
        return;
    };
    let inner = rest.rsplit_once('}').map_or(rest, |(inner, _)| inner);
    let (mut depth, mut start) = (0, 0);
    for (at, c) in inner.char_indices().chain([(inner.len(), ',')]) {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                let part = inner[start..at].trim();
                if !part.is_empty() {
                    expand(&format!("{}{part}", stem.trim()), into);
                }
                start = at + 1;
            }
            _ => {}
        }
    }
}

fn files_below(folder: &str) -> Files {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (mut files, mut folders) = (Files::new(), vec![root.join(folder)]);
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder of the repository") {
            let path = entry.expect("readable").path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let name = path.strip_prefix(root).expect("below").to_string_lossy().replace('\\', "/");
            files.insert(name, std::fs::read_to_string(&path).expect("text"));
        }
    }
    files
}

#[test]
fn every_shader_has_its_rust_file_and_every_kernel_a_reference_that_a_test_calls() {
    let programs: Vec<_> = programs().collect();
    let of = |(source, module, _): &'_ (octolume::gpu::Source, naga::Module, _)| {
        let (folder, name) = source.path.trim_end_matches(".wgsl").split_once('/').expect("in a folder");
        let is_kernel = module.entry_points.iter().any(|entry| entry.stage == naga::ShaderStage::Compute);
        (folder.to_owned(), name.to_owned(), is_kernel)
    };
    let shaders: Vec<_> = programs.iter().map(of).collect();
    let shaders: Vec<_> = shaders.iter().map(|(folder, name, is)| (folder.as_str(), name.as_str(), *is)).collect();
    assert!(shaders.iter().filter(|(.., is_kernel)| *is_kernel).count() > 30);
    let sources = HOMES.into_iter().flat_map(|home| files_below(&format!("src/{home}"))).collect();
    assert_eq!(lacking(&shaders, &sources, &files_below("tests/suite")), [""; 0]);
}

#[test]
fn a_missing_file_and_a_reference_that_nothing_calls_are_named() {
    let files = |list: &[(&str, &str)]| -> Files {
        list.iter().map(|(path, text)| ((*path).to_owned(), (*text).to_owned())).collect()
    };
    let reference = "pub struct Sum;\nimpl Sum {\n    pub fn resolve(&self) {}\n}\npub fn gather() {}\n";
    let stages = [
        ("src/stages/light/gather.rs", ""),
        ("src/stages/light/gather_ref.rs", reference),
        ("src/stages/fill/gather.rs", ""),
        ("src/stages/fill/gather_ref.rs", reference),
    ];
    let shaders = [("light", "gather", true), ("fill", "gather", true)];
    let light = "use octolume::stages::light::{gather, gather_ref::{self, Sum}};\nfn t() { gather_ref::gather(); }";
    let fill = "use octolume::stages::fill::gather_ref::Sum;\nfn t() { Sum.resolve(); }";
    let tests = [("tests/suite/light.rs", light), ("tests/suite/fill.rs", fill)];
    assert_eq!(lacking(&shaders, &files(&stages), &files(&tests)), [""; 0]);

    // Each file in turn: one of the same name in another folder does not stand in for it.
    for gone in 0..stages.len() {
        let rest: Vec<_> = stages.iter().enumerate().filter(|(i, _)| *i != gone).map(|(_, file)| *file).collect();
        let found = lacking(&shaders, &files(&rest), &files(&tests));
        assert!(found.len() == 1 && found[0].contains(stages[gone].0), "{gone}: {found:?}");
    }
    let uncalled = "src/stages/light/gather_ref.rs: no test calls a function of it";
    for light in [
        "",
        "use octolume::stages::light::gather_ref;\nfn t() {}",
        "use octolume::stages::light::gather_ref::Sum;\nfn gather() {}\nfn t() { gather(); }",
        "use octolume::stages::fill::gather_ref;\nfn t() { gather_ref::gather(); }",
        "use octolume::stages::light::gather_ref;\nfn t() { gather_ref::gather_more(); }",
        "use octolume::stages::light::gather_ref;\n// gather_ref::gather()",
    ] {
        assert_eq!(lacking(&shaders, &files(&stages), &files(&[tests[1], ("light.rs", light)])), [uncalled], "{light}");
    }
    let copy = [("bench", "copy", true)];
    let of_experiments =
        [("src/experiment/bench/copy.rs", ""), ("src/experiment/bench/copy_ref.rs", "pub fn copy() {}")];
    let called = files(&[("t.rs", "use octolume::experiment::bench::copy_ref;\nfn t() { copy_ref::copy(); }")]);
    assert_eq!(lacking(&copy, &files(&of_experiments), &called), [""; 0]);
    let twice = [&of_experiments[..], &[("src/stages/bench/mod.rs", "")]].concat();
    assert_eq!(lacking(&copy, &files(&twice), &called).len(), 1, "of both");
    assert_eq!(lacking(&copy, &files(&stages), &called).len(), 1, "of neither");
    // Nothing draws by a reference.
    assert_eq!(lacking(&[("light", "shadow", false)], &files(&stages), &files(&[])).len(), 1);
}
