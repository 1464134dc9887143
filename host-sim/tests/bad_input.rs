//! Bad input: one line that names file, key and value, exit code 2, nothing half-written.

use std::fs;

use crate::common::{attractor_in, bad, text};

const CURVE: &str =
    "kind = \"fif-curve\"\nknots = [[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]]\nvertical_scaling = [0.5, 0.5]\n";
const IFS: &str =
    "kind = \"ifs\"\nmaps = [\n  [0.5, 0, 0, 0.5, 0, 0, 0.5],\n  [0.5, 0, 0, 0.5, 0.5, 0, 0.5],\n]\n";
const MANDELBROT: &str =
    "kind = \"mandelbrot\"\ncentre = [\"-0.75\", \"0.1\"]\nwidth = \"0.5\"\nmax_dwell = 50\n";
const JULIA: &str = "kind = \"julia\"\nc = [\"-0.8\", \"0.156\"]\n";
const SURFACE: &str = "kind = \"fif-surface\"\nmaterial = \"mirror\"\nsamples = 1\n[f]\nknots = [[0, 0], [1, 1], [2, 0]]\nvertical_scaling = [0.5, 0.5]\nintegrate = 1\n\
    [g]\nknots = [[0, 0], [1, 1], [2, 0]]\nvertical_scaling = [0.5, 0.5]\nintegrate = 1\n[camera]\neye = [-3, -2, 5]\nlook_at = [1, 1, 1]\n";

/// A scene file with one thing replaced; what the complaint about it must say.
fn refused(good: &str, from: &str, to: &str, words: &[&str]) {
    assert!(good.contains(from), "{from}");
    refused_text(good.replacen(from, to, 1).as_bytes(), words);
}

fn refused_text(scene: &[u8], words: &[&str]) {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("scene.toml"), scene).unwrap();
    for command in [
        &["dump", "scene.toml", "-o", "out.png", "--size", "16x16"][..],
        &["sample", "scene.toml", "--size", "4x4"],
    ] {
        let complaint = bad(directory.path(), command);
        for word in ["attractor: ", "scene.toml"].iter().chain(words) {
            assert!(complaint.contains(word), "no {word:?} in {complaint}");
        }
    }
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1, "something was written");
}

/// All the same with good input, so that the tests below change one thing only.
#[test]
fn the_good_files_are_good() {
    for (i, scene) in [CURVE, IFS, MANDELBROT, JULIA, SURFACE].into_iter().enumerate() {
        let directory = tempfile::tempdir().unwrap();
        fs::write(directory.path().join("scene.toml"), scene).unwrap();
        crate::common::good(directory.path(), &["dump", "scene.toml", "-o", "out.png", "--size", "16x16"]);
        crate::common::good(directory.path(), &["sample", "scene.toml", "--size", "4x4"]);
        assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 2, "{i}");
    }
}

#[test]
fn knots_out_of_order_are_refused() {
    refused(CURVE, "[1.0, 1.0]", "[2.5, 1.0]", &[":2:", "knots[2]", "[2.0, 0.0]", "to the right"]);
    refused(CURVE, "[1.0, 1.0]", "[0.0, 1.0]", &["knots[1]", "[0.0, 1.0]"]);
    refused(
        CURVE,
        "[[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]]",
        "[[1.0, 2.0]]",
        &["knots", "[[1.0, 2.0]]", "at least 2"],
    );
    refused(CURVE, "[[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]]", "[]", &["knots"]);
    // different in 48 bits, one and the same f64
    refused(
        CURVE,
        "[[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]]",
        "[[0, 0], [20000, 1], [20000.00000000000001, 2]]",
        &["knots[2]"],
    );
}

#[test]
fn scalings_of_1_or_more_are_refused() {
    for scaling in ["1.0", "1", "-1.0", "17", "0.99999999999999", "nan", "-inf", "1e300"] {
        let words = ["vertical_scaling[1]", scaling, "strictly between -1 and 1"];
        refused(CURVE, "[0.5, 0.5]", &format!("[0.5, {scaling}]"), &words);
    }
    refused(CURVE, "[0.5, 0.5]", "[0.5]", &["vertical_scaling", "[0.5]", "2 expected"]);
    refused(SURFACE, "[0.5, 0.5]", "[0.5, 1.5]", &["f.vertical_scaling[1]", "1.5"]);
}

