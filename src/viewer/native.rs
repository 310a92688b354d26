//! What the viewer asks of the machine that it runs on: a display, the time, waiting, and files. All of it stands here, so that a build for a
//! browser, where none of it is to be had, replaces this file alone.

#[cfg(all(unix, not(target_vendor = "apple"), not(target_os = "android")))]
mod display;
mod folders;
mod keeping;
mod losing;
mod memory;
mod places;
mod quietly;
mod watch;

use std::sync::mpsc;
use std::time::Duration;

use crate::renderer::Gpu;

#[cfg(all(unix, not(target_vendor = "apple"), not(target_os = "android")))]
pub(super) use display::event_loop_builder;
pub(super) use folders::{absolute, entered, in_full, length, listed};
pub(super) use keeping::{Job, Keeper, Means};
pub(super) use losing::lose_as_asked;
pub(super) use memory::{age, forget, remember, remembered, tidy};
pub(super) use places::{folder, free_name, place};
use places::{numbered_place, write};
pub(super) use quietly::quietly;
pub(super) use watch::Watch;

/// A point in time.
pub(super) use std::time::Instant;

/// The time now.
pub(super) fn now() -> Instant {
    Instant::now()
}

/// The time after a delay; none where it lies beyond what the clock counts.
pub(super) fn after(delay: Duration) -> Option<Instant> {
    now().checked_add(delay)
}

/// Runs a future that needs no device to its end.
pub(super) fn block_on<T>(future: impl Future<Output = T>) -> T {
    pollster::block_on(future)
}

/// Runs a future that waits for the device to its end.
pub(super) fn block_on_device<T>(gpu: &Gpu, future: impl Future<Output = T>) -> T {
    gpu.block_on(future)
}

/// Work on a thread of its own.
pub(super) struct Task<T>(std::thread::JoinHandle<T>);

impl<T: Send + 'static> Task<T> {
    pub fn start(work: impl FnOnce() -> T + Send + 'static) -> Self {
        Self(std::thread::spawn(work))
    }

    pub fn is_done(&self) -> bool {
        self.0.is_finished()
    }

    /// Waits for it, but not longer than that; whether it is done.
    pub fn wait(&self, patience: Duration) -> bool {
        let start = now();
        while !self.is_done() && start.elapsed() < patience {
            std::thread::sleep(Duration::from_millis(2));
        }
        self.is_done()
    }

    /// What came of it, waited for; none where it panicked, which has been said.
    pub fn outcome(self) -> Option<T> {
        self.0.join().ok()
    }
}

/// A thread that does what it is asked for, one thing after another.
pub(super) struct Worker<Order, Report> {
    orders: Option<mpsc::Sender<Order>>,
    reports: mpsc::Receiver<Report>,
    thread: Option<std::thread::JoinHandle<()>>,
}

impl<Order: Send + 'static, Report: Send + 'static> Worker<Order, Report> {
    /// `work` is done for each order; after each report of it, `wake` is called.
    pub fn start(mut work: impl FnMut(Order) -> Report + Send + 'static, wake: impl Fn() + Send + 'static) -> Self {
        let (orders, received) = mpsc::channel();
        let (sent, reports) = mpsc::channel();
        let thread = std::thread::spawn(move || {
            for order in received {
                if sent.send(work(order)).is_err() {
                    break;
                }
                wake();
            }
        });
        Self { orders: Some(orders), reports, thread: Some(thread) }
    }

    pub fn give(&self, order: Order) {
        // A worker that has gone shows in what it reports.
        let _ = self.orders.as_ref().map(|orders| orders.send(order));
    }

    /// What came of the last order; none while it is being worked on.
    pub fn report(&self) -> Result<Option<Report>, Gone> {
        match self.reports.try_recv() {
            Ok(report) => Ok(Some(report)),
            Err(mpsc::TryRecvError::Empty) => Ok(None),
            Err(mpsc::TryRecvError::Disconnected) => Err(Gone),
        }
    }
}

/// The worker panicked, and has said why.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gone;

impl<Order, Report> Worker<Order, Report> {
    /// Waits for what it is at: drivers do not like to be left in the middle of something. It takes no orders any more.
    pub fn end(&mut self) {
        self.orders = None;
        let _ = self.thread.take().map(std::thread::JoinHandle::join);
    }
}

impl<Order, Report> Drop for Worker<Order, Report> {
    fn drop(&mut self) {
        self.end();
    }
}

/// Waits until the device has done all that it was asked for.
pub(super) fn finish(gpu: &Gpu) {
    // A lost device shows in the next frame.
    let _ = gpu.device.poll(wgpu::PollType::wait_indefinitely());
}

/// Saves what the user has changed in a scene of this name as a text in the current folder; says where, or why not.
pub(super) fn save_state(name: &str, changes: &str) -> String {
    let text = format!("# Changes to {}, for --state.\n{changes}", one_line(name));
    match write(|| numbered_place(&folder(None), "toml"), text.as_bytes()) {
        Ok(path) => format!("saved {}", path.display()),
        Err(why) => format!("can't save the state: {why}"),
    }
}

/// Control characters would end the comment that a name stands in.
pub(super) fn one_line(name: &str) -> String {
    name.chars().filter(|character| !character.is_control()).collect()
}

/// Where there is but one kind of display server.
#[cfg(not(all(unix, not(target_vendor = "apple"), not(target_os = "android"))))]
pub(super) fn event_loop_builder() -> Option<winit::event_loop::EventLoopBuilder<()>> {
    Some(winit::event_loop::EventLoop::builder())
}
