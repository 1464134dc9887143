//! A board on which nothing happens: it shows that everything compiles to code for a target.

use core::convert::Infallible;

use embedded_hal::delay::DelayNs;
use embedded_hal::{digital, i2c, spi};

/// Any bus, any pin, any clock.
#[derive(Debug, Clone, Copy)]
pub struct Nothing;

impl i2c::ErrorType for Nothing {
    type Error = Infallible;
}

impl i2c::I2c for Nothing {
    fn transaction(&mut self, _: u8, _: &mut [i2c::Operation<'_>]) -> Result<(), Infallible> {
        Ok(())
    }
}

impl spi::ErrorType for Nothing {
    type Error = Infallible;
}

impl spi::SpiDevice for Nothing {
    fn transaction(&mut self, _: &mut [spi::Operation<'_, u8>]) -> Result<(), Infallible> {
        Ok(())
    }
}

impl digital::ErrorType for Nothing {
    type Error = Infallible;
}

impl digital::OutputPin for Nothing {
    fn set_low(&mut self) -> Result<(), Infallible> {
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

impl digital::InputPin for Nothing {
    fn is_high(&mut self) -> Result<bool, Infallible> {
        Ok(false)
    }

    fn is_low(&mut self) -> Result<bool, Infallible> {
        Ok(true)
    }
}

impl DelayNs for Nothing {
    fn delay_ns(&mut self, _: u32) {}
}

/// Every display at once; whether all went well.
pub fn every_display() -> bool {
    crate::ssd1306::show(Nothing).is_ok()
        && crate::mipidsi::show(Nothing, Nothing, Nothing, &mut Nothing).is_ok()
        && crate::epd_waveshare::show(&mut Nothing, Nothing, Nothing, Nothing, &mut Nothing).is_ok()
}
