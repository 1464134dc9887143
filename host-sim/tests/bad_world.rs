//! Bad input of worlds: one line that names file, key and value, exit code 2, nothing half-written.

use std::fs;

use insta::assert_snapshot;

use crate::common::{Said, bad, good};

const WORLD: &str = "kind = \"world\"
samples = 1
depth = 3
[camera]
eye = [0, -6, 2]
look_at = [0, 0, 0.7]
[[light]]
towards = [-2, -3, 5]
color = \"#ffffff\"
[[object]]
name = \"floor\"
shape = \"plane\"
[[object]]
name = \"ball\"
shape = \"sphere\"
scale = 0.5
rotate = [[0, 0, 1, 30]]
translate = [0, 0, 1]
material = \"glass\"
[[object]]
name = \"left\"
shape = \"sphere\"
[[object]]
name = \"right\"
shape = \"sphere\"
translate = [0.5, 0, 0]
[[object]]
name = \"lens\"
shape = \"intersection\"
of = [\"left\", \"right\"]
material = \"red\"
translate = [-1, 2, 1]
[material.glass]
index = 1.5
[material.red]
color = \"#c02020\"
specular = \"#808080\"
shininess = 40
";

/// The same with good input, so that the tests below change one thing only.
#[test]
fn the_good_world_is_good() {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("scene.toml"), WORLD).unwrap();
    good(directory.path(), &["dump", "scene.toml", "-o", "out.png", "--size", "16x16"]);
    let sample = good(directory.path(), &["sample", "scene.toml", "--size", "4x4"]);
    assert_eq!(sample.lines().count(), 17);
}

#[test]
fn objects_that_are_not_there_or_are_parts_of_themselves_are_refused() {
    let mut said = Said::default();
    said.change(WORLD, "name = \"ball\"", "name = \"floor\"");
    said.change(WORLD, "of = [\"left\", \"right\"]", "of = [\"left\", \"rihgt\"]");
    said.change(WORLD, "of = [\"left\", \"right\"]", "of = [\"left\"]");
    said.change(WORLD, "of = [\"left\", \"right\"]", "of = [\"left\", \"lens\"]");
    said.change(
        WORLD,
        "shape = \"sphere\"\n[[object]]\nname = \"right\"",
        "shape = \"union\"\nof = [\"right\", \"lens\"]\n[[object]]\nname = \"right\"",
    );
    said.change(WORLD, "of = [\"left\", \"right\"]\n", "");
    said.change(WORLD, "of = [\"left\", \"right\"]", "of = [\"left\", \"floor\"]\ntube = 0.5");
    let doubled = (0..6).fold(String::new(), |text, k| {
        let before = if k == 0 { "left".to_owned() } else { format!("twice {}", k - 1) };
        text + &format!(
            "[[object]]\nname = \"twice {k}\"\nshape = \"union\"\nof = [\"{before}\", \"{before}\"]\n"
        )
    });
    said.change(WORLD, "[material.glass]", &format!("{doubled}[material.glass]"));
    assert_snapshot!(said);
}

#[test]
fn places_that_are_none_are_refused() {
    let mut said = Said::default();
    said.change(WORLD, "scale = 0.5", "scale = 0");
    said.change(WORLD, "scale = 0.5", "scale = [1, 0, 1]");
    said.change(WORLD, "scale = 0.5", "scale = [1, 2]");
    said.change(WORLD, "scale = 0.5", "scale = 200");
    said.change(WORLD, "scale = 0.5", "scale = 0.001");
    said.change(WORLD, "scale = 0.5", "matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]");
    let alone =
        "name = \"ball\"\nshape = \"sphere\"\nscale = 0.5\nrotate = [[0, 0, 1, 30]]\ntranslate = [0, 0, 1]";
    let matrix = |numbers: &str| format!("name = \"ball\"\nshape = \"sphere\"\nmatrix = [{numbers}]");
    said.change(WORLD, alone, &matrix("1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 1"));
    said.change(WORLD, alone, &matrix("1, 0, 0, 0, 0, 1, 0, 0"));
    said.change(WORLD, "rotate = [[0, 0, 1, 30]]", "rotate = [[0, 0, 0, 30]]");
    said.change(WORLD, "rotate = [[0, 0, 1, 30]]", "rotate = [[0, 0, 30]]");
    said.change(WORLD, "translate = [0, 0, 1]", "translate = [0, 0, 100]");
    said.change(WORLD, "translate = [0, 0, 1]", "translate = [0, 0, \"up\"]");
    assert_snapshot!(said);
}

