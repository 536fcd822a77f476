//! `wearlaw run SCENE`: the settings of a run, and the run itself.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::args::{RunArguments, SceneArguments};
use super::console::Console;
use super::interrupt::Interrupt;
use super::machine;
use super::opening::{self, OpenedLaw};
use super::progress::Progress;
use super::restart;
use super::summary::Summary;
use super::table::labelled;
use super::writing::{Comparison, Listener};
use crate::contact::Instructions;
use crate::error::{Error, UsageError};
use crate::exit_code::ExitCode;
use crate::law::build::Language;
use crate::law::lookup;
use crate::output::{
    FieldFormat, FieldSeries, Figure, Keeper, LawReport, Report, RunPage, StabilityReport, WholeFolder, check_folder,
    earlier_scene, write_history, write_plot, write_run_page,
};
use crate::plan::{Plan, Skipped};
use crate::record::{ESTIMATED, End, HistoryRow, Record};
use crate::reference::NamedReference;
use crate::scene::{Format, Override, Scene};
use crate::solve::{ErrorNorm, Estimate, Run, SolveError};

/// What a run is told.
#[derive(Debug, Clone)]
pub(super) struct Settings {
    /// The scene file.
    pub(super) scene: PathBuf,
    /// What `plan` is told too.
    pub(super) shared: SceneArguments,
    /// The folder for the results.
    pub(super) out: PathBuf,
    /// Number of threads; `None`: as many as the machine has.
    pub(super) threads: Option<usize>,
    /// Whether it goes on from a checkpoint.
    pub(super) resume: bool,
    /// Whether a page is written.
    pub(super) html: bool,
}

pub(super) fn command(console: &Console, arguments: RunArguments) -> Result<ExitCode, Error> {
    match arguments.scene {
        None => references(console),
        Some(scene) => execute(
            console,
            &Settings {
                out: arguments.out.unwrap_or_else(|| default_folder(&scene)),
                scene,
                shared: arguments.shared,
                threads: arguments.threads.map(usize::from),
                resume: arguments.resume,
                html: arguments.html,
            },
        ),
    }
}

/// Runs the scene: reads it, opens its law, plans, solves, writes the results and sums them up.
fn execute(console: &Console, settings: &Settings) -> Result<ExitCode, Error> {
    let interrupt = Interrupt::watch();
    let (scene, law) = prepared(console, &interrupt, &settings.scene, &settings.shared)?;
    let plan = Plan::new(&scene, law.evaluator.descriptor())?;
    check_folder(&settings.out)?;
    let replaced = replaced(&settings.out, &scene)?;
    let run = Run::prepare(&plan, law.evaluator.as_ref())?;
    run.check_reference()?;
    let identity = restart::identity(&scene, &law, &run)?;
    let earlier = if settings.resume { restart::earlier(console, &settings.out, &identity)? } else { None };
    if settings.resume && earlier.is_none() {
        console.note(&format!("no checkpoint in {}: the run begins at its start", settings.out.display()));
    }
    let folder = WholeFolder::begin(&settings.out)?;
    let mut keeper = Keeper::new(folder, identity.clone(), plan.output.checkpoint);
    let wanted = !plan.output.fields.is_empty() && !plan.output.formats.is_empty();
    let formats: Vec<FieldFormat> = plan.output.formats.iter().map(|format| field_format(*format)).collect();
    let mut fields = wanted.then(|| FieldSeries::begin(&keeper.path().join("fields"), &formats)).transpose()?;
    if let Some(earlier) = &earlier {
        keeper.take_up(&earlier.fields, fields.as_mut())?;
    }
    if settings.resume {
        keeper.sweep();
    }
    let mut listener = Listener {
        console,
        interrupt: &interrupt,
        progress: Progress::start(console),
        fields,
        keeper,
        geometry: run.geometry(),
        trouble: None,
    };
    let threads = settings.threads.unwrap_or(0);
    let mut record = match &earlier {
        Some(earlier) => run.resume(threads, &mut listener, &earlier.checkpoint)?,
        None => run.go(threads, &mut listener),
    };
    drop(earlier);
    let Listener { fields, keeper, trouble, progress, .. } = listener;
    drop(progress);
    for line in run.oddities(&scene, &plan, &record) {
        console.note(&format!("warning: {line}"));
        record.warnings.push(line);
    }
    if let Some(error) = trouble {
        return Err(error.into());
    }
    fields.map(FieldSeries::finish).transpose()?;
    let finished = matches!(record.end, End::Done | End::Stopped(_));
    // A reference that fails, or takes too long for whoever waits, costs its error norm, not the results.
    let compared = match finished {
        true => run.error(&record, &mut Comparison { interrupt: &interrupt, progress: Progress::start(console) }),
        false => Ok(None),
    };
    let (error, without_reference) = match compared {
        Ok(error) => (error, None),
        Err(failure) => (None, Some(failure)),
    };
    let mut watch = Comparison { interrupt: &interrupt, progress: Progress::start(console) };
    let estimate = match plan.output.error_estimate && !interrupt.asked() {
        true => run.estimate(&record, &mut watch),
        false => Estimate::of_steps(&record),
    };
    drop(watch);
    let known = (error.as_ref(), &estimate);
    let report = report(&scene, &plan, &law, settings.shared.isolate, &run.skipped(), &record, known)?;
    write_history(&record.history, &keeper.path().join("history.csv"))?;
    let title = scene.title.clone().unwrap_or_else(|| settings.scene.display().to_string());
    let figure =
        Figure { title: &title, units: &record.units, history: &record.history, profile: record.profile.as_ref() };
    write_plot(&figure, &keeper.path().join("plot.svg"))?;
    report.write(&keeper.path().join("report.json"))?;
    if settings.html {
        let machine = machine::facts(settings.threads);
        let page = RunPage { report: &report, figure, identity: &identity, machine: &machine };
        write_run_page(&page, &keeper.path().join("report.html"))?;
    }
    keeper.commit()?;
    if let Some(title) = replaced {
        console.note(&format!("{} held the results of `{title}`, which these replace", settings.out.display()));
    }
    let missed = missed(&plan, error.as_ref());
    let (code, failure) = match record.end {
        End::Failed(error) => {
            let error = Error::from(error);
            (error.exit_code(), Some(error))
        }
        End::Interrupted => (ExitCode::Interrupted, None),
        End::Done | End::Stopped(_) if matches!(without_reference, Some(SolveError::Interrupted)) => {
            console.note("the reference was interrupted: the results are whole, their error is not known");
            (ExitCode::Interrupted, None)
        }
        End::Done | End::Stopped(_) if without_reference.is_some() => {
            let error = without_reference.map_or(Error::Interrupted, Error::from);
            (error.exit_code(), Some(error))
        }
        End::Done | End::Stopped(_) if record.stability.is_unstable => (ExitCode::NumbersFailed, None),
        End::Done | End::Stopped(_) if missed.is_some() => (ExitCode::FallsShort, None),
        End::Done | End::Stopped(_) => (ExitCode::Done, None),
    };
    if failure.is_some() {
        // The error says all that there is to say; standard output stays empty, or its document's.
    } else if console.json {
        console.document(&report.document())?;
    } else if !console.quiet {
        let summary = summary(title, &plan, &report, (error.as_ref(), &estimate), &settings.out);
        console.result(&summary.text(console))?;
    }
    if record.stability.is_unstable {
        console.note(&record.stability.verdict);
    }
    if let Some(words) = missed {
        console.note(&words);
    }
    match failure {
        Some(error) => {
            console.note(&format!("results up to time {} are in {}", report.last.time, settings.out.display()));
            Err(error)
        }
        None => Ok(code),
    }
}

