//! Bad input: one line that names file, key and value, exit code 2, nothing half-written.

use std::fs;

use insta::assert_snapshot;

use crate::common::{Said, attractor_in, bad, text};

const CURVE: &str =
    "kind = \"fif-curve\"\nknots = [[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]]\nvertical_scaling = [0.5, 0.5]\n";
const IFS: &str =
    "kind = \"ifs\"\nmaps = [\n  [0.5, 0, 0, 0.5, 0, 0, 0.5],\n  [0.5, 0, 0, 0.5, 0.5, 0, 0.5],\n]\n";
const MANDELBROT: &str =
    "kind = \"mandelbrot\"\ncentre = [\"-0.75\", \"0.1\"]\nwidth = \"0.5\"\nmax_dwell = 50\n";
const JULIA: &str = "kind = \"julia\"\nc = [\"-0.8\", \"0.156\"]\n";
const SURFACE: &str = "kind = \"fif-surface\"\nmaterial = \"mirror\"\nsamples = 1\n[f]\nknots = [[0, 0], [1, 1], [2, 0]]\nvertical_scaling = [0.5, 0.5]\nintegrate = 1\n\
    [g]\nknots = [[0, 0], [1, 1], [2, 0]]\nvertical_scaling = [0.5, 0.5]\nintegrate = 1\n[camera]\neye = [-3, -2, 5]\nlook_at = [1, 1, 1]\n";

/// All the same with good input, so that the tests below change one thing only.
#[test]
fn the_good_files_are_good() {
    for (i, scene) in [CURVE, IFS, MANDELBROT, JULIA, SURFACE, LATTICE].into_iter().enumerate() {
        let directory = tempfile::tempdir().unwrap();
        fs::write(directory.path().join("scene.toml"), scene).unwrap();
        crate::common::good(directory.path(), &["dump", "scene.toml", "-o", "out.png", "--size", "16x16"]);
        crate::common::good(directory.path(), &["sample", "scene.toml", "--size", "4x4"]);
        assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 2, "{i}");
    }
}

#[test]
fn knots_out_of_order_are_refused() {
    let mut said = Said::default();
    said.change(CURVE, "[1.0, 1.0]", "[2.5, 1.0]");
    said.change(CURVE, "[1.0, 1.0]", "[0.0, 1.0]");
    said.change(CURVE, "[[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]]", "[[1.0, 2.0]]");
    said.change(CURVE, "[[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]]", "[]");
    // different in 48 bits, one and the same f64
    said.change(
        CURVE,
        "[[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]]",
        "[[0, 0], [20000, 1], [20000.00000000000001, 2]]",
    );
    assert_snapshot!(said);
}

#[test]
fn scalings_of_1_or_more_are_refused() {
    let mut said = Said::default();
    for scaling in ["1.0", "1", "-1.0", "17", "0.99999999999999", "nan", "-inf", "1e300"] {
        said.change(CURVE, "[0.5, 0.5]", &format!("[0.5, {scaling}]"));
    }
    said.change(CURVE, "[0.5, 0.5]", "[0.5]");
    said.change(SURFACE, "[0.5, 0.5]", "[0.5, 1.5]");
    assert_snapshot!(said);
}

#[test]
fn numbers_outside_the_format_are_refused() {
    let mut said = Said::default();
    said.change(CURVE, "[1.0, 1.0]", "[1.0, 128.0]");
    said.change(CURVE, "[1.0, 1.0]", "[1.0, 1e12]");
    said.change(CURVE, "[2.0, 0.0]", "[1e5, 0.0]");
    said.change(CURVE, "[0.5, 0.5]", "[0.999, 0.999]");
    said.change(IFS, "0.5, 0, 0.5]", "1000, 0, 0.5]");
    said.change(MANDELBROT, "-0.75", "-32769");
    said.change(MANDELBROT, "\"0.5\"", "\"0\"");
    said.change(MANDELBROT, "\"0.5\"", "\"-3\"");
    let nowhere = MANDELBROT.replace("0.5", "1e-30");
    said.change(&nowhere, "centre = [\"-0.75\", \"0.1\"]\n", "");
    said.change(MANDELBROT, "\"0.5\"", "\"1e-130\"");
    said.change(MANDELBROT, "\"0.5\"", "\"1e-114\"");
    said.change(MANDELBROT, "\"0.5\"", "\"wide\"");
    said.change(MANDELBROT, "= 50", "= 0");
    said.change(MANDELBROT, "= 50", "= -1");
    said.change(MANDELBROT, "= 50", "= 1000000000");
    said.change(JULIA, "-0.8", "-2.5");
    said.change(SURFACE, "eye = [-3, -2, 5]", "eye = [-300, -2, 5]");
    said.change(SURFACE, "eye = [-3, -2, 5]", "eye = [1, 1, 1]");
    said.change(SURFACE, "samples = 1", "samples = 9");
    said.change(SURFACE, "samples = 1", "depth = 99");
    said.change(SURFACE, "look_at = [1, 1, 1]", "look_at = [1, 1, 1]\nfield_of_view = 170");
    said.change(SURFACE, "samples = 1", "samples = 1\n[light]\ndirection = [0, 0, 0]");
    said.change(SURFACE, "samples = 1", "samples = 1\n[checkerboard]\nscale = 1000");
    said.change(SURFACE, "samples = 1", "samples = 1\n[gradient]\nzenith = 1.5");
    assert_snapshot!(said);
}

