//! What a study comes to, in words.

use super::front::stable;
use crate::record::{Case, Cheapest, Clock, Kind, Status, StudyRecord, YardstickKind};

/// Below this part of the wall time the processors must have been busy with other work.
const BUSY: f64 = 0.8;

/// What the varied value of a case is, in words.
pub(super) fn value_words(kind: Kind, value: f64) -> String {
    match kind {
        Kind::Substeps if value == 1.0 => "1 substep".to_owned(),
        Kind::Substeps => format!("{value} substeps"),
        Kind::Tolerance => format!("{value:e}"),
        Kind::Scaling => format!("C1 = {value}"),
        Kind::Grid => format!("{value} cells"),
    }
}

/// A case with its value: `tr-bdf2 in 4 substeps`.
fn named(case: &Case) -> String {
    let value = value_words(case.kind, case.value);
    match case.kind {
        Kind::Substeps => format!("{} in {value}", case.line),
        Kind::Tolerance => match case.line.strip_suffix(" to a tolerance") {
            Some(method) => format!("{method} to the tolerance {value}"),
            None => format!("{} {value}", case.line),
        },
        Kind::Scaling | Kind::Grid => format!("{} with {value}", case.line),
    }
}

fn seconds(value: f64) -> String {
    match value {
        value if value < 1e-3 => format!("{:.0} us", 1e6 * value),
        value if value < 1.0 => format!("{:.3} ms", 1e3 * value),
        value => format!("{value:.3} s"),
    }
}

/// A factor with two or three digits.
fn times(factor: f64) -> String {
    if factor < 10.0 { format!("{factor:.1}") } else { format!("{factor:.0}") }
}

/// The verdict, a sentence each.
pub(super) fn words(study: &StudyRecord) -> Vec<String> {
    // A study of grids alone says nothing of the errors of integrators.
    let advances = study.cases.iter().any(|case| case.kind != Kind::Grid);
    let cheapest = study.cheapest.iter().filter(|_| advances);
    let mut lines: Vec<String> = cheapest.map(|cheapest| to_error(study, cheapest)).collect();
    lines.extend(wall(study));
    lines.extend(busy(study));
    lines.extend(orders(study));
    lines.push(yardstick(study));
    lines.extend(grid(study));
    if study.cases.iter().any(|case| matches!(case.status, Status::LeftOut(_))) {
        let count = study.cases.iter().filter(|case| matches!(case.status, Status::LeftOut(_))).count();
        let lines_words = if count == 1 { "1 line was".to_owned() } else { format!("{count} lines were") };
        lines.push(format!("{lines_words} not run to the end: the table says where, and why"));
    }
    lines
}

/// The cheapest way to an error, and how much dearer explicit steps are.
fn to_error(study: &StudyRecord, cheapest: &Cheapest) -> String {
    let wanted = format!("{:e}", cheapest.error);
    let told = |index: usize| {
        let case = &study.cases[index];
        let time = case.time(study.clock).unwrap_or_default();
        let error = case.errors.get(&study.norm).copied().unwrap_or(f64::NAN);
        format!("{}, {}, error {error:.1e}", named(case), seconds(time))
    };
    let Some(case) = cheapest.case else {
        let errors = stable(&study.cases, &study.norm, 0.0, study.clock).map(|(.., error)| error);
        let least = errors.fold(f64::INFINITY, f64::min);
        return unreached(cheapest.error, least, study.yardstick.stated.get(&study.norm).copied());
    };
    let way = format!("to {wanted}: cheapest is {}", told(case));
    let prescribed = study.explicit_limit.is_none();
    match (cheapest.explicit, cheapest.factor, cheapest.processor_factor) {
        (Some(explicit), ..) if explicit == case => format!("{way}, which is explicit stepping"),
        (Some(explicit), Some(factor), Some(processor)) => format!(
            "{way}; the cheapest {}explicit run that is as good: {}: {} times the run time, {} times the processor time",
            if prescribed { "" } else { "stable " },
            told(explicit),
            times(factor),
            times(processor)
        ),
        _ => format!("{way}; no stable explicit run came so near in the time there was"),
    }
}

/// Why no run is named for an error: of the least error that was found, and what is stated of the yardstick's own.
fn unreached(error: f64, least: f64, own: Option<f64>) -> String {
    match own {
        Some(own) if least <= error => format!(
            "to {error:e}: not to be told from a yardstick that is itself off by {own:.1e}, though {least:.1e} was found"
        ),
        _ => format!("to {error:e}: nothing that was run came so near"),
    }
}

