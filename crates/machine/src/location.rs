//! Locations: a function's name with argument values (Börger & Stärk 2003, definition 2.4.3).

use std::fmt;

use hashbrown::Equivalent;
use program::{FunctionId, Program};

use crate::print::Show;
use crate::value::Value;

/// A location: what an update changes and a state gives a value to.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Location {
    /// The dynamic function.
    pub function: FunctionId,
    /// One value a parameter.
    pub arguments: Vec<Value>,
}

impl Location {
    /// The location as it would be written: `f(a,1)`.
    pub fn show<'a>(&'a self, program: &'a Program) -> impl fmt::Display + 'a {
        self.borrowed().show(program)
    }

    /// The same location with borrowed arguments.
    pub fn borrowed(&self) -> LocationRef<'_> {
        LocationRef { function: self.function, arguments: &self.arguments }
    }
}

/// A location that borrows its arguments, for reading, comparing or finding one without building a [`Location`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LocationRef<'a> {
    /// The dynamic function.
    pub function: FunctionId,
    /// One value a parameter.
    pub arguments: &'a [Value],
}

impl<'a> LocationRef<'a> {
    /// The location as it would be written: `f(a,1)`.
    pub fn show(self, program: &'a Program) -> impl fmt::Display + 'a {
        ShowLocation { location: self, program }
    }

    /// The same location with owned arguments.
    pub fn to_location(self) -> Location {
        Location { function: self.function, arguments: self.arguments.to_vec() }
    }
}

impl Equivalent<Location> for LocationRef<'_> {
    fn equivalent(&self, key: &Location) -> bool {
        *self == key.borrowed()
    }
}

struct ShowLocation<'a> {
    location: LocationRef<'a>,
    program: &'a Program,
}

impl fmt::Display for ShowLocation<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.program.function(self.location.function).shown())?;
        if self.location.arguments.is_empty() {
            return Ok(());
        }
        f.write_str("(")?;
        for (index, argument) in self.location.arguments.iter().enumerate() {
            if index > 0 {
                f.write_str(",")?;
            }
            write!(f, "{}", argument.show(self.program))?;
        }
        f.write_str(")")
    }
}
