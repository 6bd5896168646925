//! The executor: what is recorded runs as recorded, however it is cut; mistakes are sentences.

use std::time::Duration;

use octolume::gpu::{Gpu, GpuBuffer, GpuError, Job, JobState, KernelTiming, Recorder};
use wgpu::BufferUsages;

use crate::device::{gpu, open};

const WHOLE: Duration = Duration::from_millis(200);
const SLICED: Duration = Duration::from_millis(1);

const HEADER: &str = "
    #import shared/threads.wgsl
    override WORKGROUP_SIZE: u32 = 64u;
    @compute @workgroup_size(WORKGROUP_SIZE)
    fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
        let i = thread_index(id, groups);
        if (i >= threads.end) { return; }
";

/// sum[i] = a[i] + b[i] + offset
pub fn add_source() -> String {
    let bindings = "
        struct Params { offset: u32 }
        @group(0) @binding(0) var<storage, read> a: array<u32>;
        @group(0) @binding(1) var<storage, read> b: array<u32>;
        @group(0) @binding(2) var<storage, read_write> sum: array<u32>;
        @group(0) @binding(3) var<uniform> params: Params;
        @group(0) @binding(4) var<storage, read_write> unused: array<u32>;
    ";
    format!("{HEADER} sum[i] = a[i] + b[i] + params.offset; }} {bindings}")
}

/// Every thread counts itself once: visits[i] += 1.
pub fn visit_source() -> String {
    format!(
        "{HEADER} atomicAdd(&visits[i], 1u); }} @group(0) @binding(0) var<storage, read_write> visits: array<atomic<u32>>;"
    )
}

fn words(gpu: &Gpu, buffer: &GpuBuffer) -> Vec<u32> {
    gpu.read(buffer, 0..buffer.bytes()).expect("readable")
}

/// Runs a job in slices; the number of polls before it was done.
pub fn run_sliced(job: &mut Job, gpu: &Gpu, budget: Duration) -> usize {
    let mut polls = 0;
    while job.advance(gpu, budget).expect("runs") != JobState::Done {
        polls += 1;
        std::thread::sleep(Duration::from_micros(200));
    }
    polls
}

fn visits(gpu: &Gpu, threads: u64, workgroup_size: u32, budget: Duration) -> (Vec<u32>, usize, Vec<KernelTiming>) {
    let kernel = gpu.kernel_from_source("visit", &visit_source(), &[("WORKGROUP_SIZE", f64::from(workgroup_size))]);
    let buffer = gpu.buffer("visits", threads * 4, BufferUsages::empty()).expect("fits");
    let mut recorder = Recorder::default();
    recorder.pass(&kernel).bind("visits", &buffer).dispatch(threads);
    let mut job = Job::new(recorder);
    let polls = run_sliced(&mut job, gpu, budget);
    (words(gpu, &buffer), polls, job.take_timings())
}

#[test]
fn adds_and_copies() {
    let gpu = gpu();
    let kernel = gpu.kernel_from_source("add", &add_source(), &[]);
    let numbers: Vec<u32> = (0..1000).collect();
    let a = gpu.upload("a", &numbers).expect("fits");
    let sum = gpu.buffer("sum", 4000, BufferUsages::empty()).expect("fits");
    let copy = gpu.upload("copy", &[7_u32; 1000]).expect("fits");
    let mut recorder = Recorder::default();
    for offset in [1_u32, 5] {
        recorder.pass(&kernel).bind("a", &a).bind("b", &a).bind("sum", &sum).uniform("params", &offset).dispatch(1000);
    }
    recorder.copy(&sum, 400, &copy, 0, 40);
    Job::new(recorder).run_to_end(gpu).expect("runs");
    assert_eq!(words(gpu, &sum), numbers.iter().map(|i| 2 * i + 5).collect::<Vec<_>>());
    let copied = words(gpu, &copy);
    assert_eq!(copied[..10], numbers[100..110].iter().map(|i| 2 * i + 5).collect::<Vec<_>>());
    assert_eq!(copied[10..], [7; 990]);
}

