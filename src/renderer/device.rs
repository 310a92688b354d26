//! Finding an adapter and opening a device on it.

use std::task::{Context, Poll, Waker};

use wgpu::{Adapter, Backends, Device, DownlevelFlags, Instance, InstanceDescriptor, InstanceFlags, Queue, Surface};

use super::targets::RadianceFormat;

/// An opened graphics device. A clone is another handle to it.
#[derive(Clone)]
pub struct Gpu {
    /// The driver's adapter: its name, features and limits.
    pub adapter: Adapter,
    /// The device that was opened on it.
    pub device: Device,
    /// The queue to which work for the device is submitted.
    pub queue: Queue,
}

impl Gpu {
    /// Whether the device is a program on the processor.
    pub fn is_software(&self) -> bool {
        self.adapter.get_info().device_type == wgpu::DeviceType::Cpu
    }

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
    /// There are adapters, but none that is described so.
    #[error("no adapter's description contains '{wanted}': this machine has {}", found.join("; "))]
    NoMatch {
        /// The part of a description that was asked for.
        wanted: String,
        /// The descriptions of the adapters that are there.
        found: Vec<String>,
    },
    /// The adapter lacks what every scene needs.
    #[error("adapter '{adapter}' cannot draw scenes ({lack}): use another one, or `velour reference`")]
    Unable {
        /// The adapter's description.
        adapter: String,
        /// What it lacks.
        lack: String,
    },
    /// The adapter's driver gives no device.
    #[error("adapter '{adapter}' gave no device: {source}")]
    Refused {
        /// The adapter's description.
        adapter: String,
        /// The driver's reason.
        source: wgpu::RequestDeviceError,
    },
}

/// An adapter of this machine, and a text that tells it from all others.
pub struct Found {
    /// The driver's adapter.
    pub adapter: Adapter,
    /// Its name, and in brackets its backend, kind and driver. Where several are the same in all these, the second ends in `#2`.
    pub description: String,
}

/// Which drivers to ask, in this order: OpenGL only where nothing better fits, because asking for it takes time.
pub const BACKENDS: [Backends; 2] = [Backends::PRIMARY, Backends::SECONDARY];

/// The entry to the drivers of some backends.
pub fn instance(backends: Backends) -> Instance {
    Instance::new(InstanceDescriptor { backends, flags: flags(), ..InstanceDescriptor::new_without_display_handle() })
}

/// The same for a window on the given `display`.
pub fn instance_for_window(backends: Backends, display: Box<dyn wgpu::wgt::WgpuHasDisplayHandle>) -> Instance {
    Instance::new(InstanceDescriptor {
        backends,
        flags: flags(),
        ..InstanceDescriptor::new_with_display_handle(display)
    })
}

/// wgpu's own for this kind of build, but without debug information in shaders: for that it searches the whole source for each
/// statement's line, in every pipeline anew.
fn flags() -> InstanceFlags {
    InstanceFlags::default().difference(InstanceFlags::DEBUG)
}

/// The adapters of an instance, the one that is taken where none is asked for first: hardware before software.
pub async fn adapters(instance: &Instance) -> Vec<Found> {
    let mut adapters = instance.enumerate_adapters(Backends::all()).await;
    adapters.sort_by_key(|adapter| speed_rank(&adapter.get_info()));
    let mut found: Vec<Found> = Vec::new();
    for adapter in adapters {
        let plain = describe(&adapter.get_info());
        let same = found.iter().filter(|other| describe(&other.adapter.get_info()) == plain).count();
        let description = if same == 0 { plain } else { format!("{plain} #{}", same + 1) };
        found.push(Found { adapter, description });
    }
    found
}

/// Opens a device to draw pictures without a window: on the adapter whose description (see [`adapters`]) is `wanted` or, where there is none
/// such, contains it (case does not count); on the best one that can draw scenes where none is asked for.
pub async fn open_offscreen(wanted: Option<&str>) -> Result<Gpu, DeviceError> {
    let (mut descriptions, mut failure) = (Vec::new(), None);
    for backends in BACKENDS {
        match open(&instance(backends), wanted, None).await {
            Ok(gpu) => return Ok(gpu),
            Err(DeviceError::NoAdapter) => {}
            Err(DeviceError::NoMatch { found, .. }) => descriptions.extend(found),
            Err(error) => failure = failure.or(Some(error)),
        }
    }
    Err(failure.unwrap_or_else(|| no_match(wanted, descriptions)))
}

/// Opens an adapter of this instance as `open_offscreen` does; with a `surface`, one that can present to it.
pub async fn open(
    instance: &Instance,
    wanted: Option<&str>,
    surface: Option<&Surface<'_>>,
) -> Result<Gpu, DeviceError> {
    let mut found = adapters(instance).await;
    found.retain(|found| surface.is_none_or(|surface| found.adapter.is_surface_supported(surface)));
    let chosen = match wanted {
        Some(wanted) => position(wanted, found.iter().map(|found| found.description.as_str())),
        // Where none is able, the first one says why.
        None => found.iter().position(|found| lack(&found.adapter).is_none()).or((!found.is_empty()).then_some(0)),
    };
    let Some(chosen) = chosen else {
        return Err(no_match(wanted, found.into_iter().map(|found| found.description).collect()));
    };
    let Found { adapter, description } = found.swap_remove(chosen);
    if let Some(lack) = lack(&adapter) {
        return Err(DeviceError::Unable { adapter: description, lack });
    }
    let descriptor = wgpu::DeviceDescriptor {
        label: Some("velour"),
        required_features: adapter.features() & wanted_features(adapter.get_info().device_type),
        required_limits: adapter.limits(),
        memory_hints: wgpu::MemoryHints::MemoryUsage,
        ..Default::default()
    };
    let refused = |source| DeviceError::Refused { adapter: description, source };
    let (device, queue) = adapter.request_device(&descriptor).await.map_err(refused)?;
    Ok(Gpu { adapter, device, queue })
}

