//! Random scenes of solved contact over all options and magnitudes: what finishes keeps the conditions of contact, what
//! does not has a reason that the scene itself shows.
//!
//! `WEARLAW_RANDOM_SCENES=1000` goes through so many instead of a hundred.

#[path = "random_scenes/conditions.rs"]
mod conditions;
#[path = "random_scenes/draw.rs"]
mod draw;
#[path = "random_scenes/feasible.rs"]
mod feasible;
#[allow(dead_code)] // other targets take the rest of it
#[path = "wear_reference/laws.rs"]
mod laws;
#[path = "random_scenes/ploughing.rs"]
mod ploughing;
#[path = "support/random.rs"]
mod random;
#[path = "support/solved.rs"]
mod solved;
#[path = "random_scenes/units.rs"]
mod units;
#[path = "random_scenes/warm.rs"]
mod warm;

use std::collections::BTreeMap;

use conditions::Growing;
use draw::{Drawn, Law};
use solved::{Case, archard, memory};
use wearlaw::law::LawInstance;
use wearlaw::record::End;
use wearlaw::solve::Run;

/// The laws, made once.
struct Laws([LawInstance; 6]);

impl Laws {
    fn new() -> Self {
        Laws([
            archard(),
            memory::<laws::RunningIn>(None),
            memory::<laws::Work>(None),
            memory::<ploughing::Ploughing>(None),
            memory::<laws::ImpatientRate>(None),
            memory::<warm::Warm>(None),
        ])
    }

    fn of(&self, law: Law) -> &LawInstance {
        &self.0[match law {
            Law::Archard(_) => 0,
            Law::RunningIn => 1,
            Law::Work => 2,
            Law::Ploughing => 3,
            Law::Impatient => 4,
            Law::Warm => 5,
        }]
    }
}

/// A scene with its files.
fn case(drawn: &Drawn) -> Case {
    let case = Case::text(&drawn.text);
    drawn.files.iter().for_each(|(name, text)| case.file(name, text));
    case
}

/// How a scene ended: finished, or an error that the scene explains. `Err`: a fault.
fn go(drawn: &Drawn, laws: &Laws) -> Result<&'static str, String> {
    let law = laws.of(drawn.law);
    let case = case(drawn);
    let plan = match case.try_plan(law) {
        Ok(plan) => plan,
        Err(error) => return feasible::refused(&error, drawn).ok_or_else(|| format!("{error:?}")),
    };
    let run = Run::prepare(&plan, law).map_err(|error| error.to_string())?;
    let mut growing = Growing::default();
    let record = run.go(1, &mut growing);
    let kept = conditions::check(&plan, &record);
    if let Some(step) = growing.fell {
        return Err(format!("a depth fell in step {step}"));
    }
    match &record.end {
        End::Done | End::Stopped(_) => kept.map(|()| "finished"),
        End::Failed(error) => {
            feasible::explained(error, &plan, &record, drawn).ok_or_else(|| format!("{error}\n{error:?}"))
        }
        End::Interrupted => Err("it does not end".to_owned()),
    }
}

#[test]
fn random_scenes_finish_or_show_why_not() {
    let asked = std::env::var("WEARLAW_RANDOM_SCENES").ok().map(|text| text.parse().expect("a number of scenes"));
    let count: u64 = asked.unwrap_or(100);
    let laws = Laws::new();
    let mut ends: BTreeMap<&str, u64> = BTreeMap::new();
    let mut faults = Vec::new();
    for seed in 1..=count {
        let drawn = draw::draw(seed, draw::units(seed));
        match go(&drawn, &laws) {
            Ok(end) => *ends.entry(end).or_default() += 1,
            Err(what) => {
                let fault = format!("seed {seed}: {what}\n{}", drawn.text);
                // Told at once: the scenes behind it may take long.
                println!("{fault}");
                faults.push(seed);
            }
        }
    }
    let finished = ends.get("finished").copied().unwrap_or(0);
    println!("{count} scenes: {ends:?}, {} faults", faults.len());
    assert!(faults.is_empty(), "faults in the scenes of the seeds {faults:?}");
    assert!(finished * 5 >= count * 4, "{finished} of {count} finished");
}
