//! What a chart's text says of composite states: history, what is done on entering and leaving, and the declaration as it is written.
//!
//! In: the syntax of a composite state, or the JSON of an operation on one. Out: JSON for a box; the operation. Edits are `ide`'s.

use std::collections::BTreeMap;

use ide::{Centre, Copied, Moment, Operation};
use lsp_server::ErrorCode;
use serde_json::{Value, json};
use syntax::ast::{AstNode, CompositeState, Link, Shape};

use crate::route::Refused;

fn wrong(message: &str) -> Refused {
    Refused::new(ErrorCode::InvalidParams, message)
}

/// A link without its braces.
pub fn told(link: &Link) -> String {
    link.syntax().text().to_string().trim().trim_start_matches('{').trim_end_matches('}').trim().to_string()
}

/// What the box of a composite state says beside what all shapes say; `source` is its declaration as it is written.
pub fn of(state: &CompositeState, source: &str) -> Value {
    let history = state.histories().next().map(|history| json!({ "link": history.link().as_ref().map(told) }));
    let doings = state.syntax().children().filter_map(Shape::cast).filter_map(|shape| {
        let when = match &shape {
            Shape::Entry(_) => "entry",
            Shape::Exit(_) => "exit",
            _ => return None,
        };
        let name = shape.name()?.text().to_string();
        let link = shape.link().as_ref().map(told);
        Some(json!({ "id": name, "when": when, "text": shape.text().unwrap_or_default(), "link": link }))
    });
    let doings: Vec<Value> = doings.collect();
    json!({ "history": history, "doings": doings, "source": source })
}

/// An operation on a composite state; none if it is another one.
///
/// # Errors
/// Something is missing in it.
pub fn operation_of(value: &Value) -> Result<Option<Operation>, Refused> {
    let id = || value["id"].as_str().map(str::to_string).ok_or_else(|| wrong("`id` is a text"));
    let filled = |text: &Value| text.as_str().filter(|text| !text.trim().is_empty()).map(str::to_string);
    Ok(Some(match value["kind"].as_str().unwrap_or_default() {
        "history" => {
            let history = &value["history"];
            Operation::History(id()?, history.is_object().then(|| filled(&history["link"])))
        }
        "addDoing" => {
            let moment = match value["when"].as_str() {
                Some("entry") => Moment::Entry,
                Some("exit") => Moment::Exit,
                _ => return Err(wrong("`when` is entry or exit")),
            };
            Operation::AddDoing(id()?, moment, filled(&value["text"]))
        }
        _ => return Ok(None),
    }))
}

/// A composite state that is pasted.
///
/// # Errors
/// Something is missing in it.
pub fn copied(value: &Value, places: BTreeMap<String, Centre>) -> Result<Copied, Refused> {
    let source = value["source"].as_str().ok_or_else(|| wrong("`source` is a declaration"))?;
    Ok(Copied { source: source.to_string(), places })
}
