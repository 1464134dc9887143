//! The table of promises: every kernel with its format, the inputs tried, the errors found and the bound that
//! it states.
//!
//! Inputs come from four generators: a hand list, edge cases, a seeded random sequence, evenly spaced values.

mod texture;

use attractor::fif::{Cell, Fif, Knot, Pyramid};
use attractor::num::{self, Angle, Real, Scaling, Unit, Vec3, Wide};
use attractor::trace::{Environment, Finish, HeightField, Light, Ray};
use attractor_reference as reference;

/// One line of the table.
#[derive(Debug, Clone)]
pub struct Row {
    /// What was evaluated.
    pub kernel: &'static str,
    /// The format of its result.
    pub format: &'static str,
    /// How many inputs were tried.
    pub inputs: usize,
    /// The largest error.
    pub max_error: f64,
    /// The root of the mean square error.
    pub rms: f64,
    /// The bound promised in the documentation.
    pub bound: f64,
}

impl Row {
    /// Whether something was measured and it kept the promise.
    pub fn holds(&self) -> bool {
        self.inputs > 0 && self.max_error > 0.0 && self.max_error <= self.bound
    }
}

/// The whole table, measured now.
pub fn table() -> Vec<Row> {
    let mut rows = numbers();
    rows.extend(functions());
    rows.extend(surfaces());
    rows.extend(shading());
    rows.extend(moments());
    rows.extend(texture::rows());
    rows
}

fn row(kernel: &'static str, format: &'static str, bound: f64, errors: impl IntoIterator<Item = f64>) -> Row {
    let (mut inputs, mut max_error, mut squares) = (0, 0.0_f64, 0.0);
    for e in errors {
        inputs += 1;
        max_error = max_error.max(e.abs());
        squares += e * e;
    }
    Row { kernel, format, inputs, max_error, rms: (squares / f64::from(inputs.max(1) as u32)).sqrt(), bound }
}

/// `2^k`.
pub fn two_to(k: i32) -> f64 {
    f64::from(k).exp2()
}

/// A seeded sequence of words (SplitMix64, Steele, Lea, Flood 2014).
pub fn words(seed: u64) -> impl Iterator<Item = u64> {
    let mut state = seed;
    std::iter::repeat_with(move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    })
}

/// Edges, random and evenly spaced 32-bit words.
fn patterns() -> Vec<u32> {
    let edges = (0..32).flat_map(|k| [(1_u32 << k).wrapping_sub(1), 1 << k, (1 << k) + 1]);
    let random = words(1).take(20_000).map(|w| w as u32);
    let even = (0..20_000_u32).map(|i| i * 214_748);
    edges.chain([u32::MAX, u32::MAX - 1]).chain(random).chain(even).collect()
}

fn numbers() -> Vec<Row> {
    let words = patterns();
    let positive = || words.iter().copied().filter(|w| *w > 0);
    let turns = |w: u32| f64::from(w) / two_to(32) * std::f64::consts::TAU;
    vec![
        row(
            "num::reciprocal",
            "31 bits",
            two_to(-29),
            positive().map(|d| {
                let (m, s) = num::reciprocal(d);
                f64::from(m) / two_to(s as i32) * f64::from(d) - 1.0
            }),
        ),
        row(
            "num::reciprocal_sqrt",
            "31 bits",
            two_to(-29),
            positive().map(|w| {
                let v = u64::from(w) * u64::from(w >> 3 | 1);
                let (m, s) = num::reciprocal_sqrt(v);
                f64::from(m) / two_to(s as i32) * (v as f64).sqrt() - 1.0
            }),
        ),
        row(
            "num::sin_cos",
            "I2F30",
            two_to(-28),
            words.iter().flat_map(|w| {
                let (s, c) = num::sin_cos(Angle::from_bits(*w));
                [s.to_num::<f64>() - turns(*w).sin(), c.to_num::<f64>() - turns(*w).cos()]
            }),
        ),
        row(
            "num::exp_minus",
            "I2F30",
            two_to(-29),
            words.iter().map(|w| {
                let x = Real::from_bits((*w >> 1) as i32);
                num::exp_minus(x).to_num::<f64>() - (-x.to_num::<f64>()).exp()
            }),
        ),
    ]
}

