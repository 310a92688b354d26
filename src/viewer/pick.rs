//! What is seen at a point of the picture: a ray of the camera against all triangles that are drawn.
//!
//! Each instance's box is tried first, then its triangles one by one, in `f64`: a click is rare, and a million triangles
//! take about 40 ms on two cores, less than it would take to build a hierarchy over them.

use std::ops::Range;

use glam::{DMat4, DVec2, DVec3, Vec2, Vec3};
use rayon::prelude::*;

use crate::scene::{AlphaMode, Bounds, Camera, Drawn, Material, Mesh, Projection, TextureSlot};

/// Triangles that are tried by one thread at a time.
const CHUNK: usize = 1 << 14;

/// A ray of a camera. Its parameter is the depth along the view, in metres.
#[derive(Clone, Debug)]
pub struct Ray {
    origin: DVec3,
    /// One metre along the view.
    direction: DVec3,
    /// Depths between which something is shown.
    depths: Range<f64>,
}

/// What a ray meets first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Picked {
    /// Index into `Drawn::instances`.
    pub instance: usize,
    /// Index into `Drawn::materials`.
    pub material: usize,
    /// In the world, metres.
    pub point: Vec3,
    /// Of the surface there as it is shaded but for normal maps, unit, to its front.
    pub normal: Vec3,
}

impl Ray {
    /// The ray through `at` in a picture of this aspect (width / height); (0, 0) is its upper left corner, (1, 1) the
    /// lower right one.
    pub fn new(camera: &Camera, aspect: f32, at: Vec2) -> Self {
        let at = (2.0 * at.as_dvec2() - 1.0) * DVec2::new(aspect.into(), -1.0);
        let (origin, direction, near, far) = match camera.projection {
            Projection::Perspective { yfov, near, far } => {
                (DVec3::ZERO, (at * (0.5 * f64::from(yfov)).tan()).extend(-1.0), near, far)
            }
            Projection::Orthographic { ymag, near, far } => {
                ((at * f64::from(ymag)).extend(0.0), DVec3::NEG_Z, near, far)
            }
        };
        let world_from_camera = camera.world_from_camera.as_dmat4();
        Self {
            origin: world_from_camera.transform_point3(origin),
            direction: world_from_camera.transform_vector3(direction),
            depths: near.into()..far.into(),
        }
    }

    /// Where along a line through a point it passes that nearest, metres; none where they are nearly parallel.
    pub fn along(&self, point: Vec3, axis: Vec3) -> Option<f32> {
        let (axis, direction) = (axis.as_dvec3().normalize(), self.direction.normalize());
        let between = point.as_dvec3() - self.origin;
        let cosine = axis.dot(direction);
        let square = 1.0 - cosine * cosine;
        (square > 1e-4).then(|| ((cosine * direction - axis).dot(between) / square) as f32)
    }

    /// Where it meets a plane; none where that is nearly edge-on, or behind.
    pub fn on_plane(&self, point: Vec3, normal: Vec3) -> Option<Vec3> {
        let (normal, direction) = (normal.as_dvec3().normalize(), self.direction.normalize());
        let slope = direction.dot(normal);
        let distance = (point.as_dvec3() - self.origin).dot(normal) / slope;
        (slope.abs() > 1e-3 && distance > 0.0).then(|| (self.origin + distance * direction).as_vec3())
    }

    /// Its point at this depth.
    pub fn at(&self, depth: f32) -> Vec3 {
        self.point(depth.into()).as_vec3()
    }

    fn point(&self, depth: f64) -> DVec3 {
        self.origin + depth * self.direction
    }

    /// The same ray in a mesh's space; its parameter stays.
    fn transformed(&self, mesh_from_world: &DMat4) -> Self {
        Self {
            origin: mesh_from_world.transform_point3(self.origin),
            direction: mesh_from_world.transform_vector3(self.direction),
            depths: self.depths.clone(),
        }
    }

    /// Whether it passes through a box.
    fn meets(&self, bounds: &Bounds) -> bool {
        let Range { start: mut enters, end: mut leaves } = self.depths;
        for axis in 0..3 {
            let sides = [bounds.min, bounds.max].map(|side| f64::from(side[axis]) - self.origin[axis]);
            match self.direction[axis] {
                0.0 if sides[0] > 0.0 || sides[1] < 0.0 => return false,
                0.0 => {}
                slope => {
                    let depths = sides.map(|side| side / slope);
                    enters = enters.max(depths[0].min(depths[1]));
                    leaves = leaves.min(depths[0].max(depths[1]));
                }
            }
        }
        enters <= leaves
    }

