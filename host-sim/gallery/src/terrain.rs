//! A landscape: a surface by subdivision, or given heights, under a sun, in air, over a plain or a sea.

use attractor::Error;
use attractor::num::{RandomField, Real, Rgb, Unit, Vec3};
use attractor::terrain::{Heights, InnerGeometry, Law, PlaneToLine, Rows};
use attractor::trace::material::{Hazy, Mixture};
use attractor::trace::texture::{Landscape, Noise, Turbulence};
use attractor::trace::world::{Lamp, Leaf, Object, Op, World, WorldCaster};
use attractor::trace::{Camera, Extent, Filter, HeightRange, Sampling, Sky, Terrain};
use embedded_graphics::geometry::Size;

use crate::page::{Display, Watch, draw_field};
use crate::shade::Shade;

attractor::materials! {
    /// What it is made of.
    #[derive(Debug, Clone, Copy)]
    enum Stuff {
        /// The land.
        Land(Hazy<Mixture<Landscape>>),
        /// The plain or the sea, and land of one colour.
        Plain(Hazy<Mixture>),
    }
}

/// The colours of the land by height and slope, as [`Landscape`] has them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ground {
    /// Below the shore.
    pub sand: Rgb,
    /// Above it.
    pub grass: Rgb,
    /// Where it is steep.
    pub rock: Rgb,
    /// Where it is high.
    pub snow: Rgb,
    /// The height of the shore.
    pub shore: Real,
    /// The height from which snow lies.
    pub snow_line: Real,
    /// The vertical part of the normal below which there is rock.
    pub steep: Unit,
    /// How wide passages are.
    pub passage: Unit,
    /// How ragged lines are: the grains a unit, and by how much of height.
    pub ragged: (Real, Unit),
}

/// A plain or a sea.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Floor {
    /// How high it lies.
    pub level: Real,
    /// Its own colour.
    pub color: Rgb,
    /// How much it mirrors.
    pub reflect: Rgb,
}

/// A landscape ready to be drawn.
#[derive(Debug, Clone, Copy)]
pub struct TerrainPicture<'a> {
    /// Heights of the knots, rows from south to north.
    pub knots: &'a [Real],
    /// How many columns of knots there are.
    pub columns: u32,
    /// The coordinates of the first knot.
    pub origin: [i16; 2],
    /// How rough it is, and how much of that is left at small scales.
    pub roughness: (Unit, Unit),
    /// The seed of its random numbers, and which of its surfaces it is.
    pub seed: (u64, u32),
    /// How often a cell between four knots is halved.
    pub levels: u32,
    /// What spans the finest cells.
    pub inner: InnerGeometry,
    /// The ends along x and y.
    pub over: [[Real; 2]; 2],
    /// Its colours.
    pub ground: Ground,
    /// What lies round it.
    pub plain: Option<Floor>,
    /// Towards the sun, and its light.
    pub sun: (Vec3, Rgb),
    /// How much of their colour things show in the shade.
    pub ambient: Unit,
    /// The sky; its horizon is the colour of the air.
    pub sky: Sky,
    /// How much of the light a unit of air takes.
    pub haze: Unit,
    /// Where the eye stands, what it looks at, and the vertical angle of view in degrees.
    pub view: (Vec3, Vec3, Real),
    /// Samples a side of a pixel.
    pub samples: u8,
    /// The greys that a display of 16 levels or fewer shows as black and as white.
    pub contrast: Option<[u8; 2]>,
}

/// What a landscape borrows while it is drawn.
#[derive(Debug)]
pub struct TerrainMemory<'m> {
    /// All heights of the finest lattice: [`TerrainPicture::heights`].
    pub heights: &'m mut [Real],
    /// Rows while they are streamed: [`TerrainPicture::words`].
    pub rows: &'m mut [Real],
    /// Bounds: [`TerrainPicture::ranges`].
    pub ranges: &'m mut [HeightRange],
}

