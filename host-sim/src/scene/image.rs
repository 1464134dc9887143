//! `kind = "image"`: an encoded picture, decoded in one pass or by sweeps, or a PNG file as it is.

use std::convert::Infallible;
use std::path::Path;

use attractor::codec::{Header, Planes, Profile, check, open};
use attractor::plane::from_fn;
use attractor_gallery::{Frames, ImagePicture, PAPER, Tones, Watch, draw_field, ground};
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::Point;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor as _};
use serde::Deserialize;
use toml::Spanned;

use super::request::Request;
use crate::builtin;
use crate::color::Depth;
use crate::decode;
use crate::fail::Fail;
use crate::palette::Named;
use crate::source::{Place, Source};
use crate::still::{Pixels, Still};
use crate::table::Csv;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(rename = "kind")]
    _kind: String,
    #[serde(rename = "title")]
    _title: Option<String>,
    file: Option<Spanned<String>>,
    stream: Option<Spanned<String>>,
    sweeps: Option<Spanned<Sweeps>>,
    palette: Option<Spanned<Named>>,
    range: Option<Spanned<[u32; 2]>>,
}

/// One frame or several.
#[derive(Debug, Deserialize)]
#[serde(untagged, expecting = "sweeps are a whole number, 0 to 8, or several that grow: [0, 1, 2, 3, 4]")]
enum Sweeps {
    One(i64),
    Several(Vec<i64>),
}

/// The most sweeps; a stream says at most so many.
const MOST: u32 = 8;

/// What is shown.
#[derive(Debug)]
pub(crate) enum Shown {
    Stream(Vec<u8>, Header),
    Still(Still),
}

/// A picture ready to be drawn.
#[derive(Debug)]
pub(crate) struct ImageScene {
    pub(crate) shown: Shown,
    pub(crate) sweeps: Vec<u32>,
    pub(crate) tones: Option<Tones>,
    place: Place,
}

impl ImageScene {
    pub(super) fn load(source: &Source) -> Result<Self, Fail> {
        let file: File = source.parse()?;
        let (shown, place) = match (&file.stream, &file.file) {
            (Some(name), None) => {
                let place = source.place(name.span(), "stream");
                let streams = builtin::STREAMS.iter();
                let Some((_, bytes)) = streams.clone().find(|(known, _)| known == name.get_ref()) else {
                    let names: Vec<&str> = streams.map(|(name, _)| *name).collect();
                    return Err(place.fail(format_args!("built in are {}", names.join(", "))));
                };
                (stream(bytes.to_vec(), &place)?, place)
            }
            (None, Some(path)) => {
                let place = source.place(path.span(), "file");
                let Some(beside) = source.beside(path.get_ref()) else {
                    return Err(place.fail("a scene that is built in names a stream that is"));
                };
                (read(&beside, &place)?, place)
            }
            (Some(_), Some(path)) => {
                return Err(source.fail(path.span(), "file", "a stream is named as well"));
            }
            (None, None) => {
                let reason = "missing: a file of an encoded picture or a PNG file, or a built-in stream";
                return Err(source.fail_all("file", reason));
            }
        };
        let sweeps = file.sweeps.as_ref().map(|sweeps| wanted(source, sweeps, &shown)).transpose()?;
        let tones = tones(source, &file, &shown)?;
        Ok(Self { shown, sweeps: sweeps.unwrap_or_default(), tones, place })
    }

    pub(super) fn draw<D>(&self, request: &Request, target: &mut D, watch: Watch<'_, D>) -> Result<(), Fail>
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        let size = request.size;
        let (stream, header) = match &self.shown {
            Shown::Stream(bytes, header) => (bytes, header),
            Shown::Still(still) => {
                self.still(still, request, target, watch);
                return Ok(());
            }
        };
        let picture = ImagePicture { stream, sweeps: &self.sweeps, tones: self.tones };
        let drawn = picture.frames(size).and_then(|frames| {
            let samples = open(stream.iter().copied())?.samples(frames.scale);
            if header.deep {
                picture.draw(size, target, &mut vec![0_u16; samples], watch)
            } else {
                picture.draw(size, target, &mut vec![0_u8; samples], watch)
            }
        });
        drawn.map_err(|error| self.place.fail_at(size, error))
    }

    /// A PNG file: nearest pixels where it is scaled.
    fn still<D>(&self, still: &Still, request: &Request, target: &mut D, watch: Watch<'_, D>)
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        let frames = Frames::new(still.size, request.size, 1);
        let (seen, at) = frames.at(0);
        let paper = ground::<D::Color>(PAPER);
        let color = |x: u32, y: u32| {
            let p = Point::new(x as i32, y as i32) - at + seen.top_left;
            if !seen.contains(p) {
                return paper;
            }
            let whole = |v: i32, most: u32| {
                let v = v.unsigned_abs();
                (if frames.scale >= 0 { v >> frames.scale } else { v << -frames.scale }).min(most - 1)
            };
            let at = whole(p.y, still.size.height) * still.size.width + whole(p.x, still.size.width);
            self.color(still, at as usize)
        };
        draw_field(from_fn(request.size, color), |rgb: Rgb888| rgb, target, watch);
    }

