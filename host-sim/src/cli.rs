//! The command line.

use std::io::{self, Write as _};
use std::path::PathBuf;
use std::process::ExitCode;

use attractor::num::Wide;
use attractor::plane::MAX_SIDE;
use attractor::trace::material::Tabulated;
use attractor_gallery::Named;
use clap::{Args, Parser, Subcommand, ValueEnum};
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Rgb888;

use crate::color::ColorDepth;
use crate::number::nearest;

/// The most points of a sample or of a chaos game.
pub(crate) use attractor_gallery::MAX_POINTS;
/// The most pixels of a file.
pub(crate) const MAX_PIXELS: u64 = 1 << 26;

/// Fractals for small displays, in fixed point.
///
/// Shows on this machine, bit for bit, what a microcontroller shows on its display. Without a command: what
/// there is.
#[derive(Debug, Parser)]
#[command(name = "attractor", version, after_help = EXAMPLES)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

const EXAMPLES: &str = "Examples:
  attractor dump                                the gallery: every built-in scene as out/NAME.png
  attractor dump fern mandelbrot -o pictures    two of them
  attractor dump my-scene.toml -o my-scene.png --size 128x64 --color mono --scale 4
  attractor sample figure-1-f --points 1000 > f.csv
  attractor accuracy";

/// Used twice: at the end of the help, and when a window opens.
macro_rules! keys {
    () => {
        "Keys
  arrows, W A S D    pan; on a surface, walk round it
  + -, wheel         zoom, about the mouse with the wheel; a click looks there
  [ ]                half as many iterations, twice as many
  I J K L            the first light of a surface or a world up, left, down, right
  R                  the scene as its file says, read again
  Enter              save what is shown as NAME-1.png, and print the lines of a scene file that come back here
  N P, Page keys     next scene, previous scene
  Esc                close"
    };
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Say what there is: scenes, kinds of scene files, commands
    List,
    /// Write scenes as PNG files, as the display would show them
    Dump(Dump),
    /// Write the numbers of a scene as CSV, with the f64 reference beside the fixed-point values
    Sample(Sample),
    /// Write a scene of any kind as a Rust module of constants, for firmware
    Export(Export),
    /// Write how a height field leans as a table of slopes: a material, constants, a picture
    Brdf(Brdf),
    /// Compress a PNG file into a stream that core's codec decodes
    Encode(Encode),
    /// Write what a stream shows as a PNG file
    Decode(Decode),
    /// Say what a stream is made of, and draw its partition
    Inspect(Inspect),
    /// Measure the kernels against the f64 reference, beside the bounds that they promise
    Accuracy(Accuracy),
    /// Measure the dimension of an attractor, a curve or a graph, with theory beside it
    Dimension(Dimension),
    /// Measure the spectral exponent of a graph or a random curve, with theory beside it
    Spectrum(Spectrum),
    /// Fit a surface by control points to a grid of elevations, and write it as a scene file
    Fit(crate::reconstruction::Fit),
    /// Show scenes in a window, row by row as they are computed (feature `window`)
    Window(Window),
}

