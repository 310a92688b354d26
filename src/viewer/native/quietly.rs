//! Work with a device that may be lost in its midst, in which wgpu panics at some calls.

use std::cell::{Cell, RefCell};
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::sync::Once;

thread_local! {
    static IS_QUIET: Cell<bool> = const { Cell::new(false) };
    static SAID: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Does it; where it panics, that is not printed, but returned in one line. What it was at must not be used any more.
pub fn quietly<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let before = take_hook();
        set_hook(Box::new(move |info| {
            if IS_QUIET.get() {
                let said = info.payload_as_str().unwrap_or_default();
                SAID.set(Some(said.split_whitespace().collect::<Vec<_>>().join(" ")));
            } else {
                before(info);
            }
        }));
    });
    let was_quiet = IS_QUIET.replace(true);
    let done = catch_unwind(AssertUnwindSafe(work));
    IS_QUIET.set(was_quiet);
    done.map_err(|_| SAID.take().unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_panics_says_why() {
        assert_eq!(quietly(|| 3), Ok(3));
        assert_eq!(quietly(|| -> u8 { panic!("no\n buffer {}", 7) }), Err("no buffer 7".to_owned()));
        let inner = quietly(|| quietly(|| -> u8 { panic!("inner") }));
        assert_eq!(inner, Ok(Err("inner".to_owned())));
        assert!(!IS_QUIET.get());
    }
}
