"""Writes asmetal.xml, Kate's highlighting of models, scenarios and charts, from the words of the TextMate grammar.

In: ../vscode/syntaxes/asmetal.tmLanguage.json, the one place where the words are kept for editors. Out: asmetal.xml beside this
script; with --check, whether it is what would be written. Only the words come from there: the few other patterns are written here.
"""

import json
import re
import sys
from pathlib import Path
from xml.sax.saxutils import escape

HERE = Path(__file__).parent
GRAMMAR = HERE.parent / "vscode/syntaxes/asmetal.tmLanguage.json"

# The scope of the grammar's list, and how Kate shows it.
LISTS = [
    ("keyword.control.asmetal", "control", "dsControlFlow"),
    ("keyword.control.scenario.asmetal", "scenario", "dsControlFlow"),
    ("keyword.operator.word.asmetal", "operators", "dsOperator"),
    ("storage.modifier.asmetal", "kinds", "dsAttribute"),
    ("keyword.declaration.asmetal", "declaring", "dsKeyword"),
    ("keyword.declaration.chart.asmetal", "chart", "dsKeyword"),
    ("constant.language.asmetal", "constants", "dsConstant"),
    ("support.type.asmetal", "types", "dsBuiltIn"),
]


def words(pattern: str) -> list[str]:
    """The words of `\\b(a|b|c?)\\b`; one with an optional last letter is two."""
    found = re.fullmatch(r"\\b\(([\w|?]+)\)\\b(?:\(\?=.*\))?", pattern)
    if found is None:
        sys.exit(f"{pattern} is no list of words")
    listed = []
    for word in found[1].split("|"):
        listed += [word[:-2], word[:-1]] if word.endswith("?") else [word]
    return listed


def page() -> str:
    patterns = json.loads(GRAMMAR.read_text())["patterns"]
    # The first of a name that begins a file, such as `asm Name`, is a pattern with captures.
    lists = {one["name"]: words(one["match"]) for one in patterns if one.get("name") in dict((s, 0) for s, _, _ in LISTS)}
    heads = next(one["match"] for one in patterns if "captures" in one)
    lists["keyword.declaration.asmetal"] += re.search(r"\(([\w|]+)\)", heads)[1].split("|")
    imports = [one["match"] for one in patterns if "captures" in one][1]
    lists["keyword.declaration.asmetal"] += re.search(r"\(([\w|]+)\)", imports)[1].split("|")
    out = ['<?xml version="1.0" encoding="UTF-8"?>', "<!DOCTYPE language>", "<!-- Written by make.py. -->"]
    out.append(
        '<language name="AsmetaL" section="Sources" version="1" kateversion="5.62" '
        'extensions="*.asm;*.avalla;*.chart" priority="5" license="Apache-2.0" author="Groundstate">'
    )
    out.append("<highlighting>")
    seen: set[str] = set()
    for scope, name, _ in LISTS:
        out.append(f'<list name="{name}">')
        out += [f"<item>{escape(word)}</item>" for word in lists[scope] if not (word in seen or seen.add(word))]
        out.append("</list>")
    out.append('<contexts>\n<context name="text" attribute="Text" lineEndContext="#stay">')
    out.append('<DetectSpaces/>')
    out.append('<Detect2Chars attribute="Comment" context="line" char="/" char1="/"/>')
    out.append('<Detect2Chars attribute="Comment" context="block" char="/" char1="*" beginRegion="comment"/>')
    out.append('<DetectChar attribute="String" context="string" char="&quot;"/>')
    out.append("<RegExpr attribute=\"String\" context=\"#stay\" String=\"'(\\\\[^']+|[^'\\\\])'\"/>")
    out.append('<RegExpr attribute="Variable" context="#stay" String="\\$[A-Za-z_]\\w*"/>')
    for scope, name, _ in LISTS:
        out.append(f'<keyword attribute="{name}" context="#stay" String="{name}"/>')
    out.append('<RegExpr attribute="Number" context="#stay" String="\\b\\d+(\\.\\d+)?[in]?\\b"/>')
    out.append('<RegExpr attribute="Rule" context="#stay" String="\\br_\\w+"/>')
    out.append('<RegExpr attribute="Literal" context="#stay" String="\\b[A-Z]{2}[A-Z0-9_]*\\b"/>')
    out.append('<RegExpr attribute="Domain" context="#stay" String="\\b[A-Z]\\w*\\b"/>')
    out.append("<DetectIdentifier/>")
    out.append('<RegExpr attribute="Operator" context="#stay" String=":=|&lt;-|-&gt;|!=|&lt;=|&gt;=|[=&lt;&gt;+*/^-]"/>')
    out.append("</context>")
    out.append('<context name="line" attribute="Comment" lineEndContext="#pop"><IncludeRules context="##Comments"/></context>')
    out.append('<context name="block" attribute="Comment" lineEndContext="#stay">')
    out.append('<Detect2Chars attribute="Comment" context="#pop" char="*" char1="/" endRegion="comment"/>')
    out.append('<IncludeRules context="##Comments"/></context>')
    out.append('<context name="string" attribute="String" lineEndContext="#pop">')
    out.append('<RegExpr attribute="Escape" context="#stay" String="\\\\."/>')
    out.append('<DetectChar attribute="String" context="#pop" char="&quot;"/></context>')
    out.append("</contexts>\n<itemDatas>")
    styles = {name: style for _, name, style in LISTS}
    styles |= {
        "Text": "dsNormal", "Comment": "dsComment", "String": "dsString", "Escape": "dsSpecialChar", "Variable": "dsVariable",
        "Number": "dsDecVal", "Rule": "dsFunction", "Literal": "dsConstant", "Domain": "dsDataType", "Operator": "dsOperator",
    }
    out += [f'<itemData name="{name}" defStyleNum="{style}"/>' for name, style in styles.items()]
    out.append("</itemDatas>\n</highlighting>\n<general>\n<comments>")
    out.append('<comment name="singleLine" start="//"/>\n<comment name="multiLine" start="/*" end="*/" region="comment"/>')
    out.append('</comments>\n<keywords casesensitive="1"/>\n</general>\n</language>')
    return "\n".join(out) + "\n"


if __name__ == "__main__":
    target = HERE / "asmetal.xml"
    if "--check" in sys.argv:
        if target.read_text() != page():
            sys.exit("asmetal.xml is not what make.py writes: run `python3 editors/kate/make.py`")
    else:
        target.write_text(page())
