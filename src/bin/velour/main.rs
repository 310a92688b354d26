//! The command line: what the user asks for, in which order it is done, and what is said about it.

mod args;
mod compare;
#[cfg(feature = "gpu")]
mod draw;
mod figures;
mod fit;
mod inputs;
mod interrupt;
mod output;
mod overrides;
mod reference;
mod render_args;

use std::fmt::Display;
use std::io::{self, Write};
use std::process::ExitCode;

use args::{Arguments, Command};
use clap::Parser;

/// How a run ends, but for success: the exit code and the line that says why.
pub struct Failure {
    code: u8,
    message: String,
}

impl Failure {
    /// A comparison or check fell short.
    fn check(message: impl ToString) -> Self {
        Self { code: 1, message: message.to_string() }
    }

    /// Bad usage or bad input.
    fn input(message: impl ToString) -> Self {
        Self { code: 2, message: message.to_string() }
    }

    /// No graphics device, or no display for a window.
    #[cfg(feature = "gpu")]
    fn device(message: impl ToString) -> Self {
        Self { code: 3, message: message.to_string() }
    }
}

fn main() -> ExitCode {
    quiet_device_selection();
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => return usage(&error),
    };
    let done = match arguments.command {
        #[cfg(feature = "window")]
        None => draw::view_or_render_default(),
        #[cfg(not(feature = "window"))]
        None => Err(Failure::input("this build has no viewer: use a command, see `velour --help`")),
        #[cfg(feature = "window")]
        Some(Command::View(view)) => draw::view(&view),
        #[cfg(feature = "gpu")]
        Some(Command::Render(render)) => draw::render(&render),
        Some(Command::Reference(arguments)) => reference::reference(&arguments),
        #[cfg(feature = "gpu")]
        Some(Command::Info) => draw::info(),
        Some(Command::Fit(fit)) => fit::fit(&fit),
        Some(Command::Compare(compare)) => compare::compare(&compare),
        Some(Command::Figures(figures)) => figures::figures(&figures),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            complain(failure.message);
            ExitCode::from(failure.code)
        }
    }
}

/// Mesa's device selection layer asks Wayland and, where there is none, says so on stderr, where our one line belongs.
fn quiet_device_selection() {
    if std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        // SAFETY: the first thing that the process does, so no other thread reads the environment.
        unsafe { std::env::set_var("NODEVICE_SELECT", "1") };
    }
}

/// A line on stdout. Whoever closed the other end has read enough; another failure ends the program, which says so once.
fn say(line: impl Display) {
    match writeln!(io::stdout(), "{line}") {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            complain(format!("stdout cannot be written ({error}): give it another place"));
            std::process::exit(2);
        }
        _ => {}
    }
}

/// A line on stderr; where that cannot be written, nobody is left to tell.
fn complain(line: impl Display) {
    let _ = writeln!(io::stderr(), "velour: {}", one_line(&line.to_string()));
}

/// Help and version as clap prints them; anything else in one line.
fn usage(error: &clap::Error) -> ExitCode {
    if !error.use_stderr() {
        // A closed pipe is no reason to complain.
        let _ = error.print();
        return ExitCode::SUCCESS;
    }
    let text = error.to_string();
    let telling = |line: &&str| !["Usage:", "For more information"].iter().any(|start| line.starts_with(start));
    let saying = |line: &&str| !line.is_empty() && !line.starts_with("tip:");
    let message: Vec<&str> = text.lines().map(str::trim).take_while(telling).filter(saying).collect();
    let message = message.join(" ");
    complain(format!("{}; see `velour --help`", message.strip_prefix("error: ").unwrap_or(&message)));
    ExitCode::from(2)
}

/// Errors and notices are one line each, whatever a path or a name in them holds.
fn one_line(message: &str) -> String {
    message.chars().map(|character| if character.is_control() { '?' } else { character }).collect()
}
