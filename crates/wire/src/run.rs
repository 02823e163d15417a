//! Reads the JSON of a run (spec/run.md): what a controller did to its world.
//!
//! In: the bytes of the file, and a function that reads the pictures it names. Out: [`RunTold`]. What the file lacks is
//! not shown. Columns that belong together end with the shortest one.

use ::report::{ClosedLoop, Joint, Tally, View};
use serde::Deserialize;

/// The file.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct RunFile {
    title: Option<String>,
    note: Option<String>,
    time: String,
    image: [f64; 2],
    converged_below: Option<f64>,
    goals: Vec<Goal>,
    /// The path of the recording, relative to this file's folder.
    pub log: Option<String>,
    views: Vec<Picture>,
    servoing: Images,
    robot: Motions,
    motor: Ages,
    verdict: Option<Ending>,
}

#[derive(Debug, Deserialize)]
struct Goal {
    at_s: f64,
}

#[derive(Debug, Deserialize)]
struct Picture {
    file: String,
    t_s: f64,
    target: u64,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Images {
    t_s: Vec<f64>,
    image_age_ms: Vec<Option<f64>>,
    error: Vec<Option<f64>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Motions {
    t_s: Vec<f64>,
    image_age_ms: Vec<Option<f64>>,
    set_point_rad: Vec<Vec<f64>>,
    measured_rad: Vec<Vec<f64>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Ages {
    image_age_ms: Vec<Option<f64>>,
}

#[derive(Debug, Deserialize)]
struct Ending {
    good: bool,
    words: String,
}

/// What the page shows of the file.
#[derive(Debug, Default)]
pub struct RunTold {
    /// The title.
    pub title: Option<String>,
    /// A sentence or two below the title.
    pub note: Option<String>,
    /// What was controlled.
    pub closed_loop: Option<ClosedLoop>,
}

/// A picture that cannot be shown.
#[derive(Debug)]
pub enum Unseen<X> {
    /// It cannot be read.
    Unread(X),
    /// The file of this name is not a PNG.
    NoPng(String),
}

impl RunFile {
    /// Reads the file's bytes.
    ///
    /// # Errors
    /// They are not the JSON of a run; a sentence.
    pub fn read(bytes: &[u8]) -> Result<RunFile, String> {
        serde_json::from_slice(bytes).map_err(|error| error.to_string())
    }

    /// What the page shows. `read` reads the pictures that the file names.
    ///
    /// # Errors
    /// The first picture that cannot be shown.
    pub fn told<X>(self, read: &mut dyn FnMut(&str) -> Result<Vec<u8>, X>) -> Result<RunTold, Unseen<X>> {
        let Some(end) = &self.verdict else {
            return Ok(RunTold { title: self.title, note: self.note, closed_loop: None });
        };
        // How a run in real time ends depends on the machine's load, so a bad end is shown but not judged.
        let reached = (end.good || self.time != "real").then_some(end.good);
        let image_ages = [
            ("visual servoing", &self.servoing.image_age_ms),
            ("robot controller", &self.robot.image_age_ms),
            ("motors", &self.motor.image_age_ms),
        ];
        let known = image_ages.into_iter().map(|(name, ages)| (name.to_string(), tally(ages)));
        let closed_loop = ClosedLoop {
            end: end.words.clone(),
            reached,
            image: (self.image[0], self.image[1]),
            goals_s: self.goals.iter().map(|goal| goal.at_s).collect(),
            bound: self.converged_below,
            error: self.servoing.t_s.iter().copied().zip(self.servoing.error.iter().copied()).collect(),
            views: self.views.iter().map(|picture| view(picture, read)).collect::<Result<_, _>>()?,
            joints: joints(&self.robot),
            image_ages: known.filter(|(_, tally)| !tally.is_empty()).collect(),
        };
        Ok(RunTold { title: self.title, note: self.note, closed_loop: Some(closed_loop) })
    }
}

fn tally(ages_ms: &[Option<f64>]) -> Tally {
    let mut tally = Tally::default();
    // The worst place is not shown, so all are 0.
    ages_ms.iter().flatten().for_each(|ms| tally.add((ms.max(0.0) * 1e6).round() as u64, 0));
    tally
}

fn view<X>(picture: &Picture, read: &mut dyn FnMut(&str) -> Result<Vec<u8>, X>) -> Result<View, Unseen<X>> {
    let png = read(&picture.file).map_err(Unseen::Unread)?;
    if !png.starts_with(b"\x89PNG\r\n\x1a\n") {
        return Err(Unseen::NoPng(picture.file.clone()));
    }
    Ok(View { png, caption: format!("after {:.2} s, on the way to goal {}", picture.t_s, picture.target) })
}

fn joints(motions: &Motions) -> Vec<Joint> {
    let count = motions.set_point_rad.iter().map(Vec::len).min().unwrap_or(0);
    let column = |of: &[Vec<f64>], at: usize| -> Vec<(f64, f64)> {
        motions.t_s.iter().zip(of).filter_map(|(time, row)| Some((*time, *row.get(at)?))).collect()
    };
    let joint = |at| Joint {
        name: format!("Joint {}", at + 1),
        set: column(&motions.set_point_rad, at),
        measured: column(&motions.measured_rad, at),
    };
    (0..count).map(joint).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_become_points() {
        let text = r#"{"time":"virtual","goals":[{"at_s":0},{"at_s":5}],"unheard-of":1,
            "servoing":{"t_s":[0.1,0.2],"error":[null,0.5],"image_age_ms":[12.5,null]},
            "robot":{"t_s":[0.1,0.2],"set_point_rad":[[1,2],[3,4]],"measured_rad":[[5,6],[7,8]]},
            "verdict":{"good":false,"words":"not converged"}}"#;
        let run: RunFile = serde_json::from_str(text).expect("a run");
        let told = run.told(&mut |name| Err(name.to_string())).expect("it is whole");
        let world = told.closed_loop.expect("a closed loop");
        assert_eq!((world.reached, world.goals_s.as_slice()), (Some(false), [0.0, 5.0].as_slice()));
        assert_eq!(world.error, [(0.1, None), (0.2, Some(0.5))]);
        assert_eq!(
            (world.joints[1].set.as_slice(), world.joints[0].measured[1]),
            ([(0.1, 2.0), (0.2, 4.0)].as_slice(), (0.2, 7.0))
        );
        assert_eq!((world.image_ages.len(), world.image_ages[0].1.greatest()), (1, Some((12_500_000, 0))));
    }

    #[test]
    fn a_run_in_real_time_is_not_judged_by_where_it_came() {
        let run: RunFile =
            serde_json::from_str(r#"{"time":"real","verdict":{"good":false,"words":"w"}}"#).expect("a run");
        let told = run.told(&mut |name| Err(name.to_string())).expect("it is whole");
        assert_eq!(told.closed_loop.and_then(|world| world.reached), None);
    }
}