/// A function of the papers or like them, fixed and exact.
#[derive(Debug)]
pub struct Example {
    /// What it is.
    pub name: &'static str,
    /// The abscissae and ordinates.
    pub knots: Vec<(f64, f64)>,
    /// The vertical scalings.
    pub scaling: Vec<f64>,
    /// How often it is integrated from 0.
    pub integrate: u32,
}

impl Example {
    fn new(name: &'static str, knots: &[(f64, f64)], scaling: &[f64], integrate: u32) -> Self {
        Self { name, knots: knots.to_vec(), scaling: scaling.to_vec(), integrate }
    }

    /// The fixed-point function.
    pub fn fixed(&self) -> Fif<16, 4> {
        let knots: Vec<_> =
            self.knots.iter().map(|(x, y)| Knot::new(Wide::from_num(*x), Wide::from_num(*y))).collect();
        let scaling: Vec<_> = self.scaling.iter().map(|a| nearest(*a)).collect();
        let mut f = Fif::interpolating(&knots, &scaling).expect(self.name);
        for _ in 0..self.integrate {
            f = f.integral(Wide::ZERO).expect(self.name);
        }
        f
    }

    /// The reference.
    pub fn exact(&self) -> reference::Fif {
        let mut f = reference::Fif::interpolating(&self.knots, &self.scaling);
        for _ in 0..self.integrate {
            f = f.integral(0.0);
        }
        f
    }
}

/// The nearest scaling: `from_num` truncates.
pub fn nearest(alpha: f64) -> Scaling {
    Scaling::from_bits((alpha * two_to(31)).round().min(two_to(31) - 1.0) as i32)
}

/// Functions on dyadic partitions.
pub fn dyadic_examples() -> Vec<Example> {
    let tent = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)];
    let four = [(0.0, 0.3), (0.25, -0.7), (0.5, 1.1), (0.75, 0.2), (1.0, -0.4)];
    vec![
        Example::new("f of figure 1", &tent, &[0.5, 0.5], 0),
        Example::new("g of figure 1", &tent, &[0.85, -0.85], 0),
        Example::new("integral of f", &tent, &[0.5, 0.5], 1),
        Example::new("integral of g", &tent, &[0.85, -0.85], 1),
        Example::new("second integral of g", &tent, &[0.85, -0.85], 2),
        Example::new("four maps", &four, &[0.7, -0.3, 0.55, 0.1], 0),
        Example::new("steep", &tent, &[0.99, -0.99], 0),
        Example::new("large", &[(-8.0, -31.25), (0.0, 40.1), (8.0, 22.7)], &[0.3, 0.37], 0),
        Example::new("three wide", &[(-1.0, 0.2), (0.5, 0.9), (2.0, -0.3)], &[0.9, -0.8], 0),
        Example::new("two straight maps", &[(0.0, 0.1), (0.5, 0.7), (1.0, 1.3)], &[0.0, 0.0], 0),
    ]
}

/// Functions whose partition is not dyadic.
pub fn other_examples() -> Vec<Example> {
    vec![
        Example::new("thirds", &[(0.0, 0.0), (1.0, 0.6), (2.0, -0.3), (3.0, 0.5)], &[0.4, -0.6, 0.3], 0),
        Example::new("uneven", &[(0.0, 0.0), (0.1, 0.5), (0.3, 0.2), (1.0, 1.0)], &[0.3, 0.8, -0.5], 0),
        Example::new(
            "years",
            &[(1700.0, 0.05), (1800.0, 1.1), (1917.0, 0.4), (2008.0, 0.03)],
            &[0.2, -0.35, 0.5],
            0,
        ),
        Example::new(
            "integral of uneven",
            &[(0.0, 0.0), (0.1, 0.5), (0.3, 0.2), (1.0, 1.0)],
            &[0.3, 0.8, -0.5],
            1,
        ),
    ]
}

