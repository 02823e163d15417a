//! JSON Schema (2020-12) as far as our own schemas use it. A keyword that is not known here fails the test, so nothing is
//! taken for checked that was not looked at.

use serde_json::{Map, Value};

/// Words that say nothing about what is valid.
const SILENT: [&str; 6] = ["$schema", "$defs", "title", "description", "format", "version"];

/// The first departure of a value from a schema, with its place; none if the value is valid.
///
/// # Panics
/// The schema has a keyword that is not known here, or one that is put together wrongly.
pub fn departure(schema: &Value, value: &Value) -> Option<String> {
    departs(schema, schema, value, "")
}

fn departs(root: &Value, schema: &Value, value: &Value, at: &str) -> Option<String> {
    let keywords = match schema {
        Value::Bool(true) => return None,
        Value::Bool(false) => return Some(format!("{at}: nothing may stand here")),
        Value::Object(keywords) => keywords,
        other => panic!("{other} is no schema"),
    };
    let words = keywords.iter().filter(|(word, _)| !SILENT.contains(&word.as_str()));
    words.into_iter().find_map(|(word, told)| keyword(root, keywords, (word, told), value, at))
}

fn keyword(
    root: &Value,
    keywords: &Map<String, Value>,
    (word, told): (&str, &Value),
    value: &Value,
    at: &str,
) -> Option<String> {
    let inner = |schema: &Value, value: &Value, at: &str| departs(root, schema, value, at);
    let list = || told.as_array().unwrap_or_else(|| panic!("`{word}` is no list"));
    let wrong = |what: String| Some(format!("{at}: {what}"));
    let count = || told.as_u64().unwrap_or_else(|| panic!("`{word}` is no number")) as usize;
    match word {
        "$ref" => {
            let pointer = told.as_str().and_then(|text| text.strip_prefix('#')).expect("a reference within the schema");
            inner(root.pointer(pointer).unwrap_or_else(|| panic!("{told} leads nowhere")), value, at)
        }
        "type" => {
            let types = told.as_array().map_or_else(|| vec![told], |types| types.iter().collect());
            let fits = types.iter().any(|of| is_of(of.as_str().expect("the name of a type"), value));
            if fits { None } else { wrong(format!("{value} is not of type {told}")) }
        }
        "const" => {
            if value == told {
                None
            } else {
                wrong(format!("{value} is not {told}"))
            }
        }
        "enum" => {
            if list().contains(value) {
                None
            } else {
                wrong(format!("{value} is none of {told}"))
            }
        }
        "anyOf" => {
            let all: Vec<Option<String>> = list().iter().map(|one| inner(one, value, at)).collect();
            if all.contains(&None) {
                None
            } else {
                wrong(format!("it is none of: {}", all.into_iter().flatten().collect::<Vec<_>>().join(" | ")))
            }
        }
        "oneOf" => match list().iter().filter(|one| inner(one, value, at).is_none()).count() {
            1 => None,
            count => wrong(format!("{value} fits {count} of the alternatives, not one")),
        },
        "properties" => {
            let known = told.as_object().expect("an object of schemas");
            let here = value.as_object()?;
            known.iter().find_map(|(name, schema)| inner(schema, here.get(name)?, &format!("{at}/{name}")))
        }
        "required" => {
            let here = value.as_object()?;
            let missing = list().iter().find(|name| !here.contains_key(name.as_str().expect("a name")))?;
            wrong(format!("{missing} is missing"))
        }
        "additionalProperties" => {
            let known = keywords.get("properties").and_then(Value::as_object);
            let others =
                value.as_object()?.iter().filter(|(name, _)| known.is_none_or(|known| !known.contains_key(*name)));
            others.into_iter().find_map(|(name, value)| inner(told, value, &format!("{at}/{name}")))
        }
        "prefixItems" => {
            let pairs = list().iter().zip(value.as_array()?).enumerate();
            pairs.into_iter().find_map(|(index, (schema, value))| inner(schema, value, &format!("{at}/{index}")))
        }
        "items" => {
            let before = keywords.get("prefixItems").and_then(Value::as_array).map_or(0, Vec::len);
            let rest = value.as_array()?.iter().enumerate().skip(before);
            rest.into_iter().find_map(|(index, value)| inner(told, value, &format!("{at}/{index}")))
        }
        "minItems" => {
            if value.as_array()?.len() >= count() {
                None
            } else {
                wrong(format!("fewer than {told} items"))
            }
        }
        "maxItems" => {
            if value.as_array()?.len() <= count() {
                None
            } else {
                wrong(format!("more than {told} items"))
            }
        }
        "minimum" => {
            if value.as_f64()? >= told.as_f64().expect("a number") {
                None
            } else {
                wrong(format!("{value} is below {told}"))
            }
        }
        "maximum" => {
            if value.as_f64()? <= told.as_f64().expect("a number") {
                None
            } else {
                wrong(format!("{value} is above {told}"))
            }
        }
        unknown => panic!("the keyword `{unknown}` is not known here"),
    }
}

fn is_of(name: &str, value: &Value) -> bool {
    match name {
        "null" => value.is_null(),
        "boolean" => value.is_boolean(),
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "number" => value.is_number(),
        "integer" => value.as_f64().is_some_and(|number| number.fract() == 0.0),
        unknown => panic!("`{unknown}` is no type"),
    }
}
