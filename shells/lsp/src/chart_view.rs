//! Charts as pictures that are drawn in: where everything lies, and what is done to it as edits of the text (docs/editors.md).
//!
//! In: `groundstate/chart/picture` and `groundstate/chart/edit` with parameters as JSON. Out: geometry with places in the text; edits. The
//! picture is the one of `groundstate chart draw`; `ide` knows what an operation means.

use std::collections::BTreeMap;
use std::path::Path;

use chart::{Arrow, Chart, End, Loaded, Machine, Part, ShapeKind};
use draw::{Drawing, Figure, Picture, Placed, Theme, drawings};
use groundstate::Kind;
use ide::{Centre, Fresh, FreshKind, Joint, Operation};
use lsp_server::ErrorCode;
use serde_json::{Map, Value, json};
use syntax::ast::{AstNode, ChartFile, Shape};
use syntax::{FileId, Severity, Span, parse_chart};

use crate::answer::Answers;
use crate::composite_view;
use crate::location::uri_of;
use crate::route::{Refused, subject};

/// The beginning of both methods.
pub const PREFIX: &str = "groundstate/chart/";

/// The version of both.
const VERSION: u32 = 1;

fn wrong(message: impl Into<String>) -> Refused {
    Refused::new(ErrorCode::InvalidParams, message)
}

fn failed(message: impl Into<String>) -> Refused {
    Refused::new(ErrorCode::RequestFailed, message)
}

fn path_in(params: &Value) -> Result<String, Refused> {
    let path = subject(params).filter(|path| Kind::of(Path::new(path)) == Some(Kind::Chart));
    path.ok_or_else(|| wrong("`textDocument.uri` is a chart"))
}

/// Answers a request about a chart.
///
/// # Errors
/// There is no chart or no such request, or it cannot be done; a sentence.
pub fn answer(answers: &mut Answers, method: &str, params: &Value) -> Result<Value, Refused> {
    match method {
        "picture" => picture(answers, params),
        "edit" => edit(answers, params),
        "places" => crate::places_view::places(answers, &path_in(params)?, params),
        "times" => crate::system_view::times(answers, &path_in(params)?),
        other => Err(Refused::new(ErrorCode::MethodNotFound, format!("{PREFIX}{other} is not known"))),
    }
}

/// Where everything lies.
fn picture(answers: &mut Answers, params: &Value) -> Result<Value, Refused> {
    let path = path_in(params)?;
    let theme = match &params["theme"] {
        Value::Null => None,
        Value::String(word) if word == "light" => Some(Theme::Light),
        Value::String(word) if word == "dark" => Some(Theme::Dark),
        _ => return Err(wrong("`theme` is light or dark")),
    };
    let loaded = answers.project.chart(&path).map_err(failed)?;
    let text = answers.project.text(&path).map_err(|absent| failed(absent.told(&path)))?.text;
    let parse = parse_chart(FileId(0), &text);
    let declared = ChartFile::cast(parse.syntax()).map(|file| Declared::of(&file, &text)).unwrap_or_default();
    let systems = crate::system_view::systems(answers, &path, &parse);
    let mut view = View { answers, path: &path, loaded: &loaded, declared: &declared };
    let mut drawn = Vec::new();
    let mut problems: Vec<String> = Vec::new();
    for drawing in drawings(&loaded.chart) {
        match drawing.picture() {
            Ok(picture) => {
                let mut told = view.drawing(&drawing, &picture);
                told["system"] = systems.get(drawing.name()).cloned().unwrap_or_default();
                if let Some(theme) = theme {
                    told["svg"] = json!(drawing.svg(theme).unwrap_or_default());
                }
                drawn.push(told);
            }
            Err(fault) => problems.push(format!("{} cannot be laid out: {fault}", drawing.name())),
        }
    }
    // Of a text that cannot be read as it is, the picture is a guess.
    let is_guess = parse.diagnostics.iter().any(|fault| fault.severity == Severity::Error);
    Ok(json!({ "version": VERSION, "drawings": drawn, "problems": problems, "guess": is_guess }))
}

/// What the text says of drawings and their shapes, by name.
#[derive(Debug, Default)]
struct Declared {
    /// The bytes of each section.
    sections: BTreeMap<String, (u32, u32)>,
    /// By drawing and shape.
    shapes: BTreeMap<(String, String), Declaration>,
}

