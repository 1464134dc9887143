//! Points of a scene file: `[[x, y], ...]`.

use attractor::num::Real;
use attractor::plane::Point2;
use toml::Spanned;

use crate::fail::Fail;
use crate::source::{Num, Source};

/// The list as a file gives it.
pub(super) type Points = Spanned<Vec<Spanned<[Num; 2]>>>;

/// In the format of the kernels.
pub(super) fn points(source: &Source, key: &str, list: &Points) -> Result<Vec<Point2>, Fail> {
    let point = |(i, pair): (usize, &Spanned<[Num; 2]>)| {
        let [x, y] = source.pair::<Real>(pair.get_ref(), &format!("{key}[{i}]"))?;
        Ok(Point2::new(x, y))
    };
    list.get_ref().iter().enumerate().map(point).collect()
}
