//! `attractor encode`: a PNG file as a stream of core's codec.

mod bins;
mod cosine;
mod file;
mod fill;
mod finest;
mod partition;
mod polish;
mod quality;
mod quantise;
mod range_encoder;
mod rate;
mod rounded;
mod samples;
mod search;
mod settled;
mod target;
mod trials;

use std::io::Write as _;

use attractor::codec::Profile;
use indicatif::{ProgressBar, ProgressStyle};

pub(crate) use file::Plan;
pub(crate) use partition::Without;
use quality::ms_ssim;
pub(crate) use rate::meet;
pub(crate) use search::Effort;
pub(crate) use target::{Encoded, Target};

use crate::cli::{Encode, EncodeEffort, EncodePart, EncodeProfile};
use crate::decode::decoded;
use crate::fail::{Fail, say};
use crate::output;
use crate::still::{Pixels, Still};

impl Effort {
    /// How hard to look.
    pub(crate) const FAST: Self = Self {
        isometries: 1,
        candidates: 2,
        far: false,
        rounds: 1,
        polish: false,
        whole: 0.7,
        filled: 0.995,
        again: false,
    };
    pub(crate) const BEST: Self = Self {
        isometries: 8,
        candidates: 16,
        far: true,
        rounds: 2,
        polish: true,
        whole: 0.95,
        filled: 0.998,
        again: true,
    };
}

impl Plan {
    /// As the command encodes.
    pub(crate) const fn new(profile: Profile) -> Self {
        let (reach, without) = (
            match profile {
                Profile::Streaming => 8,
                Profile::Iterated => 4,
                Profile::Pure => 8,
            },
            Without { domains: false, transform: false, split: false },
        );
        Self { profile, reach, chroma: 20, without }
    }
}

/// Reads a picture, encodes it and writes the stream.
pub(crate) fn run(args: &Encode) -> Result<(), Fail> {
    output::check_beside(&args.output, [&*args.image])?;
    let still = Still::load(&args.image, args.ground)?;
    let pixels = f64::from(still.size.width) * f64::from(still.size.height);
    let target = match (args.bytes, args.bpp, args.psnr) {
        (Some(bytes), ..) => Target::Bytes(bytes as f64),
        (_, Some(bpp), _) => Target::Bytes((bpp * pixels / 8.0).max(1.0)),
        (.., psnr) => Target::Decibels(psnr.unwrap_or(36.0)),
    };
    let plan = Plan::new(match args.profile {
        EncodeProfile::Streaming => Profile::Streaming,
        EncodeProfile::Iterated => Profile::Iterated,
        EncodeProfile::Pure => Profile::Pure,
    });
    let without = Without {
        domains: args.without == Some(EncodePart::Domains),
        transform: args.without == Some(EncodePart::Transform),
        split: args.without == Some(EncodePart::Split),
    };
    if let (Some(sweeps), Profile::Streaming) = (args.sweeps, plan.profile) {
        return Err(Fail::new(format_args!(
            "--sweeps {sweeps}: profile streaming is decoded in one pass; iterated and pure have sweeps"
        )));
    }
    let plan = Plan { without, reach: args.sweeps.unwrap_or(plan.reach), ..plan };
    let effort = match args.effort {
        EncodeEffort::Fast => Effort::FAST,
        EncodeEffort::Best => Effort::BEST,
    };
    let bar = ProgressBar::new_spinner();
    if let Ok(style) = ProgressStyle::with_template("{spinner} encoding {pos}: {msg}") {
        bar.set_style(style);
    }
    let mut tell = |encoded: &Encoded| {
        bar.inc(1);
        bar.set_message(format!("{} bytes, {:.2} dB", encoded.bytes.len(), encoded.psnr));
    };
    let best = meet(&still, !args.full_chroma, plan, effort, target, &mut tell)
        .map_err(|error| Fail::new(format_args!("{}: {error}", args.image.display())))?;
    bar.finish_and_clear();
    let length = best.bytes.len();
    match target {
        Target::Bytes(bytes) if length as f64 > bytes => say(&format!(
            "{} bytes are too few: the smallest file of this picture has {length}",
            bytes as u64
        )),
        Target::Bytes(bytes) if (length as f64) < 0.99 * bytes - 1.0 && best.psnr.is_infinite() => {
            say(&format!(
                "{} bytes are more than the picture takes: with {length} it is exact",
                bytes as u64
            ));
        }
        Target::Bytes(bytes) if (length as f64) < 0.99 * bytes - 1.0 && best.finest => {
            say(&format!("{} bytes are more than the finest step takes: {length}", bytes as u64));
        }
        Target::Bytes(bytes) if (length as f64) < 0.99 * bytes - 1.0 => {
            say(&format!("{} bytes are not met: the best file below has {length}", bytes as u64));
        }
        Target::Decibels(decibels) if best.psnr < decibels => {
            // what is lost with three quarters of the chroma no step brings back
            let halved = matches!(still.pixels, Pixels::Colour(_)) && !args.full_chroma;
            let more = if halved { "; --full-chroma keeps all samples of chroma" } else { "" };
            say(&format!("{decibels} dB are out of reach: {:.2} dB{more}", best.psnr));
        }
        _ => {}
    }
    output::write(&args.output, &best.bytes)?;
    let picture = decoded(&best.bytes, 0, None)
        .map_err(|error| Fail::new(format_args!("{}: {error}", args.output.display())))?;
    let (truth, got) = (still.samples(), picture.samples());
    let channels = (truth.len() as f64 / pixels) as usize;
    let alike = ms_ssim(truth, got, still.size.width, channels, still.peak());
    let alike = alike.map_or_else(String::new, |alike| format!(", MS-SSIM {alike:.4}"));
    writeln!(
        std::io::stdout(),
        "{}: {length} bytes, {:.4} bits a pixel, PSNR {:.2} dB{alike}",
        args.output.display(),
        8.0 * length as f64 / pixels,
        best.psnr
    )?;
    Ok(())
}
