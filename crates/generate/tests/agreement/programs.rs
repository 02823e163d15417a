//! What of a system cannot be generated is told, as its page shows.

use chart::read;
use generate::system::ungenerated;
use syntax::{FileId, parse_chart};

#[test]
fn the_fault_has_a_page_whose_example_shows_it() {
    for id in generate::FAULT_IDS {
        let page = testkit::Page::fault(id);
        let example = page.texts("chart fault").first().copied().expect("an example");
        let (chart, faults) = read(FileId(0), &parse_chart(FileId(0), example));
        assert_eq!(faults, []);
        let found = ungenerated(chart.system.as_ref().expect("it has a system"));
        assert_eq!(found.iter().map(|fault| fault.id).collect::<Vec<_>>(), [*id]);
    }
}
