//! When tasks start that await several channels: in random runs on one processor, no cycle takes longer than its analysed response, and no
//! task starts more often than the analysis of the tasks behind it allows.

use chart::times::{Order, Platform, Times, times};
use syntax::SourceFile;
use testkit::{Patterns, Random};

/// A number between two, both of them possible.
fn between(random: &mut Random, least: u64, most: u64) -> u64 {
    least + random.below(most - least + 1)
}

/// What starts a task.
#[derive(Debug, Clone)]
enum Start {
    Every { period: u64, jitter: u64 },
    All(Vec<usize>),
    Any(Vec<usize>),
}

/// A task of the drawn system: the more urgent ones come first.
#[derive(Debug, Clone)]
struct Task {
    start: Start,
    elaborates: u64,
    /// The tasks that read what it writes.
    readers: Vec<usize>,
}

impl Task {
    fn awaits(&self) -> &[usize] {
        match &self.start {
            Start::Every { .. } => &[],
            Start::All(writers) | Start::Any(writers) => writers,
        }
    }

    /// Each reading and each writing takes a tick.
    fn execution(&self) -> u64 {
        self.awaits().len() as u64 + self.elaborates + self.readers.len() as u64
    }
}

/// Periodic tasks, one that awaits several of them, and others behind it.
fn drawn(numbers: &mut Random) -> Vec<Task> {
    let writers = between(numbers, 2, 3) as usize;
    // Periods that differ by little drift through all their phases; what one of them leaves behind then shows in a long cycle.
    let drift = between(numbers, 0, 2) == 0;
    let (least, most) = if drift { (19, 22) } else { (10, 40) };
    let mut periods: Vec<u64> = (0..writers).map(|_| between(numbers, least, most)).collect();
    periods.sort_unstable();
    let jitter = |numbers: &mut Random| if between(numbers, 0, 2) == 0 { between(numbers, 1, 4) } else { 0 };
    let periodic = |period| (period, jitter(numbers));
    let starts = periods.into_iter().map(periodic).collect::<Vec<_>>();
    let mut tasks: Vec<Task> = starts
        .into_iter()
        .map(|(period, jitter)| Task { start: Start::Every { period, jitter }, elaborates: 1, readers: Vec::new() })
        .collect();
    for index in writers..writers + between(numbers, 1, 3) as usize {
        let mut awaits: Vec<usize> = (0..index).filter(|_| between(numbers, 0, 1) == 0).collect();
        if awaits.is_empty() {
            awaits.push(index - 1);
        }
        for writer in &awaits {
            tasks[*writer].readers.push(index);
        }
        let start = if between(numbers, 0, 1) == 0 { Start::All(awaits) } else { Start::Any(awaits) };
        tasks.push(Task { start, elaborates: between(numbers, 1, 3), readers: Vec::new() });
    }
    if drift && let Some(last) = tasks.last_mut() {
        last.elaborates = between(numbers, 100, 200);
    }
    tasks
}

fn chart(tasks: &[Task]) -> String {
    let mut text = "chart Starts\nimport patterns/ControlTask\nsystem starts\n\tprocessors 1\n".to_string();
    for (index, task) in tasks.iter().enumerate() {
        let names: Vec<String> = task.awaits().iter().map(|writer| format!("c{writer}_{index}")).collect();
        let kind = match (&task.start, names.len()) {
            (Start::Every { period, jitter: 0 }, _) => format!("synchronous period {period} ms"),
            (Start::Every { period, jitter }, _) => format!("synchronous period {period} ms jitter {jitter} ms"),
            (_, 1) => format!("asynchronous awaits {}", names[0]),
            (Start::All(_), _) => format!("asynchronous awaits all {}", names.join(", ")),
            (Start::Any(_), _) => format!("asynchronous awaits any {}", names.join(", ")),
        };
        text += &format!("\tcomponent t{index} {kind}\n");
        names.iter().for_each(|name| text += &format!("\t\tread {name} 1 ms\n"));
        text += &format!("\t\telaborate e{index} {} ms\n", task.elaborates);
        task.readers.iter().for_each(|reader| text += &format!("\t\twrite c{index}_{reader} 1 ms\n"));
        text += "\tendcomponent\n";
    }
    for (index, task) in tasks.iter().enumerate() {
        for reader in &task.readers {
            text += &format!("\tchannel c{index}_{reader} from t{index} to t{reader} shared value\n");
        }
    }
    text + "endsystem\n"
}

