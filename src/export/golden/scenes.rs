//! Rows of the whole: surfaces, views and lights, with every case that has gone wrong somewhere among them.

use super::function::{Function, Row};
use super::whole::{LIGHTS_FACTORS, MOST, Scene};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// A shaded point and how it is seen.
#[derive(Clone, Copy)]
struct Surface {
    position: [f64; 3],
    normal: [f64; 3],
    view: [f64; 3],
    alpha: f64,
    roughness: f64,
}

const FLOOR: Surface = Surface {
    position: [0.25, -0.5, 0.0],
    normal: [0.0, 0.0, 1.0],
    view: [0.5, -0.6, 0.45],
    alpha: 0.4,
    roughness: 0.5,
};
const SLOPE: Surface = Surface {
    position: [0.5, 0.25, 1.0],
    normal: [0.3, -0.5, 0.8],
    view: [0.7, 0.1, 0.5],
    alpha: 0.65,
    roughness: 0.35,
};
const BACK: Surface = Surface {
    position: [-1.0, 2.0, 0.5],
    normal: [-0.6, -0.7, 0.2],
    view: [-0.2, -0.8, 0.7],
    alpha: 0.2,
    roughness: 0.6,
};

/// A planar outline, counter-clockwise about its normal.
struct Light {
    middle: [f64; 3],
    /// Towards the lit side.
    normal: [f64; 3],
    /// The outline's x axis, made orthogonal to the normal.
    along: [f64; 3],
    outline: Vec<[f64; 2]>,
}

impl Light {
    fn corners(&self) -> Vec<DVec3> {
        let normal = DVec3::from(self.normal).normalize();
        let x = DVec3::from(self.along).reject_from_normalized(normal).normalize();
        let y = normal.cross(x);
        self.outline.iter().map(|[s, t]| DVec3::from(self.middle) + *s * x + *t * y).collect()
    }
}

/// A regular polygon, a little longer one way.
fn regular(count: usize, radius: f64) -> Vec<[f64; 2]> {
    let corner = |k: usize| 0.3 + TAU * k as f64 / count as f64;
    (0..count).map(|k| (radius * DVec2::from_angle(corner(k)) * DVec2::new(1.0, 0.7)).to_array()).collect()
}

fn rectangle(width: f64, height: f64) -> Vec<[f64; 2]> {
    let [x, y] = [0.5 * width, 0.5 * height];
    vec![[-x, -y], [x, -y], [x, y], [-x, y]]
}

fn scene(surface: Surface, two_sided: bool, corners: &[DVec3]) -> Scene {
    let mut padded = [DVec3::ZERO; MOST];
    padded[..corners.len()].copy_from_slice(corners);
    Scene {
        position: surface.position.into(),
        normal: DVec3::from(surface.normal).normalize(),
        view: DVec3::from(surface.view).normalize(),
        alpha: surface.alpha,
        roughness: surface.roughness,
        two_sided: f64::from(u8::from(two_sided)),
        count: corners.len() as f64,
        corners: padded,
    }
}

/// In front of the slope and of the back surface, above their horizons.
fn panel(count: usize) -> Light {
    Light { middle: [0.9, -1.6, 3.2], normal: [-0.2, 0.6, -0.8], along: [1.0, 0.1, 0.0], outline: regular(count, 0.9) }
}

/// An upright light that reaches below the floor, facing the point on it.
fn wall(outline: Vec<[f64; 2]>) -> Light {
    Light { middle: [1.75, 0.25, 0.25], normal: [-0.9, -0.4, 0.1], along: [-0.4, 0.9, 0.0], outline }
}

