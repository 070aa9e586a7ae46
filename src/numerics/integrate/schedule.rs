//! A time grid cut at the instants where inputs jump.

/// Instants closer than this, relative to the horizon, are one instant.
const SEPARATION: f64 = 1e-12;

/// A stretch of time without jumps inside.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// First instant.
    pub start: f64,
    /// Last instant.
    pub end: f64,
    /// Grid points of the segment, as index and instant; a grid point on a jump belongs to the later segment.
    pub samples: Vec<(usize, f64)>,
    /// Instants inside at which the inputs are continuous but not smooth.
    pub kinks: Vec<f64>,
    lowest: f64,
    highest: f64,
}

impl Segment {
    /// The instant at which inputs must be evaluated to see this segment's side of a jump at either end.
    pub fn inside(&self, t: f64) -> f64 {
        t.max(self.lowest).min(self.highest)
    }

    /// Grid points and kinks in order, each with the index of its grid point, then the end.
    pub fn stops(&self) -> Vec<(Option<usize>, f64)> {
        let near = SEPARATION * self.end.abs().max(self.end - self.start);
        let samples = self.samples.iter().map(|(index, t)| (Some(*index), *t));
        let apart = |kink: &&f64| {
            let after = self.samples.partition_point(|(_, t)| t < kink);
            let neighbours = &self.samples[after.saturating_sub(1)..self.samples.len().min(after + 1)];
            neighbours.iter().all(|(_, t)| (t - **kink).abs() > near)
        };
        let kinks = self.kinks.iter().filter(apart);
        let mut stops: Vec<_> = samples.chain(kinks.map(|k| (None, *k))).collect();
        stops.sort_by(|a, b| a.1.total_cmp(&b.1));
        if stops.last().is_none_or(|last| last.1 < self.end) {
            stops.push((None, self.end));
        }
        stops
    }
}

/// Cuts an ascending grid at the jumps; instants outside the grid, or not finite, are ignored.
///
/// A jump at the very start is seen from its later side, a jump at the very end from its earlier side.
pub fn segments(grid: &[f64], jumps: &[f64], kinks: &[f64]) -> Vec<Segment> {
    let (Some(first), Some(last)) = (grid.first().copied(), grid.last().copied()) else { return Vec::new() };
    let separation = SEPARATION * (last - first).max(last.abs());
    let on = |instants: &[f64], t: f64| instants.iter().any(|jump| (jump - t).abs() <= separation);
    let mut cuts: Vec<f64> =
        jumps.iter().copied().filter(|t| *t > first + separation && *t < last - separation).collect();
    cuts.sort_by(f64::total_cmp);
    // nearer neighbours would leave no room between their margins
    cuts.dedup_by(|later, earlier| *later - *earlier <= 4.0 * separation);
    let mut result = Vec::with_capacity(cuts.len() + 1);
    let (mut start, mut next) = (first, 0);
    for (k, end) in cuts.iter().copied().chain([last]).enumerate() {
        let is_last = k == cuts.len();
        let mut samples = Vec::new();
        while next < grid.len() && (is_last || grid[next] < end - separation) {
            samples.push((next, grid[next].max(start)));
            next += 1;
        }
        let inner = |t: &f64| *t > start + separation && *t < end - separation;
        let mut kinks: Vec<f64> = kinks.iter().copied().filter(inner).collect();
        kinks.sort_by(f64::total_cmp);
        kinks.dedup_by(|later, earlier| *later - *earlier <= separation);
        let opens_at_jump = k > 0 || on(jumps, first);
        let closes_at_jump = !is_last || on(jumps, last);
        let lowest = if opens_at_jump { start + 2.0 * separation } else { start };
        let highest = if closes_at_jump { end - 2.0 * separation } else { end };
        result.push(Segment { start, end, samples, kinks, lowest, highest });
        start = end;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_point_on_a_jump_belongs_to_the_later_segment() {
        let parts = segments(&[0.0, 1.0, 2.0, 3.0], &[2.0 + 1e-14], &[0.5, 2.0]);
        assert_eq!(parts.len(), 2, "one jump inside: {parts:?}");
        assert_eq!(parts[0].samples, [(0, 0.0), (1, 1.0)], "before the jump");
        assert_eq!(parts[1].samples[0].0, 2, "on the jump");
        assert_eq!(parts[0].kinks, [0.5], "kinks at a jump are dropped");
        assert!(parts[0].inside(2.0 + 1e-14) < 2.0, "the first part never sees the jump");
        assert!(parts[1].inside(2.0) > 2.0 + 1e-14, "the second never sees the time before");
        assert_eq!(parts[0].inside(0.0), 0.0, "no jump at the start, no shift");
    }

    #[test]
    fn jumps_at_the_ends_or_outside_cut_nothing() {
        let parts = segments(&[0.0, 1.0], &[-1.0, 0.0, 1.0, 7.0, f64::NAN], &[]);
        assert_eq!(parts.len(), 1, "nothing inside: {parts:?}");
        assert!(parts[0].inside(0.0) > 0.0 && parts[0].inside(1.0) < 1.0, "both ends seen from inside");
    }

    #[test]
    fn unsorted_and_repeated_jumps_are_put_in_order() {
        let parts = segments(&[0.0, 4.0], &[3.0, 1.0, 1.0], &[]);
        let ends: Vec<f64> = parts.iter().map(|p| p.end).collect();
        assert_eq!(ends, [1.0, 3.0, 4.0], "ascending, once each");
        assert_eq!(parts[1].stops(), [(None, 3.0)], "a part without grid points still has its end");
    }
}
