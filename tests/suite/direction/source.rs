//! Who imports whom, read from the sources: every path in a `use`, an expression or a type, with re-exports followed to
//! the file that defines what is named. Unit tests are left out, since they may look anywhere.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use proc_macro2::{TokenStream, TokenTree};
use syn::visit::Visit;

/// "gpu::job" for src/gpu/job.rs, "" for src/lib.rs.
pub type Module = String;

/// By module, the modules whose items it names.
pub type Imports = BTreeMap<Module, BTreeSet<Module>>;

/// Of a crate: its modules with their sources, in any order.
pub fn imports(sources: &[(Module, String)]) -> Imports {
    let parsed: BTreeMap<&str, File> =
        sources.iter().map(|(module, text)| (&**module, File::parse(module, text))).collect();
    let of_file = |(module, file): (&&str, &File)| {
        let targets = file.paths.iter().filter_map(|path| definition(&parsed, path, 0));
        ((*module).to_owned(), targets.filter(|target| target != module).collect())
    };
    parsed.iter().map(of_file).collect()
}

/// The sources of a folder as modules.
pub fn read(folder: &Path) -> Vec<(Module, String)> {
    let mut sources = Vec::new();
    collect(folder, &[], &mut sources);
    sources
}

fn collect(folder: &Path, names: &[String], sources: &mut Vec<(Module, String)>) {
    let listing = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    for entry in listing {
        let path = entry.expect("a listed file").path();
        let stem = path.file_stem().expect("a name").to_string_lossy().into_owned();
        let inner = [names, std::slice::from_ref(&stem)].concat();
        if path.is_dir() {
            collect(&path, &inner, sources);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let own = matches!(&*stem, "mod" | "lib");
            let module = if own { names.join("::") } else { inner.join("::") };
            sources.push((module, std::fs::read_to_string(&path).expect("text")));
        }
    }
}

#[derive(Default)]
struct File {
    module: Vec<String>,
    /// Imports by the name under which they are found here.
    names: BTreeMap<String, Vec<String>>,
    /// Modules of which everything is found here.
    globs: Vec<Vec<String>>,
    /// From the root of the crate on.
    paths: Vec<Vec<String>>,
}

impl File {
    fn parse(module: &str, text: &str) -> Self {
        let module = module.split("::").filter(|name| !name.is_empty()).map(str::to_owned).collect();
        let mut file = Self { module, ..Self::default() };
        file.visit_file(&syn::parse_file(text).unwrap_or_else(|error| panic!("{}: {error}", file.module.join("::"))));
        file
    }

    /// Paths in what a macro is given, which is not parsed: names with `::` between them.
    fn tokens(&mut self, tokens: TokenStream) {
        let (mut names, mut colons): (Vec<String>, u32) = (Vec::new(), 0);
        for token in tokens {
            match token {
                TokenTree::Ident(name) if colons == 2 => names.push(name.to_string()),
                TokenTree::Punct(punct) if punct.as_char() == ':' => {
                    colons += 1;
                    continue;
                }
                other => {
                    self.paths.extend(self.absolute(&std::mem::take(&mut names)));
                    match other {
                        TokenTree::Ident(name) => names = vec![name.to_string()],
                        TokenTree::Group(group) => self.tokens(group.stream()),
                        TokenTree::Punct(_) | TokenTree::Literal(_) => {}
                    }
                }
            }
            colons = 0;
        }
        self.paths.extend(self.absolute(&names));
    }

    /// From the root of this crate, if it is a path into it.
    fn absolute(&self, path: &[String]) -> Option<Vec<String>> {
        let (first, rest) = path.split_first()?;
        let up = path.iter().take_while(|name| *name == "super").count();
        match &**first {
            "crate" | "octolume" => Some(rest.to_vec()),
            "self" => Some([&self.module, rest].concat()),
            "super" => {
                let kept = self.module.len().checked_sub(up)?;
                Some([&self.module[..kept], &path[up..]].concat())
            }
            _ => None,
        }
    }

    fn tree(&mut self, tree: &syn::UseTree, before: &[String], is_public: bool) {
        let with = |name: &syn::Ident| [before, &[name.to_string()]].concat();
        match tree {
            syn::UseTree::Path(path) => self.tree(&path.tree, &with(&path.ident), is_public),
            syn::UseTree::Group(group) => group.items.iter().for_each(|tree| self.tree(tree, before, is_public)),
            syn::UseTree::Name(name) => self.named(with(&name.ident), name.ident.to_string(), is_public),
            syn::UseTree::Rename(name) => self.named(with(&name.ident), name.rename.to_string(), is_public),
            syn::UseTree::Glob(_) => {
                let path = self.absolute(before).unwrap_or_else(|| [&self.module, before].concat());
                self.paths.push(path.clone());
                self.globs.extend(is_public.then_some(path));
            }
        }
    }

    /// Without a leading keyword it is a module of this folder, or another crate, which no module here is called like.
    fn named(&mut self, path: Vec<String>, name: String, is_public: bool) {
        let path = self.absolute(&path).unwrap_or_else(|| [&self.module, &*path].concat());
        // What a module re-exports it need not use itself. A private import is found by its children too.
        self.paths.extend((!is_public).then(|| path.clone()));
        self.names.insert(name, path);
    }
}

impl<'ast> Visit<'ast> for File {
    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        let is_test = item.attrs.iter().any(|attribute| attribute.path().is_ident("cfg"));
        if !is_test {
            // Ways up begin inside of it.
            self.module.push(item.ident.to_string());
            syn::visit::visit_item_mod(self, item);
            self.module.pop();
        }
    }

    /// Whom something is shown to is not imported.
    fn visit_visibility(&mut self, _: &'ast syn::Visibility) {}

    fn visit_item_use(&mut self, item: &'ast syn::ItemUse) {
        self.tree(&item.tree, &[], !matches!(item.vis, syn::Visibility::Inherited));
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let names: Vec<String> = path.segments.iter().map(|segment| segment.ident.to_string()).collect();
        // A lone name was imported, or is defined here; longer ones may begin with a module of this folder.
        if names.len() > 1 {
            let path = self.absolute(&names).unwrap_or_else(|| [&self.module, &*names].concat());
            self.paths.push(path);
        }
        syn::visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, invoked: &'ast syn::Macro) {
        self.tokens(invoked.tokens.clone());
        syn::visit::visit_macro(self, invoked);
    }
}

/// The module that defines what a path names; `None` where it leads out of the crate.
fn definition(files: &BTreeMap<&str, File>, path: &[String], hops: u32) -> Option<Module> {
    let mut module: &[String] = &[];
    for length in (0..=path.len()).rev() {
        if files.contains_key(&*path[..length].join("::")) && (length > 0 || path.len() == 1) {
            module = &path[..length];
            break;
        }
    }
    let name = path.get(module.len());
    if module.is_empty() && !files.get("").is_some_and(|root| name.is_some_and(|name| root.names.contains_key(name))) {
        return None;
    }
    let file = files.get(&*module.join("::"))?;
    let followed = name.and_then(|name| file.names.get(name)).filter(|_| hops < 8);
    followed.and_then(|target| definition(files, target, hops + 1)).or_else(|| Some(module.join("::")))
}
