//! What a leaf of the partition says, and in what order: mean, domain, coefficients.
//!
//! Contexts know sizes, neighbours' sizes and what of the leaf itself was said before, never a pixel: the
//! stream is read without decoding it.

use super::context::{self, NUMBER};
use super::levels::Levels;
use super::models::{Coder, number, tree};

/// A domain: a square twice as large as the leaf, from which it copies what its transform does not say.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Domain {
    /// Whether the place is one of 16 x 16 about the leaf, else one of all.
    pub near: bool,
    /// Column and row among the places.
    pub column: u32,
    /// See `column`.
    pub row: u32,
    /// Mirrored across (1), down (2), then transposed (4).
    pub isometry: u32,
    /// Contrast less 1 in eighths (0 to 7), and 8 if negative.
    pub scaling: u32,
}

impl Domain {
    /// Eight times the contrast.
    #[inline]
    pub const fn contrast(&self) -> i32 {
        let eighths = (self.scaling & 7) as i32 + 1;
        if self.scaling & 8 == 0 { eighths } else { -eighths }
    }
}

/// A leaf.
#[derive(Debug, Clone, Default)]
pub struct Leaf {
    /// Where it copies from.
    pub domain: Option<Domain>,
    /// Its mean less what the neighbours let expect, in steps.
    pub mean: i32,
    /// Place of its last coefficient along the scan, from 1; 0 for none.
    pub last: u32,
    /// Coefficients.
    pub levels: Levels,
}

/// What decides how a leaf is said.
#[derive(Debug, Clone, Copy)]
pub struct Setting {
    /// Logarithm of its side, 2 to 5.
    pub size: u32,
    /// 1 for chroma.
    pub chroma: u32,
    /// How many of two neighbours have a domain.
    pub neighbours: u32,
    /// Columns and rows of the places of domains that are not near; none without.
    pub far: Option<(u32, u32)>,
    /// Whether there are coefficients.
    pub transform: bool,
}

/// How many classes of frequencies there are.
pub const CLASSES: usize = 13;

/// Where each class ends along the scan.
const ENDS: [u32; CLASSES] = [1, 2, 3, 4, 6, 10, 15, 21, 28, 45, 64, 128, u32::MAX];

/// The class of the frequency at a place of the scan.
pub const fn class(i: u32) -> usize {
    let mut class = 0;
    while class < CLASSES - 1 && i >= ENDS[class] {
        class += 1;
    }
    class
}

/// A zigzag from the lowest frequency to the highest: `v` in the upper four bits, `u` in the lower.
const fn zigzag<const N: usize>(side: usize) -> [u8; N] {
    let mut scan = [0; N];
    let (mut n, mut diagonal) = (0, 0);
    while diagonal < 2 * side - 1 {
        let mut t = 0;
        while t <= diagonal {
            let v = if diagonal & 1 == 1 { t } else { diagonal - t };
            let u = diagonal - v;
            if v < side && u < side {
                scan[n] = (v << 4 | u) as u8;
                n += 1;
            }
            t += 1;
        }
        diagonal += 1;
    }
    scan
}

/// The order of the coefficients of blocks of 4, 8, and 16 and more.
const SCANS: [&[u8]; 4] = [&zigzag::<16>(4), &zigzag::<64>(8), &zigzag::<256>(16), &zigzag::<256>(16)];

/// The order of the coefficients of a block of `2^size`; the first is not said.
#[inline]
pub fn scan(size: u32) -> &'static [u8] {
    SCANS.get(size.wrapping_sub(2) as usize).copied().unwrap_or(&[])
}

impl Leaf {
    /// Says the leaf, or hears it: a decoder's leaf must come with all levels 0.
    #[inline]
    pub fn code(&mut self, coder: &mut impl Coder, setting: &Setting) {
        let k = (setting.size.clamp(2, 5) - 2) as usize;
        let plane = setting.chroma as usize & 1;
        let models = context::DOMAIN + (plane * 4 + k) * 3 + setting.neighbours.min(2) as usize;
        self.domain = match coder.bin(models, self.domain.is_some()) {
            true => Some(code_domain(coder, setting, k, self.domain)),
            false => None,
        };
        let models = context::MEAN + (plane * 4 + k) * NUMBER;
        let magnitude = number(coder, models, self.mean.unsigned_abs()) as i32;
        let negative = magnitude != 0 && coder.bin(context::MEAN_SIGN + plane * 4 + k, self.mean < 0);
        self.mean = if negative { -magnitude } else { magnitude };
        if setting.transform {
            self.code_levels(coder, setting.size, plane, k);
        }
    }

    #[inline(never)]
    fn code_levels(&mut self, coder: &mut impl Coder, size: u32, plane: usize, k: usize) {
        let scan = scan(size);
        let models = context::LAST + (plane * 4 + k) * NUMBER;
        self.last = number(coder, models, self.last).min(scan.len() as u32 - 1);
        // models of the class that a place is in, and where it ends
        let (mut models, mut ends) = (k * CLASSES, ENDS.iter());
        let mut end = ends.next().map_or(u32::MAX, |end| *end);
        for (i, place) in (1..).zip(scan.get(1..=self.last as usize).unwrap_or(&[])) {
            if i >= end {
                models += 1;
                end = ends.next().map_or(u32::MAX, |end| *end);
            }
            let level = self.levels.get(*place);
            let about = self.levels.about(*place);
            if i < self.last && !coder.bin(context::SIGNIFICANT + models * 3 + about, level != 0) {
                continue;
            }
            let mut magnitude = 1;
            if coder.bin(context::LARGE + models, level.unsigned_abs() > 1) {
                magnitude =
                    2 + number(coder, context::MAGNITUDE, level.unsigned_abs().saturating_sub(2)) as i32;
            }
            let negative = coder.raw(1, u32::from(level < 0)) == 1;
            self.levels.set(*place, if negative { -magnitude } else { magnitude });
        }
    }
}

/// Says a domain.
#[inline(never)]
fn code_domain(coder: &mut impl Coder, setting: &Setting, k: usize, said: Option<Domain>) -> Domain {
    let said = said.unwrap_or(Domain { near: false, column: 0, row: 0, isometry: 0, scaling: 0 });
    let near = match setting.far {
        Some(_) => coder.bin(context::NEAR + k, said.near),
        None => true,
    };
    let isometry = tree(coder, context::ISOMETRY, 3, said.isometry);
    let (column, row) = match setting.far {
        Some((columns, rows)) if !near => {
            let places = columns * rows;
            let bits = 32 - places.saturating_sub(1).leading_zeros();
            let place = coder.raw(bits, said.row * columns + said.column).min(places.saturating_sub(1));
            (place % columns.max(1), place / columns.max(1))
        }
        _ => (
            tree(coder, context::COLUMN + 16 * k, 4, said.column),
            tree(coder, context::ROW + 16 * k, 4, said.row),
        ),
    };
    let scaling = tree(coder, context::SCALING + 16 * k, 4, said.scaling);
    Domain { near, column, row, isometry, scaling }
}
