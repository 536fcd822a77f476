//! `wearlaw stability SCENE`: how stiff the contact is against wear, and what every integrator does beyond the limit.

use serde_json::{Value, json};

use super::args::StabilityArguments;
use super::console::Console;
use super::interrupt::Interrupt;
use super::opening::OpenedLaw;
use super::run::prepared;
use super::table::{aligned, labelled};
use super::unit_text::significant;
use crate::error::Error;
use crate::exit_code::ExitCode;
use crate::law::CallNumbers;
use crate::plan::Plan;
use crate::scene::Units;
use crate::solve::{Ladder, Ordinary, Outcome, Row, Run};
use crate::stability::extremes::{self, Answer, Extreme, Point, Surroundings};

const LABEL: usize = 18;
const WIDTH: usize = 100;
/// What stands for a pressure or a velocity where the scene has none: 1 MPa and 0.1 m/s if it is in SI units.
const ORDINARY: (f64, f64) = (1e6, 0.1);

pub(super) fn command(console: &Console, arguments: StabilityArguments) -> Result<ExitCode, Error> {
    let interrupt = Interrupt::watch();
    let (scene, law) = prepared(console, &interrupt, &arguments.scene, &arguments.shared)?;
    let plan = Plan::new(&scene, law.evaluator.descriptor())?;
    let run = Run::prepare(&plan, law.evaluator.as_ref())?;
    let at = arguments.at.unwrap_or(0.0);
    let ladder = interrupt.over(run.ladder(at, &|| !interrupt.asked()).map_err(Error::from))?;
    let usual = ladder.as_ref().map(|ladder| ladder.moment.ordinary()).or(run.ordinary()).unwrap_or_default();
    let rows = extremes(&plan, &law, usual, at)?;
    let own_fine = ladder.as_ref().is_none_or(|ladder| ladder.own.fine);
    let code = if own_fine { ExitCode::Done } else { ExitCode::NumbersFailed };
    let verdict = verdict(ladder.as_ref(), &rows);
    if console.json {
        console.document(&document(&scene.file.display().to_string(), &law, ladder.as_ref(), &rows, &verdict)?)?;
    } else if !console.quiet {
        let title = scene.title.clone().unwrap_or_else(|| scene.file.display().to_string());
        let mut text = format!("{}\n", console.headline(&title));
        if let Some(ladder) = &ladder {
            text.push_str(&head(ladder, &plan.units));
            text.push_str(&steps(console, ladder));
        }
        text.push_str(&inputs(console, &law.evaluator.descriptor().name, &rows));
        text.push_str(&format!("\n{}\n", console.headline("verdict")));
        verdict.iter().for_each(|line| text.push_str(&labelled("-", line, 2, WIDTH)));
        console.result(&text)?;
    }
    Ok(code)
}

/// The law at extreme input, around what an ordinary point of the scene has.
fn extremes(plan: &Plan, law: &OpenedLaw, usual: Ordinary, at: f64) -> Result<Vec<Extreme>, Error> {
    let or = |value: f64, ordinary: f64| if value > 0.0 { value } else { ordinary };
    let mut durations = plan.blocks.iter().flat_map(|block| &block.steps).filter_map(|step| step.duration);
    let duration = durations.find(|duration| *duration != 0.0).unwrap_or(1.0);
    let table = &plan.material.constants;
    let point = Point {
        constants: (0..table.count()).map(|c| table.value(c, at, usual.temperature)).collect(),
        pressure: or(usual.pressure, ORDINARY.0),
        velocity: or(usual.velocity, ORDINARY.1),
        dt: duration / plan.substeps.unwrap_or(1) as f64,
    };
    let numbers = CallNumbers {
        dimension: i64::from(plan.dimension),
        material: plan.material.number,
        reference_temperature: plan.units.reference_temperature.unwrap_or(0.0),
        absolute_zero: plan.units.absolute_zero(),
        units: plan.sizes,
        ..CallNumbers::default()
    };
    let around = Surroundings {
        numbers,
        temperature: usual.temperature,
        friction: plan.friction.unwrap_or(0.0),
        state: plan.initial_state.clone(),
    };
    // A law that needs what no scene gives here has no table of its own.
    Ok(extremes::table(law.evaluator.as_ref(), &point, &around).unwrap_or_default())
}

