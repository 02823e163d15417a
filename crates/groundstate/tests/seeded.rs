//! Faults that a stranger once put into the pattern machines, and of which half went through every proof: each is a mutant, and
//! a model of library/verification finds it.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use groundstate::mutate::{Operator, applied, changed, mutants};
use groundstate::verify::{EngineKind, Options, Outcome, Subject, verify};
use groundstate::{Loaded, load};
use model::Loader;
use syntax::SourceFile;
use testkit::{Disk, repository};

/// A file has this text instead of its own.
struct Instead {
    name: String,
    text: String,
}

impl Loader for Instead {
    fn load(&mut self, importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        let file = Disk.load(importer, path)?;
        if file.name == self.name { Ok(SourceFile::new(file.name, self.text.as_str())) } else { Ok(file) }
    }
}

fn path(name: &str) -> PathBuf {
    repository::root().join("library").join(Path::new(name))
}

fn loaded(model: &str, loader: &mut dyn Loader) -> Loaded {
    let root = Disk::read(&path(&format!("verification/{model}.asm"))).expect("a model");
    load(root, loader).unwrap_or_else(|faulty| panic!("{model}: {:?}", faulty.diagnostics))
}

/// The mutant of a line that becomes another one, the first of those alike, is found by this property.
fn check(file: &str, operator: Operator, (before, after): (&str, &str), model: &str, property: &str) {
    check_nth(0, file, operator, (before, after), model, property);
}

fn check_nth(nth: usize, file: &str, operator: Operator, (before, after): (&str, &str), model: &str, property: &str) {
    let base = loaded(model, &mut Disk);
    let name = Disk::read(&path(&format!("patterns/{file}.asm"))).expect("a module").name;
    let (id, source) = base.sources.iter().find(|(_, source)| source.name == name).expect("it is imported");
    let is_it = |mutant: &&groundstate::mutate::Mutant| {
        let change = changed(&source.text, &mutant.edits);
        let is = |lines: &[String], line: &str| lines.len() == 1 && lines[0].trim() == line;
        mutant.operator == operator && is(&change.before, before) && is(&change.after, after)
    };
    let all = mutants(&base.model, &base.sources, id);
    let found = all.iter().filter(is_it).nth(nth).unwrap_or_else(|| panic!("{file}: {before}: no mutant"));
    let text = applied(&source.text, &found.edits);
    let mutant = loaded(model, &mut Instead { name, text });
    let options = Options { engine: EngineKind::Explicit, first: true, ..Options::default() };
    let report = verify(&Arc::clone(&mutant.program), &options, &mut |_| true).expect("it begins");
    let violated: Vec<&str> = report
        .verdicts
        .iter()
        .filter(|verdict| matches!(verdict.outcome, Outcome::Violated(_)))
        .map(|verdict| match verdict.subject {
            Subject::Property(index) => mutant.program.properties[index].name.as_str(),
            _ => "a built-in check",
        })
        .collect();
    assert!(violated.contains(&property), "{file}: {before}: {violated:?}");
}

#[test]
fn faults_in_time_are_found() {
    use Operator::*;
    let longer = (
        "scheduler_currentScheduleTime($c) >= time(scheduler_currentPhase($c))",
        "scheduler_currentScheduleTime($c) > time(scheduler_currentPhase($c))",
    );
    check("Scheduler", RelationReplaced, longer, "PairInTicks", "inv_periods");
    let early = (
        "if isDef(task_deadline($t)) then task_deadline($t) else task_period($t) endif",
        "if false then task_deadline($t) else task_period($t) endif",
    );
    check("Task", GuardFalse, early, "TaskTimes", "inv_patience");
}

#[test]
fn faults_in_locks_are_found() {
    use Operator::*;
    let more = (
        "if sem_state($s, $t) = WAITING then indexOf(sem_line($s), $t) < semacount($s) else false endif",
        "if sem_state($s, $t) = WAITING then indexOf(sem_line($s), $t) <= semacount($s) else false endif",
    );
    check("Semaphore", RelationReplaced, more, "Lock", "inv_permits");
    let stays = ("sem_state($s, $t) := READY", "skip");
    check("Semaphore", RuleDeleted, stays, "Lock", "ltlSpec_served");
    // That of a slave: the first two are those of masters.
    check_nth(
        2,
        "PatternMachines",
        GuardFalse,
        ("if givesUp($c) then", "if false then"),
        "PairInTicks",
        "inv_watchdog",
    );
    let swaps = ("if sem_granted(sem($b), $t) then", "if true then");
    check("Scheduler", GuardTrue, swaps, "PairInTicks", "inv_indexSection");
}

#[test]
fn faults_in_handing_over_are_found() {
    use Operator::*;
    check(
        "SwingingBuffer",
        ValueReplaced,
        ("sb_fresh($b) := $isNew", "sb_fresh($b) := true"),
        "PairInTicks",
        "inv_fresh",
    );
    check("SwingingBuffer", RuleDeleted, ("sb_fresh($b) := false", "skip"), "PairInTicks", "inv_fresh");
    check("SharedValue", ValueReplaced, ("sv_fresh($v) := sv_isNew($v)", "sv_fresh($v) := true"), "Value", "inv_fresh");
    let loses = (
        "if mq_isFull(messageQueue(scheduler_currentPhase($c))) and thereIsTime(scheduler_mainThread($c)) then",
        "if false then",
    );
    check("Producer", GuardFalse, loses, "SendingInTicks", "inv_sending");
}