/// Whether other work shared the machine.
fn busy(study: &StudyRecord) -> Option<String> {
    let share = study.processor_share.filter(|share| *share < BUSY && study.threads == 1)?;
    let by = if study.clock == Clock::Wall { "; `--clock processor` goes by the processor time" } else { "" };
    Some(format!("other work shared the machine: the processors worked {:.0} % of the wall time{by}", 100.0 * share))
}

/// The wall that explicit steps stand before.
fn wall(study: &StudyRecord) -> Vec<String> {
    let Some(limit) = study.explicit_limit else { return Vec::new() };
    let mut lines = vec![format!(
        "explicit steps are stable up to {:.3e} (measured at the start, in units of time); with nine tenths of that, {} \
         substeps of the longest load step",
        limit.step, limit.substeps
    )];
    let unstable: Vec<&Case> = study.cases.iter().filter(|case| case.status == Status::Unstable).collect();
    let volume = |case: &&Case| case.errors.get("volume_relative").copied();
    let worst = |norm: &str| unstable.iter().filter_map(|case| case.errors.get(norm).copied()).fold(0.0, f64::max);
    if let Some(volume) = unstable.iter().filter_map(volume).reduce(f64::max) {
        let also = worst("pressure_l2_relative");
        let pressure = if also > 0.0 { format!(", pressures by {also:.1e}") } else { String::new() };
        lines.push(format!(
            "{} unstable: their profiles are off by up to {:.1e}{pressure}, their volumes by {volume:.1e}",
            match unstable.len() {
                1 => "1 explicit run is".to_owned(),
                count => format!("{count} explicit runs are"),
            },
            worst(&study.norm),
        ));
    }
    lines
}

fn orders(study: &StudyRecord) -> Option<String> {
    let each = study.orders.iter().map(|order| {
        format!("{} {:.2} (of {} runs, {} to {} substeps)", order.line, order.order, order.cases, order.from, order.to)
    });
    let each: Vec<String> = each.collect();
    (!each.is_empty()).then(|| format!("observed orders: {}", each.join(", ")))
}

fn yardstick(study: &StudyRecord) -> String {
    let yardstick = &study.yardstick;
    let name = &yardstick.name;
    match (yardstick.kind, yardstick.stated.get(&study.norm)) {
        (YardstickKind::SelfConverged, Some(own)) => {
            format!("compared with {name}, whose own error in time is stated as {own:.1e}")
        }
        (YardstickKind::SelfConverged, None) => format!("compared with {name}, of whose own error nothing is known"),
        _ => format!("compared with {name}"),
    }
}

/// What the grid is off by, and what that makes of smaller errors in time.
fn grid(study: &StudyRecord) -> Option<String> {
    let estimated = study.grid.as_ref()?.estimated.get(&study.norm);
    let measured = study.yardstick.measured.get(&study.norm);
    let answer = study.yardstick.answer.as_deref().unwrap_or_default();
    let text = match (measured, estimated) {
        (Some(measured), Some(estimated)) => {
            format!(
                "the grid itself is off by {measured:.1e} from {answer} (estimated from half the cells: {estimated:.1e})"
            )
        }
        (Some(measured), None) => format!("the grid itself is off by {measured:.1e} from {answer}"),
        (None, Some(estimated)) => {
            format!("the grid itself is off by about {estimated:.1e}, estimated from half the cells")
        }
        (None, None) => return None,
    };
    Some(format!("{text}: errors in time far below that buy nothing"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_that_came_near_is_not_denied() {
        assert_eq!(unreached(1e-3, 2e-3, Some(1e-4)), "to 1e-3: nothing that was run came so near");
        assert_eq!(unreached(1e-3, 2e-3, None), "to 1e-3: nothing that was run came so near");
        let near = unreached(1e-3, 4e-4, Some(8e-4));
        assert_eq!(
            near,
            "to 1e-3: not to be told from a yardstick that is itself off by 8.0e-4, though 4.0e-4 was found"
        );
    }

    #[test]
    fn values_and_times_are_words() {
        assert_eq!(value_words(Kind::Substeps, 1.0), "1 substep");
        assert_eq!(value_words(Kind::Substeps, 64.0), "64 substeps");
        assert_eq!(value_words(Kind::Tolerance, 1e-3), "1e-3");
        assert_eq!(
            (seconds(2e-5), seconds(0.0123), seconds(2.5)),
            ("20 us".into(), "12.300 ms".into(), "2.500 s".into())
        );
        assert_eq!((times(3.16), times(316.2)), ("3.2".to_owned(), "316".to_owned()));
    }
}
