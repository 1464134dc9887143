//! What a path is made of: moves of the pen and straight lines, as the curves of this crate yield them.

use super::point::Point2;

/// A part of a path: an iterator of them is drawn by [`Stroke`](crate::draw::Stroke).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum PathElement {
    /// Lift the pen and start here.
    MoveTo(Point2),
    /// Draw a straight line to here.
    LineTo(Point2),
}
