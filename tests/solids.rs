//! Shapes of an outsider, by core's public interface alone.

use std::ops::ControlFlow;

use attractor::num::{Affine3, Angle, Near, Real, Unit, Vec3, sin_cos};
use attractor::trace::solid::{Function, Implicit, Placed};
use attractor::trace::{Ray, Surface};

use attractor_tests::accuracy::words;

/// Schoen's gyroid, thickened to a wall and cut out of a ball: `|g| < 1/4` where
/// `g = sin x cos y + sin y cos z + sin z cos x`, a turn a unit.
struct GyroidBall;

impl Function for GyroidBall {
    fn value(&self, p: Vec3<Near>) -> Near {
        let turned = |c: Near| {
            let (sin, cos) = sin_cos(Angle::from_bits((c.to_bits() << 4) as u32));
            (Near::from_num(sin), Near::from_num(cos))
        };
        let [x, y, z] = [p.x, p.y, p.z].map(turned);
        let gyroid = x.0 * y.1 + y.0 * z.1 + z.0 * x.1;
        let ball = (p.x * p.x + p.y * p.y + p.z * p.z - Near::ONE) / 2;
        ((gyroid.abs() - Near::lit("0.25")) / 8).max(ball)
    }
}

fn exact(p: [f64; 3]) -> f64 {
    let [x, y, z] = p.map(|c| (c * std::f64::consts::TAU).sin_cos());
    let gyroid = x.0 * y.1 + y.0 * z.1 + z.0 * x.1;
    ((gyroid.abs() - 0.25) / 8.0).max((p.iter().map(|c| c * c).sum::<f64>() - 1.0) / 2.0)
}

/// The gradient of the wall is below `2 pi sqrt(3) / 8`, that of the ball below the length of the box's
/// diagonal.
#[test]
fn a_gyroid_ball_is_met_where_its_function_changes_sign() {
    let one = Near::ONE;
    let bounds = [Vec3::new(-one, -one, -one), Vec3::new(one, one, one)];
    let ball = Implicit::new(GyroidBall, bounds, Real::lit("1.75")).unwrap();
    let ball = Placed::new(ball, &Affine3::translate(Vec3::new(Real::ONE, Real::ZERO, Real::ZERO))).unwrap();
    let eye = Vec3::lit("-2", "0.5", "1");
    let mut random = words(10);
    let mut next = || (random.next().unwrap() >> 40) as f64 / 2_f64.powi(23) - 1.0;
    let (mut met, mut sampled, mut skipped, mut worst) = (0, 0, 0, 0.0_f64);
    for _ in 0..300 {
        let to = [1.0 + next(), next(), next()];
        // exact in every format
        let d = [to[0] + 2.0, to[1] - 0.5, to[2] - 1.0].map(|c| (c * 4096.0).round() / 16384.0);
        let [x, y, z] = d.map(Real::from_num);
        let ray = Ray::new(eye, Vec3::new(x, y, z));
        let mut crossings = Vec::new();
        ball.cross(&ray, Unit::ZERO, &mut |crossing| {
            crossings.push((crossing.t.to_num::<f64>(), crossing.enters));
            ControlFlow::Continue(())
        });
        let at = |t: f64| exact([-2.0 + t * d[0] - 1.0, 0.5 + t * d[1], 1.0 + t * d[2]]);
        assert!(crossings.len().is_multiple_of(2) && crossings.len() <= 16);
        assert!(crossings.iter().enumerate().all(|(k, c)| c.1 == (k % 2 == 0)));
        for (t, _) in &crossings {
            worst = worst.max(at(*t).abs());
        }
        met += crossings.len();
        // every place is on the side that the crossings before it say; thin parts may be missing
        for k in 0..1024 {
            let t = f64::from(k) / 64.0;
            let inside = crossings.iter().filter(|c| c.0 < t).count() % 2 == 1;
            let sure = [-1.0, 0.0, 1.0].iter().all(|s| (at(t + s / 64.0) < 0.0) == (at(t) < 0.0));
            if sure && crossings.len() < 16 {
                assert_eq!(inside, at(t) < 0.0, "{d:?} {t}: {crossings:?}");
                sampled += 1;
            } else {
                skipped += 1;
            }
        }
    }
    assert!(met > 800 && sampled > 250_000 && skipped < sampled / 8, "{met} {sampled} {skipped}");
    assert!(worst > 1e-9 && worst < 1e-6, "{worst:e}");
}
