//! Gradient noise in space: smooth, without direction, 0 at every point with whole coordinates.
//!
//! Each lattice point has a gradient `g`, one of the 12 directions from the middle of a cube to the middles
//! of its edges, chosen by a permutation `p` of 0 to 255: `p(p(p(i) + j) + k) mod 16`. A point of a cell is
//! promised `g . d` by each of its eight corners, `d` the way from the corner; the promises are mixed along
//! `z`, `y` and `x` with the weight `6 t^5 - 15 t^4 + 10 t^3`, whose first and second derivatives are 0 at
//! both ends, so that the noise has two continuous derivatives.
//!
//! Source: K. Perlin, "Improving Noise", 2002, and his reference implementation, whose permutation this is;
//! the course unit V, section 5.8.6.
//!
//! Format: coordinates 16 fractional bits, modulo `2^16`, of which the period 256 is a divisor, so that the
//! format wraps without a seam; inside 29.

use crate::num::{Unit, Vec3, high, mixed};

/// A coordinate in noise, where lattice points are 1 apart: 16 fractional bits.
pub type Lattice = fixed::types::I16F16;

/// The permutation of Perlin's reference implementation.
pub const PERMUTATION: [u8; 256] = [
    151, 160, 137, 91, 90, 15, 131, 13, 201, 95, 96, 53, 194, 233, 7, 225, 140, 36, 103, 30, 69, 142, 8, 99,
    37, 240, 21, 10, 23, 190, 6, 148, 247, 120, 234, 75, 0, 26, 197, 62, 94, 252, 219, 203, 117, 35, 11, 32,
    57, 177, 33, 88, 237, 149, 56, 87, 174, 20, 125, 136, 171, 168, 68, 175, 74, 165, 71, 134, 139, 48, 27,
    166, 77, 146, 158, 231, 83, 111, 229, 122, 60, 211, 133, 230, 220, 105, 92, 41, 55, 46, 245, 40, 244,
    102, 143, 54, 65, 25, 63, 161, 1, 216, 80, 73, 209, 76, 132, 187, 208, 89, 18, 169, 200, 196, 135, 130,
    116, 188, 159, 86, 164, 100, 109, 198, 173, 186, 3, 64, 52, 217, 226, 250, 124, 123, 5, 202, 38, 147,
    118, 126, 255, 82, 85, 212, 207, 206, 59, 227, 47, 16, 58, 17, 182, 189, 28, 42, 223, 183, 170, 213, 119,
    248, 152, 2, 44, 154, 163, 70, 221, 153, 101, 155, 167, 43, 172, 9, 129, 22, 39, 253, 19, 98, 108, 110,
    79, 113, 224, 232, 178, 185, 112, 104, 218, 246, 97, 228, 251, 34, 242, 193, 238, 210, 144, 12, 191, 179,
    162, 241, 81, 51, 145, 235, 249, 14, 239, 107, 49, 192, 214, 31, 181, 199, 106, 157, 184, 84, 204, 176,
    115, 121, 50, 45, 127, 4, 150, 254, 138, 236, 205, 93, 222, 114, 67, 29, 24, 72, 243, 141, 128, 195, 78,
    66, 215, 61, 156, 180,
];

/// What a number of the permutation stands for: the next number, and the gradient of the number before.
#[derive(Clone, Copy)]
#[repr(C, align(4))]
struct Entry {
    gradient: [i8; 3],
    next: u8,
}

/// The permutation and what it chooses, twice and one more: a sum of two numbers below 256 needs no
/// reduction, nor does the number that follows it. 2 KB of flash.
static TABLE: [Entry; 513] = {
    let mut table = [Entry { gradient: [0; 3], next: 0 }; 513];
    let mut i = 0;
    while i < 513 {
        let next = PERMUTATION[i & 255];
        // in the order of the reference implementation: u is x or y, v is y, x or z, and the lowest bits are
        // their signs
        let u = if next & 15 < 8 { 0 } else { 1 };
        let v = match next & 15 {
            0..4 => 1,
            12 | 14 => 0,
            _ => 2,
        };
        table[i].gradient[u] = if next & 1 == 0 { 1 } else { -1 };
        table[i].gradient[v] = if next & 2 == 0 { 1 } else { -1 };
        table[i].next = next;
        i += 1;
    }
    table
};