#[test]
fn numbers_outside_the_format_are_refused() {
    refused(CURVE, "[1.0, 1.0]", "[1.0, 128.0]", &["knots[1]", "128"]);
    refused(CURVE, "[1.0, 1.0]", "[1.0, 1e12]", &["knots[1][1]", "1e12", "outside the format"]);
    refused(CURVE, "[2.0, 0.0]", "[1e5, 0.0]", &["knots[2][0]", "1e5", "32768"]);
    refused(CURVE, "[0.5, 0.5]", "[0.999, 0.999]", &["vertical_scaling", "range of the function"]);
    refused(IFS, "0.5, 0, 0.5]", "1000, 0, 0.5]", &["maps[1][4]", "1000"]);
    refused(MANDELBROT, "-0.75", "-32769", &["centre[0]", "-32769"]);
    refused(MANDELBROT, "\"0.5\"", "\"0\"", &["width", "\"0\"", "above 0", "1e-100"]);
    refused(MANDELBROT, "\"0.5\"", "\"-3\"", &["width", "-3", "above 0"]);
    let nowhere = MANDELBROT.replace("0.5", "1e-30");
    refused(&nowhere, "centre = [\"-0.75\", \"0.1\"]\n", "", &["width", "1e-30", "needs a centre"]);
    refused(MANDELBROT, "\"0.5\"", "\"1e-130\"", &["width", "1e-130", "as small as 1e-100"]);
    refused(MANDELBROT, "\"0.5\"", "\"1e-114\"", &["width", "1e-114", "as small as 1e-100"]);
    refused(MANDELBROT, "\"0.5\"", "\"wide\"", &["width", "wide", "decimal number"]);
    refused(MANDELBROT, "= 50", "= 0", &["max_dwell", "= 0", "1048576"]);
    refused(MANDELBROT, "= 50", "= -1", &["max_dwell", "-1"]);
    refused(MANDELBROT, "= 50", "= 1000000000", &["max_dwell", "1000000000"]);
    refused(JULIA, "-0.8", "-2.5", &["c = ", "-2.5"]);
    refused(SURFACE, "eye = [-3, -2, 5]", "eye = [-300, -2, 5]", &["camera.eye[0]", "-300"]);
    refused(SURFACE, "eye = [-3, -2, 5]", "eye = [1, 1, 1]", &["camera.eye"]);
    refused(SURFACE, "samples = 1", "samples = 9", &["samples", "9", "1 to 8"]);
    refused(SURFACE, "samples = 1", "depth = 99", &["depth", "99"]);
    refused(
        SURFACE,
        "look_at = [1, 1, 1]",
        "look_at = [1, 1, 1]\nfield_of_view = 170",
        &["field_of_view", "170"],
    );
    refused(
        SURFACE,
        "samples = 1",
        "samples = 1\n[light]\ndirection = [0, 0, 0]",
        &["light.direction", "[0, 0, 0]"],
    );
    refused(
        SURFACE,
        "samples = 1",
        "samples = 1\n[checkerboard]\nscale = 1000",
        &["checkerboard.scale", "1000"],
    );
    refused(SURFACE, "samples = 1", "samples = 1\n[gradient]\nzenith = 1.5", &["gradient.zenith", "1.5"]);
}

#[test]
fn a_system_that_is_none_is_refused() {
    refused(IFS, "0, 0, 0.5]", "0, 0, 0.4]", &["maps", "add up to"]);
    refused(IFS, "0, 0, 0.5]", "0, 0, -0.5]", &["maps[0][6]", "-0.5"]);
    for none in ["0", "0.0", "\"1e-12\""] {
        let words = [":3:", "maps[0][6]", "probability [0] is 0, it must lie between"];
        refused(IFS, "0, 0, 0.5]", &format!("0, 0, {none}]"), &words);
    }
    refused(
        IFS,
        "[0.5, 0, 0, 0.5, 0.5",
        "[1.0, 0, 0, 0.5, 0.5",
        &["maps[1]", ":4:", "[1.0, 0, 0, 0.5", "contraction"],
    );
    refused(IFS, "[0.5, 0, 0, 0.5, 0, 0, 0.5]", "[0.5, 0, 0, 0.5, 0, 0]", &[":3:"]);
    refused_text(b"kind = \"ifs\"\nmaps = []\n", &["maps", "[]", "at least 1"]);
    refused(IFS, "kind", "points = 0\nkind", &["points", "0"]);
    refused(IFS, "kind", "points = 1000000000\nkind", &["points", "1000000000"]);
}

