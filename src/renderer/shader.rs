//! The text of the first pass' shader, and modules of any text.

use wgpu::{Device, ShaderModule};

/// The files of the pass without shadows, floor by floor, and after them those that are given: each file stands on those above it in
/// this list, and a test holds the order.
macro_rules! surfaces {
    ($($shadows:literal),*) => {
        concat!(
            // What engines copy.
            include_str!("../../shaders/ltc.wgsl"),
            include_str!("../../shaders/ltc_sample.wgsl"),
            include_str!("../../shaders/sheen.wgsl"),
            include_str!("../../shaders/ggx.wgsl"),
            // What a pipeline is made for.
            include_str!("../../shaders/passes/variant.wgsl"),
            // What a frame is drawn with; what every pixel reads of the scene.
            include_str!("../../shaders/passes/frame.wgsl"),
            include_str!("../../shaders/passes/numbers.wgsl"),
            include_str!("../../shaders/passes/factors.wgsl"),
            include_str!("../../shaders/passes/emitters.wgsl"),
            // Textures, looked up.
            include_str!("../../shaders/passes/texels.wgsl"),
            // What of a pixel is covered, and what shading is filtered over it.
            include_str!("../../shaders/passes/coverage.wgsl"),
            include_str!("../../shaders/passes/filters.wgsl"),
            // Vertices; random numbers.
            include_str!("../../shaders/passes/vertices.wgsl"),
            include_str!("../../shaders/passes/randoms.wgsl"),
            // What a surface is made of.
            include_str!("../../shaders/passes/material.wgsl"),
            include_str!("../../shaders/passes/prior_sheens.wgsl"),
            // How it scatters light, and the point where it does so.
            include_str!("../../shaders/passes/lobes.wgsl"),
            include_str!("../../shaders/passes/receiver.wgsl"),
            // What of the lights arrives there, what they show, and which of them get a ray.
            include_str!("../../shaders/passes/polygons.wgsl"),
            include_str!("../../shaders/passes/patterns.wgsl"),
            include_str!("../../shaders/passes/points.wgsl"),
            include_str!("../../shaders/passes/picks.wgsl"),
            include_str!("../../shaders/passes/lights.wgsl"),
            // All of it together.
            include_str!("../../shaders/passes/shading.wgsl"),
            // Entry points.
            include_str!("../../shaders/passes/surfaces.wgsl"),
            include_str!("../../shaders/passes/prior_albedos.wgsl"),
            $(include_str!($shadows)),*
        )
    };
}

/// The pass' WGSL without shadows.
pub const SURFACES_WGSL: &str = surfaces!();

/// And with them, which takes longer to compile whatever of it is used.
pub const SHADOWED_WGSL: &str = surfaces!(
    // What stands in the way of light.
    "../../shaders/passes/blockers.wgsl",
    // Rays through it, to points of lights, and what they say is blocked.
    "../../shaders/passes/rays.wgsl",
    "../../shaders/passes/samples.wgsl",
    "../../shaders/passes/shadows.wgsl",
    // Entry points.
    "../../shaders/passes/shadowed.wgsl"
);

pub fn module(device: &Device, label: &str, source: &'static str) -> ShaderModule {
    let source = wgpu::ShaderSource::Wgsl(source.into());
    device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some(label), source })
}
