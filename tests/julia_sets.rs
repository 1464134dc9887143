//! Covers of Julia sets beside the points of backward orbits.

use attractor::escape::{JuliaCover, JuliaSet, View};
use attractor::num::Complex;
use attractor::num::Wide;
use attractor::plane::Field;
use attractor_reference::julia_points;
use embedded_graphics::geometry::Size;

/// The rotation by the golden mean.
const SIEGEL: (f64, f64) = (-0.390_54, -0.586_79);
/// Parabolic, with an inside, a Siegel disc, dendrites, a segment, dust.
const CONSTANTS: [(f64, f64); 12] = [
    (0.25, 0.0),
    (-0.75, 0.0),
    (-1.25, 0.0),
    (0.0, 0.0),
    (-1.0, 0.0),
    (-0.123, 0.745),
    SIEGEL,
    (0.0, 1.0),
    (-2.0, 0.0),
    (0.285, 0.01),
    (0.3, 0.6),
    (1.0, 0.5),
];
const SIDE: usize = 240;

fn set((re, im): (f64, f64)) -> JuliaSet {
    JuliaSet::new(Complex::new(Wide::from_num(re), Wide::from_num(im))).unwrap()
}

/// Which cells from `-2 - 2i` to `2 + 2i` points of backward orbits fall in.
fn visited(c: (f64, f64)) -> Vec<bool> {
    let mut cells = vec![false; SIDE * SIDE];
    let cell = |v: f64| (((v + 2.0) / 4.0 * SIDE as f64) as usize).min(SIDE - 1);
    julia_points(c, 8 * SIDE, 8, |(x, y)| cells[cell(-y) * SIDE + cell(x)] = true);
    cells
}

fn covered(c: (f64, f64)) -> Vec<u8> {
    let view = View::new(Complex::default(), Wide::from_num(4), Size::new(SIDE as u32, SIDE as u32)).unwrap();
    let cover = JuliaCover::new(view, set(c)).unwrap();
    (0..SIDE as u32).flat_map(|y| cover.row(y, 0..SIDE as u32)).collect()
}

/// How many cells have a property although no cell within one of them has the other.
fn alone(has: impl Fn(usize) -> bool, other: impl Fn(usize) -> bool) -> usize {
    let near = |i: usize| {
        let around = |v: usize| v.saturating_sub(1)..(v + 2).min(SIDE);
        around(i / SIDE).any(|y| around(i % SIDE).any(|x| other(y * SIDE + x)))
    };
    (0..SIDE * SIDE).filter(|i| has(*i) && !near(*i)).count()
}

#[test]
fn what_backward_orbits_visit_is_covered_and_little_else() {
    for c in CONSTANTS {
        let (visited, covered) = (visited(c), covered(c));
        let truth = visited.iter().filter(|v| **v).count();
        let cells = covered.iter().filter(|n| **n > 0).count();
        let missing = alone(|i| visited[i], |i| covered[i] > 0);
        let far = alone(|i| covered[i] > 0, |i| visited[i]);
        let unlike =
            (0..SIDE * SIDE).filter(|i| covered[*i] > 0 && covered[SIDE * SIDE - 1 - i] == 0).count();
        println!("{c:?}: {truth} visited, {cells} covered; {missing} missing, {far} far, {unlike} unlike");
        assert!(truth > 100 && cells > 200, "{c:?}");
        assert!(100 * missing <= truth, "{c:?}: {missing} of {truth} missing");
        assert!(100 * unlike <= cells, "{c:?}: {unlike} of {cells} without mirror image");
        let most = match c {
            SIEGEL => cells / 40,
            // the ends of the segment's two rows, 4 cells each
            (-2.0, 0.0) => 8,
            _ => cells / 100,
        };
        assert!(far <= most, "{c:?}: {far} of {cells} far from the set");
    }
}

#[test]
fn every_column_of_the_segment_is_covered_and_no_row_but_those_by_the_axis() {
    let cells = covered((-2.0, 0.0));
    assert!((0..SIDE).all(|x| cells[SIDE / 2 * SIDE + x] > 0 && cells[(SIDE / 2 - 1) * SIDE + x] > 0));
    assert!((0..SIDE / 2 - 2).all(|y| (0..SIDE).all(|x| cells[y * SIDE + x] == 0)));
}

