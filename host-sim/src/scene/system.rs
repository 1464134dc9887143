//! Maps of a scene file: `[[a, b, c, d, e, f, p], ...]` as an iterated function system.

use attractor::Error;
use attractor::ifs::{Affine, Ifs, MAX_MAPS};
use attractor::num::{Real, Unit};
use toml::Spanned;

use crate::fail::Fail;
use crate::source::{Num, Source};

/// The list as a file gives it.
pub(super) type Maps = Spanned<Vec<Spanned<[Num; 7]>>>;

/// The system of these maps.
pub(super) fn system(source: &Source, list: &Maps) -> Result<Box<Ifs<MAX_MAPS>>, Fail> {
    let (mut maps, mut shares) = (Vec::new(), Vec::new());
    for (i, map) in list.get_ref().iter().enumerate() {
        let [a, b, c, d, e, f, p] = map.get_ref();
        let unit = |n: &Num, k: usize| source.fixed::<Unit>(n, &format!("maps[{i}][{k}]"));
        let real = |n: &Num, k: usize| source.fixed::<Real>(n, &format!("maps[{i}][{k}]"));
        let linear = [unit(a, 0)?, unit(b, 1)?, unit(c, 2)?, unit(d, 3)?];
        maps.push(Affine::new(linear, [real(e, 4)?, real(f, 5)?]));
        shares.push(unit(p, 6)?);
    }
    Ifs::new(&maps, &shares).map(Box::new).map_err(|error| explain(source, list, error))
}

/// The kernel's error with the map that it is about.
fn explain(source: &Source, maps: &Maps, error: Error) -> Fail {
    let map = |index: usize, key: String, reason: &dyn std::fmt::Display| {
        let span = maps.get_ref().get(index).map_or(maps.span(), Spanned::span);
        source.fail(span, &key, reason)
    };
    match error {
        Error::NotContractive { map: index } => {
            map(index, format!("maps[{index}]"), &"it is not a contraction")
        }
        Error::OutOfRange { what: "probability", index: Some(index), .. } => {
            map(index, format!("maps[{index}][6]"), &error)
        }
        Error::OutOfRange { index: Some(index), .. } => map(index, format!("maps[{index}]"), &error),
        _ => source.fail(maps.span(), "maps", error),
    }
}
