//! `kind = "terrain"`: a landscape by subdivision of a few knots, or of a digital elevation model.

mod elevation;
mod roughness;

use std::convert::Infallible;

use attractor::num::{Coordinate, Lumen, Real, Rgb, Unit, Vec3};
use attractor::terrain::{Heights, InnerGeometry, Magnification};
use attractor::trace::{HeightRange, Sky};
use attractor_gallery::{Floor, Ground, Lines, Pencil, TerrainMemory, TerrainPicture, Watch};
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::Size;
use serde::Deserialize;
use toml::Spanned;

use super::contrast::contrast;
use super::motion::Motion;
use super::orbit::{Orbit, carried};
use super::request::Request;
use super::standpoint::{Eye, Standpoint, camera, vector};
use super::world::color::{Color, light, light_or};
use crate::color::Depth;
use crate::fail::Fail;
use crate::palette::Named;
use crate::source::{Num, Place, Source};
use crate::table::Csv;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(rename = "kind")]
    _kind: String,
    #[serde(rename = "title")]
    _title: Option<String>,
    knots: Option<Spanned<Vec<Spanned<Vec<Num>>>>>,
    elevation: Option<Spanned<elevation::Table>>,
    offset: Option<Num>,
    similarity: Option<Num>,
    seed: Option<u64>,
    surface: Option<u32>,
    origin: Option<Spanned<[i16; 2]>>,
    levels: Spanned<u32>,
    inner: Option<Inner>,
    over: Option<Spanned<[[Num; 2]; 2]>>,
    camera: Option<Spanned<Eye>>,
    flight: Option<Flight>,
    mesh: Option<Spanned<Mesh>>,
    near: Option<Spanned<Near>>,
    palette: Option<Named>,
    sun: Option<Sun>,
    sky: Option<Heaven>,
    haze: Option<Num>,
    ambient: Option<Num>,
    ground: Option<Cover>,
    plain: Option<Level>,
    samples: Option<Spanned<u8>>,
    contrast: Option<Spanned<[i64; 2]>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Inner {
    Bilinear,
    Ferguson,
    BSpline,
}

/// A flight of the camera: where it ends, and how much of the way is behind.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Flight {
    eye: Spanned<[Num; 3]>,
    look_at: Spanned<[Num; 3]>,
    time: Num,
}

/// Which lines are drawn in place of the surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Mesh {
    Edges,
    Lattice,
    Triangles,
}

