//! Addresses in base `N`: which maps lead to a point of an attractor, and the parameter that they spell.
//!
//! `s = sum_i sigma_i / N^i`, `phi(s) = lim T_sigma1 ... T_sigman lambda`. Digits end with `0 0 0 ...` or
//! with `N-1 N-1 ...`; a parameter `i / N^p` inside `(0, 1)` has both: `1/2` is `1 0 0 ...` and `0 1 1 ...`
//! in base 2.
//!
//! Source: Tosan, Guerin, Baskurt, section 2.2, and 3.1 ("double binary development"). A surface has an
//! address for each of its two parameters.

use crate::Error;
use crate::num::{Wide, ratio};

/// What digits end with, for ever.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Tail {
    /// `0 0 0 ...`
    Zeros,
    /// `N-1 N-1 N-1 ...`
    Last,
}

/// An address: finitely many digits in base `N`, and a tail.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Address<const N: usize> {
    /// The digits as a number, the first the most significant.
    index: u32,
    levels: u32,
    tail: Tail,
}

impl<const N: usize> Address<N> {
    /// The base.
    const BASE: u32 = N as u32;

    /// The most digits: `N^levels` is below `2^32`.
    pub const MAX_LEVELS: u32 = match u32::MAX.checked_ilog(if N < 2 { 2 } else { N as u32 }) {
        Some(levels) => levels,
        None => 1,
    };

    /// The address of the parameter `index / N^levels` that ends with zeros; that of 1 ends with the last
    /// digit, as it has no other.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for more levels than [`Address::MAX_LEVELS`] or a parameter above 1.
    pub fn of(index: u32, levels: u32) -> Result<Self, Error> {
        let Some(count) = Self::count(levels) else {
            return Err(out_of_range("levels of an address", levels, Self::MAX_LEVELS));
        };
        if index > count {
            return Err(out_of_range("index of an address", index, count));
        }
        Ok(if index == count {
            Self { index: 0, levels: 0, tail: Tail::Last }
        } else {
            Self { index, levels, tail: Tail::Zeros }
        })
    }

    /// The address with these digits, the first of which tells the map that is applied last.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a digit of `N` or more, [`Error::Capacity`] for too many.
    pub fn from_digits(digits: &[u8], tail: Tail) -> Result<Self, Error> {
        if digits.len() > Self::MAX_LEVELS as usize {
            let capacity = Self::MAX_LEVELS as usize;
            return Err(Error::Capacity { what: "digits of an address", needed: digits.len(), capacity });
        }
        let mut index = 0_u32;
        for digit in digits {
            let digit = u32::from(*digit);
            if digit >= Self::BASE {
                return Err(out_of_range("digit of an address", digit, Self::BASE.saturating_sub(1)));
            }
            index = index.saturating_mul(Self::BASE).saturating_add(digit);
        }
        Ok(Self { index, levels: digits.len() as u32, tail })
    }

    /// How many addresses of this many digits there are.
    pub fn count(levels: u32) -> Option<u32> {
        if N < 2 { None } else { Self::BASE.checked_pow(levels) }
    }

    /// The digits as a number, and how many there are.
    pub const fn digits(&self) -> (u32, u32) {
        (self.index, self.levels)
    }

    /// What the digits end with.
    pub const fn tail(&self) -> Tail {
        self.tail
    }

    /// The other address of the same parameter; none of 0 and of 1, which have one.
    #[must_use]
    pub fn other(&self) -> Option<Self> {
        let short = self.shortest();
        let last = short.index.checked_rem(Self::BASE)?;
        let (index, levels) = (short.index, short.levels);
        match short.tail {
            Tail::Zeros if last > 0 => Some(Self { index: index.wrapping_sub(1), levels, tail: Tail::Last }),
            Tail::Last if levels > 0 => {
                Some(Self { index: index.wrapping_add(1), levels, tail: Tail::Zeros })
            }
            _ => None,
        }
    }

    /// `s`, to the nearest `2^-48`.
    pub fn parameter(&self) -> Wide {
        let index = u64::from(self.index) + u64::from(self.tail == Tail::Last);
        let count = Self::count(self.levels).unwrap_or(1);
        // index <= count < 2^32
        Wide::from_bits((ratio(index, 49, count.into()).wrapping_add(1) >> 1) as i64)
    }