fn analysed(text: &str) -> Times {
    let chart = chart::load(SourceFile::new("Starts.chart", text), &mut Patterns).chart;
    let system = chart.system.unwrap_or_else(|| panic!("it has a system\n{text}"));
    times(&system, Platform { processors: 1, order: Order::Rate })
}

/// The longest time of a cycle of each task from when it could begin, and how many cycles began.
fn simulated(tasks: &[Task], numbers: &mut Random, ticks: u64) -> (Vec<u64>, Vec<u64>) {
    let count = tasks.len();
    let mut longest = vec![0; count];
    let mut starts = vec![0; count];
    // For each task: how much is left of its cycle, from when that counts, and which writers have something new for it.
    let mut left = vec![0_u64; count];
    let mut since: Vec<Option<u64>> = vec![None; count];
    let mut new: Vec<Vec<usize>> = vec![Vec::new(); count];
    let mut release: Vec<Option<u64>> = vec![None; count];
    for now in 0..ticks {
        for (index, task) in tasks.iter().enumerate() {
            if let Start::Every { period, jitter } = task.start {
                if now % period == 0 {
                    // As late as it may, in time, or in between.
                    release[index] =
                        Some(now + [0, jitter, between(numbers, 0, jitter)][between(numbers, 0, 2) as usize]);
                }
                if release[index].is_some_and(|at| at <= now) && left[index] == 0 {
                    (left[index], since[index], release[index]) = (task.execution(), Some(now / period * period), None);
                    starts[index] += 1;
                }
                continue;
            }
            let comes = match &task.start {
                Start::All(writers) => writers.iter().all(|writer| new[index].contains(writer)),
                Start::Any(_) | Start::Every { .. } => !new[index].is_empty(),
            };
            if comes && left[index] == 0 && since[index].is_none() {
                (left[index], since[index]) = (task.execution(), Some(now));
                starts[index] += 1;
            }
        }
        let Some(runs) = (0..count).find(|index| left[*index] > 0) else { continue };
        if left[runs] == tasks[runs].execution() {
            // It takes what is there when it begins to execute.
            new[runs].clear();
        }
        left[runs] -= 1;
        if left[runs] == 0 {
            let begun = since[runs].take().expect("it is at work");
            longest[runs] = longest[runs].max(now + 1 - begun);
            for reader in &tasks[runs].readers {
                if !new[*reader].contains(&runs) {
                    new[*reader].push(runs);
                }
            }
        }
    }
    (longest, starts)
}

#[test]
fn no_cycle_takes_longer_than_analysed() {
    let mut numbers = Random(0x9e37_79b9_7f4a_7c15);
    let (mut bounded, mut gathers, mut tight) = (0, 0, 0);
    let rounds = if testkit::sample::is_full() { 3_000 } else { 300 };
    for _ in 0..rounds {
        let tasks = drawn(&mut numbers);
        let text = chart(&tasks);
        let analysed = analysed(&text);
        let ticks = 4_000;
        let (longest, starts) = simulated(&tasks, &mut numbers, ticks);
        // What holds of a task is said while the ones before it keep theirs.
        let synchronous = tasks.iter().filter(|task| task.awaits().is_empty()).count();
        if analysed.tasks[..synchronous].iter().any(|task| task.response.is_none()) {
            continue;
        }
        for (index, task) in tasks.iter().enumerate() {
            let Some(response) = analysed.tasks[index].response else { continue };
            assert!(longest[index] <= response, "t{index}: {} of {response}\n{text}", longest[index]);
            let Some(interval) = analysed.tasks[index].interval else { panic!("t{index} has no interval\n{text}") };
            // In the long run: rounded down, and with what the jitters of a chain allow.
            let most = ticks as f64 / (interval as f64) + 40.0;
            assert!(starts[index] as f64 <= most, "t{index}: {} of {most}\n{text}", starts[index]);
            bounded += 1;
            gathers += usize::from(task.awaits().len() > 1);
            tight += usize::from(longest[index] == response);
        }
    }
    assert!(bounded > rounds && gathers > rounds / 8 && tight > rounds / 2, "{bounded} {gathers} {tight}");
}
