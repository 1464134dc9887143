//! Whatever the description: core refuses it or computes with it, and neither panics nor overflows, nor goes
//! on for ever.
//!
//! The tests run with overflow checks (the profile `test`, which is optimised). Each generator mixes numbers
//! from all bits, the ends of the format and
//! ordinary ones; each test asserts how much was accepted, so that it has evaluated something.
//! `PROPTEST_CASES` sets how many descriptions are tried.
//! What takes time is counted where it can be: items, evaluations, words drawn, pixels; never seconds.
//! That no public name of core is left out says `every_name`.

mod codec;
mod curves;
mod deep;
mod draw;
mod escape;
mod every_name;
mod functions;
mod julia;
mod numbers;
mod patches;
mod systems;
mod terrain;
mod texture;
mod trace;
mod worlds;

use std::cell::Cell as Counter;
use std::convert::Infallible;

use attractor::num::Complex;
use attractor::num::{Real, Unit, Vec3, Wide};
use attractor::plane::{Field, Point2};
use attractor::rand_core::TryRng;
use attractor::rand_xoshiro::Xoshiro128PlusPlus;
use attractor::rand_xoshiro::rand_core::SeedableRng;
use embedded_graphics::geometry::Size;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::{RngSeed, TestRunner};

/// Tries descriptions; `check` says whether one was accepted, `percent` of them must be.
fn fuzz<S: Strategy>(strategy: S, percent: u32, check: impl Fn(S::Value) -> bool) {
    // the same descriptions on every run, unless PROPTEST_RNG_SEED says otherwise
    let default = ProptestConfig::default();
    let rng_seed = match default.rng_seed {
        RngSeed::Random => RngSeed::Fixed(8),
        given => given,
    };
    let config = ProptestConfig { failure_persistence: None, rng_seed, ..default };
    let (tried, accepted) = (Counter::new(0_u32), Counter::new(0_u32));
    let result = TestRunner::new(config).run(&strategy, |description| {
        tried.set(tried.get() + 1);
        accepted.set(accepted.get() + u32::from(check(description)));
        Ok(())
    });
    if let Err(error) = result {
        panic!("{error}");
    }
    let share = 100 * accepted.get() / tried.get().max(1);
    println!("{} of {} accepted", accepted.get(), tried.get());
    assert!(share >= percent, "only {share} % accepted");
}

/// All bits, ends, and numbers of a few bits.
fn word() -> impl Strategy<Value = i32> {
    let edges = prop::sample::select(vec![0, 1, -1, i32::MAX, i32::MIN, i32::MIN + 1, 1 << 30, -(1 << 30)]);
    prop_oneof![any::<i32>(), edges, (-1000..1000_i32, 0..20_u32).prop_map(|(v, s)| v << s)]
}

fn wide() -> impl Strategy<Value = Wide> {
    let edges = prop::sample::select(vec![0, 1, -1, i64::MAX, i64::MIN, i64::MIN + 1, 1 << 48, -(1 << 48)]);
    let bits = prop_oneof![any::<i64>(), edges, (-1000..1000_i64, 0..54_u32).prop_map(|(v, s)| v << s)];
    bits.prop_map(Wide::from_bits)
}

fn real() -> impl Strategy<Value = Real> {
    word().prop_map(Real::from_bits)
}

fn unit() -> impl Strategy<Value = Unit> {
    prop_oneof![word().prop_map(Unit::from_bits), (0..=1 << 30).prop_map(Unit::from_bits)]
}

fn vector(component: impl Strategy<Value = Real>) -> impl Strategy<Value = Vec3> {
    vec(component, 3).prop_map(|v| Vec3::new(v[0], v[1], v[2]))
}

/// A real inside ±`limit`.
fn inside(limit: i32) -> impl Strategy<Value = Real> {
    let limit = (limit << 24) - 1;
    prop_oneof![
        (-limit..=limit).prop_map(Real::from_bits),
        (-limit >> 20..=limit >> 20).prop_map(|b| Real::from_bits(b << 20))
    ]
}

fn point() -> impl Strategy<Value = Point2> {
    (real(), real()).prop_map(|(x, y)| Point2::new(x, y))
}

fn complex() -> impl Strategy<Value = Complex<Wide>> {
    let disc = (-3 << 10..3_i64 << 10).prop_map(|b| Wide::from_bits(b << 38));
    let part = || prop_oneof![wide(), disc.clone()];
    (part(), part()).prop_map(|(re, im)| Complex::new(re, im))
}

fn size() -> impl Strategy<Value = Size> {
    let side = || prop_oneof![6 => 1..=400_u32, 2 => 1..=3_u32, 1 => Just(1 << 14), 1 => any::<u32>()];
    (side(), side()).prop_map(|(w, h)| Size::new(w, h))
}

/// Some of a row, wherever it begins; the row need not exist.
fn part_of_a_row<F: Field>(picture: &F, y: u32, x: u32, skip: usize) -> usize {
    let Size { width, height } = picture.size();
    let (x, y) = (x % width, y % height);
    let mut row = picture.row(y, x..width.min(x.saturating_add(48)));
    let _ = row.nth(skip);
    row.count()
}

/// A generator that counts the words that are drawn from it.
struct Drawn<'a> {
    rng: Xoshiro128PlusPlus,
    words: &'a Counter<u64>,
}

impl<'a> Drawn<'a> {
    fn new(seed: u64, words: &'a Counter<u64>) -> Self {
        Self { rng: Xoshiro128PlusPlus::seed_from_u64(seed), words }
    }
}

impl TryRng for Drawn<'_> {
    type Error = Infallible;

    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        self.words.set(self.words.get() + 1);
        self.rng.try_next_u32()
    }

    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        self.words.set(self.words.get() + 2);
        self.rng.try_next_u64()
    }

    fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
        self.words.set(self.words.get() + bytes.len().div_ceil(4) as u64);
        self.rng.try_fill_bytes(bytes)
    }
}