/// What every picture needs.
#[derive(Debug, Args)]
pub(crate) struct Look {
    /// Size of the display in pixels
    #[arg(long, allow_hyphen_values = true, value_name = "WxH", default_value = "240x240", value_parser = parse_size)]
    pub(crate) size: Size,
    /// Colour of the display
    #[arg(long, value_name = "DEPTH", default_value = "rgb565")]
    pub(crate) color: ColorDepth,
    /// Side of a pixel of the display in pixels of the file or the window
    #[arg(long, allow_hyphen_values = true, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=64))]
    pub(crate) scale: u32,
    /// Seed of the chaos game and of jittered samples
    #[arg(long, allow_hyphen_values = true, value_name = "N", default_value_t = 1)]
    pub(crate) seed: u64,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  attractor dump                          the gallery, into out/
  attractor dump --all -o gallery --size 128x64 --color mono
  attractor dump fern -o fern.png --scale 2
  attractor dump fern -o - | viewer       the PNG file on standard output
  attractor dump path/to/scene.toml       a scene file: `attractor list` names its kinds and keys

Each file written is named on standard output. A file is complete or not there at all; one that is replaced keeps its permissions.")]
pub(crate) struct Dump {
    /// Names of built-in scenes, or paths of TOML files; none means all built-in ones
    #[arg(value_name = "SCENE")]
    pub(crate) scenes: Vec<String>,
    /// All built-in scenes, besides those named
    #[arg(long)]
    pub(crate) all: bool,
    /// A file ending in .png for one scene, - for standard output, else a directory; directories are made if
    /// they are not there [default: out]
    #[arg(short, long, value_name = "FILE.png|DIR|-")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) look: Look,
}

#[derive(Debug, Args)]
#[command(after_help = "Columns:
  fif-curve            x,fixed,reference,error at x_i = x_0 + i (x_N - x_0) / (N - 1)
  fif-surface          x,y,height,nx,ny,nz,height_reference,nx_reference,ny_reference,nz_reference on a grid of about N points
                       --pixels: i,j,found,filtered,sampled,one for every pixel of --size: its tone with the normals integrated
                       (where [filter] says so), by the samples, and by the ray through its centre alone
  patch-surface        x,y,height,reference on a grid of about N points; --pixels of a lattice with a material: as fif-surface
  curve, random-curve  x,y of the first N vertices; where they stop at a pixel, --size counts
  l-system, patch-curve
                       x,y of N points
  ifs                  x,y of N points of the chaos game
  copier               x,y of the first N vertices of the last order
  julia-set            x,y of the first N points, or of the first N pixels that the set meets
  mandelbrot, julia    re,im,dwell,reference for every pixel of --size; no reference for a deep zoom
  world                --pixels: i,j,r,g,b of every pixel of --size, linear light before it is dithered, beside the reference's
                       r_reference,g_reference,b_reference (of many samples or superellipsoids slow: a small --size); so without an option
                       --rays FILE: ray,crossing,t,object,face,enters,x,y,z,nx,ny,nz,u,v,t_reference, every crossing of every object
                       --along RAY: t and the inside-outside function of each object at N places of a ray
                       --at FILE: place,texture,x,y,z,r,g,b and the reference's, each texture at places
  terrain              u,v,height of about N knots of the finest lattice
  image                x,y and the samples of the first N pixels: luma,orange,green of a stream, r,g,b of a PNG file
  texture              --at FILE: the same of the one texture; else i,j,r,g,b of every pixel of --size and the reference's

Fixed-point numbers are printed exactly, those of the reference with the digits that give the same f64 back.
An abscissa is a multiple of 2^-48 and an f64. The reference of a function passes through the knots that the format has,
and its error is that of the value at x: where the partition is not dyadic, a rough function may differ by more than the
`error_bound` of `accuracy`, which then holds for an abscissa within 2^-40 of the domain from x.")]
pub(crate) struct Sample {
    /// Name of a built-in scene, or path of a TOML file
    #[arg(value_name = "SCENE")]
    pub(crate) scene: String,
    /// How many points; mandelbrot and julia take --size instead
    #[arg(long, allow_hyphen_values = true, value_name = "N", default_value_t = 1000,
          value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_POINTS)))]
    pub(crate) points: u32,
    /// Size of the picture whose pixels are listed
    #[arg(long, allow_hyphen_values = true, value_name = "WxH", default_value = "240x240", value_parser = parse_size)]
    pub(crate) size: Size,
    /// Of a world: every crossing of the rays in a CSV file of lines ox,oy,oz,dx,dy,dz
    #[arg(long, value_name = "FILE", group = "question")]
    pub(crate) rays: Option<PathBuf>,
    /// Of a world: the inside-outside functions along a ray
    #[arg(long, allow_hyphen_values = true, value_name = "ox,oy,oz,dx,dy,dz", group = "question")]
    pub(crate) along: Option<String>,
    /// Of a world or a texture: the textures at the places in a CSV file of lines x,y,z
    #[arg(long, value_name = "FILE", group = "question")]
    pub(crate) at: Option<PathBuf>,
    /// Of a world or a texture: the linear light of every pixel of --size
    #[arg(long, group = "question")]
    pub(crate) pixels: bool,
}

#[derive(Debug, Args)]
#[command(
    after_help = "The numbers are the bits that the command itself draws with; functions make core's objects of them, and say how much memory they borrow.

Examples:
  attractor export sunspots > src/sunspots.rs
  attractor export my-fern.toml > src/my_fern.rs
  attractor export --all -o src/scenes        a module for each built-in scene, and mod.rs

What is not in `attractor` itself, margins, paper and lines that change their colour, is in the crate `attractor-gallery`: --gallery."
)]
pub(crate) struct Export {
    /// Name of a built-in scene, or path of a TOML file
    #[arg(value_name = "SCENE", required_unless_present = "all", conflicts_with = "all")]
    pub(crate) scene: Option<String>,
    /// All built-in scenes, into the directory --output
    #[arg(long, requires = "output")]
    pub(crate) all: bool,
    /// The directory of --all; it is made if it is not there
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,
    /// Also what the crate attractor-gallery draws the scene with, as the command shows it
    #[arg(long)]
    pub(crate) gallery: bool,
}

