//! The display that the window is opened on: where it may be one of two, the Wayland or the X11 server that answers.

use std::io::{self, Read, Write};
use std::os::unix::fs::FileTypeExt;
use std::os::unix::net::UnixStream;
use std::path::Path;
use std::time::Duration;

use winit::event_loop::{EventLoop, EventLoopBuilder};
use winit::platform::{wayland::EventLoopBuilderExtWayland, x11::EventLoopBuilderExtX11};

use super::super::server::{self, Server, Socket};

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
