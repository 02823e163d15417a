//! `groundstate chart draw FILE`: draws the machines and the system of a chart as SVG, PNG or PDF.

use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use draw::{DrawFault, Drawing, Still};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::shell::Shell;

/// Arguments of `chart draw`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// A chart
    file: PathBuf,
    /// Draw only this machine or system
    #[arg(long, value_name = "NAME")]
    machine: Option<String>,
    /// A folder for the pictures, one for each machine; or a file .svg, .png or .pdf, if there is only one picture.
    /// Default: stdout
    #[arg(long, short, value_name = "PATH")]
    output: Option<PathBuf>,
    /// The format of the pictures. Default: by the file's ending, else svg
    #[arg(long = "as", value_enum, value_name = "FORM")]
    form: Option<Form>,
    /// Colours: by the reader's screen, or fixed. PNG and PDF are light unless `dark` is given
    #[arg(long, value_enum, default_value_t = Theme::Auto)]
    theme: Theme,
    /// Pixels of a PNG for each pixel of the picture
    #[arg(long, value_name = "N", default_value_t = 2.0, value_parser = scale)]
    scale: f32,
}

/// A picture format.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Form {
    /// A vector picture for browsers
    Svg,
    /// A pixel image
    Png,
    /// A page
    Pdf,
}

impl Form {
    const ALL: [Form; 3] = [Form::Svg, Form::Png, Form::Pdf];

    fn ending(self) -> &'static str {
        match self {
            Form::Svg => "svg",
            Form::Png => "png",
            Form::Pdf => "pdf",
        }
    }

    /// The format of a file by its name; `None` for a folder.
    fn of(path: &Path) -> Option<Form> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        Form::ALL.into_iter().find(|form| form.ending() == ending)
    }
}

/// Colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Theme {
    /// By the reader's screen
    Auto,
    /// Dark on light
    Light,
    /// Light on dark
    Dark,
}

fn scale(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(scale) if (0.1..=20.0).contains(&scale) => Ok(scale),
        _ => Err("a number from 0.1 to 20 is expected".to_string()),
    }
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let (_, chart) = match super::read(shell, &arguments.file)? {
        Ok(read) => read,
        Err(exit) => return Ok(exit),
    };
    let wanted = |name: &str| arguments.machine.as_ref().is_none_or(|machine| machine == name);
    let all = draw::drawings(&chart);
    let machines: Vec<_> = all.iter().filter(|drawing| wanted(drawing.name())).collect();
    if machines.is_empty() {
        return Err(super::nothing_drawn(&all));
    }
    let ending = arguments.output.as_deref().and_then(Form::of);
    let form = arguments.form.or(ending).unwrap_or(Form::Svg);
    let folder = arguments.output.as_ref().filter(|_| ending.is_none());
    if machines.len() > 1 && folder.is_none() {
        let help = "name a folder with --output, or one machine with --machine";
        return Err(Failure::usage_with_help(format!("the chart has {} machines", machines.len()), help));
    }
    // All pictures are drawn before the first is written.
    let (mut pictures, mut missing) = (Vec::new(), BTreeSet::new());
    for machine in machines {
        let failed = |fault: DrawFault| Failure::usage(fault.to_string());
        let Still { bytes, left_out } = drawn(machine, form, arguments).map_err(failed)?;
        missing.extend(left_out);
        pictures.push((machine.name(), bytes));
    }
    if !missing.is_empty() {
        let letters: String = missing.into_iter().collect();
        shell.note(&format!("left out of the picture, since its faces lack them: {letters} (an SVG has them)"))?;
    }
    for (name, picture) in pictures {
        match (&arguments.output, folder) {
            (None, _) => shell.out().write_all(&picture)?,
            (Some(_), Some(folder)) => {
                std::fs::create_dir_all(folder).map_err(|error| Failure::of_file("write", folder, error))?;
                written(shell, &folder.join(format!("{name}.{}", form.ending())), &picture)?;
            }
            (Some(file), None) => written(shell, file, &picture)?,
        }
    }
    Ok(Exit::Good)
}

fn drawn(drawing: &Drawing, form: Form, arguments: &Arguments) -> Result<Still, DrawFault> {
    let theme = match (arguments.theme, form) {
        (Theme::Auto, Form::Svg) => draw::Theme::Auto,
        (Theme::Auto | Theme::Light, _) => draw::Theme::Light,
        (Theme::Dark, _) => draw::Theme::Dark,
    };
    match form {
        Form::Svg => Ok(Still { bytes: drawing.svg(theme)?.into_bytes(), left_out: Vec::new() }),
        Form::Png => drawing.png(theme, arguments.scale),
        Form::Pdf => drawing.pdf(theme),
    }
}

fn written(shell: &mut Shell, path: &Path, picture: &[u8]) -> Result<(), Failure> {
    crate::files::write_bytes(path, picture)?;
    if shell.talks() {
        writeln!(shell.out(), "{}", path.display())?;
    }
    Ok(())
}
