//! Pieces that fit together: rows, shared edges, seams, triangles of any levels.

use std::collections::HashMap;

use attractor::num::{Coordinate, RandomField, Real, Unit};
use attractor::terrain::{
    EdgeLevel, Heights, Magnification, PlaneToLine, Rows, Seam, Seamed, Triangles, Vertex,
};

use super::{knots, lattice, law, real};

/// Rows, whole and in pieces of any base, are the heights on demand, whatever order they are asked in.
#[test]
fn rows_and_pieces_are_the_heights_of_the_whole() {
    let given = knots(12, 3);
    let heights = Heights::new(4, 3, &given).unwrap().with_origin(-3, 2).unwrap();
    let terrain = PlaneToLine::new(heights, law(0.4, 0.6), RandomField::new(9)).unwrap();
    let mut compared = 0;
    for level in 0..7 {
        let (width, count, all) = lattice(&terrain, level);
        assert_eq!((width, count), ((3 << level) + 1, (2 << level) + 1));
        // backwards
        for index in (0..width * count).rev() {
            let [u, v] = terrain.point(level, index % width, index / width);
            assert_eq!(all[index as usize], terrain.height(u, v), "{level} {index}");
            compared += 1;
        }
        for base in 0..=level {
            let (columns, rows) = (1..3 << base, (1 << base)..2 << base);
            let cells = columns.end - columns.start;
            let mut memory = vec![Real::ZERO; Rows::<RandomField>::words(cells, level - base)];
            let mut piece =
                Rows::of(&terrain, base, [columns.clone(), rows.clone()], level, &mut memory).unwrap();
            let (mut row, down) = (rows.start << (level - base), piece.count());
            for _ in 0..down {
                let from = row * width + (columns.start << (level - base));
                let whole = &all[from as usize..][..piece.width()];
                assert_eq!(piece.next_row(), Some(whole), "{level} {base} {row}");
                row += 1;
            }
            assert_eq!(piece.next_row(), None);
            compared += 1;
        }
    }
    assert!(compared > 15_000, "{compared}");
}

/// Two surfaces that share a column of knots share all heights between them; so do the edges of a seam, in
/// any direction, and no others.
#[test]
fn shared_edges_and_seams_are_equal_bit_for_bit() {
    let (left, right) = (knots(6, 4), knots(6, 5));
    let joined: Vec<Real> =
        right.chunks(3).zip(left.chunks(3)).flat_map(|(r, l)| [l[2], r[1], r[2]]).collect();
    let [west, east] = [(&left, 0), (&joined, 2)].map(|(knots, u)| {
        let heights = Heights::new(3, 2, knots).unwrap().with_origin(u, 0).unwrap();
        PlaneToLine::new(heights, law(0.5, 0.7), RandomField::new(1)).unwrap()
    });
    let two = Coordinate::from_num(2);
    let mut different = 0;
    for k in 0..=1 << 10 {
        let v = Coordinate::from_bits(k << 6);
        assert_eq!(west.height(two, v), east.height(two, v));
        different += u32::from(west.height(Coordinate::ONE, v) != east.height(Coordinate::from_num(3), v));
    }
    assert!(different > 1000);
    // a strip of two cells closed to a ring with a twist: its ends run against each other
    let seams = [Seam::new(3, [0, 0], [0, 1]).unwrap(), Seam::new(3, [2, 1], [2, 0]).unwrap()];
    let heights = [0.1, 0.5, -0.3, -0.3, 0.2, 0.1].map(real);
    let strip = Heights::new(3, 2, &heights).unwrap();
    let ring = PlaneToLine::new(strip, law(0.5, 0.7), Seamed::new(RandomField::new(1), &seams)).unwrap();
    let open = PlaneToLine::new(strip, law(0.5, 0.7), RandomField::new(1)).unwrap();
    let (mut closed, mut inside) = (0, 0);
    for k in 0..=1 << 10 {
        let [v, back] = [k << 6, (1 << 16) - (k << 6)].map(Coordinate::from_bits);
        assert_eq!(ring.height(Coordinate::ZERO, v), ring.height(two, back));
        closed += u32::from(open.height(Coordinate::ZERO, v) != open.height(two, back));
        // what no seam reaches is as before: the knots' line between the cells
        inside += u32::from(ring.height(Coordinate::ONE, v) == open.height(Coordinate::ONE, v));
    }
    assert!(closed > 1000 && inside == (1 << 10) + 1, "{closed} {inside}");
}