/// Dyadic places of the unit interval: coarse, fine, random with up to 44 digits, and the ends.
fn places() -> impl Iterator<Item = f64> {
    let grid = (0..=4096).map(|i| f64::from(i) / 4096.0);
    let random = words(2).take(4_000).map(|w| ((w >> (20 + w % 40)) as f64) / two_to(44 - (w % 40) as i32));
    let edges = (1..44).flat_map(|k| [two_to(-k), 1.0 - two_to(-k)]);
    grid.chain(random).chain(edges)
}

fn functions() -> Vec<Row> {
    let mut rows = Vec::new();
    for example in dyadic_examples() {
        let (fixed, exact) = (example.fixed(), example.exact());
        let (x0, xn) = (example.knots[0].0, example.knots[example.knots.len() - 1].0);
        let steepest = exact.max_scaling();
        // the promise, or the function's own where that is tighter
        let promised = (1.0 / (1.0 - steepest) + 1.0) * two_to(-24);
        let bound = promised.min(fixed.error_bound().to_num());
        let at = |u: f64| x0 + u * (xn - x0);
        let name: &'static str = Box::leak(format!("Fif::at ({})", example.name).into_boxed_str());
        rows.push(row(
            name,
            "I8F24",
            bound,
            places().map(|u| fixed.at(Wide::from_num(at(u))).to_num::<f64>() - exact.at(at(u))),
        ));
        if let Some(fast) = fixed.dyadic::<16>() {
            let name: &'static str = Box::leak(format!("Dyadic::at ({})", example.name).into_boxed_str());
            rows.push(row(
                name,
                "I8F24",
                fast.error_bound().to_num(),
                places().filter(|u| *u < 1.0).map(|u| {
                    let bits = (u * two_to(32)) as u32;
                    fast.at(Angle::from_bits(bits)).to_num::<f64>()
                        - exact.at(at(f64::from(bits) / two_to(32)))
                }),
            ));
        }
    }
    for example in dyadic_examples() {
        let (fast, exact) = (example.fixed().compiled().expect(example.name), example.exact());
        let (x0, xn) = (example.knots[0].0, example.knots[example.knots.len() - 1].0);
        let name: &'static str = Box::leak(format!("Compiled::at ({})", example.name).into_boxed_str());
        let off = |u: f64| {
            let bits = (u * two_to(32)) as u32;
            let x = x0 + f64::from(bits) / two_to(32) * (xn - x0);
            fast.at(Angle::from_bits(bits)).to_num::<f64>() - exact.at(x)
        };
        let bound = fast.error_bound().to_num();
        rows.push(row(name, "I8F24", bound, places().filter(|u| *u < 1.0).map(off)));
    }
    let rough = &dyadic_examples()[1];
    let (fixed, exact) = (rough.fixed(), rough.exact());
    rows.push(row(
        "Fif::at_wide (g of figure 1)",
        "I16F48",
        fixed.error_bound().to_num::<f64>() - two_to(-25),
        places().map(|u| fixed.at_wide(Wide::from_num(2.0 * u)).to_num::<f64>() - exact.at(2.0 * u)),
    ));
    // composition ends at another abscissa than x: compare a function that is smooth enough for the
    // difference not to show
    let smooth = &dyadic_examples()[3];
    let (fixed, exact) = (smooth.fixed(), smooth.exact());
    rows.push(row(
        "Fif::at_by_composition (integral of g)",
        "I8F24",
        fixed.error_bound().to_num::<f64>() + 4.0 * two_to(-23),
        places().map(|u| {
            fixed.at_by_composition(Wide::from_num(2.0 * u), Real::DELTA).to_num::<f64>() - exact.at(2.0 * u)
        }),
    ));
    rows.push(row("Fif::integral (second integral of g)", "I16F48", two_to(-24), {
        let twice = &dyadic_examples()[4];
        let (fixed, exact) = (twice.fixed(), twice.exact());
        places().map(move |u| fixed.at_wide(Wide::from_num(2.0 * u)).to_num::<f64>() - exact.at(2.0 * u))
    }));
    rows
}

