//! The key `contrast` of scenes in light: which greys a display of few levels shows as black and as white.

use toml::Spanned;

use crate::fail::Fail;
use crate::source::Source;

/// Two greys, if any are given.
pub(super) fn contrast(source: &Source, given: Option<&Spanned<[i64; 2]>>) -> Result<Option<[u8; 2]>, Fail> {
    let Some(given) = given else { return Ok(None) };
    match given.get_ref().map(u8::try_from) {
        [Ok(black), Ok(white)] if black < white => Ok(Some([black, white])),
        _ => {
            let reason = "allowed are two greys from 0 to 255, the darker first";
            Err(source.fail(given.span(), "contrast", reason))
        }
    }
}