fn field_format(format: Format) -> FieldFormat {
    match format {
        Format::Csv => FieldFormat::Csv,
        Format::Npz => FieldFormat::Npz,
        Format::Vtk => FieldFormat::Vtk,
    }
}

pub(super) fn report(
    scene: &Scene,
    plan: &Plan,
    law: &OpenedLaw,
    isolated: bool,
    skipped: &[Skipped],
    record: &Record<SolveError>,
    (error, estimate): (Option<&ErrorNorm>, &Estimate),
) -> Result<Report, Error> {
    let descriptor = law.evaluator.descriptor();
    let table = &plan.material.constants;
    let json = |what: &str, value: Result<Value, serde_json::Error>| {
        value.map_err(|error| Error::Fault { what: format!("{what} as JSON: {error}") })
    };
    let error = match error.cloned().or_else(|| estimate.norm()) {
        Some(error) => {
            let mut value = json("the error", serde_json::to_value(error))?;
            value["estimate"] = json("the estimate", serde_json::to_value(estimate))?;
            value
        }
        None => Value::Null,
    };
    Ok(Report {
        scene: json("the scene", serde_json::to_value(scene))?,
        law: LawReport {
            name: descriptor.name.clone(),
            version: descriptor.version.clone(),
            path: law.origin.clone(),
            sha256: law.facts.as_ref().map(|facts| facts.sha256.clone()),
            constants: (!table.varies_in_time() && !table.varies_in_temperature()).then(|| {
                let named = descriptor.constants.iter().enumerate();
                named.map(|(c, constant)| (constant.name.clone(), table.value(c, 0.0, 0.0))).collect()
            }),
            isolated,
            build_time_s: law.build_seconds,
        },
        instructions: Instructions::asked()?.name().to_owned(),
        computed: plan.computed.clone(),
        skipped: json("the plan", serde_json::to_value(skipped))?,
        memory: record.memory.clone(),
        last: record.history.last().copied().unwrap_or_else(|| HistoryRow::at(0.0)),
        share: plan.share,
        error,
        cost: record.cost,
        stability: StabilityReport {
            stiffness_per_s: record.stability.stiffness,
            explicit_limit_s: record.stability.explicit_limit,
            largest_step_s: record.largest_step,
            verdict: record.stability.verdict.clone(),
        },
        warnings: law.warnings.iter().chain(&record.warnings).cloned().collect(),
        ended: match &record.end {
            End::Done => "done".to_owned(),
            End::Stopped(reason) => reason.clone(),
            End::Interrupted => "interrupted".to_owned(),
            End::Failed(error) => error.to_string(),
        },
    })
}

