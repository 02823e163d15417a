//! Undef arguments, and sequences stored as lists: each is stored in the right place, and agrees with the machine.

use crate::forms::case_of;
use crate::judge;

/// Functions over colours, read and updated where the colour is undef.
fn places(main: &str) -> String {
    format!(
        "asm Forms\n\nimport StandardLibrary\n\nsignature:\n\tenum domain Colour = {{RED | GREEN | BLUE}}\n\
         \tdomain D subsetof Integer\n\tdomain Robot subsetof Agent\n\tstatic left: Robot\n\tstatic right: Robot\n\
         \tcontrolled colour: Colour\n\tcontrolled after: Colour -> Colour\n\tcontrolled count: Colour -> Integer\n\
         \tcontrolled big: Colour -> Integer\n\tcontrolled mark: Prod(Colour, D) -> Integer\n\tcontrolled n: Integer\n\
         \tcontrolled inverse: Colour -> Integer\n\tcontrolled load: Robot -> Integer\n\tcontrolled mate: Robot -> Robot\n\n\
         definitions:\n\tdomain D = {{0 : 3}}\n\n\
         \trule r_work = par load(self) := load(self) + 1 if isDef(mate(self)) then load(mate(self)) := load(self) + 1 endif endpar\n\n\
         \tmain rule r_Main =\n\t\tpar\n\t\t\tn := n + 1\n\
         \t\t\tif isDef(after(colour)) then colour := after(colour) else colour := RED endif\n\t\t\t{main}\n\t\tendpar\n\n\
         default init s0:\n\tfunction n = 0\n\tfunction colour = RED\n\
         \tfunction after($c in Colour) = switch $c case RED: GREEN case GREEN: BLUE otherwise undef endswitch\n\
         \tfunction count($c in Colour) = if $c = RED then 7 else 3 endif\n\tfunction big($c in Colour) = 100000\n\
         \tfunction inverse($c in Colour) = switch $c case RED: 1 case GREEN: 2 case BLUE: 3 endswitch + 1\n\
         \tfunction load($r in Robot) = 0\n\tfunction mate($r in Robot) = if $r = left then undef else undef endif\n\
         \tagent Robot: r_work[]\n"
    )
}

#[test]
fn undef_has_a_place() {
    judge(
        "places",
        vec![
            case_of(
                "read and updated",
                places(
                    "par count(after(colour)) := (count(after(colour)) + count(colour)) mod 50 mark(after(colour), n mod 4) := n endpar",
                ),
                "gs::Fixed<gs::Maybe<Colour>, gs::OrUndef<gs::Below<Colour, 3>>> after_",
            ),
            case_of(
                "two places, one of them undef",
                places("par big(after(colour)) := big(colour) + n big(undef) := big(after(colour)) * 2 endpar"),
                "gs::OrUndef<gs::Below<Colour, 3>>> big_",
            ),
            case_of(
                "clash at undef",
                places(
                    "if n > 2 then par big(after(after(colour))) := 1 big(after(after(after(colour)))) := 2 endpar endif",
                ),
                "gs::OrUndef<gs::Below<Colour, 3>>> big_",
            ),
            // The initial value for undef faults, but only when it is read.
            case_of(
                "no initial value of undef",
                places("big(RED) := inverse(after(colour))"),
                "gs::Growing, 0, gs::Below<Colour, 3>> inverse_",
            ),
            case_of(
                "agents that nobody makes",
                places("forall $r in Robot with n < 5 do program($r)"),
                "std::int64_t, gs::OrUndef<gs::Below<Agent, 2>>> load_",
            ),
        ],
    );
}

/// A sequence of colours, and functions of it.
fn lists(main: &str) -> String {
    format!(
        "asm Forms\n\nimport StandardLibrary\n\nsignature:\n\tenum domain Colour = {{RED | GREEN | BLUE}}\n\
         \tcontrolled n: Integer\n\tcontrolled line: Seq(Colour)\n\tcontrolled other: Colour -> Seq(Colour)\n\
         \tcontrolled told: Integer -> Integer\n\tcontrolled seen: Integer -> Boolean\n\tcontrolled one: Colour\n\
         \tstatic colour: Integer -> Colour\n\tstatic reds: Seq(Colour) -> Seq(Colour)\n\n\
         definitions:\n\tfunction colour($n in Integer) = switch $n mod 3 case 0: RED case 1: GREEN otherwise BLUE endswitch\n\
         \tfunction reds($s in Seq(Colour)) = [$c in $s | $c = RED : $c]\n\n\
         \tmain rule r_Main = par n := n + 1 {main} endpar\n\n\
         default init s0:\n\tfunction n = 0\n\tfunction line = []\n\
         \tfunction other($c in Colour) = if $c = RED then [RED, BLUE] else [] endif\n"
    )
}

#[test]
fn sequences_of_small_domains() {
    let told = "told(0) := length(line) told(1) := indexOf(line, BLUE) told(2) := length([$c in line | $c != GREEN : $c]) \
                seen(0) := contains(line, GREEN) seen(1) := isEmpty(line) seen(2) := line = other(RED) \
                seen(3) := (exists $c in asSet(line) with $c = BLUE) seen(4) := (forall $c in line with $c != RED) \
                seen(5) := (exist unique $c in asSet(line) with $c = RED)";
    let grows = |by: &str| {
        lists(&format!("{told} line := {by} other(colour(n)) := union(line, [$c in line | $c = colour(n) : $c])"))
    };
    judge(
        "lists",
        vec![
            case_of("beyond what fits", grows("union(append(line, colour(n)), [BLUE, RED])"), "gs::List<Colour>> line_"),
            case_of(
                "a queue",
                grows("if length(line) > 3 then tail(append(line, colour(n))) else append(line, colour(n)) endif"),
                "gs::List<Colour>> line_",
            ),
            case_of(
                "with undef",
                grows("if n mod 3 = 1 then append(line, undef) else append(line, colour(n)) endif"),
                "gs::List<Colour>> line_",
            ),
            case_of(
                "by functions that lists have not",
                grows("reds(replaceAt(append(append(line, RED), RED), 0, colour(n)))"),
                "gs::List<Colour>> line_",
            ),
            case_of("the first of none", lists("one := first(line)"), "gs::List<Colour>> line_"),
            case_of(
                "ranged over while a part of a sequence changes it",
                lists("seq line := [RED, GREEN, BLUE] forall $c in line do seq line := [$c] other($c) := line endseq line := tail([RED, $c]) endseq")
                    .replace("line := tail([RED, $c])", "one := BLUE"),
                "gs::List<Colour>",
            ),
            case_of("undef instead of a line", lists("if n = 2 then line := undef else told(n) := length(line) endif"), "gs::Maybe<gs::List<Colour>>"),
        ],
    );
}
