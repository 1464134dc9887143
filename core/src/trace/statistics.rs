//! What intersections cost, for those who ask.

/// What intersections have cost, added up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Statistics {
    /// Rays cast.
    pub rays: u32,
    /// Boxes tested, that of the whole surface included.
    pub box_tests: u32,
    /// Most nodes that a walk stood in at a time, one inside the other: at most the depth.
    pub stack: u32,
}

/// What is told what an intersection costs.
pub(super) trait Count {
    fn ray(&mut self);
    fn test(&mut self);
    fn depth(&mut self, nodes: u32);
}

/// Nobody asks.
pub(super) struct Uncounted;

impl Count for Uncounted {
    fn ray(&mut self) {}
    fn test(&mut self) {}
    fn depth(&mut self, _: u32) {}
}

impl Count for Statistics {
    /// Every ray is tested against the box of the whole surface.
    fn ray(&mut self) {
        self.rays = self.rays.wrapping_add(1);
        self.test();
    }

    fn test(&mut self) {
        self.box_tests = self.box_tests.wrapping_add(1);
    }

    fn depth(&mut self, nodes: u32) {
        self.stack = self.stack.max(nodes);
    }
}
