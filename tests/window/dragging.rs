//! Files that are dragged from another program onto the window, as XDND has it (freedesktop.org, version 5).

use std::path::Path;
use std::rc::Rc;

use x11rb::connection::Connection;
use x11rb::protocol::Event;
use x11rb::protocol::xproto::{
    Atom, ClientMessageEvent, ConnectionExt as _, CreateWindowAux, EventMask, PropMode, SELECTION_NOTIFY_EVENT,
    SelectionNotifyEvent, Window, WindowClass,
};
use x11rb::rust_connection::RustConnection;
use x11rb::wrapper::ConnectionExt as _;

/// A file on its way, dragged by a window of its own.
pub struct Dragged {
    connection: Rc<RustConnection>,
    source: Window,
    target: Window,
    /// What the file is called on its way.
    uri: String,
}

impl Dragged {
    /// Drags a file over a window.
    pub fn over(connection: Rc<RustConnection>, [root, target]: [Window; 2], path: &Path) -> Self {
        let source = connection.generate_id().unwrap();
        let (class, aux) = (WindowClass::INPUT_ONLY, CreateWindowAux::new());
        connection.create_window(0, source, root, 0, 0, 1, 1, 0, class, 0, &aux).unwrap().check().unwrap();
        let dragged =
            Self { connection: connection.clone(), source, target, uri: format!("file://{}\r\n", path.display()) };
        let selection = dragged.atom("XdndSelection");
        connection.set_selection_owner(source, selection, 0_u32).unwrap().check().unwrap();
        dragged.send("XdndEnter", [5 << 24, dragged.atom("text/uri-list"), 0, 0]);
        dragged.send("XdndPosition", [0, 0, 0, dragged.atom("XdndActionCopy")]);
        // The window asks which file it is.
        while !dragged.answer() {
            std::thread::sleep(std::time::Duration::from_millis(10));
        }
        dragged
    }

    /// Lets it fall.
    pub fn drop(self) {
        self.send("XdndDrop", [0; 4]);
    }

    fn atom(&self, name: &str) -> Atom {
        self.connection.intern_atom(false, name.as_bytes()).unwrap().reply().unwrap().atom
    }

    fn send(&self, message: &str, [a, b, c, d]: [u32; 4]) {
        let message = ClientMessageEvent::new(32, self.target, self.atom(message), [self.source, a, b, c, d]);
        self.connection.send_event(false, self.target, EventMask::NO_EVENT, message).unwrap().check().unwrap();
    }

    /// Answers the window where it has asked; whether it has.
    fn answer(&self) -> bool {
        let Some(Event::SelectionRequest(asked)) = self.connection.poll_for_event().unwrap() else { return false };
        let (mode, list) = (PropMode::REPLACE, self.atom("text/uri-list"));
        self.connection.change_property8(mode, asked.requestor, asked.property, list, self.uri.as_bytes()).unwrap();
        let notice = SelectionNotifyEvent {
            response_type: SELECTION_NOTIFY_EVENT,
            sequence: 0,
            time: asked.time,
            requestor: asked.requestor,
            selection: asked.selection,
            target: asked.target,
            property: asked.property,
        };
        self.connection.send_event(false, asked.requestor, EventMask::NO_EVENT, notice).unwrap().check().unwrap();
        true
    }
}
