//! `velour info`: what the program finds on this machine, and which tables it carries.

use velour::renderer::RadianceFormat;
use velour::renderer::device::{self, Found, adapters, instance};
use velour::table::{GgxTable, SLAB_SIDE, SheenTable, SlabTable};

use crate::console::say;
use crate::failure::Failure;

pub fn run() -> Result<(), Failure> {
    say(format!("velour {}", env!("CARGO_PKG_VERSION")));
    let adapters: Vec<Found> =
        device::BACKENDS.into_iter().flat_map(|backends| pollster::block_on(adapters(&instance(backends)))).collect();
    if adapters.is_empty() {
        say("adapters: none");
    }
    adapters.iter().for_each(report);
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

/// What `--adapter` takes, and what the adapter draws.
fn report(Found { adapter, description }: &Found) {
    say(format!("adapter: {description}"));
    if let Some(lack) = device::lack(adapter) {
        say(format!("  draws no scenes: {lack}"));
        return;
    }
    let limits = adapter.limits();
    let counts = |format: fn(&wgpu::Adapter, u32) -> Option<RadianceFormat>| {
        let drawn = [1, 4].into_iter().filter(|&samples| format(adapter, samples).is_some());
        drawn.map(|samples| samples.to_string()).collect::<Vec<_>>().join(" or ")
    };
    let (shown, linear) = (counts(RadianceFormat::display), counts(RadianceFormat::linear));
    let linear = if linear.is_empty() { format!("{shown}, in 16-bit floats") } else { linear };
    say(format!("  samples a pixel: .png {shown}; .exr {linear}"));
    say(format!("  largest picture: {0}x{0}", limits.max_texture_dimension_2d));
    say(format!("  largest buffer: {} MiB", limits.max_buffer_size >> 20));
    say(format!("  largest storage binding: {} MiB", limits.max_storage_buffer_binding_size >> 20));
}
