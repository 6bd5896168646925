//! The device that the tests share.

use std::sync::LazyLock;

use octolume::gpu::Gpu;
use octolume::stages::SHADERS;

static GPU: LazyLock<Gpu> = LazyLock::new(open);

/// One device for all tests; counters and timings of it mix, so a test that looks at those opens
/// its own.
pub fn gpu() -> &'static Gpu {
    &GPU
}

/// The adapter that `OCTOLUME_TEST_ADAPTER` names, else the best.
pub fn open() -> Gpu {
    let name = std::env::var("OCTOLUME_TEST_ADAPTER").ok();
    Gpu::headless(&SHADERS, name.as_deref()).unwrap_or_else(|error| panic!("{error}"))
}
