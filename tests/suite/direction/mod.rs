mod source;
#[test]
fn print() {
    let imports = source::imports(&source::read(&std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src")));
    for (module, targets) in imports {
        for target in targets {
            println!("EDGE {module} {target}");
        }
    }
}
