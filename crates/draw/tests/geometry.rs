//! Every chart is drawn so that it can be read: no two shapes overlap, no label lies on a shape, a line or another label,
//! no line runs through a shape, every line starts and ends on the edge of its shape. So it is for every chart of the
//! repository, for charts made at random, for one of 500 shapes, and, where the chart says where shapes lie, for random
//! places; and these are kept. The SVG is well-formed and says in words what it shows.

use chart::{Chart, read};
use draw::{Figure, Notation, Picture, Theme, drawings, export};
use syntax::{FileId, parse_chart};
use testkit::{Page, repository};

fn read_chart(text: &str) -> Chart {
    let (chart, faults) = read(FileId(0), &parse_chart(FileId(0), text));
    let errors = faults.iter().filter(|fault| fault.severity == syntax::Severity::Error);
    assert_eq!(errors.collect::<Vec<_>>(), Vec::<&syntax::Diagnostic>::new(), "{text}");
    chart
}

fn texts() -> Vec<String> {
    let files = ["examples", "library"].map(|folder| repository::files(folder, &["chart"])).concat();
    let page = Page::spec("charts");
    files.iter().map(repository::text).chain(page.texts("chart").into_iter().map(str::to_string)).collect()
}

/// Left, upper, right and lower end.
type Area = (f64, f64, f64, f64);

fn area(x: f64, y: f64, width: f64, height: f64) -> Area {
    (x, y, x + width, y + height)
}

fn overlap(a: Area, b: Area) -> bool {
    let slack = 0.5;
    a.0 + slack < b.2 && b.0 + slack < a.2 && a.1 + slack < b.3 && b.1 + slack < a.3
}

/// The area that a stretch of a line covers.
fn stretch(from: (f64, f64), to: (f64, f64)) -> Area {
    (from.0.min(to.0) - 0.8, from.1.min(to.1) - 0.8, from.0.max(to.0) + 0.8, from.1.max(to.1) + 0.8)
}

fn inside(a: Area, picture: &Picture) -> bool {
    let Picture { left, top, width, height, .. } = *picture;
    a.0 >= left && a.1 >= top && a.2 <= left + width && a.3 <= top + height
}

/// Whether a composite state holds a shape.
fn holds(picture: &Picture, outer: usize, inner: usize) -> bool {
    std::iter::successors(picture.boxes[inner].inside, |next| picture.boxes[*next].inside).any(|next| next == outer)
}

fn assert_readable(picture: &Picture, name: &str) {
    let shapes: Vec<(Area, &str, Figure)> = picture
        .boxes
        .iter()
        .map(|shape| (area(shape.x, shape.y, shape.width, shape.height), shape.id.as_str(), shape.figure))
        .collect();
    for (index, (a, first, _)) in shapes.iter().enumerate() {
        assert!(inside(*a, picture), "{name}: {first} is outside");
        for (other, (b, second, _)) in shapes.iter().enumerate().skip(index + 1) {
            let nested = holds(picture, index, other) || holds(picture, other, index);
            assert!(nested || !overlap(*a, *b), "{name}: {first} overlaps {second}");
            for (outer, a, inner, b) in [(index, a, other, b), (other, b, index, a)] {
                let within = b.0 >= a.0 && b.1 >= a.1 && b.2 <= a.2 && b.3 <= a.3;
                assert!(
                    within || !holds(picture, outer, inner),
                    "{name}: {first} and {second} are not one in the other"
                );
            }
        }
    }
    let labels: Vec<(Area, &str)> = picture
        .labels
        .iter()
        .map(|label| (area(label.x, label.y, label.width, label.height), label.text.as_str()))
        .collect();
    for (index, (a, text)) in labels.iter().enumerate() {
        assert!(inside(*a, picture), "{name}: {text} is outside");
        // What stands in a composite state, and what leads there, lies in its frame.
        for (b, id, figure) in shapes.iter().filter(|(.., figure)| *figure != Figure::Composite) {
            // The corner of a hexagon's box beside its slanted edge is free.
            let free = *figure == Figure::Hexagon && (a.1 > (b.1 + b.3) / 2.0 || a.3 < (b.1 + b.3) / 2.0);
            assert!(free || !overlap(*a, *b), "{name}: the label {text} lies on {id}");
        }
        for (b, other) in &labels[index + 1..] {
            assert!(!overlap(*a, *b), "{name}: the label {text} lies on {other}");
        }
        for line in &picture.lines {
            for pair in line.points.windows(2) {
                assert!(!overlap(*a, stretch(pair[0], pair[1])), "{name}: a line runs through the label {text}");
            }
        }
    }
    for line in &picture.lines {
        assert!(line.points.len() >= 2, "{name}: an arrow without points");
        for (x, y) in &line.points {
            assert!(inside((*x, *y, *x, *y), picture), "{name}: an arrow leads outside");
        }
        for pair in line.points.windows(2) {
            assert!(pair[0].0 == pair[1].0 || pair[0].1 == pair[1].1, "{name}: a line is neither level nor upright");
            for (index, (b, id, _)) in shapes.iter().enumerate() {
                let own = index == line.from || index == line.to || picture.boxes[index].figure == Figure::Composite;
                assert!(own || !overlap(*b, stretch(pair[0], pair[1])), "{name}: a line runs through {id}");
            }
        }
        for (end, shape) in [(line.points[0], line.from), (line.points[line.points.len() - 1], line.to)] {
            let (left, upper, right, lower) = shapes[shape].0;
            let (x, y) = end;
            let inside = x >= left - 0.5 && x <= right + 0.5 && y >= upper - 0.5 && y <= lower + 0.5;
            let edge = [x - left, right - x, y - upper, lower - y].iter().any(|distance| distance.abs() < 0.5);
            assert!(inside && edge, "{name}: an arrow does not meet {}", shapes[shape].1);
        }
    }
}

