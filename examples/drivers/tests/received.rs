//! What a display receives over its bus is what the simulator shows.

use std::cell::RefCell;
use std::convert::Infallible;
use std::rc::Rc;

use attractor_drivers::nothing::{Nothing, every_display};
use attractor_drivers::{epd_waveshare, mipidsi, ssd1306};
use embedded_graphics::pixelcolor::raw::RawU16;
use embedded_graphics::pixelcolor::{BinaryColor, Rgb565};
use embedded_graphics::prelude::*;
use embedded_graphics_simulator::SimulatorDisplay;
use embedded_hal::{digital, i2c, spi};

/// A command with its arguments or data.
type Commands = Vec<(u8, Vec<u8>)>;

/// One board: a bus, and the pin that tells commands from data.
#[derive(Clone, Default)]
struct Board(Rc<RefCell<Wires>>);

#[derive(Default)]
struct Wires {
    data: bool,
    commands: Commands,
}

/// The pin for data or command.
#[derive(Clone)]
struct DataPin(Board);

impl Board {
    fn receive(&self, bytes: &[u8], data: bool) {
        let commands = &mut self.0.borrow_mut().commands;
        if data {
            commands.last_mut().expect("data before any command").1.extend(bytes);
        } else {
            commands.extend(bytes.iter().map(|command| (*command, Vec::new())));
        }
    }

    fn commands(&self) -> Commands {
        std::mem::take(&mut self.0.borrow_mut().commands)
    }
}

impl spi::ErrorType for Board {
    type Error = Infallible;
}

impl spi::SpiDevice for Board {
    fn transaction(&mut self, operations: &mut [spi::Operation<'_, u8>]) -> Result<(), Infallible> {
        for operation in operations {
            let spi::Operation::Write(bytes) = operation else { panic!("{operation:?}") };
            let data = self.0.borrow().data;
            self.receive(bytes, data);
        }
        Ok(())
    }
}

impl digital::ErrorType for DataPin {
    type Error = Infallible;
}

impl digital::OutputPin for DataPin {
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.0.0.borrow_mut().data = false;
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        self.0.0.borrow_mut().data = true;
        Ok(())
    }
}

impl i2c::ErrorType for Board {
    type Error = Infallible;
}