#[test]
fn a_system_that_is_none_is_refused() {
    let mut said = Said::default();
    said.change(IFS, "0, 0, 0.5]", "0, 0, 0.4]");
    said.change(IFS, "0, 0, 0.5]", "0, 0, -0.5]");
    for none in ["0", "0.0", "\"1e-12\""] {
        said.change(IFS, "0, 0, 0.5]", &format!("0, 0, {none}]"));
    }
    said.change(IFS, "[0.5, 0, 0, 0.5, 0.5", "[1.0, 0, 0, 0.5, 0.5");
    said.change(IFS, "[0.5, 0, 0, 0.5, 0, 0, 0.5]", "[0.5, 0, 0, 0.5, 0, 0]");
    said.scene(b"kind = \"ifs\"\nmaps = []\n");
    said.change(IFS, "kind", "points = 0\nkind");
    said.change(IFS, "kind", "points = 1000000000\nkind");
    assert_snapshot!(said);
}

#[test]
fn unknown_keys_and_words_are_refused() {
    let mut said = Said::default();
    said.change(CURVE, "vertical_scaling", "vertical_scalings");
    said.change(CURVE, "\"fif-curve\"", "\"fif-curv\"");
    said.change(CURVE, "kind", "palette = \"pink\"\nkind");
    said.change(CURVE, "kind", "contractions = [1, 3]\nkind");
    said.change(CURVE, "knots", "integrate = 9\nknots");
    said.change(CURVE, "knots", "integrate = -1\nknots");
    said.change(SURFACE, "\"mirror\"", "\"velvet\"");
    said.change(SURFACE, "look_at", "looks_at");
    said.change(
        SURFACE,
        "knots = [[0, 0], [1, 1], [2, 0]]\nvertical_scaling = [0.5, 0.5]",
        "knots = [[0, 0], [1, 1]]\nvertical_scaling = [0.5]",
    );
    said.change(JULIA, "kind", "inside = \"red\"\nkind");
    said.change(MANDELBROT, "kind", "c = [\"0\", \"0\"]\nkind");
    said.change(CURVE, "vertical_scaling", "polynomials = [[0, 0.5], [1, 0.5]]\nvertical_scaling");
    said.change(CURVE, "vertical_scaling", "polynomials = [[0, 0.5]]\nvertical_scaling");
    assert_snapshot!(said);
}

const DATA: &str = "kind = \"fif-curve\"\n[data]\ncsv = \"d.csv\"\nx = \"t\"\ny = \"v\"\n";

/// What the command says about a table; nothing when it draws it.
fn said_of_data(csv: &[u8]) -> String {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("scene.toml"), DATA).unwrap();
    fs::write(directory.path().join("d.csv"), csv).unwrap();
    let output = attractor_in(directory.path(), &["dump", "scene.toml", "-o", "out.png", "--size", "16x16"]);
    let written = directory.path().join("out.png").exists();
    assert_eq!(
        (output.status.code(), output.stderr.is_empty()),
        if written { (Some(0), true) } else { (Some(2), false) }
    );
    text(&output.stderr)
}

