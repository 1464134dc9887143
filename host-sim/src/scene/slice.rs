//! `kind = "texture"`: a solid texture where a plane cuts it, clouds or lava. Its third coordinate is time.

use std::convert::Infallible;
use std::io::Write;

use attractor::draw::Srgb;
use attractor::num::Real;
use attractor::plane::{Bounds2, Field as _, Point2, Window};
use attractor::trace::texture::Slice;
use attractor_gallery::{Watch, draw_field};
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::Size;
use serde::Deserialize;
use toml::Spanned;

use super::motion::Motion;
use super::request::{Question, Request};

use super::world::texture::{Pattern, Pigment, Tables, Woven};
use super::world::values::{PIXEL, at, cells, light, values};
use crate::color::Depth;
use crate::fail::Fail;
use crate::source::{Num, Place, Source};

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(rename = "kind")]
    _kind: String,
    #[serde(rename = "title")]
    _title: Option<String>,
    texture: Spanned<Woven>,
    centre: Option<Spanned<[Num; 2]>>,
    width: Option<Num>,
    height: Option<Num>,
}

/// A texture ready to be drawn.
#[derive(Debug)]
pub(crate) struct SliceScene {
    pub(crate) pattern: Pattern,
    pub(crate) centre: [Real; 2],
    /// The shorter side of a display shows as much.
    pub(crate) width: Real,
    /// Where the plane is.
    pub(crate) height: Real,
    place: Place,
}

/// Wider, the places of a picture leave the format.
const WIDEST: u8 = 120;

impl SliceScene {
    pub(super) fn load(source: &Source) -> Result<Self, Fail> {
        let file: File = source.parse()?;
        let width = match &file.width {
            Some(number) => {
                let value = source.fixed::<Real>(number, "width")?;
                if value < Real::ONE >> 10 || value > WIDEST {
                    return Err(source.fail(
                        number.span(),
                        "width",
                        format!("allowed is 0.0009765625 to {WIDEST}"),
                    ));
                }
                value
            }
            None => Real::from_num(4),
        };
        let centre = file.centre.as_ref();
        let scene = Self {
            pattern: Pattern::load(source, "", &file.texture, &Tables::new())?,
            centre: centre.map_or(Ok([Real::ZERO; 2]), |centre| source.pair(centre.get_ref(), "centre"))?,
            width,
            height: file.height.as_ref().map_or(Ok(Real::ZERO), |number| source.fixed(number, "height"))?,
            place: match (centre, &file.width) {
                (Some(centre), _) => source.place(centre.span(), "centre"),
                (None, Some(width)) => source.place(width.span(), "width"),
                (None, None) => source.whole("texture"),
            },
        };
        scene
            .bounds()
            .ok_or_else(|| scene.place.fail("the window leaves the format, allowed is -128 to 128"))?;
        Ok(scene)
    }

    /// The square that is shown at least.
    pub(crate) fn bounds(&self) -> Option<Bounds2> {
        let [x, y] = self.centre;
        let half = self.width / 2;
        let at = |x: Option<Real>, y: Option<Real>| Some(Point2::new(x?, y?));
        Some(Bounds2 {
            min: at(x.checked_sub(half), y.checked_sub(half))?,
            max: at(x.checked_add(half), y.checked_add(half))?,
        })
    }

    fn field(&self, size: Size) -> Result<Slice<Pigment<'_>>, Fail> {
        let bounds = self.bounds().ok_or_else(|| self.place.fail("the window leaves the format"))?;
        let window = Window::fit(bounds, size).map_err(|error| self.place.fail_at(size, error))?;
        let pigment = self.pattern.pigment().map_err(|error| self.place.fail(error))?;
        Ok(Slice::new(pigment, window, self.height))
    }

    /// Moves over the plane; more iterations are a plane further up.
    pub(super) fn go(&mut self, size: Size, motion: Motion) -> Result<(), Fail> {
        let part = |pixels: i32| {
            let side = i64::from(size.width.min(size.height).max(1));
            Real::from_bits((i64::from(self.width.to_bits()) * i64::from(pixels) / side) as i32)
        };
        let before = (self.centre, self.width, self.height);
        match motion {
            Motion::Pan { right, up } => {
                let [x, y] = self.centre;
                self.centre = [x.saturating_add(part(right)), y.saturating_add(part(up))];
            }
            Motion::Zoom { closer: true, .. } => self.width /= 2,
            Motion::Zoom { closer: false, .. } => self.width = self.width.saturating_mul(Real::from_num(2)),
            Motion::Iterate { more } => {
                let step = Real::ONE / 16;
                self.height = self.height.saturating_add(if more { step } else { -step });
            }
            Motion::Light { .. } => {}
        }
        let fits =
            self.bounds().is_some() && (Real::ONE >> 10..=Real::from_num(WIDEST)).contains(&self.width);
        if !fits {
            (self.centre, self.width, self.height) = before;
            return Err(Fail::new("there is nothing further out"));
        }
        Ok(())
    }

    /// What is shown, as lines of a scene file.
    pub(super) fn place(&self) -> String {
        let [x, y] = self.centre;
        format!("centre = [{x}, {y}]\nwidth = {}\nheight = {}\n", self.width, self.height)
    }

    pub(super) fn draw<D>(&self, request: &Request, target: &mut D, watch: Watch<'_, D>) -> Result<(), Fail>
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        draw_field(&self.field(request.size)?, Srgb, target, watch);
        Ok(())
    }

    pub(super) fn sample(
        &self,
        request: &Request,
        question: Question<'_>,
        out: &mut dyn Write,
    ) -> Result<(), Fail> {
        match question {
            Question::Usual | Question::Pixels => {
                let field = self.field(request.size)?;
                let reference = at(&self.pattern);
                writeln!(out, "{PIXEL}")?;
                for j in 0..request.size.height {
                    for (i, value) in (0..request.size.width).zip(field.row(j, 0..request.size.width)) {
                        let exact = cells(Some(reference(&field.point(i, j))));
                        writeln!(out, "{i},{j},{},{exact}", light(value))?;
                    }
                }
                Ok(())
            }
            Question::Places(file) => values(&[("", &self.pattern)], file, out),
            other => Err(Fail::new(format_args!("{}: only a world is asked for that", other.option()))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_window_that_leaves_the_format_is_not_gone_to() {
        let text = "kind = \"texture\"\nwidth = 64\n[texture]\nkind = \"noise\"\n";
        let mut scene = SliceScene::load(&Source::built_in("test", text)).unwrap();
        let size = Size::new(64, 64);
        let out = Motion::Zoom { about: None, closer: false };
        assert!(scene.go(size, out).is_err() && scene.width == 64);
        let aside = Motion::Pan { right: 64, up: 0 };
        assert!(scene.go(size, aside).is_ok() && scene.go(size, aside).is_err());
        assert_eq!(scene.place(), "centre = [64, 0]\nwidth = 64\nheight = 0\n");
    }
}