#[test]
fn unknown_keys_and_words_are_refused() {
    refused(CURVE, "vertical_scaling", "vertical_scalings", &[":3:", "vertical_scalings"]);
    refused(CURVE, "\"fif-curve\"", "\"fif-curv\"", &["kind", "fif-curv", "julia"]);
    refused(CURVE, "kind", "palette = \"pink\"\nkind", &["palette = \"pink\"", "dusk"]);
    refused(CURVE, "kind", "contractions = [1, 3]\nkind", &["contractions[1]", "3", "1 to 2"]);
    refused(CURVE, "knots", "integrate = 9\nknots", &["integrate", "9"]);
    refused(CURVE, "knots", "integrate = -1\nknots", &["integrate = -1"]);
    refused(SURFACE, "\"mirror\"", "\"velvet\"", &["velvet", "mirror"]);
    refused(SURFACE, "look_at", "looks_at", &["looks_at"]);
    refused(
        SURFACE,
        "knots = [[0, 0], [1, 1], [2, 0]]\nvertical_scaling = [0.5, 0.5]",
        "knots = [[0, 0], [1, 1]]\nvertical_scaling = [0.5]",
        &["f.knots", "[[0, 0], [1, 1]]", "two maps"],
    );
    refused(JULIA, "kind", "inside = \"red\"\nkind", &["inside", "red", "#rrggbb"]);
    refused(MANDELBROT, "kind", "c = [\"0\", \"0\"]\nkind", &["`c`"]);
    refused(
        CURVE,
        "vertical_scaling",
        "polynomials = [[0, 0.5], [1, 0.5]]\nvertical_scaling",
        &["knots", "disagree"],
    );
    refused(
        CURVE,
        "vertical_scaling",
        "polynomials = [[0, 0.5]]\nvertical_scaling",
        &["polynomials", "2 expected"],
    );
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
    for (csv, words) in [
        ("t,v\n0,1\n1,2\n2,3\n", &[][..]),
        ("t,v\n0,1\n1,x\n2,3\n", &["d.csv:3", "v = x"]),
        ("t,v\n0,1\n1\n2,3\n", &["d.csv:3", "v = "]),
        ("t,v\n0,1\n0,2\n2,3\n", &["d.csv:3", "t = 0"]),
        ("t,v\n0,1\n1,1000\n2,3\n", &["d.csv:3", "v = 1000"]),
        ("a,b\n0,1\n", &["data.x", "\"t\"", "a, b"]),
        ("", &["data.x"]),
        // the line is that of the file, whatever its line ends and empty lines
        ("t,v\n\n0,1\n\n\n1,x\n2,3\n", &["d.csv:6: v = x"]),
        ("\r\nt,v\r\n0,1\r\n  \r\n1,x\r\n2,3\r\n", &["d.csv:5: v = x"]),
        ("t,\"v\n\"\n0,1\n1,x\n", &["d.csv:4: v = x"]),
    ] {
        let complaint = said_of_data(csv.as_bytes());
        assert_eq!(complaint.is_empty(), words.is_empty(), "{complaint}");
        assert!(words.iter().all(|word| complaint.contains(word)), "{complaint}");
    }
    refused_text(DATA.as_bytes(), &["d.csv", "csv"]);
}

#[test]
fn tables_as_spreadsheets_write_them_are_read() {
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
    refused_text(
        marked(CURVE).replace("[1.0, 1.0]", "[1.0, 1e9]").as_bytes(),
        &["scene.toml:2: knots[1][1] = 1e9"],
    );
    assert!(said_of_data(b"\xff\xfet\0,\0").contains("byte 0 is 0xff, this is no text in UTF-8"));
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
    let directory = tempfile::tempdir().unwrap();
    for (scene, size, want) in [
        (
            "kind = \"curve\"\ngenerator = [[0, 0], [\"0.9\", \"0.43\"], [1, 0]]\nadaptive = true\n",
            "64x64",
            "attractor: scene.toml:3: adaptive = true: on 64 x 64 pixels: ",
        ),
        (
            "kind = \"random-curve\"\nlaw = \"elbow\"\nparameter = \"0.000001\"\ncoast = \"iceland\"\n",
            "64x64",
            "attractor: scene.toml:3: parameter = \"0.000001\": on 64 x 64 pixels: ",
        ),
        (
            "kind = \"mandelbrot\"\nwidth = \"3000\"\n",
            "1x16384",
            "attractor: scene.toml: width = 3000 on 1 x 16384 pixels: ",
        ),
    ] {
        fs::write(directory.path().join("scene.toml"), scene).unwrap();
        for args in [
            &["dump", "scene.toml", "-o", "new/out.png", "--size", size][..],
            &["sample", "scene.toml", "--size", size],
        ] {
            let complaint = bad(directory.path(), args);
            assert!(complaint.starts_with(want), "{args:?}: {complaint}");
            let allowed = ["there is room for ", "it must lie between "];
            assert!(allowed.iter().any(|words| complaint.contains(words)), "{complaint}");
        }
        // nor does a directory stay that was made for it
        assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1, "something was written");
    }
}

