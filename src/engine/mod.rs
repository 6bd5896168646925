//! Makes frames: owns what is on the GPU, and turns each request into submissions short enough that a window on the
//! same queue stays fluid. Window and command line drive this same engine.
//!
//! ```text
//! request ─► plan (a graph of parts) ─► parts recorded in flow order ─► one Job ─► what is shown
//! ```
//!
//! What fits the budget goes out in one submission. A frame that has begun is finished before the next request is
//! looked at, so that a playing animation always shows something; what is shown is always of one request.

mod error;
mod facts;
mod frame;
mod misfits;
mod parts;
mod pool;
mod read;
mod record;
mod reports;
mod request;
mod run;
mod shadow_layouts;
mod state;
mod times;

pub use error::EngineError;
pub use read::{NodeAddress, NodeFacts, StoredNode};
pub use reports::{AccuracyReport, FilterReport, LevelReport, OctreeReport};
pub use state::{Engine, EngineState, KEPT_BYTES};
pub use times::{BuildTimes, PassTiming};
