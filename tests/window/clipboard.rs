//! What lies on the clipboard of a display.

use x11rb::connection::Connection;
use x11rb::protocol::Event;
use x11rb::protocol::xproto::{AtomEnum, ConnectionExt as _, CreateWindowAux, Window, WindowClass};
use x11rb::rust_connection::RustConnection;

/// The text that whoever holds it hands over, if there is one.
pub fn text(connection: &RustConnection, root: Window) -> Option<String> {
    let atom = |name: &[u8]| connection.intern_atom(false, name).unwrap().reply().unwrap().atom;
    let [clipboard, utf8, property] = [&b"CLIPBOARD"[..], b"UTF8_STRING", b"VELOUR_TEST"].map(atom);
    let own = connection.generate_id().unwrap();
    let (class, aux) = (WindowClass::INPUT_ONLY, CreateWindowAux::new());
    connection.create_window(0, own, root, 0, 0, 1, 1, 0, class, 0, &aux).unwrap().check().unwrap();
    connection.convert_selection(own, clipboard, utf8, property, 0_u32).unwrap().check().unwrap();
    let is_there = loop {
        match connection.wait_for_event().unwrap() {
            Event::SelectionNotify(notice) if notice.requestor == own => break notice.property != 0,
            _ => {}
        }
    };
    let text = connection.get_property(true, own, property, AtomEnum::ANY, 0, 1 << 20).unwrap().reply().unwrap();
    connection.destroy_window(own).unwrap().check().unwrap();
    is_there.then(|| String::from_utf8(text.value).unwrap())
}
