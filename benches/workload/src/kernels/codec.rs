//! Images: a photograph of 240 x 240 at 0.27 bits a pixel, in one pass and by sweeps.

use attractor::codec::{Luma, Part, open};
use attractor::plane::Field;

use super::watch::{Tally, Watch};

static STREAMING: &[u8] = include_bytes!("../../../../tests/vectors/version-2/camera-streaming.atfi");
static TWO_SWEEPS: &[u8] = include_bytes!("../../../../tests/vectors/version-2/camera-two-sweeps.atfi");
static SWEEPS: &[u8] = include_bytes!("../../../../tests/vectors/version-2/camera-iterated.atfi");

/// What `Opened::samples` asks for in one pass.
const WINDOW: usize = 13_760;
/// The picture and 4 KiB: more than that, so that sweeps keep the leaves that they draw again.
const PICTURE: usize = 240 * 240 + 4096;

/// One sample of each row.
fn drawn(tally: &mut Tally, part: &Part<'_, u8>) {
    let size = part.size();
    for y in 0..size.height {
        let sample = Luma(*part).at((7 * y) % size.width, y);
        tally.checksum = tally.checksum.rotate_left(5) ^ u32::from(sample);
    }
    tally.units += size.width * size.height;
}

#[inline(never)]
pub(super) fn streaming(watch: &mut Watch<'_>) -> Tally {
    let mut memory = [0_u8; WINDOW];
    watch.time(|| {
        let mut tally = Tally::default();
        let stream = open(STREAMING.iter().copied()).and_then(|opened| opened.stream(0, &mut memory));
        let Ok(mut stream) = stream else { return tally };
        while let Ok(Some(band)) = stream.next_band() {
            drawn(&mut tally, &band);
        }
        tally
    })
}

fn swept(watch: &mut Watch<'_>, bytes: &'static [u8]) -> Tally {
    let mut memory = [0_u8; PICTURE];
    watch.time(|| {
        let mut tally = Tally::default();
        let sweeps = open(bytes.iter().copied()).and_then(|opened| opened.sweeps(0, &mut memory));
        let Ok(mut sweeps) = sweeps else { return tally };
        if sweeps.finish().is_ok() {
            drawn(&mut tally, &sweeps.picture());
        }
        tally
    })
}

#[inline(never)]
pub(super) fn two_sweeps(watch: &mut Watch<'_>) -> Tally {
    swept(watch, TWO_SWEEPS)
}

#[inline(never)]
pub(super) fn four_sweeps(watch: &mut Watch<'_>) -> Tally {
    swept(watch, SWEEPS)
}
