//! What a ray shows that meets nothing.

use super::environment::{Environment, is_even, part};
use crate::num::{Real, Rgb, Unit, Vec3};

/// Light from all round, infinitely far away.
pub trait Surroundings {
    /// The light from a unit direction, where `width` is how wide the cone of directions is that is asked
    /// for: finer details may be averaged.
    fn light(&self, direction: Vec3<Unit>, width: Unit) -> Rgb;
}

/// The same everywhere.
impl Surroundings for Rgb {
    fn light(&self, _: Vec3<Unit>, _: Unit) -> Rgb {
        *self
    }
}

/// In greys.
impl Surroundings for Environment {
    fn light(&self, direction: Vec3<Unit>, _: Unit) -> Rgb {
        Rgb::from_tone(self.tone(direction))
    }
}

/// A sky and a ground: from `horizon` to `zenith` with the sine of the elevation, to `nadir` downwards.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sky {
    /// Straight up.
    pub zenith: Rgb,
    /// At the horizon.
    pub horizon: Rgb,
    /// Straight down.
    pub nadir: Rgb,
}

impl Surroundings for Sky {
    fn light(&self, direction: Vec3<Unit>, _: Unit) -> Rgb {
        let pole = if direction.z < 0 { self.nadir } else { self.zenith };
        self.horizon.mixed(pole, direction.z.saturating_abs())
    }
}

/// A ceiling and a floor at unit height, tiled with squares of side `1 / scale`, faded to `horizon` where the
/// sine of the elevation falls below `fade`: [`Environment::Checkerboard`] in colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tiles {
    /// Even and odd squares of the ceiling.
    pub ceiling: [Rgb; 2],
    /// Even and odd squares of the floor.
    pub floor: [Rgb; 2],
    /// The horizon.
    pub horizon: Rgb,
    /// Squares a unit.
    pub scale: Real,
    /// Where the fading starts.
    pub fade: Unit,
}

impl Surroundings for Tiles {
    fn light(&self, direction: Vec3<Unit>, _: Unit) -> Rgb {
        let [x, y, z] = [direction.x, direction.y, direction.z].map(Unit::to_bits);
        let [even, odd] = if z < 0 { self.floor } else { self.ceiling };
        let elevation = z.unsigned_abs();
        let tile = if is_even(x, y, elevation, self.scale) { even } else { odd };
        let fade = self.fade.clamp(Unit::DELTA, Unit::ONE);
        self.horizon.mixed(tile, Unit::from_bits(part(elevation, fade)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In the greys of an environment the colours are those of the environment, within what 16 bits have.
    #[test]
    fn a_sky_and_tiles_in_grey_are_the_environments() {
        let grey = Rgb::from_tone;
        let [bright, dark, horizon] = [0.875, 0.125, 0.5].map(Unit::from_num);
        let (scale, fade) = (Real::from_num(1.5), Unit::from_num(0.125));
        let board = Environment::Checkerboard { bright, dark, horizon, scale, fade };
        let squares = [bright, dark].map(grey);
        let tiles = Tiles { ceiling: squares, floor: squares, horizon: grey(horizon), scale, fade };
        let gradient = Environment::Gradient { zenith: bright, horizon, nadir: dark };
        let sky = Sky { zenith: grey(bright), horizon: grey(horizon), nadir: grey(dark) };
        let (mut down, mut bits) = (0, [0_i32; 3]);
        for _ in 0..3000 {
            bits = [(bits[0], 0x2545_f491), (bits[1], 0x6c07_8965), (bits[2], 0x1f12_3bb5)]
                .map(|(c, step): (i32, i32)| c.wrapping_add(step));
            let [x, y, z] = bits.map(Real::from_bits);
            let Some(direction) = Vec3::new(x, y, z).normalised() else { continue };
            for (colored, grey) in [
                (tiles.light(direction, Unit::ZERO), board.light(direction, Unit::ZERO)),
                (sky.light(direction, Unit::ZERO), gradient.light(direction, Unit::ZERO)),
            ] {
                assert!(colored.r.to_bits().abs_diff(grey.r.to_bits()) <= 2, "{direction:?}");
                assert_eq!((colored.r, colored.r), (colored.g, colored.b));
            }
            down += u32::from(direction.z < 0);
        }
        assert!((1000..2000).contains(&down), "{down}");
        // floor and ceiling have colours of their own
        let floor = Tiles { floor: [Rgb::WHITE, Rgb::WHITE], ceiling: [Rgb::BLACK, Rgb::BLACK], ..tiles };
        let straight = |up: Unit| floor.light(Vec3::new(Unit::ZERO, Unit::ZERO, up), Unit::ZERO);
        assert_eq!([straight(Unit::ONE), straight(-Unit::ONE)], [Rgb::BLACK, Rgb::WHITE]);
        assert_eq!(floor.light(Vec3::new(Unit::ONE, Unit::ZERO, Unit::ZERO), Unit::ZERO), floor.horizon);
    }
}
