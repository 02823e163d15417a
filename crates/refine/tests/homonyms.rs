//! Functions that share a name: overloads, which differ in their domains, and those that export lists hide from each other.

use std::sync::Arc;

use program::Program;
use refine::{Coupling, Incomparable, Verdict};
use syntax::SourceFile;
use testkit::Texts;

use crate::induction::{proved, refines};
use crate::small::{machine, refuted, report};

const LOADS: &str = "enum domain Side = {LEFT | RIGHT} enum domain Slot = {UP | DOWN}";

/// A machine of two overloads, in either order, with these values for what is written.
fn loads(turned: bool, side: &str, slot: &str) -> Arc<Program> {
    let mut declared = ["controlled load: Side -> Boolean", "controlled load: Slot -> Boolean"];
    let mut begun = ["function load($s in Side) = false", "function load($s in Slot) = false"];
    if turned {
        declared.reverse();
        begun.reverse();
    }
    let rule = format!("main rule r_Main = par load(LEFT) := {side} load(UP) := {slot} endpar");
    machine(&format!("{LOADS} {}", declared.join(" ")), &rule, &begun.join(" "))
}

const BOTH: [&str; 2] = ["not load(LEFT)", "not load(UP)"];

#[test]
fn each_overload_corresponds_to_that_with_its_domains() {
    let one = loads(false, BOTH[0], BOTH[1]);
    let couplings = [
        None,
        Some("same load;"),
        Some(
            "couple (forall $s in Side with abstract.load($s) = concrete.load($s)) and (forall $t in Slot with abstract.load($t) = concrete.load($t));",
        ),
    ];
    for turned in [false, true] {
        for coupling in couplings {
            assert_eq!(report(&one, &loads(turned, BOTH[0], BOTH[1]), coupling).verdict, Verdict::Refines);
            refuted(report(&one, &loads(turned, "load(LEFT)", BOTH[1]), coupling));
            refuted(report(&one, &loads(turned, BOTH[0], "load(UP)"), coupling));
        }
        refines(&one, &loads(turned, BOTH[0], BOTH[1]), "");
        for other in [loads(turned, "load(LEFT)", BOTH[1]), loads(turned, BOTH[0], "load(UP)")] {
            let Some(report) = proved(&one, &other, "") else { continue };
            assert!(!matches!(report.verdict, Verdict::Refines), "{:?}", report.verdict);
        }
    }
}

/// The names and reasons of what a default coupling leaves out.
fn left_out(one: &Arc<Program>, other: &Arc<Program>) -> Vec<(String, Incomparable)> {
    let coupling = Coupling::new([one, other], None, &machine::Limits::default());
    let coupling = coupling.unwrap_or_else(|faulty| panic!("{:?}", faulty.faults));
    coupling.left_out.into_iter().map(|left| (left.name, left.why)).collect()
}

#[test]
fn a_function_whose_domains_differ_is_left_out_by_name() {
    let with = |declared: &str| {
        let signature = format!("{LOADS} controlled n: Boolean {declared}");
        machine(&signature, "main rule r_Main = n := not n", "function n = false")
    };
    let plain = with("controlled load: Side -> Boolean");
    let check = |declared: &str, why: Option<Incomparable>| {
        let found = left_out(&plain, &with(declared));
        assert_eq!(found, why.map(|why| ("load".to_string(), why)).into_iter().collect::<Vec<_>>(), "{declared}");
    };
    check("controlled load: Side -> Boolean", None);
    check("", None);
    check("monitored load: Slot -> Boolean", None);
    // The overload besides is one of the concrete machine alone.
    check("controlled load: Side -> Boolean controlled load: Slot -> Boolean", None);
    let sides = ["Side {LEFT | RIGHT}", "Slot {DOWN | UP}"].map(str::to_string);
    check("controlled load: Slot -> Boolean", Some(Incomparable::Domains(sides)));
    check("controlled load: Boolean", Some(Incomparable::Arguments([1, 0])));
    check("controlled load: Prod(Side, Slot) -> Boolean", Some(Incomparable::Arguments([1, 2])));
}

#[test]
fn overloaded_inputs_are_shared() {
    let asks = |turned: bool, side: &str| {
        let mut declared = ["monitored asked: Side -> Boolean", "monitored asked: Slot -> Boolean"];
        if turned {
            declared.reverse();
        }
        let signature = format!("{LOADS} {} controlled left: Boolean controlled up: Boolean", declared.join(" "));
        let rule = format!("main rule r_Main = par left := asked({side}) up := asked(UP) endpar");
        machine(&signature, &rule, "function left = false function up = false")
    };
    for turned in [false, true] {
        assert_eq!(report(&asks(false, "LEFT"), &asks(turned, "LEFT"), None).verdict, Verdict::Refines);
        refuted(report(&asks(false, "LEFT"), &asks(turned, "RIGHT"), None));
    }
}

/// A machine whose module paints in secret, and maybe has a secret of its own.
fn painted(module: &str, color: &str, own: &str) -> Arc<Program> {
    let library = format!(
        "module Lib import StandardLibrary export r_paint signature: controlled secret: Boolean \
         definitions: rule r_paint = secret := {color}"
    );
    let text = format!(
        "asm M import StandardLibrary import {module} signature: {own} controlled n: Boolean \
         definitions: main rule r_Main = par r_paint[] n := not n endpar default init s0: function n = false"
    );
    let file = format!("{module}.asm");
    let library = library.replace("module Lib", &format!("module {module}"));
    let checked = model::check(SourceFile::new("M.asm", text), &mut Texts::of([(file.as_str(), library.as_str())]));
    assert!(checked.diagnostics.is_empty(), "{:?}", checked.diagnostics);
    Arc::new(program::lower(&checked.model).expect("it is lowered"))
}

#[test]
fn a_hidden_function_is_compared_with_its_like() {
    for own in ["", "controlled secret: Boolean"] {
        let one = painted("Lib", "true", own);
        assert_eq!(report(&one, &painted("Other", "true", own), None).verdict, Verdict::Refines);
        refuted(report(&one, &painted("Other", "false", own), None));
    }
    // One secret here, two there: that of the same module is meant.
    let (one, own) = (painted("Lib", "true", ""), "controlled secret: Boolean");
    assert_eq!(report(&one, &painted("Lib", "true", own), None).verdict, Verdict::Refines);
    refuted(report(&one, &painted("Lib", "false", own), None));
    let other = painted("Other", "true", own);
    for pair in [[&one, &other], [&other, &one]] {
        let faulty = Coupling::new(pair, None, &machine::Limits::default()).expect_err("which one is meant?");
        assert!(faulty.faults[0].message.contains("several functions `secret`"), "{:?}", faulty.faults);
    }
}