fn surfaces() -> Vec<Row> {
    let mut rows = Vec::new();
    let tent = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)];
    let slope = |a: [f64; 2]| Example::new("slope", &tent, &a, 0);
    let (f, g) = (slope([0.5, 0.5]), slope([0.85, -0.85]));
    let factor =
        |e: &Example| attractor::fif::Factor::<16, 4>::from_slope(&e.fixed(), Wide::ZERO).expect("a factor");
    let (ff, gg) = (factor(&f), factor(&g));
    let exact = |e: &Example| reference::Factor::from_slope(e.exact(), 0.0);
    let (fe, ge) = (exact(&f), exact(&g));
    let surface = attractor::fif::Surface::new(&ff, &gg);
    let truth = reference::Surface { x: fe, y: ge };
    let grid = || (0..=64).flat_map(|i| (0..=64).map(move |j| (f64::from(i) / 32.0, f64::from(j) / 32.0)));
    let random = || {
        let mut w = words(3);
        let mut next = move || (w.next().unwrap_or(0) >> 24) as f64 / two_to(39);
        (0..4000).map(move |_| (next(), next())).collect::<Vec<_>>()
    };
    let points = || grid().chain(random());
    let wide = |v: f64| Wide::from_num(v);
    rows.push(row(
        "Surface::height (f x g)",
        "I8F24",
        two_to(-22),
        points().map(|(x, y)| surface.height(wide(x), wide(y)).to_num::<f64>() - truth.height(x, y)),
    ));
    rows.push(row(
        "Surface::partials (f x g)",
        "I8F24",
        two_to(-18),
        points().flat_map(|(x, y)| {
            let (p, t) = (surface.partials(wide(x), wide(y)), truth.partials(x, y));
            [p.0.to_num::<f64>() - t.0, p.1.to_num::<f64>() - t.1]
        }),
    ));
    rows.push(row(
        "Surface::normal (f x g)",
        "I8F24",
        two_to(-18),
        points().flat_map(|(x, y)| {
            let (n, t) = (surface.normal(wide(x), wide(y)), truth.normal(x, y));
            [n.x.to_num::<f64>() - t[0], n.y.to_num::<f64>() - t[1]]
        }),
    ));
    rows.push(row(
        "Surface::mean_normal (f x g)",
        "I8F24",
        two_to(-18),
        random()
            .chunks(2)
            .flat_map(|c| {
                let (x0, x1) = (c[0].0.min(c[1].0), c[0].0.max(c[1].0));
                let (y0, y1) = (c[0].1.min(c[1].1), c[0].1.max(c[1].1));
                let n = surface.mean_normal((wide(x0), wide(x1)), (wide(y0), wide(y1)));
                let t = truth.mean_normal(x0, x1, y0, y1);
                [n.x.to_num::<f64>() - t[0], n.y.to_num::<f64>() - t[1]]
            })
            .collect::<Vec<_>>(),
    ));
    for (e, mean_name, slope_name) in [
        (&dyadic_examples()[3], "Cell::mean (integral of g)", "Cell::slope (integral of g)"),
        (&other_examples()[3], "Cell::mean (integral of uneven)", "Cell::slope (integral of uneven)"),
    ] {
        let depth = if e.knots.len() == 3 { 8 } else { 5 };
        let fixed = e.fixed();
        let mut memory = vec![Cell::ZERO; Pyramid::cells(fixed.maps(), depth)];
        let pyramid = Pyramid::new(&fixed, depth, &mut memory).expect("a pyramid");
        let bounds = reference::Bounds::new(&e.exact(), depth as usize);
        let pairs = |pick: fn(&Cell) -> Real, exact: fn(&reference::Cell) -> f64| {
            (0..=depth)
                .flat_map(|k| {
                    let (cells, truth) = (pyramid.level(k), &bounds.levels[k as usize]);
                    assert_eq!(cells.len(), truth.len());
                    cells
                        .iter()
                        .zip(truth)
                        .map(|(c, t)| pick(c).to_num::<f64>() - exact(t))
                        .collect::<Vec<_>>()
                })
                .collect::<Vec<_>>()
        };
        let a = e.exact().max_scaling();
        rows.push(row(mean_name, "I8F24", two_to(-23) / (1.0 - a), pairs(|c| c.mean, |c| c.mean)));
        let ratio = e
            .exact()
            .maps
            .iter()
            .zip(e.knots.windows(2))
            .map(|(m, k)| {
                m.vertical_scaling.abs() * (e.knots[e.knots.len() - 1].0 - e.knots[0].0) / (k[1].0 - k[0].0)
            })
            .fold(0.0, f64::max);
        rows.push(row(slope_name, "I8F24", two_to(-23) / (1.0 - ratio), pairs(|c| c.slope, |c| c.slope)));
    }
    rows
}

