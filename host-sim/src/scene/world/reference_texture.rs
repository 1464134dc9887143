//! The textures of a world as the f64 reference has them.

use attractor::num::{Real, Rgb, Unit};
use attractor::trace::SurfacePoint;
use attractor::trace::texture::Noise;
use attractor_reference::texture::Wood;
use attractor_reference::world::{self as exact, Colour, Lookup, Part, Point, Texels, Turbulence};

use super::picture::Picture;
use super::texture::{Grain, Looked, Pattern};

/// A colour in numbers.
pub(super) fn color(light: Rgb) -> Colour {
    [light.r, light.g, light.b].map(|part| part.to_num())
}

fn turbulence(grain: Grain) -> Turbulence {
    Turbulence {
        keys: Noise::new(grain.seed).keys(),
        frequency: grain.frequency.to_num(),
        octaves: grain.octaves.into(),
    }
}

/// Linear light of level 0 (IEC 61966-2-1).
pub(super) fn texels(picture: &Picture) -> Texels {
    let linear = |code: u8| {
        let v = f64::from(code) / 255.0;
        if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
    };
    let (columns, rows) = (picture.size.0 as usize, picture.size.1 as usize);
    let light = picture.bytes.chunks_exact(3).take(columns * rows);
    Texels { size: [columns, rows], light: light.map(|texel| [0, 1, 2].map(|k| linear(texel[k]))).collect() }
}

fn knots(colors: &[(Unit, Rgb)]) -> Vec<(f64, Colour)> {
    colors.iter().map(|(knot, light)| (knot.to_num(), color(*light))).collect()
}

/// The colours of a texture.
pub(super) fn pigment(pattern: &Pattern) -> exact::Pattern<Colour> {
    let real = Real::to_num::<f64>;
    match pattern {
        Pattern::Checker { colors, frequency, squares } => {
            let (colors, [x, y, z]) = (colors.map(color), frequency.map(real));
            match squares {
                true => exact::Pattern::squares([x, y], colors),
                false => exact::Pattern::cubes([x, y, z], colors),
            }
        }
        Pattern::Mottle { colors, grain } => exact::Pattern::mottle(knots(colors), turbulence(*grain)),
        Pattern::Marble { colors, grain, amplitude, veins } => {
            exact::Pattern::marble(knots(colors), turbulence(*grain), real(*amplitude), real(*veins))
        }
        Pattern::Wood { wood, rough } => {
            let rings = Wood {
                rings: real(wood.rings),
                tilt: wood.tilt.map(real),
                wobble: real(wood.wobble),
                lobes: wood.lobes.into(),
                twist: real(wood.twist),
            };
            let rough = rough.map(|(grain, rings)| (turbulence(grain), real(rings)));
            exact::Pattern::wood(rings, wood.colors.map(color), rough, wood.soft.to_num())
        }
        Pattern::Facets { .. } => exact::Pattern::plain([1.0; 3]),
        Pattern::Image { picture, lookup, rows } => {
            let lookup = match lookup {
                Looked::Nearest => Lookup::Nearest,
                Looked::Bilinear => Lookup::Bilinear,
                Looked::Area => Lookup::Area,
            };
            exact::Pattern::image(texels(picture), lookup, rows.map(|row| row.map(real)))
        }
        Pattern::Plain(light) => exact::Pattern::plain(color(*light)),
        Pattern::Pasted { parent, detail, corners } => {
            let corners = corners.iter().map(|corner| corner.map(real)).collect();
            pigment(parent).pasted(pigment(detail), corners)
        }
    }
}

/// The bumps of a texture with a strength.
pub(super) fn raised(pattern: &Pattern, strength: Real) -> Option<exact::Pattern<[f64; 2]>> {
    let height = strength.to_num();
    match pattern {
        Pattern::Mottle { grain, .. } => Some(exact::Pattern::rough(turbulence(*grain), height)),
        Pattern::Facets { cells, seed } => {
            let tilt = Unit::saturating_from_num(strength).to_num();
            Some(exact::Pattern::facets(cells.map(Real::to_num), tilt, *seed))
        }
        Pattern::Image { picture, .. } => Some(exact::Pattern::table(texels(picture), height)),
        _ => None,
    }
}

/// The grain of a texture with a strength.
pub(super) fn turned(pattern: &Pattern, strength: Real) -> Option<exact::Pattern<f64>> {
    match pattern {
        Pattern::Checker { frequency, squares, .. } => {
            let [x, y, z] = frequency.map(Real::to_num);
            Some(match squares {
                true => exact::Pattern::threads_of_squares([x, y]),
                false => exact::Pattern::threads_of_cubes([x, y, z]),
            })
        }
        Pattern::Mottle { grain, .. } => {
            let turns = Unit::saturating_from_num(strength).to_num();
            Some(exact::Pattern::streaks(turbulence(*grain), turns))
        }
        Pattern::Image { picture, .. } => Some(exact::Pattern::angles(texels(picture))),
        _ => None,
    }
}

/// A point that core has.
pub(super) fn point(point: &SurfacePoint) -> Point {
    let vector = |v: attractor::num::Vec3| [v.x, v.y, v.z].map(Real::to_num);
    let chart = &point.chart;
    Point {
        position: vector(point.position),
        generic: vector(point.place),
        uv: [chart.u, chart.v].map(Real::to_num),
        normal: [point.normal.x, point.normal.y, point.normal.z].map(Unit::to_num),
        p_u: vector(chart.along_u),
        p_v: vector(chart.along_v),
        leaf: 0,
        part: Part::Face(point.face.into()),
        width: point.width.to_num(),
    }
}