#[derive(Debug, Args)]
#[command(
    after_help = "The table holds `side x side` squares of slopes (p, q) of the surface around their mean, from -reach to reach along each axis,
alike for opposite slopes. In a world it is a material of any shape: [material.NAME] distribution = \"FILE.toml\".
The picture shows it: p to the right, q upwards, brightness the square root of the weight.

Examples:
  attractor brdf figure-6-gg -o gg.toml                 for a scene
  attractor brdf figure-6-gg -o gg.rs -o gg.png         for firmware, and a picture
  attractor brdf figure-6-gg --region 0,0.5,0,0.5 -o corner.toml

Each file written is named on standard output. A file is complete or not there at all."
)]
pub(crate) struct Brdf {
    /// Name of a built-in scene, or path of a TOML file, of kind fif-surface
    #[arg(value_name = "SCENE")]
    pub(crate) scene: String,
    /// What is written, by its ending: a table .toml, a table as Rust .rs, a picture .png; several times, if
    /// one likes
    #[arg(short, long, value_name = "FILE", required = true)]
    pub(crate) output: Vec<PathBuf>,
    /// Squares along a side
    #[arg(long, allow_hyphen_values = true, value_name = "N", default_value_t = 32,
          value_parser = clap::value_parser!(u16).range(2..=i64::from(Tabulated::MOST)))]
    pub(crate) side: u16,
    /// The largest slope, 1/8 to 8, in 256ths: steeper ones count where the table ends
    #[arg(long, allow_hyphen_values = true, value_name = "SLOPE", default_value = "2",
          value_parser = parse_reach)]
    pub(crate) reach: u16,
    /// Places along each axis, by which slopes are counted
    #[arg(long, allow_hyphen_values = true, value_name = "N", default_value_t = 4096,
          value_parser = clap::value_parser!(u32).range(64..=16384))]
    pub(crate) points: u32,
    /// The part of the surface that counts; else all of it
    #[arg(long, allow_hyphen_values = true, value_name = "x0,x1,y0,y1", value_parser = parse_region)]
    pub(crate) region: Option<[Wide; 4]>,
    /// Colours of a picture
    #[arg(long, value_name = "PALETTE", default_value = "fire", value_parser = parse_palette)]
    pub(crate) palette: Named,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  attractor encode photograph.png -o photograph.atfi --bpp 0.25
  attractor encode photograph.png -o small.atfi --bytes 1000 --profile iterated
  attractor encode heights.png -o heights.atfi --psnr 60        a grey PNG of 16 bits too

The format is written down in docs/IMAGE-FORMAT.md. A file has at most the bytes asked for, at least 99 per cent of them, or at least the decibels; what is out of reach is said.")]
#[command(group(clap::ArgGroup::new("target").required(true)))]
pub(crate) struct Encode {
    /// A PNG file: grey of 1 to 16 bits, colour or palette of 8 bits; no animation
    #[arg(value_name = "IMAGE.png")]
    pub(crate) image: PathBuf,
    /// The stream
    #[arg(short, long, value_name = "FILE.atfi")]
    pub(crate) output: PathBuf,
    /// How many bytes it may have, header and checksum included
    #[arg(long, allow_hyphen_values = true, value_name = "N", group = "target", value_parser = bytes)]
    pub(crate) bytes: Option<u64>,
    /// How many bits a pixel
    #[arg(long, allow_hyphen_values = true, value_name = "X", group = "target", value_parser = bits_a_pixel)]
    pub(crate) bpp: Option<f64>,
    /// How many decibels of peak signal to noise
    #[arg(long, allow_hyphen_values = true, value_name = "DB", group = "target", value_parser = decibels)]
    pub(crate) psnr: Option<f64>,
    /// How it is decoded
    #[arg(long, value_name = "PROFILE", default_value = "streaming")]
    pub(crate) profile: EncodeProfile,
    /// How many sweeps a decoder may need; fewer leave fewer domains to choose from [default: 4, pure: 8]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=8))]
    pub(crate) sweeps: Option<u8>,
    /// How hard to look for domains
    #[arg(long, value_name = "EFFORT", default_value = "best")]
    pub(crate) effort: EncodeEffort,
    /// Keep all samples of chroma instead of every fourth
    #[arg(long)]
    pub(crate) full_chroma: bool,
    /// Leave out a part of the codec, to see what it is worth
    #[arg(long, value_name = "PART")]
    pub(crate) without: Option<EncodePart>,
    /// What transparent pixels are laid on
    #[arg(long, value_name = "#rrggbb", default_value = "#ffffff", value_parser = parse_color)]
    pub(crate) ground: Rgb888,
}

