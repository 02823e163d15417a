//! Checking never panics: on mutated models, on any text, and on deep nesting with a small stack.

use crate::support::check_file;
use proptest::prelude::*;

/// Uses every construct once, so that mutations reach every part of the checker.
const MODEL: &str = r#"asm t
import StandardLibrary
import CTLLibrary
import part (part, Part)
export *
signature:
    dynamic abstract domain Order
    enum domain Phase = {IDLE | BUSY}
    domain Small subsetof Integer
    dynamic domain Open subsetof Order
    domain Robot subsetof Agent
    domain Cell subsetof Prod(Integer, Integer)
    static arm: Robot
    static area: Prod(Integer, Integer) -> Integer
    derived busy: Robot -> Boolean
    controlled tasks: Robot -> Seq(Order)
    controlled phase: Phase
    controlled x: Integer
    controlled n: Natural
    controlled r: Real
    controlled p: Prod(Integer, Real)
    controlled s: Powerset(Integer)
    controlled q: Seq(Integer)
    controlled m: Map(Integer, String)
    controlled of: Order -> Integer
    controlled strategy: Rule(Integer)
    monitored b: Boolean
    out text: String
definitions:
    domain Small = {1 : 4}
    function area($w in Integer, $h in Integer) = $w * $h
    function busy($r in Robot) = length(tasks($r)) > 0
    macro rule r_Inc($l in Integer) = $l := $l + 1
    turbo rule r_Sum($n in Integer) in Integer =
        if $n <= 0 then result := 0
        else let ($rest = 0) in seq $rest <- r_Sum($n - 1) result := $rest + $n endseq endlet endif
    rule r_Work = x := self.part + 1
    INVAR b
    JUSTICE b
    COMPASSION (b, not b)
    invariant inv_x over x, Small, r_Work: x >= 0
    CTLSPEC ag(b implies ef(not b))
    main rule r_Main = par
        r_Inc[x]
        x <- r_Sum(3)
        seq x := 1 x := 2 endseq
        if x > 0 then skip elseif b then x := 0 else x := 1 endif
        switch phase case IDLE: phase := BUSY otherwise phase := IDLE endswitch
        choose $o in Order with of($o) < 3 do of($o) := 1 ifnone x := 9
        forall $i in {1 : 3}, $j in s do x := $i
        extend Order with $a, $b do of($a) := of($b)
        while x < 10 do x := x + 1
        iterate x := x + 1 enditerate
        local y: Integer [ y := 0 ] x := y
        let ($k = 1, $v = p) in par x := first($v) r := second($v) endpar endlet
        forall $r in Robot do program($r)
        strategy[x]
        b2 := (forall $i in Small with (exists unique $j in Small with $i = $j))
        s := {$i in Small | $i > 1 : $i * 2}
        m := {1 -> "a", 2 -> "b"}
        m := {$i in Small : $i -> toString($i)}
        q := [10 : 2, 3]
        x := if b then 1 else 2 endif + switch x case 1: 10 otherwise 20 endswitch
        n := 5 r := n p := (1, 2) q := append(q, at(q, 0)) text := "a" + toString('c')
        s := {} x := undef x := -3 mod 2 b3 := 3 in s
    endpar
default init s0:
    domain Open = {}
    function tasks($r in Robot) = []
    function strategy = <<r_Inc(Integer)>>
    agent Robot: r_Work[]
"#;

const PART: &str = "module part\nimport StandardLibrary\nexport *\nsignature:\nabstract domain Part\ncontrolled part: Agent -> Integer\ndefinitions:\n";

fn check(text: &str) {
    let checked = check_file("t.asm", text, &[("part.asm", PART), ("t.asm", text)]);
    for fault in &checked.diagnostics {
        let _ = checked.sources.text(fault.primary.span);
        fault.secondary.iter().for_each(|label| drop(checked.sources.text(label.span).to_string()));
    }
    drop(checked.model.dump());
}

/// The words and marks of the model, with the blanks between them.
fn words() -> Vec<&'static str> {
    let class = |letter: char| match letter {
        _ if letter.is_whitespace() => 0,
        _ if letter.is_alphanumeric() || matches!(letter, '_' | '$' | '"') => 1,
        _ => 2,
    };
    let mut words = Vec::new();
    let mut start = 0;
    let letters: Vec<(usize, char)> = MODEL.char_indices().collect();
    for pair in letters.windows(2) {
        if class(pair[0].1) != class(pair[1].1) || class(pair[1].1) == 2 {
            words.push(&MODEL[start..pair[1].0]);
            start = pair[1].0;
        }
    }
    words.push(&MODEL[start..]);
    words
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn mutated_models_never_panic(changes in prop::collection::vec((0usize..10_000, 0usize..10_000, 0u8..4), 1..6)) {
        let mut words = words();
        for (place, other, change) in changes {
            let (place, other) = (place % words.len(), other % words.len());
            match change {
                0 => { words.remove(place); }
                1 => words[place] = words[other],
                2 => words.swap(place, other),
                _ => words.insert(place, words[other]),
            }
        }
        check(&words.concat());
    }

    #[test]
    fn cut_models_never_panic(end in 0usize..MODEL.len(), start in 0usize..200) {
        let end = (0..=end).rev().find(|at| MODEL.is_char_boundary(*at)).unwrap_or(0);
        check(&MODEL[start.min(end)..end]);
    }

    #[test]
    fn any_text_never_panics(text in "\\PC{0,200}") {
        check(&text);
        check(&format!("asm t signature: definitions: main rule r_Main = x := {text}"));
    }
}

#[test]
fn deep_nesting_needs_no_deep_stack() {
    let model = |rule: String| {
        format!(
            "asm t\nimport StandardLibrary\nsignature:\ncontrolled x: Integer\ndefinitions:\nmain rule r_Main = {rule}"
        )
    };
    let nested = |open: &str, core: &str, close: &str| open.repeat(20_000) + core + &close.repeat(20_000);
    let models = [
        model(format!("x := {}", nested("(", "1", ")"))),
        model(format!("x := {}", nested("-", "1", ""))),
        model(format!("x := {}", nested("", "1", " + 1"))),
        model(format!("x := {}", nested("x + (", "1", ")"))),
        model(format!("x := {}", nested("{", "1", "}"))),
        model(format!("x := {}", nested("if true then ", "1", " endif"))),
        model(nested("if true then ", "skip", " endif")),
        model(nested("par skip ", "skip", " endpar")),
        model(nested("let ($x = 1) in ", "skip", " endlet")),
        model(nested("forall $x in {1} do ", "x := $x", "")),
        model(format!("par {} endpar", "x := 1 ".repeat(20_000))),
        format!("asm t\nsignature:\ncontrolled x: {}\ndefinitions:\n", nested("Seq(", "Integer", ")")),
    ];
    let work = move || models.iter().for_each(|model| check(model));
    let thread = std::thread::Builder::new().stack_size(2 << 20).spawn(work).expect("a thread");
    thread.join().expect("no overflow");
}
