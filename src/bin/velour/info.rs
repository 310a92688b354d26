//! `velour info`: what the program finds on this machine, and which tables it carries.

use velour::renderer::device;
use velour::table::{GgxTable, SLAB_SIDE, SheenTable, SlabTable};

use crate::console::say;
use crate::failure::Failure;

pub fn run() -> Result<(), Failure> {
    say(format!("velour {}", env!("CARGO_PKG_VERSION")));
    let adapters =
        pollster::block_on(device::instance(wgpu::Backends::all()).enumerate_adapters(wgpu::Backends::all()));
    if adapters.is_empty() {
        say("adapters: none");
    }
    for adapter in adapters {
        let about = adapter.get_info();
        let limits = adapter.limits();
        say(format!("adapter: {} ({:?}, {:?}, {})", about.name, about.backend, about.device_type, about.driver_info));
        say(format!("  largest picture: {0}x{0}", limits.max_texture_dimension_2d));
        say(format!("  largest buffer: {} MiB", limits.max_buffer_size >> 20));
        say(format!("  largest storage binding: {} MiB", limits.max_storage_buffer_binding_size >> 20));
    }
    let table = SheenTable::embedded();
    let [alphas, mus] = table.size();
    say(format!("table: sheen_ltc {alphas}x{mus}, checksum {:08x}", table.checksum()));
    say(format!(
        "table: sheen_slab {SLAB_SIDE}x{SLAB_SIDE}x{SLAB_SIDE}, checksum {:08x}",
        SlabTable::embedded().checksum()
    ));
    let table = GgxTable::embedded();
    let [roughnesses, places] = table.size();
    say(format!("table: ggx_ltc {roughnesses}x{places}, checksum {:08x}", table.checksum()));
    Ok(())
}