/// How a stream is decoded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum EncodeProfile {
    /// In one pass, in a window of 64 rows
    Streaming,
    /// By sweeps over the whole picture
    Iterated,
    /// By sweeps, of contractive maps alone
    Pure,
}

/// A part of the codec.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum EncodePart {
    /// Squares copy from nowhere
    Domains,
    /// No coefficients: means and domains alone
    Transform,
    /// All squares are 8 x 8
    Split,
}

/// How hard to look for domains.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum EncodeEffort {
    /// Near each square, as they are
    Fast,
    /// Near and far, turned and mirrored
    Best,
}

#[derive(Debug, Args)]
pub(crate) struct Decode {
    /// The stream
    #[arg(value_name = "FILE.atfi")]
    pub(crate) file: PathBuf,
    /// The picture [default: FILE.png, if no such file is there]
    #[arg(short, long, value_name = "FILE.png")]
    pub(crate) output: Option<PathBuf>,
    /// How large: 1/4, 1/2, 1, 2 or 4
    #[arg(long, value_name = "SCALE", default_value = "1", allow_hyphen_values = true, value_parser = parse_scale)]
    pub(crate) scale: i32,
    /// How many sweeps, from a black picture [default: as the stream says]
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = clap::value_parser!(u32).range(0..=64))]
    pub(crate) sweeps: Option<u32>,
    /// The display that it is shown on [default: the samples as they are]
    #[arg(long, value_name = "DEPTH")]
    pub(crate) color: Option<ColorDepth>,
}

#[derive(Debug, Args)]
pub(crate) struct Inspect {
    /// The stream
    #[arg(value_name = "FILE.atfi")]
    pub(crate) file: PathBuf,
    /// A picture of the partition: squares with a domain are red
    #[arg(short, long, value_name = "FILE.png")]
    pub(crate) output: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct Accuracy {
    /// As CSV with all digits instead of a table
    #[arg(long)]
    pub(crate) csv: bool,
}

#[derive(Debug, Args)]
#[command(after_help = "What is measured:
  ifs, copier          the attractor: boxes of 64 to 512 a side
  curve                what the refinements tend to, whatever order is drawn: the same
  julia-set, julia     the Julia set, the boundary of the filled one: the same
  random-curve         chords: 2^k chords of mean length L, D = log 2^k / log(1/L) (Carpenter's similarity ratio), and boxes
  line-to-line, fif-curve    a graph: oscillations of columns above their chords

The error is the standard error of the fitted slope. The drift, the slope of the smaller sizes less that of the larger, shows what it does not know of.

Examples:
  attractor dimension koch-snowflake
  attractor dimension heighway-dragon --boundary
  attractor dimension carpenter-1 --csv > log-log.csv")]
pub(crate) struct Dimension {
    /// Name of a built-in scene, or path of a TOML file
    #[arg(value_name = "SCENE")]
    pub(crate) scene: String,
    /// Of the boundary of a set or a curve with an inside
    #[arg(long)]
    pub(crate) boundary: bool,
    /// The points of the fit as CSV: method,log_inverse_size,log_count (natural logarithms)
    #[arg(long)]
    pub(crate) csv: bool,
}

#[derive(Debug, Args)]
#[command(after_help = "The power falls as 1/f^beta; beta is fitted to the mean power of octaves.
  fif-curve            the ordinate
  line-to-line         the ordinate, mean power of 64 functions of the scene's law
  random-curve         both coordinates over the parameter, mean power of 64 curves of the scene's law

The error is the standard error of the fitted slope.

Examples:
  attractor spectrum elbow
  attractor spectrum mountain-line --csv > log-log.csv")]
pub(crate) struct Spectrum {
    /// Name of a built-in scene, or path of a TOML file
    #[arg(value_name = "SCENE")]
    pub(crate) scene: String,
    /// The points of the fit as CSV: log_frequency,log_power (natural logarithms)
    #[arg(long)]
    pub(crate) csv: bool,
}

/// What the window understands.
#[cfg_attr(not(feature = "window"), expect(dead_code, reason = "said when a window opens"))]
pub(crate) const KEYS: &str = keys!();

#[derive(Debug, Args)]
#[command(after_help = concat!(
    keys!(),
    "\n\nNeeds: apt install libsdl2-dev; cargo run --features window -- window SCENE"
))]
pub(crate) struct Window {
    /// Name of a built-in scene, or path of a TOML file
    #[arg(value_name = "SCENE")]
    pub(crate) scene: String,
    #[command(flatten)]
    pub(crate) look: Look,
}

