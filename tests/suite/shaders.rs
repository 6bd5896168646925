//! What can be said of shaders without a GPU: they are valid, and both languages agree on every struct and
//! constant.

use std::collections::BTreeSet;

use octolume::gpu::{Mirror, Source, parse};
use octolume::stages::{MIRRORS, SHADERS};
use wgpu::naga;

/// wgpu's default, and the least that any adapter gives a stage.
const MAX_STORAGE_BUFFERS: usize = 8;

/// Every shader that runs by itself, put together as at run time.
pub fn programs() -> impl Iterator<Item = (Source, naga::Module, naga::valid::ModuleInfo)> {
    SHADERS.files.iter().filter(|(path, _)| !path.starts_with("shared/")).map(|(path, _)| {
        let source = SHADERS.embedded(path).unwrap_or_else(|error| panic!("{error}"));
        let (module, info) = parse(&source).unwrap_or_else(|error| panic!("{error}"));
        (source, module, info)
    })
}

#[test]
fn every_shader_is_valid_and_has_an_entry_point() {
    for (source, module, info) in programs() {
        assert!(!module.entry_points.is_empty(), "{}: no entry point", source.path);
        for entry in &module.entry_points {
            let name = Some((entry.stage, entry.name.as_str()));
            let resolved = naga::back::pipeline_constants::process_overrides(&module, &info, name, &Default::default());
            assert!(resolved.is_ok(), "{}: {:?}", source.path, resolved.err());
        }
    }
}

#[test]
fn no_entry_point_uses_more_storage_buffers_than_every_adapter_has() {
    for (source, module, info) in programs() {
        for (index, entry) in module.entry_points.iter().enumerate() {
            let uses = info.get_entry_point(index);
            let is_storage = |space| matches!(space, naga::AddressSpace::Storage { .. });
            let variables = module.global_variables.iter();
            let count = variables.filter(|(handle, v)| is_storage(v.space) && !uses[*handle].is_empty()).count();
            assert!(count <= MAX_STORAGE_BUFFERS, "{} {}: {count} storage buffers", source.path, entry.name);
        }
    }
}

/// A `struct` of some program: defining file, name, size and fields with offsets.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
struct WgslStruct {
    file: String,
    name: String,
    bytes: usize,
    fields: Vec<(String, usize)>,
}

/// The structs in uniform and storage bindings, nested ones too.
fn bound_structs() -> BTreeSet<WgslStruct> {
    let mut structs = BTreeSet::new();
    for (source, module, _) in programs() {
        for (_, variable) in module.global_variables.iter().filter(|(_, variable)| variable.binding.is_some()) {
            collect_structs(&source, &module, variable.ty, &mut structs);
        }
    }
    structs
}

fn collect_structs(
    source: &Source,
    module: &naga::Module,
    ty: naga::Handle<naga::Type>,
    into: &mut BTreeSet<WgslStruct>,
) {
    let ty = &module.types[ty];
    match &ty.inner {
        naga::TypeInner::Array { base, .. } => collect_structs(source, module, *base, into),
        naga::TypeInner::Struct { members, span } => {
            let name = ty.name.clone().unwrap_or_default();
            let field = |m: &naga::StructMember| (m.name.clone().unwrap_or_default(), m.offset as usize);
            let (file, fields) = (defining_file(source, &name), members.iter().map(field).collect());
            into.insert(WgslStruct { file, name, bytes: *span as usize, fields });
            members.iter().for_each(|member| collect_structs(source, module, member.ty, into));
        }
        _ => {}
    }
}

fn defining_file(source: &Source, name: &str) -> String {
    let defines = |line: &str| {
        let rest = line.trim_start().strip_prefix("struct ").and_then(|rest| rest.trim_start().strip_prefix(name));
        rest.is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
    };
    let line = source.wgsl.lines().position(defines).expect("a struct is defined somewhere");
    source.place(line + 1).rsplit_once(':').expect("file:line").0.to_owned()
}

fn mirrors() -> impl Iterator<Item = &'static Mirror> {
    MIRRORS.iter().copied().flatten()
}

fn mirror_of(found: &WgslStruct) -> Option<&'static Mirror> {
    mirrors().find(|mirror| mirror.file == found.file && mirror.wgsl_name == found.name)
}

#[test]
fn every_bound_struct_has_a_rust_mirror_with_the_same_offsets() {
    for found in bound_structs() {
        let Some(mirror) = mirror_of(&found) else {
            panic!("{}: struct {} has no mirror! beside a Rust struct", found.file, found.name);
        };
        let fields: Vec<_> = mirror.fields.iter().map(|(name, offset)| ((*name).to_owned(), *offset)).collect();
        assert_eq!(fields, found.fields, "{} and {} of {}", mirror.rust_name, found.name, found.file);
        assert_eq!(mirror.bytes, found.bytes, "size of {} and {} of {}", mirror.rust_name, found.name, found.file);
    }
}

#[test]
fn every_mirror_is_bound_somewhere() {
    let found = bound_structs();
    for mirror in mirrors() {
        let bound = found.iter().any(|s| s.file == mirror.file && s.name == mirror.wgsl_name);
        assert!(bound, "{} mirrors {} of {}, which no shader binds", mirror.rust_name, mirror.wgsl_name, mirror.file);
    }
}

#[test]
fn shared_constants_are_in_no_shader_file_and_have_one_name_each() {
    let all: Vec<&str> = SHADERS.constants.iter().copied().flatten().map(|constant| constant.name).collect();
    let names: BTreeSet<&str> = all.iter().copied().collect();
    assert_eq!(names.len(), all.len());
    for (path, text) in SHADERS.files {
        for name in &names {
            let declares = |line: &str| line.trim_start().starts_with(&format!("const {name}:"));
            assert!(!text.lines().any(declares), "{path} declares {name} again");
        }
    }
}

#[test]
fn imports_come_once_and_constants_with_their_values() {
    let text = "#import constants\n#import shared/threads.wgsl\n#import shared/threads.wgsl\n#import constants\nx";
    let source = SHADERS.inline("test", text).expect("resolves");
    assert_eq!(source.wgsl.matches("struct Threads").count(), 1);
    assert_eq!(source.wgsl.matches("const NORMAL_MAX: u32 = 511u;").count(), 1);
    let last = source.wgsl.lines().count();
    assert_eq!(source.place(last), "test:5");
}
