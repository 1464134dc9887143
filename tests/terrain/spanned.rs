//! What spans the cells: heights, slopes and bounds of patches.

use attractor::num::{Real, Unit};
use attractor::terrain::Heights;
use attractor_reference::terrain as reference;

use super::{INNER, ULP, Uniform, grid, knots, real};

/// Heights and slopes by basis functions; bounds hold; neighbours share their edges bit for bit.
#[test]
fn a_patch_is_within_4_units() {
    let mut uniform = Uniform(9);
    for (columns, rows, scale) in [(2, 2, 1.0), (3, 2, 60.0), (6, 5, 3.0)] {
        let given: Vec<Real> =
            knots(columns * rows, 11).iter().map(|h| real(h.to_num::<f64>() * scale)).collect();
        let heights = Heights::new(columns, rows, &given).unwrap();
        let exactly = grid(&heights);
        for (inner, exact) in INNER {
            let (mut worst, mut worst_slope, mut shared) = (0.0_f64, 0.0_f64, 0);
            for _ in 0..2000 {
                let (i, j) = (uniform.below(columns - 1), uniform.below(rows - 1));
                let [s, t] = [(); 2].map(|()| match uniform.below(6) {
                    0 => Unit::ZERO,
                    1 => Unit::ONE,
                    _ => Unit::from_num(uniform.next()),
                });
                let patch = inner.patch(&heights, i, j);
                let (u, v) = (f64::from(i) + s.to_num::<f64>(), f64::from(j) + t.to_num::<f64>());
                let [h, along_u, along_v] = reference::spanned(&exactly, exact, u, v);
                let height = patch.height(s, t);
                worst = worst.max((height.to_num::<f64>() - h).abs() / ULP);
                // at a knot of bilinear patches the slopes are those of the other cell
                if s < Unit::ONE && t < Unit::ONE {
                    for (got, want) in patch.slopes(s, t).into_iter().zip([along_u, along_v]) {
                        worst_slope = worst_slope.max((got.to_num::<f64>() - want).abs() / ULP);
                    }
                }
                let [low, high] = patch.range();
                assert!(low <= height && height <= high, "{inner:?}");
                if i + 2 < columns {
                    let east = inner.patch(&heights, i + 1, j);
                    assert_eq!(patch.height(Unit::ONE, t), east.height(Unit::ZERO, t));
                    shared += 1;
                }
                if j + 2 < rows {
                    let north = inner.patch(&heights, i, j + 1);
                    assert_eq!(patch.height(s, Unit::ONE), north.height(s, Unit::ZERO));
                    shared += 1;
                }
            }
            println!("{columns} x {rows} {inner:?}: {worst:.2} units, slopes {worst_slope:.2}");
            assert!(worst > 0.3 && worst < 4.0 && worst_slope < 16.0, "{worst} {worst_slope}");
            assert!(columns == 2 || shared > 500);
        }
    }
}
