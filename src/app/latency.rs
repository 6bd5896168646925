//! How long the window takes from an input to the frame that shows it, measured on the GPU's side:
//! the clock stops when the GPU has finished the very commands that paint that frame.
//!
//! While frames follow each other without a pause, an input may have waited for the whole frame
//! before; it is then counted from the start of that one, so the figure is never too small.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError, Weak};
use std::time::{Duration, Instant};

/// Samples kept.
const HISTORY: usize = 240;
/// A frame that is not painted within this time (a minimised window) is not counted.
const WATCH: Duration = Duration::from_secs(2);
/// Input is expected to go on for so long after the last.
const UNDER_INPUT: Duration = Duration::from_millis(500);
const WATCH_STEP: Duration = Duration::from_millis(1);

/// Input-to-paint times of the last frames that had input.
pub struct Latency {
    samples_ms: Arc<Mutex<VecDeque<f64>>>,
    watcher: Sender<Weak<WatchedFrame>>,
    /// Start of the frame before, if the window went on to this one without a pause.
    busy_since: Option<Instant>,
    last_input: Option<Instant>,
}

impl Latency {
    pub fn new(device: wgpu::Device) -> Self {
        let (watcher, frames) = channel();
        std::thread::spawn(move || watch(&device, &frames));
        Self { samples_ms: Arc::default(), watcher, busy_since: None, last_input: None }
    }

    /// Called once a frame, when its input is known. Paints nothing.
    pub fn frame(&mut self, ui: &egui::Ui) {
        let now = Instant::now();
        let from = self.busy_since.take().unwrap_or(now);
        if ui.input(|input| input.raw.events.is_empty()) {
            return;
        }
        self.last_input = Some(now);
        let frame = Arc::new(WatchedFrame { from, done: AtomicBool::default(), samples_ms: self.samples_ms.clone() });
        // Without its thread nothing is measured, and nothing else is lost.
        let _ = self.watcher.send(Arc::downgrade(&frame));
        ui.painter().add(egui_wgpu::Callback::new_paint_callback(ui.max_rect(), PaintDone(frame)));
    }

    /// Called at the end of a frame that asks for another one at once.
    pub fn continues(&mut self, frame_start: Instant) {
        self.busy_since = Some(frame_start);
    }

    /// Somebody is at work: there was input a moment ago.
    pub fn is_under_input(&self) -> bool {
        self.last_input.is_some_and(|last| last.elapsed() < UNDER_INPUT)
    }

    /// How many of the last inputs were measured.
    pub fn count(&self) -> usize {
        self.lock().len()
    }

    pub fn last_ms(&self) -> Option<f64> {
        self.lock().back().copied()
    }

    /// The time that 95 % of the last inputs stayed within.
    pub fn p95_ms(&self) -> Option<f64> {
        let mut sorted: Vec<f64> = self.lock().iter().copied().collect();
        sorted.sort_by(f64::total_cmp);
        let rank = (sorted.len() as f64 * 0.95).ceil() as usize;
        sorted.get(rank.saturating_sub(1)).copied()
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, VecDeque<f64>> {
        self.samples_ms.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

struct WatchedFrame {
    from: Instant,
    done: AtomicBool,
    samples_ms: Arc<Mutex<VecDeque<f64>>>,
}

impl WatchedFrame {
    fn painted(&self) {
        let mut samples = self.samples_ms.lock().unwrap_or_else(PoisonError::into_inner);
        if samples.len() == HISTORY {
            samples.pop_front();
        }
        samples.push_back(self.from.elapsed().as_secs_f64() * 1e3);
        self.done.store(true, Ordering::Release);
    }
}

/// wgpu tells of finished work only to those who poll, which a still window does not.
fn watch(device: &wgpu::Device, frames: &Receiver<Weak<WatchedFrame>>) {
    for frame in frames {
        let until = Instant::now() + WATCH;
        while frame.upgrade().is_some_and(|frame| !frame.done.load(Ordering::Acquire)) && Instant::now() < until {
            std::thread::sleep(WATCH_STEP);
            if device.poll(wgpu::PollType::Poll).is_err() {
                return;
            }
        }
    }
}

struct PaintDone(Arc<WatchedFrame>);

impl egui_wgpu::CallbackTrait for PaintDone {
    fn prepare(
        &self,
        _device: &wgpu::Device,
        _queue: &wgpu::Queue,
        _screen: &egui_wgpu::ScreenDescriptor,
        encoder: &mut wgpu::CommandEncoder,
        _resources: &mut egui_wgpu::CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        let frame = Arc::clone(&self.0);
        encoder.on_submitted_work_done(move || frame.painted());
        Vec::new()
    }

    fn paint(
        &self,
        _info: egui::PaintCallbackInfo,
        _pass: &mut wgpu::RenderPass<'static>,
        _resources: &egui_wgpu::CallbackResources,
    ) {
    }
}
