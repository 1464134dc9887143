//! `attractor sample`: the numbers of a scene as CSV on standard output.

use crate::cli::Sample;
use crate::fail::Fail;
use crate::scene::{self, Question, Request};
use crate::table;

/// The seed of the points that are listed.
const SEED: u64 = 1;

/// Writes the header and a line a point.
pub(crate) fn run(args: &Sample) -> Result<(), Fail> {
    let scene = scene::load(&args.scene)?;
    let mut out = table::records();
    let request = Request { size: args.size, seed: SEED };
    let question = match (&args.rays, &args.along, &args.at) {
        (Some(file), ..) => Question::Rays(file),
        (_, Some(ray), _) => Question::Along(ray),
        (.., Some(file)) => Question::Places(file),
        _ if args.pixels => Question::Pixels,
        _ => Question::Usual,
    };
    scene.sample(&request, question, args.points, &mut out)?;
    out.flush()?;
    Ok(())
}
