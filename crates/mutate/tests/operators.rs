//! The mutants of small models: what each operator makes, and that the checker accepts it.

use std::collections::BTreeSet;
use std::path::Path;

use model::Loader;
use mutate::{Mutant, Operator, applied, mutants};
use syntax::SourceFile;
use testkit::{Disk, NoFiles, repository};

/// A model around a main rule.
fn around(rule: &str) -> String {
    format!(
        "asm A\nimport StandardLibrary\nsignature:\n\
         enum domain Colour = {{RED | GREEN | BLUE}}\ndomain Small subsetof Integer\n\
         controlled a: Integer\ncontrolled b: Integer\ncontrolled on: Boolean\ncontrolled colour: Colour\n\
         controlled of: Small -> Boolean\nderived ready: Boolean\nderived asked: Boolean\n\
         definitions:\ndomain Small = {{1 : 3}}\nfunction ready = a < b\nfunction asked = on\n\
         rule r_up = a := a + 1\nrule r_down = b := 0\n\
         invariant over a: a >= 0 and asked\nmain rule r_Main = {rule}\n\
         default init s0:\nfunction a = 0\nfunction b = 7\nfunction on = false\n"
    )
}

fn made(name: &str, text: &str, loader: &mut dyn Loader) -> Vec<Mutant> {
    let checked = model::check(SourceFile::new(name, text), loader);
    assert!(checked.diagnostics.is_empty(), "{:?}", checked.diagnostics);
    mutants(&checked.model, &checked.sources, checked.model.root)
}

/// The main rule's mutants by these operators, in the order of the text.
fn check(rule: &str, operators: &[Operator], expect: &[&str]) {
    let text = around(rule);
    let start = text.find("r_Main = ").expect("a main rule") + 9;
    let found = made("A.asm", &text, &mut NoFiles);
    let shown: Vec<String> = found
        .iter()
        .filter(|mutant| mutant.place.start >= start && operators.contains(&mutant.operator))
        .map(|mutant| {
            let new = applied(&text, &mutant.edits);
            new[start..new.len() - (text.len() - start - rule.len())].to_string()
        })
        .collect();
    assert_eq!(shown, expect, "{rule}");
}

#[test]
fn each_operator_makes_its_mutants() {
    use Operator::*;
    let guards = [GuardNegated, GuardTrue, GuardFalse];
    check(
        "if on then a := 1 endif",
        &guards,
        &["if not (on) then a := 1 endif", "if true then a := 1 endif", "if false then a := 1 endif"],
    );
    check("if not on then a := 1 endif", &guards[..1], &["if on then a := 1 endif"]);
    check("choose $x in Small with true do a := $x", &guards, &["choose $x in Small with false do a := $x"]);
    check(
        "par a := 1 r_up[] endpar",
        &[RuleDeleted, CallDeleted, OrderReplaced],
        &["seq a := 1 r_up[] endseq", "par skip r_up[] endpar", "par a := 1 skip endpar"],
    );
    // These do the same one after the other and at once.
    check("seq a := 1 b := 2 endseq", &[OrderReplaced], &[]);
    check("seq a := 1 b := a endseq", &[OrderReplaced], &["par a := 1 b := a endpar"]);
    check("r_up[]", &[CallReplaced], &["r_down[]"]);
    check("if on then a := 1 else b := 1 endif", &[BranchesSwapped], &[]);
    check(
        "if on then a := 1 elseif ready then b := 1 endif",
        &[BranchesSwapped],
        &["if on then b := 1 elseif ready then a := 1 endif"],
    );
    check("a := b", &[LocationReplaced, FunctionReplaced], &["b := b", "a := a"]);
    check("on := a = b", &[ValueReplaced, RelationReplaced], &["on := false", "on := true", "on := a != b"]);
    check("if a < b then on := true endif", &[RelationReplaced], &["if a <= b then on := true endif"]);
    check("a := a * b - 1", &[ArithmeticReplaced], &["a := (a + b) - 1", "a := a * b + 1"]);
    check(
        "on := on or ready and on",
        &[LogicalReplaced],
        &["on := on and (ready and on)", "on := on or (ready or on)"],
    );
    check("colour := RED", &[LiteralReplaced], &["colour := BLUE", "colour := GREEN"]);
    check("a := 3", &[ConstantShifted], &["a := 2", "a := 4"]);
    check("on := (exist $x in Small with of($x))", &[QuantifierReplaced], &["on := (forall $x in Small with of($x))"]);
    check(
        "forall $x in Small, $y in Small with of($x) do of($y) := on",
        &[VariableReplaced],
        &[
            "forall $x in Small, $y in Small with of($y) do of($y) := on",
            "forall $x in Small, $y in Small with of($x) do of($x) := on",
        ],
    );
}

