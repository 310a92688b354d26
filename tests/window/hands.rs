//! What hands do.

use super::alone;
use super::desk::{Desk, keys};

const SIZE: [u16; 2] = [1280, 720];
const PICTURE: [usize; 4] = [50, 950, 50, 650];

#[test]
fn what_is_dragged_and_turned_is_in_the_state_and_home_takes_it_back() {
    let _alone = alone();
    let mut desk = Desk::new(SIZE, &[]);
    let first = desk.settle();
    assert!(!desk.state().contains("[view]"));
    for (button, what) in [(1, "azimuth"), (2, "target")] {
        desk.drag(button, [300, 300], [400, 340]);
        assert!(desk.state().contains(what));
    }
    desk.press(4);
    desk.release(4);
    let turned = desk.settle();
    assert!(first.differs(&turned, PICTURE, 8) > 0.3);
    desk.chord(&[], keys::HOME);
    let back = desk.settle();
    assert!(!desk.state().contains("[view]"));
    // What the panel says of the last file is another.
    assert!(first.differs(&back, PICTURE, 4) < 0.02, "{}", first.differs(&back, PICTURE, 4));
}
