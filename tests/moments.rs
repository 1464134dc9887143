//! The moments of functions above their cells: those of the reference, exact fractions, and of each cell what
//! its parts are together.

use attractor::Error;
use attractor::fif::{Cell, Fif, Knot, Moments, Pyramid, Spread, Stretch, Sum, Sums, Trend};
use attractor::num::{Real, Scaling, Wide};
use attractor_reference as reference;
use attractor_tests::accuracy::{Example, dyadic_examples, nearest, other_examples, two_to};

const DEPTH: u32 = 5;

/// The integrals of all examples that stay inside the format: functions with a slope.
fn smooth() -> Vec<(&'static str, Fif<16, 4>, reference::Fif, reference::Fif)> {
    let of = |example: &Example| {
        let value = example.fixed().integral::<4>(Wide::ZERO).ok()?;
        // the function that the fixed one is, its scalings rounded
        let scaling: Vec<f64> = example.scaling.iter().map(|a| nearest(*a).to_num()).collect();
        let slope = reference::Fif::interpolating(&example.knots, &scaling);
        let slope = (0..example.integrate).fold(slope, |slope, _| slope.integral(0.0));
        Some((example.name, value, slope.integral(0.0), slope))
    };
    let all: Vec<_> = dyadic_examples().iter().chain(&other_examples()).filter_map(of).collect();
    assert!(all.len() >= 12, "{}", all.len());
    all
}

