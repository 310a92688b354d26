//! The loop over lights that people copy, on a picture: a ball on a floor under lights of several shapes, against the sum of exact form factors.

// The mistakes of docs/integration.md, which an example draws.
#[path = "../../examples/mistakes/planted.rs"]
mod planted;

use crate::{device, files};
use glam::{DMat3, DVec3};
use velour::models::Schlick;
use velour::reference::polygon::form_factor;
use velour::table::{GgxTable, Ltc, SheenTable};

const SIZE: [usize; 2] = [64, 48];
/// What the shader's surface is made of.
const BASE: DVec3 = DVec3::new(0.1, 0.3, 0.4);
const F0: DVec3 = DVec3::new(0.04, 0.05, 0.06);
const ROUGHNESS: f64 = 0.35;
const SHEEN: DVec3 = DVec3::new(0.9, 0.5, 0.3);
const ALPHA: f64 = 0.4;
/// Of radiance: 1e-6 of form factors in f32, of lights as near as these, times radiances of up to 6, over what is reflected.
const TOLERANCE: f64 = 2e-6;

struct Light {
    corners: Vec<DVec3>,
    radiance: DVec3,
    two_sided: bool,
}

/// The first is not in the range that is shaded; the second is the range's first: a quad. The third is concave, the fourth shines both ways.
fn lights() -> Vec<Light> {
    let light = |corners: &[[f64; 3]], radiance: [f64; 3], two_sided| Light {
        corners: corners.iter().map(|corner| DVec3::from(*corner)).collect(),
        radiance: DVec3::from(radiance),
        two_sided,
    };
    vec![
        light(&[[0.0, 3.0, 0.0], [1.0, 3.0, 0.0], [0.0, 3.0, 1.0]], [90.0, 90.0, 90.0], true),
        light(&[[-1.5, 3.0, -1.0], [0.5, 3.0, -1.0], [0.5, 3.0, 1.0], [-1.5, 3.0, 1.0]], [4.0, 4.0, 3.0], false),
        light(
            &[[2.0, 0.25, 1.5], [2.0, 0.25, -1.5], [2.0, 2.25, -1.5], [2.0, 1.0, 0.0], [2.0, 2.25, 1.5]],
            [1.0, 2.0, 5.0],
            false,
        ),
        light(&[[-2.0, -0.5, 1.0], [-2.0, 1.5, 1.0], [-1.0, 0.5, 2.0]], [6.0, 1.0, 1.0], true),
    ]
}

impl Light {
    /// Twice the area would do: only the direction counts.
    fn normal(&self) -> DVec3 {
        let first = self.corners[0];
        let sum: DVec3 = self.corners.windows(2).map(|pair| (pair[0] - first).cross(pair[1] - first)).sum();
        sum.normalize()
    }
}

struct Point {
    position: DVec3,
    normal: DVec3,
    view: DVec3,
}

/// What a camera sees of a ball of radius 1 on the floor y = 0, row by row; none of the sky.
fn points() -> Vec<Point> {
    let eye = DVec3::new(0.5, 1.8, 5.0);
    let forward = (DVec3::new(0.0, 0.9, 0.0) - eye).normalize();
    let right = forward.cross(DVec3::Y).normalize();
    let up = right.cross(forward);
    let ray = |k: usize| {
        let (x, y) = ((k % SIZE[0]) as f64 + 0.5, (k / SIZE[0]) as f64 + 0.5);
        let half = 0.4;
        let (x, y) = ((2.0 * x - SIZE[0] as f64) / SIZE[1] as f64, 1.0 - 2.0 * y / SIZE[1] as f64);
        (forward + half * (x * right + y * up)).normalize()
    };
    (0..SIZE[0] * SIZE[1]).filter_map(|k| seen(eye, ray(k))).collect()
}

fn seen(eye: DVec3, ray: DVec3) -> Option<Point> {
    let from_center = eye - DVec3::Y;
    let (along, square) = (from_center.dot(ray), from_center.length_squared() - 1.0);
    let root = along * along - square;
    // What the shader is given, in f32.
    let rounded = |v: DVec3| v.as_vec3().as_dvec3();
    let (position, normal) = if root > 0.0 {
        let position = eye + (-along - root.sqrt()) * ray;
        (position, position - DVec3::Y)
    } else if ray.y < 0.0 {
        (eye - eye.y / ray.y * ray, DVec3::Y)
    } else {
        return None;
    };
    Some(Point { position: rounded(position), normal: rounded(normal), view: rounded(-ray) })
}

/// The frame of a point: z its normal, x the view along the surface.
fn frame(point: &Point) -> DMat3 {
    let z = point.normal.normalize();
    let x = (point.view - point.view.dot(z) * z).normalize();
    DMat3::from_cols(x, z.cross(x), z).transpose()
}

fn matrix(lobe: Ltc) -> DMat3 {
    DMat3::from_cols(DVec3::new(lobe.a, 0.0, 0.0), DVec3::new(0.0, lobe.c, 0.0), DVec3::new(lobe.b, 0.0, 1.0))
}