#[test]
fn every_chart_is_readable() {
    let mut count = 0;
    for text in texts() {
        let chart = read_chart(&text);
        for drawing in drawings(&chart) {
            let picture = drawing.picture().expect("it is laid out");
            assert_readable(&picture, &format!("{}/{}", chart.name, drawing.name()));
            let svg = drawing.svg(Theme::Auto).expect("it is drawn");
            let tree = roxmltree::Document::parse(&svg).expect("the SVG is well-formed");
            let titled = |tag: &str| tree.descendants().any(|node| node.has_tag_name(tag) && node.text().is_some());
            assert!(titled("title") && titled("desc"), "{svg}");
            assert_eq!(svg, drawing.svg(Theme::Auto).expect("it is drawn again"));
            if let Some(scxml) = export(&drawing, Notation::Scxml) {
                roxmltree::Document::parse(&scxml).expect("the SCXML is well-formed");
            }
            count += 1;
        }
    }
    assert!(count >= 5, "hardly a chart was found");
}

/// A ladder of states, each with two guards and an action.
fn ladder(states: usize) -> String {
    let mut text = "chart Large machine m control c\n".to_string();
    for n in 0..states {
        let initial = if n == 0 { "initial " } else { "" };
        text += &format!("{initial}state s{n} guard a{n} guard b{n} {{test{n}}} action d{n} {{r_do{n}[]}}\n");
    }
    for n in 0..states {
        let next = (n + 1) % states;
        text +=
            &format!("s{n} -> a{n} yes -> d{n} -> s{next} a{n} no -> b{n} b{n} yes -> s{} b{n} no -> s{n}\n", n / 2);
    }
    text + "endmachine\n"
}

#[test]
fn a_large_chart_is_readable() {
    let chart = read_chart(&ladder(125));
    let picture = drawings(&chart)[0].picture().expect("it is laid out");
    assert_eq!(picture.boxes.len(), 500);
    assert_readable(&picture, "the large chart");
}

/// Numbers that look random and are the same in every run.
struct Dice(u64);

impl Dice {
    fn throw(&mut self, sides: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % sides.max(1)
    }

    fn words(&mut self, most: usize) -> String {
        let words = ["on", "time", "elapsed", "managing", "swinging", "buffer", "acknowledged", "a", "READ", "lock"];
        (0..=self.throw(most)).map(|_| words[self.throw(words.len())]).collect::<Vec<_>>().join(" ")
    }

    fn link(&mut self, before: &str) -> String {
        if self.throw(3) == 0 { String::new() } else { format!(" {{{before}{}}}", self.words(2).replace(' ', "_")) }
    }
}

