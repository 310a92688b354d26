//! Which of two polygons lies behind the other where they overlap in the picture.

use glam::DVec2;

use super::polygon::{NARROWEST, Polygon};

/// Which of two polygons is painted first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum First {
    One,
    Other,
    /// They do not overlap.
    Either,
}

/// Which of two polygons lies behind the other. Where they lie in one plane, that is the one that came first, `one`.
/// Where they cross, what counts is the middle of their overlap.
pub fn compare(one: &Polygon, other: &Polygon) -> First {
    if is_apart(one, other) || is_apart(other, one) {
        return First::Either;
    }
    let slack = one.slack.max(other.slack);
    if one.range[1] < other.range[0] - slack {
        return First::One;
    }
    if other.range[1] < one.range[0] - slack {
        return First::Other;
    }
    let nearer = |is_one: bool| if is_one { First::Other } else { First::One };
    // The larger one's plane is the one that is known better beyond its own polygon.
    let one_is_larger = one.area > other.area;
    let (large, small) = if one_is_larger { (one, other) } else { (other, one) };
    let [min, max] = heights(small, large);
    if min >= -slack && max <= slack {
        return First::One;
    }
    if min >= -slack || max <= slack {
        return nearer(one_is_larger == (max <= slack));
    }
    let [min, max] = heights(large, small);
    if min >= -slack || max <= slack {
        return nearer(one_is_larger == (min >= -slack));
    }
    let Some(point) = middle_of_overlap(one, other) else { return First::Either };
    let nearness = |polygon: &Polygon| polygon.nearness(point).clamp(polygon.range[0], polygon.range[1]);
    nearer(nearness(one) > nearness(other) + slack)
}

/// The least and the greatest of how much nearer a polygon's corners are than a plane behind or before them.
fn heights(polygon: &Polygon, plane: &Polygon) -> [f64; 2] {
    polygon.corners().iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[min, max], &corner| {
        let height = polygon.nearness(corner) - plane.nearness(corner);
        [min.min(height), max.max(height)]
    })
}

/// Whether some side of the first polygon has all of the other one beyond it.
fn is_apart(one: &Polygon, other: &Polygon) -> bool {
    one.sides().any(|[from, to]| {
        let side = to - from;
        let narrowest = NARROWEST * (side.x.abs() + side.y.abs());
        other.corners().iter().all(|corner| side.perp_dot(corner - from) <= narrowest)
    })
}

/// A point inside of both polygons.
fn middle_of_overlap(one: &Polygon, other: &Polygon) -> Option<DVec2> {
    // Each side of a convex polygon adds a corner at most.
    let mut corners = [DVec2::ZERO; 8];
    let mut count = one.corners().len();
    corners[..count].copy_from_slice(one.corners());
    for [from, to] in other.sides() {
        let (uncut, side) = (corners, to - from);
        let height = |corner: DVec2| side.perp_dot(corner - from);
        let mut kept = 0;
        for index in 0..count {
            let [here, next] = [uncut[index], uncut[(index + 1) % count]];
            let (above, next_above) = (height(here), height(next));
            let crossing = here + (above / (above - next_above)) * (next - here);
            for corner in [(above > 0.0).then_some(here), ((above > 0.0) != (next_above > 0.0)).then_some(crossing)] {
                if let Some(corner) = corner.filter(|_| kept < corners.len()) {
                    corners[kept] = corner;
                    kept += 1;
                }
            }
        }
        count = kept;
    }
    (count > 0).then(|| corners[..count].iter().sum::<DVec2>() / count as f64)
}
