//! What a job brings back: reads by number, times by group, and what passes had to do.

use std::time::Duration;

use octolume::gpu::{Counted, Gpu, GpuBuffer, GpuError, Job, Recorder};
use wgpu::BufferUsages;

use crate::device::{gpu, open};
use crate::gpu::{run_sliced, visit_source};

const SLICED: Duration = Duration::from_millis(1);

fn done(gpu: &Gpu, recorder: Recorder) -> Job {
    let mut job = Job::new(recorder);
    run_sliced(&mut job, gpu, SLICED);
    job
}

fn visit(gpu: &Gpu, recorder: &mut Recorder, visits: &GpuBuffer, threads: u64) {
    let kernel = gpu.kernel_from_source("visit", &visit_source(), &[]);
    recorder.pass(&kernel).bind("visits", visits).dispatch(threads);
}

#[test]
fn a_read_holds_what_all_commands_left_however_they_are_cut() {
    let gpu = gpu();
    let visits = gpu.buffer("visits", 4 * 3_000_000, BufferUsages::empty()).expect("fits");
    let mut recorder = Recorder::default();
    let first = recorder.read(&visits, 0..16);
    visit(gpu, &mut recorder, &visits, 3_000_000);
    let last = recorder.read(&visits, 4 * 2_999_998..4 * 3_000_000);
    visit(gpu, &mut recorder, &visits, 3);
    let nothing = recorder.read(&visits, 8..8);
    let mut job = Job::new(recorder);
    assert!(job.take_reads().is_empty(), "nothing is here before the job is done");
    assert!(run_sliced(&mut job, gpu, SLICED) >= 3, "a budget of 1 ms takes several slices");
    let reads = job.take_reads();
    let words = |read: usize| bytemuck::pod_collect_to_vec::<u8, u32>(&reads[read]);
    assert_eq!((words(first), words(last), words(nothing)), (vec![2, 2, 2, 1], vec![1, 1], vec![]));
    assert!(job.take_reads().is_empty());
}

#[test]
fn reads_alone_make_a_recording_and_appended_ones_come_behind() {
    let gpu = gpu();
    let numbers = gpu.upload("numbers", &[1_u32, 2, 3, 4]).expect("fits");
    let (mut recorder, mut other) = (Recorder::default(), Recorder::default());
    assert!(recorder.is_empty());
    assert_eq!((recorder.read(&numbers, 4..8), other.read(&numbers, 12..16)), (0, 0));
    assert!(!recorder.is_empty());
    recorder.append(other);
    assert_eq!(recorder.read(&numbers, 0..4), 2);
    let reads = done(gpu, recorder).take_reads();
    assert_eq!(reads, [2_u32, 4, 1].map(|number| number.to_le_bytes().to_vec()));
}

#[test]
fn a_read_outside_its_buffer_is_the_jobs_error() {
    let gpu = gpu();
    let numbers = gpu.upload("numbers", &[1_u32, 2, 3, 4]).expect("fits");
    let mut recorder = Recorder::default();
    recorder.read(&numbers, 8..20);
    let error = Job::new(recorder).run_to_end(gpu).expect_err("outside");
    assert!(matches!(error, GpuError::Range { what: "read", .. }), "{error}");
}

#[test]
fn times_know_their_group_and_belong_to_their_job() {
    let gpu = open();
    let visits = gpu.buffer("visits", 4 * 64, BufferUsages::empty()).expect("fits");
    let (mut recorder, mut other) = (Recorder::default(), Recorder::default());
    recorder.clear(&visits);
    recorder.begin(3);
    visit(&gpu, &mut recorder, &visits, 64);
    other.begin(5);
    visit(&gpu, &mut other, &visits, 32);
    recorder.append(other);
    recorder.clear_part(&visits, 8);
    let mut job = Job::new(recorder);
    assert!(job.take_timings().is_empty(), "nothing has run");
    run_sliced(&mut job, &gpu, SLICED);
    let timings = job.take_timings();
    let found: Vec<_> = timings.iter().map(|t| (t.group, t.kernel.as_str(), t.threads, t.bytes_moved)).collect();
    let expected = [(0, "clear visits", 0, 256), (3, "visit", 64, 0), (5, "visit", 32, 0), (3, "clear visits", 0, 8)];
    assert_eq!(found, expected);
    assert!(job.take_timings().is_empty());
}

#[test]
fn only_the_first_bytes_are_cleared_where_only_they_are_asked_for() {
    let gpu = gpu();
    let numbers = gpu.upload("numbers", &[7_u32; 6]).expect("fits");
    let mut recorder = Recorder::default();
    recorder.clear_part(&numbers, 0);
    recorder.clear_part(&numbers, 12);
    recorder.read(&numbers, 0..24);
    let reads = done(gpu, recorder).take_reads();
    assert_eq!(bytemuck::pod_collect_to_vec::<u8, u32>(&reads[0]), [0, 0, 0, 7, 7, 7]);
    let mut recorder = Recorder::default();
    recorder.clear_part(&numbers, 28);
    let error = Job::new(recorder).run_to_end(gpu).expect_err("outside");
    assert!(matches!(error, GpuError::Range { what: "clear", .. }), "{error}");
}

#[test]
fn passes_say_what_they_had_to_do_by_what_the_gpu_counted() {
    let gpu = gpu();
    let kernel = gpu.kernel_from_source("visit", &visit_source(), &[]);
    let visits = gpu.buffer("visits", 4 * 64, BufferUsages::empty()).expect("fits");
    let counts = gpu.upload("counts", &[5_u32, 7, 9, 0]).expect("fits");
    let mut recorder = Recorder::default();
    let by = |counts: &[u32; 2]| Counted { threads: counts[0].into(), bytes: (4 * counts[1]).into() };
    recorder.pass(&kernel).bind("visits", &visits).bytes_moved(256).counted(&counts, by).dispatch(64);
    // A longer start of the same buffer, and one that the recording itself changes.
    let last = |counts: &[u32; 3]| Counted { threads: counts[2].into(), bytes: 1 };
    recorder.pass(&kernel).bind("visits", &visits).counted(&counts, last).dispatch(64);
    let seen = |visits: &u32| Counted { threads: (*visits).into(), bytes: 2 };
    recorder.pass(&kernel).bind("visits", &visits).counted(&visits, seen).dispatch(64);
    recorder.pass(&kernel).bind("visits", &visits).bytes_moved(11).dispatch(64);
    let read = recorder.read(&counts, 0..4);
    let mut job = done(gpu, recorder);
    let found: Vec<_> = job.take_timings().iter().map(|t| (t.threads, t.bytes_moved)).collect();
    assert_eq!(found, [(5, 28), (9, 1), (4, 2), (64, 11)]);
    let reads = job.take_reads();
    assert_eq!((reads.len(), &reads[read][..]), (1, &5_u32.to_le_bytes()[..]));
}

#[test]
fn a_count_that_does_not_fit_its_buffer_is_the_jobs_error() {
    let gpu = gpu();
    let kernel = gpu.kernel_from_source("visit", &visit_source(), &[]);
    let visits = gpu.buffer("visits", 16, BufferUsages::empty()).expect("fits");
    let mut recorder = Recorder::default();
    let by = |_: &[u32; 8]| Counted { threads: 0, bytes: 0 };
    recorder.pass(&kernel).bind("visits", &visits).counted(&visits, by).dispatch(1);
    let error = Job::new(recorder).run_to_end(gpu).expect_err("too short");
    assert!(matches!(error, GpuError::Range { what: "count", .. }), "{error}");
}
