//! A display of its own, the program on it, and hands: what a user sees and does, and what the process takes for it.

use std::ffi::OsStr;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::rc::Rc;
use std::time::{Duration, Instant};

use tempfile::TempDir;
use x11rb::connection::Connection;
use x11rb::protocol::xproto::{
    AtomEnum, BUTTON_PRESS_EVENT, BUTTON_RELEASE_EVENT, ConnectionExt as _, ImageFormat, InputFocus, KEY_PRESS_EVENT,
    KEY_RELEASE_EVENT, MOTION_NOTIFY_EVENT, MapState, Window,
};
use x11rb::protocol::xtest::ConnectionExt as _;
use x11rb::rust_connection::RustConnection;

use super::clipboard;
use super::dragging::Dragged;
pub use super::saved::State;
use super::shot::Shot;

/// How long anything may take on a machine that has other things to do.
const PATIENCE: Duration = Duration::from_secs(300);
/// What does nothing for so long waits for its user: no delay of the program's own is longer.
const REST: Duration = Duration::from_millis(1200);
/// Processor time that may be counted meanwhile: the clock ticks in hundredths.
const TICK: Duration = Duration::from_millis(10);

/// Keys by their X11 names' numbers.
pub mod keys {
    pub const ENTER: u32 = 0xff0d;
    pub const ESCAPE: u32 = 0xff1b;
    pub const HOME: u32 = 0xff50;
    pub const DOWN: u32 = 0xff54;
    pub const SHIFT: u32 = 0xffe1;
    pub const CONTROL: u32 = 0xffe3;
}

/// The display and the program; both end with it.
pub struct Desk {
    server: Child,
    display: String,
    connection: Rc<RustConnection>,
    root: Window,
    pub size: [u16; 2],
    program: Child,
    /// The folder that the program runs in.
    pub folder: TempDir,
    window: Window,
}

impl Drop for Desk {
    fn drop(&mut self) {
        // What has ended already cannot be ended.
        let _ = (self.program.kill(), self.program.wait(), self.server.kill(), self.server.wait());
    }
}

