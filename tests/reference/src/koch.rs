//! Curves by refinement: each segment is replaced by a smaller version of the generator, recursively.
//!
//! Source: course unit V, sections 5.1.1 and 5.1.2. The text errs here: the turns of `drawKoch` are +60,
//! -120, +60 degrees.

/// The Koch curve of order `n` from `(0, 0)` to `(1, 0)` as `drawKoch` draws it: a turtle that adds relative
/// lines up.
pub fn draw_koch(n: u32) -> Vec<(f64, f64)> {
    fn draw(points: &mut Vec<(f64, f64)>, direction: &mut f64, length: f64, n: u32) {
        if n == 0 {
            let (x, y) = points[points.len() - 1];
            let radians = direction.to_radians();
            points.push((x + length * libm::cos(radians), y + length * libm::sin(radians)));
        } else {
            for turn in [60.0, -120.0, 60.0, 0.0] {
                draw(points, direction, length / 3.0, n - 1);
                *direction += turn;
            }
        }
    }
    let mut points = vec![(0.0, 0.0)];
    draw(&mut points, &mut 0.0, 1.0, n);
    points
}

/// One segment of a generator: from which vertex to which, whether the copy is walked from its end, whether
/// it lies on the other side.
#[derive(Debug, Clone, Copy)]
pub struct Segment {
    /// Its end in the frame in which the generator leads from `(0, 0)` to `(1, 0)`.
    pub end: (f64, f64),
    /// The copy begins at the end of the segment.
    pub reversed: bool,
    /// The copy is reflected in the segment.
    pub mirrored: bool,
}

/// The generator that a turtle word describes: see the table of the kernel's `turtle`; the angle in degrees.
pub fn turtle(word: &str, degrees: f64) -> Vec<Segment> {
    let (mut x, mut y, mut heading) = (0.0, 0.0, 0.0_f64);
    let mut segments = Vec::new();
    for letter in word.chars() {
        match letter {
            '+' => heading += degrees,
            '-' => heading -= degrees,
            _ => {
                x += libm::cos(heading.to_radians());
                y += libm::sin(heading.to_radians());
                segments.push(Segment {
                    end: (x, y),
                    reversed: matches!(letter, 'B' | 'b'),
                    mirrored: letter.is_ascii_lowercase(),
                });
            }
        }
    }
    // divided by the complex number where the turtle ends
    let square = x * x + y * y;
    for segment in &mut segments {
        let (u, v) = segment.end;
        segment.end = ((u * x + v * y) / square, (v * x - u * y) / square);
    }
    segments
}

/// What is drawn of a copy: its two ends, or a point in the frame of the generator.
#[derive(Debug, Clone, Copy)]
pub enum Show {
    /// The polyline itself.
    Vertices,
    /// A point of each copy.
    Marker(f64, f64),
}

/// The points of the refinement of order `n` of the segment from `a` to `b`, in the order of the walk.
pub fn refined(generator: &[Segment], show: Show, a: (f64, f64), b: (f64, f64), n: u32) -> Vec<(f64, f64)> {
    let mut points = match show {
        Show::Vertices => vec![a],
        Show::Marker(..) => Vec::new(),
    };
    refine(&mut points, generator, show, (a, b), false, n);
    points
}

/// Adds the copy on the segment from `a` to `b` in the generator's frame, all but its first vertex.
fn refine(
    points: &mut Vec<(f64, f64)>,
    generator: &[Segment],
    show: Show,
    (a, b): ((f64, f64), (f64, f64)),
    mirrored: bool,
    n: u32,
) {
    let place = |(x, y): (f64, f64)| {
        let y = if mirrored { -y } else { y };
        let (dx, dy) = (b.0 - a.0, b.1 - a.1);
        (a.0 + dx * x - dy * y, a.1 + dx * y + dy * x)
    };
    if n == 0 {
        points.push(match show {
            Show::Vertices => b,
            Show::Marker(x, y) => place((x, y)),
        });
        return;
    }
    let mut start = (0.0, 0.0);
    for segment in generator {
        let (from, to) = (place(start), place(segment.end));
        let mirror = mirrored != segment.mirrored;
        if segment.reversed {
            let first = points.len();
            refine(points, generator, show, (to, from), mirror, n - 1);
            match show {
                // it went from `to` to `from` without `to`; wanted is the way back without `from`
                Show::Vertices => {
                    points.pop();
                    points[first..].reverse();
                    points.push(to);
                }
                Show::Marker(..) => points[first..].reverse(),
            }
        } else {
            refine(points, generator, show, (from, to), mirror, n - 1);
        }
        start = segment.end;
    }
}

/// The area of a closed polygon by the shoelace formula, positive when it is walked counter-clockwise.
pub fn area(points: &[(f64, f64)]) -> f64 {
    points.windows(2).map(|w| w[0].0 * w[1].1 - w[1].0 * w[0].1).sum::<f64>() / 2.0
}

/// The length of a polyline.
pub fn length(points: &[(f64, f64)]) -> f64 {
    points.windows(2).map(|w| libm::hypot(w[1].0 - w[0].0, w[1].1 - w[0].1)).sum()
}