#[derive(Debug, Clone, Default)]
struct Declaration {
    whole: (u32, u32),
    text: Option<String>,
    link: Option<String>,
    /// The composite state that it stands in.
    within: Option<String>,
    /// What a composite state has of its own.
    composite: Value,
}

/// The bytes of what a node says.
fn bytes(node: &syntax::SyntaxNode) -> (u32, u32) {
    let words = node.descendants_with_tokens().filter_map(|element| element.into_token());
    let words: Vec<_> = words.filter(|token| !token.kind().is_trivia()).collect();
    let start = words.first().map_or(0, |token| u32::from(token.text_range().start()));
    (start, words.last().map_or(start, |token| u32::from(token.text_range().end())))
}

impl Declared {
    fn of(file: &ChartFile, text: &str) -> Declared {
        let mut declared = Declared::default();
        for machine in file.machines() {
            let Some(name) = machine.name() else { continue };
            declared.sections.insert(name.text().to_string(), bytes(machine.syntax()));
            for shape in machine.shapes() {
                let Some(own) = shape.name() else { continue };
                let link = shape.link().as_ref().map(composite_view::told);
                let composite = match &shape {
                    Shape::Composite(state) => {
                        let (start, end) = bytes(state.syntax());
                        composite_view::of(state, text.get(start as usize..end as usize).unwrap_or_default())
                    }
                    _ => Value::Null,
                };
                let within = shape.around().and_then(|around| Shape::Composite(around).name());
                let within = within.map(|name| name.text().to_string());
                let one = Declaration { whole: bytes(shape.syntax()), text: shape.text(), link, within, composite };
                declared.shapes.insert((name.text().to_string(), own.text().to_string()), one);
            }
        }
        for system in file.systems() {
            let Some(name) = system.name() else { continue };
            declared.sections.insert(name.text().to_string(), bytes(system.syntax()));
            let mut add = |own: Option<syntax::SyntaxToken>, node: &syntax::SyntaxNode, text: Option<String>| {
                if let Some(own) = own {
                    let one = Declaration { whole: bytes(node), text, ..Declaration::default() };
                    declared.shapes.insert((name.text().to_string(), own.text().to_string()), one);
                }
            };
            system.components().for_each(|part| add(part.name(), part.syntax(), part.text()));
            system.channels().for_each(|part| add(part.name(), part.syntax(), None));
            system.devices().for_each(|part| add(part.name(), part.syntax(), part.text()));
        }
        declared
    }
}

struct View<'a> {
    answers: &'a mut Answers,
    path: &'a str,
    loaded: &'a Loaded,
    declared: &'a Declared,
}