#[test]
fn materials_that_cannot_be_are_refused() {
    let mut said = Said::default();
    for index in ["0", "0.09", "11", "-1"] {
        said.change(WORLD, "index = 1.5", &format!("index = {index}"));
    }
    said.change(WORLD, "index = 1.5", "transmit = \"#ffffff\"");
    said.change(WORLD, "index = 1.5", "index = 1.5\npriority = 256");
    said.change(WORLD, "index = 1.5", "index = 1.5\nambient = 1.5");
    said.change(WORLD, "material = \"red\"", "material = \"rde\"");
    said.change(WORLD, "material = \"red\"", "material = []");
    said.change(WORLD, "color = \"#c02020\"", "color = \"red\"");
    said.change(WORLD, "color = \"#c02020\"", "color = [1, 0.5]");
    said.change(WORLD, "color = \"#c02020\"", "color = [1, 0.5, 2]");
    said.change(WORLD, "color = \"#c02020\"", "color = [1, 0.5, -1]");
    said.change(WORLD, "color = \"#c02020\"", "texture = \"wood\"");
    said.change(WORLD, "shininess = 40", "shininess = 0");
    said.change(WORLD, "shininess = 40", "roughness = 0.2");
    said.change(WORLD, "shininess = 40", "model = \"torrance-sparrow\"\nroughness = 0.01");
    said.change(WORLD, "shininess = 40", "model = \"torrance-sparrow\"\nacross = 0.1");
    said.change(WORLD, "shininess = 40", "model = \"velvet\"");
    said.change(WORLD, "shininess = 40", "shinyness = 40");
    assert_snapshot!(said);
}

#[test]
fn lights_cameras_and_samples_outside_their_ranges_are_refused() {
    let mut said = Said::default();
    said.change(WORLD, "towards = [-2, -3, 5]", "towards = [0, 0, 0]");
    said.change(WORLD, "towards = [-2, -3, 5]", "at = [0, -6, 2]");
    said.change(WORLD, "towards = [-2, -3, 5]", "at = [1, 2, 3]\ntowards = [1, 2, 3]");
    said.change(WORLD, "towards = [-2, -3, 5]\n", "");
    said.change(WORLD, "color = \"#ffffff\"", "color = [65, 0, 0]");
    said.change(WORLD, "samples = 1", "samples = 9");
    said.change(WORLD, "samples = 1", "samples = 1\ncontrast = [200, 100]");
    said.change(WORLD, "samples = 1", "filter = \"tent\"");
    said.change(WORLD, "samples = 1", "deviation = 0.5");
    said.change(WORLD, "samples = 1", "filter = \"gaussian\"\ndeviation = 5");
    said.change(WORLD, "depth = 3", "depth = 31");
    said.change(WORLD, "depth = 3", "depth = -1");
    said.change(WORLD, "depth = 3", "interpenetration = \"allow\"");
    said.change(WORLD, "eye = [0, -6, 2]", "eye = [0, -66, 2]");
    said.change(WORLD, "look_at = [0, 0, 0.7]", "look_at = [0, -6, 2]");
    said.change(WORLD, "[[light]]", "[environment]\nzenith = \"blue\"\n[[light]]");
    said.change(WORLD, "[[light]]", "[environment]\nkind = \"plain\"\nzenith = \"#000000\"\n[[light]]");
    said.change(WORLD, "[[light]]", "[environment]\nkind = \"checkerboard\"\nfade = 0\n[[light]]");
    said.change(WORLD, "[[light]]", "[environment]\nkind = \"image\"\n[[light]]");
    said.scene(b"kind = \"world\"\n[camera]\neye = [0, -6, 2]\nlook_at = [0, 0, 1]\n");
    assert_snapshot!(said);
}

#[test]
fn lights_that_are_too_many_are_refused() {
    let directory = tempfile::tempdir().unwrap();
    let light = "[[light]]\ntowards = [-2, -3, 5]\ncolor = [0.01, 0.01, 0.01]\n";
    let dump = ["dump", "scene.toml", "-o", "out.png", "--size", "4x4"];
    fs::write(
        directory.path().join("scene.toml"),
        WORLD.replace("[[light]]", &format!("{}[[light]]", light.repeat(63))),
    )
    .unwrap();
    good(directory.path(), &dump);
    fs::write(
        directory.path().join("scene.toml"),
        WORLD.replace("[[light]]", &format!("{}[[light]]", light.repeat(64))),
    )
    .unwrap();
    let said = bad(directory.path(), &dump);
    assert_eq!(said, "attractor: scene.toml: light: 65 lights; there is room for 64\n");
}

