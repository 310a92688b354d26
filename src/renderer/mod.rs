//! wgpu: device, targets, passes.

pub mod device;
