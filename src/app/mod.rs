//! The window: panels around a picture, over the same engine and settings as the command line.

pub mod commands;
mod history;
mod journal;
mod latency;
mod panels;
mod playback;
mod theme;