#[test]
fn files_that_are_no_scene_are_refused() {
    refused_text(b"", &["empty"]);
    refused_text(b"\n\n", &["empty"]);
    refused_text(&CURVE.as_bytes()[..60], &[]);
    refused_text(&CURVE.as_bytes()[..45], &[]);
    refused_text(b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", &["byte 0", "0x89"]);
    refused_text(&[0; 64], &[]);
    const KINDS: &str = "kind: missing, allowed is fif-curve, fif-surface, curve, random-curve, l-system, ifs, copier, mandelbrot, julia, julia-set";
    refused_text("title = \"no kind\"\n".as_bytes(), &[KINDS]);
    refused_text(b"", &[KINDS]);
    refused_text(b"kind = \"random-curve\"\n", &["missing field `law`", "`attractor list` names the keys"]);
    refused_text(&vec![b'#'; 5_000_000], &["longer than"]);
}

#[test]
fn scenes_that_are_not_there_are_named_with_the_nearest_name() {
    let directory = tempfile::tempdir().unwrap();
    for (given, nearest) in
        [("mandlebrot", "mandelbrot"), ("Fern", "fern"), ("figure-6", "figure-6-"), ("gasket", "")]
    {
        let complaint = bad(directory.path(), &["dump", given]);
        assert!(
            complaint.contains(given) && complaint.contains(&format!("did you mean {nearest}")),
            "{complaint}"
        );
    }
    let complaint = bad(directory.path(), &["dump", "missing.toml"]);
    assert!(complaint.contains("missing.toml") && complaint.contains("cannot be read"), "{complaint}");
    let complaint = bad(directory.path(), &["sample", "."]);
    assert!(complaint.contains("directory"), "{complaint}");
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
        let complaint = bad(directory.path(), &["dump", "fern", option, value]);
        assert!(complaint.contains(option) && complaint.contains(value), "{complaint}");
    }
    let complaint = bad(directory.path(), &["dump", "fern", "--size", "4096x4096", "--scale", "64"]);
    assert!(complaint.contains("--scale 64"), "{complaint}");
    for points in ["0", "1000000000", "-5", "many"] {
        let complaint = bad(directory.path(), &["sample", "fern", "--points", points]);
        assert!(complaint.contains("--points") && complaint.contains(points), "{complaint}");
    }
    bad(directory.path(), &["dmup"]);
    bad(directory.path(), &["sample"]);
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 0);
}

#[test]
fn places_that_cannot_be_written_are_named() {
    let directory = tempfile::tempdir().unwrap();
    let at = |args: &[&str]| bad(directory.path(), args);
    let small = ["--size", "8x8"];
    let dump = |scenes: &[&str], output: &str| {
        let args: Vec<&str> =
            ["dump"].iter().chain(scenes).chain(&["-o", output]).chain(&small).copied().collect();
        at(&args)
    };
    fs::write(directory.path().join("file"), "kept").unwrap();
    assert!(
        dump(&["fern"], "/proc/a.png").contains("--output /proc/a.png: nothing can be written into /proc: ")
    );
    assert!(
        dump(&["fern"], "file/a.png").contains("--output file/a.png: nothing can be written into file: ")
    );
    assert_eq!(
        dump(&["fern"], "file"),
        "attractor: --output file: it is a file; pictures are PNG files, whose names end in .png\n"
    );
    for other in ["a.png", "-", "/dev/null"] {
        let reason = "2 scenes go into a directory, not into one file";
        assert_eq!(dump(&["fern", "dragon"], other), format!("attractor: --output {other}: {reason}\n"));
    }
    let reason = "pictures are PNG files, whose names end in .png; a new directory is x.jpg/ with a slash";
    assert_eq!(dump(&["fern"], "x.jpg"), format!("attractor: --output x.jpg: {reason}\n"));
    assert!(dump(&["fern", "dragon"], "file").contains("--output file: it is a file"));
    assert!(dump(&["fern", "fern"], "out").contains("fern"));
    assert_eq!(
        dump(&["fern"], "/dev/full"),
        "attractor: /dev/full: cannot be written: No space left on device (os error 28)\n"
    );
    assert_eq!(fs::read(directory.path().join("file")).unwrap(), b"kept");
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1);
    // a directory stands where the file should go, said before anything is drawn
    fs::create_dir_all(directory.path().join("out/fern.png")).unwrap();
    assert!(dump(&["koch-curve", "fern"], "out").contains("out/fern.png: cannot be written: Is a directory"));
    assert_eq!(fs::read_dir(directory.path().join("out")).unwrap().count(), 1);
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
    refused(MANDELBROT, "\"0.5\"", "\"1e-101\"", &["width", "1e-101", "1e-100"]);
    let deep = MANDELBROT.replacen("\"0.5\"", "\"1e-40\"", 1);
    refused(&deep, "[\"-0.75\", \"0.1\"]", "[\"100\", \"0\"]", &["centre[0]", "is 100", "-8 and 8"]);
}
