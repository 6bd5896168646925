//! Modules import downwards only: the order below is that of lib.rs, of ARCHITECTURE.md and of the data. Inside a folder
//! no modules import each other in a circle, its own file among them.

mod source;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use source::{Imports, Module};

/// From the lowest to the highest.
const ORDER: [&str; 19] = [
    "digest",
    "spread",
    "progress",
    "color",
    "gpu",
    "disk_cache",
    "scene",
    "settings",
    "data",
    "lights",
    "stages",
    "prepare",
    "plan",
    "accuracy",
    "engine",
    "export",
    "experiment",
    "app",
    "cli",
];

fn imports() -> Imports {
    source::imports(&source::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src")))
}

/// Imports between the modules at the top that do not go down.
fn wrong_ways(imports: &Imports) -> Vec<String> {
    let top = |module: &str| module.split("::").next().unwrap_or_default().to_owned();
    let rank = |module: &str| ORDER.iter().position(|name| *name == top(module));
    let mut wrong = Vec::new();
    for (module, targets) in imports.iter().filter(|(module, _)| !matches!(&***module, "" | "main")) {
        match rank(module) {
            None => wrong.push(format!("{module} has no place in the order")),
            Some(own) => wrong.extend(
                targets
                    .iter()
                    .filter(|target| top(target) != top(module) && rank(target).is_none_or(|other| other > own))
                    .map(|target| format!("{module} imports {target}")),
            ),
        }
    }
    wrong
}

/// Every folder, with the imports between what it holds; its own file is called "mod".
fn folders(imports: &Imports) -> BTreeMap<String, Imports> {
    let mut folders: BTreeMap<String, Imports> = BTreeMap::new();
    let of = |folder: &str, module: &str| -> Option<Module> {
        if module == folder {
            return Some("mod".to_owned());
        }
        let inner = module.strip_prefix(folder)?.strip_prefix("::")?;
        inner.split("::").next().map(str::to_owned)
    };
    for (module, targets) in imports {
        let names: Vec<&str> = module.split("::").collect();
        for length in 1..=names.len() {
            let folder = names[..length].join("::");
            let Some(own) = of(&folder, module) else { continue };
            let inside = targets.iter().filter_map(|target| of(&folder, target)).filter(|other| *other != own);
            let inside: Vec<Module> = inside.collect();
            folders.entry(folder).or_default().entry(own).or_default().extend(inside);
        }
    }
    folders
}

/// Modules that import one another, the first circle found.
fn circle(imports: &Imports) -> Option<Vec<Module>> {
    let reached = |from: &Module| {
        let (mut reached, mut left) = (BTreeSet::new(), vec![from]);
        while let Some(module) = left.pop() {
            let next = imports.get(module).into_iter().flatten();
            left.extend(next.filter(|next| reached.insert((*next).clone())));
        }
        reached
    };
    let all: BTreeMap<&Module, BTreeSet<Module>> = imports.keys().map(|module| (module, reached(module))).collect();
    let (first, _) = all.iter().find(|(module, reached)| reached.contains(**module))?;
    Some(
        all.iter()
            .filter(|(module, reached)| all[*first].contains(**module) && reached.contains(*first))
            .map(|(module, _)| (*module).clone())
            .collect(),
    )
}

/// Circles inside folders, a sentence each.
fn circles(imports: &Imports) -> Vec<String> {
    let mut found = Vec::new();
    for (folder, inside) in folders(imports) {
        found.extend(circle(&inside).map(|circle| format!("{folder}: {} import each other", circle.join(", "))));
    }
    found
}

#[test]
fn modules_import_downwards_only() {
    assert_eq!(wrong_ways(&imports()), [""; 0]);
}

#[test]
fn no_modules_import_each_other() {
    assert_eq!(circles(&imports()), [""; 0]);
}

#[test]
fn the_library_lists_its_modules_in_that_order() {
    let library = include_str!("../../../src/lib.rs");
    let listed: Vec<&str> =
        library.lines().filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';')).collect();
    let ordered: Vec<&str> = ORDER.into_iter().filter(|module| *module != "cli").collect();
    assert_eq!(listed, ordered);
}

/// A crate of a few files.
fn crate_of(files: &[(&str, &str)]) -> Imports {
    source::imports(&files.iter().map(|(module, text)| ((*module).to_owned(), (*text).to_owned())).collect::<Vec<_>>())
}

#[test]
fn every_kind_of_wrong_import_is_found() {
    let wrong = |text: &str| {
        let files = [
            ("gpu", "pub struct Gpu;"),
            ("stages", "mod fill;"),
            ("stages::fill", "pub struct Fill;"),
            ("gpu::job", text),
        ];
        wrong_ways(&crate_of(&files))
    };
    let found = ["gpu::job imports stages::fill"];
    assert_eq!(wrong("use crate::stages::fill::Fill;"), found, "an import");
    assert_eq!(wrong("use crate::{gpu, stages::{fill::{self, Fill}}};"), found, "a list");
    assert_eq!(wrong("use crate::stages::fill as other;"), found, "another name");
    assert_eq!(wrong("use crate::stages::fill::*;"), found, "everything");
    assert_eq!(wrong("use super::super::stages::fill::Fill;"), found, "a way up");
    assert_eq!(wrong("fn f() { crate::stages::fill::f(); }"), found, "a call");
    assert_eq!(wrong("struct S { fill: crate::stages::fill::Fill }"), found, "a type");
    assert_eq!(wrong("fn f() { println!(\"{:?}\", crate::stages::fill::Fill); }"), found, "in a macro");
    assert_eq!(wrong("mod inner { use super::super::super::stages::fill::Fill; }"), found, "inside of a module");
    assert_eq!(wrong("#[cfg(test)] mod tests { use crate::stages::fill::Fill; }"), [""; 0], "tests look anywhere");
    assert_eq!(wrong("use super::Gpu; use std::sync::Arc;"), [""; 0]);
    assert_eq!(wrong_ways(&crate_of(&[("elsewhere", "")])), ["elsewhere has no place in the order"]);
}

#[test]
fn circles_are_found_through_what_is_exported_again() {
    let facade = ("engine", "mod a; mod b; pub use a::A; use b::B;");
    let two = |a: &str, b: &str| circles(&crate_of(&[facade, ("engine::a", a), ("engine::b", b)]));
    let found = ["engine: a, b import each other"];
    assert_eq!(two("use super::B; pub struct A;", "use super::A; pub struct B;"), found);
    assert_eq!(two("use super::b::B; pub struct A;", "pub struct B; fn f(_: crate::engine::A) {}"), found);
    assert_eq!(two("use super::B; pub struct A;", "pub struct B;"), [""; 0]);
    let parent =
        |text: &str| circles(&crate_of(&[("engine", "mod a; use a::A; pub struct Engine(A);"), ("engine::a", text)]));
    assert_eq!(parent("use super::Engine; pub struct A;"), ["engine: a, mod import each other"]);
    assert_eq!(parent("pub struct A(super::Engine);"), ["engine: a, mod import each other"]);
    assert_eq!(parent("pub(in crate::engine) struct A;"), [""; 0], "whom it is shown to");
    assert_eq!(parent("pub struct A; mod inner { use super::A; }"), [""; 0], "up to its own file");
}
