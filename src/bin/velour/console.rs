//! What is said to the user: results on stdout, complaints on stderr.

use std::fmt::Display;
use std::io::{self, Write};

/// A line on stdout. Whoever closed the other end has read enough; another failure ends the program, which says so
/// once.
pub fn say(line: impl Display) {
    match writeln!(io::stdout(), "{line}") {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            complain(format!("stdout cannot be written ({error}): give it another place"));
            std::process::exit(2);
        }
        _ => {}
    }
}

/// A line on stderr; where that cannot be written, nobody is left to tell.
pub fn complain(line: impl Display) {
    let _ = writeln!(io::stderr(), "velour: {}", one_line(&line.to_string()));
}

/// Errors and notices are one line each, whatever a path or a name in them holds.
fn one_line(message: &str) -> String {
    message.chars().map(|character| if character.is_control() { '?' } else { character }).collect()
}
