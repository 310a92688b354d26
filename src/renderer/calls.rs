//! What is drawn as calls, in pieces that fit into a pass.

use std::ops::Range;

use super::draws::Batch;

/// Where the indices of a call are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Source {
    /// In the mesh's own buffer, in the file's order.
    Mesh,
    /// In the buffer of blended triangles, in the order of the view.
    Sorted,
}

/// Instances of a batch, one after the other, with the same indices.
#[derive(Clone)]
pub(super) struct Draw<'a> {
    pub batch: &'a Batch,
    pub instances: Range<u32>,
    pub indices: Range<u32>,
    pub source: Source,
}

/// One call of a pass.
pub(super) struct Call<'a> {
    pub draw: Draw<'a>,
    /// Index of the pass that it belongs to.
    pub pass: usize,
}

/// The calls for all of this, in order, with at most so many triangles in a pass.
pub(super) fn split<'a>(draws: impl Iterator<Item = Draw<'a>>, triangles_a_pass: u32) -> Vec<Call<'a>> {
    let mut calls: Vec<Call> = Vec::new();
    let (mut pass, mut room) = (0, triangles_a_pass);
    for Draw { batch, mut instances, indices: all, source } in draws {
        let mut first = all.start;
        while !instances.is_empty() {
            let triangles = (all.end - first) / 3;
            if room < triangles.min(triangles_a_pass) {
                (pass, room) = (pass + 1, triangles_a_pass);
            }
            // As many whole instances as there is room for; where there is none for a whole one, a part of it.
            let (count, indices) = match room / triangles.max(1) {
                0 => (0, first..first + 3 * room),
                _ if first > all.start => (1, first..all.end),
                fitting => (fitting.min(instances.len() as u32), all.clone()),
            };
            let drawn = instances.start..instances.start + count.max(1);
            room -= (indices.len() as u32 / 3) * drawn.len() as u32;
            first = if count == 0 { indices.end } else { all.start };
            instances.start += count;
            calls.push(Call { draw: Draw { batch, instances: drawn, indices, source }, pass });
        }
    }
    calls
}
