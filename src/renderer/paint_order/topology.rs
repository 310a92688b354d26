//! An order that agrees with constraints.

use std::ops::Range;

use super::constraints::Constraint;

/// Who has to wait for whom.
struct Graph {
    /// The nodes after node k are `targets[starts[k]..starts[k + 1]]`.
    starts: Vec<u32>,
    targets: Vec<u32>,
    /// How many have to come before each node and have not come yet.
    blockers: Vec<u32>,
}

impl Graph {
    fn new(nodes: usize, constraints: &[Vec<Constraint>]) -> Self {
        let constraints = || constraints.iter().flatten().copied();
        let (mut starts, mut blockers) = (vec![0; nodes + 1], vec![0; nodes]);
        for [first, after] in constraints() {
            starts[first as usize + 1] += 1;
            blockers[after as usize] += 1;
        }
        (0..nodes).for_each(|node| starts[node + 1] += starts[node]);
        let mut next = starts.clone();
        let mut targets = vec![0; starts[nodes] as usize];
        for [first, after] in constraints() {
            let next = &mut next[first as usize];
            targets[*next as usize] = after;
            *next += 1;
        }
        Self { starts, targets, blockers }
    }

    /// Indices into `targets` of what comes after a node.
    fn edges(&self, node: u32) -> Range<usize> {
        self.starts[node as usize] as usize..self.starts[node as usize + 1] as usize
    }
}

/// Sorts the nodes in `preferred`, which is all of them, such that all constraints hold, and each group's nodes follow
/// each other where they can. Where constraints go in a circle, those within the circle give way to `preferred`.
///
/// `group_of` has the group of each node, below `groups`. Takes time in proportion to nodes and constraints.
pub fn sort(constraints: &[Vec<Constraint>], preferred: &[u32], group_of: &[u32], groups: usize) -> Vec<u32> {
    let mut graph = Graph::new(preferred.len(), constraints);
    let mut ready = Ready { in_group: vec![Vec::new(); groups], groups: Vec::new(), current: None };
    // What is added last is taken first.
    for &node in preferred.iter().rev().filter(|node| graph.blockers[**node as usize] == 0) {
        ready.add(node, group_of[node as usize]);
    }
    let mut is_done = vec![false; preferred.len()];
    let mut order = Vec::with_capacity(preferred.len());
    let mut unwound: Option<std::vec::IntoIter<u32>> = None;
    while order.len() < preferred.len() {
        let node = ready.take().or_else(|| {
            // All that is left waits for something.
            let unwound = unwound.get_or_insert_with(|| Circles::unwind(&graph, preferred, &is_done).into_iter());
            unwound.find(|node| !is_done[*node as usize])
        });
        let Some(node) = node else { break };
        is_done[node as usize] = true;
        order.push(node);
        for at in graph.edges(node) {
            let after = graph.targets[at] as usize;
            graph.blockers[after] -= 1;
            if graph.blockers[after] == 0 && !is_done[after] {
                ready.add(after as u32, group_of[after]);
            }
        }
    }
    order
}

/// Nodes that wait for nothing any more.
struct Ready {
    in_group: Vec<Vec<u32>>,
    /// Groups with such nodes, and some that had them.
    groups: Vec<u32>,
    /// The group that is taken from.
    current: Option<u32>,
}

impl Ready {
    fn add(&mut self, node: u32, group: u32) {
        let nodes = &mut self.in_group[group as usize];
        if nodes.is_empty() && self.current != Some(group) {
            self.groups.push(group);
        }
        nodes.push(node);
    }

    fn take(&mut self) -> Option<u32> {
        loop {
            if let Some(node) = self.current.and_then(|group| self.in_group[group as usize].pop()) {
                return Some(node);
            }
            self.current = Some(self.groups.pop()?);
        }
    }
}

/// A search for circles (Tarjan 1972: strongly connected components).
struct Circles<'a> {
    graph: &'a Graph,
    /// When the search came to each node.
    number: Vec<u32>,
    /// The least number that is known to be in the same circle.
    lowest: Vec<u32>,
    /// Each node's circle. What comes after it was found earlier.
    circle: Vec<u32>,
    circles: u32,
    /// Nodes that the search has come to, whose circle is not known yet.
    open: Vec<u32>,
    /// The way to where the search is: nodes, and the edge that comes next at each.
    path: Vec<(u32, usize)>,
    seen: u32,
}

/// Of a node that the search has not come to, or whose circle is not known.
const UNKNOWN: u32 = u32::MAX;

impl<'a> Circles<'a> {
    /// The nodes that are not done, circle after circle as the constraints between these have it, and in the preferred
    /// order in each.
    fn unwind(graph: &'a Graph, preferred: &[u32], is_done: &[bool]) -> Vec<u32> {
        let unknown = vec![UNKNOWN; preferred.len()];
        let (number, lowest, circle) = (unknown.clone(), unknown.clone(), unknown);
        let (open, path) = (Vec::new(), Vec::new());
        let mut search = Self { graph, number, lowest, circle, circles: 0, open, path, seen: 0 };
        let mut left: Vec<u32> = preferred.iter().copied().filter(|node| !is_done[*node as usize]).collect();
        for &root in &left {
            if search.number[root as usize] == UNKNOWN {
                search.run(root, is_done);
            }
        }
        left.sort_by_key(|node| std::cmp::Reverse(search.circle[*node as usize]));
        left
    }

    fn run(&mut self, root: u32, is_done: &[bool]) {
        self.enter(root);
        while let Some((node, at)) = self.path.last_mut() {
            let node = *node as usize;
            if *at < self.graph.edges(node as u32).end {
                let after = self.graph.targets[*at] as usize;
                *at += 1;
                if is_done[after] || self.circle[after] != UNKNOWN {
                    continue;
                }
                match self.number[after] {
                    UNKNOWN => self.enter(after as u32),
                    number => self.lowest[node] = self.lowest[node].min(number),
                }
            } else {
                self.path.pop();
                self.leave(node);
            }
        }
    }

    fn enter(&mut self, node: u32) {
        self.number[node as usize] = self.seen;
        self.lowest[node as usize] = self.seen;
        self.seen += 1;
        self.open.push(node);
        self.path.push((node, self.graph.edges(node).start));
    }

    fn leave(&mut self, node: usize) {
        if let Some((before, _)) = self.path.last() {
            let before = *before as usize;
            self.lowest[before] = self.lowest[before].min(self.lowest[node]);
        }
        if self.lowest[node] == self.number[node] {
            while let Some(member) = self.open.pop() {
                self.circle[member as usize] = self.circles;
                if member as usize == node {
                    break;
                }
            }
            self.circles += 1;
        }
    }
}
