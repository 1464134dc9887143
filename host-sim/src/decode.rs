//! `attractor decode`: a stream of core's codec as a PNG file.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use attractor::Error;
use attractor::codec::{Header, Part, Planes, Profile, Sample, check, open};
use attractor::draw::{Grey, Palette as _, Picture, YCoCg};
use attractor::plane::Field;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::image::Image;
use embedded_graphics::pixelcolor::RgbColor as _;
use embedded_graphics::prelude::*;
use embedded_graphics_simulator::SimulatorDisplay;

use crate::canvas;
use crate::cli::{Decode, MAX_PIXELS};
use crate::color::{Depth, with_depth};
use crate::fail::Fail;
use crate::output;
use crate::still::{Pixels, Still};

/// Decodes a whole stream, `2^scale` times as large, with as many sweeps as asked for, or as its header says.
pub(crate) fn decoded(bytes: &[u8], scale: i32, sweeps: Option<u32>) -> Result<Still, Error> {
    let header = check(bytes)?;
    let (planes, size) = if header.deep {
        all_planes::<u16>(bytes, scale, sweeps)?
    } else {
        all_planes::<u8>(bytes, scale, sweeps)?
    };
    Ok(still(&header, planes, size))
}

/// The picture of luma and chroma.
fn still(header: &Header, planes: Vec<[u16; 3]>, size: Size) -> Still {
    let narrow = |v: u16| v as u8;
    let pixels = match (header.planes, header.deep) {
        (Planes::Grey, true) => Pixels::Deep(planes.into_iter().map(|[luma, ..]| luma).collect()),
        (Planes::Grey, false) => Pixels::Grey(planes.into_iter().map(|[luma, ..]| narrow(luma)).collect()),
        _ => {
            let rgb = |pixel: [u16; 3]| {
                let color = if header.deep { YCoCg.rgb(pixel) } else { YCoCg.rgb(pixel.map(narrow)) };
                [color.r(), color.g(), color.b()]
            };
            Pixels::Colour(planes.into_iter().map(rgb).collect())
        }
    };
    Still { size, pixels }
}

/// Luma and chroma of every pixel.
fn all_planes<S: Sample + Default + Into<u16>>(
    bytes: &[u8],
    scale: i32,
    sweeps: Option<u32>,
) -> Result<(Vec<[u16; 3]>, Size), Error> {
    let opened = open(bytes.iter().copied())?;
    let mut memory = vec![S::default(); opened.samples(scale)];
    let mut all = Vec::new();
    let mut add = |part: Part<'_, S>| {
        let size = part.size();
        for y in 0..size.height {
            all.extend(part.row(y, 0..size.width).map(|pixel| pixel.map(Into::into)));
        }
    };
    let size;
    if opened.header().profile == Profile::Streaming {
        let mut stream = opened.stream(scale, &mut memory)?;
        size = stream.size();
        while let Some(band) = stream.next_band()? {
            add(band);
        }
    } else {
        let wanted = sweeps.unwrap_or(u32::from(opened.header().reach));
        let mut iterated = opened.sweeps(scale, &mut memory)?;
        size = iterated.size();
        for _ in 0..wanted {
            iterated.sweep()?;
        }
        add(iterated.picture());
    }
    Ok((all, size))
}

/// Luma and chroma of every pixel, and the size.
pub(crate) fn samples(bytes: &[u8], sweeps: Option<u32>) -> Result<(Vec<[u16; 3]>, Size), Error> {
    if check(bytes)?.deep { all_planes::<u16>(bytes, 0, sweeps) } else { all_planes::<u8>(bytes, 0, sweeps) }
}

