//! `attractor sample --pixels` of a height field in tones.

use attractor::plane::{Field, Tone};
use attractor::trace::Found;
use embedded_graphics::geometry::Size;

use crate::fail::Fail;
use crate::table::Csv;

/// A picture with the normals of each pixel integrated, and how each pixel was found.
pub(super) trait Filtered: Field<Value = Tone> {
    fn found(&self, x: u32, y: u32) -> Found;
}

impl Filtered for attractor::trace::FilteredCaster<'_> {
    fn found(&self, x: u32, y: u32) -> Found {
        self.found(x, y)
    }
}

impl Filtered for attractor::trace::FilteredPatch<'_> {
    fn found(&self, x: u32, y: u32) -> Found {
        self.found(x, y)
    }
}

/// The tone of every pixel, filtered, if it is, by its samples, and by the ray through its centre alone.
pub(super) fn write<C: Field<Value = Tone>>(
    size: Size,
    [sampled, one]: [&C; 2],
    filtered: Option<&impl Filtered>,
    out: &mut Csv,
) -> Result<(), Fail> {
    let tone = |tone: Tone| format!("{:?}", f64::from(tone.to_bits()) / 65535.0);
    out.write_record(["i", "j", "found", "filtered", "sampled", "one"])?;
    for (j, i) in (0..size.height).flat_map(|j| (0..size.width).map(move |i| (j, i))) {
        let found = filtered.map_or("", |filtered| match filtered.found(i, j) {
            Found::Filtered => "filtered",
            Found::Sampled => "sampled",
            _ => "beyond",
        });
        let value = filtered.map_or(String::new(), |filtered| tone(filtered.at(i, j)));
        let [i_text, j_text] = [i, j].map(|place| place.to_string());
        out.write_record([&i_text, &j_text, found, &value, &tone(sampled.at(i, j)), &tone(one.at(i, j))])?;
    }
    Ok(())
}