impl View<'_> {
    fn range(&mut self, bytes: (u32, u32)) -> Value {
        json!(self.answers.range(self.path, bytes))
    }

    fn of_span(&mut self, span: Span) -> Value {
        // What is imported lies in another text.
        if self.loaded.sources.file(span.file).name != self.path {
            return Value::Null;
        }
        self.range((span.start, span.end))
    }

    fn drawing(&mut self, drawing: &Drawing<'_>, picture: &Picture) -> Value {
        let (chart, name) = (&self.loaded.chart, drawing.name());
        let subject = drawing.subject();
        let machine = subject.machine();
        let kind = match machine {
            None => "system",
            Some(machine) if machine.is_pattern => "pattern",
            Some(_) => "machine",
        };
        let link = machine.and_then(|machine| machine.rule.as_ref()).map(|link| link.name.clone());
        let section = self.declared.sections.get(name).copied();
        let boxes: Vec<Value> =
            picture.boxes.iter().map(|placed| self.shape(chart, name, &subject.part, placed)).collect();
        let lines: Vec<Value> = picture
            .lines
            .iter()
            .map(|line| {
                let span = machine.and_then(|machine| {
                    arrow(machine, &picture.boxes[line.from].id, line.branch, &picture.boxes[line.to].id)
                });
                let range = span.map_or(Value::Null, |span| self.of_span(span));
                let branch = line.branch.map(|yes| if yes { "yes" } else { "no" });
                json!({ "from": line.from, "to": line.to, "branch": branch, "points": line.points, "range": range })
            })
            .collect();
        let labels = picture.labels.iter().map(|label| {
            json!({ "of": label.of, "text": label.text, "isLink": label.is_link, "x": label.x, "y": label.y,
                    "width": label.width, "height": label.height })
        });
        let labels: Vec<Value> = labels.collect();
        // A machine with parameters runs for each element: its variable stands for any.
        let parameters = machine.map(|machine| machine.parameters.iter().map(|parameter| parameter.variable.as_str()));
        let elements = [parameters.map(|names| names.collect::<Vec<_>>().join(", ")).unwrap_or_default()];
        let lights: Vec<Value> = subject
            .lights(&elements)
            .iter()
            .map(|lights| {
                let shapes = lights.shapes.iter().map(|light| json!({ "value": light.value, "shape": light.shape }));
                json!({ "name": lights.name, "term": lights.term, "shapes": shapes.collect::<Vec<_>>() })
            })
            .collect();
        let control = machine.and(lights.first()).map(|lights| {
            let of = |light: &Value| Some((light["value"].as_str()?.to_string(), light["shape"].clone()));
            let states: Map<String, Value> = lights["shapes"].as_array().into_iter().flatten().filter_map(of).collect();
            json!({ "term": lights["term"], "states": states })
        });
        let range = section.map_or(Value::Null, |bytes| self.range(bytes));
        json!({
            "name": name,
            "kind": kind,
            "title": subject.title(),
            "link": link,
            "range": range,
            "placed": chart.layouts.contains_key(name),
            "picture": { "left": picture.left, "top": picture.top, "width": picture.width, "height": picture.height,
                         "boxes": boxes, "lines": lines, "labels": labels },
            "control": control,
            "lights": lights,
        })
    }

    fn shape(&mut self, chart: &Chart, drawing: &str, part: &Part<'_>, placed: &Placed) -> Value {
        let own = self.declared.shapes.get(&(drawing.to_string(), placed.id.clone())).cloned();
        let shape = match part {
            Part::Machine(machine) => machine.shapes.iter().find(|shape| shape.name == placed.id),
            Part::System(_) => None,
        };
        let name = match part {
            Part::Machine(_) => shape.map(|shape| shape.span),
            Part::System(system) => {
                let components = system.components.iter().map(|part| (&part.name, part.span));
                let channels = system.channels.iter().map(|part| (&part.drawn, part.span));
                let devices = system.devices.iter().map(|part| (&part.name, part.span));
                components.chain(channels).chain(devices).find(|(name, _)| **name == placed.id).map(|(_, span)| span)
            }
        };
        let pattern = shape.and_then(|shape| chart.pattern_of(shape));
        let machine = match part {
            Part::Machine(_) => None,
            Part::System(system) => system.computing.machines.iter().find_map(|machine| {
                let component = &system.components[machine.component];
                let named = component.phases[machine.phase].machine.as_ref()?;
                (component.name == placed.id).then_some((&machine.source.name, named.text.as_str()))
            }),
        };
        let opens = match (pattern, machine) {
            (Some(pattern), _) => Some((&self.loaded.sources.file(pattern.span.file).name, pattern.name.as_str())),
            (None, machine) => machine,
        };
        let opens = opens.and_then(|(file, name)| Some(json!({ "uri": uri_of(file)?.as_str(), "name": name })));
        let refinement = shape.and_then(|shape| shape.refinement.as_ref());
        let within = own.as_ref().and_then(|own| own.within.clone());
        let of = shape.and_then(|shape| match &shape.kind {
            ShapeKind::Instance(pattern) => Some(pattern.name.clone()),
            ShapeKind::State { .. } | ShapeKind::Composite(_) | ShapeKind::Guard | ShapeKind::Action => None,
        });
        let details =
            placed.details.iter().map(|detail| json!({ "id": detail.id, "text": detail.text, "right": detail.right }));
        let details: Vec<Value> = details.collect();
        let range = own.as_ref().map_or(Value::Null, |own| self.range(own.whole));
        let composite = own.as_ref().map_or(Value::Null, |own| own.composite.clone());
        let name = name.map_or(Value::Null, |span| self.of_span(span));
        json!({
            "id": placed.id,
            "figure": figure(placed.figure),
            "dashed": placed.dashed,
            "initial": placed.initial,
            "lines": placed.lines,
            "details": details,
            "x": placed.x, "y": placed.y, "width": placed.width, "height": placed.height,
            "label": own.as_ref().and_then(|own| own.text.clone()).unwrap_or_default(),
            "link": own.and_then(|own| own.link),
            "refine": refinement.map(|refinement| json!({ "by": refinement.by })),
            "of": of,
            "answers": pattern.is_some_and(chart::Machine::answers),
            "within": within,
            "composite": composite,
            "opens": opens,
            "range": range,
            "nameRange": name,
        })
    }
}