impl TerrainPicture<'_> {
    /// How many rows of knots there are.
    const fn knot_rows(&self) -> u32 {
        match (self.knots.len() as u32).checked_div(self.columns) {
            Some(rows) => rows,
            None => 0,
        }
    }

    /// Columns and rows of the finest lattice.
    pub const fn lattice(&self) -> (u32, u32) {
        (
            (self.columns.saturating_sub(1) << self.levels) + 1,
            (self.knot_rows().saturating_sub(1) << self.levels) + 1,
        )
    }

    /// How many heights are lent.
    pub const fn heights(&self) -> usize {
        let (columns, rows) = self.lattice();
        columns as usize * rows as usize
    }

    /// How many heights are lent for rows.
    pub const fn words(&self) -> usize {
        Rows::<RandomField>::words(self.columns.saturating_sub(1), self.levels)
    }

    /// How many bounds are lent; for a lattice of at least 2 x 2.
    pub const fn ranges(&self) -> usize {
        let (columns, rows) = self.lattice();
        Terrain::ranges(columns, rows)
    }

    /// The function.
    ///
    /// # Errors
    /// Those of [`Heights::new`], [`Law::new`] and [`PlaneToLine::new`].
    pub fn function(&self) -> Result<PlaneToLine<'_>, Error> {
        let [u, v] = self.origin;
        let knots = Heights::new(self.columns, self.knot_rows(), self.knots)?.with_origin(u, v)?;
        let random = RandomField::new(self.seed.0).numbered(self.seed.1);
        PlaneToLine::new(knots, Law::new(self.roughness.0, self.roughness.1)?, random)
    }

    /// Draws it; `seed` is that of the samples.
    ///
    /// # Errors
    /// Those of the constructors of core; [`Error::BufferLength`] for too little memory.
    pub fn draw<D: Display>(
        &self,
        (size, seed): (Size, u32),
        memory: TerrainMemory<'_>,
        target: &mut D,
        watch: Watch<'_, D>,
    ) -> Result<(), Error> {
        self.stream(memory.heights, memory.rows)?;
        let (columns, rows) = self.lattice();
        let heights = memory.heights.get(..self.heights()).unwrap_or_default();
        let land = Terrain::new(Heights::new(columns, rows, heights)?, self.inner, self.over, memory.ranges)?;
        let land = self.plain.map_or(land, |plain| land.with_plain(plain.level));
        self.draw_land(land, (size, seed), target, watch)
    }

    /// Streams the finest lattice.
    #[inline(never)]
    fn stream(&self, heights: &mut [Real], rows: &mut [Real]) -> Result<(), Error> {
        Rows::new(&self.function()?, self.levels, rows)?.write(heights)
    }

    /// Draws the surface among what surrounds it.
    #[inline(never)]
    fn draw_land<D: Display>(
        &self,
        land: Terrain<'_>,
        (size, seed): (Size, u32),
        target: &mut D,
        watch: Watch<'_, D>,
    ) -> Result<(), Error> {
        let (eye, look_at, field_of_view) = self.view;
        let (air, density) = (self.sky.horizon, self.haze);
        let Ground { sand, grass, rock, snow, shore, snow_line, steep, passage, ragged } = self.ground;
        let ragged = (Turbulence::new(Noise::new(1), ragged.0, 4)?, ragged.1);
        let land_stuff = Landscape { sand, grass, rock, snow, shore, snow_line, steep, passage, ragged };
        let lit = Unit::ONE.saturating_sub(self.ambient);
        let land_stuff = if [sand, rock, snow] == [grass; 3] {
            // of one colour, whatever its height and slope
            let material = Mixture::matt(grass).with_parts(self.ambient, lit)?;
            Stuff::Plain(Hazy { material, eye, air, density })
        } else {
            let material = Mixture::matt(land_stuff).with_parts(self.ambient, lit)?;
            Stuff::Land(Hazy { material, eye, air, density })
        };
        let plain = self.plain.unwrap_or(Floor { level: Real::ZERO, color: Rgb::BLACK, reflect: Rgb::BLACK });
        let material =
            Mixture::matt(plain.color).with_parts(self.ambient, lit)?.with_reflection(plain.reflect);
        let stuff = [land_stuff, Stuff::Plain(Hazy { material, eye, air, density })];
        let leaves = [Leaf { surface: land, materials: &[0, 1] }];
        let surface = |leaf: usize| leaves.get(leaf).map(|leaf| &leaf.surface);
        let mut extents = [Extent::NOTHING];
        let objects = [Object::new(&[Op::Leaf(0)], surface, &mut extents)?];
        let lamps = [Lamp::distant(self.sun.0, self.sun.1)?];
        let world = World::of_leaves(&leaves, &objects, &stuff)?.with_lamps(&lamps);
        let camera = Camera::new(eye, look_at, Vec3::Z, field_of_view)?;
        let caster = WorldCaster::<_, _, _, 9, 4, _>::new(world, self.sky, camera, size)?;
        let sampling = match self.samples {
            1 => Sampling::Centre,
            n => Sampling::Jittered { n, seed },
        };
        let caster = caster.with_sampling(sampling, Filter::Box)?;
        draw_field(&caster, Shade::new::<D::Color>(self.contrast)?, target, watch);
        Ok(())
    }
}