fn ordinary() -> Vec<(String, Scene)> {
    let mut cases = Vec::new();
    let names = ["triangle", "quadrilateral", "pentagon", "hexagon", "heptagon", "octagon"];
    for (k, name) in names.into_iter().enumerate() {
        let corners = panel(k + 3).corners();
        let alpha = [0.1, 0.25, 0.45, 0.6, 0.8, 0.95][k];
        cases.push((format!("{name} on a slope"), scene(Surface { alpha, ..SLOPE }, false, &corners)));
        let partly = wall(regular(k + 3, 1.2)).corners();
        let view = [
            [0.5, -0.6, 0.45],
            [-0.8, 0.2, 0.3],
            [-0.1, 0.9, 0.2],
            [0.3, 0.3, 0.8],
            [0.9, 0.1, 0.1],
            [-0.5, -0.5, 0.6],
        ][k];
        let surface = Surface { alpha, view, ..FLOOR };
        cases.push((format!("{name} partly below the horizon"), scene(surface, k % 2 == 1, &partly)));
    }
    let behind = Light {
        middle: [-2.6, 0.4, 1.4],
        normal: [0.7, 0.7, -0.3],
        along: [0.0, 0.2, 1.0],
        outline: rectangle(1.2, 0.8),
    };
    for (roughness, alpha) in [(0.2, 0.05), (0.45, 0.3), (0.7, 0.55), (0.95, 0.85)] {
        let surface = Surface { roughness, alpha, ..BACK };
        cases.push((format!("roughness {roughness} and alpha {alpha}"), scene(surface, false, &behind.corners())));
    }
    cases
}

/// A light, and the surface that it shines on.
fn of(name: &str, surface: Surface, two_sided: bool, light: &Light) -> (String, Scene) {
    (name.to_owned(), scene(surface, two_sided, &light.corners()))
}

/// Over the floor, facing down.
fn overhead(height: f64, outline: Vec<[f64; 2]>) -> Light {
    Light { middle: [0.3, -0.45, height], normal: [0.0, 0.0, -1.0], along: [1.0, 0.3, 0.0], outline }
}

/// From far above to below the floor, before the point.
fn slanting(normal: [f64; 3]) -> Light {
    let middle = DVec3::from(FLOOR.position) - 1.2 * DVec3::from(normal);
    Light { middle: middle.to_array(), normal, along: [normal[1], -normal[0], 0.0], outline: rectangle(3.0, 4.5) }
}

/// Huge, tiny, near and thin.
fn sizes() -> Vec<(String, Scene)> {
    let far = Light {
        middle: [300.0, -400.0, 700.0],
        normal: [-0.3, 0.4, -0.8],
        along: [1.0, 0.0, 0.0],
        outline: rectangle(16.0, 8.0),
    };
    let low = Light {
        middle: [-900.0, 1000.0, 60.0],
        normal: [0.6, -0.8, 0.1],
        along: [0.1, 0.1, 1.0],
        outline: regular(5, 25.0),
    };
    let [fuzz, dust] = [0.15, 0.9].map(|alpha| Surface { alpha, ..FLOOR });
    let dusty_slope = Surface { alpha: 0.75, ..SLOPE };
    let wide = overhead(3.0, rectangle(500.0, 400.0));
    vec![
        of("light around the zenith", FLOOR, false, &overhead(1.5, rectangle(2.0, 1.4))),
        of("octagon around the zenith", fuzz, true, &overhead(0.8, regular(8, 1.0))),
        of("huge near light", FLOOR, false, &overhead(0.25, rectangle(2000.0, 3000.0))),
        of("huge near light partly below the horizon", dusty_slope, false, &wide),
        of("tiny far light", SLOPE, false, &far),
        of("tiny far light near the horizon", FLOOR, true, &low),
        of("near light", Surface { alpha: 0.3, ..FLOOR }, false, &overhead(0.05, rectangle(0.8, 0.6))),
        of("a hair over the surface", FLOOR, false, &overhead(1e-3, rectangle(3.0, 2.0))),
        of("thin light", SLOPE, false, &Light { outline: rectangle(2.5, 0.01), ..panel(4) }),
        of("thin light partly below the horizon", dust, false, &wall(rectangle(0.02, 2.5))),
    ]
}

