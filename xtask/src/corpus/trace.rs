//! A recorded trace of the peer: text → states, inputs and the end.
//!
//! In: the text of one file of the recorded traces. Out: a [`Trace`] whose locations and values are still text, in
//! the peer's way of writing; [`super::text`] gives ours in the same way. It knows neither program nor machine.

use crate::Failure;

/// Locations with their values, both as text.
pub type Listing = Vec<(String, String)>;

/// One recorded run.
#[derive(Debug, Default)]
pub struct Trace {
    /// The model, relative to the checkout.
    pub path: String,
    /// The initial state.
    pub initial: Listing,
    /// The steps, the last one perhaps not made.
    pub steps: Vec<Step>,
    /// How it ended; none where it ran out of time.
    pub end: Option<End>,
}

/// One recorded step.
#[derive(Debug, Default)]
pub struct Step {
    /// What was asked of the environment, in order; a location may appear again.
    pub inputs: Listing,
    /// Readings of the clock.
    pub times: Listing,
    /// The state after it; none where the step was not made.
    pub after: Option<Listing>,
}

/// How a recorded run ended.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct End {
    /// `OK`, `EXC`, `CLASH`, `INVARIANT`.
    pub status: String,
    /// The class of the exception, or the invariant's name.
    pub class: String,
    /// What the peer said.
    pub message: String,
}

impl Trace {
    /// Takes elements out of the listed contents of their domains; tells whether there were any.
    pub fn forget_elements(&mut self, elements: &[(String, String)]) -> bool {
        let mut any = false;
        let after = self.steps.iter_mut().filter_map(|step| step.after.as_mut());
        for (location, value) in after.chain([&mut self.initial]).flatten() {
            for (_, element) in elements.iter().filter(|(domain, _)| domain == location) {
                let Some(inner) = value.strip_prefix('{').and_then(|rest| rest.strip_suffix('}')) else { continue };
                let kept: Vec<&str> = inner.split(',').filter(|listed| listed != element).collect();
                let shorter = format!("{{{}}}", kept.join(","));
                any |= shorter != *value;
                *value = shorter;
            }
        }
        any
    }
}

/// Reads a trace.
///
/// # Errors
/// A line of no known form.
pub fn read(text: &str) -> Result<Trace, Failure> {
    let mut trace = Trace::default();
    let mut listing: Option<Listing> = None;
    let mut begun = false;
    for line in text.lines() {
        if let Some(rest) = line.strip_prefix("# ") {
            if trace.path.is_empty() {
                trace.path = rest.to_string();
            }
        } else if line.starts_with("STATE ") {
            listing = Some(Listing::new());
        } else if line.starts_with("STEP ") {
            close(&mut trace, &mut begun, listing.take());
            trace.steps.push(Step::default());
        } else if let Some(rest) = line.strip_prefix("END ") {
            close(&mut trace, &mut begun, listing.take());
            let mut words = rest.splitn(3, ' ');
            let mut word = || words.next().unwrap_or_default().to_string();
            trace.end = Some(End { status: word(), class: word(), message: word() });
        } else if let (Some(rest), Some(step)) = (line.strip_prefix("MON "), trace.steps.last_mut()) {
            step.inputs.push(assignment(rest)?);
        } else if let (Some(rest), Some(step)) = (line.strip_prefix("TIME "), trace.steps.last_mut()) {
            step.times.push(assignment(rest)?);
        } else if let Some(listing) = &mut listing {
            listing.push(assignment(line)?);
        } else {
            return Err(format!("a line that is no part of a trace: {line}"));
        }
    }
    close(&mut trace, &mut begun, listing);
    Ok(trace)
}

fn close(trace: &mut Trace, begun: &mut bool, listing: Option<Listing>) {
    let Some(listing) = listing else { return };
    if !std::mem::replace(begun, true) {
        trace.initial = listing;
    } else if let Some(step) = trace.steps.last_mut() {
        step.after = Some(listing);
    }
}

fn assignment(line: &str) -> Result<(String, String), Failure> {
    let (location, value) = line.split_once('=').ok_or_else(|| format!("no value in the line: {line}"))?;
    Ok((location.to_string(), value.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_are_forgotten() {
        let mut trace = read("# a/B.asm\nSTATE 0\nAgent={a,self}\nx={self}\n").unwrap();
        assert!(trace.forget_elements(&[("Agent".to_string(), "self".to_string())]));
        let texts: Vec<&str> = trace.initial.iter().map(|(_, value)| value.as_str()).collect();
        assert_eq!(texts, ["{a}", "{self}"]);
        assert!(!trace.forget_elements(&[("Agent".to_string(), "self".to_string())]));
    }

    #[test]
    fn a_trace_is_taken_apart() {
        let text = "# a/B.asm\n# kind=mon\nSTATE 0\nx=1\nSTEP 1\nMON m(1)=a\nSTATE 1\nx=2\nSTEP 2\nEND CLASH C x = 3\n";
        let trace = read(text).unwrap();
        assert_eq!(trace.path, "a/B.asm");
        assert_eq!(trace.initial, [("x".to_string(), "1".to_string())]);
        assert_eq!(trace.steps[0].inputs, [("m(1)".to_string(), "a".to_string())]);
        assert_eq!(trace.steps[0].after.as_ref().map(Vec::len), Some(1));
        assert!(trace.steps[1].after.is_none());
        let end = trace.end.unwrap();
        assert_eq!((end.status.as_str(), end.class.as_str(), end.message.as_str()), ("CLASH", "C", "x = 3"));
    }
}
