//! Encoded pictures.

use attractor::codec::{Profile, open};

use super::module::{Module, variant};
use crate::scene::image::{ImageScene, Shown};

/// A stream, what it needs, and its decoder.
pub(super) fn image(scene: &ImageScene, module: &mut Module, gallery: bool) {
    let Shown::Stream(bytes, header) = &scene.shown else { return };
    let line = |line: &[u8]| {
        let line: Vec<String> = line.iter().map(|byte| format!("{byte:#04x}")).collect();
        format!("    {},\n", line.join(", "))
    };
    let lines: String = bytes.chunks(16).map(line).collect();
    let head = format!("#[rustfmt::skip]\npub static STREAM: [u8; {}] = [\n", bytes.len());
    module.item("The stream.", &format!("{head}{lines}];\n"));
    let size = format!("Size::new({}, {})", header.size.width, header.size.height);
    module.constant("How large the picture is.", "SIZE", "Size", size);
    let sample = if header.deep { "u16" } else { "u8" };
    module.item("A sample.", &format!("pub type Sample = {sample};\n"));
    let opened = open(bytes.iter().copied());
    let samples = [-2, -1, 0, 1, 2].map(|scale| opened.as_ref().map_or(0, |opened| opened.samples(scale)));
    let doc = "How many samples its decoder borrows: a quarter as large to four times as large.";
    module.constant(doc, "SAMPLES", "[usize; 5]", format_args!("{samples:?}"));
    let source = "core::iter::Copied<core::slice::Iter<'static, u8>>";
    let (doc, kind, way) = match header.profile {
        Profile::Streaming => ("Its rows, band by band.", "Stream", "stream"),
        Profile::Iterated | Profile::Pure => {
            ("The picture, black before its first sweep.", "Sweeps", "sweeps")
        }
    };
    module.function(
        &format!("{doc} It is `2^scale` times as large."),
        "[`Error::OutOfRange`] for a scale beyond 2, [`Error::BufferLength`] for fewer samples than [`SAMPLES`].",
        &format!("fn decoder(scale: i32, memory: &mut [Sample]) -> Result<{kind}<'_, Sample, {source}>, Error>"),
        &[format!("open(STREAM.iter().copied())?.{way}(scale, memory)")],
    );
    let count = scene.sweeps.len();
    if count > 0 {
        let doc = "After how many sweeps it is shown.";
        module.constant(doc, "SWEEPS", &format!("[u32; {count}]"), format_args!("{:?}", scene.sweeps));
    }
    if gallery {
        let tones = scene.tones.map_or("None".to_owned(), |tones| {
            format!("Some(Tones {{ palette: Named::{:?}, range: {:?} }})", tones.palette, tones.range)
        });
        let sweeps = if count > 0 { "&SWEEPS" } else { "&[]" };
        let fields = [("stream", "&STREAM".to_owned()), ("sweeps", sweeps.to_owned()), ("tones", tones)];
        let picture = variant("ImagePicture", &fields);
        module.constant("The picture.", "PICTURE", "ImagePicture<'static>", picture);
    }
}