/// A machine or pattern with so many states, whose paths lead over guards and actions of their own or of others. If it is nested, any
/// shape may stand in one of two composite states.
fn random(seed: u64, most: usize, nested: bool) -> String {
    let mut dice = Dice(seed);
    let is_pattern = dice.throw(2) == 0;
    let states = 1 + dice.throw(most);
    let (open, close) = if is_pattern { ("pattern", "endpattern") } else { ("machine", "endmachine") };
    let head = format!("chart Random {open} m \"{}\" control c\n", dice.words(4));
    // What stands in no composite state, in the outer and in the inner one.
    let mut shapes = [String::new(), String::new(), String::new()];
    let mut paths = String::new();
    let mut declared = |dice: &mut Dice, text: String| shapes[if nested { dice.throw(3) } else { 0 }] += &text;
    for n in 0..states {
        let initial = if n == 0 && !is_pattern && !nested { "initial " } else { "" };
        let link = if dice.throw(2) == 0 { format!(" {{S{n}}}") } else { String::new() };
        let text = format!("{initial}state s{n} \"{}\"{link}\n", dice.words(3));
        declared(&mut dice, text);
    }
    if is_pattern {
        declared(&mut dice, "action first\n".to_string());
        paths += "enter -> first -> s0\n";
    }
    let target = |dice: &mut Dice, actions: usize| match dice.throw(5) {
        0 if is_pattern => "exit".to_string(),
        1 if actions > 0 => format!("a{}", dice.throw(actions)),
        2 if nested => ["around", "within"][dice.throw(2)].to_string(),
        _ => format!("s{}", dice.throw(states)),
    };
    let (mut guards, mut actions) = (0, 0);
    for n in 0..states {
        let mut from = format!("s{n}");
        for _ in 0..1 + dice.throw(2) {
            let refined = if dice.throw(4) == 0 { " to refine" } else { "" };
            let text = format!("guard g{guards} \"{}\"{}{refined}\n", dice.words(4), dice.link(""));
            declared(&mut dice, text);
            let text = format!("action a{actions} \"{}\"{}\n", dice.words(3), dice.link("r_").replace("}", "[]}"));
            declared(&mut dice, text);
            // To an action made before, or to a state: never in a circle without one.
            paths += &format!("{from} -> g{guards} yes -> a{actions} -> {}\n", target(&mut dice, actions));
            match dice.throw(3) {
                0 => {}
                1 => paths += &format!("g{guards} no -> {}\n", target(&mut dice, actions)),
                _ => paths += &format!("g{guards} no -> s{n}\n"),
            }
            guards += 1;
            actions += 1;
            from = if nested && dice.throw(3) == 0 { "around".to_string() } else { format!("s{}", dice.throw(states)) };
        }
    }
    let [outside, around, within] = shapes;
    if !nested {
        return head + &outside + &paths + close + "\n";
    }
    let (initial, title) = (if is_pattern { "" } else { "initial " }, dice.words(3));
    format!(
        "{head}{outside}{initial}composite state around \"{title}\" history entry come exit go initial state q {around}\
         composite state within initial state r {within}endstate endstate {paths}{close}\n"
    )
}

#[test]
fn random_charts_are_readable() {
    for (seed, nested) in (0..150).map(|seed| (seed, false)).chain((0..24).map(|seed| (seed, true))) {
        let text = random(seed, 2 + seed as usize / 10, nested);
        let picture = drawings(&read_chart(&text))[0].picture().expect("it is laid out");
        assert_readable(&picture, &format!("seed {seed}\n{text}"));
    }
}

/// Machine and shape, and the shape's centre.
type Places = Vec<(String, (f64, f64))>;

