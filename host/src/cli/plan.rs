//! `wearlaw plan SCENE`: what a run would compute, what it would leave out and why.

use serde_json::json;

use super::args::PlanArguments;
use super::console::Console;
use super::interrupt::Interrupt;
use super::opening::OpenedLaw;
use super::run::prepared;
use super::table::{aligned, item};
use super::unit_text::bytes;
use crate::error::Error;
use crate::exit_code::ExitCode;
use crate::plan::Plan;
use crate::record::MemoryLine;
use crate::solve::Run;

/// Width of the text.
const WIDTH: usize = 96;

pub(super) fn command(console: &Console, arguments: PlanArguments) -> Result<ExitCode, Error> {
    let interrupt = Interrupt::watch();
    let (scene, law) = prepared(console, &interrupt, &arguments.scene, &arguments.shared)?;
    let plan = Plan::new(&scene, law.evaluator.descriptor())?;
    let run = Run::prepare(&plan, law.evaluator.as_ref())?;
    let (points, memory) = (run.points(), run.memory());
    let total: u64 = memory.iter().map(|line| line.bytes).sum();
    if console.json {
        console.document(&json!({
            "law": { "name": law.evaluator.descriptor().name, "path": law.origin },
            "computed": plan.computed,
            "skipped": plan.skipped,
            "points": points,
            "memory": memory,
            "memory_bytes": total,
        }))?;
    } else {
        let title = plan.title.clone().unwrap_or_else(|| arguments.scene.display().to_string());
        console.result(&text(console, &title, &plan, &law, points, &memory))?;
    }
    Ok(ExitCode::Done)
}

fn text(console: &Console, title: &str, plan: &Plan, law: &OpenedLaw, points: usize, memory: &[MemoryLine]) -> String {
    let mut text = format!("{}\n\n{}\n", console.headline(title), console.headline("Computed"));
    let count = if points == 1 { "1 point".to_owned() } else { format!("{points} points") };
    text.push_str(&item(&format!("{count}, law from {}", law.origin), WIDTH));
    plan.computed.iter().for_each(|line| text.push_str(&item(line, WIDTH)));
    text.push_str(&format!("\n{}\n", console.headline("Left out")));
    if plan.skipped.is_empty() {
        text.push_str(&item("nothing", WIDTH));
    }
    plan.skipped.iter().for_each(|skipped| text.push_str(&item(&format!("{}: {}", skipped.what, skipped.why), WIDTH)));
    text.push_str(&format!("\n{}\n", console.headline("Memory")));
    let mut rows: Vec<Vec<String>> = memory.iter().map(|line| vec![line.what.clone(), bytes(line.bytes)]).collect();
    rows.push(vec!["together".to_owned(), bytes(memory.iter().map(|line| line.bytes).sum())]);
    text + &aligned(&rows, 2)
}