/// The radiance of a point, layer by layer.
fn expected(point: &Point, lights: &[Light], sheen: &SheenTable, ggx: &GgxTable) -> DVec3 {
    let mu = point.normal.dot(point.view).max(0.0);
    let frame = frame(point);
    let [a, b, r] = sheen.lookup(ALPHA, mu);
    let specular = ggx.lookup(ROUGHNESS, mu);
    let reflectance =
        DVec3::from(Schlick::channels(F0, DVec3::ONE).map(|of| of.albedo(specular.albedo, specular.fresnel)));
    let lobes = [Ltc::COSINE, specular.ltc, Ltc::sheen(a, b)].map(matrix);
    let base = 1.0 - SHEEN.max_element() * r;
    let colors = [base * BASE * (1.0 - reflectance.max_element()), base * reflectance, SHEEN * r];
    let mut sum = DVec3::ZERO;
    for light in lights {
        let contour: Vec<DVec3> = light.corners.iter().map(|corner| frame * (*corner - point.position)).collect();
        for (lobe, color) in lobes.iter().zip(colors) {
            sum += light.radiance * color * form_factor(std::slice::from_ref(&contour), *lobe, light.two_sided);
        }
    }
    sum
}

fn shaded(lights: &[Light], points: &[Point]) -> Vec<[[f32; 4]; 2]> {
    let wide = |v: DVec3| [v.x as f32, v.y as f32, v.z as f32, 0.0];
    let (mut buffer, mut corners) = (Vec::<[f32; 8]>::new(), Vec::new());
    for light in lights {
        let (normal, radiance) = (light.normal().as_vec3(), light.radiance.as_vec3());
        let count = light.corners.len() as u32 | u32::from(light.two_sided) << 31;
        let [first, count] = [corners.len() as u32, count].map(f32::from_bits);
        buffer.push([normal.x, normal.y, normal.z, first, radiance.x, radiance.y, radiance.z, count]);
        corners.extend(light.corners.iter().map(|corner| wide(*corner)));
    }
    let given: Vec<[[f32; 4]; 3]> =
        points.iter().map(|point| [point.position, point.normal, point.view].map(wide)).collect();
    let (sheen, ggx) = (SheenTable::embedded(), GgxTable::embedded());
    let tables = [
        device::texture(sheen.size()[0] as u32, &sheen.texels()),
        device::texture(ggx.texture_size()[0] as u32, &ggx.texels()),
    ];
    let inputs = [bytemuck::cast_slice(&buffer), bytemuck::cast_slice(&corners), bytemuck::cast_slice(&given)];
    device::run_with(&source(), &inputs, &[&tables[0], &tables[1]], points.len())
}

fn source() -> String {
    let files = ["ltc.wgsl", "sheen.wgsl", "ggx.wgsl"].map(files::source).concat();
    let ours = include_str!("../../examples/lights.wgsl");
    let theirs = include_str!("../../examples/lights_buffers.wgsl");
    [&files, theirs, ours, include_str!("lights.wgsl")].concat()
}

#[test]
fn a_picture_by_the_loop_is_the_sum_of_exact_form_factors() {
    let (lights, points) = (lights(), points());
    assert!(points.len() > SIZE[0] * SIZE[1] / 2);
    let (sheen, ggx) = (SheenTable::embedded(), GgxTable::embedded());
    let [mut total, mut greatest] = [0.0; 2];
    for (shaded, point) in shaded(&lights, &points).iter().zip(&points) {
        let [[red, green, blue, _], _] = shaded.map(|number| number.map(f64::from));
        let expected = expected(point, &lights[1..], &sheen, &ggx);
        let apart = (DVec3::new(red, green, blue) - expected).abs().max_element();
        assert!(apart < TOLERANCE, "at {}: {apart} off {expected}", point.position);
        (total, greatest) = (total + expected.element_sum(), f64::max(greatest, apart));
    }
    println!("greatest difference {greatest:e}, mean radiance {}", total / (3 * points.len()) as f64);
    assert!(total / points.len() as f64 > 0.2, "it is lit");
}

#[test]
fn four_corners_need_no_loop_and_a_winding_tells_the_normal() {
    let (lights, points) = (lights(), points());
    for [_, [x, y, z, apart]] in shaded(&lights, &points) {
        assert!(apart < 1e-6, "{apart}");
        // 2 x 2, facing down.
        assert_eq!([x, y, z], [0.0, -4.0, 0.0]);
    }
}

#[test]
fn the_mistakes_that_an_example_draws_can_be_made() {
    let names: Vec<&str> = planted::MISTAKES.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, velour::export::golden::Mistake::ALL.map(velour::export::golden::Mistake::name));
    for (name, edits) in planted::MISTAKES {
        let source = planted::source(edits);
        assert_ne!(source, planted::source(&[]), "{name}");
        files::compile(&source).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}