fn concave() -> Vec<(String, Scene)> {
    let arrow = vec![[-0.9, -0.6], [1.0, 0.0], [-0.9, 0.7], [-0.4, 0.05]];
    let star: Vec<[f64; 2]> = (0..8)
        .map(|k| ((if k % 2 == 0 { 1.3 } else { 0.45 }) * DVec2::from_angle(0.2 + TAU * f64::from(k) / 8.0)).to_array())
        .collect();
    let teeth =
        vec![[-1.2, 0.7], [-1.0, -0.9], [-0.6, 0.1], [-0.2, -0.8], [0.3, 0.2], [0.7, -0.9], [1.2, -0.3], [1.1, 0.8]];
    let raised = |outline: &[[f64; 2]]| Light { outline: outline.to_vec(), ..panel(4) };
    let from_behind = Surface { view: [-0.3, 0.8, 0.3], ..FLOOR };
    vec![
        of("concave: an arrow", SLOPE, false, &raised(&arrow)),
        of("concave: an arrow partly below the horizon", FLOOR, false, &wall(arrow)),
        of("concave: a star", Surface { alpha: 0.3, ..SLOPE }, false, &raised(&star)),
        of("concave: a star partly below the horizon", from_behind, true, &wall(star)),
        of("concave: teeth that cross the horizon six times", FLOOR, false, &wall(teeth)),
    ]
}

/// Lights whose side or place below the horizon matters.
fn sides() -> Vec<(String, Scene)> {
    let turned = Light { normal: [0.2, -0.6, 0.8], ..panel(5) };
    let turned_low = Light { normal: [0.9, 0.4, -0.1], ..wall(regular(5, 1.2)) };
    let below = overhead(-1.0, rectangle(1.0, 2.0));
    let facing_up = Light { normal: [0.0, 0.0, 1.0], ..overhead(-1.0, rectangle(1.0, 2.0)) };
    let [wool, dust] = [0.5, 0.7].map(|alpha| Surface { alpha, ..FLOOR });
    let other_way = Surface { view: [0.2, 0.8, 0.4], ..FLOOR };
    vec![
        of("one-sided from behind", SLOPE, false, &turned),
        of("one-sided from behind partly below the horizon", FLOOR, false, &turned_low),
        of("two-sided from behind", SLOPE, true, &turned),
        of("two-sided from behind partly below the horizon", FLOOR, true, &turned_low),
        of("two-sided from the front", SLOPE, true, &panel(5)),
        of("slanting from overhead to below the horizon", wool, false, &slanting([-0.7, -0.2, -0.6])),
        of("slanting the other way", other_way, false, &slanting([0.5, -0.4, -0.6])),
        of("slanting along y", dust, true, &slanting([0.1, 0.8, -0.5])),
        of("wholly below the horizon and facing up", FLOOR, false, &facing_up),
        of("wholly below the horizon and two-sided", FLOOR, true, &below),
    ]
}

