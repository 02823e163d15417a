//! Standard output and standard error as commands write to them.
//!
//! A reader may close them early (`| head`). Later output is dropped, and the command continues to its verdict.
//! INVARIANT: the exit code does not depend on the reader. Any other trouble is an error, as for a file.

use std::io::{self, Write};

/// A stream whose reader may leave.
#[derive(Debug)]
pub struct Sink<W> {
    stream: W,
    closed: bool,
}

impl<W: Write> Sink<W> {
    pub fn new(stream: W) -> Self {
        Sink { stream, closed: false }
    }

    fn leave<T>(&mut self, outcome: io::Result<T>, instead: T) -> io::Result<T> {
        match outcome {
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => {
                self.closed = true;
                Ok(instead)
            }
            outcome => outcome,
        }
    }
}

impl<W: Write> Write for Sink<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.closed {
            return Ok(bytes.len());
        }
        let outcome = self.stream.write(bytes);
        self.leave(outcome, bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        if self.closed {
            return Ok(());
        }
        let outcome = self.stream.flush();
        self.leave(outcome, ())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Takes this many bytes, then breaks with an error.
    struct Breaks(usize, io::ErrorKind);

    impl Write for Breaks {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.0 = self.0.checked_sub(bytes.len()).ok_or(self.1)?;
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_reader_that_leaves_is_no_error() {
        let mut sink = Sink::new(Breaks(4, io::ErrorKind::BrokenPipe));
        assert!(sink.write_all(b"1234").is_ok() && !sink.closed);
        assert!(sink.write_all(b"5").is_ok() && sink.closed && sink.flush().is_ok());
    }

    #[test]
    fn a_full_disk_is_an_error() {
        let mut sink = Sink::new(Breaks(4, io::ErrorKind::StorageFull));
        assert!(sink.write_all(b"12345").is_err() && !sink.closed);
    }
}