#[test]
fn data_that_cannot_be_read_are_named() {
    let mut said = Said::default();
    for csv in [
        "t,v\n0,1\n1,2\n2,3\n",
        "t,v\n0,1\n1,x\n2,3\n",
        "t,v\n0,1\n1\n2,3\n",
        "t,v\n0,1\n0,2\n2,3\n",
        "t,v\n0,1\n1,1000\n2,3\n",
        "a,b\n0,1\n",
        "",
        // the line is that of the file, whatever its line ends and empty lines
        "t,v\n\n0,1\n\n\n1,x\n2,3\n",
        "\r\nt,v\r\n0,1\r\n  \r\n1,x\r\n2,3\r\n",
        "t,\"v\n\"\n0,1\n1,x\n",
    ] {
        said.case(&format!("{csv:?}"), &said_of_data(csv.as_bytes()));
    }
    said.scene(DATA.as_bytes());
    assert_snapshot!(said);
}

#[test]
fn tables_as_spreadsheets_write_them_are_read() {
    let mut said = Said::default();
    for csv in [
        "\u{feff}t,v\n0,1\n1,2\n2,3\n",
        "\u{feff}\"t\",\"v\"\r\n\"0\",\"1\"\r\n1,2\r\n2,3\r\n",
        "name,t, v \n\"one, two\",0,1\n\n\"say \"\"3\"\"\",1, 2\nx,2,3",
        "t,v\n0,1\n1,2\n2,3\n,\n\n",
    ] {
        assert_eq!(said_of_data(csv.as_bytes()), "", "{csv:?}");
    }
    // a scene file may begin with the mark too, and lines are counted as before
    let marked = |scene: &str| format!("\u{feff}{scene}");
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("scene.toml"), marked(CURVE)).unwrap();
    crate::common::good(directory.path(), &["dump", "scene.toml", "-o", "out.png", "--size", "16x16"]);
    said.scene(marked(CURVE).replace("[1.0, 1.0]", "[1.0, 1e9]").as_bytes());
    said.case("UTF-16", &said_of_data(b"\xff\xfet\0,\0"));
    assert_snapshot!(said);
}

#[test]
fn what_is_quoted_is_short() {
    let long = "9x".repeat(20_000);
    let start = &long[..60];
    assert_eq!(
        said_of_data(format!("t,v\n0,1\n1,{}\n2,3\n", "9x".repeat(1_500_000)).as_bytes()),
        format!("attractor: d.csv:3: v = {start}...: is not a finite decimal number\n")
    );
    assert_eq!(
        said_of_data(format!("{long},b\n0,1\n1,1\n2,3\n").as_bytes()),
        format!("attractor: scene.toml:4: data.x = \"t\": d.csv has the columns {start}..., b\n")
    );
    let directory = tempfile::tempdir().unwrap();
    let short = |complaint: String, words: &[&str]| {
        assert!(complaint.len() < 1200, "{} bytes", complaint.len());
        assert!(words.iter().all(|word| complaint.contains(word)), "{words:?}: {complaint}");
    };
    for (scene, words) in [
        (format!("kind = \"{long}\"\n"), &["scene.toml:1: kind = \"9x9x", "allowed is fif-curve"][..]),
        (format!("kind = \"ifs\"\n{long} = 3\n"), &["scene.toml:2: "]),
        (
            format!("kind = \"ifs\"\na{long} = 3\n"),
            &["scene.toml:2: unknown field `a9x9x", "... expected one of `kind`"],
        ),
        (format!("kind = \"ifs\"\nmaps = \"{long}\"\n"), &["scene.toml:2: invalid type", "maps = \"9x9x"]),
        (CURVE.replace("[0.5, 0.5]", &format!("[0.5, \"{long}\"]")), &["vertical_scaling[1] = \"9x9x"]),
        (format!("kind = \"curve\"\ncurve = \"{long}\"\norder = 1\n"), &["curve = \"9x9x", "koch"]),
        (format!("kind = \"curve\"\nturtle = \"{long}\"\nangle = 60\norder = 1\n"), &["turtle = \"9x9x"]),
        (
            format!("kind = \"fif-curve\"\n[data]\ncsv = \"{long}\"\nx = \"t\"\ny = \"v\"\n"),
            &["csv = \"9x9x", "cannot be read"],
        ),
        (
            format!("kind = \"fif-curve\"\n[data]\ncsv = \"d.csv\"\nx = \"{long}\"\ny = \"v\"\n"),
            &["data.x = \"9x9x", "a, b"],
        ),
    ] {
        fs::write(directory.path().join("scene.toml"), scene).unwrap();
        fs::write(directory.path().join("d.csv"), "a,b\n0,1\n").unwrap();
        short(bad(directory.path(), &["dump", "scene.toml", "-o", "out.png"]), words);
    }
    let long = long.as_str();
    // and what stands on the command line; control characters in it do nothing to the terminal
    for args in
        [&["dump", long][..], &["dump", "fern", "--size", long], &["dump", "fern", "--color", long], &[long]]
    {
        short(bad(directory.path(), args), &[&start[..40]]);
    }
    for args in [&["dump", "\u{1b}[2Jfern"][..], &["dump", "fern", "--size", "\u{1b}[2J\n8"], &["\u{1b}[2J"]]
    {
        let complaint = bad(directory.path(), args);
        assert!(!complaint.trim_end().contains(char::is_control), "{complaint:?}");
    }
}

