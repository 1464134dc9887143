//! Random curves: the recursive procedures of Carpenter and of the course unit, with the random function as
//! an argument.
//!
//! Source: L. C. Carpenter, "Computer rendering of fractal curves and surfaces", 1980; course unit V, section
//! 5.6, with signs and `factor` put right.

/// What is displaced, and how far at each level.
#[expect(missing_debug_implementations, reason = "it holds functions")]
pub enum Law<'a> {
    /// `h_m = (h_1 + h_2)/2 + amplitude(level) R(t_m)`.
    LineToLine(&'a dyn Fn(u32) -> f64),
    /// `p_m = (p_1 + p_2)/2 + offset(level) R(t_m) perp(p_2 - p_1)`.
    OneVariable(&'a dyn Fn(u32) -> f64),
    /// `p_m = (p_1 + p_2)/2 + o (R_2(t_m) (p_2 - p_1) + R_1(t_m) perp(p_2 - p_1))`.
    TwoVariable(f64, &'a dyn Fn(f64) -> f64),
}

/// The curve from `a` to `b` over the parameters `t`, halved while `goes_on(level, p_1, p_2)`; all its
/// points.
pub fn curve(
    law: &Law<'_>,
    random: &dyn Fn(f64) -> f64,
    goes_on: &dyn Fn(u32, (f64, f64), (f64, f64)) -> bool,
    t: (f64, f64),
    a: (f64, f64),
    b: (f64, f64),
) -> Vec<(f64, f64)> {
    let mut points = vec![a];
    halve(&mut points, law, random, goes_on, 0, t, (a, b));
    points
}

fn halve(
    points: &mut Vec<(f64, f64)>,
    law: &Law<'_>,
    random: &dyn Fn(f64) -> f64,
    goes_on: &dyn Fn(u32, (f64, f64), (f64, f64)) -> bool,
    level: u32,
    (t1, t2): (f64, f64),
    (p1, p2): ((f64, f64), (f64, f64)),
) {
    if !goes_on(level, p1, p2) {
        points.push(p2);
        return;
    }
    let t = (t1 + t2) / 2.0;
    let (dx, dy) = (p2.0 - p1.0, p2.1 - p1.1);
    let (along, across, up) = match law {
        Law::LineToLine(amplitude) => (0.0, 0.0, amplitude(level) * random(t)),
        Law::OneVariable(offset) => (0.0, offset(level) * random(t), 0.0),
        Law::TwoVariable(o, second) => (o * second(t), o * random(t), 0.0),
    };
    let m =
        ((p1.0 + p2.0) / 2.0 + along * dx - across * dy, (p1.1 + p2.1) / 2.0 + along * dy + across * dx + up);
    halve(points, law, random, goes_on, level + 1, (t1, t), (p1, m));
    halve(points, law, random, goes_on, level + 1, (t, t2), (m, p2));
}

/// The deviations `sigma_k` of an elbow whose spectrum falls as `1/f^beta`, from mean squares that are
/// followed level by level: the displacement's is to fall by `2^(1 - beta)`, the length's is a quarter of the
/// one before plus the displacement's.
pub fn elbow_deviations(first: f64, beta: f64, levels: usize) -> Vec<f64> {
    let (mut length, mut displacement) = (1.0, first * first);
    let mut deviations = Vec::new();
    for _ in 0..levels {
        deviations.push(libm::sqrt(displacement / length));
        length = length / 4.0 + displacement;
        displacement *= libm::exp2(1.0 - beta);
    }
    deviations
}