fn shading() -> Vec<Row> {
    let mut w = words(5);
    let mut component = move || Real::from_bits((w.next().unwrap_or(0) as i32) >> 5); // inside ±4
    let mut vectors =
        |n: usize| (0..n).map(|_| Vec3::new(component(), component(), component())).collect::<Vec<_>>();
    let float = |v: Vec3<Unit>| [v.x, v.y, v.z].map(|c| c.to_num::<f64>());
    let given = vectors(20_000);
    let units: Vec<Vec3<Unit>> = given.iter().filter_map(|v| v.normalised()).collect();
    let mut rows = vec![row(
        "Vec3::normalised",
        "I2F30",
        two_to(-27),
        given.iter().zip(&units).flat_map(|(v, u)| {
            let v = [v.x, v.y, v.z].map(|c| c.to_num::<f64>());
            let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
            let u = float(*u);
            (0..3).map(move |i| u[i] - v[i] / length)
        }),
    )];
    let sky = Environment::SKY;
    let exact_sky = reference::Environment::Gradient { zenith: 1.0, horizon: 0.5, nadir: 0.125 };
    rows.push(row(
        "Environment::tone (gradient)",
        "I2F30",
        two_to(-29),
        units.iter().map(|e| sky.tone(*e).to_num::<f64>() - exact_sky.tone(float(*e))),
    ));
    // a highlight without anything beside it is the hardest case
    let phong = reference::Finish::Phong { ambient: 0.0, diffuse: 0.0, specular: 1.0, shininess: 64.0 };
    let matt = reference::Finish::Diffuse { ambient: 0.125 };
    let shiny =
        Finish::Phong { ambient: Unit::ZERO, diffuse: Unit::ZERO, specular: Unit::ONE, shininess: 64 };
    let (roughness, reflectance) = (0.25, 0.75);
    let sheen = reference::Finish::TorranceSparrow {
        ambient: 0.0,
        diffuse: 0.0,
        specular: 1.0,
        roughness,
        reflectance,
    };
    let rough = Finish::TorranceSparrow {
        ambient: Unit::ZERO,
        diffuse: Unit::ZERO,
        specular: Unit::ONE,
        roughness: Unit::from_num(roughness),
        reflectance: Unit::from_num(reflectance),
    };
    for (name, bound, fixed, exact) in [
        ("Finish::tone (diffuse)", two_to(-27), Finish::DIFFUSE, matt),
        ("Finish::tone (Phong, exponent 64)", two_to(-22), shiny, phong),
        ("Finish::tone (Torrance-Sparrow)", two_to(-12), rough, sheen),
    ] {
        rows.push(row(
            name,
            "I2F30",
            bound,
            units.chunks(2).zip(&given).filter(|(c, _)| c.len() == 2).map(|(c, towards)| {
                let light = Light::new(*towards).expect("a direction");
                let towards = [towards.x, towards.y, towards.z].map(|c| c.to_num::<f64>());
                let (n, d) = (float(c[0]), float(c[1]));
                // the definition turns a normal that points away round
                let along: f64 = (0..3).map(|i| n[i] * d[i]).sum();
                let facing = if along > 0.0 { n.map(|c| -c) } else { n };
                fixed.tone(c[0], c[1], &light, &sky).to_num::<f64>()
                    - exact.tone(facing, d, towards, &exact_sky)
            }),
        ));
    }
    rows.push(hits());
    rows
}

