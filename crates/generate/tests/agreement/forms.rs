//! Each form of locations is chosen where it is allowed, and nowhere else.

use syntax::SourceFile;

use crate::run::Disk;
use crate::{Case, judge, prepare};

/// A model with this main rule; `f` and `g` hold what its rules update.
fn model(main: &str) -> String {
    format!(
        "asm Forms\n\nimport StandardLibrary\n\nsignature:\n\tdomain D subsetof Integer\n\tdomain Large subsetof Integer\n\tcontrolled n: Integer\n\
         \tcontrolled f: D -> Integer\n\tcontrolled g: Prod(D, D) -> Integer\n\tcontrolled l: Large -> Integer\n\n\
         definitions:\n\tdomain D = {{0 : 3}}\n\tdomain Large = {{0 : 99}}\n\n\
         \trule r_set($a in D, $b in D) = g($a, $b) := $a * 10 + $b + n\n\n\
         \tmain rule r_Main =\n\t\t{main}\n\n\
         default init s0:\n\tfunction n = 0\n\tfunction f($d in D) = $d\n\tfunction g($a in D, $b in D) = 0\n\
         \tfunction l($d in Large) = $d\n"
    )
}

fn case(name: &str, main: &str, member: &str) -> Case {
    case_of(name, model(main), member)
}

pub(crate) fn case_of(name: &str, text: String, member: &str) -> Case {
    let prepared = match prepare(SourceFile::new("Forms.asm", text.clone()), &mut Disk, 12, 1) {
        Ok(Some(prepared)) => prepared,
        Ok(None) => panic!("{name}: nothing to run"),
        Err(why) => panic!("{name}: {why}"),
    };
    let header = &prepared.generated.files[0].text;
    assert!(header.contains(member), "{name}: no `{member}` in\n{header}");
    Case { name: name.to_string(), text, prepared }
}

#[test]
fn forms() {
    let few = "FewLocations<gs::Clashes::possible, std::int64_t, gs::Between<0, 3>> f_";
    let cases = vec![
        case("two loops", "par forall $i in D do f($i) := $i forall $j in D do f($j) := $j + n n := n + 1 endpar", few),
        case(
            "a variable that names nothing",
            "forall $i in D, $j in D do f($i) := $j",
            "gs::Word<gs::Clashes::possible, gs::IntegerCode<0, 3>, gs::Between<0, 3>> f_",
        ),
        case(
            "undef in a word, below zero",
            "par forall $i in D do if f($i) = 3 then f($i) := undef else f($i) := -$i endif n := n + 1 endpar",
            "gs::Word<gs::Clashes::impossible, gs::MaybeCode<gs::IntegerCode<-3, 3>>, gs::Between<0, 3>> f_",
        ),
        case(
            "one bit too many",
            "forall $i in D with f($i) >= 0 do f($i) := (f($i) + 1) mod 65537",
            "gs::FewLocations<gs::Clashes::impossible, std::int64_t, gs::Between<0, 3>> f_",
        ),
        case(
            "branches apart",
            "forall $i in D do if $i < 2 then f($i) := 1 else f(($i + 2) mod 4) := 2 + f($i) * 3 endif",
            few,
        ),
        case(
            "one place for two",
            "forall $i in D, $j in D do g($i, $i) := $j",
            "IntegerCode<0, 3>, gs::Between<0, 3>, gs::B",
        ),
        case(
            "whole, in a branch",
            "par if n mod 2 = 0 then forall $i in Large do l($i) := l(99 - $i) + n endif n := n + 1 endpar",
            "gs::WholeArray<std::int64_t, 0, gs::Between<0, 99>> l_",
        ),
        case(
            "a part, by a condition",
            "par forall $i in Large with $i > n do l($i) := l(99 - $i) + n n := n + 1 endpar",
            "gs::DisjointLocations<std::int64_t, gs::Nowhere, 0, gs::Between<0, 99>> l_",
        ),
        case(
            "through a call, a choice and a let",
            "par forall $i in D do forall $j in D do r_set[$i, $j] choose $k in Large with true do l($k) := n \
             let ($m = n + 1) in n := $m endlet endpar",
            "gs::DisjointLocations<std::int64_t, gs::Nowhere, 0, gs::Between<0, 99>> l_",
        ),
        case(
            "in sequence",
            "seq forall $i in Large do l($i) := l(99 - $i) + 1 l(0) := l(1) n := n + 1 endseq",
            "gs::Locations<std::int64_t, gs::Nowhere, 0, gs::Between<0, 99>> l_",
        ),
        case(
            "one location twice",
            "par n := 1 if f(0) = 0 then n := 2 - n endif endpar",
            "gs::Location<gs::Clashes::possible, std::int64_t> n_",
        ),
        case("sums beyond 64 bits", "par n := n * 2 + 4000000000000000000 f(n mod 4) := n endpar", "n_"),
    ];
    judge("forms", cases);
}

/// A rule value is a unit of its own only if it may be a turbo rule.
#[test]
fn rule_values() {
    let model = |kind: &str| {
        format!(
            "asm Forms\n\nimport StandardLibrary\n\nsignature:\n\tdomain D subsetof Integer\n\tcontrolled n: Integer\n\
             \tcontrolled f: D -> Integer\n\tcontrolled act: D -> Rule(D)\n\n\
             definitions:\n\tdomain D = {{0 : 3}}\n\n\
             \t{kind} r_first($d in D){} = par f($d) := f($d) * 3 + n if n > 4 then f(0) := 7 endif endpar\n\n\
             \trule r_second($d in D) = f(($d + 1) mod 4) := f($d) + 70000\n\n\
             \tmain rule r_Main = par n := n + 1 if isDef(act(n mod 4)) then act(n mod 4)[n mod 4] endif endpar\n\n\
             default init s0:\n\tfunction n = 0\n\tfunction f($d in D) = $d\n\
             \tfunction act($d in D) = switch $d case 0: <<r_first(D)>> case 2: <<r_second(D)>> otherwise undef endswitch\n",
            if kind.starts_with("turbo") { " in Integer" } else { "" }
        )
    };
    let few = "gs::FewLocations<gs::Clashes::possible, std::int64_t, gs::Between<0, 3>> f_";
    let general = "gs::Locations<std::int64_t, gs::Nowhere, 36, gs::Between<0, 3>> f_";
    judge("rule_values", vec![case_of("plain", model("rule"), few), case_of("turbo", model("turbo rule"), general)]);
}