#[test]
fn clears_only_what_is_asked() {
    let gpu = gpu();
    let (a, b) = (gpu.upload("a", &[1_u32; 9]).expect("fits"), gpu.upload("b", &[1_u32; 9]).expect("fits"));
    let mut recorder = Recorder::default();
    recorder.clear(&a);
    Job::new(recorder).run_to_end(gpu).expect("runs");
    assert_eq!((words(gpu, &a), words(gpu, &b)), (vec![0; 9], vec![1; 9]));
}

#[test]
fn five_million_threads_are_folded_and_run_once_each() {
    let (visits, ..) = visits(gpu(), 5_000_001, 64, WHOLE);
    assert!(visits.iter().all(|&count| count == 1));
}

#[test]
fn every_workgroup_size_runs_every_thread_once() {
    for size in [32, 64, 128, 256] {
        for threads in [0, 1, u64::from(size) - 1, u64::from(size), u64::from(size) + 1, 100_003] {
            let (visits, ..) = visits(gpu(), threads, size, WHOLE);
            assert!(visits[..threads as usize].iter().all(|&count| count == 1), "{threads} threads, {size} a group");
            assert!(visits[threads as usize..].iter().all(|&count| count == 0), "{threads} threads, {size} a group");
        }
    }
}

#[test]
fn slices_give_what_one_dispatch_gives() {
    let whole = visits(gpu(), 1_000_003, 64, WHOLE).0;
    let (sliced, polls, _) = visits(gpu(), 1_000_003, 64, SLICED);
    assert_eq!(whole, sliced);
    assert!(polls >= 3, "a budget of 1 ms takes several slices");
}

#[test]
fn many_passes_keep_their_own_uniforms_and_order() {
    let gpu = gpu();
    let append = format!(
        "{HEADER} log[step.x] = log[max(step.x, 1u) - 1u] + step.y; }}
        @group(0) @binding(0) var<storage, read_write> log: array<u32>;
        @group(0) @binding(1) var<uniform> step: vec2<u32>;"
    );
    let kernel = gpu.kernel_from_source("append", &append, &[]);
    let log = gpu.buffer("log", 4 * 700, BufferUsages::empty()).expect("fits");
    let mut recorder = Recorder::default();
    for step in 0..700_u32 {
        let mut part = Recorder::default();
        part.pass(&kernel).bind("log", &log).uniform("step", &[step, step]).dispatch(1);
        recorder.append(part);
    }
    Job::new(recorder).run_to_end(gpu).expect("runs");
    let expected: Vec<u32> = (0..700).map(|step| step * (step + 1) / 2).collect();
    assert_eq!(words(gpu, &log), expected);
}

#[test]
fn counters_count_recorded_passes_and_timings_follow_them() {
    let gpu = open();
    let before = gpu.counters();
    let (.., timings) = visits(&gpu, 1_000_000, 64, SLICED);
    let after = gpu.counters();
    assert_eq!(after.dispatches.get("visit"), Some(&1));
    assert_eq!((after.pipelines - before.pipelines, after.buffers - before.buffers), (1, 1));
    assert_eq!(timings.len(), 1);
    assert_eq!((timings[0].kernel.as_str(), timings[0].threads), ("visit", 1_000_000));
    assert!(timings[0].ms > 0.0);
}

#[test]
fn an_empty_recording_is_done_at_once_and_counts_nothing() {
    let gpu = open();
    let kernel = gpu.kernel_from_source("visit", &visit_source(), &[]);
    let buffer = gpu.buffer("visits", 0, BufferUsages::empty()).expect("fits");
    let mut recorder = Recorder::default();
    recorder.pass(&kernel).bind("visits", &buffer).dispatch(0);
    assert_eq!(Job::new(recorder).advance(&gpu, Duration::from_millis(1)), Ok(JobState::Done));
    assert!(gpu.counters().dispatches.is_empty());
}