#[test]
fn initial_states_are_mutated_and_properties_are_not() {
    let found = made("A.asm", &around("if ready then r_up[] else r_down[] endif"), &mut NoFiles);
    let initial = found.iter().filter(|mutant| mutant.operator == Operator::InitialReplaced).count();
    assert_eq!(initial, 2 + 2 + 1, "a and b by one more and one less, on by the other");
    // `ready` is used by a rule, `asked` by the invariant alone.
    let text = around("if ready then r_up[] else r_down[] endif");
    let (ready, asked) = (text.find("a < b").expect("there"), text.find("asked = on").expect("there"));
    assert!(found.iter().any(|mutant| mutant.place.start == ready));
    assert!(!found.iter().any(|mutant| (asked..asked + 10).contains(&mutant.place.start)));
}

/// Files whose name ends so are read as this text.
struct Instead<'t>(&'t str, &'t str);

impl Loader for Instead<'_> {
    fn load(&mut self, importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        let file = Disk.load(importer, path)?;
        let text = if file.name == self.0 { self.1 } else { &file.text };
        Ok(SourceFile::new(file.name.clone(), text))
    }
}

#[test]
fn the_checker_accepts_every_mutant() {
    let full = testkit::sample::is_full();
    let mut used = BTreeSet::new();
    let mut models = vec![
        "library/verification/Lock.asm",
        "examples/philosophers/Philosophers.asm",
        "examples/production_cell/ProductionCell.asm",
    ];
    if full {
        models.extend([
            "library/verification/PairInTicks.asm",
            "library/verification/Queue.asm",
            "library/runtime/QueueSteps.asm",
            "examples/visual_servoing/CompleteController.asm",
            "examples/micro_assembly/AssemblySystem.asm",
            "examples/coffee_machine/CoffeeMachine.asm",
            "examples/word_count/WordCount.asm",
        ]);
    }
    for name in models {
        let root = Disk::read(&repository::root().join(Path::new(name))).expect("a model");
        let checked = model::check(root.clone(), &mut Disk);
        let own = |name: &str| !name.starts_with('<') && !name.contains("/library/std/");
        let files: Vec<_> = checked.sources.iter().filter(|(_, file)| own(&file.name)).collect();
        for (id, file) in files {
            for (index, mutant) in mutants(&checked.model, &checked.sources, id).into_iter().enumerate() {
                used.insert(mutant.operator);
                // Checking takes its time: a share of them is enough every day.
                if !full && index % 5 != 0 {
                    continue;
                }
                let text = applied(&file.text, &mutant.edits);
                let changed = if file.name == root.name { &text } else { &*root.text };
                let again = SourceFile::new(root.name.clone(), changed.to_string());
                let again = model::check(again, &mut Instead(&file.name, &text));
                let errors = again.diagnostics.iter().filter(|fault| fault.severity == syntax::Severity::Error);
                assert_eq!(errors.count(), 0, "{}: {mutant:?}: {:?}", file.name, again.diagnostics);
            }
        }
    }
    assert!(used.len() > 14, "{used:?}");
}
