//! Mistakes in recordings, shaders and sizes are sentences that name what is wrong and where.

use octolume::gpu::{Gpu, Job, Recorder};
use wgpu::BufferUsages;

use crate::device::gpu;
use crate::gpu::{add_source, visit_source};

fn sentence(gpu: &Gpu, record: impl FnOnce(&mut Recorder)) -> String {
    let mut recorder = Recorder::default();
    record(&mut recorder);
    Job::new(recorder).run_to_end(gpu).expect_err("refused").to_string()
}

#[test]
fn wrong_bindings_name_kernel_and_binding() {
    let gpu = gpu();
    let kernel = gpu.kernel_from_source("add", &add_source(), &[]);
    let a = gpu.upload("a", &[0_u32; 64]).expect("fits");
    let sum = gpu.upload("sum", &[0_u32; 64]).expect("fits");
    let missing = sentence(gpu, |r| r.pass(&kernel).bind("a", &a).bind("b", &a).bind("sum", &sum).dispatch(1));
    assert_eq!(missing, "kernel \"add\", binding \"params\": not bound");
    let surplus = sentence(gpu, |r| r.pass(&kernel).bind("unused", &a).dispatch(1));
    assert_eq!(surplus, "kernel \"add\", binding \"unused\": the kernel does not use it");
    let twice = sentence(gpu, |r| r.pass(&kernel).bind("a", &a).bind("a", &a).dispatch(1));
    assert_eq!(twice, "kernel \"add\", binding \"a\": bound twice");
    let kind = sentence(gpu, |r| r.pass(&kernel).uniform("a", &0_u32).dispatch(1));
    assert_eq!(kind, "kernel \"add\", binding \"a\": the kernel declares a storage buffer, something else is bound");
    let aliased = sentence(gpu, |r| {
        r.pass(&kernel).bind("a", &a).bind("b", &a).bind("sum", &a).uniform("params", &0_u32).dispatch(1);
    });
    assert_eq!(aliased, "kernel \"add\", binding \"a\": the pass also writes this buffer through another binding");
}

#[test]
fn shaders_that_do_not_compile_name_file_and_line() {
    let gpu = gpu();
    let buffer = gpu.upload("a", &[0_u32; 4]).expect("fits");
    let run = |source: &str| {
        let kernel = gpu.kernel_from_source("broken", source, &[]);
        sentence(gpu, |r| r.pass(&kernel).bind("a", &buffer).dispatch(1))
    };
    let unknown = run("#import shared/threads.wgsl\n\nfn main() { nowhere(); }\noverride WORKGROUP_SIZE: u32 = 1;");
    assert!(unknown.starts_with("broken:3: "), "{unknown}");
    let inside = run("#import shared/threads.wgsl\n@compute @workgroup_size(1) fn main() {}");
    assert!(inside.starts_with("shared/threads.wgsl:"), "{inside}");
    let import = run("\n#import shared/absent.wgsl");
    assert_eq!(import, "broken:2: #import shared/absent.wgsl: there is no such shader");
    let entry = run("fn other() {}");
    assert_eq!(entry, "broken: there is no compute entry point \"main\"");
    let absent = sentence(gpu, |r| r.pass(&gpu.kernel("no/such.wgsl", &[])).dispatch(1));
    assert_eq!(absent, "no/such.wgsl: there is no such shader");
}

#[test]
fn an_unknown_constant_is_refused() {
    let gpu = gpu();
    let kernel = gpu.kernel_from_source("visit", &visit_source(), &[("WORKGROUP_SIZES", 1.0)]);
    let message = sentence(gpu, |r| r.pass(&kernel).dispatch(1));
    assert!(message.contains("WORKGROUP_SIZES"), "{message}");
}

#[test]
fn a_buffer_beyond_the_limit_names_both_numbers() {
    let gpu = gpu();
    let bytes = gpu.limits.max_buffer_size + 4;
    let error = gpu.buffer("huge", bytes, BufferUsages::empty()).expect_err("too large").to_string();
    assert!(error.contains("\"huge\"") && error.contains(&bytes.to_string()), "{error}");
    assert!(error.contains(&gpu.limits.max_buffer_size.to_string()), "{error}");
}

#[test]
fn more_threads_than_32_bits_are_refused() {
    let gpu = gpu();
    let kernel = gpu.kernel_from_source("visit", &visit_source(), &[]);
    let buffer = gpu.upload("visits", &[0_u32; 4]).expect("fits");
    let message = sentence(gpu, |r| r.pass(&kernel).bind("visits", &buffer).dispatch(1 << 33));
    assert_eq!(message, "kernel \"visit\" cannot run 8589934592 threads: thread numbers have 32 bits");
}

#[test]
fn an_absent_adapter_is_a_sentence() {
    let Err(error) = Gpu::headless(&octolume::stages::SHADERS, Some("no such adapter")) else { panic!("found one") };
    assert!(error.to_string().starts_with("no GPU adapter has \"no such adapter\" in its name; "), "{error}");
}