#[test]
fn what_comes_up_while_a_picture_is_drawn_names_file_key_and_value() {
    let mut said = Said::default();
    let directory = tempfile::tempdir().unwrap();
    for (scene, size) in [
        ("kind = \"curve\"\ngenerator = [[0, 0], [\"0.9\", \"0.43\"], [1, 0]]\nadaptive = true\n", "64x64"),
        (
            "kind = \"random-curve\"\nlaw = \"elbow\"\nparameter = \"0.000001\"\ncoast = \"iceland\"\n",
            "64x64",
        ),
        ("kind = \"mandelbrot\"\nwidth = \"3000\"\n", "1x16384"),
    ] {
        fs::write(directory.path().join("scene.toml"), scene).unwrap();
        said.case(&format!("{scene:?}"), "");
        said.command(directory.path(), &["dump", "scene.toml", "-o", "new/out.png", "--size", size]);
        said.command(directory.path(), &["sample", "scene.toml", "--size", size]);
        // nor does a directory stay that was made for it
        assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1, "something was written");
    }
    assert_snapshot!(said);
}

#[test]
fn files_that_are_no_scene_are_refused() {
    let mut said = Said::default();
    said.scene(b"");
    said.scene(b"\n\n");
    said.scene(&CURVE.as_bytes()[..60]);
    said.scene(&CURVE.as_bytes()[..45]);
    said.scene(b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR");
    said.scene(&[0; 64]);
    said.scene("title = \"no kind\"\n".as_bytes());
    said.scene(b"");
    said.scene(b"kind = \"random-curve\"\n");
    said.scene(&vec![b'#'; 5_000_000]);
    assert_snapshot!(said);
}

#[test]
fn scenes_that_are_not_there_are_named_with_the_nearest_name() {
    let directory = tempfile::tempdir().unwrap();
    let mut said = Said::default();
    for given in ["mandlebrot", "Fern", "figure-6", "gasket", "missing.toml"] {
        said.command(directory.path(), &["dump", given]);
    }
    said.command(directory.path(), &["sample", "."]);
    assert_snapshot!(said);
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 0);
}

#[test]
fn a_bad_scene_among_good_ones_stops_everything() {
    let directory = tempfile::tempdir().unwrap();
    bad(directory.path(), &["dump", "fern", "fren"]);
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 0);
}

#[test]
fn sizes_and_counts_have_limits() {
    let directory = tempfile::tempdir().unwrap();
    let mut said = Said::default();
    for (option, value) in [
        ("--size", "0x240"),
        ("--size", "240x0"),
        ("--size", "1000000000x1"),
        ("--size", "240x1000000000"),
        ("--size", "16384x16384"),
        ("--size", "240"),
        ("--size", "-1x5"),
        ("--size", "axb"),
        ("--color", "rgb666"),
        ("--scale", "0"),
        ("--scale", "1000000000"),
        ("--seed", "x"),
    ] {
        said.command(directory.path(), &["dump", "fern", option, value]);
    }
    said.command(directory.path(), &["dump", "fern", "--size", "4096x4096", "--scale", "64"]);
    for points in ["0", "1000000000", "-5", "many"] {
        said.command(directory.path(), &["sample", "fern", "--points", points]);
    }
    said.command(directory.path(), &["dmup"]);
    said.command(directory.path(), &["sample"]);
    assert_snapshot!(said);
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 0);
}