fn summary(
    title: String,
    plan: &Plan,
    report: &Report,
    (error, estimate): (Option<&ErrorNorm>, &Estimate),
    out: &Path,
) -> Summary {
    let shown = match error {
        Some(error) => Some((format!("against {}", error.reference), error.norm.clone(), error.value)),
        None => estimate.norm().map(|error| {
            let causes = error.reference.strip_prefix(ESTIMATED).unwrap_or(&error.reference);
            (format!("estimated: {causes}"), error.norm, error.value)
        }),
    };
    Summary {
        title,
        law: format!("{} {} ({})", report.law.name, report.law.version, report.law.path),
        time: report.last.time,
        sliding_distance: report.last.sliding_distance,
        max_wear_depth: report.last.max_wear_depth,
        wear_volume: report.last.wear_volume,
        error: shown,
        estimate: plan.output.error_estimate.then(|| estimate.clone()),
        run_time_s: report.cost.run_time_s,
        build_time_s: report.law.build_time_s,
        steps: report.cost.steps,
        points_evaluated: report.cost.points_evaluated,
        out: out.to_owned(),
        length: plan.units.length.label.to_owned(),
        time_unit: plan.units.time.label.to_owned(),
        stopped: (report.ended != "done").then(|| report.ended.clone()),
        share: plan.share,
    }
}

/// What is to be said of an error above the bar of the scene; `None`: it is not, or there is no bar.
pub(super) fn missed(plan: &Plan, error: Option<&ErrorNorm>) -> Option<String> {
    let (error, bar) = error.zip(plan.bar).filter(|(error, bar)| error.value.is_nan() || error.value > *bar)?;
    Some(format!("the error {:e} is above the bar of the scene, {bar:e} (`reference.bar`)", error.value))
}

/// The scene with its overrides, and its law.
pub(super) fn prepared(
    console: &Console,
    interrupt: &Interrupt,
    file: &std::path::Path,
    shared: &SceneArguments,
) -> Result<(Scene, OpenedLaw), Error> {
    Instructions::asked()?;
    let overrides: Vec<Override> = shared.overrides.iter().map(|text| Override::from(text.as_str())).collect();
    if let Some(what) = law_instead_of_scene(file) {
        return Err(UsageError::LawNotScene { path: file.to_owned(), what }.into());
    }
    let scene = Scene::read(file, &overrides)?;
    let law = opening::open(console, interrupt, &scene, shared)?;
    law.warnings.iter().for_each(|warning| console.note(&format!("warning: {warning}")));
    Ok((scene, law))
}

/// What a file is that was typed where a scene belongs, if its name tells a law.
fn law_instead_of_scene(file: &Path) -> Option<&'static str> {
    let is_library = lookup::is_library(file);
    let is_source = Language::of(file).is_some() || file.file_name().is_some_and(|name| name == "Cargo.toml");
    if is_library { Some("a library") } else { is_source.then_some("source code") }
}

/// The title of another scene whose results these replace.
fn replaced(out: &Path, scene: &Scene) -> Result<Option<String>, Error> {
    let earlier = earlier_scene(out)?.and_then(|earlier| earlier["title"].as_str().map(str::to_owned));
    Ok(earlier.filter(|title| Some(title) != scene.title.as_ref()))
}

/// `NAME.out` in the current folder for a scene `NAME.toml` in any.
fn default_folder(scene: &std::path::Path) -> PathBuf {
    let mut name = scene.file_stem().unwrap_or("scene".as_ref()).to_owned();
    name.push(".out");
    PathBuf::from(name)
}

/// The exact answers that a scene can name.
fn references(console: &Console) -> Result<ExitCode, Error> {
    if console.json {
        let all = NamedReference::ALL.map(|one| json!({ "kind": one.name(), "description": one.description() }));
        console.document(&json!({ "references": all }))?;
    } else {
        let mut text = format!("{}\n", console.headline("exact answers for [reference] kind"));
        for one in NamedReference::ALL {
            text.push_str(&labelled(one.name(), one.description(), 20, 96));
        }
        console.result(&text)?;
    }
    Ok(ExitCode::Done)
}

#[cfg(test)]
mod tests {
    use super::default_folder;
    use std::path::Path;

    #[test]
    fn results_go_to_a_folder_here_that_is_named_after_the_scene() {
        assert_eq!(default_folder(Path::new("scenes/pin_on_disc.toml")), Path::new("pin_on_disc.out"));
    }
}