/// The depth of hits times the least component of the direction, where the leaf is the reference's; fewer
/// than one in 500 may be another one.
fn hits() -> Row {
    let e = &dyadic_examples()[3];
    let fixed = e.fixed();
    let mut memory = vec![Cell::ZERO; Pyramid::cells(2, 7)];
    let pyramid = Pyramid::new(&fixed, 7, &mut memory).expect("a pyramid");
    let surface = HeightField::new(&pyramid, &pyramid).expect("a surface");
    let bounds = reference::Bounds::new(&e.exact(), 7);
    let mut w = words(6);
    let mut number = move |bits: u32| Real::from_bits((w.next().unwrap_or(0) >> (64 - bits)) as i32);
    let (mut met, mut other, mut errors) = (0, 0, Vec::new());
    for _ in 0..4000 {
        let from = Vec3::new(
            number(27) - Real::from_num(3),
            number(27) - Real::from_num(3),
            number(26) + Real::from_num(1),
        );
        let to = Vec3::new(number(25), number(25), number(23));
        let direction = to.minus(from);
        let direction = Vec3::new(direction.x >> 2, direction.y >> 2, direction.z >> 2);
        let float = |v: Vec3| [v.x, v.y, v.z].map(|c| c.to_num::<f64>());
        let ray = reference::Ray { origin: float(from), direction: float(direction) };
        let exact = reference::trace(&bounds, &bounds, &ray, 0.0).hit;
        let hit = surface.intersect(&Ray::new(from, direction), Unit::ZERO);
        match (hit, exact) {
            (Some(a), Some(b)) if a.index == (b.i as u32, b.j as u32) => {
                met += 1;
                let least = ray.direction.iter().fold(f64::MAX, |least, c| least.min(c.abs()));
                errors.push((a.t.to_num::<f64>() - b.t) * least);
            }
            (None, None) => {}
            _ => other += 1,
        }
    }
    assert!(met > 1000 && other * 500 <= met, "{met} leaves agree, {other} differ");
    row("HeightField::intersect (depth)", "I8F24", two_to(-21), errors)
}

/// The exact moments of an attractor's measure by the reference, for the numbers that the kernel has,
/// rounding of the tables included.
pub fn exact_moments<const N: usize>(ifs: &attractor::ifs::Ifs<N>) -> reference::Moments {
    let maps: Vec<_> = ifs
        .maps()
        .iter()
        .map(|m| {
            let [a, b, c, d] = [m.a, m.b, m.c, m.d].map(|l| l.to_num::<f64>());
            reference::Affine { a, b, c, d, e: m.e.to_num(), f: m.f.to_num() }
        })
        .collect();
    let shares: Vec<f64> = ifs.probabilities().iter().map(|p| p.to_num()).collect();
    let sum: f64 = shares.iter().sum();
    reference::moments(&maps, &shares.iter().map(|p| p / sum).collect::<Vec<_>>())
}

fn moments() -> Vec<Row> {
    let (mut means, mut covariances) = (Vec::new(), Vec::new());
    for attractor in attractor::ifs::catalogue::ALL {
        let ifs = attractor.ifs::<{ attractor::ifs::catalogue::LARGEST }>().expect(attractor.name);
        let got = ifs.moments().expect(attractor.name);
        let want = exact_moments(&ifs);
        let pairs = |got: &[Wide], want: &[f64]| -> Vec<f64> {
            got.iter().zip(want).map(|(g, w)| g.to_num::<f64>() - w).collect()
        };
        means.extend(pairs(&got.mean, &[want.mean.0, want.mean.1]));
        let (xx, xy, yy) = want.covariance;
        covariances.extend(pairs(&got.covariance, &[xx, xy, yy]));
    }
    vec![
        row("Ifs::moments (mean)", "I16F48", two_to(-46), means),
        row("Ifs::moments (covariance)", "I16F48", two_to(-40), covariances),
    ]
}
