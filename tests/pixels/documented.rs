//! The commands that documents show: the program has them, and their flags.

use super::run::Bench;

const DOCUMENTS: [(&str, &str); 7] = [
    ("README.md", include_str!("../../README.md")),
    ("CONTRIBUTING.md", include_str!("../../CONTRIBUTING.md")),
    ("docs/golden.md", include_str!("../../docs/golden.md")),
    ("docs/integration.md", include_str!("../../docs/integration.md")),
    ("docs/tables.md", include_str!("../../docs/tables.md")),
    ("docs/scenes.md", include_str!("../../docs/scenes.md")),
    ("docs/accuracy.md", include_str!("../../docs/accuracy.md")),
];

/// What follows `velour ` in a line of a block of code, or between backticks.
fn commands(text: &str) -> impl Iterator<Item = &str> {
    let lines = text.lines().filter_map(|line| line.strip_prefix("velour "));
    let spans = text.split('`').skip(1).step_by(2).filter_map(|span| span.strip_prefix("velour "));
    lines.map(|line| line.split(" #").next().unwrap_or(line)).chain(spans)
}

/// The words that name a command: the first, and for `export` what is exported.
fn named(command: &str) -> String {
    let count = if command.starts_with("export ") { 2 } else { 1 };
    let words = command.split_whitespace().take(count).take_while(|word| !word.starts_with('-'));
    words.collect::<Vec<_>>().join(" ")
}

/// The flags of a command that its help does not know.
fn unknown<'a>(command: &'a str, help: &str) -> Vec<&'a str> {
    let flags = command.split_whitespace().filter(|word| word.starts_with('-'));
    let known: Vec<&str> = help.split(|sign: char| sign.is_whitespace() || sign == ',').collect();
    flags.filter(|flag| !known.contains(flag)).collect()
}

#[test]
fn commands_in_documents_have_the_flags_that_they_show() {
    let bench = Bench::new();
    let mut count = 0;
    for (name, text) in DOCUMENTS {
        for command in commands(text) {
            let help = bench.run(&format!("{} --help", named(command))).stdout;
            assert_eq!(unknown(command, &help), [""; 0], "{name}: velour {command}");
            count += 1;
        }
    }
    assert!(count > 20, "{count} commands");
}