    /// The depth at which it meets a triangle, and the weights of the corners there (Moeller and Trumbore 1997); `culled`
    /// leaves out what is seen from behind, clockwise.
    fn meeting(&self, [a, b, c]: [DVec3; 3], culled: bool) -> Option<(f64, DVec3)> {
        let (to_b, to_c) = (b - a, c - a);
        let normal = self.direction.cross(to_c);
        let determinant = to_b.dot(normal);
        if determinant == 0.0 || culled && determinant < 0.0 {
            return None;
        }
        let from_a = self.origin - a;
        let of_b = from_a.dot(normal) / determinant;
        let other = from_a.cross(to_b);
        let of_c = self.direction.dot(other) / determinant;
        let depth = to_c.dot(other) / determinant;
        let weights = DVec3::new(1.0 - of_b - of_c, of_b, of_c);
        (weights.min_element() >= 0.0 && self.depths.contains(&depth)).then_some((depth, weights))
    }
}

/// What the ray meets first of what is drawn. Back faces that are culled, what is hidden, and holes that are cut out let
/// it through; what is blended stops it, unless it is wholly transparent.
pub fn pick(drawn: &Drawn, ray: &Ray) -> Option<Picked> {
    let mut nearest: Option<(Met, usize)> = None;
    let shown = (0..drawn.instances.len()).filter(|&instance| drawn.is_drawn(instance));
    // Instances of a mesh often follow each other.
    let mut boxed: Option<(usize, Bounds)> = None;
    for instance in shown {
        let placed = &drawn.instances[instance];
        let mesh = drawn.mesh(placed.mesh);
        let bounds = match boxed {
            Some((index, bounds)) if index == placed.mesh => bounds,
            _ => Bounds::of_points(&mesh.positions),
        };
        boxed = Some((placed.mesh, bounds));
        let mut ray = ray.transformed(&placed.world_from_mesh.as_dmat4().inverse());
        if let Some((met, _)) = &nearest {
            ray.depths.end = met.depth;
        }
        if !ray.meets(&bounds) {
            continue;
        }
        let culled = !drawn.is_double_sided(instance);
        let surface = Surface { drawn, mesh, material: &drawn.materials[mesh.material], culled };
        nearest = surface.nearest(&ray).map(|met| (met, instance)).or(nearest);
    }
    nearest.map(|(met, instance)| Picked {
        instance,
        material: drawn.mesh_of(instance).material,
        point: ray.point(met.depth).as_vec3(),
        normal: (drawn.instances[instance].world_from_normal() * met.normal.as_vec3()).normalize_or(Vec3::Y),
    })
}

/// The middle of what is seen in the middle of a camera's picture, or the point itself where the eye is within its box; none
/// where nothing is seen there.
pub fn subject(drawn: &Drawn, camera: &Camera) -> Option<Vec3> {
    let picked = pick(drawn, &Ray::new(camera, 1.0, Vec2::splat(0.5)))?;
    let (bounds, eye) = (bounds(drawn, picked.instance), camera.world_from_camera.w_axis.truncate());
    let is_within = bounds.with(eye) == bounds;
    Some(if is_within { picked.point } else { bounds.center() })
}

/// The box of an instance in the world, metres.
pub fn bounds(drawn: &Drawn, instance: usize) -> Bounds {
    let placed = &drawn.instances[instance];
    Bounds::of_points(&drawn.mesh(placed.mesh).positions).transformed(placed.world_from_mesh)
}

/// Where a ray meets a mesh.
struct Met {
    depth: f64,
    /// In the mesh's space.
    normal: DVec3,
}

/// A mesh and what it is made of.
struct Surface<'a> {
    drawn: &'a Drawn<'a>,
    mesh: &'a Mesh,
    material: &'a Material,
    /// Whether it is seen from its front alone.
    culled: bool,
}