/// A whole stream, and its planes as they lie, for an encoder that takes its domains from them.
pub(crate) fn decoded_with_planes(bytes: &[u8]) -> Result<(Still, Vec<Vec<u16>>), Error> {
    let header = check(bytes)?;
    let (pixels, size) = samples(bytes, None)?;
    let count = if header.planes == Planes::Grey { 1 } else { 3 };
    let plane = |index: u32| {
        let step = 1 << header.halved(index);
        let places =
            (0..size.height).step_by(step).flat_map(|y| (0..size.width).step_by(step).map(move |x| (x, y)));
        places.map(|(x, y)| pixels[(y * size.width + x) as usize][index as usize]).collect()
    };
    let planes = (0..count).map(plane).collect();
    Ok((still(&header, pixels, size), planes))
}

/// The most bytes that are read of a file.
const LONGEST: u64 = 1 << 26;

/// The bytes of a file, or why not; of one without an end no more than a picture takes.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let read = File::open(path).and_then(|file| file.take(LONGEST + 1).read_to_end(&mut bytes));
    match read {
        Err(error) => Err(format!("{}: {error}", path.display())),
        Ok(_) if bytes.len() as u64 > LONGEST => {
            Err(format!("{}: it is longer than {LONGEST} bytes", path.display()))
        }
        Ok(_) => Ok(bytes),
    }
}

/// The bytes of a stream, read and checked.
pub(crate) fn load(path: &Path) -> Result<(Vec<u8>, Header), Fail> {
    let bytes = read(path).map_err(Fail::new)?;
    let header = check(&bytes).map_err(|error| Fail::new(format_args!("{}: {error}", path.display())))?;
    Ok((bytes, header))
}

/// Reads a stream and writes what it shows.
pub(crate) fn run(args: &Decode) -> Result<(), Fail> {
    let goal = args.output.clone().unwrap_or_else(|| args.file.with_extension("png"));
    let (bytes, header) = load(&args.file)?;
    if args.sweeps.is_some() && header.profile == Profile::Streaming {
        let file = args.file.display();
        return Err(Fail::new(format_args!("--sweeps: {file} is decoded in one pass, profile streaming")));
    }
    let scaled = |side: u32| u64::from(side).unbounded_shl(args.scale.max(0) as u32) >> (-args.scale).max(0);
    if scaled(header.size.width) * scaled(header.size.height) > MAX_PIXELS {
        return Err(Fail::new(format_args!("--scale: more than {MAX_PIXELS} pixels")));
    }
    match &args.output {
        Some(named) => output::check_png(named)?,
        None => output::vacant(&goal)?,
    }
    output::check_beside(&goal, [&*args.file])?;
    let picture = decoded(&bytes, args.scale, args.sweeps)
        .map_err(|error| Fail::new(format_args!("{}: {error}", args.file.display())))?;
    let png = match args.color {
        None => picture.png(),
        Some(color) => with_depth!(color, shown, &picture),
    };
    let png = png.map_err(|error| Fail::new(format_args!("{}: {error}", goal.display())))?;
    output::write(&goal, &png)
}

/// The picture on a display of colour `C`, as a PNG file.
fn shown<C: Depth>(still: &Still) -> Result<Vec<u8>, png::EncodingError> {
    let mut display = SimulatorDisplay::<C>::new(still.size);
    let Ok(()) = match &still.pixels {
        Pixels::Grey(grey) => {
            let field =
                attractor::plane::from_fn(still.size, |x, y| grey[(y * still.size.width + x) as usize]);
            Image::new(&Picture::new(field, Grey), Point::zero()).draw(&mut display)
        }
        Pixels::Deep(grey) => {
            let field =
                attractor::plane::from_fn(still.size, |x, y| grey[(y * still.size.width + x) as usize]);
            Image::new(&Picture::new(field, Grey), Point::zero()).draw(&mut display)
        }
        Pixels::Colour(rgb) => {
            let field =
                attractor::plane::from_fn(still.size, |x, y| rgb[(y * still.size.width + x) as usize]);
            let palette = |[r, g, b]: [u8; 3]| embedded_graphics::pixelcolor::Rgb888::new(r, g, b);
            Image::new(&Picture::new(field, palette), Point::zero()).draw(&mut display)
        }
    };
    canvas::png(&display, 1)
}