#[test]
fn memory_lists_live_buffers_until_the_last_clone_is_dropped() {
    let gpu = open();
    let kept = gpu.upload("kept", &[0_u64; 8]).expect("fits");
    let dropped = gpu.buffer("dropped", 1000, BufferUsages::empty()).expect("fits");
    let clone = dropped.clone();
    let labels = || gpu.memory().into_iter().map(|used| (used.label, used.bytes)).collect::<Vec<_>>();
    assert_eq!(labels(), [("kept".to_owned(), 64), ("dropped".to_owned(), 1000)]);
    drop(dropped);
    assert_eq!(labels().len(), 2);
    drop(clone);
    assert_eq!(labels(), [("kept".to_owned(), 64)]);
    drop(kept);
}

#[test]
fn kernels_are_compiled_once_per_path_and_constants() {
    let gpu = open();
    let sizes = [64.0, 64.0, 128.0];
    let source = |size| gpu.kernel("shared/threads.wgsl", &[("WORKGROUP_SIZE", size)]);
    let kernels = sizes.map(source);
    assert!(std::sync::Arc::ptr_eq(&kernels[0], &kernels[1]));
    assert!(!std::sync::Arc::ptr_eq(&kernels[0], &kernels[2]));
}

#[test]
fn reads_any_whole_range_and_refuses_others() {
    let gpu = gpu();
    let buffer = gpu.upload("numbers", &[1_u32, 2, 3, 4, 5]).expect("fits");
    assert_eq!(gpu.read::<u32>(&buffer, 4..12), Ok(vec![2, 3]));
    assert_eq!(gpu.read::<u32>(&buffer, 4..4), Ok(vec![]));
    for range in [2..6, 16..24] {
        let error = gpu.read::<u32>(&buffer, range).expect_err("outside");
        assert!(matches!(error, GpuError::Range { .. }), "{error}");
    }
    let odd = gpu.upload("odd", &[1_u8, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17]).expect("fits");
    assert_eq!(gpu.read::<u8>(&odd, 16..20), Ok(vec![17, 0, 0, 0]));
}

#[test]
fn threads_that_read_at_the_same_time_all_get_their_answer() {
    let gpu = gpu();
    std::thread::scope(|scope| {
        for thread in 0..8_u32 {
            scope.spawn(move || {
                for round in 0..400 {
                    let buffer = gpu.upload("numbers", &[thread, round, 3, 4]).expect("fits");
                    assert_eq!(gpu.read::<u32>(&buffer, 0..8), Ok(vec![thread, round]));
                }
            });
        }
    });
}

#[test]
fn a_read_does_not_have_to_wait() {
    let gpu = gpu();
    let buffer = gpu.upload("numbers", &[1_u32, 2, 3, 4]).expect("fits");
    let read = gpu.start_read(&buffer, 8..16).expect("in range");
    let bytes = loop {
        if let Some(bytes) = read.take(gpu).expect("readable") {
            break bytes;
        }
    };
    assert_eq!(bytes, bytemuck::cast_slice::<u32, u8>(&[3, 4]));
}

#[test]
fn a_default_workgroup_size_reaches_kernels_that_declare_one() {
    let gpu = open().with_workgroup_size(128);
    assert_eq!(gpu.kernel_from_source("visit", &visit_source(), &[]).workgroup_size, [128, 1, 1]);
    let explicit = gpu.kernel_from_source("visit", &visit_source(), &[("WORKGROUP_SIZE", 32.0)]);
    assert_eq!(explicit.workgroup_size, [32, 1, 1]);
}

#[test]
fn a_destroyed_device_is_lost_and_says_so() {
    let gpu = open();
    let kernel = gpu.kernel_from_source("visit", &visit_source(), &[]);
    let buffer = gpu.upload("visits", &[0_u32; 64]).expect("fits");
    let mut recorder = Recorder::default();
    recorder.pass(&kernel).bind("visits", &buffer).dispatch(64);
    gpu.device.destroy();
    let error = Job::new(recorder).run_to_end(&gpu).expect_err("lost");
    assert!(matches!(error, GpuError::Lost(_)), "{error}");
    assert!(gpu.is_lost());
    let error = gpu.upload("more", &[0_u32; 64]).expect_err("lost");
    assert!(matches!(error, GpuError::Lost(_)), "{error}");
}
