//! Intersections of pixel rectangles: which part of a picture a target can show.
//!
//! In 64 bits, since `Rectangle::intersection` overflows for boxes near the ends of `i32`.

use core::ops::Range;

use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;

/// The columns and rows of a rectangle.
pub(super) type Spans = (Range<i64>, Range<i64>);

/// The columns and rows of `area`, as far as they have coordinates in 32 bits.
pub(super) fn spans(area: &Rectangle) -> Spans {
    let span = |start: i32, length: u32| {
        let start = i64::from(start);
        start..(start + i64::from(length)).min(1 << 31)
    };
    (span(area.top_left.x, area.size.width), span(area.top_left.y, area.size.height))
}

/// What lies in both.
pub(super) fn common(a: &Spans, b: &Spans) -> Spans {
    let both = |a: &Range<i64>, b: &Range<i64>| a.start.max(b.start)..a.end.min(b.end);
    (both(&a.0, &b.0), both(&a.1, &b.1))
}

/// Moved by `offset`.
pub(super) fn moved((x, y): Spans, offset: Point) -> Spans {
    let by = |span: Range<i64>, offset: i32| span.start + i64::from(offset)..span.end + i64::from(offset);
    (by(x, offset.x), by(y, offset.y))
}

/// The columns and rows of a picture of `size`, in its own coordinates.
pub(super) type Part = (Range<u32>, Range<u32>);

/// The part of a picture of `size` that shows when its `area` is drawn with the area's top left at the origin
/// of a target whose bounding box is `target`; either range may be empty.
pub(super) fn visible(size: Size, area: &Rectangle, target: &Rectangle) -> Part {
    narrow(common(&inside(size, area), &moved(spans(target), area.top_left)))
}

/// The part of a picture of `size` in `area`; either range may be empty.
pub(super) fn part(size: Size, area: &Rectangle) -> Part {
    narrow(inside(size, area))
}

fn inside(size: Size, area: &Rectangle) -> Spans {
    common(&spans(&Rectangle::new(Point::zero(), size)), &spans(area))
}

/// Of spans in common with a picture's own: not negative and at most 2^31.
fn narrow((x, y): Spans) -> Part {
    let narrow = |span: Range<i64>| span.start.max(0) as u32..span.end.max(0) as u32;
    (narrow(x), narrow(y))
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAST: i64 = i32::MAX as i64;

    fn rectangle(x: i32, y: i32, width: u32, height: u32) -> Rectangle {
        Rectangle::new(Point::new(x, y), Size::new(width, height))
    }

    #[test]
    fn the_visible_part_lies_in_the_picture_the_area_and_the_target() {
        let size = Size::new(100, 50);
        let whole = rectangle(0, 0, 100, 50);
        assert_eq!(visible(size, &whole, &rectangle(-5, 10, 20, 20)), (0..15, 10..30));
        assert_eq!(visible(size, &rectangle(30, 20, 10, 10), &rectangle(0, 0, 64, 64)), (30..40, 20..30));
        assert_eq!(visible(size, &rectangle(-3, 20, 10, 90), &rectangle(0, 0, 64, 64)), (0..7, 20..50));
        assert!(visible(size, &whole, &rectangle(100, 0, 9, 9)).0.is_empty());
    }

    #[test]
    fn boxes_at_the_ends_of_32_bits_do_not_overflow() {
        let huge = rectangle(i32::MIN, i32::MAX, u32::MAX, u32::MAX);
        let (x, y) = visible(Size::new(u32::MAX, u32::MAX), &huge, &huge);
        assert!(x.is_empty() && y.is_empty());
        let (x, y) = visible(
            Size::new(9, 9),
            &rectangle(0, 0, u32::MAX, u32::MAX),
            &rectangle(i32::MIN, -1, u32::MAX, u32::MAX),
        );
        assert_eq!((x, y), (0..9, 0..9));
        // the last coordinate is one like the others
        assert_eq!(spans(&rectangle(i32::MAX, i32::MAX - 1, 1, 9)), (LAST..LAST + 1, LAST - 1..LAST + 1));
        let last = rectangle(i32::MAX, 0, 5, 1);
        assert_eq!(visible(Size::new(u32::MAX, 1), &last, &rectangle(0, 0, 5, 1)).0, (1 << 31) - 1..1 << 31);
    }
}