fn materials() -> Vec<(String, Scene)> {
    let corners = panel(4).corners();
    let low = wall(rectangle(1.8, 1.2)).corners();
    let of = |name: &str, surface: Surface| (name.to_owned(), scene(surface, false, &corners));
    let on = |name: &str, surface: Surface| (name.to_owned(), scene(surface, true, &low));
    let up = Light { normal: [0.2, -0.1, 0.9], ..panel(4) }.corners();
    let facing_up = |name: &str, surface: Surface| (name.to_owned(), scene(surface, false, &up));
    let leaning = |mu: f64| [f64::sqrt(1.0 - mu * mu), 0.0, mu];
    vec![
        of("alpha 0 and roughness 0.15", Surface { alpha: 0.0, roughness: 0.15, ..SLOPE }),
        of("alpha 1 and roughness 1", Surface { alpha: 1.0, roughness: 1.0, ..SLOPE }),
        on("alpha 0 partly below the horizon", Surface { alpha: 0.0, ..FLOOR }),
        on("alpha 1 partly below the horizon", Surface { alpha: 1.0, ..FLOOR }),
        on("mu 0: the view on the horizon", Surface { view: [-0.8, -0.6, 0.0], ..FLOOR }),
        on("view below the horizon: mu 0", Surface { view: [-0.8, 0.5, -0.3], ..FLOOR }),
        on("mu 1: V = N", Surface { view: [0.0, 0.0, 1.0], ..FLOOR }),
        of("mu 1: V = N on a slope", Surface { view: SLOPE.normal, ..SLOPE }),
        on("view a thousandth off the normal", Surface { view: [1e-3, 5e-4, 1.0], ..FLOOR }),
        on("a node of the sheen's table", Surface { alpha: 10.0 / 31.0, view: leaning(20.0 / 31.0), ..FLOOR }),
        on("in the middle of a cell", Surface { alpha: 10.5 / 31.0, view: leaning(20.5 / 31.0), ..FLOOR }),
        on("dust under a grazing view", Surface { alpha: 0.92, view: leaning(0.05), ..FLOOR }),
        on("fuzz under a grazing view", Surface { alpha: 0.12, view: leaning(0.08), ..FLOOR }),
        facing_up(
            "normal straight down",
            Surface { position: [0.9, -1.6, 5.0], normal: [0.0, 0.0, -1.0], view: [0.3, 0.5, -0.6], ..SLOPE },
        ),
    ]
}

fn dark() -> Vec<(String, Scene)> {
    let point = |position: [f64; 3], corners: &[[f64; 3]]| {
        let corners: Vec<DVec3> = corners.iter().map(|corner| DVec3::from(*corner)).collect();
        scene(Surface { position, ..FLOOR }, true, &corners)
    };
    // Upright, in the plane x = 1, half of it below the floor; and flat, in the plane z = 0.
    let upright = [[1.0, -1.0, -1.0], [1.0, -1.0, 1.0], [1.0, 1.0, 1.0], [1.0, 1.0, -1.0]];
    let flat = [[-1.0, -1.0, 0.0], [-1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [1.0, -1.0, 0.0]];
    let raised = [[1.0, -1.0, 0.0], [1.0, -1.0, 2.0], [1.0, 1.0, 2.0], [1.0, 1.0, 0.0]];
    [
        ("in the light's plane and within it", point([1.0, 0.5, 0.25], &upright)),
        ("in the light's plane and beside it", point([1.0, 3.0, 0.0], &upright)),
        ("on the light's edge", point([1.0, 1.0, 0.25], &upright)),
        ("on the light's lower edge where it lies on the surface", point([1.0, 0.25, 0.0], &raised)),
        ("at the light's vertex", point([1.0, 1.0, 1.0], &upright)),
        ("at the light's lower vertex", point([1.0, 1.0, 0.0], &raised)),
        ("in the plane of a flat light", point([0.25, -0.5, 0.0], &flat)),
        ("degenerate polygon: one place", point([0.0, 0.0, 0.0], &[[0.5, 1.0, 2.0], [0.5, 1.0, 2.0], [0.5, 1.0, 2.0]])),
        (
            "degenerate polygon: there and back",
            point([0.0, 0.0, 0.0], &[[0.0, 0.0, 1.0], [2.0, 1.0, 1.0], [0.0, 0.0, 1.0], [2.0, 1.0, 1.0]]),
        ),
        ("degenerate polygon: on a line", point([0.0, 0.0, 0.0], &[[0.0, 0.0, 1.0], [1.0, 0.5, 1.0], [2.0, 1.0, 1.0]])),
    ]
    .map(|(name, scene)| (name.to_owned(), scene))
    .to_vec()
}

pub(super) fn lights_factors(index: usize) -> (Function, Vec<Row>) {
    let cases: Vec<(String, Scene)> = [ordinary(), sizes(), concave(), sides(), materials(), dark()].concat();
    LIGHTS_FACTORS.rows(index, cases.iter().map(|(case, scene)| (case.as_str(), *scene)))
}
