//! Trees that are growing, and their nodes brought together at the end.
//!
//! In each wave every tree takes one branch of its own queue, so each grows in the order of its own
//! bounds, whichever trees grow beside it.

use super::branches::{BranchQueue, PendingBranch};
use super::tree::{Root, ShadeTrees};

/// The trees of some camera rays that have branches to follow.
#[derive(Default)]
pub(super) struct Growth {
    growing: Vec<Growing>,
    /// Of each growing tree, the branch that is followed in this wave.
    pending: Vec<PendingBranch>,
    /// Empty queues, for their memory.
    spare: Vec<BranchQueue>,
    /// Of each node that a branch added, its root.
    roots: Vec<u32>,
    /// Of each node, where it goes.
    places: Vec<u32>,
    /// Of each root, where its last node so far goes.
    last: Vec<u32>,
}

/// A tree that is growing.
pub(super) struct Growing {
    /// Index into [`ShadeTrees::roots`].
    pub(super) root: u32,
    pub(super) queue: BranchQueue,
}

impl Growth {
    /// A queue for the branches of another tree.
    pub(super) fn queue(&mut self) -> BranchQueue {
        self.spare.pop().unwrap_or_default()
    }

    /// Adds a tree whose first node has branches.
    pub(super) fn add(&mut self, root: u32, queue: BranchQueue) {
        self.growing.push(Growing { root, queue });
    }

    /// Takes a branch of each tree that has any left, and forgets the others. False where none has.
    pub(super) fn take_wave(&mut self, roots: &mut [Root]) -> bool {
        let (pending, spare) = (&mut self.pending, &mut self.spare);
        pending.clear();
        self.growing.retain_mut(|tree| {
            let branch = tree.queue.next(&mut roots[tree.root as usize]);
            let grows = branch.is_some();
            pending.extend(branch);
            if !grows {
                let mut queue = std::mem::take(&mut tree.queue);
                queue.clear();
                spare.push(queue);
            }
            grows
        });
        !self.pending.is_empty()
    }

    /// The branches of this wave.
    pub(super) fn pending(&self) -> &[PendingBranch] {
        &self.pending
    }

    /// Branch `number` of this wave and the tree that it belongs to.
    pub(super) fn branch(&mut self, number: usize) -> (&PendingBranch, &mut Growing) {
        (&self.pending[number], &mut self.growing[number])
    }

    /// Notes that the last node that was added to the trees belongs to this root.
    pub(super) fn note_node(&mut self, root: u32, roots: &mut [Root]) {
        roots[root as usize].count += 1;
        self.roots.push(root);
    }

    /// Brings the nodes of each tree together, in the order in which they were added. The trees are
    /// those from a root on, their nodes those from a node on: first the roots' own, in the order of
    /// the roots, then the ones noted.
    pub(super) fn bring_together(
        &mut self,
        first_root: usize,
        first_node: usize,
        trees: &mut ShadeTrees,
    ) {
        if self.roots.is_empty() {
            return;
        }
        self.places.clear();
        let mut next = first_node as u32;
        for root in &mut trees.roots[first_root..] {
            root.first = next;
            next += root.count;
            self.places.extend((root.count > 0).then_some(root.first));
        }
        self.last.clear();
        let first = trees.roots[first_root..].iter().map(|root| root.first);
        self.last.extend(first);
        for root in self.roots.drain(..) {
            let last = &mut self.last[root as usize - first_root];
            *last += 1;
            self.places.push(*last);
        }
        permute(&mut trees.nodes[first_node..], &mut self.places, first_node);
    }
}

/// Moves each element to its place; places count from `first`.
fn permute<T>(elements: &mut [T], places: &mut [u32], first: usize) {
    for i in 0..elements.len() {
        while places[i] as usize != first + i {
            let place = places[i] as usize - first;
            elements.swap(i, place);
            places.swap(i, place);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::tree::{Node, Seen};
    use glam::DVec3;

    #[test]
    fn nodes_of_a_tree_come_together_in_the_order_in_which_they_were_added() {
        // Roots 0, 1, 3 see something; nodes are marked by their D.
        let mut trees = ShadeTrees::default();
        let mut growth = Growth::default();
        let add = |trees: &mut ShadeTrees, doppler: f64| {
            trees.nodes.push(Node {
                branch: None,
                doppler,
                seen: Seen::Sky(DVec3::Z),
            });
        };
        for (root, count) in [1, 1, 0, 1].into_iter().enumerate() {
            let first = trees.nodes.len() as u32;
            trees.roots.push(Root {
                first,
                count,
                cut: 0.0,
            });
            if count > 0 {
                add(&mut trees, root as f64);
            }
        }
        for (root, doppler) in [(0, 0.1), (3, 3.1), (0, 0.2), (1, 1.1), (3, 3.2), (0, 0.3)] {
            add(&mut trees, doppler);
            growth.note_node(root, &mut trees.roots);
        }
        growth.bring_together(0, 0, &mut trees);
        let of = |root: usize| -> Vec<f64> {
            let nodes = trees.nodes_of(trees.roots[root]);
            nodes.iter().map(|node| node.doppler).collect()
        };
        assert_eq!(of(0), [0.0, 0.1, 0.2, 0.3]);
        assert_eq!(of(1), [1.0, 1.1]);
        assert!(of(2).is_empty());
        assert_eq!(of(3), [3.0, 3.1, 3.2]);
    }
}
