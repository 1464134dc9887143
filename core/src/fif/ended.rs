//! Cells with their ends, found by the place that they hold: for partitions whose parts are not alike.

/// A cell: index in its level, both ends with 31 fractional bits.
#[derive(Clone, Copy)]
pub(super) struct Ended {
    pub(super) index: usize,
    pub(super) start: u32,
    pub(super) end: u32,
}

impl Ended {
    pub(super) const WHOLE: Self = Self { index: 0, start: 0, end: 1 << 31 };

    fn place(self, start: u32) -> u32 {
        let width = self.end.wrapping_sub(self.start);
        self.start.wrapping_add(((u64::from(start) * u64::from(width) + (1 << 30)) >> 31) as u32)
    }

    pub(super) fn part(self, starts: &[u32], j: usize) -> Self {
        let start = starts.get(j).map_or(self.start, |s| self.place(*s));
        let end = starts.get(j + 1).map_or(self.end, |s| self.place(*s));
        Self { index: self.index * starts.len() + j, start, end }
    }

    /// The part that holds `u`; a place between two parts counts to the right one for the left end of an
    /// interval, to the left one for its right end.
    pub(super) fn holding(self, starts: &[u32], u: u32, left_end: bool) -> Self {
        let before = |s: u32| if left_end { self.place(s) <= u } else { self.place(s) < u };
        self.part(starts, starts.partition_point(|s| before(*s)).saturating_sub(1))
    }
}