/// A noise: Perlin's, or one of another seed. Size: 3 bytes.
///
/// ```
/// use attractor::num::{Unit, Vec3};
/// use attractor::trace::texture::{Lattice, Noise};
/// let place = Vec3::new(Lattice::lit("3.5"), Lattice::lit("-42.25"), Lattice::lit("7"));
/// let [a, b] = [Noise::PERLIN.at(place), Noise::new(1).at(place)];
/// assert!(a != b && a.abs() < Unit::lit("1.1"));
/// assert_eq!(Noise::new(1).at(Vec3::new(place.z, place.z, place.z)), 0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Noise {
    /// What is added to the first index of the permutation, and changes the bits of the other two.
    keys: [u8; 3],
}

impl Noise {
    /// The noise of Perlin's reference implementation.
    pub const PERLIN: Self = Self { keys: [0; 3] };

    /// The noise of this seed: one of 16 million; Perlin's for 0.
    pub const fn new(seed: u32) -> Self {
        let [a, b, c, _] = mixed(seed).to_le_bytes();
        Self { keys: [a, b, c] }
    }

    /// What was hashed from the seed.
    pub const fn keys(self) -> [u8; 3] {
        self.keys
    }

    /// The noise at a place.
    ///
    /// Domain: all. Result: in `-1.04 .. 1.04`, exactly 0 at lattice points. Error: below `2^-26` (row
    /// `Noise::at`). Cost: 24 multiplications for the gradients, 16 for the weights and mixtures (kernel row
    /// `noise`).
    #[inline]
    pub fn at(self, place: Vec3<Lattice>) -> Unit {
        let [x, y, z] = [place.x, place.y, place.z].map(Lattice::to_bits);
        let [i, j, k] = [x, y, z].map(|c| (c >> 16) as u32);
        let [key_x, key_y, key_z] = self.keys.map(u32::from);
        let [a, b] = pair(i.wrapping_add(key_x) & 255);
        let along_y = |entry: &Entry| pair((u32::from(entry.next) ^ key_y) + (j & 255));
        let along_z = |entry: &Entry| pair((u32::from(entry.next) ^ key_z) + (k & 255));
        let ([aa, ab], [ba, bb]) = (along_y(a), along_y(b));
        let corners = [aa, ab, ba, bb].map(along_z);

        // from both ends of the cell, 29 fractional bits
        let [x, y, z] = [x, y, z].map(|c| c << 16);
        let near = [x, y, z].map(|c| (c as u32 >> 3) as i32);
        let far = near.map(|c| c - (1 << 29));
        let [u, v, w] = [x, y, z].map(|c| weight(c ^ i32::MIN));
        let edge = |[from, to]: [&Entry; 2], x: i32, y: i32| {
            mix(w, promise(from, [x, y, near[2]]), promise(to, [x, y, far[2]]))
        };
        let [aa, ab, ba, bb] = corners;
        let a = mix(v, edge(aa, near[0], near[1]), edge(ab, near[0], far[1]));
        let b = mix(v, edge(ba, far[0], near[1]), edge(bb, far[0], far[1]));
        Unit::from_bits(mix(u, a, b) << 1)
    }
}

/// The entry of an index below 512, and the next one.
#[inline(always)]
fn pair(index: u32) -> [&'static Entry; 2] {
    let index = (index & 511) as usize;
    [&TABLE[index], &TABLE[index + 1]]
}

/// `g . d`.
#[inline(always)]
fn promise(entry: &Entry, [x, y, z]: [i32; 3]) -> i32 {
    // a copy of all three is loaded as two words and taken apart; a Cortex-M0 is no slower at that
    let [a, b, c] = if cfg!(no_long_product) {
        entry.gradient.map(i32::from)
    } else {
        entry.gradient.each_ref().map(|component| i32::from(*component))
    };
    // two of the three factors are 1 or -1: below 2^30
    a.wrapping_mul(x).wrapping_add(b.wrapping_mul(y)).wrapping_add(c.wrapping_mul(z))
}

