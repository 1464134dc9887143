//! Where each decision's models begin among all of a stream.

/// Models that a number takes: `number` of the models.
pub const NUMBER: usize = 20;

/// By plane, size and how many of two neighbours are smaller.
pub const SPLIT: usize = 0;
/// By plane, size and how many of two neighbours have a domain.
pub const DOMAIN: usize = SPLIT + 2 * 4 * 3;
/// By size.
pub const NEAR: usize = DOMAIN + 2 * 4 * 3;
/// A tree of three bins.
pub const ISOMETRY: usize = NEAR + 4;
/// By size, a tree of four bins.
pub const COLUMN: usize = ISOMETRY + 8;
/// By size, a tree of four bins.
pub const ROW: usize = COLUMN + 4 * 16;
/// By size, a tree of four bins.
pub const SCALING: usize = ROW + 4 * 16;
/// By plane and size, a number.
pub const MEAN: usize = SCALING + 4 * 16;
/// By plane and size.
pub const MEAN_SIGN: usize = MEAN + 2 * 4 * NUMBER;
/// By plane and size, a number.
pub const LAST: usize = MEAN_SIGN + 2 * 4;
/// By size, class of the frequency and what is at the next lower ones.
pub const SIGNIFICANT: usize = LAST + 2 * 4 * NUMBER;
/// By size and class of the frequency.
pub const LARGE: usize = SIGNIFICANT + 4 * 13 * 3;
/// A number.
pub const MAGNITUDE: usize = LARGE + 4 * 13;
/// How many models there are.
pub const COUNT: usize = MAGNITUDE + NUMBER;