/// The chart with places: those of its picture, drawn apart and moved a little; some are left out.
fn placed(text: &str, dice: &mut Dice, left_out: usize) -> (String, Places) {
    let chart = read_chart(text);
    let (mut out, mut places) = (text.to_string(), Places::new());
    for drawing in drawings(&chart) {
        if chart.layouts.contains_key(drawing.name()) {
            continue;
        }
        out += &format!("\nlayout {}\n", drawing.name());
        for shape in drawing.picture().expect("it is laid out").boxes {
            if matches!(shape.figure, Figure::Exit | Figure::Composite) || dice.throw(100) < left_out {
                continue;
            }
            let mut moved = |at: f64| (at * 1.6 + dice.throw(40) as f64).round() - 20.0;
            let place = (moved(shape.x + shape.width / 2.0), moved(shape.y + shape.height / 2.0));
            out += &format!("\t{} at {}, {}\n", shape.id, place.0, place.1);
            places.push((format!("{}/{}", drawing.name(), shape.id), place));
        }
        out += "endlayout\n";
    }
    (out, places)
}

fn assert_placed(text: &str, places: &[(String, (f64, f64))], name: &str) {
    let chart = read_chart(text);
    for drawing in drawings(&chart) {
        let picture = drawing.picture().expect("it is laid out");
        assert_readable(&picture, name);
        for shape in &picture.boxes {
            let id = format!("{}/{}", drawing.name(), shape.id);
            let centre = (shape.x + shape.width / 2.0, shape.y + shape.height / 2.0);
            if let Some((_, place)) = places.iter().find(|(known, _)| *known == id) {
                assert_eq!(centre, *place, "{name}: {id} moved");
            }
        }
    }
}

#[test]
fn places_are_kept() {
    let mut dice = Dice(7);
    let full = testkit::sample::is_full();
    for (index, text) in texts().iter().enumerate() {
        let both = [0, 30];
        for left_out in if full { &both[..] } else { &both[index % 2..=index % 2] }.iter().copied() {
            let (text, places) = placed(text, &mut dice, left_out);
            assert_placed(&text, &places, &format!("chart {index} without {left_out} %\n{text}"));
        }
    }
    for seed in (0..60).filter(|seed| full || seed % 3 == 0) {
        let nested = seed % 4 == 3;
        let (text, places) = placed(&random(seed, 2 + seed as usize / 10, nested), &mut dice, (seed % 3 * 20) as usize);
        assert_placed(&text, &places, &format!("seed {seed}\n{text}"));
    }
}

/// A machine with a composite state into whose initial state a path leads back.
const PICKER: &str = "chart Picker

machine picker
	control mode
	composite state working
		initial state seeking
		state carrying
		state dropping
		guard found
		guard overBin
		guard dropped
		seeking -> found yes -> carrying -> overBin yes -> dropping -> dropped yes -> seeking
	endstate
	initial state parked
	guard pressed
	guard stopped
	action halt
	parked -> pressed yes -> working
	working -> stopped yes -> halt -> parked
endmachine
";

/// A guard whose `no` leads back to a state above.
const DOCK: &str = "chart Dock

machine dock
	control mode
	initial state away
	state approaching
	state aligning
	state docked
	state charging
	state broken
	guard low
	guard near
	guard faulty
	guard aligned
	guard triesLeft
	guard contact
	guard full
	action again
	action alarm
	action on
	away -> low yes -> approaching
	approaching -> near yes -> aligning
	near no -> faulty yes -> alarm -> broken -> away
	faulty no -> approaching
	aligning -> aligned yes -> docked
	aligned no -> triesLeft yes -> again -> approaching
	triesLeft no -> alarm
	docked -> contact yes -> on -> charging
	contact no -> aligning
	charging -> full yes -> away
	full no -> charging
endmachine
";

/// What `chart place` writes changes no picture by more than half a pixel.
#[test]
fn a_placed_chart_is_drawn_as_before() {
    for text in [PICKER, DOCK].into_iter().map(str::to_string).chain(texts()) {
        let parse = parse_chart(FileId(0), &text);
        let chart = read_chart(&text);
        let written =
            draw::place(&chart, &parse, &text, |name| !chart.layouts.contains_key(name)).expect("it is placed");
        let placed = read_chart(&written);
        for (before, after) in drawings(&chart).iter().zip(&drawings(&placed)) {
            if chart.layouts.contains_key(before.name()) {
                continue;
            }
            let (before, after) = (before.picture().expect("it is laid out"), after.picture().expect("it is laid out"));
            let near = |a: f64, b: f64| (a - b).abs() <= 0.5;
            let same = |a: &(f64, f64), b: &(f64, f64)| near(a.0, b.0) && near(a.1, b.1);
            for (one, other) in before.lines.iter().zip(&after.lines) {
                let all = one.points.len() == other.points.len();
                assert!(
                    all && one.points.iter().zip(&other.points).all(|(a, b)| same(a, b)),
                    "{one:?}\n{other:?}\n{written}"
                );
            }
            for (one, other) in before.boxes.iter().zip(&after.boxes) {
                assert!(same(&(one.x, one.y), &(other.x, other.y)), "{one:?} {other:?}");
            }
        }
    }
}