impl i2c::I2c for Board {
    /// The first byte says what follows: 0 a command with its arguments, 0x40 data.
    fn transaction(&mut self, address: u8, operations: &mut [i2c::Operation<'_>]) -> Result<(), Infallible> {
        assert_eq!(address, 0x3c);
        for operation in operations {
            let i2c::Operation::Write(bytes) = operation else { panic!("{operation:?}") };
            match **bytes {
                [0x00, command, ref arguments @ ..] => {
                    self.receive(&[command], false);
                    self.receive(arguments, true);
                }
                [0x40, ref data @ ..] => {
                    self.receive(&[DATA], false);
                    self.receive(data, true);
                }
                _ => panic!("{bytes:?}"),
            }
        }
        Ok(())
    }
}

/// Stands for data between the commands of an ssd1306.
const DATA: u8 = 0x40;

fn lit(display: &SimulatorDisplay<BinaryColor>) -> usize {
    let pixels = display.bounding_box().points();
    pixels.filter(|p| display.get_pixel(*p) == BinaryColor::On).count()
}

#[test]
fn an_ssd1306_receives_the_fern() {
    let mut shown = SimulatorDisplay::<BinaryColor>::new(Size::new(128, 64));
    ssd1306::draw(&mut shown).unwrap();
    let board = Board::default();
    ssd1306::show(board.clone()).unwrap();
    // its memory: pages of 8 rows, a byte a column, the lowest bit on top
    let mut memory = [[0_u8; 128]; 8];
    let (mut columns, mut pages) = ([0, 127], [0, 7]);
    let (mut column, mut page) = (0, 0);
    let mut mode = None;
    for (command, bytes) in board.commands() {
        match (command, &bytes[..]) {
            (0x20, [given]) => mode = Some(*given),
            (0x21, [first, last]) => (columns, column) = ([*first, *last], *first),
            (0x22, [first, last]) => (pages, page) = ([*first, *last], *first),
            (DATA, data) => {
                for byte in data {
                    memory[usize::from(page)][usize::from(column)] = *byte;
                    column += 1;
                    if column > columns[1] {
                        column = columns[0];
                        page = if page == pages[1] { pages[0] } else { page + 1 };
                    }
                }
            }
            _ => {}
        }
    }
    assert_eq!(mode, Some(0), "rows first");
    for p in shown.bounding_box().points() {
        let byte = memory[(p.y / 8) as usize][p.x as usize];
        let received = byte >> (p.y % 8) & 1 == 1;
        assert_eq!(received, shown.get_pixel(p) == BinaryColor::On, "{p}");
    }
    assert!((300..2_000).contains(&lit(&shown)), "{}", lit(&shown));
}

#[test]
fn an_st7789_receives_the_mandelbrot_set() {
    let mut shown = SimulatorDisplay::<Rgb565>::new(Size::new(240, 240));
    mipidsi::draw(&mut shown).unwrap();
    let board = Board::default();
    mipidsi::show(board.clone(), DataPin(board.clone()), DataPin(Board::default()), &mut Nothing).unwrap();
    let mut memory = vec![None; 240 * 240];
    let (mut columns, mut rows) = ([0; 2], [0; 2]);
    let pair = |bytes: &[u8]| [0, 2].map(|i| usize::from(u16::from_be_bytes([bytes[i], bytes[i + 1]])));
    for (command, bytes) in board.commands() {
        match command {
            0x2a => columns = pair(&bytes),
            0x2b => rows = pair(&bytes),
            0x2c => {
                let places = (rows[0]..=rows[1]).flat_map(|y| (columns[0]..=columns[1]).map(move |x| (x, y)));
                assert_eq!(bytes.len(), 2 * places.clone().count());
                for ((x, y), color) in places.zip(bytes.chunks(2)) {
                    memory[240 * y + x] = Some(u16::from_be_bytes([color[0], color[1]]));
                }
            }
            _ => {}
        }
    }
    for (p, received) in shown.bounding_box().points().zip(memory) {
        let received = received.map(|raw| Rgb565::from(RawU16::new(raw)));
        assert_eq!(received, Some(shown.get_pixel(p)), "{p}");
    }
    let black = shown.bounding_box().points().filter(|p| shown.get_pixel(*p) == Rgb565::BLACK).count();
    assert!((5_000..30_000).contains(&black), "{black} of 57,600");
}

#[test]
fn an_e_paper_receives_a_julia_set_in_ink() {
    let mut shown = SimulatorDisplay::<BinaryColor>::new(Size::new(128, 296));
    epd_waveshare::draw(&mut shown).unwrap();
    let mut board = Board::default();
    let (dc, reset) = (DataPin(board.clone()), DataPin(Board::default()));
    epd_waveshare::show(&mut board, Nothing, dc, reset, &mut Nothing).unwrap();
    let commands = board.commands();
    let frames: Vec<_> = commands.iter().filter(|(command, _)| *command == 0x24).collect();
    let [(_, frame)] = frames[..] else { panic!("{} frames", frames.len()) };
    assert_eq!(commands.last(), Some(&(0x20, Vec::new())), "the frame is shown");
    // rows of bytes, the highest bit on the left, 1 is white
    assert_eq!(frame.len(), 128 / 8 * 296);
    for p in shown.bounding_box().points() {
        let white = frame[(16 * p.y + p.x / 8) as usize] << (p.x % 8) & 0x80 != 0;
        assert_eq!(white, shown.get_pixel(p) == BinaryColor::Off, "{p}");
    }
    assert!((2_000..20_000).contains(&lit(&shown)), "{} of 37,888 in ink", lit(&shown));
}

#[test]
fn a_board_without_anything_is_served() {
    assert!(every_display());
}
