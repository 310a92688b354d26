//! Lights made of what glows.

use glam::Vec3;

use super::emission::Radiances;
use super::islands::Topology;
use super::notices::Notices;
use super::outline::crosses;
use super::{Light, Scene};

/// The most planar islands of an instance that is a light.
pub const ISLANDS_MAX: usize = 256;
/// The most corners of all lights of a scene together: every shaded point visits each of them.
pub const CORNERS_MAX: usize = 8192;
/// The most triangles of all emitters together that are searched for islands.
const TRIANGLES_MAX: usize = 1 << 23;

/// Adds a light for every instance from index `first` on that emits. What is past a limit glows but lights nothing.
pub(super) fn add_lights(scene: &mut Scene, first: usize, notices: &mut Notices) {
    let (mut triangles, mut corners) = (0, 0);
    let (mut radiances, mut lights) = (Radiances::new(scene), Vec::new());
    let mut topologies: Vec<Option<Topology>> = scene.meshes.iter().map(|_| None).collect();
    for index in first..scene.instances.len() {
        let instance = &scene.instances[index];
        let mesh = &scene.meshes[instance.mesh];
        let material = &scene.materials[mesh.material];
        if !radiances.is_bright(index) {
            continue;
        }
        let name = if instance.name.is_empty() { &mesh.name } else { &instance.name };
        triangles += mesh.indices.len() / 3;
        if triangles > TRIANGLES_MAX {
            triangles -= mesh.indices.len() / 3;
            notices.add("emitters past 8388608 triangles glow but light nothing", || name.clone());
            continue;
        }
        let topology = topologies[instance.mesh].get_or_insert_with(|| Topology::new(mesh));
        let Some(polygons) = topology.polygons(mesh, instance, ISLANDS_MAX) else {
            notices.add("emitters of more than 256 flat parts glow but light nothing", || mesh.name.clone());
            continue;
        };
        let own: usize = polygons.iter().flat_map(|polygon| &polygon.contours).map(Vec::len).sum();
        if corners + own > CORNERS_MAX {
            notices.add("emitters past 8192 corners in all glow but light nothing", || name.clone());
        } else if own > 0 {
            // What glows may have no area.
            let radiance = radiances.of(index);
            if radiance == Vec3::ZERO {
                continue;
            }
            corners += own;
            if polygons.iter().any(|polygon| crosses(&polygon.contours, polygon.normal)) {
                let kind = "emitters whose outline crosses itself light twice where they overlap";
                notices.add(kind, || name.clone());
            }
            let name = name.clone();
            // A channel that does not glow has no mean. With 1 it may be given a radiance later.
            let mean = radiance / material.emission.max(Vec3::splat(f32::MIN_POSITIVE));
            let texture_mean = Vec3::select(material.emission.cmpgt(Vec3::ZERO), mean, Vec3::ONE);
            let two_sided = material.double_sided;
            lights.push(Light { name, radiance, texture_mean, two_sided, polygons, instance: index });
        }
    }
    scene.lights.extend(lights);
}
