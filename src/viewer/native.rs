//! What the viewer asks of the machine that it runs on: a display, the time, waiting, and files. All of it stands here, so that a build for a
//! browser, where none of it is to be had, replaces this file alone.

use std::path::PathBuf;
use std::sync::mpsc;
use std::time::Duration;

use crate::file::write_atomically;
use crate::picture::DisplayImage;
use crate::renderer::Gpu;

use super::state::State;

pub(super) use display::event_loop_builder;

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

impl<Order, Report> Drop for Worker<Order, Report> {
    /// Waits for what it is at: drivers do not like to be left in the middle of something.
    fn drop(&mut self) {
        self.orders = None;
        let _ = self.thread.take().map(std::thread::JoinHandle::join);
    }
}

/// Waits until the device has done all that it was asked for.
pub(super) fn finish(gpu: &Gpu) {
    // A lost device shows in the next frame.
    let _ = gpu.device.poll(wgpu::PollType::wait_indefinitely());
}

/// What is written into a picture of what the state shows: of what, and how to have it again.
pub(super) fn comment(state: &State) -> String {
    format!(
        "velour view of {} at {} EV, with this state:\n{}",
        one_line(&state.name),
        state.settings().exposure,
        state.edits.to_text(&state.scene)
    )
}

/// Saves a picture with its comment in the current folder under the first free name; says where, or why not.
pub(super) fn save(picture: &DisplayImage, comment: &str) -> String {
    let bytes = picture.to_png_with_comment(comment).map_err(|error| error.to_string());
    bytes.and_then(|bytes| save_as("png", &bytes)).unwrap_or_else(|error| error)
}

/// Saves what the user has changed as a text in the current folder; says where, or why not.
pub(super) fn save_state(state: &State) -> String {
    let text = format!("# Changes to {}, for --state.\n{}", one_line(&state.name), state.edits.to_text(&state.scene));
    save_as("toml", text.as_bytes()).unwrap_or_else(|error| error)
}

/// Control characters would end the comment that a name stands in.
fn one_line(name: &str) -> String {
    name.chars().filter(|character| !character.is_control()).collect()
}

/// Writes a file in the current folder under the first free name; says where.
fn save_as(extension: &str, bytes: &[u8]) -> Result<String, String> {
    // Whoever opened the window from a desktop does not know which folder is the current one.
    let in_full = |path: PathBuf| std::path::absolute(&path).unwrap_or(path);
    let taken = || format!("velour-001.{extension} to velour-999.{extension} are taken");
    let path = free_name(extension).map(in_full).ok_or_else(taken)?;
    write_atomically(&path, bytes).map_err(|error| error.to_string())?;
    Ok(format!("saved {}", path.display()))
}

/// The first of velour-001 to velour-999 with this extension that is not there.
fn free_name(extension: &str) -> Option<PathBuf> {
    (1..1000).map(|number| PathBuf::from(format!("velour-{number:03}.{extension}"))).find(|path| !path.exists())
}

/// Where the display may be one of two: a Wayland or an X11 server.
#[cfg(all(unix, not(target_vendor = "apple"), not(target_os = "android")))]
mod display {
    use std::io::{self, Read, Write};
    use std::os::unix::fs::FileTypeExt;
    use std::os::unix::net::UnixStream;
    use std::path::Path;
    use std::time::Duration;

    use winit::event_loop::{EventLoop, EventLoopBuilder};
    use winit::platform::{wayland::EventLoopBuilderExtWayland, x11::EventLoopBuilderExtX11};

    use crate::viewer::server::{self, Server, Socket};

    /// The start of an event loop on the display server that answers; none where the environment names none.
    pub fn event_loop_builder() -> Option<EventLoopBuilder<()>> {
        let mut builder = EventLoop::builder();
        match server::choose(|name| std::env::var_os(name), server_answers)? {
            Server::Wayland => builder.with_wayland(),
            Server::X11 => builder.with_x11(),
        };
        Some(builder)
    }

    /// Whether a Wayland server is there, and not just its name.
    fn server_answers(socket: &Socket) -> bool {
        match socket {
            // Whoever handed the connection down has opened it; the first word on it is the client's.
            Socket::Open(descriptor) => {
                std::fs::metadata(format!("/dev/fd/{descriptor}")).is_ok_and(|file| file.file_type().is_socket())
            }
            Socket::Path(path) => ask_wayland(path).is_ok(),
        }
    }

    /// Connects and waits, for a while, for an answer to the smallest request.
    fn ask_wayland(path: &Path) -> io::Result<()> {
        /// A server may be busy, but nobody waits longer for a window.
        const PATIENCE: Duration = Duration::from_secs(2);
        /// `wl_display.sync`: to object 1, the display, request 0, 12 bytes long, to be answered by a new object 2.
        const SYNC: [u32; 3] = [1, 12 << 16, 2];
        let mut stream = UnixStream::connect(path)?;
        stream.set_read_timeout(Some(PATIENCE))?;
        stream.write_all(bytemuck::bytes_of(&SYNC))?;
        let mut sender = [0; 4];
        stream.read_exact(&mut sender)?;
        if u32::from_ne_bytes(sender) == SYNC[2] { Ok(()) } else { Err(io::ErrorKind::InvalidData.into()) }
    }

    #[cfg(test)]
    mod tests {
        use super::*;
        use std::os::unix::net::UnixListener;

        #[test]
        fn a_wayland_server_is_there_if_it_answers() {
            let folder = tempfile::tempdir().unwrap();
            let path = |name| folder.path().join(name);
            let answers = |name| server_answers(&Socket::Path(path(name)));
            assert!(!answers("missing"));
            std::fs::write(path("file"), "").unwrap();
            assert!(!answers("file"));
            drop(UnixListener::bind(path("dead")).unwrap());
            assert!(!answers("dead"));
            let mute = UnixListener::bind(path("mute")).unwrap();
            assert!(!answers("mute"));
            drop(mute);
            // The callback's `done`, or the display's complaint.
            for (name, sender) in [("alive", 2_u32), ("odd", 1)] {
                let server = UnixListener::bind(path(name)).unwrap();
                let serving = std::thread::spawn(move || {
                    let (mut stream, _) = server.accept().unwrap();
                    let mut request = [0; 12];
                    stream.read_exact(&mut request).unwrap();
                    stream.write_all(bytemuck::bytes_of(&[sender, 12 << 16, 7])).unwrap();
                    request
                });
                assert_eq!(answers(name), sender == 2);
                assert_eq!(serving.join().unwrap(), bytemuck::cast::<_, [u8; 12]>([1_u32, 12 << 16, 2]));
            }
        }

        #[test]
        fn a_connection_that_was_handed_down_is_a_socket() {
            use std::os::fd::AsRawFd;
            let (stream, _other) = UnixStream::pair().unwrap();
            let file = tempfile::tempfile().unwrap();
            assert!(server_answers(&Socket::Open(stream.as_raw_fd() as u32)));
            assert!(!server_answers(&Socket::Open(file.as_raw_fd() as u32)));
            assert!(!server_answers(&Socket::Open(99_999)));
        }
    }
}

/// Where there is but one.
#[cfg(not(all(unix, not(target_vendor = "apple"), not(target_os = "android"))))]
mod display {
    use winit::event_loop::{EventLoop, EventLoopBuilder};

    /// The start of an event loop.
    pub fn event_loop_builder() -> Option<EventLoopBuilder<()>> {
        Some(EventLoop::builder())
    }
}
