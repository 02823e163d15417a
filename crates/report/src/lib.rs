//! A validated run as one page: timeline, deadlines, waiting, age of data, scenarios, coverage.
//!
//! In: a [`Spec`] that says which terms of a model make which lane ([`read_specification`] reads one), their values
//! state by state ([`ReportBuilder`]), and data that a shell adds from elsewhere; or the recorded events of a program
//! ([`ProgramRun`]). Out: [`render_html`] and [`render_program`], a page in a single file that needs nothing else;
//! [`render_svg`], a still picture; [`summarise`] and [`summarise_program`], the same in short for a terminal. A mutation
//! analysis has a page, too ([`render_mutation`]), and so has a refinement check ([`render_refinement`]).
//!
//! It must not know what a task or a buffer of any model is called, how a model is executed, or a file; the same
//! report gives the same bytes.

mod builder;
mod flow;
mod html;
pub mod keys;
mod lanes;
mod legend;
mod levels;
mod markup;
mod mutation;
mod program;
mod refinement;
mod report;
mod spec;
mod specification;
mod svg;
mod tally;
mod text;
mod time;
mod tone;
mod track;

pub use builder::{ReportBuilder, SHOWN_TICKS};
pub use flow::{Flow, Journey};
pub use html::{
    LivePart, render_html, render_mutation, render_program, render_refinement, render_refinement_part, render_timeline,
};
pub use levels::Levels;
pub use mutation::{Fate, JudgedMutant, MutatedFile, MutationAnalysis};
pub use program::{ChannelAge, ClosedLoop, Held, Joint, Program, ProgramRun, TaskTiming, View};
pub use recording::{Bounded, Greatest};
pub use refinement::{Candidate, Diagram, Judgement, RefinementCheck};
pub use report::{
    Buffer, Chart, Coverage, Fact, Invariant, Lights, Measure, Queue, Report, Scenario, Series, Task, Verdict,
};
pub use spec::{
    ActivitySpec, BufferSpec, ChartSpec, CounterSpec, FlowSpec, HopSpec, LightsSpec, PartSpec, QueueSpec, SeriesSpec,
    Spec, TaskSpec, TermText,
};
pub use specification::{Specification, TermPlace, Wanted, WantedMachine, read_specification, specification_fault};
pub use svg::{SvgOptions, render_svg};
pub use tally::Tally;
pub use text::{RunSummary, SummaryOptions, summarise, summarise_program};
pub use time::{TimeBase, count};
pub use tone::Tone;
pub use track::{Curve, Kind, Segment, Span, Track};
