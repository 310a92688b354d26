// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
//! A hierarchy of boxes over triangles, cut at the median, in the order in which a ray without a stack goes through it.

use glam::Vec3;

/// Most triangles of a leaf; the shader has three bits for their number.
const LEAF: usize = 4;
/// Half of this share of the greatest coordinate is added to boxes on each side, so that rounding misses nothing.
const PADDING: f32 = 2e-6;

/// As the shader reads it: an inner node is followed by its first child.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Node {
    pub low: [f32; 3],
    /// The node to go on with where this one is missed, or done with.
    pub skip: u32,
    pub high: [f32; 3],
    /// 8 times the first triangle plus their number; 0 of an inner node.
    pub leaf: u32,
}

/// The nodes over triangles given by their corners, and the order in which leaves name them: indices into `triangles`.
pub fn build(triangles: &[[Vec3; 3]]) -> (Vec<Node>, Vec<usize>) {
    let mut order: Vec<usize> = (0..triangles.len()).collect();
    let mut nodes = Vec::new();
    let greatest = triangles.iter().flatten().fold(0.0_f32, |most, corner| most.max(corner.abs().max_element()));
    add(triangles, &mut order, 0, PADDING * greatest, &mut nodes);
    (nodes, order)
}

/// Adds the tree over some of the triangles, of which the first has this place in the order of all.
fn add(triangles: &[[Vec3; 3]], order: &mut [usize], first: usize, padding: f32, nodes: &mut Vec<Node>) {
    let corners = order.iter().flat_map(|&index| triangles[index]);
    let around = |(low, high): (Vec3, Vec3), corner: Vec3| (low.min(corner), high.max(corner));
    let (low, high) = corners.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), around);
    let (at, half) = (nodes.len(), order.len() / 2);
    let is_leaf = order.len() <= LEAF;
    let leaf = if is_leaf { (8 * first + order.len()) as u32 } else { 0 };
    nodes.push(Node { low: (low - padding).to_array(), skip: 0, high: (high + padding).to_array(), leaf });
    if !is_leaf {
        let axis = (high - low).max_position();
        let middle = |&index: &usize| triangles[index].iter().map(|corner| corner[axis]).sum::<f32>();
        order.select_nth_unstable_by(half, |one, other| middle(one).total_cmp(&middle(other)));
        let (left, right) = order.split_at_mut(half);
        add(triangles, left, first, padding, nodes);
        add(triangles, right, first + half, padding, nodes);
    }
    nodes[at].skip = nodes.len() as u32;
}
