//! Blended surfaces: which of their triangles are drawn in which order, anew for each view.

use std::collections::HashMap;
use std::ops::Range;

use glam::{Mat4, Vec3, Vec4};
use wgpu::{Buffer, BufferUsages};

use super::Gpu;
use super::calls::{Draw, Source};
use super::draws::{BlendedInstance, Draws, Frustum};
use super::paint_order::{PAIRS_MAX, PaintOrder, Painted, PlacedMesh, TRIANGLES_MAX};
use super::resident::Resident;
use super::view::View;
use crate::scene::{Drawn, Mesh};

/// What of a mesh decides the order.
struct Shape {
    positions: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
}

impl Shape {
    fn new(mesh: &Mesh) -> Self {
        Self { positions: mesh.positions.clone(), triangles: mesh.indices.as_chunks().0.to_vec() }
    }
}

/// A part of one blended instance that is drawn in one go.
struct Run {
    /// Index into `Draws::blended`.
    instance: usize,
    indices: Range<u32>,
    source: Source,
}

/// What the order depends on.
#[derive(PartialEq)]
struct Shown {
    clip_from_world: Mat4,
    eye: Vec4,
    /// By blended instance: mesh, place, and whether it is double-sided.
    placed: Vec<(usize, Mat4, bool)>,
}

/// Blended surfaces in the order of the view that was drawn last.
#[derive(Default)]
pub(super) struct Blended {
    /// Of the meshes that have been blended, by index: the scene itself is not at hand when a view is drawn.
    shapes: HashMap<usize, Shape>,
    shown: Option<Shown>,
    runs: Vec<Run>,
    indices: Option<Buffer>,
    /// Why the order is not exact.
    pub notice: Option<String>,
}

impl Blended {
    /// Keeps the shapes of what is blended now.
    pub fn update(&mut self, drawn: &Drawn, draws: &Draws) {
        for instance in &draws.blended {
            self.shapes.entry(instance.mesh).or_insert_with(|| Shape::new(drawn.mesh(instance.mesh)));
        }
    }

    /// Sorts for a view, unless it was the last one and nothing has moved.
    pub fn prepare(&mut self, gpu: &Gpu, draws: &Draws, view: &View) {
        let placed = |instance: &BlendedInstance| (instance.mesh, instance.world_from_mesh, instance.double_sided);
        let placed = draws.blended.iter().map(placed).collect();
        let shown = Shown { clip_from_world: view.clip_from_world, eye: view.eye, placed };
        if self.shown.as_ref() == Some(&shown) {
            return;
        }
        self.shown = Some(shown);
        let frustum = Frustum::new(view.clip_from_world, view.eye);
        let seen: Vec<usize> =
            (0..draws.blended.len()).filter(|index| frustum.may_show(&draws.blended[*index].bounds)).collect();
        let triangles = |index: &usize| self.shapes[&draws.blended[*index].mesh].triangles.len();
        if seen.iter().map(triangles).sum::<usize>() > TRIANGLES_MAX {
            self.sort_instances(draws, seen, &frustum);
        } else {
            self.sort_triangles(gpu, draws, &seen, view);
        }
    }

    fn sort_triangles(&mut self, gpu: &Gpu, draws: &Draws, seen: &[usize], view: &View) {
        let meshes = seen.iter().map(|index| {
            let BlendedInstance { mesh, world_from_mesh, double_sided, .. } = draws.blended[*index];
            let Shape { positions, triangles } = &self.shapes[&mesh];
            PlacedMesh { positions, triangles, world_from_mesh, double_sided }
        });
        let meshes: Vec<PlacedMesh> = meshes.collect();
        let order = PaintOrder::new(&meshes, view);
        let painted = order.triangles.iter();
        let indices: Vec<[u32; 3]> =
            painted.map(|painted| meshes[painted.mesh as usize].triangles[painted.triangle as usize]).collect();
        let mut end = 0;
        let run = |part: &[Painted]| {
            let start = end;
            end += 3 * part.len() as u32;
            Run { instance: seen[part[0].mesh as usize], indices: start..end, source: Source::Sorted }
        };
        self.runs = order.triangles.chunk_by(|one, next| one.mesh == next.mesh).map(run).collect();
        self.notice = (!order.is_exact).then(|| {
            format!(
                "blended triangles overlap in more than {PAIRS_MAX} pairs: they are drawn in the order of their middles, \
                 which is wrong for some; give materials that need no blending the alphaMode MASK or OPAQUE"
            )
        });
        self.upload(gpu, bytemuck::cast_slice(&indices));
    }

    /// Each instance as a whole, the farthest first.
    fn sort_instances(&mut self, draws: &Draws, seen: Vec<usize>, frustum: &Frustum) {
        let mut seen: Vec<(f32, usize)> =
            seen.into_iter().map(|index| (frustum.depth(draws.blended[index].bounds.center()), index)).collect();
        seen.sort_by(|(left, _), (right, _)| right.total_cmp(left));
        let run = |(_, instance): (f32, usize)| {
            let triangles = &self.shapes[&draws.blended[instance].mesh].triangles;
            Run { instance, indices: 0..3 * triangles.len() as u32, source: Source::Mesh }
        };
        self.runs = seen.into_iter().map(run).collect();
        self.notice = Some(format!(
            "more than {TRIANGLES_MAX} blended triangles are in view: whole meshes are drawn in the order of their \
             middles, their triangles in that of the file; give materials that need no blending the alphaMode MASK or OPAQUE"
        ));
    }

    /// Sends indices to the device, in a buffer that grows.
    fn upload(&mut self, gpu: &Gpu, indices: &[u8]) {
        let size = indices.len() as u64;
        if size == 0 {
            return;
        }
        let buffer = self.indices.take().filter(|buffer| buffer.size() >= size).unwrap_or_else(|| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("blended triangles"),
                size: size.next_power_of_two(),
                usage: BufferUsages::INDEX | BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        });
        gpu.queue.write_buffer(&buffer, 0, indices);
        self.indices = Some(buffer);
    }

    /// The sorted triangles' indices; nothing before the first of them were sorted.
    pub fn indices(&self) -> Option<&Buffer> {
        self.indices.as_ref()
    }

    /// What is drawn, in order.
    pub fn draws<'a>(&'a self, resident: &'a Resident) -> impl Iterator<Item = Draw<'a>> {
        self.runs.iter().map(|run| {
            let BlendedInstance { batch, slot, .. } = resident.draws.blended[run.instance];
            let batch = &resident.draws.batches[batch];
            Draw { batch, instances: slot..slot + 1, indices: run.indices.clone(), source: run.source }
        })
    }
}
