//! Polygons as the shaders see them and as the reference sees them, and ways to draw random ones.

use crate::{device, files};
use glam::{DMat3, DVec2, DVec3, Mat3, Vec3};
use rand::RngExt;
use rand_pcg::Pcg64;
use std::f64::consts::TAU;
use velour::reference::polygon;

/// A shaded point and a light, in `f32`, as both sides are fed them.
#[derive(Clone, Debug)]
pub struct Case {
    pub position: Vec3,
    pub normal: Vec3,
    pub view: Vec3,
    pub contours: Vec<Vec<Vec3>>,
    pub light_normal: Vec3,
    pub two_sided: bool,
    pub m_inv: Mat3,
}

impl Case {
    /// A light in the shaded point's own frame: nothing is rounded on the way.
    pub fn local(contours: Vec<Vec<Vec3>>, light_normal: Vec3) -> Self {
        let m_inv = Mat3::IDENTITY;
        Self { position: Vec3::ZERO, normal: Vec3::Z, view: Vec3::X, contours, light_normal, two_sided: false, m_inv }
    }

    /// The point's height over the light's plane, as a share of its distance from the first vertex.
    pub fn height(&self) -> f64 {
        let first = self.contours[0][0].as_dvec3() - self.position.as_dvec3();
        self.light_normal.as_dvec3().dot(first).abs() / first.length()
    }

    /// The exact form factors of the diffuse lobe and of `m_inv`.
    pub fn exact(&self) -> [f64; 2] {
        let normal = self.normal.as_dvec3().normalize();
        let tangent = self.view.as_dvec3().reject_from_normalized(normal);
        // Where the view equals the normal to the last digit, any frame will do.
        let x = if tangent.length() < 1e-9 { normal.any_orthonormal_vector() } else { tangent.normalize() };
        let local_from_world = DMat3::from_cols(x, normal.cross(x), normal).transpose();
        let local = |vertex: &Vec3| local_from_world * (vertex.as_dvec3() - self.position.as_dvec3());
        let contours: Vec<Vec<DVec3>> =
            self.contours.iter().map(|contour| contour.iter().map(local).collect()).collect();
        [DMat3::IDENTITY, self.m_inv.as_dmat3()].map(|m_inv| polygon::form_factor(&contours, m_inv, self.two_sided))
    }
}

#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct PackedCase {
    position: Vec3,
    first: u32,
    normal: Vec3,
    count: u32,
    view: Vec3,
    two_sided: u32,
    light_normal: [f32; 4],
    m_inv: [[f32; 4]; 3],
}

/// What the shipped file gives for each case on the device: form factors of the diffuse lobe and of `m_inv`.
pub fn shaded(cases: &[Case]) -> Vec<[f32; 2]> {
    shaded_by(&files::source("ltc.wgsl"), cases)
}

/// The same from another source in place of the shipped file.
pub fn shaded_by(ltc: &str, cases: &[Case]) -> Vec<[f32; 2]> {
    let (mut packed, mut contours, mut vertices) = (Vec::new(), Vec::<[u32; 2]>::new(), Vec::<[f32; 4]>::new());
    for case in cases {
        packed.push(PackedCase {
            position: case.position,
            first: contours.len() as u32,
            normal: case.normal,
            count: case.contours.len() as u32,
            view: case.view,
            two_sided: u32::from(case.two_sided),
            light_normal: case.light_normal.extend(0.0).to_array(),
            m_inv: [0, 1, 2].map(|column| case.m_inv.col(column).extend(0.0).to_array()),
        });
        for contour in &case.contours {
            contours.push([vertices.len() as u32, contour.len() as u32]);
            vertices.extend(contour.iter().map(|vertex| vertex.extend(0.0).to_array()));
        }
    }
    let source = [ltc, include_str!("form_factor.wgsl")].concat();
    let inputs = [bytemuck::cast_slice(&packed), bytemuck::cast_slice(&contours), bytemuck::cast_slice(&vertices)];
    device::run(&source, &inputs, None, cases.len())
}

/// Log-uniform between two bounds.
pub fn log_uniform(random: &mut Pcg64, low: f64, high: f64) -> f64 {
    low * (high / low).powf(random.random::<f64>())
}

pub fn direction(random: &mut Pcg64) -> DVec3 {
    let z = random.random_range(-1.0..1.0);
    let (y, x) = random.random_range(0.0..TAU).sin_cos();
    let radius = f64::sqrt(1.0 - z * z);
    DVec3::new(radius * x, radius * y, z)
}

/// A simple polygon in its own plane around (0, 0), counter-clockwise, of size 1 along one axis and `thinness` along
/// the other: every third one is star-shaped and mostly concave, the others have their vertices on an ellipse.
pub fn outline(random: &mut Pcg64, thinness: f64) -> Vec<DVec2> {
    let count = random.random_range(3..=8);
    let star = random.random_range(0..3) == 0;
    let start = random.random_range(0.0..TAU);
    let mut vertices: Vec<DVec2> = (0..count)
        .map(|k| {
            let angle = start + TAU * (f64::from(k) + random.random_range(-0.45..0.45)) / f64::from(count);
            let radius = if star { random.random_range(0.1..0.5) } else { 0.5 };
            radius * DVec2::from_angle(angle) * DVec2::new(1.0, thinness)
        })
        .collect();
    vertices.rotate_left(random.random_range(0..count as usize));
    vertices
}

