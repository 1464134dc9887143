//! Bytes of a reader of `embedded-io`, as an iterator.

use embedded_io::{Error as _, ErrorKind, Read};

/// The bytes of a reader, taken `N` at a time: flash, a card, a socket. It ends where the reader does, or
/// fails; [`Bytes::error`] tells which.
///
/// ```
/// use attractor::codec::Bytes;
/// let mut bytes = Bytes::<_, 4>::new(&b"any reader"[..]);
/// assert!(bytes.by_ref().eq(*b"any reader"));
/// assert_eq!(bytes.error(), None);
/// ```
#[derive(Debug)]
pub struct Bytes<R, const N: usize> {
    reader: R,
    buffer: [u8; N],
    next: usize,
    filled: usize,
    error: Option<ErrorKind>,
}

impl<R: Read, const N: usize> Bytes<R, N> {
    /// From where the reader is.
    pub const fn new(reader: R) -> Self {
        Self { reader, buffer: [0; N], next: 0, filled: 0, error: None }
    }

    /// Why it ended, if the reader failed.
    pub const fn error(&self) -> Option<ErrorKind> {
        self.error
    }
}

impl<R: Read, const N: usize> Iterator for Bytes<R, N> {
    type Item = u8;

    #[inline]
    fn next(&mut self) -> Option<u8> {
        if self.next >= self.filled {
            if self.error.is_some() {
                return None;
            }
            self.next = 0;
            self.filled = match self.reader.read(&mut self.buffer) {
                Ok(filled) => filled.min(N),
                Err(error) => {
                    self.error = Some(error.kind());
                    0
                }
            };
        }
        let byte = self.buffer.get(..self.filled)?.get(self.next).copied()?;
        self.next += 1;
        Some(byte)
    }
}