#[test]
fn glass_that_shares_a_place_is_refused_unless_it_is_allowed() {
    let mut said = Said::default();
    let shared =
        WORLD.replace("material = \"red\"", "material = \"glass\"").replace("[-1, 2, 1]", "[0.4, 0, 1]");
    said.change(&shared, "depth = 3", "depth = 4");
    assert_snapshot!(said);
    let directory = tempfile::tempdir().unwrap();
    for allowed in [
        shared.replace("depth = 3", "interpenetration = \"priority\""),
        shared.replace("\"glass\"\ntranslate", "\"water\"\ntranslate")
            + "[material.water]\nindex = 1.33\npriority = 1\n",
    ] {
        fs::write(directory.path().join("scene.toml"), allowed).unwrap();
        good(directory.path(), &["dump", "scene.toml", "-o", "out.png", "--size", "16x16"]);
    }
}

#[test]
fn what_a_world_is_asked_for_is_complete_and_of_numbers() {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("scene.toml"), WORLD).unwrap();
    let mut said = Said::default();
    for (name, lines) in [
        ("short.csv", "0,0,5,0,0,-1\n1,2,3\n"),
        ("words.csv", "ox,oy,oz,dx,dy,dz\n0,0,5,0,down,-1\n"),
        ("nowhere.csv", "0,0,5,0,0,0\n"),
        ("far.csv", "0,0,65,0,0,-1\n"),
        ("fast.csv", "0,0,5,0,0,-5\n"),
        ("empty.csv", "\n"),
    ] {
        fs::write(directory.path().join(name), lines).unwrap();
        said.command(directory.path(), &["sample", "scene.toml", "--rays", name]);
    }
    said.command(directory.path(), &["sample", "scene.toml", "--rays", "missing.csv"]);
    said.command(directory.path(), &["sample", "scene.toml", "--along", "0,0,5,0,0"]);
    said.command(directory.path(), &["sample", "scene.toml", "--along", "0,0,5,0,0,0"]);
    said.command(directory.path(), &["sample", "scene.toml", "--at", "short.csv"]);
    said.command(directory.path(), &["sample", "scene.toml", "--pixels", "--rays", "short.csv"]);
    said.command(directory.path(), &["sample", "fern", "--pixels"]);
    assert_snapshot!(said);
    assert!(bad(directory.path(), &["dimension", "scene.toml"]).contains("a world"));
}

#[test]
fn shapes_that_are_none_are_refused() {
    let shape = |text: &str| WORLD.replacen("shape = \"plane\"", text, 1);
    let mut said = Said::default();
    let mut change = |good: &str, from: &str, to: &[&str]| {
        let good = shape(good);
        to.iter().for_each(|to| said.change(&good, from, to));
    };
    change("shape = \"torus\"\ntube = 0.5", "0.5", &["0", "1", "-1"]);
    change("shape = \"superellipsoid\"\nn = 2\nm = 3", "m = 3", &["m = 0.1", "m = 21"]);
    change("shape = \"superellipsoid\"\nn = 2\nm = 3", "\nm = 3", &[""]);
    change("shape = \"tapered-cylinder\"\ncap = 0.5", "0.5", &["-0.5", "1.5"]);
    let square = "shape = \"polygon\"\npoints = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]";
    change(square, "[1, 1, 0]", &["[1, 1, 0.1]", "[0.2, 0.2, 0]", "[3, 1, 0]"]);
    change(square, ", [1, 1, 0], [0, 1, 0]", &[""]);
    let corner =
        "shape = \"polyhedron\"\nplanes = [[-1, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, 0], [1, 1, 1, 1]]";
    change(corner, "[1, 1, 1, 1]", &["[1, 1, 1, -1]", "[-1, 0, 0, 1]", "[0, 0, 0, 1]"]);
    change(corner, ", [1, 1, 1, 1]", &[""]);
    let field = "shape = \"height-field\"\nf = { knots = [[0, 0], [1, 1], [2, 0]], vertical_scaling = [0.5, 0.5] }\ng = { knots = [[0, 0], [1, 1], [2, 0]], vertical_scaling = [0.5, 0.5] }";
    change(field, "[0.5, 0.5]", &["[0.5, 1.5]", "[0.5]"]);
    change(field, "[[0, 0], [1, 1], [2, 0]]", &["[[0, 0], [1, 1]]"]);
    let open = WORLD.replace("name = \"left\"\nshape = \"sphere\"", "name = \"left\"\nshape = \"square\"");
    said.change(&open, "samples = 1", "samples = 2");
    assert_snapshot!(said);
}

