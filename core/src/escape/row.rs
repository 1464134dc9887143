//! Rows of pictures whose value is a function of the point: one iterator, written once.

/// Implements a row with the fields `picture` and `line` for a picture with `value_at`.
macro_rules! values_along_a_line {
    ($row:ident, $value:ty) => {
        impl<P: EscapeTime> Iterator for $row<'_, P> {
            type Item = $value;

            #[inline]
            fn next(&mut self) -> Option<$value> {
                self.line.next().map(|point| self.picture.value_at(point))
            }

            #[inline]
            fn nth(&mut self, n: usize) -> Option<$value> {
                self.line.nth(n).map(|point| self.picture.value_at(point))
            }

            #[inline]
            fn size_hint(&self) -> (usize, Option<usize>) {
                self.line.size_hint()
            }
        }

        impl<P: EscapeTime> ExactSizeIterator for $row<'_, P> {}
        impl<P: EscapeTime> core::iter::FusedIterator for $row<'_, P> {}
    };
}

pub(super) use values_along_a_line;
