//! Random things done to pictures of charts: the text means what was drawn, and undoing gives the bytes back.
//!
//! A second account of the chart, shapes and arrows alone, is kept beside the text. GROUNDSTATE_FULL makes ten thousand operations.

use std::collections::{BTreeMap, BTreeSet};

use chart::{Chart, End, Machine};
use ide::{Edit, Fresh, FreshKind, Joint, Operation, drawn, edited};
use syntax::{FileId, parse_chart};

const START: &str = "/* head */\nchart Random\n\npattern part \"Part\" // first\n\tcontrol partState\n\tstate one \"One\" // a comment\n\t// two\n\
                     \tguard g \"G\" {f(1) = 2} to refine\n\taction a \"A\"\n\taction b \"B\" {r_b[]}\n\tsequence a, b\n\tenter -> a -> b -> one\n\
                     \tone -> g yes -> exit\n\tg no -> one\nendpattern // end\n\nlayout part\n\tone at 1, 2 // here\nendlayout\n";

struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % bound.max(1) as u64) as usize
    }
}

#[derive(Debug, Clone, Default, PartialEq)]
struct Account {
    shapes: BTreeMap<String, Figure>,
    arrows: BTreeSet<(String, Option<bool>, String)>,
    places: BTreeMap<String, (i64, i64)>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Figure {
    State,
    Guard,
    Other,
}

fn read(text: &str) -> Chart {
    chart::read(FileId(0), &parse_chart(FileId(0), text)).0
}

fn account(chart: &Chart) -> Account {
    let machine: &Machine = &chart.machines[0];
    let named = |end: End| match end {
        End::Enter => "enter".to_string(),
        End::Exit => "exit".to_string(),
        End::Shape(id) => machine.shape(id).name.clone(),
    };
    let kind = |shape: &chart::Shape| match shape.kind {
        chart::ShapeKind::State { .. } | chart::ShapeKind::Composite(_) => Figure::State,
        chart::ShapeKind::Guard => Figure::Guard,
        chart::ShapeKind::Action | chart::ShapeKind::Instance(_) => Figure::Other,
    };
    Account {
        shapes: machine.shapes.iter().map(|shape| (shape.name.clone(), kind(shape))).collect(),
        arrows: machine.arrows.iter().map(|arrow| (named(arrow.from), arrow.branch, named(arrow.to))).collect(),
        places: chart
            .layouts
            .get("part")
            .into_iter()
            .flatten()
            .map(|(name, at)| (name.clone(), (at.0 as i64, at.1 as i64)))
            .collect(),
    }
}

impl Account {
    /// What connecting two ends makes of it; none if it is refused.
    fn connect(&mut self, from: &str, branch: Option<bool>, to: &str) -> bool {
        let kind = self.shapes.get(from).copied();
        let legal = to != "enter" && from != "exit" && (to == "exit" || self.shapes.contains_key(to));
        let branch = if kind == Some(Figure::Guard) { branch } else { None };
        let known = from == "enter" || kind.is_some();
        if !legal || !known || kind == Some(Figure::Guard) && branch.is_none() {
            return false;
        }
        let forks = from == "enter" || kind == Some(Figure::State);
        if !forks {
            self.arrows.retain(|(other, exit, _)| other != from || *exit != branch);
        }
        self.arrows.insert((from.to_string(), branch, to.to_string()));
        true
    }
}

#[test]
fn the_text_means_what_was_drawn() {
    let rounds = if std::env::var_os("GROUNDSTATE_FULL").is_some() { 10_000 } else { 300 };
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    let mut text = START.to_string();
    let mut kept = account(&read(&text));
    for round in 0..rounds {
        if round % 60 == 59 {
            text = START.to_string();
            kept = account(&read(&text));
        }
        let mut names: Vec<String> = kept.shapes.keys().cloned().collect();
        names.extend(["enter".to_string(), "exit".to_string()]);
        let pick = |random: &mut Random| names[random.below(names.len())].clone();
        let branch = |random: &mut Random| [None, Some(true), Some(false)][random.below(3)];
        let mut next = kept.clone();
        let arrow = (!kept.arrows.is_empty())
            .then(|| kept.arrows.iter().nth(random.below(kept.arrows.len())).cloned())
            .flatten();
        let joint = |(from, branch, to): (String, Option<bool>, String)| Joint { from, branch, to };
        let (operation, is_legal) = match random.below(9) {
            0 | 1 => {
                let (from, branch, to) = (pick(&mut random), branch(&mut random), pick(&mut random));
                let legal = next.connect(&from, branch, &to);
                (Operation::Connect(Joint { from, branch, to }), legal)
            }
            2 if let Some(arrow) = arrow => {
                next.arrows.remove(&arrow);
                (Operation::Disconnect(joint(arrow)), true)
            }
            3 if let Some(arrow) = arrow => {
                let to = pick(&mut random);
                next.arrows.remove(&arrow);
                let legal = next.connect(&arrow.0, arrow.1, &to);
                let new = (arrow.0.clone(), arrow.1, to);
                (Operation::Redirect(joint(arrow), joint(new)), legal)
            }
            4 => {
                let name = pick(&mut random);
                let is_there = next.shapes.remove(&name).is_some();
                next.arrows.retain(|(from, _, to)| *from != name && *to != name);
                next.places.remove(&name);
                (Operation::Delete(vec![name]), is_there)
            }
            5 | 6 => {
                let (kind, own) = [
                    (FreshKind::State, Figure::State),
                    (FreshKind::Guard, Figure::Guard),
                    (FreshKind::Action, Figure::Other),
                ][random.below(3)];
                let name = format!("n{round}");
                let at = (random.below(500) as f64, random.below(500) as f64);
                next.shapes.insert(name.clone(), own);
                next.places.insert(name.clone(), (at.0 as i64, at.1 as i64));
                let text = Some(format!("N {round} // \"no comment\""));
                (Operation::Add(Fresh { kind, name: Some(name), text, link: None, of: None, at }), true)
            }
            7 => {
                let (name, to) = (pick(&mut random), format!("r{round}"));
                let is_there = next.shapes.contains_key(&name);
                if let Some(kind) = next.shapes.remove(&name) {
                    next.shapes.insert(to.clone(), kind);
                }
                if is_there && let Some(place) = next.places.remove(&name) {
                    next.places.insert(to.clone(), place);
                }
                let renamed = |end: &String| if *end == name { to.clone() } else { end.clone() };
                next.arrows =
                    next.arrows.iter().map(|(from, exit, end)| (renamed(from), *exit, renamed(end))).collect();
                (Operation::Rename(name, to), is_there)
            }
            _ => {
                let name = pick(&mut random);
                let at = (random.below(500), random.below(500));
                let is_there = name != "exit";
                next.places.insert(name.clone(), (at.0 as i64, at.1 as i64));
                (Operation::Move(BTreeMap::from([(name, (at.0 as f64, at.1 as f64))])), is_there)
            }
        };
        let done = drawn(&text, "part", &operation, &BTreeMap::new());
        match (done, is_legal) {
            (Ok(done), true) => {
                let edits: Vec<Edit> = done.edit.into_iter().collect();
                let after = edited(&text, &edits);
                assert_eq!(account(&read(&after)), next, "{operation:?}\n{text}\n=>\n{after}");
                for comment in ["/* head */", "// first", "// end", "chart Random"] {
                    assert!(after.contains(comment), "{comment} is lost by {operation:?}\n{after}");
                }
                let back: Vec<Edit> = edits
                    .iter()
                    .map(|edit| {
                        let (start, end) = edit.range;
                        Edit::new(start..start + edit.text.len() as u32, &text[start as usize..end as usize])
                    })
                    .collect();
                assert_eq!(edited(&after, &back), text);
                (text, kept) = (after, next);
            }
            (Err(_), false) => {}
            (done, _) => panic!("{operation:?} is legal: {is_legal}, but {done:?}\n{text}"),
        }
    }
}
