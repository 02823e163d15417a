//! Charts → pictures, in the notation of the paper (Figures 4 to 6): circles, hexagons with yes and no exits, rectangles,
//! dashed where they are to be refined, blocks for pattern instances, an entering arrow and floating exit arrows, and
//! `{links}` in small type. Systems are drawn as component diagrams (Figures 1 and 2).
//!
//! In: a chart without errors. Out: a [`Drawing`] of each machine and system, as SVG, PNG, PDF, Mermaid or DOT; the same
//! bytes for the same chart. ELK's layered algorithm places shapes and routes arrows; the result is a [`Picture`], which
//! tests measure. What charts mean is known in `chart`; nothing but shells depends on this crate.

mod components;
mod drawing;
mod elk;
mod fixed;
mod font;
mod kept;
mod measure;
mod notation;
mod picture;
mod place;
mod route;
mod scene;
mod still;
mod style;
mod svg;
mod words;

pub use drawing::{Drawing, Embedded, Page, Still, drawings};
pub use elk::LayoutFault;
pub use notation::{Notation, export};
pub use picture::{Detail, Figure, Label, Line, Picture, Placed};
pub use place::place;
pub use still::DrawFault;
pub use style::Theme;