/// No stream is longer.
fn bytes(text: &str) -> Result<u64, String> {
    let most = 1 << 28;
    match text.parse::<u64>() {
        Ok(number) if (1..=most).contains(&number) => Ok(number),
        _ => Err(format!("`{text}` is no whole number from 1 to {most}")),
    }
}

/// No picture has more bins.
fn bits_a_pixel(text: &str) -> Result<f64, String> {
    above_0(text, 64.0)
}

/// The last pixel of the largest picture of 16 bits that is off by 1 is 180.6 dB.
fn decibels(text: &str) -> Result<f64, String> {
    above_0(text, 180.0)
}

fn above_0(text: &str, most: f64) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number > 0.0 && number <= most => Ok(number),
        _ => Err(format!("`{text}` is no number above 0 and up to {most}")),
    }
}

/// A slope in 256ths.
fn parse_reach(text: &str) -> Result<u16, String> {
    let refused = || format!("`{text}` is no slope from 0.125 to 8");
    let slope = text.parse::<f64>().map_err(|_| refused())?;
    let words = (slope * 256.0).round();
    if (32.0..=2048.0).contains(&words) { Ok(words as u16) } else { Err(refused()) }
}

fn parse_region(text: &str) -> Result<[Wide; 4], String> {
    let refused = || "a region is x0,x1,y0,y1 with x0 < x1 and y0 < y1, for example 0,0.5,0,0.5".to_owned();
    let numbers = text.split(',').map(|number| nearest::<Wide>(number.trim()));
    let numbers = numbers.collect::<Result<Vec<_>, _>>().map_err(|_| refused())?;
    let region: [Wide; 4] = numbers.try_into().map_err(|_| refused())?;
    let [x0, x1, y0, y1] = region;
    if x0 < x1 && y0 < y1 { Ok(region) } else { Err(refused()) }
}

fn parse_palette(text: &str) -> Result<Named, String> {
    use serde::Deserialize as _;
    use serde::de::IntoDeserializer as _;
    Named::deserialize(text.into_deserializer()).map_err(|error: serde::de::value::Error| error.to_string())
}

/// A power of two from 1/4 to 4, as its logarithm.
fn parse_scale(text: &str) -> Result<i32, String> {
    match text {
        "1/4" => Ok(-2),
        "1/2" => Ok(-1),
        "1" => Ok(0),
        "2" => Ok(1),
        "4" => Ok(2),
        _ => Err("allowed are 1/4, 1/2, 1, 2 and 4".to_owned()),
    }
}

/// `#rrggbb`.
fn parse_color(text: &str) -> Result<Rgb888, String> {
    let digits = text.strip_prefix('#').filter(|digits| digits.len() == 6);
    let number = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok());
    number.map(attractor::draw::hex).ok_or_else(|| format!("`{text}` is no colour such as #ffffff"))
}

/// `WxH`, each side from 1 to [`MAX_SIDE`].
fn parse_size(text: &str) -> Result<Size, String> {
    let (width, height) = text.split_once('x').ok_or("a size is WxH, for example 240x240")?;
    let side = |name: &str, text: &str| match text.parse::<u64>() {
        Ok(side) if (1..=u64::from(MAX_SIDE)).contains(&side) => Ok(side as u32),
        Ok(side) => Err(format!("{name} is {side}, allowed is 1 to {MAX_SIDE}")),
        Err(_) => Err(format!("{name} is `{text}`, a number from 1 to {MAX_SIDE} is needed")),
    };
    let size = Size::new(side("width", width)?, side("height", height)?);
    if u64::from(size.width) * u64::from(size.height) > MAX_PIXELS {
        return Err(format!("more than {MAX_PIXELS} pixels"));
    }
    Ok(size)
}

/// Prints help where it was asked for; turns every other complaint of the parser into one line and exit
/// code 2.
pub(crate) fn explain(error: &clap::Error) -> ExitCode {
    if !error.use_stderr() {
        // help or version; nobody listening is no error
        return match error.print().and_then(|()| io::stdout().flush()) {
            Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
                crate::fail::say(&format!("standard output: {error}"));
                ExitCode::from(2)
            }
            _ => ExitCode::SUCCESS,
        };
    }
    let text = error.render().to_string();
    let lines = text.lines().map(str::trim).filter(|l| !l.is_empty());
    let lines: Vec<&str> = lines
        .take_while(|l| !l.starts_with("Usage:"))
        .filter(|l| !l.starts_with("For more information"))
        .collect();
    let line = lines.join("; ");
    crate::fail::say(&line.strip_prefix("error: ").unwrap_or(&line).replace(":; ", ": "));
    ExitCode::from(2)
}
