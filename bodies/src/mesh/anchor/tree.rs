//! Tree of boxes, which finds the nearest of many bodies without visiting most of them.
//!
//! The bodies of a branch are halved at the median of the middles of their boxes, along the axis on which
//! these lie farthest apart, until a leaf holds a few. Both halves hold as many bodies however these are
//! spread: one that lies far away enlarges the boxes above its leaf, and no others.
//!
//! This module is independent of tetrahedra.

use std::ops::Range;

use crate::mesh::Bounds;

/// Largest number of bodies of a leaf: visiting one costs about as much as visiting a few boxes.
const LEAF: usize = 4;

/// Growth of a body's box by its longest side: points that are in the body only by rounding are in its box,
/// too.
const GROWTH: f64 = 1e-6;

/// Boxes around bodies, and boxes around these.
pub(super) struct Tree {
    /// Each branch, with its first half behind it and the second half behind that.
    branches: Vec<Branch>,
    /// The bodies in the order of the leaves.
    bodies: Vec<usize>,
}

struct Branch {
    bounds: Bounds,
    /// Its part of the bodies.
    bodies: Range<usize>,
    /// Index of the second half; `None` for a leaf.
    second: Option<usize>,
}

/// Distance of a body from a point, `None` if it holds the point, and its index: in this order the smallest
/// is the nearest body, and the first of several.
pub(super) type Nearest = (Option<f64>, usize);

impl Tree {
    pub(super) fn new(mut boxes: Vec<Bounds>) -> Self {
        for bounds in &mut boxes {
            let growth = GROWTH * bounds.size().into_iter().fold(0.0, f64::max);
            bounds.min = bounds.min.map(|x| x - growth);
            bounds.max = bounds.max.map(|x| x + growth);
        }
        let mut tree = Self { branches: Vec::new(), bodies: (0..boxes.len()).collect() };
        tree.grow(&boxes, 0..boxes.len());
        tree
    }

    fn grow(&mut self, boxes: &[Bounds], range: Range<usize>) {
        let bodies = &mut self.bodies[range.clone()];
        let corners: Vec<_> = bodies.iter().flat_map(|&body| [boxes[body].min, boxes[body].max]).collect();
        let middle = |body: usize, c: usize| 0.5 * boxes[body].min[c] + 0.5 * boxes[body].max[c];
        let middles: Vec<_> = bodies.iter().map(|&body| [0, 1, 2].map(|c| middle(body, c))).collect();
        let here = self.branches.len();
        let bounds = Bounds::around(&corners);
        self.branches.push(Branch { bounds, bodies: range.clone(), second: None });
        if bodies.len() <= LEAF {
            return;
        }
        let spread = Bounds::around(&middles).size();
        let axis = (1..3).fold(0, |longest, c| if spread[c] > spread[longest] { c } else { longest });
        let half = bodies.len() / 2;
        bodies.select_nth_unstable_by(half, |&one, &other| {
            middle(one, axis).total_cmp(&middle(other, axis)).then(one.cmp(&other))
        });
        self.grow(boxes, range.start..range.start + half);
        self.branches[here].second = Some(self.branches.len());
        self.grow(boxes, range.start + half..range.end);
    }

    /// The body nearest to a point; `distance` is the distance to a body, `None` if the body holds the point.
    pub(super) fn nearest(&self, x: [f64; 3], distance: impl Fn(usize) -> Option<f64>) -> Option<Nearest> {
        let mut best = None;
        self.search(0, x, &distance, &mut best);
        best
    }

    fn search(
        &self,
        branch: usize,
        x: [f64; 3],
        distance: &impl Fn(usize) -> Option<f64>,
        best: &mut Option<Nearest>,
    ) {
        let Branch { bodies, second, .. } = &self.branches[branch];
        let Some(second) = *second else {
            for &body in &self.bodies[bodies.clone()] {
                let found = (distance(body), body);
                if best.is_none_or(|best| found < best) {
                    *best = Some(found);
                }
            }
            return;
        };
        // No body in a box is nearer than the box.
        let mut halves = [branch + 1, second].map(|half| (self.branches[half].bounds.distance(x), half));
        if halves[1].0 < halves[0].0 {
            halves.swap(0, 1);
        }
        for (least, half) in halves {
            if !best.is_some_and(|(distance, _)| least > distance.unwrap_or(0.0)) {
                self.search(half, x, distance, best);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use piola::__private::random::Random;

    use super::*;

    fn some(random: &mut Random, count: usize, spread: f64) -> Vec<Bounds> {
        let mut point = |reach: f64| [(); 3].map(|()| random.uniform(-reach, reach));
        let bounds = |_| {
            let (middle, half) = (point(spread), point(0.5));
            Bounds::around(&[1.0, -1.0].map(|sign| [0, 1, 2].map(|c| middle[c] + sign * half[c])))
        };
        (0..count).map(bounds).collect()
    }

    /// In a grid all boxes would fall into one cell.
    #[test]
    fn one_far_away_makes_no_more_to_look_at() {
        let mut random = Random::new(7);
        let mut boxes = some(&mut random, 4000, 10.0);
        let points: Vec<_> = (0..100).map(|_| [(); 3].map(|()| random.uniform(-10.0, 10.0))).collect();
        let looks = |boxes: &[Bounds]| -> usize {
            let (tree, looks) = (Tree::new(boxes.to_vec()), Cell::new(0));
            for &x in &points {
                let nearest = tree.nearest(x, |body| {
                    looks.set(looks.get() + 1);
                    (!boxes[body].contains(x)).then(|| boxes[body].distance(x))
                });
                assert!(nearest.is_some());
            }
            looks.get()
        };
        let near = looks(&boxes);
        boxes.push(Bounds { min: [1e7; 3], max: [1.1e7; 3] });
        let far = looks(&boxes);
        // Its leaf is at most one more for each point.
        assert!(far <= near + LEAF * points.len(), "{far} looks instead of {near}");
        assert!(near <= 50 * points.len(), "{near} looks at {} points", points.len());
    }
}
