//! How large the window opens.

use winit::dpi::{LogicalSize, PhysicalSize};

/// The window's size where monitors have room for it, in points.
const USUAL: [f64; 2] = [1280.0, 720.0];

/// What panel and picture need, in points.
const LEAST: [f64; 2] = [480.0, 320.0];

/// The share of a monitor, along either side, that the window takes at most: its frame and the desktop's bars want some.
const SHARE: f64 = 0.9;

/// The size that the window opens with and the least that it may be given: what fits all of the monitors, which come with
/// their pixels per point.
pub fn sizes(monitors: impl IntoIterator<Item = (PhysicalSize<u32>, f64)>) -> [LogicalSize<f64>; 2] {
    // A monitor may be listed before its mode is known.
    let known = monitors.into_iter().filter(|(size, _)| size.width > 0 && size.height > 0);
    let room = known.fold([f64::INFINITY; 2], |[width, height], (size, scale)| {
        let monitor = size.to_logical::<f64>(scale);
        [width.min(SHARE * monitor.width), height.min(SHARE * monitor.height)]
    });
    [USUAL, LEAST].map(|[width, height]| LogicalSize::new(width.min(room[0]), height.min(room[1])))
}

/// The factor by which the user interface shrinks in a window of this size, so that panel and picture find room in it.
pub fn zoom(window: LogicalSize<f64>) -> f32 {
    // What the system has not placed yet may be empty.
    (window.width / LEAST[0]).min(window.height / LEAST[1]).clamp(0.2, 1.0) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(monitors: &[(u32, u32, f64)]) -> [[f64; 2]; 2] {
        let monitors = monitors.iter().map(|&(width, height, scale)| (PhysicalSize::new(width, height), scale));
        sizes(monitors).map(|size| [size.width.round(), size.height.round()])
    }

    #[test]
    fn the_window_has_its_usual_size_where_that_fits() {
        let usual = [USUAL, LEAST];
        assert_eq!(points(&[]), usual);
        assert_eq!(points(&[(0, 0, 1.0)]), usual);
        assert_eq!(points(&[(1600, 1000, 1.0)]), usual);
        assert_eq!(points(&[(3840, 2160, 2.0)]), usual);
        assert_eq!(points(&[(1600, 1000, 1.0), (3840, 2160, 2.0)]), usual);
    }

    #[test]
    fn it_fits_smaller_monitors() {
        assert_eq!(points(&[(1600, 1000, 2.0)]), [[720.0, 450.0], LEAST]);
        assert_eq!(points(&[(1366, 768, 1.0)]), [[1229.0, 691.0], LEAST]);
        assert_eq!(points(&[(1600, 1000, 1.0), (1024, 768, 1.0)]), [[922.0, 691.0], LEAST]);
        assert_eq!(points(&[(640, 480, 2.0)]), [[288.0, 216.0]; 2]);
    }

    #[test]
    fn the_interface_shrinks_where_it_finds_no_room() {
        assert_eq!(zoom(LogicalSize::new(1280.0, 720.0)), 1.0);
        assert_eq!(zoom(LogicalSize::new(480.0, 320.0)), 1.0);
        assert_eq!(zoom(LogicalSize::new(288.0, 216.0)), 0.6);
        assert_eq!(zoom(LogicalSize::new(0.0, 0.0)), 0.2);
    }
}
