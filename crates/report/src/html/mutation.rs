//! The page of a mutation analysis: the score, the survivors as differences, the texts with marks, who killed what.
//!
//! It needs no script. INVARIANT: what is not known is shown as such, and never counted as killed.

use std::collections::BTreeMap;

use crate::html::figures::figure;
use crate::html::{open, section};
use crate::markup::{Text, put};
use crate::mutation::{Fate, JudgedMutant, MutatedFile, MutationAnalysis};
use crate::time::count;

/// LIMIT: lines of a change that are shown on each side.
const LINES: usize = 12;

/// A mutation analysis as a page.
///
/// ```
/// let page = report::render_mutation(&report::MutationAnalysis { title: "Light.asm".to_string(), ..Default::default() });
/// assert!(page.starts_with("<!DOCTYPE html>") && page.contains("Light.asm"));
/// ```
pub fn render_mutation(analysis: &MutationAnalysis) -> String {
    let mut out = String::new();
    open(&mut out, &format!("Mutants of {}", analysis.title), include_str!("mutation.css"));
    header(&mut out, analysis);
    out.push_str("<main>\n");
    survivors(&mut out, analysis);
    unsettled(&mut out, analysis);
    texts(&mut out, analysis);
    judges(&mut out, analysis);
    operators(&mut out, analysis);
    out.push_str(
        "</main>\n<footer>Written by Groundstate. This page is complete: it loads nothing.</footer>\n</body>\n</html>\n",
    );
    out
}

fn header(out: &mut String, analysis: &MutationAnalysis) {
    put!(
        out,
        "<header>\n<p class=\"eyebrow\">Mutation analysis</p>\n<h1>{}</h1>\n<p class=\"note\">Each mutant is the model with one small fault. A property or a scenario that notices the fault kills it; what survives is a fault that nobody would notice.</p>\n",
        Text(&analysis.title)
    );
    let survived = analysis.count(|fate| *fate == Fate::Survived);
    let left = analysis.count(|fate| matches!(fate, Fate::Unknown | Fate::NotJudged | Fate::Refused));
    let (class, mark, sentence) = match (analysis.mutants.len(), survived, left) {
        (0, ..) => ("unknown", '?', "There was nothing to mutate.".to_string()),
        (_, 0, 0) => ("good", '\u{2713}', "No mutant survived.".to_string()),
        (_, 0, _) => ("unknown", '?', format!("Nothing survived; of {} it is not known.", plural(left, "mutant"))),
        _ => ("bad", '\u{2717}', format!("{} survived.", plural(survived, "mutant"))),
    };
    put!(
        out,
        "<div class=\"verdict {class}\"><p><span class=\"mark\" aria-hidden=\"true\">{mark}</span>{sentence}</p></div>\n"
    );
    out.push_str("<dl class=\"figures\">\n");
    let interval = match analysis.interval {
        Some((low, high)) => format!("of all between {low:.1} % and {high:.1} %"),
        None => "of those killed or survived".to_string(),
    };
    let score = analysis.score.map_or("\u{2013}".to_string(), |score| format!("{score:.1} %"));
    figure(out, "Score", &score, &interval, survived > 0);
    let drawn = analysis.mutants.len();
    let of = if drawn < analysis.total {
        format!("a sample of {}", count(analysis.total as u64))
    } else {
        "all".to_string()
    };
    figure(out, "Mutants", &count(drawn as u64), &of, false);
    let killed = analysis.count(|fate| matches!(fate, Fate::Killed(_)));
    let (models, scenarios) = (plural(analysis.models.len(), "model"), plural(analysis.scenarios.len(), "scenario"));
    let by = match &analysis.couplings {
        None => format!("by {models} and {scenarios}"),
        Some(couplings) => format!("by {models}, {scenarios} and {}", plural(couplings.len(), "refinement")),
    };
    figure(out, "Killed", &count(killed as u64), &by, false);
    figure(out, "Survived", &count(survived as u64), "nobody notices them", survived > 0);
    let equivalent = analysis.count(|fate| *fate == Fate::Equivalent);
    figure(out, "Equivalent", &count(equivalent as u64), "proved: they make no difference", false);
    if left > 0 {
        figure(out, "Not known", &count(left as u64), "see below", false);
    }
    out.push_str("</dl>\n</header>\n");
}

fn survivors(out: &mut String, analysis: &MutationAnalysis) {
    let survived: Vec<&JudgedMutant> = analysis.mutants.iter().filter(|mutant| mutant.fate == Fate::Survived).collect();
    if survived.is_empty() {
        return;
    }
    section(
        out,
        "survivors",
        "Survivors",
        "The most surprising first. Read each as a question: does it matter? Then a property or a scenario is missing.",
    );
    survived.iter().for_each(|mutant| difference(out, analysis, mutant));
    out.push_str("</section>\n");
}

