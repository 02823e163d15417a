//! Each keyword of the validator lets what is valid pass and refuses what is not.

use serde_json::json;
use testkit::schema::departure;

#[test]
fn each_keyword_refuses_what_it_is_for() {
    let whole = json!({"type": "object", "properties": {"a": {"type": "integer"}}, "required": ["a"], "additionalProperties": false});
    let pair = json!({"prefixItems": [{"const": 1}, {"type": "string"}], "minItems": 2, "maxItems": 2});
    let named = json!({"$defs": {"small": {"minimum": 0, "maximum": 9}}, "items": {"$ref": "#/$defs/small"}});
    for (schema, valid, wrong) in [
        (json!({"type": "string"}), json!("x"), json!(1)),
        (json!({"type": ["null", "boolean"]}), json!(null), json!("null")),
        (json!({"type": "integer"}), json!(2.0), json!(2.5)),
        (json!({"const": "run"}), json!("run"), json!("ran")),
        (json!({"enum": ["a", "b"]}), json!("b"), json!("c")),
        (json!({"anyOf": [{"type": "null"}, {"type": "number"}]}), json!(0.5), json!("0.5")),
        (json!({"oneOf": [{"type": "integer"}, {"type": "number"}]}), json!(0.5), json!(5)),
        (whole.clone(), json!({"a": 1}), json!({"a": "1"})),
        (whole.clone(), json!({"a": 1}), json!({})),
        (whole, json!({"a": 1}), json!({"a": 1, "b": 1})),
        (pair.clone(), json!([1, "x"]), json!([1, 1])),
        (pair.clone(), json!([1, "x"]), json!([1])),
        (pair, json!([1, "x"]), json!([1, "x", "x"])),
        (named.clone(), json!([0, 9]), json!([0, 10])),
        (named, json!([]), json!([-1])),
        (json!({"items": false}), json!([]), json!([1])),
    ] {
        assert_eq!(departure(&schema, &valid), None, "{schema} and {valid}");
        assert!(departure(&schema, &wrong).is_some(), "{schema} lets {wrong} pass");
    }
}

#[test]
fn a_departure_is_told_with_its_place() {
    let schema = json!({"properties": {"steps": {"items": {"type": "integer"}}}});
    assert_eq!(
        departure(&schema, &json!({"steps": [1, "x"]})).as_deref(),
        Some("/steps/1: \"x\" is not of type \"integer\"")
    );
}

#[test]
#[should_panic(expected = "the keyword `pattern` is not known here")]
fn an_unknown_keyword_is_not_passed_over() {
    departure(&json!({"pattern": "a"}), &json!("a"));
}

#[test]
#[should_panic(expected = "leads nowhere")]
fn a_reference_that_leads_nowhere_is_not_passed_over() {
    departure(&json!({"$ref": "#/$defs/lost"}), &json!(1));
}