impl Surface<'_> {
    /// Where a ray in the mesh's space meets it first. There front faces are counter-clockwise, whatever
    /// becomes of them in the world.
    fn nearest(&self, ray: &Ray) -> Option<Met> {
        let of_chunk = |indices: &[u32]| {
            let depths = indices.as_chunks::<3>().0.iter().filter_map(|corners| {
                let places = corners.map(|at| self.mesh.positions[at as usize].as_dvec3());
                let (depth, weights) = ray.meeting(places, self.culled)?;
                self.is_there(corners, weights).then_some((depth, *corners, weights))
            });
            depths.min_by(|one, other| one.0.total_cmp(&other.0))
        };
        let met = self.mesh.indices.par_chunks(3 * CHUNK).filter_map(of_chunk);
        let (depth, corners, weights) = met.min_by(|one, other| one.0.total_cmp(&other.0))?;
        Some(Met { depth, normal: self.normal(&corners, weights) })
    }

    /// The interpolated normal, or the triangle's.
    fn normal(&self, corners: &[u32; 3], weights: DVec3) -> DVec3 {
        let normals =
            corners.map(|at| self.mesh.normals.get(at as usize).map_or(DVec3::ZERO, |normal| normal.as_dvec3()));
        let smooth = weights.x * normals[0] + weights.y * normals[1] + weights.z * normals[2];
        let [a, b, c] = corners.map(|at| self.mesh.positions[at as usize].as_dvec3());
        smooth.try_normalize().unwrap_or_else(|| (b - a).cross(c - a).normalize_or_zero())
    }

    /// Whether anything of it is at a point of a triangle.
    fn is_there(&self, corners: &[u32; 3], weights: DVec3) -> bool {
        match self.material.alpha_mode {
            AlphaMode::Opaque => true,
            AlphaMode::Mask { cutoff } => self.opacity(corners, weights) >= cutoff.into(),
            AlphaMode::Blend => self.opacity(corners, weights) > 0.0,
        }
    }

    fn opacity(&self, corners: &[u32; 3], weights: DVec3) -> f64 {
        let colors = &self.mesh.colors;
        let of_vertex = |at: u32| colors.get(at as usize).map_or(1.0, |&[.., alpha]| f64::from(alpha) / 65535.0);
        let of_vertices = weights.dot(DVec3::from(corners.map(of_vertex)));
        f64::from(self.material.opacity) * of_vertices * self.texel(corners, weights)
    }

    /// The alpha of the base colour's texture; 1 without one.
    fn texel(&self, corners: &[u32; 3], weights: DVec3) -> f64 {
        let Some(used) = self.material.texture(TextureSlot::BaseColor) else { return 1.0 };
        let texture = self.drawn.scene.textures[used.texture];
        let image = &self.drawn.scene.images[texture.image];
        let coordinates = &self.mesh.tex_coords[used.tex_coord];
        let of_vertex = |at: u32| coordinates.get(at as usize).map_or(DVec2::ZERO, |at| at.as_dvec2());
        let [a, b, c] = corners.map(of_vertex);
        let uv = used.uv_from_tex_coord.as_daffine2().transform_point2(weights.x * a + weights.y * b + weights.z * c);
        let alpha = |at: usize| f64::from(image.texels[at][3]) / 255.0;
        texture.sampler.magnified([image.width, image.height], uv, alpha)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Edits, Image, Instance, Light, Polygon, Sampler, Scene, Texture, TextureUse};
    use glam::Mat4;

    const PERSPECTIVE: Projection = Projection::Perspective { yfov: 0.8, near: 0.1, far: 100.0 };
    const ORTHOGRAPHIC: Projection = Projection::Orthographic { ymag: 2.0, near: 0.1, far: 100.0 };

    /// A square of 2 x 2 metres in the plane z = 0, towards +z.
    fn square(material: usize) -> Mesh {
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        Mesh {
            positions: corners.map(|[x, y]| Vec3::new(x, y, 0.0)).to_vec(),
            tex_coords: [corners.map(|[x, y]| Vec2::new(0.5 + 0.5 * x, 0.5 - 0.5 * y)).to_vec(), vec![]],
            indices: vec![0, 1, 2, 0, 2, 3],
            material,
            ..Mesh::default()
        }
    }

    /// Squares of these materials, at these depths below the origin.
    fn squares(materials: Vec<Material>, depths: &[f32]) -> Scene {
        let instance = |(mesh, &depth): (usize, &f32)| Instance {
            name: String::new(),
            mesh,
            world_from_mesh: Mat4::from_translation(Vec3::new(0.0, 0.0, -depth)),
        };
        Scene {
            meshes: (0..depths.len()).map(square).collect(),
            instances: depths.iter().enumerate().map(instance).collect(),
            materials,
            ..Scene::default()
        }
    }

    fn matte(name: &str) -> Material {
        Material::matte(name, Vec3::ONE)
    }

    /// At a point of a picture of this aspect, from 5 metres above the origin.
    fn picked(scene: &Scene, edits: &Edits, projection: Projection, at: Vec2) -> Option<Picked> {
        let camera =
            Camera { name: String::new(), world_from_camera: Mat4::from_translation(5.0 * Vec3::Z), projection };
        pick(&Drawn::new(scene, edits), &Ray::new(&camera, 1.5, at))
    }

    fn middle(scene: &Scene) -> Option<usize> {
        picked(scene, &Edits::default(), PERSPECTIVE, Vec2::splat(0.5)).map(|picked| picked.material)
    }

    #[test]
    fn the_nearest_is_picked_where_it_is() {
        let scene = squares(vec![matte("far"), matte("near")], &[2.0, 0.0]);
        for projection in [PERSPECTIVE, ORTHOGRAPHIC] {
            // The place in the picture of points of the world, by the camera's definition.
            let place = |point: Vec3| {
                let half = match projection {
                    Projection::Perspective { yfov, .. } => (5.0 - point.z) * (0.5 * yfov).tan(),
                    Projection::Orthographic { ymag, .. } => ymag,
                };
                Vec2::new(0.5 + 0.5 * point.x / (1.5 * half), 0.5 - 0.5 * point.y / half)
            };
            for (point, material) in [(Vec3::new(0.3, -0.8, 0.0), 1), (Vec3::new(-0.9, 0.95, 0.0), 1)] {
                let found = picked(&scene, &Edits::default(), projection, place(point)).unwrap();
                assert_eq!((found.instance, found.material), (material, material));
                assert!(found.point.distance(point) < 1e-5, "{found:?}");
            }
            let beside = place(Vec3::new(1.05, 0.0, 0.0));
            assert_eq!(picked(&scene, &Edits::default(), projection, beside), None);
        }
    }

    #[test]
    fn what_is_culled_hidden_or_beyond_the_planes_is_not_picked() {
        let mut scene = squares(vec![matte("turned"), matte("behind")], &[0.0, 1.0]);
        let turned = Mat4::from_rotation_y(std::f32::consts::PI);
        scene.instances[0].world_from_mesh = turned;
        assert_eq!(middle(&scene), Some(1));
        scene.materials[0].double_sided = true;
        assert_eq!(middle(&scene), Some(0));
        scene.materials[0].double_sided = false;
        // Mirrored as well, it faces the eye.
        scene.instances[0].world_from_mesh = turned * Mat4::from_scale(Vec3::new(1.0, 1.0, -1.0));
        assert_eq!(middle(&scene), Some(0));
        // Before the near plane.
        scene.instances[0].world_from_mesh = Mat4::from_translation(4.95 * Vec3::Z);
        assert_eq!(middle(&scene), Some(1));
        scene.instances[1].world_from_mesh = Mat4::from_translation(-100.0 * Vec3::Z);
        assert_eq!(middle(&scene), None);
    }

    #[test]
    fn lamps_are_picked_while_they_are_seen() {
        let mut scene = squares(vec![matte("lamp"), matte("behind")], &[0.0, 1.0]);
        scene.materials[0].emission = Vec3::ONE;
        let outline = scene.meshes[0].positions.clone();
        let polygons = vec![Polygon { contours: vec![outline], normal: Vec3::Z, pattern: None }];
        scene.lights = vec![Light { radiance: Vec3::ONE, polygons, instance: 0, ..Light::default() }];
        assert!(Drawn::new(&scene, &Edits::default()).light(0).is_some_and(Light::is_lamp));
        assert_eq!(middle(&scene), Some(0));
        let edits = Edits { lights_visible: Some(false), ..Edits::default() };
        let found = picked(&scene, &edits, PERSPECTIVE, Vec2::splat(0.5));
        assert_eq!(found.map(|picked| picked.material), Some(1));
    }

    #[test]
    fn holes_let_through_what_lies_behind() {
        let mut scene = squares(vec![matte("lace"), matte("behind")], &[0.0, 1.0]);
        // Left half there, right half cut out.
        let texels = vec![[255, 255, 255, 255], [255, 255, 255, 0]];
        scene.images = vec![Image { name: String::new(), width: 2, height: 1, texels }];
        scene.textures = vec![Texture { image: 0, sampler: Sampler::DEFAULT }];
        let texture = TextureUse { texture: 0, tex_coord: 0, uv_from_tex_coord: Default::default() };
        scene.materials[0].textures[TextureSlot::BaseColor as usize] = Some(texture);
        let at =
            |scene: &Scene, x: f32| picked(scene, &Edits::default(), ORTHOGRAPHIC, Vec2::new(x, 0.5)).unwrap().material;
        assert_eq!([0.42, 0.58].map(|x| at(&scene, x)), [0, 0]);
        scene.materials[0].alpha_mode = AlphaMode::Mask { cutoff: 0.5 };
        assert_eq!([0.42, 0.58].map(|x| at(&scene, x)), [0, 1]);
        scene.materials[0].opacity = 0.0;
        scene.materials[0].alpha_mode = AlphaMode::Blend;
        assert_eq!([0.42, 0.58].map(|x| at(&scene, x)), [1, 1]);
    }
}
