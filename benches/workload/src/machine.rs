//! What the workload asks of the machine it runs on.

use embedded_graphics::primitives::Rectangle;

/// A counter of instructions and a painted stack.
pub trait Machine {
    /// Instructions executed so far, modulo `2^32`. A machine that cannot count says 0 for ever.
    fn instructions(&mut self) -> u32;

    /// Paints the free part of the stack, from the caller's frame downwards.
    fn paint_stack(&mut self) {}

    /// How many bytes of the paint were overwritten since: the deepest the stack went below the painter's
    /// caller.
    fn stack_used(&mut self) -> u32 {
        0
    }

    /// The pixels of `area` from the `offset`-th on, row by row, as they were drawn. The clock stands still.
    fn pixels(&mut self, area: Rectangle, offset: usize, colours: &[u16]) {
        let _ = (area, offset, colours);
    }

    /// Bytes of RAM that are free for a scene: what lies between the stack and the static data.
    fn ram_free(&mut self) -> usize {
        usize::MAX
    }
}

/// A machine that measures nothing: the host, which only compares results.
#[derive(Debug, Clone, Copy, Default)]
pub struct Blind;

impl Machine for Blind {
    fn instructions(&mut self) -> u32 {
        0
    }
}

/// Whether this is an image for Armv6-M, which alone lacks atomic exchange: it has only the rows that a
/// machine with 16 KiB of RAM runs, since all of them would not fit its flash.
pub(crate) const SMALL: bool = cfg!(all(target_arch = "arm", not(target_has_atomic = "32")));