/// Levels that are all over the place, but the edge's own.
struct Motley;

impl EdgeLevel for Motley {
    fn level(&self, [u_0, v_0]: [Coordinate; 2], [u_1, v_1]: [Coordinate; 2]) -> u32 {
        let middle = |a: Coordinate, b: Coordinate| (a.to_bits() / 2 + b.to_bits() / 2) as u32;
        (middle(u_0, u_1).wrapping_mul(0x9e37_79b1) ^ middle(v_0, v_1).wrapping_mul(0x85eb_ca6b)) >> 24 & 3
    }
}

/// Each edge of a triangle is one of another, the other way round, bit for bit; those that are not make the
/// rim of the whole. And no triangle is turned over: seen from above they cover the square once.
#[test]
fn triangles_of_any_levels_leave_no_crack() {
    let given = knots(25, 6);
    let heights = Heights::new(5, 5, &given).unwrap().with_origin(-2, -2).unwrap();
    let terrain = PlaneToLine::new(heights, law(0.4, 0.7), RandomField::new(3)).unwrap();
    let one = Coordinate::ONE;
    let eye = [-one * 2, -one, one / 2];
    let near = Magnification { eye, length: Unit::from_num(0.25), most: 5 };
    let (motley, mut levels) = (Motley, [0; 6]);
    for (rule, base) in [(&motley as &dyn Rule, 1), (&near, 0), (&2_u32, 2)] {
        let mut edges: HashMap<(Vertex, Vertex), u32> = HashMap::new();
        let mut area = 0_i64;
        let side = 4 << base;
        for cell in 0..side * side {
            for [a, b, c] in rule.triangles(&terrain, base, [cell % side, cell / side]) {
                let off =
                    |p: Vertex| [p.u.to_bits() - a.u.to_bits(), p.v.to_bits() - a.v.to_bits()].map(i64::from);
                let ([x, y], [z, w]) = (off(b), off(c));
                assert!(x * w > y * z, "{a:?} {b:?} {c:?}");
                area += x * w - y * z;
                for edge in [(a, b), (b, c), (c, a)] {
                    assert_eq!(edges.insert(edge, 1), None, "twice the same way");
                }
                let longest = x.abs().max(y.abs()).max(z.abs()).max(w.abs());
                levels[(16 - base - longest.ilog2()).min(5) as usize] += 1;
            }
        }
        assert_eq!(area, 2 << 36);
        for (a, b) in edges.keys().filter(|(a, b)| !edges.contains_key(&(*b, *a))) {
            let rim = |a: Coordinate, b: Coordinate| a == b && (a == -2 || a == 2);
            assert!(rim(a.u, b.u) || rim(a.v, b.v), "{a:?} {b:?}");
        }
        for vertex in edges.keys().map(|(a, _)| a).take(300) {
            assert_eq!(vertex.height, terrain.height(vertex.u, vertex.v));
        }
    }
    println!("{levels:?} triangles by level");
    assert!(levels.iter().filter(|count| **count > 30).count() > 2, "{levels:?}");
}

/// A rule of any kind.
trait Rule {
    fn triangles(&self, terrain: &PlaneToLine<'_>, base: u32, cell: [u32; 2]) -> Vec<[Vertex; 3]>;
}

impl<E: EdgeLevel> Rule for E {
    fn triangles(&self, terrain: &PlaneToLine<'_>, base: u32, cell: [u32; 2]) -> Vec<[Vertex; 3]> {
        Triangles::new(terrain, base, cell, self).unwrap().collect()
    }
}
