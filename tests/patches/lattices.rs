//! Refinable lattices, and sheets of cells.

use attractor::Error;
use attractor::num::{Near, Real, Wide};
use attractor::patch::{Address, Mask, Patch, Sheet, Tensor, bezier, takagi};
use attractor_reference::patch::{self as reference, Matrix};

use super::seeded::{Words, cubic, seeded_mask};

/// What a cell of these heights has at the place with these digits and ends, by refined grids and their
/// limits in f64.
fn exact(heights: &[Real; 16], entries: &[[f64; 5]; 5], digits: &[[usize; 2]], ends: [usize; 2]) -> f64 {
    let mut grid: Matrix = (0..4).map(|a| (0..4).map(|b| heights[4 * a + b].to_num()).collect()).collect();
    for [i, j] in digits {
        let finer = reference::refined(&grid, entries);
        grid = (0..4).map(|a| finer[a + i][*j..j + 4].to_vec()).collect();
    }
    let about = (0..3).map(|a| grid[a + ends[0]][ends[1]..ends[1] + 3].to_vec()).collect();
    reference::limit(&about, entries)
}

/// `Mask::height` against grids in f64, that of the cubic mask against the B-spline too: small heights and
/// great ones, which leave no room for more bits.
#[test]
fn a_lattice_is_within_two_units_a_digit() {
    let mut words = Words(19);
    let (mut tried, mut most) = (0, [0.0_f64; 2]);
    while tried < 8 * 2 * 150 {
        let mask = if tried < 300 { Mask::new(cubic()).ok() } else { seeded_mask(&mut words) };
        let Some(mask) = mask else { continue };
        let entries = mask.entries().map(|row| row.map(|w| w.to_num::<f64>()));
        for round in 0..300_u32 {
            let size = [1.0, 20.0][(round % 2) as usize];
            let heights: [Real; 16] =
                std::array::from_fn(|_| Real::from_num(words.between(-1.0, 1.0)) * Real::from_num(size));
            let levels = if round < 200 { 12 } else { round % 8 };
            let index = [0, 1].map(|_| words.next() % ((1 << levels) + 1));
            let ends = index.map(|index| usize::from(index == 1 << levels));
            let digits: Vec<[usize; 2]> = (0..levels)
                .rev()
                .map(|k| [0, 1].map(|axis| if ends[axis] == 1 { 1 } else { index[axis] as usize >> k & 1 }))
                .collect();
            let got = mask.height(&heights, index.map(|index| Address::of(index, levels).unwrap()));
            let mut want = exact(&heights, &entries, &digits, ends);
            if tried < 300 {
                let [s, t] = index.map(|index| f64::from(index) / f64::from(1 << levels));
                let [u, v] = [s, t].map(reference::cubic_b_spline);
                want = (0..16).map(|k| u[k / 4] * v[k % 4] * heights[k].to_num::<f64>()).sum();
            }
            let off = (got.to_num::<f64>() - want).abs() * f64::from(1 << 24) / size;
            assert!(off < 2.0 * f64::from(levels) + 2.0, "{off} of {levels} levels, {size}");
            let most = &mut most[(round % 2) as usize];
            *most = most.max(off);
            tried += 1;
        }
    }
    // 3.2 and 4.3 units: more if what steps take is not given back
    assert!(most[0] > 0.5 && most[0] < 4.0 && most[1] > 0.5 && most[1] < 5.0, "{most:?}");
}

/// One height stays one, to the last bit; both addresses of a place give the same bits.
#[test]
fn a_level_stays_level_and_a_place_has_one_height() {
    let mut words = Words(29);
    let mut tried = 0;
    while tried < 600 {
        let Some(mask) = seeded_mask(&mut words) else { continue };
        for level in ["127.99", "-0.3", "0.0000001"].map(Real::lit) {
            let heights: [Real; 16] = std::array::from_fn(|_| Real::from_num(words.between(-1.0, 1.0)));
            for _ in 0..40 {
                let at = [0, 1].map(|_| Address::<2>::of(words.next() % 512 * 2 + 1, 10).unwrap());
                assert_eq!(mask.height(&[level; 16], at), level);
                let others = at.map(|address| address.other().unwrap());
                let height = mask.height(&heights, at);
                for other in [[at[0], others[1]], [others[0], at[1]], others] {
                    assert_eq!(mask.height(&heights, other), height);
                }
                tried += 1;
            }
        }
    }
}

