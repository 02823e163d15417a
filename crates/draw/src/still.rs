//! SVG → PNG and PDF, by resvg and krilla, with the faces of this crate and no others.
//!
//! In: the SVG of a drawing. Out: the bytes of a file, the same on every machine.

use std::sync::{Arc, OnceLock};

use krilla::Document;
use krilla::geom::Size;
use krilla::page::PageSettings;
use krilla_svg::{SurfaceExt, SvgSettings};
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::fontdb::{Database, Source};
use resvg::usvg::{Options, Tree};

use crate::elk::LayoutFault;
use crate::font;

/// Why there is no file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum DrawFault {
    /// There is no layout.
    Layout(LayoutFault),
    /// So many dots to the right and down are too many.
    TooLarge(u64, u64),
    /// A library refused the SVG: our bug or its own.
    Refused(String),
}

impl std::fmt::Display for DrawFault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            DrawFault::Layout(fault) => fault.fmt(f),
            DrawFault::TooLarge(width, height) => {
                write!(f, "a picture of {width} by {height} dots is too large for PNG")
            }
            DrawFault::Refused(why) => write!(f, "the picture could not be drawn: {why}"),
        }
    }
}

impl std::error::Error for DrawFault {}

impl From<LayoutFault> for DrawFault {
    fn from(fault: LayoutFault) -> DrawFault {
        DrawFault::Layout(fault)
    }
}

/// LIMIT: a PNG has at most so many dots.
const DOTS: u64 = 400_000_000;

fn tree(svg: &str) -> Result<Tree, DrawFault> {
    static FONTS: OnceLock<Arc<Database>> = OnceLock::new();
    let load = || {
        let mut fonts = Database::new();
        for file in font::FILES {
            fonts.load_font_source(Source::Binary(Arc::new(file)));
        }
        fonts.set_sans_serif_family("Arimo");
        fonts.set_monospace_family("Cousine");
        Arc::new(fonts)
    };
    let fontdb = FONTS.get_or_init(load).clone();
    let options = Options { fontdb, font_family: "Arimo".to_string(), ..Options::default() };
    Tree::from_str(svg, &options).map_err(|error| DrawFault::Refused(error.to_string()))
}

pub fn png(svg: &str, scale: f32) -> Result<Vec<u8>, DrawFault> {
    let tree = tree(svg)?;
    let size = tree.size();
    let (width, height) = ((size.width() * scale).ceil() as u64, (size.height() * scale).ceil() as u64);
    let too_large = DrawFault::TooLarge(width, height);
    if width.saturating_mul(height) > DOTS {
        return Err(too_large);
    }
    let Some(mut dots) = Pixmap::new(width.max(1) as u32, height.max(1) as u32) else { return Err(too_large) };
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut dots.as_mut());
    dots.encode_png().map_err(|error| DrawFault::Refused(error.to_string()))
}

pub fn pdf(svg: &str) -> Result<Vec<u8>, DrawFault> {
    /// Points a pixel.
    const POINTS: f32 = 0.75;
    let tree = tree(svg)?;
    let refused = |what: &str| DrawFault::Refused(what.to_string());
    let size = Size::from_wh(tree.size().width() * POINTS, tree.size().height() * POINTS);
    let size = size.ok_or_else(|| refused("it has no extent"))?;
    let mut document = Document::new();
    let page = PageSettings::from_wh(size.width(), size.height()).ok_or_else(|| refused("it has no extent"))?;
    let mut page = document.start_page_with(page);
    let mut surface = page.surface();
    surface.draw_svg(&tree, size, SvgSettings::default()).ok_or_else(|| refused("a text has no outline"))?;
    surface.finish();
    page.finish();
    document.finish().map_err(|error| refused(&format!("{error:?}")))
}
