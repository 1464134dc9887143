//! Scene files that show what the built-in scenes do not, each beside its module as `attractor export` writes it.
#![allow(dead_code, unreachable_pub, reason = "modules as the command writes them, used in part")]

pub(crate) mod corner;
pub(crate) mod near_seahorses;
pub(crate) mod periods;
pub(crate) mod polynomials;
pub(crate) mod stopped;
pub(crate) mod turtle;
pub(crate) mod two_factors;

/// The name of each file, and the text of its module.
pub(crate) const FILES: [(&str, &str); 7] = [
    ("corner", include_str!("corner.rs")),
    ("near-seahorses", include_str!("near_seahorses.rs")),
    ("periods", include_str!("periods.rs")),
    ("polynomials", include_str!("polynomials.rs")),
    ("stopped", include_str!("stopped.rs")),
    ("turtle", include_str!("turtle.rs")),
    ("two-factors", include_str!("two_factors.rs")),
];