/// The numbers above the table of steps.
fn head(ladder: &Ladder, units: &Units) -> String {
    let mut text = String::new();
    let mut line = |label: &str, value: &str| text.push_str(&labelled(label, value, LABEL, WIDTH));
    let time = units.time.label;
    let moment = &ladder.moment;
    line(
        "state",
        &format!(
            "time {} {time}, load {}, approach {}, {} cells in contact",
            significant(moment.time, 4),
            significant(moment.load, 6),
            significant(moment.approach, 6),
            moment.cells_in_contact
        ),
    );
    for stiff in &ladder.stiff {
        let label = format!("given {}", stiff.control.word());
        match (stiff.stiffness_per_s, stiff.explicit_limit_s) {
            (Some(stiffness), Some(limit)) => {
                let mut value = format!(
                    "stiffness {} per {time}, explicit limit {} {time} (2 / stiffness)",
                    significant(stiffness, 5),
                    significant(limit, 5)
                );
                if stiff.points_left_out > 0 {
                    value.push_str(&format!(
                        "; {} points under less than 1e-2 of the largest pressure were left out of the measure, because \
                         the law's derivative grows without bound at no pressure",
                        stiff.points_left_out
                    ));
                }
                line(&label, &value);
            }
            _ => line(&label, stiff.without.as_deref().unwrap_or("not measured")),
        }
    }
    text
}

/// The table of steps.
fn steps(console: &Console, ladder: &Ladder) -> String {
    if ladder.rows.is_empty() {
        return String::new();
    }
    let mut text = String::new();
    let mut groups: Vec<(crate::solve::Pressed, bool)> = Vec::new();
    for row in &ladder.rows {
        if !groups.contains(&(row.control, row.held)) {
            groups.push((row.control, row.held));
        }
    }
    for (control, held) in groups {
        let contact = if held { "contact held to the cells of the start" } else { "contact as it comes" };
        let title = format!(
            "{} steps of r / stiffness each (explicit limit: r = 2), given {}, {contact}",
            ladder.steps,
            control.word()
        );
        text.push_str(&format!("\n{}\n", console.headline(&title)));
        let names = ["r", "method", "roughness", "ripple", "p centre", "p lowest", "wear/reach", "error", "comes out"];
        let mut rows = vec![names.map(str::to_owned).to_vec()];
        let group: Vec<&Row> = ladder.rows.iter().filter(|row| row.control == control && row.held == held).collect();
        for row in &group {
            rows.push(cells(row, beyond_the_grid(&group, row)));
        }
        rows.retain(|row| !row.is_empty());
        text.push_str(&aligned(&rows, 2));
    }
    text.push_str(
        "\n  roughness: second differences of the pressure over the pressure, beyond those of a refined run\n  \
         ripple: the mode that decays fastest, over its amplitude of 1 % of the pressure at the start\n  \
         p centre: over that of the refined run; p lowest: over the largest at the start\n  \
         wear/reach: largest wear over what there was to wear; error: L2, against the refined run\n",
    );
    text
}

/// Whether no method was tried in steps of this length; one line says so for all.
fn beyond_the_grid(group: &[&Row], row: &Row) -> bool {
    group.iter().filter(|other| other.ratio == row.ratio).all(|other| matches!(other.outcome, Outcome::NotTried(_)))
}

fn cells(row: &Row, none_tried: bool) -> Vec<String> {
    let ratio = if row.ratio < 1e3 { row.ratio.to_string() } else { format!("{:e}", row.ratio) };
    let blank = |words: &str| {
        let mut cells = vec![ratio.clone(), row.method.clone()];
        cells.extend(std::iter::repeat_n("-".to_owned(), 6));
        cells.push(words.to_owned());
        cells
    };
    match &row.outcome {
        Outcome::NotTried(why) if none_tried => {
            if row.method != "explicit-euler" {
                return Vec::new();
            }
            let mut cells = blank(&format!("not tried: {why}"));
            cells[1] = "all".to_owned();
            cells
        }
        Outcome::NotTried(why) => blank(why),
        // What it said stands once, below the tables.
        Outcome::Failed(_) => blank("failed"),
        Outcome::Seen(seen) => {
            let short = |value: f64| significant(value, 3);
            let stepped = match seen.replaced {
                0 => String::new(),
                1 => "; the rule stepped in once".to_owned(),
                times => format!("; the rule stepped in {times} times"),
            };
            let words = row.outcome.trouble().unwrap_or_else(|| "fine".to_owned());
            vec![
                ratio,
                row.method.clone(),
                short(seen.roughness),
                seen.ripple.map_or_else(|| "-".to_owned(), short),
                short(seen.center_pressure),
                short(seen.lowest_pressure),
                short(seen.wear_over_reach),
                short(seen.error),
                format!("{words}{stepped}"),
            ]
        }
    }
}

/// The table of extreme input.
fn inputs(console: &Console, law: &str, rows: &[Extreme]) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let mut text = format!("\n{}\n", console.headline(&format!("extreme input of the law {law}")));
    let row = |row: &Extreme| {
        let answer = match &row.answer {
            Answer::Value(value) => format!("{value:e}"),
            Answer::Cut(factor) => format!("wants a step shorter by {factor}"),
            Answer::Refused(_) => "refused".to_owned(),
        };
        let right = match row.right {
            Some(true) => "right",
            Some(false) => "WRONG",
            None => "",
        };
        vec![row.input.clone(), answer, right.to_owned()]
    };
    text.push_str(&aligned(&rows.iter().map(row).collect::<Vec<_>>(), 2));
    text
}

