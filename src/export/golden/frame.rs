//! Where things stand: the frame of a shaded point, and the side of a light on which it is.

use super::flat::flat;
use super::function::{Definition, Function, Row, none};
use super::mistake::Mistake;
use glam::{DMat3, DVec3};

flat!(Surface { normal: DVec3, view: DVec3 });

flat!(Facing { light_normal: DVec3, to_vertex: DVec3, two_sided: f64 });

/// A point this near to a light's plane, as a share of the distance to its vertex, is in the plane.
const IN_PLANE: f64 = 4.8e-7;

const FRAME: Definition<Surface, DMat3> = Definition {
    name: "ltc_frame",
    output: "frame",
    answer: |surface| local_from_world(surface.normal, surface.view),
    tolerance: frame_tolerance,
    reason: "1e-6, some roundings of numbers up to 1; of x and y besides 4e-7 over the sine between normal and view, by which \
             rounding turns them. Where these coincide x is any tangent: not compared.",
    mistaken: |surface, mistake| {
        let frame = local_from_world(surface.normal, surface.view);
        (mistake == Mistake::FrameTransposed).then(|| frame.transpose())
    },
};

const SIDE: Definition<Facing, f64> = Definition {
    name: "ltc_side",
    output: "side",
    answer: side,
    tolerance: |_, _| 1e-6,
    reason: "1e-6: it is -1, 0 or 1.",
    mistaken: none,
};

/// The rows x, y, normal, with x the view projected on the surface; where it vanishes, some tangent.
pub(super) fn local_from_world(normal: DVec3, towards: DVec3) -> DMat3 {
    let normal = normal.normalize();
    let across = towards.reject_from_normalized(normal);
    let x = if across.length() > 1e-12 { across.normalize() } else { normal.any_orthonormal_vector() };
    DMat3::from_cols(x, normal.cross(x), normal).transpose()
}

fn frame_tolerance(surface: &Surface, _: &DMat3) -> DMat3 {
    let across = surface.view.reject_from_normalized(surface.normal.normalize()).length();
    let turned = 1e-6 + 4e-7 / across;
    let tangents = DVec3::splat(if turned < 0.1 { turned } else { f64::INFINITY });
    DMat3::from_cols(tangents, tangents, DVec3::splat(1e-6)).transpose()
}

fn side(facing: &Facing) -> f64 {
    let sine = facing.light_normal.dot(-facing.to_vertex.normalize_or_zero());
    match sine.abs() > IN_PLANE && (sine > 0.0 || facing.two_sided != 0.0) {
        true => sine.signum(),
        false => 0.0,
    }
}

pub(super) fn frames(index: usize) -> (Function, Vec<Row>) {
    let surface = |normal: [f64; 3], view: [f64; 3]| Surface {
        normal: DVec3::from(normal).normalize(),
        view: DVec3::from(view).normalize(),
    };
    let tilted = DVec3::new(0.3, -0.5, 0.8).normalize();
    FRAME.rows(
        index,
        [
            ("upright surface", surface([0.0, 0.0, 1.0], [0.6, 0.3, 0.7])),
            ("upright surface and the view along -y", surface([0.0, 0.0, 1.0], [0.0, -0.9, 0.2])),
            ("tilted surface", surface([0.3, -0.5, 0.8], [0.2, 0.9, 0.4])),
            ("wall", surface([1.0, 0.0, 0.0], [0.5, 0.5, -0.6])),
            ("wall along y", surface([0.0, 1.0, 0.0], [0.4, 0.5, 0.6])),
            ("surface that faces down", surface([-0.2, 0.1, -0.9], [0.3, 0.7, -0.5])),
            ("ceiling", surface([0.0, 0.0, -1.0], [0.2, -0.3, -0.7])),
            ("normal a hair below the xy plane", surface([0.8, 0.6, -1e-7], [0.3, 0.9, 0.1])),
            ("normal in the xy plane", surface([-0.6, 0.8, 0.0], [0.1, 0.2, 0.9])),
            ("grazing view", surface([0.1, 0.2, 0.97], [0.9, 0.3, -0.15])),
            ("view below the horizon", surface([0.2, 0.3, 0.9], [0.4, -0.3, -0.8])),
            (
                "view a hundredth off the normal",
                Surface { normal: tilted, view: (tilted + DVec3::new(0.01, 0.004, 0.0)).normalize() },
            ),
            (
                "view a ten thousandth off the normal",
                Surface { normal: tilted, view: (tilted + DVec3::new(0.0, 1e-4, 5e-5)).normalize() },
            ),
            ("V = N", surface([0.3, -0.5, 0.8], [0.3, -0.5, 0.8])),
            ("V = N upright", surface([0.0, 0.0, 1.0], [0.0, 0.0, 1.0])),
            ("V = -N", surface([0.0, 0.0, -1.0], [0.0, 0.0, 1.0])),
        ],
    )
}

pub(super) fn sides(index: usize) -> (Function, Vec<Row>) {
    let facing = |light_normal: [f64; 3], to_vertex: [f64; 3], two_sided: bool| Facing {
        light_normal: DVec3::from(light_normal).normalize_or_zero(),
        to_vertex: to_vertex.into(),
        two_sided: f64::from(u8::from(two_sided)),
    };
    let down = [0.0, 0.0, -1.0];
    SIDE.rows(
        index,
        [
            ("in front of a one-sided light", facing(down, [0.4, 0.2, 1.5], false)),
            ("in front of a two-sided light", facing(down, [0.4, 0.2, 1.5], true)),
            ("behind a one-sided light", facing([0.0, 0.0, 1.0], [0.4, 0.2, 1.5], false)),
            ("behind a two-sided light", facing([0.0, 0.0, 1.0], [0.4, 0.2, 1.5], true)),
            ("oblique light from the front", facing([0.5, -0.6, 0.4], [-3.0, 2.0, -1.0], false)),
            ("oblique light from behind", facing([0.5, -0.6, 0.4], [3.0, -2.0, 1.0], true)),
            ("in the light's plane", facing(down, [3.0, -4.0, 0.0], true)),
            ("in the light's plane but for rounding", facing(down, [3.0, -4.0, 1e-6], true)),
            ("behind the light's plane by no more than rounding", facing(down, [3.0, -4.0, -1e-6], true)),
            ("a hair before the light's plane", facing(down, [0.3, -0.4, 1e-5], false)),
            ("a hair behind the light's plane", facing(down, [0.3, -0.4, -1e-5], true)),
            ("at the light's vertex", facing(down, [0.0, 0.0, 0.0], true)),
            ("degenerate polygon without a normal", facing([0.0, 0.0, 0.0], [0.3, 0.4, 0.5], true)),
            ("far light", facing([0.0, -1.0, 0.0], [2e4, 3e4, -1e4], false)),
        ],
    )
}