/// The limits that a device must have to draw scenes.
pub fn needed_limits() -> wgpu::Limits {
    wgpu::Limits {
        // Of the lights.
        max_storage_buffers_per_shader_stage: 4,
        // What every pixel reads of a scene, and what stands in the way of light.
        max_storage_textures_per_shader_stage: 2,
        // Larger scenes need more, and say so.
        max_storage_buffer_binding_size: 1 << 24,
        ..wgpu::Limits::downlevel_webgl2_defaults()
    }
}

/// What the adapter lacks of what every scene needs; `None` where it can draw them.
pub fn lack(adapter: &Adapter) -> Option<String> {
    let flags = adapter.get_downlevel_capabilities().flags;
    lack_of_buffers(flags, &adapter.limits())
        .or_else(|| RadianceFormat::nearest_display(adapter, 1).is_none().then(|| "it draws no floats".to_owned()))
}

fn lack_of_buffers(flags: wgpu::DownlevelFlags, limits: &wgpu::Limits) -> Option<String> {
    for (flag, stage) in [(DownlevelFlags::VERTEX_STORAGE, "vertex"), (DownlevelFlags::FRAGMENT_STORAGE, "fragment")] {
        if !flags.contains(flag) {
            return Some(format!("its {stage} shaders have no storage buffers"));
        }
    }
    let mut lack = None;
    needed_limits().check_limits_with_fail_fn(limits, true, |name, needed, allowed| {
        lack = Some(format!("its {name} is {allowed}, of {needed} needed"));
    });
    lack
}

/// Name, backend, kind and driver, as far as the driver tells them.
fn describe(info: &wgpu::AdapterInfo) -> String {
    let wgpu::AdapterInfo { name, backend, device_type, driver, driver_info, .. } = info;
    let driver =
        [driver.as_str(), driver_info].into_iter().filter(|text| !text.is_empty()).collect::<Vec<_>>().join(" ");
    let parts = [format!("{backend:?}"), format!("{device_type:?}"), driver];
    let parts: Vec<String> = parts.into_iter().filter(|text| !text.is_empty()).collect();
    format!("{name} ({})", parts.join(", "))
}

/// Index of the description that is `wanted`, else of the first that contains it; case does not count.
fn position<'a>(wanted: &str, descriptions: impl Iterator<Item = &'a str>) -> Option<usize> {
    let wanted = wanted.to_lowercase();
    let lower: Vec<String> = descriptions.map(str::to_lowercase).collect();
    let same = lower.iter().position(|description| *description == wanted);
    same.or_else(|| lower.iter().position(|description| description.contains(&wanted)))
}

/// Multisampled targets of 32-bit floats; and, where the device shares the processor's memory, buffers that are filled
/// in place.
fn wanted_features(kind: wgpu::DeviceType) -> wgpu::Features {
    let shared = matches!(kind, wgpu::DeviceType::Cpu | wgpu::DeviceType::IntegratedGpu);
    let mappable = if shared { wgpu::Features::MAPPABLE_PRIMARY_BUFFERS } else { wgpu::Features::empty() };
    wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES | mappable
}

fn no_match(wanted: Option<&str>, found: Vec<String>) -> DeviceError {
    match wanted {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_description_picks_its_own_adapter() {
        let texts = ["big Card (Vulkan, A 1)", "Card (Vulkan, A 1)", "Card (Vulkan, A 1) #2", "Card (Gl, A 1)"];
        for (index, text) in texts.iter().enumerate() {
            assert_eq!(position(text, texts.into_iter()), Some(index), "{text}");
            assert_eq!(position(&text.to_uppercase(), texts.into_iter()), Some(index), "{text}");
        }
        let parts = [("card", Some(0)), ("#2", Some(2)), ("(gl", Some(3)), ("a 1", Some(0)), ("metal", None)];
        for (part, index) in parts {
            assert_eq!(position(part, texts.into_iter()), index, "{part}");
        }
    }

    #[test]
    fn what_an_adapter_lacks_is_named() {
        let (all, enough) = (DownlevelFlags::all(), needed_limits());
        assert_eq!(lack_of_buffers(all, &enough), None);
        let vertex = lack_of_buffers(all - DownlevelFlags::VERTEX_STORAGE, &enough);
        assert!(vertex.is_some_and(|lack| lack.contains("vertex")));
        let fragment = lack_of_buffers(all - DownlevelFlags::FRAGMENT_STORAGE, &enough);
        assert!(fragment.is_some_and(|lack| lack.contains("fragment")));
        let few = wgpu::Limits { max_storage_buffers_per_shader_stage: 3, ..enough };
        let lack = lack_of_buffers(all, &few).unwrap();
        assert_eq!(lack, "its max_storage_buffers_per_shader_stage is 3, of 4 needed");
    }
}