/// `6 t^5 - 15 t^4 + 10 t^3 - 1/2 = s (15/16 - s^2 (5/8 - 3/16 s^2))` with 32 fractional bits, of
/// `s = 2 t - 1` with 31: exactly -1/2 for `t` = 0, below 1/2, and within `2^-28` in between.
#[inline(always)]
fn weight(s: i32) -> i32 {
    let square = high(s, s); // 30
    let inner = 3 * (square >> 3) - (5 << 28); // 31
    // the bracket is rounded down: no product leaves the format
    let bracket = (15 << 27) + (high(square, inner) << 2); // 31
    high(s, bracket) << 2
}

/// `(from + to) / 2 + (to - from) weight`.
#[inline(always)]
fn mix(weight: i32, from: i32, to: i32) -> i32 {
    // the two ways are on different sides of a cell: their promises are less than 3 apart
    let step = to.wrapping_sub(from);
    from.wrapping_add(step >> 1).wrapping_add(high(step, weight))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    fn at(noise: Noise, bits: [i32; 3]) -> i32 {
        let [x, y, z] = bits.map(Lattice::from_bits);
        noise.at(Vec3::new(x, y, z)).to_bits()
    }

    /// All 65536 of them, against f64, which has all the digits of the polynomial that count.
    #[test]
    fn every_weight_is_right_and_none_leaves_the_format() {
        let mut worst: f64 = 0.0;
        let mut last = i32::MIN;
        for t in 0..1 << 16 {
            let got = weight((t << 16) ^ i32::MIN);
            let x = f64::from(t) / 65536.0;
            let exact = x * x * x * (x * (x * 6.0 - 15.0) + 10.0) - 0.5;
            worst = worst.max((f64::from(got) / 2_f64.powi(32) - exact).abs());
            assert!(got >= last.saturating_sub(16), "{t}: {got} after {last}");
            last = got;
        }
        assert_eq!(weight(i32::MIN), i32::MIN);
        assert!(worst > 2_f64.powi(-30) && worst < 2_f64.powi(-28), "{worst:e}");
    }

    #[test]
    fn noise_is_zero_at_every_lattice_point_and_has_its_gradient_there() {
        let mut gradients = [0; 3];
        for seed in [0, 1, 99] {
            let noise = Noise::new(seed);
            for n in 0..3000_i32 {
                let p = [0x2545_f491, 0x6c07_8965, 0x1f12_3bb5].map(|c: i32| c.wrapping_mul(n) & !0xffff);
                assert_eq!(at(noise, p), 0, "{p:?}");
                // one step of the format along each axis: the gradient's component, less the bend
                let steps: Vec<i32> = (0..3)
                    .map(|axis| {
                        let mut q = p;
                        q[axis] = q[axis].wrapping_add(1);
                        (at(noise, q) + (1 << 13)) >> 14
                    })
                    .collect();
                assert_eq!(steps.iter().map(|c| c * c).sum::<i32>(), 2, "{p:?}: {steps:?}");
                for (count, step) in gradients.iter_mut().zip(steps) {
                    *count += step;
                }
            }
        }
        // no direction is preferred
        assert!(gradients.iter().all(|sum| sum.abs() < 400), "{gradients:?}");
    }

    #[test]
    fn noise_goes_on_smoothly_over_cells_and_over_the_ends_of_the_format() {
        let (mut steepest, mut bent, mut zeros) = (0, 0, 0);
        for n in 0..2000_i32 {
            let mut p = [0x1234_5678, 0x0765_4321, 0x2468_ace1].map(|c: i32| c.wrapping_mul(n));
            let axis = (n % 3) as usize;
            // a lattice plane, the end of the format one time in four
            p[axis] = if n % 4 == 0 { i32::MIN } else { p[axis] & !0xffff };
            let value = |step: i32| {
                let mut q = p;
                q[axis] = q[axis].wrapping_add(step << 6);
                at(Noise::new(n as u32 & 3), q)
            };
            let values: Vec<i32> = (-4..=4).map(value).collect();
            for three in values.windows(3) {
                steepest = steepest.max((three[1] - three[0]).abs());
                bent = bent.max((three[2] - 2 * three[1] + three[0]).abs());
            }
            zeros += i32::from(values[3] == values[4]);
        }
        // steps of 2^-10: slopes below 3, second differences about 2^-20 times a second derivative below 20
        assert!(steepest > 1 << 19 && steepest < 3 << 20, "{steepest}");
        assert!(bent > 64 && bent < 20 << 10, "{bent}");
        assert!(zeros < 20, "{zeros}");
    }

    /// With a period of 256, negative coordinates have the noise of positive ones.
    #[test]
    fn noise_repeats_after_256_cells_whatever_the_sign() {
        let mut different = 0;
        for n in 0..2000_i32 {
            let p = [0x0123_4567, 0x0076_5432, 0x0024_68ac].map(|c: i32| c.wrapping_mul(n));
            for axis in 0..3 {
                let mut q = p;
                q[axis] = q[axis].wrapping_sub(256 << 16);
                assert_eq!(at(Noise::PERLIN, p), at(Noise::PERLIN, q));
                q[axis] = q[axis].wrapping_add(128 << 16);
                different += i32::from(at(Noise::PERLIN, p) != at(Noise::PERLIN, q));
            }
        }
        assert!(different > 5900, "{different}");
    }

    /// On lines that follow no axis; along an edge of the lattice noise is 0 where both gradients stand
    /// across it, as the formula says.
    #[test]
    fn noise_never_stands_still_for_long() {
        let mut longest = 0;
        for line in 0..60_i32 {
            let (mut run, mut last) = (0, 0);
            for n in 0..2000_i32 {
                let p = [97 + line, -61 - 2 * line, 31 + line].map(|c| c.wrapping_mul(n + 77 * line));
                let value = at(Noise::PERLIN, p);
                run = if value == last { run + 1 } else { 0 };
                (longest, last) = (longest.max(run), value);
            }
        }
        assert!(longest < 3, "{longest}");
    }

    #[test]
    fn noise_reaches_far_to_both_sides_and_no_farther_than_stated() {
        let place = |n: i32| [0x2545_f491, 0x6c07_8965, 0x1f12_3bb5].map(|c: i32| c.wrapping_mul(n));
        let values =
            (0..40_000).map(|n| f64::from(at(Noise::new(n as u32 >> 12), place(n))) / 2_f64.powi(30));
        let (least, most) =
            values.fold((0.0, 0.0), |(least, most): (f64, f64), v| (least.min(v), most.max(v)));
        assert!((-1.04..-0.8).contains(&least) && (0.8..1.04).contains(&most), "{least} {most}");
    }

    #[test]
    fn noises_of_other_seeds_have_nothing_to_do_with_each_other() {
        assert_eq!((Noise::new(0), Noise::default()), (Noise::PERLIN, Noise::PERLIN));
        assert_ne!(Noise::new(1).keys(), Noise::new(2).keys());
        let place =
            |n: i32| [0x2545_f491, 0x6c07_8965, 0x1f12_3bb5].map(|c: i32| c.wrapping_mul(2 * n + 1) >> 3);
        let value = |noise, n| f64::from(at(noise, place(n))) / f64::from(1 << 30);
        let n = 4000;
        let product = |a, b| (0..n).map(|i| value(a, i) * value(b, i)).sum::<f64>() / f64::from(n);
        let power = product(Noise::PERLIN, Noise::PERLIN);
        assert!(power > 0.04 && power < 0.12, "{power}");
        for (a, b) in [(0, 1), (1, 2), (2, 3), (0, 0xffff_ffff), (7, 1 << 31)] {
            let correlation = product(Noise::new(a), Noise::new(b)) / power;
            assert!(correlation.abs() < 5.0 / f64::from(n).sqrt(), "{a} {b}: {correlation}");
        }
    }
}