/// A shape that is moved takes along its own arrows alone.
#[test]
fn what_was_not_moved_keeps_its_arrows() {
    let chart = read_chart(PICKER);
    let written = draw::place(&chart, &parse_chart(FileId(0), PICKER), PICKER, |_| true).expect("it is placed");
    let line = written.lines().find(|line| line.starts_with("\thalt at ")).expect("it has a place");
    let moved = written.replace(line, "\thalt at -400, 2000");
    let (before, after) = (read_chart(&written), read_chart(&moved));
    let picture = |chart: &Chart| drawings(chart)[0].picture().expect("it is laid out");
    let (before, after) = (picture(&before), picture(&after));
    assert_readable(&after, "halt was moved");
    let halt = before.boxes.iter().position(|shape| shape.id == "halt").expect("it is drawn");
    let kept = before.lines.iter().zip(&after.lines).filter(|(line, _)| line.from != halt && line.to != halt);
    let kept: Vec<_> = kept.collect();
    assert!(kept.len() >= 8 && kept.iter().all(|(one, other)| one == other), "{kept:#?}");
}

#[test]
fn a_composite_state_begins_with_its_initial_state() {
    let chart = read_chart(PICKER);
    let picture = drawings(&chart)[0].picture().expect("it is laid out");
    let y = |id: &str| picture.boxes.iter().find(|shape| shape.id == id).expect("it is drawn").y;
    for other in ["carrying", "dropping", "found", "overBin", "dropped"] {
        assert!(y("seeking") < y(other), "{other}");
    }
}

/// Where `no` leads to the left, it leaves there, and crosses no arrow of its own guard.
#[test]
fn what_leads_to_the_left_leaves_there() {
    let chart = read_chart(DOCK);
    let picture = drawings(&chart)[0].picture().expect("it is laid out");
    assert_readable(&picture, "dock");
    let guard = picture.boxes.iter().position(|shape| shape.id == "triesLeft").expect("it is drawn");
    let no = picture.lines.iter().find(|line| line.from == guard && line.branch == Some(false)).expect("it is drawn");
    assert!(no.points[1].0 < no.points[0].0, "{no:?}");
    for other in picture.lines.iter().filter(|line| line.to == guard || line.from == guard && line.branch == Some(true))
    {
        let mut pairs = no.points.windows(2).flat_map(|a| other.points.windows(2).map(move |b| (a, b)));
        assert!(!pairs.any(|(a, b)| overlap(stretch(a[0], a[1]), stretch(b[0], b[1]))), "{no:?} {other:?}");
    }
}

#[test]
fn a_large_chart_keeps_its_places() {
    let (text, places) = placed(&ladder(30), &mut Dice(3), 4);
    assert_placed(&text, &places, "the large chart");
    // One so large that ELK is not asked where all places are given.
    let (text, places) = placed(&ladder(31), &mut Dice(3), 0);
    assert_placed(&text, &places, "the larger chart");
}

#[test]
fn pictures_are_files() {
    let chart = read_chart(&texts()[0]);
    let drawing = drawings(&chart)[0];
    for theme in [Theme::Light, Theme::Dark] {
        let png = drawing.png(theme, 1.0).expect("it is drawn").bytes;
        assert!(png.starts_with(b"\x89PNG") && png.len() > 5_000, "{}", png.len());
        assert_eq!(png, drawing.png(theme, 1.0).expect("it is drawn again").bytes);
        let pdf = drawing.pdf(theme).expect("it is drawn").bytes;
        assert!(pdf.starts_with(b"%PDF") && pdf.len() > 5_000, "{}", pdf.len());
        assert_eq!(pdf, drawing.pdf(theme).expect("it is drawn again").bytes);
    }
    assert!(drawing.png(Theme::Light, 1000.0).is_err());
}
