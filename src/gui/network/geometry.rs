//! Where nodes and edges of a graph lie on the screen.

use egui::{Pos2, Rect, Vec2, vec2};

use super::links::Link;

/// Nodes on a circle, the first one on top, the others clockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Circle {
    centre: Pos2,
    radius: f32,
    count: usize,
    /// Radius of a node.
    pub node: f32,
}

impl Circle {
    /// Up to this many nodes carry their numbers inside.
    pub(super) const INSIDE: usize = 24;
    /// Up to this many nodes have numbers.
    pub(super) const NUMBERED: usize = 60;

    /// A circle of nodes in a place.
    pub(super) fn new(place: Rect, count: usize) -> Self {
        let margin = match count {
            0..=Self::INSIDE => 30.0,
            _ if count <= Self::NUMBERED => 22.0,
            _ => 10.0,
        };
        let radius = (place.size().min_elem() / 2.0 - margin).max(10.0);
        let arc = std::f32::consts::TAU * radius / count.max(1) as f32;
        Self { centre: place.center(), radius, count, node: (0.36 * arc).clamp(1.5, 13.0) }
    }

    /// The direction from the centre to a node.
    pub(super) fn outwards(&self, k: usize) -> Vec2 {
        if self.count == 1 {
            return vec2(0.0, -1.0);
        }
        let angle = std::f32::consts::TAU * k as f32 / self.count as f32;
        vec2(angle.sin(), -angle.cos())
    }

    /// The middle of a node.
    pub(super) fn at(&self, k: usize) -> Pos2 {
        if self.count == 1 { self.centre } else { self.centre + self.radius * self.outwards(k) }
    }

    /// The node under a point, within reach of a finger where nodes are small.
    pub(super) fn node_at(&self, point: Pos2) -> Option<usize> {
        let angle = (point - self.centre).angle() + std::f32::consts::FRAC_PI_2;
        let share = angle.rem_euclid(std::f32::consts::TAU) / std::f32::consts::TAU;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a number of a node, not negative"
        )]
        let nearest = (share * self.count as f32).round() as usize;
        let nearest = if self.count == 0 { 0 } else { nearest % self.count };
        let near = nearest < self.count && self.at(nearest).distance(point) <= self.node.max(5.0) + 3.0;
        near.then_some(nearest)
    }

    /// The points of an edge, from the border of one node to that of the other.
    pub(super) fn edge(&self, link: &Link) -> Vec<Pos2> {
        let (from, to) = (self.at(link.from), self.at(link.to));
        let way = to - from;
        if way.length() < 1.0 {
            return Vec::new();
        }
        // to the right of the way, so that the two edges of a pair lie apart
        let bend = if link.mutual { 0.13 * way.rot90() } else { Vec2::ZERO };
        let middle = from + 0.5 * way - bend;
        let start = from + self.node * (middle - from).normalized();
        let end = to + (self.node + 1.0) * (middle - to).normalized();
        if !link.mutual {
            return vec![start, end];
        }
        const PARTS: u8 = 14;
        let point = |k: u8| {
            let t = f32::from(k) / f32::from(PARTS);
            let (first, second) = (start.lerp(middle, t), middle.lerp(end, t));
            first.lerp(second, t)
        };
        (0..=PARTS).map(point).collect()
    }
}

/// The distance of a point from a line of points.
pub(super) fn distance(point: Pos2, line: &[Pos2]) -> f32 {
    let segment = |pair: &[Pos2]| {
        let (from, way) = (pair[0], pair[1] - pair[0]);
        let share = ((point - from).dot(way) / way.length_sq().max(1e-6)).clamp(0.0, 1.0);
        (from + share * way).distance(point)
    };
    line.windows(2).map(segment).fold(f32::INFINITY, f32::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(count: usize) -> Circle {
        Circle::new(Rect::from_min_size(Pos2::new(20.0, 40.0), vec2(300.0, 300.0)), count)
    }

    #[test]
    fn every_node_is_found_where_it_is_drawn() {
        for count in [1, 2, 4, 61, 500] {
            let circle = square(count);
            for k in [0, count / 3, count - 1] {
                assert_eq!(circle.node_at(circle.at(k)), Some(k), "{k} of {count}");
            }
        }
        assert_eq!(square(4).node_at(Pos2::new(170.0, 190.0)), None, "nothing in the middle");
    }

    #[test]
    fn the_two_edges_of_a_pair_lie_apart() {
        let circle = square(6);
        let link = |to, from| Link { to, from, weight: 1.0, mutual: true };
        let (there, back) = (circle.edge(&link(1, 4)), circle.edge(&link(4, 1)));
        let middle = there[there.len() / 2];
        assert!(distance(middle, &back) > 8.0, "apart in the middle");
        assert!(distance(middle, &there) < 0.1, "a point of the edge lies on it");
        let alone = circle.edge(&Link { mutual: false, ..link(1, 4) });
        assert_eq!(alone.len(), 2, "an edge alone is straight");
    }

    #[test]
    fn edges_end_at_the_border_of_their_nodes() {
        let circle = square(5);
        let points = circle.edge(&Link { to: 2, from: 0, weight: 1.0, mutual: false });
        let (start, end) = (points[0].distance(circle.at(0)), points[1].distance(circle.at(2)));
        assert!(
            (start - circle.node).abs() < 0.01 && (end - circle.node - 1.0).abs() < 0.01,
            "{start}, {end}"
        );
    }
}
