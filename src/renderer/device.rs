//! Finding an adapter and opening a device on it.

use wgpu::{Adapter, Device, Instance, InstanceDescriptor, Queue, Surface};

/// An opened graphics device.
pub struct Gpu {
    pub adapter: Adapter,
    pub device: Device,
    pub queue: Queue,
}

/// No device could be opened.
#[derive(Debug, thiserror::Error)]
pub enum DeviceError {
    #[error("no graphics adapter was found: install a Vulkan driver (scripts/setup does), or see `velour info`")]
    NoAdapter,
    #[error("no adapter's name contains '{wanted}': this machine has {found}")]
    NoMatch { wanted: String, found: String },
    #[error("adapter '{adapter}' gave no device: {source}")]
    Refused { adapter: String, source: wgpu::RequestDeviceError },
}

/// The entry to the drivers. Windows pass their event loop's display handle in `descriptor`.
pub fn instance() -> Instance {
    Instance::new(InstanceDescriptor::new_without_display_handle_from_env())
}

/// Opens the adapter whose name contains `name_part` (case does not count), or the best one where none is asked for.
/// With a `surface`, only adapters that can present to it count.
pub async fn open(
    instance: &Instance,
    name_part: Option<&str>,
    surface: Option<&Surface<'_>>,
) -> Result<Gpu, DeviceError> {
    let mut adapters = instance.enumerate_adapters(wgpu::Backends::all()).await;
    adapters.retain(|adapter| surface.is_none_or(|surface| adapter.is_surface_supported(surface)));
    // Hardware before software, Vulkan, Metal and DirectX before OpenGL; the order of enumeration decides ties.
    adapters.sort_by_key(|adapter| rank(&adapter.get_info()));
    let names: Vec<String> = adapters.iter().map(|adapter| adapter.get_info().name).collect();
    let adapter = match name_part {
        None => adapters.into_iter().next().ok_or(DeviceError::NoAdapter)?,
        Some(wanted) => {
            let found = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
            let matches = |adapter: &Adapter| adapter.get_info().name.to_lowercase().contains(&wanted.to_lowercase());
            let error = || DeviceError::NoMatch { wanted: wanted.to_owned(), found };
            adapters.into_iter().find(matches).ok_or_else(error)?
        }
    };
    let descriptor = wgpu::DeviceDescriptor {
        label: Some("velour"),
        required_features: adapter.features() & wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES,
        required_limits: adapter.limits(),
        ..Default::default()
    };
    let refused = |source| DeviceError::Refused { adapter: adapter.get_info().name, source };
    let (device, queue) = adapter.request_device(&descriptor).await.map_err(refused)?;
    Ok(Gpu { adapter, device, queue })
}

fn rank(info: &wgpu::AdapterInfo) -> (u8, u8) {
    use wgpu::{Backend, DeviceType};
    let kind = match info.device_type {
        DeviceType::DiscreteGpu => 0,
        DeviceType::IntegratedGpu => 1,
        DeviceType::VirtualGpu => 2,
        DeviceType::Other => 3,
        DeviceType::Cpu => 4,
    };
    (kind, u8::from(info.backend == Backend::Gl))
}
