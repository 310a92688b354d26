//! How bright a colour is.

use glam::DVec3;

/// The luminance of a linear Rec. 709 colour.
pub(super) fn luminance(color: DVec3) -> f64 {
    color.dot(DVec3::new(0.2126, 0.7152, 0.0722))
}