#[test]
fn a_mask_of_numbers_is_that_of_its_entries_and_a_wrong_one_is_refused() {
    let entries = cubic();
    let numbers: Vec<Near> = (0..25)
        .filter(|k| !((1..3).contains(&(k / 5)) && (1..3).contains(&(k % 5))))
        .map(|k| entries[k / 5][k % 5])
        .collect();
    let numbers: [Near; 21] = numbers.try_into().unwrap();
    assert_eq!(Mask::from_numbers(&numbers).unwrap(), Mask::new(entries).unwrap());
    for class in 0..4_usize {
        let mut wrong = entries;
        wrong[4 - (class >> 1)][4 - (class & 1)] += Near::lit("0.25");
        let refused = Error::NotBarycentric { column: class, sum: Wide::lit("1.25") };
        assert_eq!(Mask::new(wrong).unwrap_err(), refused);
    }
    // a mask that spreads: 9 entries of alternating sign
    let mut wild = entries;
    wild[0][0] += Near::lit("2");
    wild[4][4] += Near::lit("2");
    wild[2][2] -= Near::lit("4");
    assert!(matches!(
        Mask::new(wild),
        Err(Error::OutOfRange { what: "entry of a mask", index: Some(0), .. })
    ));
    wild[0][0] -= Near::lit("0.5");
    wild[4][4] -= Near::lit("0.5");
    wild[2][2] += Near::lit("1");
    wild[0][4] -= Near::lit("1");
    wild[2][2] += Near::lit("1");
    assert_eq!(Mask::new(wild).unwrap_err(), Error::NotContractive { map: 0 });
}

/// A sheet is its cells, seen from either side of what they have in common.
#[test]
fn a_sheet_is_its_cells() {
    let mut words = Words(23);
    let mask = loop {
        if let Some(mask) = seeded_mask(&mut words) {
            break mask;
        }
    };
    assert_eq!(Sheet::<Mask, 16>::heights(5), 64);
    let heights: Vec<Real> = (0..64).map(|_| Real::from_num(words.between(-1.0, 1.0))).collect();
    let sheet = Sheet::new(&mask, &heights, 5).unwrap();
    assert_eq!((sheet.cells(), sheet.contraction()), (5, mask.contraction()));
    let mut seams = 0;
    for i in 0..=20_u32 {
        for j in 0..=20_u32 {
            let height = sheet.at([i, j], 2);
            // every cell that has the place
            for ci in 0..5_u32 {
                for cj in 0..5_u32 {
                    if (4 * ci..=4 * ci + 4).contains(&i) && (4 * cj..=4 * cj + 4).contains(&j) {
                        let of: [Real; 16] =
                            std::array::from_fn(|k| heights[(ci as usize + k / 4) * 8 + cj as usize + k % 4]);
                        let at = [i - 4 * ci, j - 4 * cj].map(|index| Address::of(index, 2).unwrap());
                        let own = mask.height(&of, at);
                        // the same weights by other maps: to within their rounding
                        assert!((own - height).abs() <= Real::DELTA * 2, "{own} {height}");
                        seams += 1;
                    }
                }
            }
        }
    }
    assert!(seams > 500);
    // the mean normal of a plane
    let slope: Vec<Real> = (0..64).map(|k| Real::from_num(k / 8) / 8).collect();
    let plane = Sheet::new(&mask, &slope, 5).unwrap();
    let normal = plane.mean_normal([1, 2], 0);
    assert!(normal.y.abs() < 1e-5 && normal.z == 1, "{normal:?}");
    let mut twist = heights;
    twist[7] = Real::lit("100");
    assert!(matches!(
        Sheet::new(&mask, &twist, 5),
        Err(Error::OutOfRange { what: "height", index: Some(7), .. })
    ));
    assert!(matches!(
        Sheet::new(&mask, &twist, 4),
        Err(Error::LengthMismatch { expected: 49, given: 64, .. })
    ));
    assert!(matches!(Sheet::new(&mask, &twist, 0), Err(Error::OutOfRange { .. })));
}

