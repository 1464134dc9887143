//! Palettes as constants: core's own for firmware, and their names for the gallery.

use attractor::draw::{Gradient, gradients};

use super::module::Module;
use crate::palette::Named;

/// Type and value of a palette of core.
pub(super) fn of_core(named: Named) -> (String, String) {
    const fn stops<const N: usize>(_: &Gradient<N>) -> usize {
        N
    }
    let stops = match named {
        Named::CourseUnit | Named::Grey => return (format!("{named:?}"), format!("{named:?}")),
        Named::Dusk => stops(&gradients::DUSK),
        Named::Fire => stops(&gradients::FIRE),
        Named::Ocean => stops(&gradients::OCEAN),
        Named::Moss => stops(&gradients::MOSS),
        Named::Even => stops(&gradients::EVEN),
        Named::Porcelain => stops(&gradients::PORCELAIN),
    };
    (format!("Gradient<{stops}>"), format!("gradients::{}", format!("{named:?}").to_uppercase()))
}

/// The palette of a scene that has one and asks nothing of it.
pub(super) fn plain(named: Named, module: &mut Module, gallery: bool) {
    let (kind, value) = of_core(named);
    module.constant("Where its colours come from.", "PALETTE", &kind, value);
    if gallery {
        module.constant("The same by its name.", "NAMED", "Named", format_args!("Named::{named:?}"));
    }
}
