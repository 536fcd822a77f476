//! The Pareto front, and the cheapest way to an error.

use crate::record::{Case, Cheapest, Clock, Errors, Kind, Status};

/// The errors that a verdict speaks of.
pub(super) const ERRORS: [f64; 3] = [1e-2, 1e-3, 1e-4];

/// Stable cases on the scene's own grid with their time and error; an error that the yardstick does not resolve is no
/// smaller than what is stated of the yardstick.
pub(super) fn stable<'c>(
    cases: &'c [Case],
    norm: &'c str,
    own: f64,
    clock: Clock,
) -> impl Iterator<Item = (usize, f64, f64)> + 'c {
    cases.iter().enumerate().filter_map(move |(index, case)| {
        let counts = case.status == Status::Done && case.kind != Kind::Grid;
        let (time, error) = (case.time(clock)?, *case.errors.get(norm)?);
        (counts && error.is_finite()).then_some((index, time, error.max(own)))
    })
}

/// Indices of the cases that no other beats in both time and error, from the cheapest to the most exact.
pub(super) fn front(cases: &[Case], norm: &str, stated: &Errors, clock: Clock) -> Vec<usize> {
    let own = stated.get(norm).copied().unwrap_or(0.0);
    let mut all: Vec<(usize, f64, f64)> = stable(cases, norm, own, clock).collect();
    all.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.2.total_cmp(&b.2)));
    let (mut front, mut least) = (Vec::new(), f64::INFINITY);
    for (index, _, error) in all {
        if error < least {
            least = error;
            front.push(index);
        }
    }
    front
}

/// The cheapest stable cases to an error, of all and of the explicit ones; an error counts with the yardstick's own on top.
pub(super) fn cheapest(cases: &[Case], norm: &str, stated: &Errors, clock: Clock) -> Vec<Cheapest> {
    let own = stated.get(norm).copied().unwrap_or(0.0);
    let of = |error: f64, explicit: bool| {
        let reaching = stable(cases, norm, 0.0, clock).filter(|(index, _, found)| {
            *found + own <= error && (!explicit || cases[*index].method == "explicit-euler")
        });
        reaching.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, ..)| index)
    };
    let ratio = |a: Option<usize>, b: Option<usize>, time: &dyn Fn(&Case) -> Option<f64>| {
        Some(time(&cases[a?])? / time(&cases[b?])?)
    };
    let each = |error: f64| {
        let (case, explicit) = (of(error, false), of(error, true));
        Cheapest {
            error,
            case,
            explicit,
            factor: ratio(explicit, case, &|case| Some(case.timing?.wall_s)),
            processor_factor: ratio(explicit, case, &|case| Some(case.timing?.processor_s)),
        }
    };
    ERRORS.map(each).to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Timing;

    fn case(method: &str, wall_s: f64, error: f64, status: Status) -> Case {
        Case {
            line: method.to_owned(),
            kind: Kind::Substeps,
            method: method.to_owned(),
            isolated: false,
            value: 1.0,
            overrides: Vec::new(),
            status,
            timing: Some(Timing {
                wall_s,
                wall_spread: 0.0,
                processor_s: 2.0 * wall_s,
                limit_s: 0.0,
                runs: 1,
                warmed_up: false,
            }),
            work: None,
            errors: Errors::from([("e".to_owned(), error)]),
            unresolved: Vec::new(),
            note: None,
        }
    }

    #[test]
    fn the_front_holds_what_nothing_stable_beats() {
        let cases = [
            case("sdirk2", 1.0, 1e-2, Status::Done),
            case("explicit-euler", 0.5, 1e-6, Status::Unstable),
            case("sdirk2", 2.0, 2e-2, Status::Done),
            case("sdirk2", 3.0, 1e-3, Status::Done),
            case("explicit-euler", 60.0, 8e-4, Status::Done),
        ];
        let stated = Errors::from([("e".to_owned(), 1e-5)]);
        assert_eq!(front(&cases, "e", &stated, Clock::Wall), [0, 3, 4]);
        let found = cheapest(&cases, "e", &stated, Clock::Wall);
        // 1e-2 with the yardstick's own error on top is more than 1e-2.
        assert_eq!((found[0].case, found[0].explicit, found[0].factor), (Some(3), Some(4), Some(20.0)));
        assert_eq!((found[1].case, found[1].factor), (Some(4), Some(1.0)));
        assert_eq!((found[2].case, found[2].explicit, found[2].factor), (None, None, None));
    }
}
