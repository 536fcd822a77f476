//! `wearlaw plan SCENE`: what a run would compute, what it would leave out and why.

use serde_json::json;

use super::args::PlanArguments;
use super::console::Console;
use super::interrupt::Interrupt;
use super::run::prepared;
use super::table::{aligned, labelled};
use super::unit_text::bytes;
use crate::error::Error;
use crate::exit_code::ExitCode;
use crate::plan::Plan;
use crate::solve::Run;

const WIDTH: usize = 100;

pub(super) fn command(console: &Console, arguments: PlanArguments) -> Result<ExitCode, Error> {
    let interrupt = Interrupt::watch();
    let (scene, law) = prepared(console, &interrupt, &arguments.scene, &arguments.shared)?;
    let plan = Plan::new(&scene, law.evaluator.descriptor())?;
    let run = Run::prepare(&plan, law.evaluator.as_ref())?;
    let (memory, pieces) = (run.memory(), run.pieces_planned()?);
    let total: u64 = memory.iter().map(|line| line.bytes).sum();
    let least = run.least_evaluations()?;
    let skipped = run.skipped();
    if console.json {
        console.document(&json!({
            "computed": plan.computed,
            "skipped": skipped,
            "points": run.points(),
            "pieces_of_loading": pieces,
            "evaluations_at_least": least,
            "memory": memory,
            "memory_bytes": total,
        }))?;
        return Ok(ExitCode::Done);
    }
    let mut text = format!("{}\n", console.headline("computed"));
    for line in &plan.computed {
        text.push_str(&labelled("-", line, 2, WIDTH));
    }
    text.push_str(&format!("\n{}\n", console.headline("left out")));
    let widest = skipped.iter().map(|skipped| skipped.what.chars().count()).max().unwrap_or(0).min(40);
    for skipped in &skipped {
        text.push_str(&labelled(&skipped.what, &skipped.why, widest + 2, WIDTH));
    }
    text.push_str(&format!("\n{}\n", console.headline("memory for the points")));
    let mut rows: Vec<Vec<String>> = memory.iter().map(|line| vec![line.what.clone(), bytes(line.bytes)]).collect();
    rows.push(vec!["together".to_owned(), bytes(total)]);
    text.push_str(&aligned(&rows, 2));
    text.push_str(&format!("\n{}\n", console.headline("cost")));
    let cost =
        [vec!["points".to_owned(), run.points().to_string()], vec!["pieces of loading".to_owned(), pieces.to_string()]];
    let least = least.map(|least| vec!["evaluations of the law, at least".to_owned(), least.to_string()]);
    let cost: Vec<Vec<String>> = cost.into_iter().chain(least).collect();
    text.push_str(&aligned(&cost, 2));
    console.result(&text)?;
    Ok(ExitCode::Done)
}
