//! The display and the GPU that the window takes.

use std::sync::Arc;

use crate::gpu::Gpu;

/// Whether there is a display server to ask for a window.
pub fn has_display() -> bool {
    let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    !cfg!(all(unix, not(target_vendor = "apple")))
        || ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"].into_iter().any(is_set)
}

/// The adapter whose name contains `name`, or else the best one, that can show pictures in a
/// window; its device with what the kernels need.
pub fn setup(name: Option<&str>) -> egui_wgpu::WgpuSetup {
    let name = name.map(str::to_owned);
    let mut setup = egui_wgpu::WgpuSetupCreateNew::without_display_handle();
    setup.native_adapter_selector = Some(Arc::new(move |adapters, surface| {
        let fits = |adapter: &&wgpu::Adapter| surface.is_none_or(|surface| adapter.is_surface_supported(surface));
        let adapters = adapters.iter().filter(fits).cloned().collect();
        Gpu::choose_adapter(adapters, name.as_deref()).map_err(|error| error.to_string())
    }));
    setup.device_descriptor = Arc::new(Gpu::device_descriptor);
    egui_wgpu::WgpuSetup::CreateNew(setup)
}
