//! The checksum of what is drawn.

use crc::{CRC_32_ISO_HDLC, Crc};

/// That of zlib and PNG.
pub static CRC_32: Crc<u32> = Crc::<u32>::new(&CRC_32_ISO_HDLC);
