//! A path or a cloud of points as measurements see it: as dense as they ask for, with what theory says.

use attractor::Error;
use attractor::num::Real;
use attractor::plane::PathElement;

use super::law::Law;
use crate::theory::Theory;

/// Steps whose pieces are shorter than a length, in scene units.
type FinerThan<'a> = dyn Fn(Real) -> Result<Box<dyn Iterator<Item = PathElement> + 'a>, Error> + 'a;

/// A set in the plane that is traced rather than covered.
pub(crate) struct Trail<'a> {
    pub(crate) finer_than: Box<FinerThan<'a>>,
    /// The dimension of the set.
    pub(crate) theory: Option<Theory>,
    /// The dimension of its boundary.
    pub(crate) boundary: Option<Theory>,
    /// The law of a random curve.
    pub(crate) law: Option<&'a Law>,
}