#[test]
fn places_that_cannot_be_written_are_named() {
    let directory = tempfile::tempdir().unwrap();
    let mut said = Said::default();
    let mut dump = |scenes: &[&str], output: &str| {
        let args = [&["dump"], scenes, &["-o", output, "--size", "8x8"]].concat();
        said.command(directory.path(), &args);
    };
    fs::write(directory.path().join("file"), "kept").unwrap();
    dump(&["fern"], "/proc/a.png");
    dump(&["fern"], "file/a.png");
    dump(&["fern"], "file");
    for other in ["a.png", "-", "/dev/null"] {
        dump(&["fern", "dragon"], other);
    }
    dump(&["fern"], "x.jpg");
    dump(&["fern", "dragon"], "file");
    dump(&["fern", "fern"], "out");
    dump(&["fern"], "/dev/full");
    assert_eq!(fs::read(directory.path().join("file")).unwrap(), b"kept");
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1);
    // a directory stands where the file should go, said before anything is drawn
    fs::create_dir_all(directory.path().join("out/fern.png")).unwrap();
    dump(&["koch-curve", "fern"], "out");
    assert_eq!(fs::read_dir(directory.path().join("out")).unwrap().count(), 1);
    assert_snapshot!(said);
}

/// Standard output that is full.
#[cfg(target_os = "linux")]
#[test]
fn what_cannot_be_printed_is_an_error() {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("curve.toml"), CURVE).unwrap();
    for args in [
        &["--help"][..],
        &["help", "dump"],
        &["--version"],
        &["list"],
        &[],
        &["sample", "curve.toml"],
        &["export", "curve.toml"],
        &["dimension", "koch-curve", "--csv"],
        &["spectrum", "figure-1-g"],
        &["dump", "koch-curve", "-o", "-", "--size", "8x8"],
        &["dump", "koch-curve", "-o", "a.png", "--size", "8x8"],
    ] {
        let full = fs::File::create("/dev/full").unwrap();
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_attractor"))
            .args(args)
            .current_dir(directory.path())
            .stdout(full)
            .output()
            .unwrap();
        let complaint = "attractor: standard output: No space left on device (os error 28)\n";
        assert_eq!((output.status.code(), text(&output.stderr).as_str()), (Some(2), complaint), "{args:?}");
    }
}

#[cfg(not(feature = "window"))]
#[test]
fn without_the_feature_the_window_says_how_to_get_it() {
    let directory = tempfile::tempdir().unwrap();
    let complaint = bad(directory.path(), &["window", "fern"]);
    assert!(complaint.contains("--features window") && complaint.contains("libsdl2-dev"), "{complaint}");
}

#[test]
fn help_is_not_an_error() {
    let directory = tempfile::tempdir().unwrap();
    for args in [&["--help"][..], &["help", "dump"], &["sample", "--help"], &["--version"]] {
        let output = attractor_in(directory.path(), args);
        assert_eq!((output.status.code(), output.stderr.len()), (Some(0), 0), "{args:?}");
        assert!(text(&output.stdout).contains("attractor"));
    }
}

#[test]
fn a_deep_view_beyond_the_range_is_told_what_is_allowed() {
    let mut said = Said::default();
    said.change(MANDELBROT, "\"0.5\"", "\"1e-101\"");
    let deep = MANDELBROT.replacen("\"0.5\"", "\"1e-40\"", 1);
    said.change(&deep, "[\"-0.75\", \"0.1\"]", "[\"100\", \"0\"]");
    assert_snapshot!(said);
}

/// A lattice of 2 x 2 cells, the same in all directions, as a matt height field.
const LATTICE: &str = "kind = \"patch-surface\"\nmodel = \"lattice\"\nnumbers = [\n  0, 0, 0, 0, 0,\n  0, \"0.25\", 0,\n  0, \"0.5\", 0,\n  0, \"0.25\", \"0.5\", \"0.25\", 0,\n  0, 0, 0, 0, 0,\n]\ncells = 2\nheights = [\n  0, 0, 0, 0, 0,\n  0, 0, 0, 0, 0,\n  0, 0, \"0.5\", 0, 0,\n  0, 0, 0, 0, 0,\n  0, 0, 0, 0, 0,\n]\nmaterial = \"torrance-sparrow\"\nsamples = 2\n[camera]\neye = [-2, -3, 2]\nlook_at = [0.5, 0.5, 0.2]\n[filter]\nquality = \"fine\"\n";