/// `Sheet::normal`: that of a product of parabolas everywhere, by its derivatives; at no joint of a product
/// of Takagi's curves; on a roof of flat pieces beside its ridges, not on them.
#[test]
fn there_is_a_normal_where_a_plane_touches() {
    let tolerance = Real::lit("0.02");
    let heights: [Real; 9] = ["0.1", "0.4", "-0.2", "0.3", "0.9", "0", "-0.1", "0.5", "0.2"].map(Real::lit);
    let parabola = bezier::<3>().unwrap();
    let product = Tensor::<2, 3, 3, 9>::new(parabola, parabola).unwrap();
    let smooth = Sheet::new(&product, &heights, 1).unwrap();
    let slopes = |s: f64| [2.0 * s - 2.0, 2.0 - 4.0 * s, 2.0 * s];
    let mut most = 0.0_f64;
    for (i, j) in (0..=16).flat_map(|i| (0..=16).map(move |j| (i, j))) {
        let [s, t] = [i, j].map(|index| f64::from(index) / 16.0);
        let sum = |a: [f64; 3], b: [f64; 3]| -> f64 {
            (0..9).map(|k| a[k / 3] * b[k % 3] * heights[k].to_num::<f64>()).sum()
        };
        let [p, q] = [s, t].map(|s| <[f64; 3]>::try_from(reference::bernstein(2, s)).unwrap());
        let want = [-sum(slopes(s), q), -sum(p, slopes(t))];
        let normal = smooth.normal([i, j], 4, tolerance).unwrap();
        for (got, want) in [normal.x, normal.y].iter().zip(want) {
            most = most.max((got.to_num::<f64>() - want).abs());
        }
        assert_eq!(normal.z, Real::ONE);
    }
    assert!(most < 0.004 && most > 1e-5, "{most}");
    let takagi = takagi().unwrap();
    let rough = Tensor::<2, 3, 3, 9>::new(takagi, takagi).unwrap();
    let rough = Sheet::new(&rough, &heights, 1).unwrap();
    assert!((1..16).all(|k| rough.normal([k, 16 - k], 4, tolerance).is_none()));
    // halves: a roof over the middle control point, bilinear between them
    let halves =
        |k: usize| [[1.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.0, 1.0, 0.0], [0.0, 0.5, 0.5], [0.0, 0.0, 1.0]][k];
    let grid: Vec<[Near; 9]> = (0..25)
        .map(|k| std::array::from_fn(|c| Near::from_num(halves(k / 5)[c / 3] * halves(k % 5)[c % 3])))
        .collect();
    let roof = Patch::<2, 3, 9>::from_grid(&grid).unwrap();
    let mut heights = [Real::ZERO; 9];
    (heights[1], heights[4], heights[7]) = (Real::ONE, Real::ONE, Real::ONE);
    let roof = Sheet::new(&roof, &heights, 1).unwrap();
    for i in 0..=8 {
        for j in 0..=8 {
            let normal = roof.normal([i, j], 3, tolerance);
            assert_eq!(normal.is_some(), j != 4, "{i} {j}");
            let down = if j < 4 { -2 } else { 2 };
            assert!(
                normal.is_none_or(|normal| (normal.y - Real::from_num(down)).abs() < 0.01 && normal.x == 0)
            );
        }
    }
    assert_eq!([smooth.normal([17, 0], 4, tolerance), smooth.normal([0, 0], 13, tolerance)], [None; 2]);
}
