//! Finding an adapter and opening a device on it.

use std::task::{Context, Poll, Waker};

use wgpu::{Adapter, Backends, Device, Instance, InstanceDescriptor, Queue, Surface};

/// An opened graphics device.
pub struct Gpu {
    /// The driver's adapter: its name, features and limits.
    pub adapter: Adapter,
    /// The device that was opened on it.
    pub device: Device,
    /// The queue to which work for the device is submitted.
    pub queue: Queue,
}

impl Gpu {
    /// Runs a future of this crate to its end, waiting for the device whenever it is pending. Blocks; not for browsers,
    /// where the event loop does this.
    pub fn block_on<T>(&self, future: impl Future<Output = T>) -> T {
        let mut future = std::pin::pin!(future);
        let mut context = Context::from_waker(Waker::noop());
        loop {
            if let Poll::Ready(output) = future.as_mut().poll(&mut context) {
                return output;
            }
            // A failure to wait shows in the result that is waited for: a lost device fails to map its buffers.
            let _ = self.device.poll(wgpu::PollType::wait_indefinitely());
        }
    }
}

/// Why no device could be opened.
#[derive(Debug, thiserror::Error)]
pub enum DeviceError {
    /// There is no adapter at all, or none that can present to the window.
    #[error("no graphics adapter was found: install a Vulkan driver (scripts/setup does), or see `velour info`")]
    NoAdapter,
    /// There are adapters, but none of the wanted name.
    #[error("no adapter's name contains '{wanted}': this machine has {}", found.join(", "))]
    NoMatch {
        /// The part of a name that was asked for.
        wanted: String,
        /// The names of the adapters that are there.
        found: Vec<String>,
    },
    /// The adapter's driver gives no device.
    #[error("adapter '{adapter}' gave no device: {source}")]
    Refused {
        /// The adapter's name.
        adapter: String,
        /// The driver's reason.
        source: wgpu::RequestDeviceError,
    },
}

/// Which drivers to ask, in this order: OpenGL only where nothing better fits, because asking for it takes time.
pub const BACKENDS: [Backends; 2] = [Backends::PRIMARY, Backends::SECONDARY];

/// The entry to the drivers of some backends.
pub fn instance(backends: Backends) -> Instance {
    Instance::new(InstanceDescriptor { backends, ..InstanceDescriptor::new_without_display_handle() })
}

/// The same for a window on the given `display`.
pub fn instance_for_window(backends: Backends, display: Box<dyn wgpu::wgt::WgpuHasDisplayHandle>) -> Instance {
    Instance::new(InstanceDescriptor { backends, ..InstanceDescriptor::new_with_display_handle(display) })
}

/// Opens a device to draw pictures without a window: the adapter whose name contains `name_part` (case does not count),
/// or the best one where none is asked for.
pub async fn open_offscreen(name_part: Option<&str>) -> Result<Gpu, DeviceError> {
    let mut found = Vec::new();
    for backends in BACKENDS {
        match open(&instance(backends), name_part, None).await {
            Err(DeviceError::NoMatch { found: names, .. }) => found.extend(names),
            Err(DeviceError::NoAdapter) => {}
            done => return done,
        }
    }
    Err(no_match(name_part, found))
}

/// Opens an adapter of this instance as `open_offscreen` does; with a `surface`, one that can present to it.
pub async fn open(
    instance: &Instance,
    name_part: Option<&str>,
    surface: Option<&Surface<'_>>,
) -> Result<Gpu, DeviceError> {
    let mut adapters = instance.enumerate_adapters(Backends::all()).await;
    adapters.retain(|adapter| surface.is_none_or(|surface| adapter.is_surface_supported(surface)));
    adapters.sort_by_key(|adapter| speed_rank(&adapter.get_info()));
    let names = adapters.iter().map(|adapter| adapter.get_info().name).collect();
    let wanted = name_part.unwrap_or_default().to_lowercase();
    let fits = |adapter: &Adapter| adapter.get_info().name.to_lowercase().contains(&wanted);
    let adapter = adapters.into_iter().find(fits).ok_or_else(|| no_match(name_part, names))?;
    let descriptor = wgpu::DeviceDescriptor {
        label: Some("velour"),
        required_features: adapter.features() & wanted_features(adapter.get_info().device_type),
        required_limits: adapter.limits(),
        memory_hints: wgpu::MemoryHints::MemoryUsage,
        ..Default::default()
    };
    let refused = |source| DeviceError::Refused { adapter: adapter.get_info().name, source };
    let (device, queue) = adapter.request_device(&descriptor).await.map_err(refused)?;
    Ok(Gpu { adapter, device, queue })
}

/// Multisampled targets of 32-bit floats; and, where the device shares the processor's memory, buffers that are filled
/// in place.
fn wanted_features(kind: wgpu::DeviceType) -> wgpu::Features {
    let shared = matches!(kind, wgpu::DeviceType::Cpu | wgpu::DeviceType::IntegratedGpu);
    let mappable = if shared { wgpu::Features::MAPPABLE_PRIMARY_BUFFERS } else { wgpu::Features::empty() };
    wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES | mappable
}

fn no_match(name_part: Option<&str>, found: Vec<String>) -> DeviceError {
    match name_part {
        Some(wanted) if !found.is_empty() => DeviceError::NoMatch { wanted: wanted.to_owned(), found },
        _ => DeviceError::NoAdapter,
    }
}

/// Hardware before software; the order of enumeration decides ties.
fn speed_rank(info: &wgpu::AdapterInfo) -> u8 {
    match info.device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    }
}
