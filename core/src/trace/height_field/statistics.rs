//! How much work intersections took: rays, boxes tested, and how deep the walks went.
//!
//! For choosing the depth of a pyramid and for tests; a picture does not need it. A walk reports each step to
//! a [`Count`]: [`Statistics`] adds the steps up, [`Uncounted`] does nothing and the compiler leaves the
//! reports out of the walk.

/// What intersections have cost, added up: more than any picture takes fits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Statistics {
    /// Rays cast.
    pub rays: u64,
    /// Boxes tested, that of the whole surface included.
    pub box_tests: u64,
    /// Most nodes that a walk stood in at a time, one inside the other: at most the depth. Where nodes have
    /// other parts than halves, those do not count whose last part the walk is in.
    pub stack: u32,
}

/// What a walk reports its steps to.
pub(crate) trait Count {
    /// A ray begins.
    fn ray(&mut self);
    /// A box is tested.
    fn test(&mut self);
    /// The walk stands inside so many nodes.
    fn depth(&mut self, nodes: u32);
}

/// Counts nothing: for pictures.
pub(crate) struct Uncounted;

impl Count for Uncounted {
    fn ray(&mut self) {}
    fn test(&mut self) {}
    fn depth(&mut self, _: u32) {}
}

impl Count for Statistics {
    /// Every ray is tested against the box of the whole surface.
    fn ray(&mut self) {
        self.rays = self.rays.saturating_add(1);
        self.test();
    }

    fn test(&mut self) {
        self.box_tests = self.box_tests.saturating_add(1);
    }

    fn depth(&mut self, nodes: u32) {
        self.stack = self.stack.max(nodes);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_count_goes_on_beyond_32_bits() {
        let full = u64::from(u32::MAX);
        let mut statistics = Statistics { rays: full, box_tests: full, stack: 3 };
        statistics.ray();
        statistics.test();
        statistics.depth(2);
        assert_eq!(statistics, Statistics { rays: full + 1, box_tests: full + 2, stack: 3 });
        let mut last = Statistics { rays: u64::MAX, box_tests: u64::MAX, stack: 0 };
        last.ray();
        assert_eq!((last.rays, last.box_tests), (u64::MAX, u64::MAX));
    }
}