fn unsettled(out: &mut String, analysis: &MutationAnalysis) {
    let left = |fate: &Fate| matches!(fate, Fate::Unknown | Fate::Refused | Fate::NotJudged);
    if analysis.count(left) == 0 {
        return;
    }
    section(out, "unknown", "Not known", "They count neither as killed nor as survived.");
    for mutant in analysis.mutants.iter().filter(|mutant| left(&mutant.fate)) {
        difference(out, analysis, mutant);
    }
    out.push_str("</section>\n");
}

/// A mutant with what it changes.
fn difference(out: &mut String, analysis: &MutationAnalysis, mutant: &JudgedMutant) {
    let path = &analysis.files[mutant.file].path;
    put!(
        out,
        "<article class=\"mutant\"><h3><a href=\"#{}\">{}:{}:{}</a> <span title=\"{}\">{}</span></h3>\n<p class=\"remark\">{}</p>\n<pre class=\"change\">",
        anchor(mutant.file, mutant.lines.0),
        Text(path),
        mutant.lines.0,
        mutant.column,
        Text(&mutant.meaning),
        Text(&mutant.operator),
        Text(&mutant.remark)
    );
    for (sign, tag, lines) in [('\u{2212}', "del", &mutant.before), ('+', "ins", &mutant.after)] {
        for line in lines.iter().take(LINES) {
            put!(out, "<{tag}>{sign} {}</{tag}>\n", Text(spaced(line)));
        }
        if lines.len() > LINES {
            put!(out, "<span>{sign} and {} more</span>\n", plural(lines.len() - LINES, "line"));
        }
    }
    out.push_str("</pre></article>\n");
}

fn spaced(line: &str) -> String {
    line.replace('\t', "    ")
}

fn anchor(file: usize, line: usize) -> String {
    format!("f{file}l{line}")
}

fn texts(out: &mut String, analysis: &MutationAnalysis) {
    for (index, file) in analysis.files.iter().enumerate() {
        let own: Vec<&JudgedMutant> = analysis.mutants.iter().filter(|mutant| mutant.file == index).collect();
        if !own.is_empty() {
            text(out, (index, file), &own);
        }
    }
}

/// A text with a mark at each line where mutants begin.
fn text(out: &mut String, (index, file): (usize, &MutatedFile), own: &[&JudgedMutant]) {
    let survived = own.iter().filter(|mutant| mutant.fate == Fate::Survived).count();
    let lead = format!(
        "{} begin here, {survived} survived. A mark counts those of its line; what became of each is said where it is pointed at.",
        plural(own.len(), "mutant")
    );
    section(out, &format!("file{index}"), &file.path, &lead);
    let mut at: BTreeMap<usize, Vec<&JudgedMutant>> = BTreeMap::new();
    own.iter().for_each(|mutant| at.entry(mutant.lines.0).or_default().push(mutant));
    out.push_str("<div class=\"wide\"><table class=\"source\"><tbody>\n");
    for (number, line) in (1..).zip(file.text.lines()) {
        let (class, mark, told) = match at.get(&number) {
            None => ("", String::new(), String::new()),
            Some(mutants) => marked(mutants),
        };
        put!(
            out,
            "<tr id=\"{}\"{class}><th scope=\"row\">{number}</th><td class=\"sum\" title=\"{}\">{mark}</td><td><code>{}</code></td></tr>\n",
            anchor(index, number),
            Text(told),
            Text(spaced(line))
        );
    }
    out.push_str("</tbody></table></div>\n</section>\n");
}

/// How a line with mutants is drawn: its class, its mark, what is said of it.
fn marked(mutants: &[&JudgedMutant]) -> (&'static str, String, String) {
    let of = |is: &dyn Fn(&Fate) -> bool| mutants.iter().filter(|mutant| is(&mutant.fate)).count();
    let killed = of(&|fate| matches!(fate, Fate::Killed(_)));
    let survived = of(&|fate| *fate == Fate::Survived);
    let left = of(&|fate| matches!(fate, Fate::Unknown | Fate::Refused | Fate::NotJudged));
    let told: Vec<String> = mutants.iter().map(|mutant| format!("{}: {}", mutant.operator, said(mutant))).collect();
    let class = match (survived, left, killed) {
        (1.., ..) => " class=\"lives\"",
        (_, 1.., _) => " class=\"open\"",
        (.., 1..) => " class=\"dies\"",
        _ => " class=\"same\"",
    };
    let sign = match (survived, left, killed) {
        (1.., ..) => '\u{2717}',
        (_, 1.., _) => '?',
        (.., 1..) => '\u{2713}',
        _ => '=',
    };
    let noticed = mutants.len() - of(&|fate| *fate == Fate::Equivalent);
    let mark = if noticed == 0 { sign.to_string() } else { format!("{sign}\u{a0}{killed}/{noticed}") };
    (class, mark, told.join("\n"))
}

