//! Running the binary in a folder of its own.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;
use velour::scene::{Drawn, Edits, Scene};

use super::stage::{Stage, Thing, facing, glow, looking, velvet};

/// A velvet floor under a rectangle: enough to draw.
pub fn small_stage() -> Stage {
    let floor = Thing::rectangle([1.5, 1.5], velvet([0.9, 0.5, 0.2], 0.4)).placed(facing([0.0; 3], [0.0, 1.0, 0.0]));
    let light = Thing::rectangle([0.5, 0.3], glow([4.0, 3.0, 2.0])).placed(facing([1.0, 1.2, -1.0], [0.0; 3]));
    Stage::new(vec![floor, light], looking([0.4, 1.1, 2.6], [0.0; 3]))
}

/// What edits draw of a scene with nothing in the way of light, which is the closed form.
pub fn unshadowed<'a>(scene: &'a Scene, edits: &Edits) -> Drawn<'a> {
    Drawn::new(scene, &Edits { shadows: Some(false), ..edits.clone() })
}

/// A folder that holds `scene.glb` and whatever a test puts there, in which the binary runs.
pub struct Bench {
    folder: TempDir,
}

impl Bench {
    pub fn new() -> Self {
        let bench = Self { folder: tempfile::tempdir().unwrap() };
        bench.put("scene.glb", small_stage().glb());
        bench
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn put(&self, name: &str, bytes: impl AsRef<[u8]>) {
        std::fs::write(self.path(name), bytes).unwrap();
    }

    /// The names of all that lies in the folder, hidden things too.
    pub fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.folder.path()).unwrap();
        let mut names: Vec<String> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// The binary with these words as arguments, on a machine without a display.
    pub fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(Path::new(env!("CARGO_BIN_EXE_velour")));
        command.args(arguments.split_whitespace()).current_dir(self.folder.path());
        for variable in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET", "XDG_RUNTIME_DIR"] {
            command.env_remove(variable);
        }
        command
    }

    /// Runs it and takes what it says; it must succeed.
    pub fn run(&self, arguments: &str) -> Said {
        let said = Said::of(self.command(arguments).output().unwrap());
        assert_eq!(said.code, Some(0), "velour {arguments}: {}", said.stderr);
        said
    }

    /// Runs it on bad input: it must end with this code and one line on stderr, which holds `hint`, and leave nothing.
    pub fn refused(&self, command: &mut Command, code: i32, hint: &str) {
        let before = self.names();
        let said = Said::of(command.output().unwrap());
        let shown = format!("{command:?}: {said:?}");
        assert_eq!(said.code, Some(code), "{shown}");
        assert!(said.stderr.starts_with("velour: ") && said.stderr.trim_end().lines().count() == 1, "{shown}");
        assert!(said.stderr.to_lowercase().contains(&hint.to_lowercase()), "no '{hint}' in {shown}");
        assert_eq!(said.stdout, "", "{shown}");
        assert_eq!(self.names(), before, "{shown}");
    }
}

/// How a run ended.
#[derive(Debug)]
pub struct Said {
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl Said {
    fn of(output: Output) -> Self {
        let text = |bytes| String::from_utf8(bytes).expect("what is said is UTF-8");
        Self { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
    }
}
