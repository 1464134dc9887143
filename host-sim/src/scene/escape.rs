//! What Mandelbrot and Julia scenes share: the view, the limit, the colours, the CSV.

use attractor::Error;
use attractor::escape::{MAX_DWELL, View};
use attractor::num::Complex;
use attractor::num::{Limbs, Wide};
use attractor::plane::MAX_SIDE;
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};

use super::coloring::Coloring;
use super::deep::{self, Deep};
use super::keys::{Keys, count};
use super::motion::{Motion, Sight};
use crate::color::Depth;
use crate::fail::{Fail, shortened};
use crate::number::{self, exact};
use crate::palette::{Colors, Named, color};
use crate::source::Source;
use crate::table::Csv;

/// What is seen, and how.
#[derive(Debug)]
pub(crate) struct Escape {
    /// What messages call the scene.
    file: String,
    pub(crate) centre: Complex<Wide>,
    /// None: as much as shows the home rectangle.
    pub(crate) width: Option<Wide>,
    /// Width and height that are shown at least.
    pub(crate) home: (Wide, Wide),
    /// The view with all its digits, if it may be too fine for 32 bits.
    pub(crate) deep: Option<Deep>,
    goes_deep: bool,
    pub(crate) max_dwell: u32,
    pub(crate) coloring: Coloring,
    pub(crate) equalised: bool,
    pub(crate) colors: Colors,
    /// On displays without colour.
    pub(crate) grey: Colors,
}

impl Escape {
    /// `home` is what a scene without a width shows at least: the middle's real part, width and height.
    pub(super) fn load(source: &Source, keys: &Keys<'_>, home: [Wide; 3]) -> Result<Self, Fail> {
        let [middle, home_width, home_height] = home;
        let centre = match keys.centre {
            Some(centre) => {
                let [re, im] = source.pair(centre.get_ref(), "centre")?;
                Complex::new(re, im)
            }
            None => Complex::new(middle, Wide::ZERO),
        };
        let width = keys.width.map(|width| source.fixed::<Wide>(width, "width")).transpose()?;
        let max_dwell = count(source, "max_dwell", keys.max_dwell, MAX_DWELL)?.unwrap_or(100);
        let colors = Colors {
            named: keys.palette.unwrap_or(Named::CourseUnit),
            lift: keys.lift,
            cycle: count(source, "cycle", keys.cycle, MAX_DWELL)?,
            inside: keys.inside.map_or(Ok(Rgb888::BLACK), |text| color(source, "inside", text))?,
        };
        let grey = match keys.grey {
            None => colors,
            Some(grey) => Colors {
                named: grey.palette.unwrap_or(Named::Grey),
                lift: grey.lift,
                cycle: count(source, "grey.cycle", grey.cycle.as_ref(), MAX_DWELL)?,
                inside: grey
                    .inside
                    .as_ref()
                    .map_or(Ok(Rgb888::BLACK), |text| color(source, "grey.inside", text))?,
            },
        };
        let coloring = keys.coloring.map_or(Coloring::Dwell, |coloring| *coloring.get_ref());
        if let Some(cycle) = keys.cycle.filter(|_| keys.equalised) {
            return Err(source.fail(cycle.span(), "cycle", "an equalised palette does not come round"));
        }
        let deep = if keys.goes_deep { Deep::load(source, keys)? } else { None };
        let is_deep =
            deep.is_some() && keys.width.is_some_and(|w| number::float(source.digits(w)) < deep::UNIT);
        let scene = Self {
            file: source.name.clone(),
            centre,
            width,
            home: (home_width, home_height),
            deep,
            goes_deep: keys.goes_deep,
            max_dwell,
            coloring,
            equalised: keys.equalised,
            colors,
            grey,
        };
        if let Some(width) = keys.width.filter(|_| !is_deep) {
            // the coarsest grid there is: what it refuses, every size refuses
            View::new(centre, scene.width.unwrap_or_default(), Size::new(1, 1))
                .map_err(|error| source.fail(width.span(), "width", error))?;
        }
        Ok(scene)
    }

    /// The deep view on a display of this size, if 32 bits are too coarse for it.
    pub(super) fn deep_view(&self, size: Size) -> Result<Option<deep::View>, Fail> {
        let Some(deep) = self.deep.filter(|_| self.view(size).is_err()) else { return Ok(None) };
        let Deep(Sight { width, .. }) = deep;
        deep.view(size).map(Some).map_err(|error| self.refused(&deep::decimal(width), size, error))
    }