#[test]
fn textures_that_cannot_be_are_refused() {
    let with =
        |texture: &str| WORLD.replace("color = \"#c02020\"", "texture = \"t\"") + "[texture.t]\n" + texture;
    let mut said = Said::default();
    let mut change = |good: &str, from: &str, to: &str| said.change(&with(good), from, to);
    change("kind = \"checker\"\n", "\"checker\"", "\"tartan\"");
    change("kind = \"checker\"\ncolors = [\"#ffffff\", \"#000000\"]\n", ", \"#000000\"]", "]");
    change("kind = \"checker\"\n", "kind = \"checker\"", "octaves = 3\nkind = \"checker\"");
    change("kind = \"turbulence\"\noctaves = 4\n", "octaves = 4", "octaves = 17");
    change(
        "kind = \"marble\"\ncolors = [\"#ffffff\", \"#000000\"]\nknots = [-1, 1]\n",
        "knots = [-1, 1]",
        "knots = [1, -1]",
    );
    change(
        "kind = \"marble\"\ncolors = [\"#ffffff\", \"#000000\"]\nknots = [-1, 1]\n",
        "knots = [-1, 1]",
        "knots = [-1]",
    );
    change("kind = \"marble\"\nknots = [-1, 1]\n", "knots = [-1, 1]", "knots = [-2, 1]");
    change("kind = \"wood\"\nsoft = 1\n", "soft = 1", "soft = 2");
    change("kind = \"wood\"\n", "kind = \"wood\"", "kind = \"image\"");
    change("kind = \"wood\"\n", "kind = \"wood\"", "kind = \"image\"\nimage = \"missing.png\"");
    change("kind = \"wood\"\n", "kind = \"wood\"", "kind = \"image\"\nimage = \"scene.toml\"");
    let pattern = "kind = \"pattern\"\nparent = \"#ffffff\"\ndetail = \"u\"\n\
                   points = [[0, 0], [1, 0], [0, 1]]\n[texture.u]\nkind = \"wood\"\n";
    for (from, to) in [
        ("parent = \"#ffffff\"\n", ""),
        ("parent = \"#ffffff\"", "parent = \"#fff\""),
        ("parent = \"#ffffff\"", "parent = [1, 2, 1]"),
        ("detail = \"u\"", "detail = \"v\""),
        ("detail = \"u\"", "detail = \"t\""),
        ("points = [[0, 0], [1, 0], [0, 1]]\n", ""),
        ("[1, 0], [0, 1]", "[0, 1], [1, 0]"),
        ("[0, 0], [1, 0], [0, 1]", "[0, 0], [1, 0]"),
        ("[0, 0], [1, 0], [0, 1]", "[0, 0], [1, 0], [0, 200]"),
        ("kind = \"wood\"", "kind = \"wood\"\nparent = \"t\""),
        ("kind = \"wood\"", "kind = \"pattern\"\nparent = \"t\"\ndetail = \"#000000\"\npoints = []"),
    ] {
        change(pattern, from, to);
    }
    let deep: String = (0..9)
        .map(|k| {
            format!(
                "[texture.t{k}]\nkind = \"pattern\"\nparent = \"t{}\"\n\
                     detail = \"#ffffff\"\npoints = [[0, 0], [1, 0], [0, 1]]\n",
                k + 1
            )
        })
        .collect();
    change(
        &format!("kind = \"wood\"\n{deep}[texture.t9]\nkind = \"wood\"\n"),
        "kind = \"wood\"\n[texture.t0]",
        "kind = \"wood\"\nrings = 2\n[texture.t0]",
    );
    for relief in ["bump", "frame"] {
        let bumpy = WORLD.to_owned() + "[texture.t]\nkind = \"marble\"\n";
        said.change(
            &bumpy,
            "shininess = 40",
            &format!("shininess = 40\n{relief} = {{ texture = \"t\", strength = 0.1 }}"),
        );
    }
    said.scene(b"kind = \"texture\"\nwidth = 0\n[texture]\nkind = \"noise\"\n");
    said.scene(b"kind = \"texture\"\ncentre = [127, 0]\n[texture]\nkind = \"noise\"\n");
    assert_snapshot!(said);
}

/// The table of a scene of the kind `texture` is `[texture]`, without a name.
#[test]
fn the_one_texture_of_a_scene_has_no_name() {
    let directory = tempfile::tempdir().unwrap();
    for (keys, said) in [
        ("colors = [\"#000000\"]", "texture.colors = ["),
        ("colors = [\"#000000\", \"#ffffff\"]\nknots = [0]", "texture.knots = [0]: 1 knots for 2 colours"),
        ("colors = [\"#000000\", \"#ffffff\"]\nknots = [1, 0]", "texture.knots = [1, 0]: knot 1 is not"),
    ] {
        let scene = format!("kind = \"texture\"\n[texture]\nkind = \"noise\"\n{keys}\n");
        fs::write(directory.path().join("scene.toml"), scene).unwrap();
        let complaint = bad(directory.path(), &["dump", "scene.toml", "-o", "out.png"]);
        assert!(complaint.contains(&format!(": {said}")), "{keys}: {complaint}");
    }
}
