//! Lights made of what glows.

use std::collections::HashMap;

use glam::{Mat4, Vec3};

use super::emission::{Glows, Seen, Surface};
use super::islands::{Island, Topology};
use super::notices::Notices;
use super::patterns::Patterns;
use super::{Light, Mesh, Polygon, Scene, clusters, overlaps};

/// The most flat parts of an emitter that light each for itself; those of one that has more are merged.
pub const PARTS_MAX: usize = 512;
/// The parts into which an emitter is merged that has more than [`PARTS_MAX`]: towards any direction a sphere of so
/// many sends what it should to 0.3%.
const MERGED_PARTS: usize = 256;
/// The fewest parts that an emitter is merged into so that the corners of all fit.
const PARTS_MIN: usize = 16;
/// The corners of a merged part, on average.
const PART_CORNERS: usize = 6;
/// The most corners of all lights of a scene together: every shaded point visits each of them.
pub const CORNERS_MAX: usize = 8192;
/// The most triangles of all emitters together that are searched for flat parts.
const TRIANGLES_MAX: usize = 1 << 23;
/// The most triangles of all emitters together whose flat parts are merged.
const MERGED_MAX: usize = 1 << 18;

/// The most cells along a side of a pattern.
const PATTERN_SIDE: u32 = 512;
/// Flat parts that may have patterns; more of them have none, which would take long to make.
const PATTERNED_MAX: usize = 256;
/// The most cells of all patterns of a scene together.
const PATTERNS_MAX: f64 = (1 << 21) as f64;

/// An instance that glows.
struct Emitter {
    /// Index into `Scene::instances`.
    instance: usize,
    /// Its flat parts, where they are no more than [`PARTS_MAX`].
    flat: Option<Vec<Island>>,
}

impl Emitter {
    /// About how many corners its parts have where they are to be no more than `parts`.
    fn corners(&self, parts: usize) -> usize {
        match &self.flat {
            Some(islands) if islands.len() <= parts => corners(islands.iter().map(|island| &island.polygon)),
            _ => PART_CORNERS * parts.min(MERGED_PARTS),
        }
    }
}

/// Adds a light for every instance from index `first` on that emits. What is past a limit glows but lights nothing.
pub(super) fn add_lights(scene: &mut Scene, first: usize, notices: &mut Notices) {
    let (mut glows, mut topologies) = (Glows::new(scene), HashMap::new());
    let bright: Vec<usize> = (first..scene.instances.len()).filter(|&index| glows.is_bright(index)).collect();
    let emitters = emitters(scene, bright, &mut topologies, notices);
    let halves = std::iter::successors(Some(PARTS_MAX), |parts| Some(parts / 2));
    let fits = |&parts: &usize| emitters.iter().map(|emitter| emitter.corners(parts)).sum::<usize>() <= CORNERS_MAX;
    let parts = halves.take_while(|&parts| parts >= PARTS_MIN).find(fits).unwrap_or(PARTS_MIN);
    let most = pattern_side(&emitters, &mut glows);
    let (mut lights, mut all, mut merged) = (Vec::new(), 0, 0);
    for Emitter { instance, flat } in emitters {
        let mesh = &scene.meshes[scene.instances[instance].mesh];
        let mut seen = glows.of(instance);
        let polygons = match flat.filter(|islands| islands.len() <= parts) {
            Some(islands) => {
                let place = scene.instances[instance].world_from_mesh;
                match glows.surface(instance) {
                    Some(surface) => patterned(surface, place, islands, most, &mut seen),
                    None => islands.into_iter().map(|island| island.polygon).collect(),
                }
            }
            None => {
                merged += mesh.indices.len() / 3;
                if merged > MERGED_MAX {
                    let kind = "emitters of many flat parts past 262144 triangles glow but light nothing";
                    notices.add(kind, || name(scene, instance));
                    continue;
                }
                let kind = "emitters of more flat parts than there is room for light by fewer that are nearly flat";
                notices.add(kind, || name(scene, instance));
                let topology = &topologies[&scene.instances[instance].mesh];
                clusters::polygons(&topology.placed(mesh, &scene.instances[instance]), parts.min(MERGED_PARTS))
            }
        };
        all += corners(&polygons);
        if all > CORNERS_MAX {
            all -= corners(&polygons);
            notices.add("emitters past 8192 corners in all glow but light nothing", || name(scene, instance));
        } else {
            lights.extend(light(scene, instance, polygons, seen));
        }
    }
    overlaps::separate(&mut lights);
    scene.lights.extend(lights);
}

