//! A device that draws on the window, and the thread that draws with it.

use std::sync::Arc;

use winit::event_loop::EventLoopProxy;
use winit::window::Window;

use super::ViewerError;
use super::frame::Frame;
use super::health::Health;
use super::native::{self, Worker};
use super::order::{Order, Report};
use super::painter::Painter;
use crate::renderer::{Gpu, device};
use crate::table::SheenTable;

/// A device that draws on a window, and who draws with it.
pub(super) struct Easel {
    pub gpu: Gpu,
    pub health: Health,
    pub painter: Worker<Order, Result<Report, ViewerError>>,
}

impl Easel {
    pub fn new(
        window: &Arc<Window>,
        context: &egui::Context,
        table: Arc<SheenTable>,
        wake: EventLoopProxy<()>,
    ) -> Result<Self, ViewerError> {
        let (surface, gpu) = native::block_on(open_surface(window))?;
        // Where the loop has ended nobody is left to be woken.
        let wake = move || _ = wake.send_event(());
        let health = Health::of(&gpu, wake.clone());
        native::lose_as_asked(&gpu);
        let frame =
            native::quietly(|| Frame::new(surface, &gpu, window.inner_size().into())).map_err(ViewerError::Lost)??;
        let (mut painter, watched) = (Painter::new(gpu.clone(), frame, context.clone(), table), health.clone());
        let obey = move |order| {
            let done = native::quietly(|| painter.obey(order)).unwrap_or_else(|why| Err(ViewerError::Lost(why)));
            // What else is wrong comes of that.
            watched.ailment().map_or(done, |why| Err(ViewerError::Lost(why)))
        };
        Ok(Self { gpu, health, painter: Worker::start(obey, wake) })
    }
}

/// A surface of the window and a device that presents to it.
async fn open_surface(window: &Arc<Window>) -> Result<(wgpu::Surface<'static>, Gpu), ViewerError> {
    let mut failure = ViewerError::Device(device::DeviceError::NoAdapter);
    for backends in device::BACKENDS {
        let instance = device::instance_for_window(backends, Box::new(Arc::clone(window)));
        let opened = match instance.create_surface(Arc::clone(window)) {
            Ok(surface) => device::open(&instance, None, Some(&surface)).await.map(|gpu| (surface, gpu)),
            Err(_) => continue,
        };
        match opened {
            Ok(opened) => return Ok(opened),
            Err(error) => failure = ViewerError::Device(error),
        }
    }
    Err(failure)
}
