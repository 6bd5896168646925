//! What lives on the GPU is counted, and a limit holds for all of it together.

use octolume::data::octree::Slot;
use octolume::gpu::{Gpu, GpuError, GpuTexture};
use wgpu::BufferUsages;

use crate::device::open;

/// Side in pixels, four bytes each.
fn texture(gpu: &Gpu, side: u32) -> Result<GpuTexture, GpuError> {
    gpu.texture(&wgpu::TextureDescriptor {
        label: Some("square"),
        size: wgpu::Extent3d { width: side, height: side, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::R32Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    })
}

#[test]
fn bytes_in_use_are_the_sum_of_what_lives() {
    let gpu = open();
    let listed = || gpu.memory().iter().map(|used| used.bytes).sum::<u64>();
    let kept = gpu.buffer("kept", 1000, BufferUsages::empty()).expect("fits");
    let square = texture(&gpu, 16).expect("fits");
    assert_eq!((gpu.bytes_in_use(), listed()), (1000 + 1024, 1000 + 1024));
    drop(square);
    assert_eq!((gpu.bytes_in_use(), listed()), (1000, 1000));
    drop(kept);
    assert_eq!((gpu.bytes_in_use(), listed()), (0, 0));
}

#[test]
fn what_would_go_beyond_the_limit_is_refused_and_counts_nothing() {
    let gpu = open();
    gpu.limit_memory(Some(2000));
    let kept = gpu.buffer("kept", 1000, BufferUsages::empty()).expect("within the limit");
    let before = gpu.counters().buffers;
    let refused = [
        gpu.buffer("more", 1004, BufferUsages::empty()).map(drop).expect_err("beyond"),
        texture(&gpu, 16).map(drop).expect_err("beyond"),
    ];
    for (error, label, bytes) in [(&refused[0], "more", 1004), (&refused[1], "square", 1024)] {
        let GpuError::OutOfMemory { label: named, bytes: needed, cause } = error else { panic!("{error}") };
        assert_eq!((named.as_str(), *needed), (label, bytes));
        assert!(cause.contains("the limit of 2000"), "{cause}");
    }
    assert_eq!((gpu.bytes_in_use(), gpu.counters().buffers), (1000, before));
    gpu.buffer("exactly", 1000, BufferUsages::empty()).expect("up to the limit");
    drop(kept);
    texture(&gpu, 16).expect("there is room again");
    gpu.limit_memory(None);
    gpu.buffer("large", 1 << 20, BufferUsages::empty()).expect("without a limit");
}

#[test]
fn a_slot_is_made_again_where_it_lacks_bytes_or_usages() {
    let gpu = open();
    let mut slot = Slot::default();
    assert_eq!(slot.bytes(), 0);
    let first = slot.ensure(&gpu, "slot", 64).expect("fits");
    assert_eq!(slot.ensure(&gpu, "slot", 32).expect("fits").raw(), first.raw());
    let uniform = slot.ensure_as(&gpu, "slot", 64, BufferUsages::UNIFORM).expect("fits");
    assert_ne!(uniform.raw(), first.raw());
    assert!(uniform.raw().usage().contains(BufferUsages::UNIFORM));
    assert_eq!(slot.ensure(&gpu, "slot", 64).expect("fits").raw(), uniform.raw());
    assert_eq!(slot.bytes(), uniform.bytes());
}
