//! Patterns that answer yes or no: what their charts are built to, what is at fault with them, and that nothing gets lost on the way.

use chart::{Known, build, load, read};
use syntax::{FileId, SourceFile, parse_chart};
use testkit::Texts;

const PATTERN: &str = "
pattern look ($d in Door) \"Look\"
	control eye
	state first \"First\"
	guard seen \"Seen\"
	enter -> first
	first -> seen yes -> exit yes
	seen no -> exit no
endpattern
";

fn machine(paths: &str) -> String {
    format!(
        "chart Door\nmachine door ($d in Door)\n\tcontrol phase\n\tinitial state shut\n\tstate open\n\tstate off\n\
         \tinstance looking of look($d)\n{paths}endmachine\n"
    )
}

fn built(text: &str) -> String {
    let (chart, faults) = read(FileId(0), &parse_chart(FileId(0), text));
    assert_eq!(faults, [], "{text}");
    build(&chart, &Known::default(), None).expect("there was no file").text
}

fn faults(text: &str) -> Vec<String> {
    let (_, faults) = read(FileId(0), &parse_chart(FileId(0), text));
    faults.iter().map(|fault| format!("{}: {}", fault.id, fault.message)).collect()
}

#[test]
fn a_block_leads_on_by_the_answer() {
    let both = machine("\tshut -> looking yes -> open\n\tlooking no -> off\n\toff -> shut\n") + PATTERN;
    let text = built(&both);
    let block = "if phase($d) = LOOKING then
				if isUndef(eye($d)) then
					if lookAnswer($d) then
						phase($d) := OPEN
					else
						phase($d) := OFF
					endif
				else
					r_look[$d]
				endif
			endif";
    assert!(text.contains(block), "{text}");
    assert!(text.contains("// what Look answers\n\tcontrolled lookAnswer: Door -> Boolean"), "{text}");
    // Where there is no exit for an answer, it is asked again.
    let one = machine("\tshut -> looking yes -> open\n\topen -> off\n") + PATTERN;
    let again = "else
						par
							r_look[$d]
							phase($d) := LOOKING
						endpar
					endif";
    assert!(built(&one).contains(again), "{}", built(&one));
}

#[test]
fn in_a_composite_state_too() {
    let text = machine(
        "\tcomposite state inner\n\tinitial state within\n\tinstance inside of look($d)\n\twithin -> inside yes -> off\n\tinside no -> within\n\tendstate\n\tguard stop\n\tinner -> stop yes -> shut\n\tshut -> looking yes -> inner\n\tlooking no -> open\n",
    ) + PATTERN;
    let text = built(&text);
    let left = "if isUndef(eye($d)) then
						if lookAnswer($d) then
							phase($d) := OFF
						else
							phase($d) := WITHIN
						endif";
    assert!(text.contains(left), "{text}");
}

#[test]
fn what_is_written_is_read_back() {
    let text = machine("\tshut -> looking yes -> open\n\tlooking no -> off\n\toff -> shut\n") + PATTERN;
    let (chart, _) = read(FileId(0), &parse_chart(FileId(0), &text));
    let written = chart::write(&chart);
    let (again, faults) = read(FileId(0), &parse_chart(FileId(0), &written));
    assert_eq!(faults, [], "{written}");
    assert_eq!(chart::dump(&again), chart::dump(&chart));
    assert!(written.contains("seen no -> exit no"), "{written}");
    assert_eq!(syntax::format(&parse_chart(FileId(0), &written)), written);
}

#[test]
fn a_word_before_an_arrow_begins_a_path() {
    // Names that are also words were always allowed.
    let text = "chart C pattern p control c state yes state no enter -> yes -> exit no -> yes enter -> no endpattern";
    assert_eq!(faults(text), Vec::<String>::new());
}

#[test]
fn patterns_that_do_not_answer_well() {
    let check = |from: &str, to: &str, expected: &[&str]| {
        let text = (machine("\tshut -> looking yes -> open\n\tlooking no -> off\n") + PATTERN).replace(from, to);
        assert_eq!(faults(&text), expected, "{text}");
    };
    check("", "", &[]);
    check(
        "seen no -> exit no",
        "seen no -> exit",
        &[
            "pattern-answer: no path of `look` leads to `exit no`: it can only answer yes",
            "pattern-answer: `look` is left without an answer here",
        ],
    );
    check(
        "seen no -> exit no",
        "seen no -> exit yes",
        &["pattern-answer: no path of `look` leads to `exit no`: it can only answer yes"],
    );
    check(
        "seen no -> exit no",
        "seen no -> first\n\tstate lost\n\tlost -> exit no",
        &[
            "pattern-answer: no path of `look` leads to `exit no`: it can only answer yes",
            "unreachable-shape: no path leads to the control state `lost`",
        ],
    );
    check(
        "enter -> first",
        "guard may\n\tenter -> may yes -> first",
        &["pattern-answer: `look` is not entered if `may` is no"],
    );
    check(
        "looking yes -> open",
        "looking -> open",
        &["guard-exit: the arrow out of the block `looking` says neither yes nor no"],
    );
    let plain = PATTERN.replace("exit yes", "exit").replace("exit no", "exit");
    assert_eq!(
        faults(&(machine("\tshut -> looking yes -> open\n\topen -> off\n") + &plain)),
        ["guard-exit: `looking` is neither a guard nor a pattern that answers",]
    );
    let at_once = PATTERN
        .replace("\tenter -> first\n\tfirst -> seen", "\tenter -> seen")
        .replace("\tstate first \"First\"\n", "");
    assert_eq!(
        faults(&(machine("\tshut -> looking yes -> open\n\tlooking no -> off\n") + &at_once)),
        ["pattern-answer: `look` answers in the step that enters it",]
    );
    let of_machine = "chart C machine m control c initial state s guard g s -> g yes -> exit yes endmachine";
    assert_eq!(faults(of_machine), ["misplaced-exit: `exit` cannot stand here"]);
    let twice = "chart C machine m control c initial state s guard pAnswer instance i of p s -> pAnswer yes -> i i yes -> s i no -> s endmachine \
                 pattern p control d state t guard g enter -> t t -> g yes -> exit yes g no -> exit no endpattern";
    let (chart, _) = read(FileId(0), &parse_chart(FileId(0), twice));
    let ids: Vec<_> = chart::unbuilt(&chart, &Known::default()).iter().map(|fault| fault.message.clone()).collect();
    assert_eq!(ids, ["a second function `pAnswer` would be made"]);
}

#[test]
fn a_pattern_of_another_file_answers_too() {
    let root = machine("\tshut -> looking yes -> open\n\tlooking no -> off\n")
        .replace("chart Door\n", "chart Door\nimport \"lib/Look.chart\"\n");
    let other = format!("chart Look\n{PATTERN}");
    let texts = [("a/Door.chart", root.as_str()), ("a/lib/Look.chart", other.as_str())];
    let loaded = load(SourceFile::new("a/Door.chart", root.as_str()), &mut Texts::of(texts));
    assert_eq!(loaded.diagnostics, []);
    let text = build(&loaded.chart, &Known::default(), None).expect("there was no file").text;
    assert!(text.contains("if lookAnswer($d) then"), "{text}");
    assert!(!text.contains("controlled lookAnswer"), "{text}");
}
