//! What must hold for any input.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, Once, PoisonError};
use std::time::{Duration, Instant};

use octolume::{
    prepare::prepare,
    progress::Progress,
    scene::{Scene, load},
    settings::Discretization,
};

use crate::ALLOCATOR;

/// What takes longer hangs, on however busy a machine.
const TIME_LIMIT: Duration = Duration::from_secs(120);

/// Allowed for opening a file.
const MEMORY_BUDGET_BYTES: u64 = 16 << 20;

/// Above the budget: work space of threads and decoders, and what is twice there while it moves from
/// the file's form to the scene's.
const MEMORY_SLACK_BYTES: u64 = 32 << 20;

/// More than a person reads.
const MOST_WARNINGS: usize = 256;

/// The right to allocate much: memory is counted for the whole process.
pub struct Turn(#[expect(dead_code, reason = "held until it is dropped")] MutexGuard<'static, ()>);

pub fn turn() -> Turn {
    static TURN: Mutex<()> = Mutex::new(());
    Turn(locked(&TURN))
}

/// Since when which input is under test.
static UNDER_TEST: Mutex<Option<(Instant, Vec<u8>)>> = Mutex::new(None);

pub fn check(_: &Turn, file: &[u8]) {
    let _under_test = UnderTest::start(file);
    let options = load::OpenOptions { memory_budget_bytes: MEMORY_BUDGET_BYTES, ..Default::default() };
    ALLOCATOR.reset_peak_usage();
    let before = ALLOCATOR.current_usage();
    let opened = load::open_bytes_with("input.glb", file, None, &options, &Progress::default());
    let taken = ALLOCATOR.peak_usage().saturating_sub(before) as u64;
    assert!(taken <= MEMORY_BUDGET_BYTES + MEMORY_SLACK_BYTES, "{taken} bytes for a file of {}", file.len());
    match opened {
        Ok(scene) => {
            assert_eq!(
                scene.warnings.iter().find(|warning| warning.sentence.contains('\n')),
                None,
                "a sentence is one line"
            );
            assert!(scene.warnings.len() <= MOST_WARNINGS, "{} warnings", scene.warnings.len());
            show(scene);
        }
        Err(error) => {
            let sentence = error.to_string();
            let cause = sentence.strip_prefix("input.glb: ").unwrap_or_default();
            assert!(!cause.is_empty() && !sentence.contains('\n'), "{sentence:?}");
        }
    }
}

/// What the program does with a scene before anything is drawn.
fn show(scene: Scene) {
    for clip in (0..scene.clips.len()).map(Some).chain([None]) {
        for time_secs in [0.0, 0.3, 1e9] {
            let pose = scene.pose(clip, time_secs);
            (0..scene.skins.len()).for_each(|skin| assert!(scene.joint_matrices(skin, &pose).len() < usize::MAX));
            scene.bounds_at(&pose);
        }
    }
    let scene = Arc::new(scene);
    for span in [None, Some(0.25)] {
        let discretization = Discretization { grid: 64, span, ..Discretization::default() };
        if let Err(error) = prepare(Arc::clone(&scene), &discretization, None, &Progress::default()) {
            assert!(!error.to_string().is_empty());
        }
    }
}

/// Writes the input down where it fails or hangs.
struct UnderTest;

impl UnderTest {
    fn start(file: &[u8]) -> Self {
        static WATCHDOG: Once = Once::new();
        WATCHDOG.call_once(|| {
            std::thread::spawn(watch);
        });
        *locked(&UNDER_TEST) = Some((Instant::now(), file.to_vec()));
        Self
    }
}

impl Drop for UnderTest {
    fn drop(&mut self) {
        let under_test = locked(&UNDER_TEST).take();
        if let (true, Some((_, file))) = (std::thread::panicking(), under_test) {
            save("finding.glb", &file);
        }
    }
}

/// A thread that hangs cannot be stopped: the whole process ends.
fn watch() {
    loop {
        std::thread::sleep(TIME_LIMIT / 10);
        if let Some((_, file)) = locked(&UNDER_TEST).take_if(|(since, _)| since.elapsed() > TIME_LIMIT) {
            // Past the test harness, which would keep it to itself.
            let _ = writeln!(io::stderr(), "hangs on {}", save("hang.glb", &file).display());
            std::process::exit(1);
        }
    }
}

fn save(name: &str, file: &[u8]) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::write(&path, file).expect("written");
    path
}

/// A finding poisons the locks; shrinking it goes on.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
