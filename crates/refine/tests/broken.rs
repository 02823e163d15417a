//! Half of a coupling's text is missing, changed or out of order: there is a fault at a place in it, or a verdict, and no panic.

use refine::{Coupling, IDS, Options, format, refine};
use syntax::{FileId, SourceFile};
use testkit::Page;

use crate::small::{example, machine};

#[test]
fn every_kind_of_fault_has_a_page() {
    assert!(IDS.is_sorted());
    IDS.iter().for_each(|id| drop(Page::fault(id)));
}

#[test]
fn broken_couplings_have_faults_at_their_places() {
    let page = Page::spec("refine");
    let models: Vec<&str> =
        page.blocks().into_iter().filter(|block| block.info.starts_with("asmetal")).map(|block| block.text).collect();
    let texts: Vec<&str> =
        page.blocks().into_iter().filter(|block| block.info.starts_with("refine")).map(|block| block.text).collect();
    let (one, other) = (example(models[2]), example(models[3]));
    let check = |text: &str| {
        // What can be laid out at all keeps its words, and stays as it is when it is laid out again.
        if let Ok(formatted) = format(FileId(0), text) {
            let words = |text: &str| text.split_whitespace().collect::<String>();
            assert_eq!(words(text), words(&formatted));
            assert_eq!(format(FileId(0), &formatted).as_ref(), Ok(&formatted), "{text:?}");
        }
        let file = SourceFile::new("c.refine", text);
        match Coupling::new([&one, &other], Some(file), &machine::Limits::default()) {
            Err(faulty) => {
                for fault in &faulty.faults {
                    let span = fault.primary.span;
                    assert_eq!(faulty.sources.file(span.file).name, "c.refine", "{text:?}: {}", fault.message);
                    assert!(text.get(span.range()).is_some(), "{text:?}: {}", fault.message);
                    assert!(!fault.message.contains("abstract_"), "{text:?}: {}", fault.message);
                }
                assert!(!faulty.faults.is_empty());
            }
            Ok(coupling) => drop(refine(&coupling, &Options { max_pairs: 100, ..Options::default() }, &mut |_| true)),
        }
    };
    for text in texts {
        for at in (0..text.len()).step_by(3) {
            check(&text[..at]);
            check(&text[at..]);
            check(&format!("{}{}", &text[at..], &text[..at]));
            check(&format!("{}§{}", &text[..at], &text[at..]));
            check(&format!("{}{}", &text[..at], &text[(at + 5).min(text.len())..]));
        }
    }
}

/// What a name in a coupling may mean is told, and a fault stands at the name alone.
#[test]
fn names_that_are_not_known_have_their_neighbours() {
    let of = |function: &str| {
        let signature = format!("monitored go: Boolean controlled held: Boolean controlled {function}: Boolean");
        let rule = format!("main rule r_Main = if go then par held := not held {function} := held endpar endif");
        machine(&signature, &rule, &format!("function held = false function {function} = false"))
    };
    let (one, other) = (of("open"), of("opens"));
    let check = |text: &str, at: &str, says: &str, help: &str| {
        let coupling =
            Coupling::new([&one, &other], Some(SourceFile::new("c.refine", text)), &machine::Limits::default());
        let faulty = coupling.err().unwrap_or_else(|| panic!("{text}"));
        let fault = &faulty.faults[0];
        assert!(fault.message.contains(says), "{text}: {}", fault.message);
        assert_eq!(
            (&text[fault.primary.span.range()], fault.help.as_deref().unwrap_or_default()),
            (at, help),
            "{text}"
        );
    };
    check("same hold;", "hold", "the abstract machine has no function", "did you mean `held`?");
    check("same open;", "open", "the concrete machine has no function", "did you mean `opens`?");
    check("same held, held;", "held", "the same twice", "");
    check("couple held;", "held", "no function `held`", "say of which machine: `abstract.held` or `concrete.held`");
    check("couple opens;", "opens", "no function `opens`", "say of which machine: `concrete.opens`");
    check("couple concrete.hold;", "concrete.hold", "no function", "did you mean `concrete.held`?");
    let any = "write `concrete.NAME`, with the name of a function of that machine";
    check("couple concrete.lamp = true;", "concrete.lamp", "no function", any);
    check("couple abstract.held = concrete.go;", "concrete.go", "is an input", "");
    check(
        "same held; segment concrete.held and abstract.open;",
        "abstract.open",
        "the concrete machine's state alone",
        "",
    );
    let integer = "give a term of domain Integer";
    check("same held; variant concrete.held;", "concrete.held", "the variant takes Integer", integer);
}