    /// Of a PNG file's pixel.
    fn color(&self, still: &Still, at: usize) -> Rgb888 {
        let grey = |sample: u16, peak: u32| {
            let tones = self.tones.unwrap_or(Tones { palette: Named::Grey, range: [0, peak] });
            tones.color(sample.into())
        };
        match &still.pixels {
            Pixels::Grey(samples) => grey(samples[at].into(), 255),
            Pixels::Deep(samples) => grey(samples[at], 65535),
            Pixels::Colour(pixels) => Rgb888::new(pixels[at][0], pixels[at][1], pixels[at][2]),
        }
    }

    /// `x,y,luma,orange,green` of the first pixels after the last sweep, or `x,y,r,g,b` of a PNG file.
    pub(super) fn sample(&self, points: u32, out: &mut Csv) -> Result<(), Fail> {
        let (pixels, width, head) = match &self.shown {
            Shown::Stream(bytes, _) => {
                let (pixels, size) =
                    decode::samples(bytes, self.sweeps.last().copied()).map_err(|e| self.place.fail(e))?;
                (pixels, size.width, ["luma", "orange", "green"])
            }
            Shown::Still(still) => {
                let count = (still.size.width * still.size.height).min(points) as usize;
                let rgb = |at| {
                    let color = self.color(still, at);
                    [color.r(), color.g(), color.b()].map(u16::from)
                };
                ((0..count).map(rgb).collect(), still.size.width, ["r", "g", "b"])
            }
        };
        out.write_record(["x", "y"].iter().chain(&head))?;
        for (i, [a, b, c]) in (0..points).zip(pixels) {
            let numbers = [i % width, i / width, a.into(), b.into(), c.into()];
            out.write_record(numbers.map(|n| n.to_string()))?;
        }
        Ok(())
    }
}

/// A file of either kind, told by its name.
fn read(path: &Path, place: &Place) -> Result<Shown, Fail> {
    let ends_in = |end: &str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(end));
    if ends_in("atfi") {
        return stream(decode::read(path).map_err(|reason| place.fail(reason))?, place);
    }
    if !ends_in("png") {
        return Err(place.fail("a picture is an .atfi file or a .png file"));
    }
    Still::load(path, Rgb888::WHITE).map(Shown::Still).map_err(|fail| match fail {
        Fail::Message(message) => place.fail(message),
        pipe => pipe,
    })
}

fn stream(bytes: Vec<u8>, place: &Place) -> Result<Shown, Fail> {
    let header = check(&bytes).map_err(|error| place.fail(error))?;
    Ok(Shown::Stream(bytes, header))
}

/// The sweeps after which a picture is shown.
fn wanted(source: &Source, sweeps: &Spanned<Sweeps>, shown: &Shown) -> Result<Vec<u32>, Fail> {
    let refused = |reason: &str| Err(source.fail(sweeps.span(), "sweeps", reason));
    match shown {
        Shown::Still(_) => return refused("a PNG file has none: `attractor encode --profile iterated`"),
        Shown::Stream(_, header) if header.profile == Profile::Streaming => {
            return refused("this stream is decoded in one pass, profile streaming");
        }
        Shown::Stream(..) => {}
    }
    let given = match sweeps.get_ref() {
        Sweeps::One(count) => std::slice::from_ref(count),
        Sweeps::Several(counts) => counts,
    };
    let counts: Vec<u32> =
        given.iter().filter_map(|n| u32::try_from(*n).ok().filter(|n| *n <= MOST)).collect();
    if counts.is_empty() || counts.len() < given.len() || !counts.is_sorted_by(|a, b| a < b) {
        return refused(&format!("allowed is 0 to {MOST}, or several that grow: [0, 1, 2, 3, 4]"));
    }
    Ok(counts)
}

/// The colours of a grey picture.
fn tones(source: &Source, file: &File, shown: &Shown) -> Result<Option<Tones>, Fail> {
    let (is_grey, peak) = match shown {
        Shown::Stream(_, header) => (header.planes == Planes::Grey, if header.deep { 65535 } else { 255 }),
        Shown::Still(still) => (!matches!(still.pixels, Pixels::Colour(_)), still.peak()),
    };
    let given = [
        file.palette.as_ref().map(|palette| (palette.span(), "palette")),
        file.range.as_ref().map(|range| (range.span(), "range")),
    ];
    if let Some((span, key)) = given.into_iter().flatten().next().filter(|_| !is_grey) {
        return Err(source.fail(span, key, "the picture has colours of its own"));
    }
    let palette = file.palette.as_ref().map_or(Named::Grey, |palette| *palette.get_ref());
    let range = match &file.range {
        None if file.palette.is_none() => return Ok(None),
        None => [0, peak],
        Some(range) => {
            let [low, high] = *range.get_ref();
            if low >= high || high > peak {
                let reason = format!("allowed is [darkest, brightest], growing, at most {peak}");
                return Err(source.fail(range.span(), "range", reason));
            }
            [low, high]
        }
    };
    Ok(Some(Tones { palette, range }))
}
