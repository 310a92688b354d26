//! Devices that are lost on purpose, for tests: `VELOUR_LOSE_DEVICE=SECONDS` loses the first one so long after it was opened, and
//! `SECONDS,COUNT` the first so many.

use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

use crate::renderer::Gpu;

/// Loses a device that has just been opened, if that is asked for.
pub fn lose_as_asked(gpu: &Gpu) {
    static OPENED: AtomicU32 = AtomicU32::new(0);
    let opened = OPENED.fetch_add(1, Ordering::Relaxed);
    let asked = std::env::var("VELOUR_LOSE_DEVICE").ok().and_then(|text| parse(&text));
    if let Some((after, count)) = asked
        && opened < count
    {
        let device = gpu.device.clone();
        std::thread::spawn(move || {
            std::thread::sleep(after);
            device.destroy();
            // That it is gone is told once its work has ended.
            let _ = device.poll(wgpu::PollType::wait_indefinitely());
        });
    }
}

/// After how long, and how many.
fn parse(text: &str) -> Option<(Duration, u32)> {
    let (seconds, count) = text.split_once(',').unwrap_or((text, "1"));
    let after = Duration::try_from_secs_f64(seconds.trim().parse().ok()?).ok()?;
    Some((after, count.trim().parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_and_a_number_of_devices_are_read() {
        let after = Duration::from_millis(2500);
        assert_eq!(
            [parse("2.5"), parse(" 2.5 , 7"), parse("2.5,0")],
            [Some((after, 1)), Some((after, 7)), Some((after, 0))]
        );
        assert_eq!(["", "x", "-1", "1,", "1,-1", "1e99", "nan"].map(parse), [None; 7]);
    }
}
