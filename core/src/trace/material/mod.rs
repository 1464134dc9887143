//! Materials: what a surface makes of the light that reaches it.
//!
//! Source: the course unit V, section 5.9; Cochran, Lewis, Hart, sections 4 to 6.

mod anisotropic;
mod hazy;
mod highlight;
mod mixture;
mod phong;
mod respond;
mod specular;
mod sum;
mod tabulated;
mod torrance_sparrow;

pub use anisotropic::Anisotropic;
pub use hazy::Hazy;
pub use highlight::Highlight;
pub use mixture::{Clear, Interior, Mixture};
pub use phong::Phong;
pub use respond::{Lit, Material, Medium, Response};
pub use specular::{Sight, Specular};
pub use tabulated::Tabulated;
pub use torrance_sparrow::TorranceSparrow;
