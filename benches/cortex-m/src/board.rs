//! The emulated boards: how each counts instructions, and where its stack is.
//!
//! | target | machine | counter |
//! | --- | --- | --- |
//! | thumbv7em-none-eabihf | netduinoplus2 (STM32F405, Cortex-M4F) | TIM2, one tick an instruction under `-icount shift=0` |
//! | thumbv6m-none-eabi | microbit (nRF51822, Cortex-M0) | none; run on netduinoplus2 it has TIM2 |
//! | riscv32imac-unknown-none-elf | virt | the CSR `instret` |

use attractor_workload::Machine;
use embedded_graphics::primitives::Rectangle;
use semihosting::fs::File;
use semihosting::io::Write;

/// What unused stack holds.
const PAINT: u32 = 0xcccc_cccc;
/// Bytes below the painter's frame that are left alone: the painter itself needs them.
const MARGIN: usize = 64;

unsafe extern "C" {
    #[cfg(target_arch = "arm")]
    static _stack_end: u8;
    #[cfg(target_arch = "riscv32")]
    static __estack: u8;
}

/// The board that the image runs on.
#[derive(Debug)]
pub struct Board {
    counter: Counter,
    painted_from: usize,
    frames: Option<File>,
    /// Bits of a pixel of the frames.
    bits: u8,
}

impl Default for Board {
    fn default() -> Self {
        Self::new()
    }
}

impl Board {
    /// Starts the counter, if the board has one.
    pub fn new() -> Self {
        Self { counter: Counter::start(), painted_from: 0, frames: None, bits: 0 }
    }

    /// Whether the board counts instructions.
    pub const fn counts(&self) -> bool {
        self.counter.counts()
    }

    /// Streams every pixel drawn from now on to `file`: records of six 16-bit numbers (column, row, width of
    /// the area, bits of a pixel, 0, count; the offset into the area as 32 bits) and the colours. `None` ends
    /// it.
    pub fn stream(&mut self, file: Option<File>, bits: u8) {
        self.frames = file;
        self.bits = bits;
    }
}

impl Machine for Board {
    fn instructions(&mut self) -> u32 {
        self.counter.read()
    }

    #[inline(never)]
    fn paint_stack(&mut self) {
        let top = stack_pointer();
        self.painted_from = top;
        let mut at = stack_end();
        while at + MARGIN < top {
            // SAFETY: between the end of the static data and the stack pointer nothing lives.
            unsafe { (at as *mut u32).write_volatile(PAINT) };
            at += 4;
        }
    }

    #[inline(never)]
    fn stack_used(&mut self) -> u32 {
        let mut at = stack_end();
        while at < self.painted_from {
            // SAFETY: RAM of this image, only read.
            if unsafe { (at as *const u32).read_volatile() } != PAINT {
                break;
            }
            at += 4;
        }
        (self.painted_from - at) as u32
    }

    fn pixels(&mut self, area: Rectangle, offset: usize, colours: &[u16]) {
        if let Some(file) = &mut self.frames {
            let mut head = [0_u8; 16];
            let words = [
                area.top_left.x as u16,
                area.top_left.y as u16,
                area.size.width as u16,
                u16::from(self.bits),
                offset as u16,
                (offset >> 16) as u16,
                colours.len() as u16,
                0,
            ];
            for (bytes, word) in head.chunks_exact_mut(2).zip(words) {
                bytes.copy_from_slice(&word.to_le_bytes());
            }
            // SAFETY: two bytes to a colour; this target stores the low one first.
            let body =
                unsafe { core::slice::from_raw_parts(colours.as_ptr().cast::<u8>(), 2 * colours.len()) };
            if file.write_all(&head).and_then(|()| file.write_all(body)).is_err() {
                panic!("the frame cannot be written");
            }
        }
    }

    fn ram_free(&mut self) -> usize {
        stack_pointer() - stack_end()
    }
}

#[cfg(target_arch = "arm")]
fn stack_end() -> usize {
    &raw const _stack_end as usize
}

#[cfg(target_arch = "riscv32")]
fn stack_end() -> usize {
    &raw const __estack as usize
}

#[inline(always)]
fn stack_pointer() -> usize {
    let sp: usize;
    // SAFETY: reads a register.
    unsafe {
        #[cfg(target_arch = "arm")]
        core::arch::asm!("mov {}, sp", out(reg) sp, options(nomem, nostack, preserves_flags));
        #[cfg(target_arch = "riscv32")]
        core::arch::asm!("mv {}, sp", out(reg) sp, options(nomem, nostack, preserves_flags));
    }
    sp
}

#[cfg(target_arch = "riscv32")]
#[derive(Debug)]
struct Counter;

#[cfg(target_arch = "riscv32")]
impl Counter {
    const fn start() -> Self {
        Self
    }

    const fn counts(&self) -> bool {
        true
    }

    fn read(&self) -> u32 {
        let count: u32;
        // SAFETY: reads a counter.
        unsafe { core::arch::asm!("csrr {}, minstret", out(reg) count, options(nomem, nostack)) };
        count
    }
}

#[cfg(target_arch = "arm")]
#[derive(Debug)]
struct Counter {
    present: bool,
}

#[cfg(target_arch = "arm")]
impl Counter {
    const TIM2: usize = 0x4000_0000;
    const CPUID: usize = 0xe000_ed00;

    /// Only the machine with a Cortex-M4 has the timer, whatever target the image is built for.
    fn start() -> Self {
        // SAFETY: CPUID can be read on every Cortex-M, and the registers are those of the only Cortex-M4
        // machine this runs on.
        unsafe {
            let present = (Self::CPUID as *const u32).read_volatile() >> 4 & 0xfff == 0xc24;
            if present {
                let write = |offset: usize, v: u32| ((Self::TIM2 + offset) as *mut u32).write_volatile(v);
                write(0x28, 0); // PSC: no division
                write(0x2c, u32::MAX); // ARR: all 32 bits
                write(0x14, 1); // EGR: take these over
                write(0x00, 1); // CR1: run
            }
            Self { present }
        }
    }

    const fn counts(&self) -> bool {
        self.present
    }

    fn read(&self) -> u32 {
        if self.present {
            // SAFETY: as above.
            unsafe { ((Self::TIM2 + 0x24) as *const u32).read_volatile() }
        } else {
            0
        }
    }
}
