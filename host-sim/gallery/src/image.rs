//! An encoded picture: decoded in one pass, or by sweeps from black, after any of which it is shown.

use attractor::Error;
use attractor::codec::{Part, Planes, Profile, Sample, open};
use attractor::draw::{Level, Palette, Picture, YCoCg};
use attractor::plane::{Field as _, from_fn};
use embedded_graphics::draw_target::DrawTargetExt as _;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::primitives::Rectangle;

use crate::named::Named;
use crate::page::{Display, Watch, paper};

/// Colours of the samples between two.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tones {
    /// Where they come from.
    pub palette: Named,
    /// The darkest sample and the brightest.
    pub range: [u32; 2],
}

/// An encoded picture ready to be drawn.
#[derive(Debug, Clone, Copy)]
pub struct ImagePicture<'a> {
    /// The stream.
    pub stream: &'a [u8],
    /// After how many sweeps it is shown, each in a frame of its own; none: once, after all.
    pub sweeps: &'a [u32],
    /// Of a grey picture; none: as its samples say.
    pub tones: Option<Tones>,
}

/// Where pictures of one size stand on a display: side by side, each as large as it fits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Frames {
    /// They are `2^scale` times as large, -2 to 2.
    pub scale: i32,
    drawn: Size,
    cell: Size,
    columns: u32,
}

impl Frames {
    /// So many pictures. The number of columns is the one that shows most of each; what does not fit at the
    /// smallest scale loses its edges.
    pub const fn new(picture: Size, display: Size, count: u32) -> Self {
        let mut best = Self::across(picture, display, count, 1);
        let mut columns = 2;
        while columns <= count {
            let other = Self::across(picture, display, count, columns);
            if other.seen() > best.seen() {
                best = other;
            }
            columns += 1;
        }
        best
    }

    const fn across(picture: Size, display: Size, count: u32, columns: u32) -> Self {
        let rows = if count == 0 { 1 } else { count.div_ceil(columns) };
        let cell = Size::new(display.width / columns, display.height / rows);
        let mut scale = 2;
        loop {
            let drawn = Size::new(scaled(picture.width, scale), scaled(picture.height, scale));
            if scale == -2 || drawn.width <= cell.width && drawn.height <= cell.height {
                return Self { scale, drawn, cell, columns };
            }
            scale -= 1;
        }
    }

    /// How much of each is seen.
    const fn shown(&self) -> Size {
        let (drawn, cell) = (self.drawn, self.cell);
        Size::new(
            if drawn.width < cell.width { drawn.width } else { cell.width },
            if drawn.height < cell.height { drawn.height } else { cell.height },
        )
    }

    const fn seen(&self) -> u64 {
        let shown = self.shown();
        shown.width as u64 * shown.height as u64
    }

    /// What is seen of a picture, and where on the display.
    pub fn at(&self, index: u32) -> (Rectangle, Point) {
        let shown = self.shown();
        let half = |v: u32| (v / 2) as i32;
        let cell = Point::new(
            (index % self.columns * self.cell.width) as i32,
            (index / self.columns * self.cell.height) as i32,
        );
        let gap = self.cell - shown;
        let from = self.drawn - shown;
        let seen = Rectangle::new(Point::new(half(from.width), half(from.height)), shown);
        (seen, cell + Point::new(half(gap.width), half(gap.height)))
    }
}

/// A length as it is drawn.
const fn scaled(v: u32, scale: i32) -> u32 {
    if scale >= 0 { v << scale } else { (v + (1 << -scale) - 1) >> -scale }
}

impl Tones {
    /// The colour of a sample.
    pub fn color(&self, sample: i32) -> Rgb888 {
        let [low, high] = self.range;
        let above = u32::try_from(sample).unwrap_or(0).saturating_sub(low);
        self.palette.at(Level::ratio(above, high.saturating_sub(low)))
    }
}

impl ImagePicture<'_> {
    /// Where its frames stand on a display.
    ///
    /// # Errors
    /// Those of [`open`].
    pub fn frames(&self, display: Size) -> Result<Frames, Error> {
        let header = *open(self.stream.iter().copied())?.header();
        Ok(Frames::new(header.size, display, self.sweeps.len() as u32))
    }

    /// Draws it, in memory of as many samples as [`Opened::samples`](attractor::codec::Opened::samples) says
    /// at the scale of its [frames](ImagePicture::frames).
    ///
    /// # Errors
    /// Those of the decoder. What was drawn before stays.
    pub fn draw<S: Sample, D: Display>(
        &self,
        size: Size,
        target: &mut D,
        memory: &mut [S],
        watch: Watch<'_, D>,
    ) -> Result<(), Error>
    where
        YCoCg: Palette<[S; 3]>,
    {
        let opened = open(self.stream.iter().copied())?;
        let (header, frames) = (*opened.header(), self.frames(size)?);
        let grey = Tones { palette: Named::Grey, range: [0, (1 << S::BITS) - 1] };
        let tones = if header.planes == Planes::Grey { self.tones.or(Some(grey)) } else { None };
        let color = |value: [S; 3]| match tones {
            Some(tones) => tones.color(value[0].number()),
            None => YCoCg.rgb(value),
        };
        paper(size, target);
        let last = [u32::from(header.reach)];
        let wanted = if self.sweeps.is_empty() { &last[..] } else { self.sweeps };
        let all = wanted.len() as u32 * frames.shown().height;
        if header.profile == Profile::Streaming {
            let mut stream = opened.stream(frames.scale, memory)?;
            while let Some(band) = stream.next_band()? {
                if !show(&band, color, frames.at(0), target, &mut |target, row| watch(target, row, all)) {
                    break;
                }
            }
            return Ok(());
        }
        let mut sweeps = opened.sweeps(frames.scale, memory)?;
        let (mut before, mut done) = (0, 0);
        for (index, count) in (0..).zip(wanted) {
            while done < *count {
                done = sweeps.sweep()?;
            }
            let mut watch = |target: &mut D, row| watch(target, before + row, all);
            if !show(&sweeps.picture(), color, frames.at(index), target, &mut watch) {
                break;
            }
            before += frames.shown().height;
        }
        Ok(())
    }
}

/// Draws those rows of a part that are seen, `seen` of the picture at a point of the display; false where it
/// was stopped. `watch` is told how many rows of the picture are done.
fn show<S: Sample, D: Display>(
    part: &Part<'_, S>,
    color: impl Fn([S; 3]) -> Rgb888,
    (seen, at): (Rectangle, Point),
    target: &mut D,
    watch: &mut dyn FnMut(&mut D, u32) -> bool,
) -> bool {
    let (left, above) = (seen.top_left.x.unsigned_abs(), seen.top_left.y.unsigned_abs());
    let first = above.saturating_sub(part.top());
    let end = (above + seen.size.height).saturating_sub(part.top()).min(part.size().height);
    let rows = end.saturating_sub(first);
    // rows of the picture that are seen above this part
    let before = (part.top() + first).saturating_sub(above);
    let at = at + Point::new(0, before as i32);
    let field = from_fn(Size::new(seen.size.width, rows), |x, y| part.at(x + left, y + first));
    let picture = Picture::<_, _, D::Color>::new(field, color).with_dither_origin(at);
    for row in 0..rows {
        let Ok(()) = picture.draw_row(&mut target.translated(at), row);
        if !watch(target, before + row + 1) {
            return false;
        }
    }
    true
}