/// From where edges are magnified.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Near {
    eye: Spanned<[Num; 3]>,
    length: Num,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Sun {
    towards: Spanned<[Num; 3]>,
    color: Option<Spanned<Color>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Heaven {
    zenith: Option<Spanned<Color>>,
    horizon: Option<Spanned<Color>>,
    nadir: Option<Spanned<Color>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Cover {
    color: Option<Spanned<Color>>,
    sand: Option<Spanned<Color>>,
    grass: Option<Spanned<Color>>,
    rock: Option<Spanned<Color>>,
    snow: Option<Spanned<Color>>,
    shore: Option<Num>,
    snow_line: Option<Num>,
    steep: Option<Num>,
    passage: Option<Num>,
    ragged: Option<Num>,
    grain: Option<Num>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Level {
    level: Option<Num>,
    color: Option<Spanned<Color>>,
    reflect: Option<Spanned<Color>>,
}

/// A landscape ready to be drawn.
#[derive(Debug)]
pub(crate) struct TerrainScene {
    knots: Vec<Real>,
    /// All numbers but the knots.
    picture: TerrainPicture<'static>,
    pub(crate) lines: Option<(Lines, Named)>,
    orbit: Option<Orbit>,
    place: Place,
}

/// The most heights of a lattice.
const MOST: u64 = 1 << 24;

impl TerrainScene {
    pub(super) fn load(source: &Source) -> Result<Self, Fail> {
        let file: File = source.parse()?;
        let (columns, knots, place) = knots(source, &file)?;
        let rows = knots.len() as u32 / columns;
        let levels = *file.levels.get_ref();
        let cells = |knots: u32| u64::from(knots - 1) << levels.min(32);
        if levels > attractor::terrain::LEVELS || (cells(columns) + 1) * (cells(rows) + 1) > MOST {
            let reason = format!("allowed is 0 to 16, and {MOST} heights in all");
            return Err(source.fail(file.levels.span(), "levels", reason));
        }
        let over = match &file.over {
            None => [[-Real::ONE, Real::ONE]; 2],
            Some(over) => {
                let [x, y] = over.get_ref();
                [source.pair(x, "over[0]")?, source.pair(y, "over[1]")?]
            }
        };
        let samples = match &file.samples {
            Some(samples) if !(1..=8).contains(samples.get_ref()) => {
                return Err(source.fail(samples.span(), "samples", "allowed is 1 to 8 a side"));
            }
            samples => samples.as_ref().map_or(2, |samples| *samples.get_ref()),
        };
        let lines = lines(source, &file)?;
        let (eye, look_at, field_of_view, orbit) = match (&file.camera, &lines) {
            (Some(given), None) => {
                let (_, Standpoint { eye, look_at, field_of_view, .. }, orbit) = camera(source, given)?;
                match &file.flight {
                    Some(flight) => {
                        let [eye, look_at] = flown(source, flight, [eye, look_at])?;
                        (eye, look_at, field_of_view, Some(Orbit::new(eye, look_at, field_of_view)))
                    }
                    None => (eye, look_at, field_of_view, orbit),
                }
            }
            (None, Some(_)) => (Vec3::Y, Vec3::default(), Real::from_num(40), None),
            (Some(given), Some(_)) => {
                return Err(source.fail(given.span(), "camera", "a mesh is drawn in parallel projection"));
            }
            (None, None) => return Err(source.fail_all("camera", "missing; or a key mesh")),
        };
        let unit = |number: &Option<Num>, key: &str, usual: Unit| match number {
            None => Ok(usual),
            Some(number) => source
                .fixed::<Unit>(number, key)
                .ok()
                .filter(|part| (Unit::ZERO..=Unit::ONE).contains(part))
                .ok_or_else(|| source.fail(number.span(), key, "allowed is 0 to 1")),
        };
        let scene = Self {
            picture: TerrainPicture {
                knots: &[],
                columns,
                origin: file.origin.as_ref().map_or([0, 0], |origin| *origin.get_ref()),
                roughness: roughness(source, &file, columns, &knots)?,
                seed: (file.seed.unwrap_or(0), file.surface.unwrap_or(0)),
                levels,
                inner: match file.inner.unwrap_or(Inner::BSpline) {
                    Inner::Bilinear => InnerGeometry::Bilinear,
                    Inner::Ferguson => InnerGeometry::Ferguson,
                    Inner::BSpline => InnerGeometry::BSpline,
                },
                over,
                ground: ground(source, file.ground.as_ref().unwrap_or(&Cover::default()), &unit)?,
                plain: file.plain.as_ref().map(|plain| level(source, plain)).transpose()?,
                sun: sun(source, file.sun.as_ref())?,
                ambient: unit(&file.ambient, "ambient", Unit::from_num(0.15))?,
                sky: sky(source, file.sky.as_ref().unwrap_or(&Heaven::default()))?,
                haze: unit(&file.haze, "haze", Unit::ZERO)?,
                view: (eye, look_at, field_of_view),
                samples,
                contrast: contrast(source, file.contrast.as_ref())?,
            },
            knots,
            lines,
            orbit,
            place,
        };
        // ranges are checked now, not in the middle of a picture
        let picture = scene.picture();
        let heights = Heights::new(columns, rows, &scene.knots).map_err(|error| scene.place.fail(error))?;
        if let Some(origin) = &file.origin {
            let [u, v] = *origin.get_ref();
            heights.with_origin(u, v).map_err(|error| source.fail(origin.span(), "origin", error))?;
        }
        picture.function().map_err(|error| scene.place.fail(error))?;
        scene.drawn_small().map_err(|error| {
            let span = file.over.as_ref().map_or_else(|| file.levels.span(), Spanned::span);
            source.fail(span, if file.over.is_some() { "over" } else { "levels" }, error)
        })?;
        Ok(scene)
    }

    /// All its numbers.
    pub(crate) fn picture(&self) -> TerrainPicture<'_> {
        TerrainPicture { knots: &self.knots, ..self.picture }
    }

    /// One pixel, so that every constructor has seen its numbers.
    fn drawn_small(&self) -> Result<(), attractor::Error> {
        let mut display = embedded_graphics_simulator::SimulatorDisplay::<
            embedded_graphics::pixelcolor::Rgb888,
        >::new(Size::new(1, 1));
        self.with_memory(|memory| {
            self.picture().draw((Size::new(1, 1), 1), memory, &mut display, &mut |_, _, _| true)
        })
    }

    fn with_memory<T>(&self, use_it: impl FnOnce(TerrainMemory<'_>) -> T) -> T {
        let picture = self.picture();
        let mut heights = vec![Real::ZERO; picture.heights()];
        let mut rows = vec![Real::ZERO; picture.words()];
        let mut ranges = vec![HeightRange::default(); picture.ranges()];
        use_it(TerrainMemory { heights: &mut heights, rows: &mut rows, ranges: &mut ranges })
    }

    pub(super) fn draw<D>(&self, request: &Request, target: &mut D, watch: Watch<'_, D>) -> Result<(), Fail>
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        let picture = self.picture();
        let drawn = match self.lines {
            Some((lines, palette)) => {
                let pencil = Pencil { palette, closed: false };
                picture.draw_lines(lines, pencil, request.size, target, watch)
            }
            None => self.with_memory(|memory| {
                picture.draw((request.size, request.seed as u32), memory, target, watch)
            }),
        };
        drawn.map_err(|error| self.place.fail_at(request.size, error))
    }

    /// Moves the camera round what it looks at.
    pub(super) fn go(&mut self, size: Size, motion: Motion) -> Result<(), Fail> {
        if let Motion::Light { right, up } = motion {
            let (sun, light) = self.picture.sun;
            self.picture.sun = (carried(sun, Vec3::default(), [right, up], size), light);
            return Ok(());
        }
        let Some(orbit) = &self.orbit else {
            return Err(Fail::new("the camera moves about only where z is up"));
        };
        let orbit = orbit.after(motion, size);
        let [x, y, z] = orbit.eye().map(Real::saturating_from_num);
        let (_, look_at, field_of_view) = self.picture.view;
        self.picture.view = (Vec3::new(x, y, z), look_at, field_of_view);
        self.orbit = Some(orbit);
        Ok(())
    }

    /// Where the viewer stands, as lines of a scene file.
    pub(super) fn place(&self) -> Option<String> {
        self.orbit.as_ref().map(Orbit::place)
    }

    /// Heights on the lattice, about as many as asked for.
    pub(super) fn sample(&self, points: u32, out: &mut Csv) -> Result<(), Fail> {
        let picture = self.picture();
        let function = picture.function().map_err(|error| self.place.fail(error))?;
        out.write_record(["u", "v", "height"])?;
        let (columns, rows) = picture.lattice();
        let stride =
            ((f64::from(columns) * f64::from(rows) / f64::from(points)).sqrt().ceil() as usize).max(1);
        for j in (0..rows).step_by(stride) {
            for i in (0..columns).step_by(stride) {
                let [u, v] = function.point(picture.levels, i, j);
                out.write_record([
                    u.to_string(),
                    v.to_string(),
                    crate::number::exact(function.height(u, v)),
                ])?;
            }
        }
        Ok(())
    }
}

/// The lines that the file asks for.
fn lines(source: &Source, file: &File) -> Result<Option<(Lines, Named)>, Fail> {
    let palette = file.palette.unwrap_or(Named::Ocean);
    let lines = match (&file.mesh, &file.near) {
        (None, None) => return Ok(None),
        (Some(mesh), Some(near)) if *mesh.get_ref() == Mesh::Triangles => {
            let Near { eye, length } = near.get_ref();
            let [u, v, z] = source.triple::<Coordinate>(eye.get_ref(), "near.eye")?;
            let length = source.fixed(length, "near.length")?;
            Lines::Triangles(Magnification { eye: [u, v, z], length, most: *file.levels.get_ref() })
        }
        (Some(mesh), None) => match mesh.get_ref() {
            Mesh::Edges => Lines::Edges,
            Mesh::Lattice => Lines::Lattice,
            Mesh::Triangles => {
                return Err(source.fail(mesh.span(), "mesh", "triangles are asked for by a table [near]"));
            }
        },
        (_, Some(near)) => return Err(source.fail(near.span(), "near", "mesh is not \"triangles\"")),
    };
    Ok(Some((lines, palette)))
}

/// Eye and aim after the part of a flight that `time` says, straight ahead at constant speed.
fn flown(source: &Source, flight: &Flight, from: [Vec3; 2]) -> Result<[Vec3; 2], Fail> {
    let to = [vector(source, &flight.eye, "flight.eye")?, vector(source, &flight.look_at, "flight.look_at")?];
    let time = source
        .fixed::<Unit>(&flight.time, "flight.time")
        .ok()
        .filter(|time| (Unit::ZERO..=Unit::ONE).contains(time))
        .ok_or_else(|| source.fail(flight.time.span(), "flight.time", "allowed is 0 to 1"))?;
    let between = |a: Real, b: Real| {
        let way = (i64::from(b.to_bits()) - i64::from(a.to_bits())) * i64::from(time.to_bits());
        Real::from_bits((i64::from(a.to_bits()) + (way >> 30)) as i32)
    };
    let mixed = |a: Vec3, b: Vec3| Vec3::new(between(a.x, b.x), between(a.y, b.y), between(a.z, b.z));
    let [eye, look_at] = [mixed(from[0], to[0]), mixed(from[1], to[1])];
    attractor::trace::Camera::new(eye, look_at, Vec3::Z, Real::from_num(40))
        .map_err(|error| source.fail(flight.eye.span(), "flight.eye", error))?;
    Ok([eye, look_at])
}

/// Columns and heights, from knots or elevations, and where they stand.
fn knots(source: &Source, file: &File) -> Result<(u32, Vec<Real>, Place), Fail> {
    match (&file.knots, &file.elevation) {
        (Some(list), None) => {
            let mut knots = Vec::new();
            let columns = list.get_ref().first().map_or(0, |row| row.get_ref().len());
            let place = source.place(list.span(), "knots");
            if list.get_ref().len() < 2 || columns < 2 {
                return Err(place.fail("a surface has two rows of two knots at least"));
            }
            for (j, row) in list.get_ref().iter().enumerate() {
                let key = format!("knots[{j}]");
                if row.get_ref().len() != columns {
                    let reason = format!("{} knots, the first row has {columns}", row.get_ref().len());
                    return Err(source.fail(row.span(), &key, reason));
                }
                for (i, knot) in row.get_ref().iter().enumerate() {
                    knots.push(source.fixed::<Real>(knot, &format!("{key}[{i}]"))?);
                }
            }
            Ok((columns as u32, knots, place))
        }
        (None, Some(table)) => {
            let (columns, knots) = table.get_ref().read(source)?;
            Ok((columns, knots, source.place(table.span(), "elevation")))
        }
        (None, None) => Err(source.fail_all("knots", "missing; or a table [elevation]")),
        (Some(_), Some(table)) => Err(source.fail(table.span(), "elevation", "knots are given as well")),
    }
}

/// What the file says, or else the data.
fn roughness(source: &Source, file: &File, columns: u32, knots: &[Real]) -> Result<(Unit, Unit), Fail> {
    let given = |number: &Option<Num>, key: &str, usual: f64, (most, named): (Unit, &str)| match number {
        None => Ok(Unit::from_num(usual)),
        Some(number) => source
            .fixed::<Unit>(number, key)
            .ok()
            .filter(|part| *part >= 0 && *part <= most)
            .ok_or_else(|| source.fail(number.span(), key, format!("allowed is 0 to {named}"))),
    };
    let (mut offset, mut similarity) = (0.25, 0.9);
    if let Some(table) =
        file.elevation.as_ref().filter(|_| file.offset.is_none() || file.similarity.is_none())
    {
        let heights: Vec<f64> = knots.iter().map(|h| h.to_num()).collect();
        let what = match roughness::estimate(columns as usize, knots.len() / columns as usize, &heights) {
            Some((o, h)) => {
                (offset, similarity) = (o.min(1.99), h.clamp(0.0, 1.0));
                let smooth = if h > 1.0 { "; the law's most is 1, which is taken" } else { "" };
                format!(
                    "roughness estimated from the data: offset {o:.5}, similarity exponent {h:.3}{smooth}"
                )
            }
            None => {
                offset = 0.0;
                "too few or too flat to estimate a roughness from: no detail is added".to_owned()
            }
        };
        source.note(table.span(), "elevation", &what);
    }
    Ok((
        given(&file.offset, "offset", offset, (Unit::MAX, "just below 2"))?,
        given(&file.similarity, "similarity", similarity, (Unit::ONE, "1"))?,
    ))
}

fn code(code: u32) -> Rgb {
    // a display's code as light, by the square that nearly is its curve
    let part = |shift: u32| {
        Lumen::from_bits(((code >> shift & 0xff) * (code >> shift & 0xff)).min(65_025) * 65_536 / 65_025)
    };
    Rgb::new(part(16), part(8), part(0))
}

fn ground(
    source: &Source,
    given: &Cover,
    unit: &impl Fn(&Option<Num>, &str, Unit) -> Result<Unit, Fail>,
) -> Result<Ground, Fail> {
    let plain = given.color.as_ref().map(|color| light(source, color, "ground.color", 1)).transpose()?;
    let color = |color: &Option<Spanned<Color>>, key: &str, usual: u32| {
        light_or(source, color.as_ref(), key, plain.unwrap_or(code(usual)))
    };
    let real = |number: &Option<Num>, key: &str, usual: f64| match number {
        Some(number) => source.fixed::<Real>(number, key),
        None => Ok(Real::from_num(usual)),
    };
    let grain = real(&given.grain, "ground.grain", 6.0)?;
    Ok(Ground {
        sand: color(&given.sand, "ground.sand", 0xc8b48c)?,
        grass: color(&given.grass, "ground.grass", 0x5a7838)?,
        rock: color(&given.rock, "ground.rock", 0x786c60)?,
        snow: color(&given.snow, "ground.snow", 0xf4f6fa)?,
        shore: real(&given.shore, "ground.shore", 0.02)?,
        snow_line: real(&given.snow_line, "ground.snow_line", 0.5)?,
        steep: unit(&given.steep, "ground.steep", Unit::from_num(0.7))?,
        passage: unit(&given.passage, "ground.passage", Unit::from_num(0.1))?,
        ragged: (grain, unit(&given.ragged, "ground.ragged", Unit::from_num(0.1))?),
    })
}

fn level(source: &Source, given: &Level) -> Result<Floor, Fail> {
    Ok(Floor {
        level: given.level.as_ref().map_or(Ok(Real::ZERO), |level| source.fixed(level, "plain.level"))?,
        color: light_or(source, given.color.as_ref(), "plain.color", code(0x1c3a50))?,
        reflect: light_or(source, given.reflect.as_ref(), "plain.reflect", Rgb::BLACK)?,
    })
}

fn sun(source: &Source, given: Option<&Sun>) -> Result<(Vec3, Rgb), Fail> {
    let usual = Rgb::new(Lumen::ONE, Lumen::from_num(0.94), Lumen::from_num(0.84));
    let Some(sun) = given else {
        return Ok((Vec3::new(Real::from_num(-3), Real::from_num(-1), Real::from_num(2)), usual));
    };
    let towards = vector(source, &sun.towards, "sun.towards")?;
    attractor::trace::world::Lamp::distant(towards, usual)
        .map_err(|error| source.fail(sun.towards.span(), "sun.towards", error))?;
    let color = match &sun.color {
        Some(color) => light(source, color, "sun.color", 16)?,
        None => usual,
    };
    Ok((towards, color))
}

fn sky(source: &Source, given: &Heaven) -> Result<Sky, Fail> {
    Ok(Sky {
        zenith: light_or(source, given.zenith.as_ref(), "sky.zenith", code(0x3a6ab0))?,
        horizon: light_or(source, given.horizon.as_ref(), "sky.horizon", code(0xc4d4e4))?,
        nadir: light_or(source, given.nadir.as_ref(), "sky.nadir", code(0x807c78))?,
    })
}
