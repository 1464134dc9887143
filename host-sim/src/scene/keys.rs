//! The keys that Mandelbrot and Julia scenes share.

use serde::Deserialize;
use toml::Spanned;

use super::coloring::Coloring;
use crate::fail::Fail;
use crate::palette::Named;
use crate::source::{Num, Source};

/// Keys of both kinds, as their files give them.
#[derive(Debug)]
pub(super) struct Keys<'a> {
    pub(super) centre: Option<&'a Spanned<[Num; 2]>>,
    pub(super) width: Option<&'a Num>,
    pub(super) max_dwell: Option<&'a Spanned<i64>>,
    pub(super) palette: Option<Named>,
    pub(super) lift: bool,
    pub(super) cycle: Option<&'a Spanned<i64>>,
    pub(super) inside: Option<&'a Spanned<String>>,
    pub(super) grey: Option<&'a Grey>,
    pub(super) coloring: Option<&'a Spanned<Coloring>>,
    pub(super) equalised: bool,
    /// Whether there are pictures beyond 32 bits.
    pub(super) goes_deep: bool,
}

/// The table `[grey]`: the colours on displays without colour.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Grey {
    pub(super) palette: Option<Named>,
    #[serde(default)]
    pub(super) lift: bool,
    pub(super) cycle: Option<Spanned<i64>>,
    pub(super) inside: Option<Spanned<String>>,
}

/// A count from 1 on.
pub(super) fn count(
    source: &Source,
    key: &str,
    given: Option<&Spanned<i64>>,
    most: u32,
) -> Result<Option<u32>, Fail> {
    let Some(given) = given else { return Ok(None) };
    match u32::try_from(*given.get_ref()) {
        Ok(n) if (1..=most).contains(&n) => Ok(Some(n)),
        _ => Err(source.fail(given.span(), key, format!("allowed is 1 to {most}"))),
    }
}
