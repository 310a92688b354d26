//! Which display server the window goes to, where an environment may name two.

use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

/// A kind of display server.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Server {
    Wayland,
    X11,
}

/// Where a Wayland server may be found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Socket {
    /// A connection that the process was started with, by its file descriptor.
    Open(u32),
    /// A place to connect to.
    Path(PathBuf),
}

/// The server that the environment names, Wayland before X11, but for Wayland where nothing `answers`. winit asks Wayland
/// wherever it is named, and may be asked but once in the life of a process.
pub fn choose(variable: impl Fn(&str) -> Option<OsString>, answers: impl Fn(&Socket) -> bool) -> Option<Server> {
    let set = |name| variable(name).filter(|value| !value.is_empty());
    if wayland(&variable).is_some_and(|socket| answers(&socket)) {
        Some(Server::Wayland)
    } else {
        set("DISPLAY").map(|_| Server::X11)
    }
}

/// Where winit's client looks for Wayland.
fn wayland(variable: &impl Fn(&str) -> Option<OsString>) -> Option<Socket> {
    // Where this is set, even to nonsense, the other is not looked at.
    if let Some(descriptor) = variable("WAYLAND_SOCKET") {
        return descriptor.to_str()?.parse().ok().map(Socket::Open);
    }
    let name = variable("WAYLAND_DISPLAY").filter(|name| !name.is_empty())?;
    let folder = || variable("XDG_RUNTIME_DIR").map(PathBuf::from);
    let path = if is_absolute(&name) { PathBuf::from(name) } else { folder()?.join(name) };
    path.is_absolute().then_some(Socket::Path(path))
}

fn is_absolute(path: &OsStr) -> bool {
    Path::new(path).is_absolute()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The choice in an environment, where the Wayland servers answer at these places.
    fn chosen(environment: &[(&str, &str)], answering: &[&str]) -> Option<Server> {
        let variable = |name: &str| environment.iter().find(|(own, _)| *own == name).map(|(_, value)| value.into());
        let answers = |socket: &Socket| match socket {
            Socket::Open(descriptor) => answering.contains(&descriptor.to_string().as_str()),
            Socket::Path(path) => answering.iter().any(|place| Path::new(place) == path),
        };
        choose(variable, answers)
    }

    const RUN: (&str, &str) = ("XDG_RUNTIME_DIR", "/run/user/1");
    const X11: (&str, &str) = ("DISPLAY", ":0");

    #[test]
    fn wayland_comes_first_where_it_answers() {
        let wayland = ("WAYLAND_DISPLAY", "wayland-0");
        assert_eq!(chosen(&[wayland, RUN, X11], &["/run/user/1/wayland-0"]), Some(Server::Wayland));
        assert_eq!(chosen(&[wayland, RUN], &["/run/user/1/wayland-0"]), Some(Server::Wayland));
        assert_eq!(chosen(&[("WAYLAND_DISPLAY", "/tmp/w"), X11], &["/tmp/w"]), Some(Server::Wayland));
        assert_eq!(chosen(&[("WAYLAND_SOCKET", "5"), X11], &["5"]), Some(Server::Wayland));
    }

    #[test]
    fn x11_is_taken_where_wayland_does_not_answer() {
        for wayland in ["wayland-0", "/tmp/w", ""] {
            assert_eq!(chosen(&[("WAYLAND_DISPLAY", wayland), RUN, X11], &[]), Some(Server::X11));
            assert_eq!(chosen(&[("WAYLAND_DISPLAY", wayland), X11], &["wayland-0"]), Some(Server::X11));
        }
        // What was handed down counts before what is named, even where it is of no use.
        for socket in ["", "7", "nonsense", "-1"] {
            let environment = [("WAYLAND_SOCKET", socket), ("WAYLAND_DISPLAY", "/tmp/w"), X11];
            assert_eq!(chosen(&environment, &["/tmp/w"]), Some(Server::X11));
        }
        assert_eq!(chosen(&[X11], &[]), Some(Server::X11));
    }

    #[test]
    fn there_may_be_none() {
        assert_eq!(chosen(&[], &[]), None);
        assert_eq!(chosen(&[("DISPLAY", ""), ("WAYLAND_DISPLAY", "wayland-0"), RUN], &[]), None);
        assert_eq!(chosen(&[("WAYLAND_DISPLAY", "wayland-0"), ("XDG_RUNTIME_DIR", "run")], &["run/wayland-0"]), None);
    }
}