fn figure(figure: Figure) -> &'static str {
    match figure {
        Figure::Circle => "circle",
        Figure::Composite => "composite",
        Figure::Hexagon => "hexagon",
        Figure::Rectangle => "rectangle",
        Figure::Block => "block",
        Figure::Enter => "enter",
        Figure::Exit => "exit",
        Figure::Component => "component",
        Figure::Channel => "channel",
        Figure::Device => "device",
    }
}

/// Where the text has an arrow.
fn arrow(machine: &Machine, from: &str, branch: Option<bool>, to: &str) -> Option<Span> {
    let is = |end: End, id: &str| match end {
        End::Enter => id == "enter",
        End::Exit => id.starts_with("exit "),
        End::Shape(shape) => machine.shape(shape).name == id,
    };
    let answer = |arrow: &&Arrow| match arrow.answer {
        Some(true) => to.starts_with("exit yes "),
        Some(false) => to.starts_with("exit no "),
        None => true,
    };
    let leads = |arrow: &&Arrow| is(arrow.from, from) && arrow.branch == branch && is(arrow.to, to);
    let found = machine.arrows.iter().filter(leads).find(answer);
    found.map(|arrow| arrow.span)
}

/// What is done to a drawing.
fn edit(answers: &mut Answers, params: &Value) -> Result<Value, Refused> {
    let path = path_in(params)?;
    let source = answers.project.text(&path).map_err(|absent| failed(absent.told(&path)))?;
    let drawing = params["drawing"].as_str().unwrap_or_default();
    let operation = &params["operation"];
    let places = centres(&params["places"])?;
    let (edit, select) = match operation["kind"].as_str() {
        Some("layout") => (laid_out(answers, &path, &source.text, drawing)?, Vec::new()),
        _ => {
            let done = ide::drawn(&source.text, drawing, &operation_of(operation)?, &places).map_err(failed)?;
            (done.edit, done.select)
        }
    };
    let edits = edit.iter().map(|edit| json!({ "range": answers.range(&path, edit.range), "newText": edit.text }));
    let edits: Vec<Value> = edits.collect();
    Ok(json!({ "edits": edits, "select": select }))
}

/// All shapes of a drawing get the places that the layout gives them.
fn laid_out(answers: &mut Answers, path: &str, text: &str, drawing: &str) -> Result<Option<ide::Edit>, Refused> {
    let mut chart = answers.project.chart(path).map_err(failed)?.chart;
    chart.layouts.remove(drawing);
    let found = drawings(&chart).into_iter().find(|found| found.name() == drawing);
    let found = found.ok_or_else(|| failed(format!("the chart has no machine or system `{drawing}`")))?;
    let picture = found.picture().map_err(|fault| failed(fault.to_string()))?;
    let centre = |placed: &Placed| (placed.x + placed.width / 2.0, placed.y + placed.height / 2.0);
    let shapes = picture.boxes.iter().filter(|placed| !matches!(placed.figure, Figure::Exit | Figure::Composite));
    let places: BTreeMap<String, Centre> = shapes
        .map(|placed| (placed.id.clone(), centre(placed)))
        .map(|(id, (x, y))| (id, (x.round(), y.round())))
        .collect();
    Ok(ide::drawn(text, drawing, &Operation::Move(places), &BTreeMap::new()).map_err(failed)?.edit)
}

fn centre(value: &Value) -> Result<Centre, Refused> {
    let number = |index: usize| value.get(index).and_then(Value::as_f64);
    number(0).zip(number(1)).ok_or_else(|| wrong("a place is two numbers of pixels"))
}

fn centres(value: &Value) -> Result<BTreeMap<String, Centre>, Refused> {
    match value {
        Value::Null => Ok(BTreeMap::new()),
        Value::Object(places) => places.iter().map(|(id, at)| Ok((id.clone(), centre(at)?))).collect(),
        _ => Err(wrong("`places` has a place for each shape")),
    }
}

