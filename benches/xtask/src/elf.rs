//! Sizes of an image.

use std::path::Path;

use anyhow::{Context, Result};
use object::{Object, ObjectSection, SectionFlags, SectionKind};

/// Bytes of an image, by where they lie.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Sizes {
    /// Code, constants and initial values; without the vector table, whose length is the chip's affair.
    pub(crate) flash: u64,
    /// Initialised static data, in flash and in RAM.
    pub(crate) data: u64,
    /// Static data that starts as zero.
    pub(crate) bss: u64,
}

/// Reads the sizes of the image at `path`.
pub(crate) fn sizes(path: &Path) -> Result<Sizes> {
    let bytes = std::fs::read(path).with_context(|| format!("{} cannot be read", path.display()))?;
    let file = object::File::parse(&*bytes).with_context(|| format!("{} is no image", path.display()))?;
    let mut sizes = Sizes::default();
    for section in file.sections() {
        let SectionFlags::Elf { sh_flags, .. } = section.flags() else { continue };
        if (sh_flags & object::elf::SHF_ALLOC).0 == 0 {
            continue;
        }
        let name = section.name().unwrap_or_default();
        match section.kind() {
            // .stack and .uninit of the start-up code reserve what is left of RAM
            SectionKind::UninitializedData if name == ".bss" => sizes.bss += section.size(),
            SectionKind::UninitializedData => {}
            _ if name == ".vector_table" || name == ".heap" || name == ".stack" => {}
            SectionKind::Data => {
                sizes.data += section.size();
                sizes.flash += section.size();
            }
            _ => sizes.flash += section.size(),
        }
    }
    Ok(sizes)
}
