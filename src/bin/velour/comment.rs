//! What made a picture, as its file says it.

use std::ffi::OsString;

/// Flags, followed by a value, that say where files go: they change nothing in them.
const PLACES: [&str; 4] = ["-o", "--output", "--heatmap", "--errors"];
/// Flags without a value that say how the run reports.
const REPORTS: [&str; 1] = ["--json"];

/// The command that the program was started with, but for where it writes and how it reports: the same flags make the
/// same bytes in any place.
pub fn command() -> String {
    of(std::env::args_os().skip(1))
}

fn of(words: impl IntoIterator<Item = OsString>) -> String {
    let mut words = words.into_iter().map(|word| word.to_string_lossy().into_owned());
    let mut command = "velour".to_owned();
    while let Some(word) = words.next() {
        if PLACES.contains(&word.as_str()) {
            words.next();
        } else if !REPORTS.contains(&word.as_str()) && !holds_place(&word) {
            command.push(' ');
            // On one line.
            command.push_str(&quoted(&word.replace(char::is_control, "?")));
        }
    }
    command
}

/// Whether a flag and the place stand in one word: `--output=a.png`, `-oa.png`.
fn holds_place(word: &str) -> bool {
    let joined = |flag: &&str| match word.strip_prefix(*flag) {
        Some(rest) => rest.starts_with('=') || !flag.starts_with("--"),
        None => false,
    };
    PLACES.iter().any(joined)
}

/// A word as a shell takes it.
pub fn quoted(word: &str) -> String {
    let is_plain = |character: char| character.is_alphanumeric() || "_-+=.,:/%@".contains(character);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn command(words: &[&str]) -> String {
        of(words.iter().map(OsString::from))
    }

    #[test]
    fn places_and_reports_are_left_out() {
        let expected = "velour render scene.glb --size 64x40 --exposure -2";
        for place in [&["-o", "a.png"][..], &["-oa.png"], &["-o=a.png"], &["--output", "a.png"], &["--output=a.png"]] {
            let words = [&["render", "scene.glb"], place, &["--size", "64x40", "--json", "--exposure", "-2"]].concat();
            assert_eq!(command(&words), expected);
        }
        let words = ["compare", "a.exr", "b.exr", "--heatmap", "c.png", "--layer", "x"];
        assert_eq!(command(&words), "velour compare a.exr b.exr --layer x");
        assert_eq!(command(&["reference", "a.glb", "--errors=e.exr", "--spp=4"]), "velour reference a.glb --spp=4");
    }

    #[test]
    fn what_a_shell_would_take_apart_is_quoted() {
        let words = ["render", "my scene.glb", "--set", "it's.alpha=0.5", "", "a\nb", "größe.glb", "$x"];
        assert_eq!(command(&words), r"velour render 'my scene.glb' --set 'it'\''s.alpha=0.5' '' 'a?b' größe.glb '$x'");
    }
}