fn operation_of(value: &Value) -> Result<Operation, Refused> {
    let text = |key: &str| value[key].as_str().map(str::to_string);
    let needed = |key: &str| text(key).ok_or_else(|| wrong(format!("`{key}` is a text")));
    Ok(match value["kind"].as_str().unwrap_or_default() {
        "move" => Operation::Move(centres(&value["places"])?),
        "add" => Operation::Add(fresh(value)?),
        "connect" => Operation::Connect(joint(value)?),
        "disconnect" => Operation::Disconnect(joint(value)?),
        "redirect" => Operation::Redirect(joint(value)?, joint(&value["new"])?),
        "delete" => {
            let ids = value["ids"].as_array().ok_or_else(|| wrong("`ids` is a list of names"))?;
            Operation::Delete(ids.iter().filter_map(Value::as_str).map(str::to_string).collect())
        }
        "rename" => Operation::Rename(needed("id")?, needed("name")?),
        "text" => Operation::Text(needed("id")?, text("text").filter(|text| !text.is_empty())),
        "link" => Operation::Link(needed("id")?, text("link").filter(|link| !link.trim().is_empty())),
        "refine" => {
            let by = value["refine"].get("by").and_then(Value::as_str).map(str::to_string);
            Operation::Refine(needed("id")?, value["refine"].is_object().then_some(by))
        }
        "initial" => Operation::Initial(needed("id")?),
        "nest" => {
            let ids = value["ids"].as_array().ok_or_else(|| wrong("`ids` is a list of names"))?;
            Operation::Nest(
                ids.iter().filter_map(Value::as_str).map(str::to_string).collect(),
                text("into"),
                centres(&value["places"])?,
            )
        }
        "machine" => Operation::Machine {
            name: needed("name")?,
            is_pattern: value["pattern"].as_bool().unwrap_or(false),
            title: text("title").unwrap_or_default(),
        },
        "paste" => {
            let list = |key: &str| value[key].as_array().cloned().unwrap_or_default();
            let shapes = list("shapes").iter().map(fresh).collect::<Result<_, _>>()?;
            let composites = list("composites");
            let copied = |one: &Value| composite_view::copied(one, centres(&one["places"])?);
            let composites = composites.iter().map(copied).collect::<Result<_, _>>()?;
            Operation::Paste(shapes, composites, list("arrows").iter().map(joint).collect::<Result<_, _>>()?)
        }
        other => match composite_view::operation_of(value)? {
            Some(operation) => operation,
            None => {
                crate::system_view::operation_of(value)?.ok_or_else(|| wrong(format!("`{other}` is no operation")))?
            }
        },
    })
}

fn joint(value: &Value) -> Result<Joint, Refused> {
    let end = |key: &str| {
        let name = value[key].as_str().ok_or_else(|| wrong(format!("`{key}` is the name of a shape")))?;
        // Each floating arrow has an end of its own in the picture, and one name in the text.
        let exit = ["exit yes", "exit no", "exit"]
            .into_iter()
            .find(|exit| name.strip_prefix(exit).is_some_and(|rest| rest.is_empty() || rest.starts_with(' ')));
        Ok(exit.unwrap_or(name).to_string())
    };
    let branch = match &value["branch"] {
        Value::Null => None,
        Value::String(word) if word == "yes" => Some(true),
        Value::String(word) if word == "no" => Some(false),
        _ => return Err(wrong("`branch` is yes, no or null")),
    };
    Ok(Joint { from: end("from")?, branch, to: end("to")? })
}

fn fresh(value: &Value) -> Result<Fresh, Refused> {
    let text = |key: &str| value[key].as_str().filter(|text| !text.is_empty()).map(str::to_string);
    let kind = match value["shape"].as_str().unwrap_or_default() {
        "state" => FreshKind::State,
        "composite" => FreshKind::Composite,
        "guard" => FreshKind::Guard,
        "action" => FreshKind::Action,
        "instance" => FreshKind::Instance,
        "component" => FreshKind::Component,
        "sensor" => FreshKind::Sensor,
        "actuator" => FreshKind::Actuator,
        other => return Err(wrong(format!("`{other}` is no kind of shape"))),
    };
    let at = centre(&value["at"])?;
    Ok(Fresh { kind, name: text("id"), text: text("text"), link: text("link"), of: text("of"), at })
}
