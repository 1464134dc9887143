//! How large a picture may be: the one check that every constructor with a size shares.

use embedded_graphics_core::geometry::Size;

use crate::Error;
use crate::num::Wide;

/// The largest number of pixels a side: coordinates of pixels stay far inside 32 bits.
pub const MAX_SIDE: u32 = 1 << 14;

/// Checks a picture's size: each side from 1 to [`MAX_SIDE`].
///
/// # Errors
/// [`Error::OutOfRange`] that names the side.
pub fn checked_size(size: Size) -> Result<Size, Error> {
    for (what, side) in [("width", size.width), ("height", size.height)] {
        if side == 0 || side > MAX_SIDE {
            return Err(Error::OutOfRange {
                what,
                index: None,
                value: Wide::saturating_from_num(side),
                min: Wide::ONE,
                max: Wide::from_num(MAX_SIDE as i16),
            });
        }
    }
    Ok(size)
}