/// Materials of height fields, and normals that have no moments.
#[test]
fn materials_and_filters_that_are_none_are_refused() {
    let mut said = Said::default();
    said.change(SURFACE, "\"mirror\"", "\"chrome\"");
    said.change(SURFACE, "samples = 1", "samples = 1\ntorrance-sparrow = { roughness = 0.25 }");
    let sheen = SURFACE.replace("\"mirror\"", "\"torrance-sparrow\"");
    for table in
        ["roughness = 0.01", "roughness = 1.5", "reflectance = -1", "reflectance = 1.001", "gloss = 1"]
    {
        said.change(&sheen, "samples = 1", &format!("samples = 1\ntorrance-sparrow = {{ {table} }}"));
    }
    // the slopes of what is not integrated have no moments
    let filtered = format!("{SURFACE}[filter]\nquality = \"fine\"\n");
    said.change(&filtered, "\"fine\"", "\"finer\"");
    said.change(
        &filtered,
        "vertical_scaling = [0.5, 0.5]\nintegrate = 1\n[g]",
        "vertical_scaling = [0.5, 0.5]\n[g]",
    );
    // a lattice that bends planes, and one whose slopes are too rough
    said.change(LATTICE, "[\n  0, 0, 0, 0, 0,\n  0, \"0.25\"", "[\n  0, \"0.0625\", 0, 0, 0,\n  0, \"0.25\"");
    said.change(
        LATTICE,
        "numbers = [\n  0, 0, 0, 0, 0,\n  0, \"0.25\", 0,\n  0, \"0.5\", 0,\n  0, \"0.25\", \"0.5\", \"0.25\", 0,\n  0, 0, 0, 0, 0,\n]",
        "numbers = [\n  \"-0.03125\", \"-0.078125\", 0, \"-0.078125\", \"-0.03125\",\n  \"-0.078125\", \"0.25\", \"-0.078125\",\n  0, \"0.65625\", 0,\n  \"-0.078125\", \"0.25\", \"0.65625\", \"0.25\", \"-0.078125\",\n  \"-0.03125\", \"-0.078125\", 0, \"-0.078125\", \"-0.03125\",\n]",
    );
    said.change(LATTICE, "cells = 2", "cells = 2\nheight = 1");
    said.change(LATTICE, "material = \"torrance-sparrow\"\n", "");
    said.change(LATTICE, "material = \"torrance-sparrow\"\n", "palette = \"dusk\"\n");
    said.change(
        LATTICE,
        "eye = [-2, -3, 2]\nlook_at = [0.5, 0.5, 0.2]\n[filter]\nquality = \"fine\"",
        "eye = [0.5, 0.5, 2]\nlook_at = [0.5, 0.5, 0.2]",
    );
    said.change(LATTICE, "samples = 2", "samples = 9");
    assert_snapshot!(said);
}

/// By whatever name.
#[test]
fn what_is_read_is_not_written_over() {
    let directory = tempfile::tempdir().unwrap();
    let dir = directory.path();
    let picture = fs::File::create(dir.join("in.png")).unwrap();
    let samples: Vec<u8> = (0..33 * 33).map(|k| (k % 33 * (k / 33) / 5) as u8).collect();
    let mut encoder = png::Encoder::new(picture, 33, 33);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.write_header().unwrap().write_image_data(&samples).unwrap();
    crate::common::good(dir, &["encode", "in.png", "-o", "in.atfi", "--psnr", "30"]);
    fs::copy(dir.join("in.atfi"), dir.join("stream.png")).unwrap();
    fs::write(dir.join("surface.toml"), SURFACE).unwrap();
    fs::create_dir(dir.join("room")).unwrap();
    let files = ["in.png", "in.atfi", "stream.png", "surface.toml"];
    let read = || files.map(|name| fs::read(dir.join(name)).unwrap());
    let before = read();
    for args in [
        &["encode", "in.png", "-o", "in.png", "--psnr", "30"][..],
        &["encode", "in.png", "-o", "room/../in.png", "--psnr", "30"],
        &["decode", "stream.png", "-o", "./stream.png"],
        &["inspect", "stream.png", "-o", "stream.png"],
        &["fit", "in.png", "--parameters", "70", "-o", "in.png"],
        &["brdf", "surface.toml", "-o", "slopes.png", "-o", "surface.toml"],
    ] {
        let output = attractor_in(dir, args);
        let said = text(&output.stderr);
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{args:?}: {said}");
        assert!(said.contains("it is what is read") && said.contains("--output "), "{args:?}: {said}");
        assert_eq!((read(), fs::read_dir(dir).unwrap().count()), (before.clone(), 5), "{args:?}");
    }
}