/// What it all means, a sentence each.
fn verdict(ladder: Option<&Ladder>, extremes: &[Extreme]) -> Vec<String> {
    let mut lines = Vec::new();
    match ladder {
        None => lines.push("a prescribed pressure has no stability limit: wear does not change it".to_owned()),
        Some(ladder) => {
            let fine = if ladder.own.fine { "fine" } else { "not fine" };
            lines.push(format!("the scene's method, {}, is {fine}: {}", ladder.own.method, ladder.own.words));
            lines.extend(ladder.own.beside.clone());
            lines.extend(failures(ladder));
            lines.extend(overworn(ladder));
        }
    }
    let wrong = extremes.iter().filter(|row| row.right == Some(false)).count();
    let judged = extremes.iter().filter(|row| row.right.is_some()).count();
    if judged > 0 {
        lines.push(match wrong {
            0 => format!("all {judged} answers to extreme input that are known are right"),
            _ => format!("{wrong} of {judged} answers to extreme input are wrong"),
        });
    }
    lines
}

/// What the failed trials said, each text once.
fn failures(ladder: &Ladder) -> Vec<String> {
    let mut told: Vec<(String, Vec<String>)> = Vec::new();
    for row in &ladder.rows {
        let Outcome::Failed(text) = &row.outcome else { continue };
        let place = format!("{} at r = {:e}, given {}", row.method, row.ratio, row.control.word());
        match told.iter_mut().find(|(known, _)| known == text) {
            Some((_, places)) => places.push(place),
            None => told.push((text.clone(), vec![place])),
        }
    }
    told.into_iter().map(|(text, places)| format!("failed, {}: {text}", places.join("; "))).collect()
}

/// Where a second-order method alone would have gone wrong.
fn overworn(ladder: &Ladder) -> Vec<String> {
    let mut lines = Vec::new();
    for method in ["tr-bdf2 alone", "sdirk2 alone"] {
        let wrong: Vec<&Row> =
            ladder.rows.iter().filter(|row| row.method == method && row.outcome.trouble().is_some()).collect();
        let Some(first) = wrong.iter().map(|row| row.ratio).min_by(f64::total_cmp) else { continue };
        let worst = wrong.iter().filter_map(|row| match &row.outcome {
            Outcome::Seen(seen) => Some(seen.wear_over_reach),
            _ => None,
        });
        let worst = worst.fold(0.0, f64::max);
        let far = if worst > 1.0 {
            format!(", by up to {} times what there was", significant(worst, 3))
        } else {
            String::new()
        };
        let method = method.trim_end_matches(" alone");
        lines.push(format!(
            "{method} without its rule goes wrong from r = {first} on{far}; where that would leave a point open that \
             backward Euler keeps closed, a run takes the step by backward Euler"
        ));
    }
    lines
}

fn document(
    scene: &str,
    law: &OpenedLaw,
    ladder: Option<&Ladder>,
    extremes: &[Extreme],
    verdict: &[String],
) -> Result<Value, Error> {
    let json = |value: Result<Value, serde_json::Error>| {
        value.map_err(|error| Error::Fault { what: format!("the stability table as JSON: {error}") })
    };
    let own = ladder.and_then(Ladder::own_stiffness);
    let mut rows = json(serde_json::to_value(ladder.map(|ladder| &ladder.rows[..]).unwrap_or_default()))?;
    if let (Some(rows), Some(ladder)) = (rows.as_array_mut(), ladder) {
        for (value, row) in rows.iter_mut().zip(&ladder.rows) {
            value["trouble"] = row.outcome.trouble().into();
        }
    }
    Ok(json!({
        "scene": scene,
        "law": { "name": law.evaluator.descriptor().name, "version": law.evaluator.descriptor().version },
        "state": json(serde_json::to_value(ladder.map(|ladder| &ladder.moment)))?,
        "control": ladder.map(|ladder| ladder.control.word()),
        "stiffness_per_s": own.and_then(|own| own.stiffness_per_s),
        "explicit_limit_s": own.and_then(|own| own.explicit_limit_s),
        "by_control": json(serde_json::to_value(ladder.map(|ladder| &ladder.stiff)))?,
        "limit_at_ratio": crate::stability::EXPLICIT_LIMIT,
        "steps": ladder.map(|ladder| ladder.steps),
        "rows": rows,
        "extremes": json(serde_json::to_value(extremes))?,
        "method": json(serde_json::to_value(ladder.map(|ladder| &ladder.own)))?,
        "verdict": verdict,
    }))
}