/// The most cells along a side of a pattern; none where there are too many parts.
fn pattern_side(emitters: &[Emitter], glows: &mut Glows) -> u32 {
    let varying = emitters.iter().filter(|emitter| glows.varies(emitter.instance));
    let count: usize = varying.filter_map(|emitter| emitter.flat.as_ref()).map(Vec::len).sum();
    if count > PATTERNED_MAX {
        return 0;
    }
    PATTERN_SIDE.min((PATTERNS_MAX / count.max(1) as f64).sqrt() as u32)
}

/// The polygons of an emitter's flat parts, each with what it shows. Where that varies, the mean of it is seen.
fn patterned(surface: &Surface, place: Mat4, islands: Vec<Island>, most: u32, seen: &mut Seen) -> Vec<Polygon> {
    let found = (most > 0).then(|| Patterns::new(surface, place.as_dmat4(), &islands, most)).flatten();
    let mut polygons: Vec<Polygon> = islands.into_iter().map(|island| island.polygon).collect();
    if let Some(Patterns { patterns, mean }) = found {
        seen.emission = mean;
        polygons.iter_mut().zip(patterns).for_each(|(polygon, pattern)| polygon.pattern = pattern);
    }
    polygons
}

/// What a user calls an instance.
fn name(scene: &Scene, instance: usize) -> String {
    let instance = &scene.instances[instance];
    if instance.name.is_empty() { scene.meshes[instance.mesh].name.clone() } else { instance.name.clone() }
}

fn corners<'a>(polygons: impl IntoIterator<Item = &'a Polygon>) -> usize {
    polygons.into_iter().flat_map(|polygon| &polygon.contours).map(Vec::len).sum()
}

/// The instances that glow, with their flat parts, and how the meshes of all of them are connected.
fn emitters(
    scene: &Scene,
    bright: Vec<usize>,
    topologies: &mut HashMap<usize, Topology>,
    notices: &mut Notices,
) -> Vec<Emitter> {
    let mut triangles = 0;
    let mut emitter = |index: usize| {
        let instance = &scene.instances[index];
        let mesh: &Mesh = &scene.meshes[instance.mesh];
        triangles += mesh.indices.len() / 3;
        if triangles > TRIANGLES_MAX {
            triangles -= mesh.indices.len() / 3;
            notices.add("emitters past 8388608 triangles glow but light nothing", || name(scene, index));
            return None;
        }
        let topology = topologies.entry(instance.mesh).or_insert_with(|| Topology::new(mesh));
        let flat = topology.islands(mesh, instance, PARTS_MAX);
        Some(Emitter { instance: index, flat })
    };
    bright.into_iter().filter_map(&mut emitter).collect()
}

/// The light of an emitter, unless it has no area or is not seen to glow.
fn light(scene: &Scene, instance: usize, polygons: Vec<Polygon>, seen: Seen) -> Option<Light> {
    let material = &scene.materials[scene.meshes[scene.instances[instance].mesh].material];
    let radiance = material.emission * seen.emission.as_vec3();
    if polygons.is_empty() || radiance == Vec3::ZERO {
        return None;
    }
    // A channel that does not glow has no mean. With 1 it may be given a radiance later.
    let seen_share = Vec3::select(material.emission.cmpgt(Vec3::ZERO), seen.emission.as_vec3(), Vec3::ONE);
    Some(Light {
        name: name(scene, instance),
        radiance,
        seen_share,
        glowing_share: (seen.glowing / seen.area) as f32,
        two_sided: material.double_sided,
        polygons,
        instance,
        doubles: Vec::new(),
    })
}