/// What became of a mutant, in words.
fn said(mutant: &JudgedMutant) -> String {
    match &mutant.fate {
        Fate::Killed(by) => format!("killed by {by}"),
        Fate::Survived => format!("survived, {}", mutant.remark),
        Fate::Equivalent => format!("equivalent, {}", mutant.remark),
        Fate::Unknown => format!("not known, {}", mutant.remark),
        Fate::Refused => format!("refused, {}", mutant.remark),
        Fate::NotJudged => "not judged".to_string(),
    }
}

/// Who killed how many: a check that kills none says little.
fn judges(out: &mut String, analysis: &MutationAnalysis) {
    let mut by: BTreeMap<&str, usize> = BTreeMap::new();
    for mutant in &analysis.mutants {
        if let Fate::Killed(name) = &mutant.fate {
            *by.entry(name).or_default() += 1;
        }
    }
    if by.is_empty() {
        return;
    }
    section(
        out,
        "judges",
        "Who killed",
        "The first check that noticed a mutant is the one that counts; another may have noticed it later.",
    );
    out.push_str("<div class=\"wide\"><table>\n<thead><tr><th scope=\"col\">Check</th><th scope=\"col\">Mutants</th></tr></thead>\n<tbody>\n");
    let mut rows: Vec<(&str, usize)> = by.into_iter().collect();
    rows.sort_by_key(|(name, killed)| (usize::MAX - killed, *name));
    for (name, killed) in rows {
        put!(out, "<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", Text(name), count(killed as u64));
    }
    out.push_str("</tbody></table></div>\n</section>\n");
}

fn operators(out: &mut String, analysis: &MutationAnalysis) {
    let mut by: BTreeMap<&str, (&str, [usize; 4])> = BTreeMap::new();
    for mutant in &analysis.mutants {
        let row = &mut by.entry(&mutant.operator).or_insert((&mutant.meaning, [0; 4])).1;
        row[match mutant.fate {
            Fate::Killed(_) => 0,
            Fate::Survived => 1,
            Fate::Equivalent => 2,
            Fate::Unknown | Fate::Refused | Fate::NotJudged => 3,
        }] += 1;
    }
    if by.is_empty() {
        return;
    }
    section(out, "operators", "By kind of fault", "");
    out.push_str("<div class=\"wide\"><table>\n<thead><tr><th scope=\"col\">Operator</th><th scope=\"col\">Killed</th><th scope=\"col\">Survived</th><th scope=\"col\">Equivalent</th><th scope=\"col\">Not known</th></tr></thead>\n<tbody>\n");
    for (operator, (meaning, counts)) in by {
        put!(out, "<tr><th scope=\"row\">{}<small>{}</small></th>", Text(operator), Text(meaning));
        for (index, counted) in counts.into_iter().enumerate() {
            let class = if index == 1 && counted > 0 { " class=\"bad\"" } else { "" };
            put!(out, "<td{class}>{}</td>", count(counted as u64));
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</tbody></table></div>\n</section>\n");
}

fn plural(number: usize, word: &str) -> String {
    format!("{} {word}{}", count(number as u64), if number == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mutant(line: usize, fate: Fate) -> JudgedMutant {
        JudgedMutant {
            file: 0,
            lines: (line, line),
            column: 3,
            operator: "guard-true".to_string(),
            meaning: "a guard becomes `true`".to_string(),
            fate,
            remark: "as many states, other steps".to_string(),
            before: vec!["\tif a < b then".to_string()],
            after: vec!["\tif true then".to_string()],
        }
    }

    fn page(mutants: Vec<JudgedMutant>) -> String {
        let file = MutatedFile { path: "A.asm".to_string(), text: "asm A\n\tif a < b then\n\tskip\n".to_string() };
        render_mutation(&MutationAnalysis {
            title: "A.asm".to_string(),
            total: mutants.len(),
            files: vec![file],
            mutants,
            ..MutationAnalysis::default()
        })
    }

    #[test]
    fn a_line_says_the_worst_that_happened_on_it() {
        let killed = || mutant(2, Fate::Killed("inv_<a>".to_string()));
        let page_of = |fates: Vec<JudgedMutant>| page(fates);
        let both = page_of(vec![killed(), mutant(2, Fate::Survived)]);
        assert!(both.contains("<tr id=\"f0l2\" class=\"lives\">") && both.contains("\u{2717}\u{a0}1/2"), "{both}");
        assert!(both.contains("killed by inv_&lt;a&gt;") && both.contains("<del>\u{2212}     if a &lt; b then</del>"));
        let open = page_of(vec![killed(), mutant(2, Fate::Unknown)]);
        assert!(open.contains("class=\"open\"") && open.contains("Nothing survived; of 1 mutant it is not known."));
        let good = page_of(vec![killed(), mutant(3, Fate::Equivalent)]);
        assert!(good.contains("class=\"dies\"") && good.contains("class=\"same\"") && good.contains("verdict good"));
    }
}
