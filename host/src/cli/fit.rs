//! `wearlaw fit SCENE --data FILE --vary NAMES`: constants of a law from measurements.

use std::path::{Path, PathBuf};

use super::console::Console;
use super::fit_args::{FitArguments, FitNoise};
use super::interrupt::Interrupt;
use super::progress::Progress;
use super::run::prepared;
use super::table::labelled;
use crate::error::Error;
use crate::exit_code::ExitCode;
use crate::fit::{Asked, Data, Noise, fit};
use crate::output::{FIT_PICTURE, check_fit_folder, write_fit};
use crate::record::FitRecord;
use crate::scene::Override;

const WIDTH: usize = 100;

pub(super) fn command(console: &Console, arguments: &FitArguments) -> Result<ExitCode, Error> {
    let interrupt = Interrupt::watch();
    let noise = match arguments.noise {
        FitNoise::Relative => Noise::Relative,
        FitNoise::Absolute => Noise::Absolute,
    };
    let data = Data::read(&arguments.data, noise)?;
    let out = arguments.out.clone().unwrap_or_else(|| default_folder(&arguments.scene));
    check_fit_folder(&out)?;
    let (_, law) = prepared(console, &interrupt, &arguments.scene, &arguments.shared)?;
    let overrides: Vec<Override> =
        arguments.shared.overrides.iter().map(|text| Override::from(text.as_str())).collect();
    let progress = Progress::start(console);
    let mut tell = |run: usize| progress.show_case(&format!("run {run} of the scene"), 0.0);
    let goes_on = || !interrupt.asked();
    let asked = Asked { vary: arguments.vary.clone(), noise };
    let record = fit(&arguments.scene, &overrides, law.evaluator.as_ref(), &data, &asked, &mut tell, &goes_on)?;
    drop(progress);
    write_fit(&record, &out)?;
    if console.json {
        console.document(&record)?;
    } else if !console.quiet {
        console.result(&text(console, &record, &out))?;
    }
    record.undetermined.iter().for_each(|what| console.note(&format!("warning: {what}")));
    Ok(ExitCode::Done)
}

fn text(console: &Console, fit: &FitRecord, out: &Path) -> String {
    let mut text = format!("{}\n", console.headline(&format!("{} fitted to {}", fit.law, fit.data)));
    let mut line = |label: &str, value: &str| text.push_str(&labelled(label, value, 18, WIDTH));
    line("measured", &format!("{} over {}, {} points", fit.quantity, fit.across, fit.points.len()));
    for one in &fit.parameters {
        let known = match one.interval {
            Some([low, high]) => {
                format!("{:.6e}, {low:.4e} to {high:.4e} with 95 % confidence (began at {:e})", one.value, one.start)
            }
            None => format!("not known by itself (the fit stands at {:.4e})", one.value),
        };
        line(&one.name, &known);
    }
    let strong = pairs(fit).map(|(a, b, value)| format!("{a} with {b} {value:+.5}")).collect::<Vec<_>>();
    if !strong.is_empty() {
        line("correlation", &strong.join(", "));
    }
    let scatter = match fit.reduced_chi_squared {
        Some(squares) => {
            format!("{squares:.3} squares of deviations per degree of freedom: about 1 where sigma is right")
        }
        None if fit.relative => format!("{:.2} % of what was measured", 100.0 * fit.scatter),
        None => format!("{:.4e}", fit.scatter),
    };
    line("scatter", &scatter);
    line("work", &format!("{} runs of the scene", fit.runs));
    line("results", &format!("{} (picture: {})", out.display(), out.join(FIT_PICTURE).display()));
    text
}

fn pairs(fit: &FitRecord) -> impl Iterator<Item = (&str, &str, f64)> {
    let count = fit.parameters.len();
    (0..count).flat_map(move |a| (a + 1..count).map(move |b| (a, b))).filter_map(|(a, b)| {
        let (first, second) = (&fit.parameters[a], &fit.parameters[b]);
        let known = first.interval.is_some() && second.interval.is_some();
        known.then(|| (first.name.as_str(), second.name.as_str(), fit.correlation[a][b]))
    })
}

/// `NAME.fit` in the current folder for a scene `NAME.toml` in any.
fn default_folder(scene: &Path) -> PathBuf {
    let mut name = scene.file_stem().unwrap_or_default().to_os_string();
    name.push(".fit");
    PathBuf::from(name)
}