/// Where the shaded point is in relation to a polygon of size 1.
#[derive(Clone, Copy)]
pub enum Stand {
    /// This many sizes away, in any direction.
    Away(f64),
    /// This many sizes above a random point of the polygon's bounding square.
    Over(f64),
    /// This many sizes from a random point of an edge, in any direction.
    BesideEdge(f64),
}

/// The shaded point's place in the plane's frame (z towards the lit side).
pub fn stand(random: &mut Pcg64, outline: &[DVec2], stand: Stand) -> DVec3 {
    match stand {
        Stand::Away(distance) => distance * direction(random),
        Stand::Over(height) => DVec3::new(random.random_range(-0.7..0.7), random.random_range(-0.7..0.7), height),
        Stand::BesideEdge(distance) => {
            let k = random.random_range(0..outline.len());
            let point = outline[k].lerp(outline[(k + 1) % outline.len()], random.random());
            point.extend(0.0) + distance * direction(random)
        }
    }
}

/// A random lobe of the sheen: a from dust to fuzz, b of both signs.
pub fn sheen_lobe(random: &mut Pcg64) -> Mat3 {
    let a = random.random_range(0.03..1.2_f32);
    let b = random.random_range(-1.0..0.1_f32);
    Mat3::from_cols(Vec3::X * a, Vec3::Y * a, Vec3::new(b, 0.0, 1.0))
}

/// A random lobe of the specular base, like its fits: c is near 1 / (2 alpha) for GGX of `alpha`, and the peak is where
/// a mirror has it.
pub fn specular_lobe(random: &mut Pcg64, alpha: f64) -> Mat3 {
    let mu: f64 = random.random_range(0.01..1.0);
    let c = 0.5 / alpha * random.random_range(0.7..1.4);
    let lean = c * mu * f64::sqrt(1.0 - mu * mu) * random.random_range(0.9..1.1);
    let rows = [c * mu * mu, c, lean].map(|entry| entry as f32);
    Mat3::from_cols(Vec3::X * rows[0], Vec3::Y * rows[1], Vec3::new(rows[2], 0.0, 1.0))
}

/// Whether `position`, `normal` and `view` are random too, or the case is given in the local frame.
#[derive(Clone, Copy, PartialEq)]
pub enum Space {
    Local,
    World,
}

/// A light of the given size, seen from a surface of random orientation; two out of three are one-sided and seen from
/// the lit side.
pub fn place(random: &mut Pcg64, outline: &[DVec2], stand: DVec3, size: f64, space: Space) -> Case {
    place_contours(random, &[outline.to_vec()], stand, size, space)
}

/// The same for a light of several contours, the first of which encloses some of the area.
pub fn place_contours(random: &mut Pcg64, plane: &[Vec<DVec2>], stand: DVec3, size: f64, space: Space) -> Case {
    let two_sided = random.random_range(0..3) == 0;
    let stand = if two_sided { stand } else { stand.with_z(stand.z.abs()) };
    let plane_normal = direction(random);
    let (x, y) = plane_normal.any_orthonormal_pair();
    let in_local = DMat3::from_cols(x, y, plane_normal);
    let local: Vec<Vec<DVec3>> = plane
        .iter()
        .map(|contour| contour.iter().map(|vertex| size * (in_local * (vertex.extend(0.0) - stand))).collect())
        .collect();
    let m_inv = sheen_lobe(random);
    if space == Space::Local {
        let contours: Vec<Vec<Vec3>> =
            local.iter().map(|contour| contour.iter().map(|vertex| vertex.as_vec3()).collect()).collect();
        let normal = normal_of(&contours[0]);
        return Case { two_sided, m_inv, ..Case::local(contours, normal) };
    }
    let normal = direction(random);
    let (x, y) = normal.any_orthonormal_pair();
    let world_from_local = DMat3::from_cols(x, y, normal);
    let nearest = local.iter().flatten().map(|vertex| vertex.length()).fold(f64::INFINITY, f64::min);
    let position = (nearest * direction(random)).as_vec3();
    let world = |vertex: &DVec3| (world_from_local * vertex + position.as_dvec3()).as_vec3();
    let contours: Vec<Vec<Vec3>> = local.iter().map(|contour| contour.iter().map(world).collect()).collect();
    let light_normal = normal_of(&contours[0]);
    let view = direction(random).as_vec3();
    Case { position, normal: normal.as_vec3(), view, contours, light_normal, two_sided, m_inv }
}

/// The unit normal of a contour, as a loader computes it from its rounded vertices.
fn normal_of(contour: &[Vec3]) -> Vec3 {
    area_of(contour).normalize_or_zero().as_vec3()
}

/// The area of a contour times its normal (Newell), exact for the given vertices.
pub fn area_of(contour: &[Vec3]) -> DVec3 {
    let about = contour[0].as_dvec3();
    let next = contour.iter().cycle().skip(1);
    contour.iter().zip(next).map(|(p, q)| (p.as_dvec3() - about).cross(q.as_dvec3() - about) / 2.0).sum()
}