/// 0 belongs to the set of i, and `f'` is 0 there: on a grid with an odd side it is the middle of a pixel.
#[test]
fn the_critical_point_of_a_dendrite_is_covered() {
    for c in [(0.0, 1.0), (-2.0, 0.0)] {
        let view = View::new(Complex::default(), Wide::lit("4"), Size::new(239, 239)).unwrap();
        let cover = JuliaCover::new(view, set(c)).unwrap();
        let row: Vec<u8> = cover.row(119, 0..239).collect();
        assert!(row[119] > 0, "{c:?}: {row:?}");
    }
}

#[test]
fn a_pixel_is_the_square_by_itself_whatever_part_of_the_row_is_asked_for() {
    for (width, height) in [(96, 48), (97, 49)] {
        let pitch = Wide::lit("0.03125");
        let view = View::new(Complex::default(), pitch * i64::from(width), Size::new(width, height)).unwrap();
        for c in [(0.285, 0.01), (-0.75, 0.0), (0.0, 1.0)] {
            let cover = JuliaCover::new(view, set(c)).unwrap();
            let mut met = 0;
            for y in 0..height {
                let row: Vec<u8> = cover.row(y, 0..width).collect();
                let alone: Vec<u8> = (0..width).map(|x| set(c).sixteenths(view.point(x, y), pitch)).collect();
                assert_eq!(row, alone, "{c:?}: row {y}");
                assert_eq!(cover.row(y, 13..50).collect::<Vec<_>>(), row[13..50]);
                assert_eq!(cover.row(y, 0..width).nth(31), Some(row[31]));
                // each pixel as its negative, exactly
                let mut mirrored: Vec<u8> = cover.row(height - 1 - y, 0..width).collect();
                mirrored.reverse();
                assert_eq!(row, mirrored);
                met += row.iter().filter(|n| **n > 0).count();
            }
            assert!(met > 100);
        }
    }
}

#[test]
fn the_radius_bounds_the_set() {
    for c in CONSTANTS.into_iter().chain([(-1.75, 0.0), (0.0, 2.0), (-1.4, -1.4)]) {
        let stored = set(c).constant();
        let modulus = stored.re.to_num::<f64>().hypot(stored.im.to_num());
        let exact = (1.0 + (1.0 + 4.0 * modulus).sqrt()) / 2.0;
        let off = set(c).radius().to_num::<f64>() - exact;
        assert!((0.0..2_f64.powi(-26)).contains(&off), "{c:?}: {off:e}");
        let mut farthest = 0.0_f64;
        julia_points(c, 200, 4, |(x, y)| farthest = farthest.max(x.hypot(y)));
        assert!(farthest <= exact + 1e-6 && farthest > 0.5, "{c:?}: {farthest}");
    }
}

/// Discs of every size, also those with a middle far away: not one that contains a point of the set is left
/// out.
#[test]
fn a_disc_round_a_point_of_the_set_may_meet_it() {
    for c in CONSTANTS {
        let set = set(c);
        let (mut k, mut refused) = (0_u32, 0);
        julia_points(c, 60, 4, |(x, y)| {
            k += 1;
            let r = 0.05 * f64::from(k % 81 * 4 + 1).sqrt().exp2().min(240.0);
            let (sin, cos) = f64::from(k).sin_cos();
            let disc = |off: f64| {
                let middle = Complex::new(Wide::from_num(x + off * cos), Wide::from_num(y + off * sin));
                set.may_meet(middle, Wide::from_num(r))
            };
            assert!(disc(0.99 * r) && disc(0.0), "{c:?}: {x} {y}, {r}");
            refused += u32::from(!disc(1.5 * r + 5.1));
        });
        assert!(k > 100 && refused == k, "{c:?}: {refused} of {k}");
    }
}

#[test]
fn pixels_wider_than_the_set_are_refused() {
    let view = |width: Wide| View::new(Complex::default(), width, Size::new(2, 2)).unwrap();
    let circle = set((0.0, 0.0));
    assert!(JuliaCover::new(view(Wide::lit("8")), circle).unwrap().row(0, 0..2).all(|n| n > 0));
    assert!(JuliaCover::new(view(Wide::lit("8.1")), circle).is_err());
}
