// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
//! Pictures without a window.

use std::sync::atomic::{AtomicBool, Ordering};

use bevy::camera::RenderTarget;
use bevy::log::LogPlugin;
use bevy::prelude::*;
use bevy::render::RenderPlugin;
use bevy::render::gpu_readback::{Readback, ReadbackComplete};
use bevy::render::pipelined_rendering::PipelinedRenderingPlugin;
use bevy::render::render_resource::{TextureFormat, TextureUsages};
use bevy::window::ExitCondition;
use bevy::winit::WinitPlugin;

use crate::sheen::SheenPlugin;

/// Frames after which assets have reached the device.
const FRAMES_TO_SETTLE: usize = 6;
/// Frames after which a picture that has not come back is given up.
const FRAMES_TO_WAIT: usize = 1000;

/// An app that draws into an image.
pub struct Headless {
    pub app: App,
    image: Handle<Image>,
}

#[derive(Default, Resource)]
struct Bytes(Option<Vec<u8>>);

impl Headless {
    /// Without entities yet: `picture` draws what is in `app`'s world by then, by cameras that draw into `target`.
    pub fn new(size: UVec2, format: TextureFormat) -> Self {
        let windows = WindowPlugin { primary_window: None, exit_condition: ExitCondition::DontExit, ..default() };
        let renderer = RenderPlugin { synchronous_pipeline_compilation: true, ..default() };
        // A picture that comes back after the one that was taken is not missed.
        let log = LogPlugin { filter: "warn,bevy_render::gpu_readback=error".into(), ..default() };
        let mut app = App::new();
        let plugins = DefaultPlugins.set(windows).set(renderer);
        let plugins = plugins.disable::<WinitPlugin>().disable::<PipelinedRenderingPlugin>();
        // One log serves all apps of a program.
        static HAS_LOG: AtomicBool = AtomicBool::new(false);
        let has_log = HAS_LOG.swap(true, Ordering::Relaxed);
        let plugins = if has_log { plugins.disable::<LogPlugin>() } else { plugins.set(log) };
        app.add_plugins((plugins, SheenPlugin)).init_resource::<Bytes>();
        app.finish();
        app.cleanup();
        let mut image = Image::new_target_texture(size.x, size.y, format, None);
        image.texture_descriptor.usage |= TextureUsages::COPY_SRC;
        let image = app.world_mut().resource_mut::<Assets<Image>>().add(image);
        Self { app, image }
    }

    pub fn target(&self) -> RenderTarget {
        RenderTarget::Image(self.image.clone().into())
    }

    /// The texels of the world as it is now; none where the device does not answer.
    pub fn picture(&mut self) -> Option<Vec<u8>> {
        (0..FRAMES_TO_SETTLE).for_each(|_| self.app.update());
        self.app.insert_resource(Bytes::default());
        let readback = self.app.world_mut().spawn(Readback::texture(self.image.clone())).observe(keep).id();
        let bytes = (0..FRAMES_TO_WAIT).find_map(|_| {
            self.app.update();
            self.app.world_mut().resource_mut::<Bytes>().0.take()
        });
        self.app.world_mut().despawn(readback);
        bytes
    }
}

fn keep(read: On<ReadbackComplete>, mut bytes: ResMut<Bytes>) {
    bytes.0 = Some(read.data.clone());
}
