//! Which shapes of a chart places of its model speak of: `groundstate/chart/places` (docs/editors.md).
//!
//! In: the chart, the model, and places in it; without places, all that may speak of shapes. Out: what `ide` says of them.

use groundstate::Kind;
use ide::Spoken;
use lsp_types::Position;
use serde_json::{Value, json};

use crate::answer::Answers;
use crate::location::path_of;
use crate::route::Refused;

/// LIMIT: places of a model that are looked at.
const PLACES: usize = 4_000;

/// What places of a model speak of.
///
/// # Errors
/// There is no such chart or model; a sentence.
pub fn places(answers: &mut Answers, chart: &str, params: &Value) -> Result<Value, Refused> {
    let model = params["model"].as_str().and_then(|uri| path_of(&uri.parse().ok()?));
    let model = model.filter(|path| Kind::of(std::path::Path::new(path)) == Some(Kind::Model));
    let model = model.ok_or_else(|| Refused::failed("`model` is a model".to_string()))?;
    let analysis = answers.project.analysis(&model).map_err(|absent| Refused::failed(absent.told(&model)))?;
    let parse = analysis.parse().ok_or_else(|| Refused::failed(format!("{model} cannot be read")))?;
    let offsets: Vec<u32> = match params["positions"].as_array() {
        Some(positions) => {
            let positions = positions.iter().filter_map(|one| serde_json::from_value::<Position>(one.clone()).ok());
            positions.take(PLACES).map(|position| answers.offset(&model, position)).collect()
        }
        None => Some(ide::speaking(parse)).filter(|all| all.len() <= PLACES).unwrap_or_default(),
    };
    let loaded = answers.project.chart(chart).map_err(Refused::failed)?;
    let spoken = ide::spoken(parse, &loaded.chart, &offsets);
    let told = |(offset, shapes): (&u32, &Option<Spoken>)| {
        let shapes = shapes.as_ref().map(|one| {
            json!({ "drawing": one.drawing, "state": one.state, "guard": one.guard, "action": one.action, "rule": one.rule })
        });
        json!({ "position": answers.position(&model, *offset), "shapes": shapes })
    };
    Ok(offsets.iter().zip(&spoken).map(told).collect())
}
