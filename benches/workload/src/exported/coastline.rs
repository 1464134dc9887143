//! Iceland's outline in 44 points, roughened by the one-variable law.
//!
//! Written by `attractor export --gallery coastline`.

use attractor::Error;
use attractor::curve::{OneVariable, Stop};
use attractor::draw::{Gradient, gradients};
use attractor::num::Unit;
use attractor::plane::Point2;
use attractor_gallery::{Named, Pencil};

/// The offset.
pub const OFFSET: Unit = Unit::lit("0.16");

/// Selects one of all curves.
pub const SEED: u64 = 1980;

/// The law.
///
/// # Errors
/// None: those of [`OneVariable`]'s constructors do not occur with these numbers.
pub fn law() -> Result<OneVariable, Error> {
    OneVariable::new(OFFSET, SEED)
}

/// What it goes through.
#[rustfmt::skip]
pub static KNOTS: [Point2; 45] = [
    Point2::lit("-1.77499557", "-1.2"),
    Point2::lit("-1.56368655", "-1.2"),
    Point2::lit("-1.2255922", "-1.2"),
    Point2::lit("-1.0142832", "-1.2"),
    Point2::lit("-0.7607124", "-1.4"),
    Point2::lit("-0.2535708", "-1.59999996"),
    Point2::lit("-0.0422618", "-1.59999996"),
    Point2::lit("0.2958326", "-1.29999995"),
    Point2::lit("0.67618877", "-1.2"),
    Point2::lit("0.97202134", "-1"),
    Point2::lit("1.3946394", "-0.79999995"),
    Point2::lit("1.69047195", "-0.59999996"),
    Point2::lit("1.90178096", "-0.29999995"),
    Point2::lit("2.0708282", "0"),
    Point2::lit("2.02856636", "0.29999995"),
    Point2::lit("1.77499557", "0.59999996"),
    Point2::lit("1.7327338", "0.79999995"),
    Point2::lit("1.5214248", "1"),
    Point2::lit("1.64821017", "1.4"),
    Point2::lit("1.3523776", "1.2"),
    Point2::lit("1.05654496", "1.5"),
    Point2::lit("0.84523594", "1.09999996"),
    Point2::lit("0.54940337", "1.2"),
    Point2::lit("0.422618", "1"),
    Point2::lit("0.1267854", "1.2"),
    Point2::lit("0.1690472", "0.7"),
    Point2::lit("-0.1690472", "1.2"),
    Point2::lit("-0.46487975", "0.7"),
    Point2::lit("-0.80297416", "1.09999996"),
    Point2::lit("-0.7607124", "0.59999996"),
    Point2::lit("-1.0988068", "0.29999995"),
    Point2::lit("-1.2255922", "0.7"),
    Point2::lit("-1.3523776", "1.2"),
    Point2::lit("-1.69047195", "1.5"),
    Point2::lit("-1.9863046", "1.09999996"),
    Point2::lit("-1.7327338", "0.9"),
    Point2::lit("-2.15535176", "1"),
    Point2::lit("-2.53570795", "0.5"),
    Point2::lit("-1.9863046", "0.5"),
    Point2::lit("-1.56368655", "0.4"),
    Point2::lit("-1.64821017", "0"),
    Point2::lit("-2.324399", "-0.09999996"),
    Point2::lit("-1.56368655", "-0.4"),
    Point2::lit("-1.479163", "-0.9"),
    Point2::lit("-1.77499557", "-1.2"),
];

/// Where it stops; none: at the length of a pixel.
pub const STOP: Option<Stop> = None;

/// Whether it is the graph of a function, stretched over the display.
pub const GRAPH: bool = false;

/// Whether what it encloses, or what lies below a graph, has a ground: a bit of lent memory for each pixel.
pub const FILLED: bool = true;

/// Where its colours come from.
pub const PALETTE: Gradient<9> = gradients::MOSS;

/// How its colours change along it.
pub const PENCIL: Pencil = Pencil { palette: Named::Moss, closed: true };