fn with_moments<const N: usize, const D: usize, R>(
    f: &Fif<N, D>,
    depth: u32,
    then: impl FnOnce(&Moments<'_>) -> R,
) -> Result<R, Error> {
    let count = Pyramid::cells(f.maps(), depth);
    let (mut cells, mut spreads) = (vec![Cell::ZERO; count], vec![Spread::ZERO; count]);
    let pyramid = Pyramid::new(f, depth, &mut cells)?;
    Ok(then(&Moments::new(f, &pyramid, &mut spreads)?))
}

/// The addresses of a level, from left to right.
fn addresses(maps: usize, level: u32) -> Vec<Vec<usize>> {
    let digit = |index: usize, k: u32| index / maps.pow(k) % maps;
    let address = |index| (0..level).rev().map(|k| digit(index, k)).collect();
    (0..maps.pow(level)).map(address).collect()
}

fn units(a: Real, b: f64) -> f64 {
    (a.to_num::<f64>() - b).abs() * two_to(24)
}

#[test]
fn moments_of_cells_are_those_of_the_reference() {
    let (mut tried, mut worst) = (0, 0.0_f64);
    for (name, f, value, slope) in smooth() {
        // a variance above 128 is saturated
        let most = reference::moments::stretches(&value, &slope, &[vec![]])[0];
        assert!(most.value_variance < 2000.0, "{name}");
        with_moments(&f, DEPTH, |moments| {
            for level in 0..=DEPTH {
                let exact = reference::moments::stretches(&value, &slope, &addresses(f.maps(), level));
                let first = Pyramid::cells(f.maps(), level) - exact.len();
                for (spread, exact) in moments.spreads()[first..].iter().zip(&exact) {
                    let off = [
                        units(spread.slope, exact.slope_variance.min(Real::MAX.to_num())),
                        units(spread.value, exact.value_variance.min(Real::MAX.to_num())),
                        units(spread.lift, exact.lift),
                    ];
                    let most = off.into_iter().fold(0.0, f64::max);
                    assert!(most < 1.0, "{name} level {level}: {spread:?} {exact:?} {off:?}");
                    (tried, worst) = (tried + 1, worst.max(most));
                }
            }
        })
        .unwrap();
    }
    assert!(tried > 2000 && worst > 0.49, "{tried} {worst}");
}

#[test]
fn cells_finer_than_a_pyramid_are_those_of_the_reference() {
    let (mut tried, mut worst) = (0, 0.0_f64);
    for (name, f, value, slope) in smooth() {
        let n = f.maps() as u64;
        for (level, k) in [(0, 0), (1, 1), (7, 5), (7, 77), (10, 1000), (12, 54_321)] {
            let index = k % n.pow(level);
            let address: Vec<usize> = (0..level).rev().map(|k| (index / n.pow(k) % n) as usize).collect();
            let exact = reference::moments::stretches(&value, &slope, &[address])[0];
            let found = f.spread_at(level, index).unwrap();
            let off = [
                units(found.slope, exact.slope_variance.min(Real::MAX.to_num())),
                units(found.value, exact.value_variance.min(Real::MAX.to_num())),
                units(found.lift, exact.lift),
            ];
            let most = off.into_iter().fold(0.0, f64::max);
            assert!(most < 1.0, "{name} {level} {index}: {found:?} {exact:?} {off:?}");
            (tried, worst) = (tried + 1, worst.max(most));
        }
    }
    assert!(tried > 70 && worst > 0.49, "{tried} {worst}");
}

/// What the parts of a cell are together is the cell, and so is an interval with its ends.
#[test]
fn an_interval_is_what_its_cells_are_together() {
    let (mut tried, mut worst, mut rough) = (0, 0.0_f64, 0);
    for (name, f, value, slope) in smooth() {
        let (x0, x1) = f.domain();
        let length = (x1 - x0).to_num::<f64>();
        let knots: Vec<f64> = f.knots().map(|k| (k.x - x0).to_num::<f64>() / length).collect();
        with_moments(&f, DEPTH, |moments| {
            for level in 0..DEPTH - 1 {
                let addresses = addresses(f.maps(), level);
                let exact = reference::moments::stretches(&value, &slope, &addresses);
                for (address, exact) in addresses.iter().zip(&exact) {
                    let (mut from, mut width) = (0.0, 1.0);
                    for j in address {
                        from += width * knots[*j];
                        width *= knots[j + 1] - knots[*j];
                    }
                    if exact.slope_variance > 100.0 || exact.value_variance > 100.0 || width < 0.002 {
                        continue;
                    }
                    let at = |u: f64| x0 + Wide::from_num(u * length);
                    let Stretch { slope, value, slope_variance, value_variance, covariance } =
                        moments.over(at(from), at(from + width)).unwrap();
                    let found = [slope, value, slope_variance, value_variance, covariance];
                    let truth = [
                        exact.slope,
                        exact.value,
                        exact.slope_variance,
                        exact.value_variance,
                        exact.covariance,
                    ];
                    // a unit of a number is that of a number up to 1, or of its size
                    let size = 1.0 + truth.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
                    for (a, b) in found.into_iter().zip(truth) {
                        worst = worst.max(units(a, b) / size);
                        assert!(units(a, b) < 6.0 * size, "{name} {address:?}: {found:?} {truth:?}");
                    }
                    rough += u32::from(exact.slope_variance > 0.01);
                    tried += 1;
                }
            }
        })
        .unwrap();
    }
    assert!(tried > 300 && rough > 100 && worst > 1.0, "{tried} {rough} {worst}");
}

/// Of cells, of neighbours together, and of intervals that end inside cells: even partitions and others.
#[test]
fn running_sums_tell_what_the_reference_says() {
    let (mut tried, mut uneven, mut worst) = (0, 0, 0.0_f64);
    for (name, f, value, slope) in smooth() {
        let depth = if f.maps() < 4 { 7 } else { 4 };
        let (x0, x1) = f.domain();
        let length = (x1 - x0).to_num::<f64>();
        let knots: Vec<f64> = f.knots().map(|k| (k.x - x0).to_num::<f64>() / length).collect();
        let even = (0..).zip(&knots).all(|(j, u)| (u * f.maps() as f64 - f64::from(j)).abs() < 1e-9);
        let mut memory = vec![Sum::ZERO; Sums::places(f.maps(), depth)];
        let sums = Sums::new(&f, depth, &mut memory).unwrap();
        let all = addresses(f.maps(), 2);
        let exact = reference::moments::stretches(&value, &slope, &all);
        for (address, exact) in all.iter().zip(&exact) {
            let (mut from, mut width) = (0.0, 1.0);
            for j in address {
                from += width * knots[*j];
                width *= knots[j + 1] - knots[*j];
            }
            if exact.slope_variance + exact.slope * exact.slope > 100.0 || width < 1.0 / 256.0 {
                continue;
            }
            let at = |u: f64| x0 + Wide::from_num(u * length);
            let Trend { slope, value, variance, covariance } = sums.over(at(from), at(from + width)).unwrap();
            // of the largest of slope, value and their squares
            let size = [exact.slope, exact.value, 1.0].map(|v| v * v).into_iter().fold(1.0, f64::max);
            let pairs = [
                (slope, exact.slope),
                (value, exact.value),
                (variance, exact.slope_variance),
                (covariance, exact.covariance),
            ];
            for (a, b) in pairs {
                worst = worst.max(units(a, b) / size);
                assert!(units(a, b) < two_to(6) * size, "{name} {address:?}: {pairs:?}");
            }
            (tried, uneven) = (tried + 1, uneven + u32::from(!even));
        }
    }
    assert!(tried > 60 && uneven > 15 && worst > 8.0, "{tried} {uneven} {worst}");
}

/// Intervals whose ends lie inside cells, against the integral and the squares of many slopes: off by what a
/// cell at each end varies, far less at four levels deeper.
#[test]
fn intervals_that_end_inside_cells_are_off_by_what_a_cell_varies() {
    let (_, f, value, slope) = smooth().into_iter().find(|(name, ..)| name.contains("g")).unwrap();
    let (x0, x1) = f.domain();
    let (start, length) = (x0.to_num::<f64>(), (x1 - x0).to_num::<f64>());
    let mut worst = [[0.0_f64; 4]; 2];
    for (worst, depth) in worst.iter_mut().zip([5, 9]) {
        let mut memory = vec![Sum::ZERO; Sums::places(f.maps(), depth)];
        let sums = Sums::new(&f, depth, &mut memory).unwrap();
        for k in 0..40 {
            let from = start + length * (0.01 + f64::from(k) * 0.0217);
            let to = from + length * 0.083;
            let n = 4000;
            let places = (0..n).map(|i| from + (to - from) * (f64::from(i) + 0.5) / f64::from(n));
            let pairs: Vec<(f64, f64)> = places.map(|x| (slope.at(x), value.at(x))).collect();
            let mean = |g: &dyn Fn(&(f64, f64)) -> f64| pairs.iter().map(g).sum::<f64>() / f64::from(n);
            let (s, v) = (mean(&|p| p.0), mean(&|p| p.1));
            let rise = (value.at(to) - value.at(from)) / (to - from);
            let exact = [rise, v, mean(&|p| p.0 * p.0) - s * s, mean(&|p| p.0 * p.1) - s * v];
            let found = sums.over(Wide::from_num(from), Wide::from_num(to)).unwrap();
            let found = [found.slope, found.value, found.variance, found.covariance];
            for ((worst, a), b) in worst.iter_mut().zip(found).zip(exact) {
                *worst = worst.max((a.to_num::<f64>() - b).abs());
            }
        }
    }
    let [coarse, fine] = worst;
    assert!(fine.iter().zip(coarse).all(|(fine, coarse)| *fine < coarse / 16.0), "{worst:?}");
    assert!(fine[0] < 1e-4 && fine[1] < 2e-7 && fine[2] < 1e-4 && fine[3] < 1e-5, "{fine:?}");
    assert!(fine.iter().all(|fine| *fine > 1e-9), "{fine:?}");
}

/// A fraction in lowest terms.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Fraction(i128, i128);

impl Fraction {
    fn new(a: i128, b: i128) -> Self {
        let (mut x, mut y) = (a.abs(), b.abs());
        while y != 0 {
            (x, y) = (y, x % y);
        }
        let g = x.max(1) * b.signum();
        Self(a / g, b / g)
    }

    fn plus(self, o: Self) -> Self {
        Self::new(self.0 * o.1 + o.0 * self.1, self.1 * o.1)
    }

    fn times(self, o: Self) -> Self {
        let (a, b) = (Self::new(self.0, o.1), Self::new(o.0, self.1));
        Self::new(a.0 * b.0, a.1 * b.1)
    }

    fn over(self, o: Self) -> Self {
        self.times(Self::new(o.1, o.0))
    }

    fn value(self) -> f64 {
        self.0 as f64 / self.1 as f64
    }
}

/// The variance of the slope by its recurrence in fractions, for the tent with scalings `a` and `b` over 20:
/// `f(L_1 u) = a f + u`, `f(L_2 u) = b f + 1 - u`.
#[test]
fn variances_of_slopes_of_f_and_g_are_exact_fractions() {
    let whole = |n: i128| Fraction::new(n, 1);
    let (twelfth, two) = (Fraction::new(1, 12), whole(2));
    for (scalings, root) in [([17, -17], Fraction::new(100, 333)), ([10, 10], Fraction::new(1, 9))] {
        let s = scalings.map(|a| Fraction::new(a, 20));
        let one_less = |sum: Fraction| whole(1).plus(sum.times(whole(-1)));
        // m = sum a_j (s_j m + 1/2): half of each
        let mean = Fraction::new(1, 2).over(one_less(s[0].plus(s[1]).over(two)));
        // E(f u) = sum 1/2 (s_j E(f (u + j) / 2) + E(q_j (u + j) / 2)), q = u and 1 - u
        let of_q = Fraction::new(1, 12).plus(Fraction::new(1, 6)); // 1/2 (1/6) + 1/2 (1/12 + 1/4)
        let by_m = s[1].times(mean).over(whole(4));
        let with_u = of_q.plus(by_m).over(one_less(s[0].plus(s[1]).over(whole(4))));
        let kappa = with_u.plus(mean.over(whole(-2)));
        // the variance of a part: s^2 v + 2 s d kappa + 1/12, d = 1 and -1; its mean s m + 1/2
        let part = |v: Fraction, j: usize| {
            let d = whole(if j == 0 { 2 } else { -2 });
            s[j].times(s[j]).times(v).plus(s[j].times(d).times(kappa)).plus(twelfth)
        };
        let apart = s[0].plus(s[1].times(whole(-1))).times(mean).over(two);
        let known = part(whole(0), 0).plus(part(whole(0), 1)).over(two).plus(apart.times(apart));
        let squares = s[0].times(s[0]).plus(s[1].times(s[1])).over(two);
        let variance = known.over(one_less(squares));
        assert_eq!(variance, root, "{scalings:?}");
        let knots = [(0, 0), (1, 1), (2, 0)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
        let given = scalings.map(|a| Scaling::from_num(f64::from(a as i32) / 20.0));
        let f = Fif::<2, 2>::interpolating(&knots, &given).unwrap().integral::<2>(Wide::ZERO).unwrap();
        with_moments(&f, 1, |moments| {
            let spreads = moments.spreads();
            // a scaling of 0.85 is given to half a unit of 2^-31
            assert!(units(spreads[0].slope, variance.value()) <= 0.52, "{:?}", spreads[0]);
            for j in 0..2 {
                assert!(units(spreads[j + 1].slope, part(variance, j).value()) <= 0.52, "{spreads:?}");
            }
        })
        .unwrap();
    }
}

/// What of a surface's normal is a fractal function in its own right: functions with the same knots and
/// scalings are closed under addition and multiplication by a number, so that along a line of constant `y`
/// the normal `(-f G(y), -F g(y), 1)` has three components that are fractal functions of `x` with the
/// scalings of `f`, of `F`, and a constant; its mean over an interval is that of the functions.
#[test]
fn along_a_line_each_component_of_the_normal_is_a_fractal_function() {
    let wide = Wide::from_num::<f64>;
    let knots = |ys: [f64; 3]| [0, 1, 2].map(|i| Knot::new(wide([0.0, 0.5, 2.0][i]), wide(ys[i])));
    let scalings = [0.5, -0.625].map(Scaling::from_num);
    let of = |ys: [f64; 3]| Fif::<2, 2>::interpolating(&knots(ys), &scalings).unwrap();
    let (one, two) = ([0.25, 0.75, -0.5], [1.0, -0.25, 0.125]);
    let combined = [0, 1, 2].map(|i| 1.5 * one[i] - 0.75 * two[i]);
    let (f, h, sum) = (of(one), of(two), of(combined));
    let factor = attractor::fif::Factor::<2, 3>::from_slope(&f, wide(0.25)).unwrap();
    let surface = attractor::fif::Surface::new(&factor, &factor);
    let mut worst = 0.0_f64;
    for y in [0.125, 0.8125, 1.75].map(wide) {
        let (value, slope) = (factor.value().at(y), factor.slope().at(y));
        // f with its knots times G(y), and the integral of f with its knots times g(y)
        let times = |v: Real| of(one.map(|y| y * v.to_num::<f64>()));
        let across = times(value);
        let along = times(slope).integral::<3>(wide(0.25 * slope.to_num::<f64>())).unwrap();
        for i in 0..=64 {
            let x = wide(f64::from(i) / 32.0);
            let (p, q) = surface.partials(x, y);
            worst = worst.max(units(p, across.at(x).to_num()).max(units(q, along.at(x).to_num())));
            let both = 1.5 * f.at(x).to_num::<f64>() - 0.75 * h.at(x).to_num::<f64>();
            assert!(units(sum.at(x), both) < 4.0, "{x}");
        }
        // the mean of the normal between two places is that of the functions: by their integrals
        let (from, to) = (wide(0.375), wide(1.5));
        let area = across.integral::<3>(Wide::ZERO).unwrap();
        let mean = (area.at_wide(to) - area.at_wide(from)).to_num::<f64>() / 1.125;
        let normal = surface.mean_normal((from, to), (y, y));
        assert!((normal.x.to_num::<f64>() + mean).abs() < two_to(-20), "{normal:?} {mean}");
    }
    assert!(worst < 8.0 && worst > 0.0, "{worst}");
}

#[test]
fn what_has_no_moments_is_refused() {
    let knots = [(0, 0), (1, 1), (2, 0)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
    let rough = Fif::<2, 2>::interpolating(&knots, &[0.5, -0.5].map(Scaling::from_num)).unwrap();
    assert_eq!(with_moments(&rough, 2, |_| ()), Err(Error::NotDifferentiable { map: 0 }));
    let f = rough.integral::<2>(Wide::ZERO).unwrap();
    let mut cells = [Cell::ZERO; 7];
    let pyramid = Pyramid::new(&f, 2, &mut cells).unwrap();
    let mut short = [Spread::ZERO; 6];
    let error = Moments::new(&f, &pyramid, &mut short).unwrap_err();
    assert!(matches!(error, Error::BufferLength { given: 6, needed: 7, .. }), "{error}");
    let said = "a buffer of 6 spreads of 12 bytes beside the cells of the pyramid lent, 7 needed";
    assert_eq!(error.to_string(), said);
    let other =
        [(0, 0), (1, 0), (2, 0), (3, 0)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
    let other = Fif::<3, 1>::interpolating(&other, &[Scaling::ZERO; 3]).unwrap();
    let error = Moments::new(&other, &pyramid, &mut [Spread::ZERO; 7]).unwrap_err();
    assert!(matches!(error, Error::LengthMismatch { given: 3, expected: 2, .. }), "{error}");
    // nothing of an interval inside the domain, and one that is cut to it
    let mut spreads = [Spread::ZERO; 7];
    let moments = Moments::new(&f, &pyramid, &mut spreads).unwrap();
    let at = Wide::from_num;
    assert_eq!(moments.over(at(-3), at(0)), None);
    assert_eq!(moments.over(at(1), at(1)), None);
    assert_eq!(moments.over(at(5), at(-5)), moments.over(at(0), at(2)));
    assert_eq!(moments.pyramid().depth(), 2);
    assert_eq!(core::mem::size_of::<Spread>(), 12);
    // the same of sums
    let error = Sums::new(&rough, 2, &mut [Sum::ZERO; 5]).unwrap_err();
    assert_eq!(error, Error::NotDifferentiable { map: 0 });
    let error = Sums::new(&f, 2, &mut [Sum::ZERO; 4]).unwrap_err();
    assert!(matches!(error, Error::BufferLength { given: 4, needed: 5, .. }), "{error}");
    assert_eq!(error.to_string(), "a buffer of 4 places of 12 bytes for the running sums lent, 5 needed");
    assert_eq!(core::mem::size_of::<Sum>(), 12);
    let error = Sums::new(&f, 17, &mut []).unwrap_err();
    assert!(matches!(error, Error::Capacity { needed: 17, capacity: 16, .. }), "{error}");
    let mut places = [Sum::ZERO; 5];
    let sums = Sums::new(&f, 2, &mut places).unwrap();
    assert_eq!((sums.over(at(-3), at(0)), sums.over(at(1), at(1))), (None, None));
    assert_eq!(sums.over(at(5), at(-5)), sums.over(at(0), at(2)));
    assert_eq!((Sums::MAX_DEPTH, core::mem::size_of::<Sum>()), (16, 12));
}
