//! Light and textures as numbers, beside those of the reference.

use std::io::Write;
use std::path::Path;

use attractor::num::{Real, Unit, Vec3};
use attractor::plane::LinearRgb;
use attractor::trace::texture::Texture as _;
use attractor::trace::{Chart, SurfacePoint};

use super::reference_texture::{pigment, point};
use super::texture::Pattern;
use crate::fail::Fail;
use crate::lines::Lines;
use crate::number::exact;

/// The parts of a light as CSV cells: exact numbers of 65535ths.
pub(crate) fn light(light: LinearRgb) -> String {
    let [r, g, b] = [light.r, light.g, light.b].map(|part| f64::from(part) / 65535.0);
    format!("{r:?},{g:?},{b:?}")
}

/// The columns of a pixel.
pub(crate) const PIXEL: &str = "i,j,r,g,b,r_reference,g_reference,b_reference";

/// The reference's light as CSV cells, empty where it has none.
pub(crate) fn cells(light: Option<[f64; 3]>) -> String {
    light.map_or_else(|| ",,".to_owned(), |[r, g, b]| format!("{r:?},{g:?},{b:?}"))
}

/// The reference's texture at a point of core's.
pub(crate) fn at(pattern: &Pattern) -> impl Fn(&SurfacePoint) -> [f64; 3] {
    let pigment = pigment(pattern);
    move |place| pigment.at(&point(place))
}

/// The textures at the places of a file, each taken in the coordinates of the shape that it colours.
pub(crate) fn values(textures: &[(&str, &Pattern)], file: &Path, out: &mut dyn Write) -> Result<(), Fail> {
    let places = Lines::of("--at", file, ["x", "y", "z"]).read(file, |_: [Real; 3]| Ok(()))?;
    writeln!(out, "place,texture,x,y,z,r,g,b,r_reference,g_reference,b_reference")?;
    let references: Vec<_> = textures.iter().map(|(_, pattern)| at(pattern)).collect();
    for (number, [x, y, z]) in places.into_iter().enumerate() {
        let place = Vec3::new(x, y, z);
        let normal = Vec3::new(Unit::ZERO, Unit::ZERO, Unit::ONE);
        let chart = Chart { u: x, v: y, along_u: Vec3::X, along_v: Vec3::Y };
        let place =
            SurfacePoint { position: place, place, normal, inward: false, chart, face: 0, width: Real::ZERO };
        for ((name, pattern), reference) in textures.iter().zip(&references) {
            let color = pattern.pigment().map_err(Fail::new)?.at(&place);
            let [r, g, b] = [color.r, color.g, color.b].map(exact);
            let [x, y, z] = [x, y, z].map(exact);
            let reference = cells(Some(reference(&place)));
            writeln!(out, "{number},{name},{x},{y},{z},{r},{g},{b},{reference}")?;
        }
    }
    Ok(())
}