/// Starts the program on a display, in a folder.
fn program(display: &str, folder: &TempDir, arguments: &[&Path], variables: &[(&str, &OsStr)]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_velour"))
        .args(arguments)
        .current_dir(folder)
        .env("DISPLAY", display)
        .env("XDG_RUNTIME_DIR", folder.path())
        .env("XDG_STATE_HOME", folder.path())
        .envs(variables.iter().copied())
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

impl Desk {
    /// A display of this size, which the program's window fills, with these arguments.
    pub fn new(size: [u16; 2], arguments: &[&Path]) -> Self {
        let mut desk = Self::without_window(size, arguments);
        desk.find_window();
        desk
    }

    /// The same with these variables in the program's environment.
    pub fn within(size: [u16; 2], arguments: &[&Path], variables: &[(&str, &OsStr)]) -> Self {
        let mut desk = Self::started(size, arguments, variables);
        desk.find_window();
        desk
    }

    /// Kills the program, which hears nothing of it, and starts it again on the same display and in the same folder.
    pub fn kill_and_start(&mut self, arguments: &[&Path]) {
        _ = (self.program.kill(), self.program.wait());
        self.program = program(&self.display, &self.folder, arguments, &[]);
        self.find_window();
    }

    /// Waits for the window, and gives it the screen and the keyboard: no window manager would.
    fn find_window(&mut self) {
        let size = self.size;
        self.window = self.until("a window", |desk| desk.find());
        let place = x11rb::protocol::xproto::ConfigureWindowAux::new().x(0).y(0);
        let place = place.width(u32::from(size[0])).height(u32::from(size[1]));
        self.connection.configure_window(self.window, &place).unwrap().check().unwrap();
        self.connection.set_input_focus(InputFocus::PARENT, self.window, 0_u32).unwrap().check().unwrap();
        self.move_to([i16::try_from(size[0] / 3).unwrap(), 5]);
    }

    /// The same with the default scene, without shadows: pictures are finished as soon as they are drawn, and come out the same each time.
    pub fn without_shadows(size: [u16; 2]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let state = folder.path().join("state.toml");
        std::fs::write(&state, "shadows = false\n").unwrap();
        let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/drape.glb");
        let mut desk = Self::new(size, &["view".as_ref(), &scene, "--state".as_ref(), &state]);
        // The state has been read.
        desk.settle();
        desk
    }

    /// The same before there is a window.
    pub fn without_window(size: [u16; 2], arguments: &[&Path]) -> Self {
        Self::started(size, arguments, &[])
    }

    /// The same, with these variables in the program's environment.
    pub fn started(size: [u16; 2], arguments: &[&Path], variables: &[(&str, &OsStr)]) -> Self {
        // A window takes nine tenths of its monitor at most.
        let [width, height] = size.map(|side| side.div_ceil(9) * 10);
        let screen = format!("{width}x{height}x24");
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", &screen, "-nolisten", "tcp"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb is there: `scripts/setup window` installs it");
        let mut number = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut number).unwrap();
        let display = format!(":{}", number.trim());
        let (connection, screen) = RustConnection::connect(Some(&display)).unwrap();
        let root = connection.setup().roots[screen].root;
        let folder = tempfile::tempdir().unwrap();
        let program = program(&display, &folder, arguments, variables);
        Self { server, display, connection: Rc::new(connection), root, size, program, folder, window: 0 }
    }

    /// Asks until there is an answer.
    pub fn until<T>(&mut self, what: &str, mut ask: impl FnMut(&mut Self) -> Option<T>) -> T {
        let start = Instant::now();
        loop {
            if let Some(answer) = ask(self) {
                return answer;
            }
            let status = self.program.try_wait().unwrap();
            assert!(status.is_none(), "no {what}: the program has ended, {status:?}");
            assert!(start.elapsed() < PATIENCE, "no {what} after {PATIENCE:?}");
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    fn find(&self) -> Option<Window> {
        let children = self.connection.query_tree(self.root).unwrap().reply().unwrap().children;
        children.into_iter().find(|&window| {
            let shown = self.connection.get_window_attributes(window).unwrap().reply();
            let is_shown = shown.is_ok_and(|window| window.map_state == MapState::VIEWABLE);
            is_shown && self.title_of(window).starts_with("Velour")
        })
    }

    fn title_of(&self, window: Window) -> String {
        let property = self.connection.get_property(false, window, AtomEnum::WM_NAME, AtomEnum::ANY, 0, 1024);
        property.unwrap().reply().map(|name| String::from_utf8_lossy(&name.value).into_owned()).unwrap_or_default()
    }

    /// The window's title.
    pub fn title(&self) -> String {
        self.title_of(self.window)
    }

    /// What the screen shows.
    pub fn shot(&self) -> Shot {
        let [width, height] = self.size;
        let image = self.connection.get_image(ImageFormat::Z_PIXMAP, self.root, 0, 0, width, height, !0);
        let data = image.unwrap().reply().unwrap().data;
        let pixels = data.chunks_exact(4).map(|pixel| [pixel[2], pixel[1], pixel[0]]).collect();
        Shot::new(width.into(), pixels)
    }

    /// Processor time that the program has taken.
    pub fn cpu(&self) -> Duration {
        let stat = std::fs::read_to_string(format!("/proc/{}/stat", self.program.id())).unwrap();
        let after_name = stat.rsplit(')').next().unwrap();
        let ticks = after_name.split_whitespace().skip(11).take(2).map(|ticks| ticks.parse::<u64>().unwrap());
        Duration::from_millis(10 * ticks.sum::<u64>())
    }

    /// Memory that the program has written to, in kB.
    pub fn memory(&self) -> usize {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.program.id())).unwrap();
        let of = |name| {
            let line = status.lines().find_map(|line| line.strip_prefix(name)).unwrap();
            line.trim().trim_end_matches(" kB").parse::<usize>().unwrap()
        };
        of("RssAnon:") + of("VmSwap:")
    }

    /// Whether some thread of the program runs, or would if there were a processor for it.
    fn is_running(&self) -> bool {
        let tasks = std::fs::read_dir(format!("/proc/{}/task", self.program.id())).unwrap();
        tasks.flatten().any(|task| {
            // One that has ended since does nothing.
            let stat = std::fs::read_to_string(task.path().join("stat")).unwrap_or_default();
            stat.rsplit(") ").next().is_some_and(|after| after.starts_with(['R', 'D']))
        })
    }

    /// Whether it does nothing for so long. On a machine that has other things to do, what is merely kept waiting does not count.
    pub fn is_idle_for(&self, time: Duration) -> bool {
        let (start, before) = (Instant::now(), self.cpu());
        while start.elapsed() < time {
            if self.is_running() {
                return false;
            }
            std::thread::sleep(Duration::from_millis(20));
        }
        self.cpu() - before <= TICK
    }

    /// Waits until the program does nothing any more: its picture is finished.
    pub fn settle(&mut self) -> Shot {
        self.until("rest", |desk| desk.is_idle_for(REST).then_some(()));
        self.shot()
    }

    /// Waits until what is shown fits, and says what that is.
    pub fn until_shown(&mut self, what: &str, fits: impl Fn(&Shot) -> bool) -> Shot {
        self.until(what, |desk| Some(desk.shot()).filter(&fits))
    }

    fn fake(&self, kind: u8, detail: u8, [x, y]: [i16; 2]) {
        self.connection.xtest_fake_input(kind, detail, 0, self.root, x, y, 0).unwrap().check().unwrap();
    }

    pub fn move_to(&self, place: [i16; 2]) {
        self.fake(MOTION_NOTIFY_EVENT, 0, place);
    }

    /// 1 is the left button, 2 the middle, 3 the right.
    pub fn press(&self, button: u8) {
        self.fake(BUTTON_PRESS_EVENT, button, [0; 2]);
    }

    pub fn release(&self, button: u8) {
        self.fake(BUTTON_RELEASE_EVENT, button, [0; 2]);
    }

    pub fn click(&self, place: [i16; 2]) {
        self.move_to(place);
        std::thread::sleep(Duration::from_millis(60));
        self.press(1);
        std::thread::sleep(Duration::from_millis(60));
        self.release(1);
        std::thread::sleep(Duration::from_millis(60));
    }

    /// A step of the wheel, up or down.
    pub fn wheel(&self, up: bool) {
        let button = if up { 4 } else { 5 };
        self.press(button);
        self.release(button);
    }

    /// A drag in steps of some pixels, each of which is waited for.
    pub fn drag(&self, button: u8, from: [i16; 2], to: [i16; 2]) {
        self.move_to(from);
        std::thread::sleep(Duration::from_millis(60));
        self.press(button);
        for step in 1..=10_i16 {
            let between = |axis: usize| from[axis] + (to[axis] - from[axis]) / 10 * step;
            self.move_to([between(0), between(1)]);
            std::thread::sleep(Duration::from_millis(40));
        }
        self.release(button);
        std::thread::sleep(Duration::from_millis(60));
    }

    /// The key that gives a symbol, and whether it takes Shift.
    fn key(&self, symbol: u32) -> (u8, bool) {
        let setup = self.connection.setup();
        let (least, most) = (setup.min_keycode, setup.max_keycode);
        let mapping = self.connection.get_keyboard_mapping(least, most - least + 1).unwrap().reply().unwrap();
        let a_key = usize::from(mapping.keysyms_per_keycode);
        let found = mapping.keysyms.iter().position(|&listed| listed == symbol);
        let at = found.unwrap_or_else(|| panic!("no key gives {symbol:#x}"));
        (least + u8::try_from(at / a_key).unwrap(), at % a_key == 1)
    }

    /// Presses a key while others are held.
    pub fn chord(&self, held: &[u32], symbol: u32) {
        let (code, shift) = self.key(symbol);
        let shift = if shift { Some(keys::SHIFT) } else { None };
        let held: Vec<u8> = held.iter().copied().chain(shift).map(|symbol| self.key(symbol).0).collect();
        held.iter().for_each(|&code| self.fake(KEY_PRESS_EVENT, code, [0; 2]));
        self.fake(KEY_PRESS_EVENT, code, [0; 2]);
        self.fake(KEY_RELEASE_EVENT, code, [0; 2]);
        held.iter().rev().for_each(|&code| self.fake(KEY_RELEASE_EVENT, code, [0; 2]));
        std::thread::sleep(Duration::from_millis(80));
    }

    /// Types a text, key by key; what is no letter or digit is a symbol of the same number.
    pub fn type_text(&self, text: &str) {
        text.chars().for_each(|character| self.chord(&[], u32::from(character)));
    }

    /// The state, as the program saves it when it is asked to.
    pub fn state(&mut self) -> State {
        self.chord(&[keys::CONTROL], u32::from('s'));
        let path = self.written("velour-001.toml");
        let text = std::fs::read_to_string(&path).unwrap();
        std::fs::remove_file(path).unwrap();
        State(text)
    }

    /// The state, once it is so.
    pub fn until_state(&mut self, what: &str, fits: impl Fn(&State) -> bool) -> State {
        self.until(what, |desk| Some(desk.state()).filter(&fits))
    }

    /// Takes back the last change, which leaves a state that fits.
    pub fn undo(&mut self, what: &str, fits: impl Fn(&State) -> bool) {
        self.chord(&[keys::CONTROL], u32::from('z'));
        let state = self.state();
        assert!(fits(&state), "{what} taken back:\n{}", state.0);
    }

    /// The path of a file in the program's folder, once it is there: files appear whole.
    pub fn written(&mut self, name: &str) -> PathBuf {
        let path = self.folder.path().join(name);
        self.until(name, |_| path.exists().then_some(()));
        path
    }

    /// Drags a file over the window.
    pub fn drag_file(&self, path: &Path) -> Dragged {
        Dragged::over(self.connection.clone(), [self.root, self.window], path)
    }

    /// Drops a file on the window.
    pub fn drop_file(&self, path: &Path) {
        self.drag_file(path).drop();
    }

    /// Closes the window, which ends the program as it should.
    pub fn close(&mut self) {
        self.ask_to_close();
        assert_eq!((self.ended().code(), self.complaints().as_str()), (Some(0), ""));
    }

    /// Asks the window to close, as its frame's button does.
    pub fn ask_to_close(&self) {
        use x11rb::protocol::xproto::{ClientMessageEvent, EventMask};
        let atom = |name: &[u8]| self.connection.intern_atom(false, name).unwrap().reply().unwrap().atom;
        let (protocols, delete) = (atom(b"WM_PROTOCOLS"), atom(b"WM_DELETE_WINDOW"));
        let message = ClientMessageEvent::new(32, self.window, protocols, [delete, 0, 0, 0, 0]);
        self.connection.send_event(false, self.window, EventMask::NO_EVENT, message).unwrap().check().unwrap();
    }

    /// The text on the clipboard, if there is one.
    pub fn clipboard(&self) -> Option<String> {
        clipboard::text(&self.connection, self.root)
    }

    /// Waits for the program's end.
    pub fn ended(&mut self) -> ExitStatus {
        self.until("end", |desk| desk.program.try_wait().unwrap())
    }

    /// Waits for the program's end; its exit code, and whether there was a window until then.
    pub fn ended_without_window(&mut self) -> (Option<i32>, bool) {
        let mut has_had_window = false;
        let status = self.until("end", |desk| {
            has_had_window |= desk.find().is_some();
            desk.program.try_wait().unwrap()
        });
        (status.code(), has_had_window)
    }

    /// What it has said on stderr, once it has ended.
    pub fn complaints(&mut self) -> String {
        let mut said = String::new();
        let mut stderr = self.program.stderr.take().unwrap();
        std::io::Read::read_to_string(&mut stderr, &mut said).unwrap();
        said
    }
}
