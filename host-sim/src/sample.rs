//! `attractor sample`: the numbers of a scene as CSV on standard output.

use crate::cli::Sample;
use crate::fail::Fail;
use crate::scene::{self, Request};
use crate::table;

/// The seed of the points that are listed.
const SEED: u64 = 1;

/// Writes the header and a line a point.
pub(crate) fn run(args: &Sample) -> Result<(), Fail> {
    let scene = scene::load(&args.scene)?;
    let mut out = table::records();
    let request = Request { size: args.size, seed: SEED };
    scene.sample(&request, args.points, &mut out)?;
    out.flush()?;
    Ok(())
}
