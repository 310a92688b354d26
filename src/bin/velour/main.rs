//! The command line: what the user asks for, and how the run ends.
//!
//! Each command has a file of its name with its flags and its `run`: `view`, `render`, `reference`, `fit`, `compare`,
//! `figures`, `export`, `golden`, `info`; `args` lists them. The others are what commands share.

mod args;
mod assignment;
mod comment;
mod compare;
mod console;
mod export;
mod exposed;
mod failure;
mod figures;
mod fit;
mod golden;
#[cfg(feature = "gpu")]
mod info;
mod inputs;
mod interrupt;
mod loading;
mod output;
mod picture_args;
mod progress;
mod reference;
#[cfg(feature = "gpu")]
mod render;
mod state;
mod timing;
#[cfg(feature = "window")]
mod view;
#[cfg(feature = "gpu")]
mod without_device;

use std::process::ExitCode;

use args::{Arguments, Command};
use clap::Parser;
use clap::error::{ContextKind, ContextValue};
use console::complain;
#[cfg(not(feature = "window"))]
use failure::Failure;

fn main() -> ExitCode {
    quiet_device_selection();
    if let Some(word) = std::env::args_os().nth(1).filter(|word| args::is_stray(word)) {
        let word = word.display();
        complain(format!("'{word}' is neither a command nor a file that is there; see `velour --help`"));
        return ExitCode::from(2);
    }
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => return usage(&error),
    };
    let done = match arguments.command {
        #[cfg(feature = "window")]
        None => view::run_or_render(arguments.scene.as_deref(), &arguments.loading.options()),
        #[cfg(not(feature = "window"))]
        None => Err(Failure::input("this build has no viewer: use a command, see `velour --help`")),
        #[cfg(feature = "window")]
        Some(Command::View(view)) => view::run(&view),
        #[cfg(feature = "gpu")]
        Some(Command::Render(render)) => render::run(&render),
        Some(Command::Reference(reference)) => reference::run(&reference),
        #[cfg(feature = "gpu")]
        Some(Command::Info) => info::run(),
        Some(Command::Fit(fit)) => fit::run(&fit),
        Some(Command::Compare(compare)) => compare::run(&compare),
        Some(Command::Export(export)) => export::run(&export),
        Some(Command::Golden(golden)) => golden::run(&golden),
        Some(Command::Figures(figures)) => figures::run(&figures),
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

/// Help and version as clap prints them; anything else in one line.
fn usage(error: &clap::Error) -> ExitCode {
    if !error.use_stderr() {
        // A closed pipe is no reason to complain.
        let _ = error.print();
        return ExitCode::SUCCESS;
    }
    if let (Some(ContextValue::String(command)), Some(ContextValue::Strings(commands))) =
        (error.get(ContextKind::InvalidSubcommand), error.get(ContextKind::ValidSubcommand))
    {
        complain(missing(command, commands));
        return ExitCode::from(2);
    }
    let text = error.to_string();
    let telling = |line: &&str| !["Usage:", "For more information"].iter().any(|start| line.starts_with(start));
    let saying = |line: &&str| !line.is_empty() && !line.starts_with("tip:");
    let message: Vec<&str> = text.lines().map(str::trim).take_while(telling).filter(saying).collect();
    let message = message.join(" ");
    complain(format!("{}; see `velour --help`", message.strip_prefix("error: ").unwrap_or(&message)));
    ExitCode::from(2)
}

/// What to say where `command`, with the program's name before it, lacks one of its own commands.
fn missing(command: &str, commands: &[String]) -> String {
    let commands: Vec<&str> = commands.iter().map(String::as_str).filter(|name| *name != "help").collect();
    let named = match commands.split_last() {
        Some((last, [])) => (*last).to_owned(),
        Some((last, others)) => format!("{} or {last}", others.join(", ")),
        None => String::new(),
    };
    let name = command.split_once(' ').map_or(command, |(_, name)| name);
    format!("{name} takes {named}; see `{command} --help`")
}