    /// Without the digits that its tail repeats.
    #[must_use]
    pub fn shortest(self) -> Self {
        let repeated = match self.tail {
            Tail::Zeros => 0,
            Tail::Last => Self::BASE.wrapping_sub(1),
        };
        let mut short = self;
        while short.levels > 0 {
            let (rest, digit) = split::<N>(short.index);
            if digit != repeated {
                break;
            }
            short = Self { index: rest, levels: short.levels.wrapping_sub(1), ..short };
        }
        short
    }

    /// The address of the same parameter that ends with zeros, shortest; that of 1 has no digit.
    #[inline(always)]
    pub(super) fn canonical(self) -> Self {
        let short = self.shortest();
        match short.tail {
            // the last digit is below N - 1, so that it has a successor
            Tail::Last if short.levels > 0 => {
                Self { index: short.index.wrapping_add(1), tail: Tail::Zeros, ..short }
            }
            _ => short,
        }
    }
}

/// The addresses of both parameters of a place on a surface, with as many digits.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair {
    pub(super) indices: [u32; 2],
    pub(super) levels: u32,
    /// Whether they end with the last digit.
    pub(super) at_end: [bool; 2],
}

impl Pair {
    /// The canonical addresses of `s` and `t`; the shorter one repeats its tail.
    #[inline(always)]
    pub(super) fn of<const N: usize>(at: [Address<N>; 2]) -> Self {
        let [s, t] = at.map(Address::canonical);
        let levels = s.levels.max(t.levels);
        let padded = |address: Address<N>| {
            let places = (address.levels..levels).fold(1_u32, |count, _| count.wrapping_mul(N as u32));
            match address.tail {
                // below N^levels, which fits
                Tail::Zeros => address.index.wrapping_mul(places),
                // of 1, without a digit
                Tail::Last => places.wrapping_sub(1),
            }
        };
        let at_end = [s, t].map(|address| address.tail == Tail::Last);
        Self { indices: [padded(s), padded(t)], levels, at_end }
    }
}

/// A number without its last digit, and that digit.
#[inline(always)]
pub(super) fn split<const N: usize>(index: u32) -> (u32, u32) {
    const { assert!(N > 0, "a base") };
    (index / N as u32, index % N as u32)
}

fn out_of_range(what: &'static str, value: u32, most: u32) -> Error {
    let number = |n: u32| Wide::saturating_from_num(n);
    Error::OutOfRange { what, index: None, value: number(value), min: Wide::ZERO, max: number(most) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `01111...` and `1000...` are 1/2; 0 and 1 have one address each; the other of the other is itself.
    #[test]
    fn a_joint_has_two_addresses_and_an_end_one() {
        let half = Address::<2>::of(1, 1).unwrap();
        let other = half.other().unwrap();
        assert_eq!((other.digits(), other.tail()), ((0, 1), Tail::Last));
        assert_eq!((half.parameter(), other.parameter()), (Wide::lit("0.5"), Wide::lit("0.5")));
        assert_eq!(Address::<2>::from_digits(&[0, 1, 1, 1], Tail::Last).unwrap().shortest(), other);
        let mut joints = 0;
        for levels in 0..=4 {
            let count = Address::<3>::count(levels).unwrap();
            for index in 0..=count {
                let address = Address::<3>::of(index, levels).unwrap();
                let exact = f64::from(index) / f64::from(count);
                assert!((address.parameter().to_num::<f64>() - exact).abs() < 3e-15, "{index}");
                let Some(other) = address.other() else {
                    assert!(index == 0 || index == count, "{index} of {count}");
                    continue;
                };
                assert_ne!(other.tail(), address.tail());
                assert_eq!(other.parameter(), address.parameter());
                assert_eq!(other.other(), Some(address.shortest()));
                assert_eq!(other.canonical(), address.canonical());
                joints += 1;
            }
        }
        assert_eq!(joints, 2 + 8 + 26 + 80);
    }

    #[test]
    fn digits_and_levels_are_limited() {
        assert_eq!((Address::<2>::MAX_LEVELS, Address::<3>::MAX_LEVELS), (31, 20));
        assert!(Address::<2>::of(1 << 31, 31).is_ok() && Address::<2>::of(0, 32).is_err());
        assert!(Address::<2>::of(5, 2).is_err() && Address::<2>::from_digits(&[2], Tail::Zeros).is_err());
        assert!(matches!(
            Address::<2>::from_digits(&[0; 32], Tail::Zeros),
            Err(Error::Capacity { needed: 32, capacity: 31, .. })
        ));
        // no base
        assert!(Address::<1>::of(0, 0).is_err());
    }
}