    /// Moves about on a display of this size. Each doubling of the scale adds iterations: finer detail needs
    /// longer orbits. A dwell that is a share of ever more iterations would be ever darker: its colours are
    /// equalised from then on.
    ///
    /// The message says why not.
    pub(super) fn go(&mut self, size: Size, motion: Motion) -> Result<(), Fail> {
        /// Iterations that a doubling adds.
        const FINER: u32 = 32;
        const EDGE: &str = "there is nothing further out";
        let max_dwell = match motion {
            Motion::Iterate { more: true } => self.max_dwell.saturating_mul(2),
            Motion::Iterate { more: false } => self.max_dwell / 2,
            Motion::Zoom { closer: true, .. } => self.max_dwell.saturating_add(FINER),
            Motion::Zoom { closer: false, .. } => {
                if self.max_dwell > 2 * FINER {
                    self.max_dwell - FINER
                } else {
                    self.max_dwell
                }
            }
            Motion::Pan { .. } | Motion::Light { .. } => self.max_dwell,
        };
        let sight = self.sight(size)?.after(motion, size).ok_or_else(|| Fail::new(EDGE))?;
        let centre = Complex::new(sight.centre.re.to_wide(), sight.centre.im.to_wide());
        let (width, deep) = (Some(sight.width.to_wide()), self.goes_deep.then_some(Deep(sight)));
        let before = (self.centre, self.width, self.deep);
        (self.centre, self.width, self.deep) = (centre, width, deep);
        let possible = match self.deep_view(size) {
            Ok(Some(_)) => Ok(()),
            Ok(None) => self.view(size).map(|_| ()),
            Err(fail) => Err(fail),
        };
        if let Err(fail) = possible {
            (self.centre, self.width, self.deep) = before;
            return Err(fail);
        }
        self.max_dwell = max_dwell.clamp(1, MAX_DWELL);
        let is_share =
            matches!(self.coloring, Coloring::Dwell | Coloring::Smooth) && self.colors.cycle.is_none();
        if let Motion::Zoom { closer: true, .. } | Motion::Iterate { more: true } = motion {
            self.equalised |= is_share;
        }
        Ok(())
    }

    /// The middle and the width with all their digits.
    fn sight(&self, size: Size) -> Result<Sight<{ deep::LIMBS }>, Fail> {
        if let Some(Deep(sight)) = self.deep {
            return Ok(sight);
        }
        let view = self.view(size)?;
        let limbs =
            |v: Wide| Limbs::from_wide(v).ok_or_else(|| Fail::new("the view is too wide to move about in"));
        let centre = Complex::new(limbs(view.centre().re)?, limbs(view.centre().im)?);
        Ok(Sight { centre, width: limbs(view.width())? })
    }

    /// Where the viewer stands, as lines of a scene file.
    pub(super) fn place(&self, size: Size) -> Result<String, Fail> {
        let Sight { centre, width } = self.sight(size)?;
        let [re, im, width] = [centre.re, centre.im, width].map(deep::decimal);
        let equalised = if self.equalised { "equalised = true\n" } else { "" };
        let max_dwell = self.max_dwell;
        Ok(format!(
            "centre = [\"{re}\", \"{im}\"]\nwidth = \"{width}\"\nmax_dwell = {max_dwell}\n{equalised}"
        ))
    }

    /// The palette on a display of colour `C`.
    pub(super) fn colors<C: Depth>(&self) -> Colors {
        if C::GREY_BITS.is_some() { self.grey } else { self.colors }
    }

    /// The view on a display of this size.
    pub(super) fn view(&self, size: Size) -> Result<View, Fail> {
        let width = self.width.unwrap_or_else(|| {
            // as much as shows the home width and the home height
            let (width, height) = self.home;
            let scaled =
                i128::from(height.to_bits()) * i128::from(size.width) / i128::from(size.height.max(1));
            width.max(Wide::from_bits(scaled.min(i128::from(i64::MAX)) as i64))
        });
        View::new(self.centre, width, size).map_err(|error| self.refused(&exact(width), size, error))
    }

    /// The kernel's error with the width that is shown now.
    fn refused(&self, width: &str, size: Size, error: Error) -> Fail {
        let (file, width) = (&self.file, shortened(width));
        Fail::new(format_args!("{file}: width = {width} on {} x {} pixels: {error}", size.width, size.height))
    }
}

/// `re,im,dwell,reference` for every pixel of a view, row by row.
pub(super) fn sample(
    view: &View,
    dwell: impl Fn(Complex<Wide>) -> u32,
    reference: impl Fn(f64, f64) -> u32,
    out: &mut Csv,
) -> Result<(), Fail> {
    debug_assert!(view.size().width <= MAX_SIDE);
    out.write_record(["re", "im", "dwell", "reference"])?;
    for row in 0..view.size().height {
        for column in 0..view.size().width {
            let p = view.point(column, row);
            let (re, im) = (p.re.to_num(), p.im.to_num());
            let (dwell, reference) = (dwell(p).to_string(), reference(re, im).to_string());
            out.write_record([exact(p.re), exact(p.im), dwell, reference])?;
        }
    }
    Ok(())
}
