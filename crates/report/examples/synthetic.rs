//! Prints the made-up run of the tests: `html` (default), `svg` or `text`. For looking at a change of the design.

#![allow(clippy::disallowed_macros)]

#[path = "../tests/fixture/mod.rs"]
mod fixture;

fn main() {
    let report = fixture::report(10_000);
    match std::env::args().nth(1).as_deref() {
        Some("svg") => println!("{}", report::render_svg(&report, &report::SvgOptions::default())),
        Some("text") => println!("{}", report::summarise(&report, &report::SummaryOptions::default())),
        _ => println!("{}", report::render_html(&report)),
    }
}
