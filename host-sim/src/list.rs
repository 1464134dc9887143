//! `attractor list`: scenes, kinds of scene files, commands.

use std::io::Write as _;

use clap::CommandFactory as _;

use crate::builtin;
use crate::cli::Cli;
use crate::fail::Fail;
use crate::scene;
use crate::table;

const KINDS: &str = "\
Kinds of scene files (TOML); keys in brackets may be left out, every kind has [title]
  fif-curve    knots = [[x, y], ...], vertical_scaling = [a, ...], [polynomials], [integrate = times], [contractions = [map, ...]], [palette];
               [data] csv, x, y, [y_unit] instead of knots, the scalings then fitted
  fif-surface  [f] and [g] as above, height f(x) g(y); [camera] eye, look_at, [up], [field_of_view]; [light] direction;
               [material = \"diffuse\" | \"phong\" | \"mirror\"], [environment = \"gradient\" | \"checkerboard\" | \"plain\"],
               [gradient] zenith, horizon, nadir; [checkerboard] bright, dark, horizon, scale, fade; [samples], [depth], [palette]
  curve        curve = \"koch\" | ... or generator = [[x, y], ...] or turtle = \"F+F--F+F\" with angle = degrees;
               order = 5 or adaptive = true (down to a pixel), [base = [[x, y], ...]], [fill], [palette];
               letters of a turtle: F or A a copy of the curve, B walked from its end, a and b the same on the other side, + left, - right
  random-curve law = \"elbow\" | \"line-to-line\" | \"one-variable\" | \"two-variable\", [knots = [[x, y], ...] | coast = \"iceland\"], [extrapolate], [seed],
               [beta], [deviation], [offset], [ratio], [length | norm | parameter: where to stop], [fill], [palette]
  l-system     axiom = \"X\", rules = { X = \"F[+X]F[-X]+X\", F = \"FF\" }, angle = degrees, order = 5, [heading = 0: degrees, 90 is up], [palette];
               letters: F and G draw a step, f moves a step, + left, - right, | round, [ remember, ] return; other letters only rewrite
  copier       maps as ifs, or attractor = \"barnsley-fern\" | ..., [polyline = [[x, y], ...]], [orders = [0, 1, 2, 3, 4, 5, 6]], [palette]
  ifs          maps = [[a, b, c, d, e, f, p], ...], [points], [shading = \"maps\" | \"density\" | \"plain\"], [palette]
  mandelbrot   [centre = [\"re\", \"im\"]], [width = \"3.0\"], [max_dwell = 100], [palette], [lift], [cycle], [inside = \"#rrggbb\"],
               [coloring = \"dwell\" | \"smooth\" | \"distance\" | \"interior\"], [equalised], widths down to \"1e-100\",
               [grey] palette, lift, cycle, inside: the colours on displays without colour
  julia        c = [\"re\", \"im\"], and as mandelbrot
  julia-set    c = [\"re\", \"im\"], [points], [method = \"cover\" | \"plain\"], [palette]
  patch-curve  control_points = [[x, y], ...]; curve = \"bezier\" | \"b-spline\" | \"takagi\" | \"type-a\" ... \"type-f\" or maps = [[a, b], [c, d]];
               [levels = 11], [palette]
  patch-surface model = \"standard\" | \"tensor\" | \"lattice\", numbers = [72, 8 or 21], heights, [cells = 1], [height = 0.5];
               [camera] eye, look_at, [up], [field_of_view]; [light] direction; [samples = 1]; `attractor fit` writes it
  world        [camera] eye, look_at, [up], [field_of_view]; [[light]] towards or at, [color];
               [[object]] [name], shape = \"plane\" | \"square\" | \"polygon\" (points) | \"sphere\" | \"cube\" | \"polyhedron\" (planes = [[nx, ny, nz, d], ...]) |
               \"tapered-cylinder\" ([cap]) | \"torus\" (tube) | \"superellipsoid\" (n, m) | \"height-field\" (f, g) |
               \"union\" | \"intersection\" | \"difference\" (of = [names]);
               [scale], [rotate = [[x, y, z, degrees], ...]], [translate] or [matrix] of 12 numbers, [material = name or list, one a face];
               [material.NAME] color or texture, [ambient], [diffuse], [specular], [model = \"phong\" | \"torrance-sparrow\" | \"anisotropic\" | \"tabulated\"],
               [shininess] | [roughness], [reflectance] | [roughness], [across] | distribution = \"g-x-g\" | \"f-x-f\" | \"FILE.toml\", [reflectance]; [reflect]; [index], [transmit], [fresnel], [priority];
               [bump] and [frame] = { texture, strength }; [texture.NAME] as below; [environment] kind = \"plain\" | \"sky\" | \"checkerboard\" | \"image\";
               [samples = 1], [filter = \"box\" | \"gaussian\"], [seed], [depth = 5], [interpenetration = \"refuse\" | \"priority\"]; colours \"#rrggbb\" or [r, g, b]
  terrain      knots (rows from south to north) or [elevation] png, step, [window = [column, row, columns, rows]], [base], [void], [voids = \"refuse\" | \"fill\"];
               [offset], [similarity] (both from the data if left out), [seed], [surface = 0], [origin], levels, [inner = \"bilinear\" | \"ferguson\" | \"b-spline\"],
               [over = [[-1, 1], [-1, 1]]], [camera], [flight] eye, look_at, time; [sun] towards, color; [sky] zenith, horizon, nadir; [haze], [ambient], [samples = 2];
               [ground] color or [sand], [grass], [rock], [snow], [shore], [snow_line], [steep], [passage], [ragged], [grain]; [plain] [level], [color], [reflect];
               or mesh = \"edges\" | \"lattice\" | \"triangles\" ([near] eye, length), [palette]
  texture      [texture] kind = \"checker\" | \"noise\" | \"turbulence\" | \"wood\" | \"marble\" | \"facets\" | \"image\", [colors], [knots], [grain], [octaves], [seed], ...;
               [centre], [width = 4], [height = 0: the third coordinate, time]
  image        file = \"picture.atfi\" or \"picture.png\" (relative to the scene) or stream = \"camera-streaming\" | \"camera-iterated\" | \"camera-pure\" |
               \"camera-colour\" | \"jacksboro\"; [sweeps = 0 to 8, or [0, 1, 2, 3, 4]: frames from black], [palette], [range = [darkest, brightest]]
Palettes: course-unit, grey, dusk, fire, ocean, moss, even, porcelain
";

/// What every command takes, what it does: the command line's own words, so that none is missing.
fn commands() -> String {
    let mut all = Cli::command();
    // `help` among them, and their names with that of the program
    all.build();
    let mut text = "Commands\n".to_owned();
    for command in all.get_subcommands_mut().filter(|command| command.get_name() != "help") {
        let usage = command.render_usage().to_string();
        let usage = usage.split_whitespace().skip(1).collect::<Vec<_>>().join(" ");
        let about = command.get_about().map(ToString::to_string).unwrap_or_default();
        text += &format!("  {usage}\n      {about}\n");
    }
    text + "  attractor help COMMAND\n      All options, with examples\n"
}

/// Prints all of it.
pub(crate) fn run() -> Result<(), Fail> {
    let mut out = std::io::stdout().lock();
    writeln!(out, "attractor: fractals for small displays, in fixed point\n\nScenes")?;
    let scenes = builtin::SCENES.iter().map(|(name, _)| {
        let scene = scene::load(name)?;
        Ok([(*name).to_owned(), scene.kind().to_owned(), scene.title])
    });
    let scenes = scenes.collect::<Result<Vec<_>, Fail>>()?;
    table::columns(scenes, 3).lines().try_for_each(|line| writeln!(out, "  {line}"))?;
    write!(out, "\n{KINDS}\n{}", commands())?;
    Ok(())
}
