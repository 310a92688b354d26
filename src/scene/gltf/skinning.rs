//! Linear blend skinning: vertices moved by the joints to which they are bound (glTF 2.0, section 3.7.3.3).

use glam::{DAffine3, DMat3, DVec3, Vec3, Vec4};

use super::Fault;
use crate::scene::mesh::normal_matrix;
use crate::scene::notices::Notices;
use crate::scene::{FARTHEST, Mesh};

/// Up to four joints that move each vertex, by their index in the skin, and how strongly each does.
pub struct Influences {
    pub joints: Vec<Joints>,
    pub weights: Vec<Vec4>,
}

/// Indices of four joints.
pub struct Joints([u16; 4]);

impl From<[f32; 4]> for Joints {
    fn from(joints: [f32; 4]) -> Self {
        // They were 16 bits wide in the file.
        Self(joints.map(|joint| joint as u16))
    }
}

/// Bytes in memory for each vertex of so many sets of influences, while it is moved.
pub fn vertex_bytes(sets: usize) -> usize {
    sets * (size_of::<Joints>() + size_of::<Vec4>()) + size_of::<DVec3>() + size_of::<bool>()
}

/// Moves vertices to the world, to where joints put them; then about the middle of them all, which is the result, so
/// that 32 bits hold their places wherever that is. Normals stay perpendicular to the surface and on its side.
/// Triangles that joints mirror are turned over, so that they are seen from their front as before.
pub fn apply(
    mesh: &mut Mesh,
    triangles: &mut [[u32; 3]],
    sets: &[Influences],
    joints: &[DAffine3],
    notices: &mut Notices,
) -> Result<DVec3, Fault> {
    let (mut placed, mut mirrored) = (Vec::new(), Vec::new());
    placed.reserve_exact(mesh.positions.len());
    mirrored.reserve_exact(mesh.positions.len());
    let mut oddities = Vec::new();
    for vertex in 0..mesh.positions.len() {
        let world_from_mesh = blend(vertex, sets, joints, &mut oddities)?;
        let p_world = world_from_mesh.transform_point3(mesh.positions[vertex].as_dvec3());
        let is_far = |value: &f64| value.is_nan() || value.abs() > f64::from(FARTHEST);
        if let Some(value) = p_world.to_array().into_iter().find(is_far) {
            let what = format_args!("vertex {vertex} is posed {value:.2e} m away; bring it within {FARTHEST:e} m");
            return Err(Fault::new(what));
        }
        placed.push(p_world);
        let is_mirrored = world_from_mesh.matrix3.determinant() < 0.0;
        mirrored.push(is_mirrored);
        turn(mesh, vertex, world_from_mesh.matrix3, is_mirrored);
    }
    for kind in oddities {
        notices.add(kind, || mesh.name.clone());
    }
    let (least, greatest) = placed.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(least, greatest), &point| {
        (least.min(point), greatest.max(point))
    });
    let middle = 0.5 * (least + greatest);
    mesh.positions = placed.into_iter().map(|p_world| (p_world - middle).as_vec3()).collect();
    for triangle in triangles {
        if triangle.iter().filter(|&&corner| mirrored[corner as usize]).count() >= 2 {
            triangle.swap(1, 2);
        }
    }
    Ok(middle)
}

/// Turns a vertex's normal and tangent with its surface. Where that is crushed to a line or a point, any direction will
/// do, and the file's is kept.
fn turn(mesh: &mut Mesh, vertex: usize, world_from_mesh: DMat3, is_mirrored: bool) {
    if let Some(normal) = mesh.normals.get_mut(vertex) {
        let turned = normal_matrix(world_from_mesh) * normal.as_dvec3();
        *normal = unit(turned).unwrap_or(*normal);
    }
    if let Some(tangent) = mesh.tangents.get_mut(vertex) {
        let (own, side) = (tangent.truncate(), if is_mirrored { -tangent.w } else { tangent.w });
        let turned = world_from_mesh * own.as_dvec3();
        *tangent = unit(turned).unwrap_or(own).extend(side);
    }
}

fn unit(vector: DVec3) -> Option<Vec3> {
    vector.try_normalize().map(|unit| unit.as_vec3())
}

/// The mean of the matrices of a vertex's joints by their weights, whatever the sum of these. Where no joint has one,
/// the first counts. What there is to say about the weights is added to `oddities`, once.
fn blend(
    vertex: usize,
    sets: &[Influences],
    joints: &[DAffine3],
    oddities: &mut Vec<&'static str>,
) -> Result<DAffine3, Fault> {
    let mut note = |kind| {
        if !oddities.contains(&kind) {
            oddities.push(kind);
        }
    };
    let (mut matrix, mut sum) = (DAffine3 { matrix3: DMat3::ZERO, translation: DVec3::ZERO }, 0.0);
    for Influences { joints: of_vertex, weights } in sets {
        for (joint, weight) in of_vertex[vertex].0.into_iter().zip(weights[vertex].to_array()) {
            if weight > 0.0 {
                let weight = f64::from(weight);
                let joint = find(joints, joint, vertex)?;
                matrix.matrix3 += weight * joint.matrix3;
                matrix.translation += weight * joint.translation;
                sum += weight;
            } else if weight < 0.0 {
                note("weights of joints below 0 are taken to be 0");
            } else if usize::from(joint) >= joints.len() {
                note("joints of no weight that the skin does not have are passed over");
            }
        }
    }
    if sum == 0.0 {
        note("vertices to which no joint has a weight go with their first joint");
        let first = sets.first().map_or(0, |set| set.joints[vertex].0[0]);
        return find(joints, first, vertex).copied();
    }
    let share = sum.recip();
    Ok(DAffine3 { matrix3: share * matrix.matrix3, translation: share * matrix.translation })
}

fn find(joints: &[DAffine3], joint: u16, vertex: usize) -> Result<&DAffine3, Fault> {
    let count = joints.len();
    let missing = || Fault::new(format_args!("vertex {vertex} is bound to joint {joint} of {count}; export it again"));
    joints.get(usize::from(joint)).ok_or_else(missing)
}
