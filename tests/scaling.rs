//! Scaling of the wear increment: scaled runs against unscaled ones at represented time, and what their histories say.

#[allow(dead_code)] // reason: a part of these laws is for other tests.
#[path = "wear_reference/laws.rs"]
mod laws;
#[path = "support/solved.rs"]
mod solved;

use laws::{RunningIn, Work};
use solved::{Case, archard, memory, near};
use wearlaw::plan::Plan;
use wearlaw::record::{End, HistoryRow, Nobody, Record};
use wearlaw::scene::Scene;
use wearlaw::solve::{Run, SolveError};

/// A cylinder on springs: K/H = 1e-14, load per length.
const CYLINDER: &str = "[law]\nuse = \"archard\"\nconstants = { K = 1e-4, H = 1e10 }\n\
    [contact]\nmodel = \"foundation\"\ndimension = 2\nstiffness = 1e13\n[grid]\nsize = [1.2e-3]\ncells = [120]\n\
    [surface]\nshape = \"cylinder\"\nradius = 1e-2\n";

fn solve(scene: &str) -> Record<SolveError> {
    let law = archard();
    let scene = Scene::parse(scene, "scene.toml", &[]).unwrap_or_else(|error| panic!("{error:?}\n{scene}"));
    let plan = Plan::new(&scene, law_of(&law)).unwrap_or_else(|error| panic!("{error:?}"));
    let record = Run::prepare(&plan, &law).expect("a surface").go(1, &mut Nobody);
    assert!(matches!(record.end, End::Done), "{:?}", record.end);
    record
}

fn law_of(law: &dyn wearlaw::law::Evaluator) -> &wearlaw::law::LawDescriptor {
    law.descriptor()
}

fn last<E>(record: &Record<E>) -> HistoryRow {
    *record.history.last().expect("rows")
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    let norm = |values: &mut dyn Iterator<Item = f64>| values.map(|v| v * v).sum::<f64>().sqrt();
    norm(&mut a.iter().zip(b).map(|(a, b)| a - b)) / norm(&mut b.iter().copied())
}

/// Times add up, factors are at least 1, and no row leaves out what its step stood for.
#[track_caller]
fn columns_add_up(record: &Record<SolveError>) {
    let (mut time, mut simulated) = (0.0, 0.0);
    for row in &record.history.rows {
        time += row.dt;
        simulated += row.dt / row.scale;
        assert!(row.scale >= 1.0 - 1e-12 || row.time == last(record).time, "{row:?}");
        near(time.max(1e-300), row.time.max(1e-300), 1e-9);
        near(simulated.max(1e-300), row.simulated_time.max(1e-300), 1e-9);
    }
}

#[test]
fn scaled_substeps_end_where_unscaled_ones_do_with_fewer_of_them() {
    let scene = |more: &str| {
        format!(
            "{CYLINDER}[[step]]\nduration = 100.0\nload = 1000.0\nvelocity = 1.0\n[integrator]\nsubsteps = 400\n{more}"
        )
    };
    let plain = solve(&scene(""));
    let mut before = f64::INFINITY;
    let mut steps = 400;
    for (safety, bound) in [(0.02, 5e-3), (0.1, 3e-2), (0.4, 2e-1)] {
        let scaled = solve(&scene(&format!("[scaling]\nkind = \"auto\"\nsafety = {safety}\n")));
        columns_add_up(&scaled);
        let end = last(&scaled);
        assert_eq!((end.time, last(&plain).time), (100.0, 100.0), "the last scaled substep lands on the end");
        assert!(scaled.cost.steps < steps, "{} substeps with C1 = {safety}", scaled.cost.steps);
        assert!(end.simulated_time < before);
        (steps, before) = (scaled.cost.steps, end.simulated_time);
        // Load and speed are constant: the worn area is c P t whatever the factor.
        near(end.wear_volume.unwrap(), 1e-14 * 1000.0 * 100.0, 1e-9);
        near(end.sliding_distance, 100.0, 1e-12);
        let error = distance(&scaled.wear, &plain.wear);
        assert!(error < bound, "C1 = {safety}: {error:e}");
        // A factor is C1 over the change of pressure that the substep before made, whatever that one stood for.
        assert!(scaled.history.rows.iter().any(|row| row.scale > 2.0));
    }
    let held = solve(&scene("[scaling]\nkind = \"auto\"\nmaximum = 1.0\n"));
    assert!(held.cost.steps == 400 && distance(&held.wear, &plain.wear) < 1e-12, "C2 = 1 scales nothing");
}

#[test]
fn scaled_cycles_end_where_unscaled_ones_do_and_count_what_they_stand_for() {
    let scene = |more: &str| {
        format!(
            "{CYLINDER}[[cycle]]\ncount = 300\n[[cycle.step]]\nduration = 0.1\nload = 1000.0\nvelocity = 1.0\n\
             [[cycle.step]]\nduration = 0.2\nload = 400.0\nvelocity = 0.5\nramp = [\"load\"]\n\
             [integrator]\nsubsteps = 2\n{more}"
        )
    };
    let plain = solve(&scene(""));
    for (safety, bound) in [(0.05, 1e-2), (0.2, 6e-2)] {
        let scaled = solve(&scene(&format!("[scaling]\nkind = \"cycle\"\nsafety = {safety}\n")));
        columns_add_up(&scaled);
        let (end, whole) = (last(&scaled), last(&plain));
        near(end.time, 90.0, 1e-12);
        assert_eq!((end.cycle, whole.cycle), (300.0, 300.0), "the last scaled cycle lands on the end");
        assert!(scaled.cost.steps * 2 < plain.cost.steps, "{} against {}", scaled.cost.steps, plain.cost.steps);
        near(end.sliding_distance, whole.sliding_distance, 1e-9);
        let error = distance(&scaled.wear, &plain.wear);
        assert!(error < bound, "C1 = {safety}: {error:e}");
        let rows = &scaled.history.rows;
        assert!(rows.iter().take_while(|row| row.cycle <= 1.0).all(|row| row.scale == 1.0), "the first is unscaled");
        assert!(rows.iter().any(|row| row.scale > 2.0));
        // The four substeps of a simulated cycle stand for the same number of cycles.
        let ends: Vec<&HistoryRow> = rows[1..].chunks(4).map(|cycle| &cycle[3]).collect();
        let mut done = 0.0;
        for end in ends {
            done += end.scale;
            near(end.cycle, done, 1e-9);
        }
    }
}

/// The same scene refined, `kind = "self"`, has the error of the scaling in it, or says that it has not.
#[test]
fn a_scaled_run_is_held_to_an_unscaled_one_where_that_can_be_paid_for() {
    // A hundred time units of sliding, in so many cycles.
    let scene = |count: u64, integrator: &str, more: &str| {
        let duration = 100.0 / count as f64;
        format!(
            "{CYLINDER}[[cycle]]\ncount = {count}\n[[cycle.step]]\nduration = {duration:e}\nload = 1000.0\nvelocity = 1.0\n\
             [integrator]\n{integrator}\n{more}"
        )
    };
    let scaled = "[scaling]\nkind = \"cycle\"\nsafety = 0.3\n[reference]\nkind = \"self\"\n";
    let run = |count: u64, integrator: &str| {
        let solved = Case::text(&scene(count, integrator, scaled)).solve(&archard());
        (solved.error.expect("it names a reference"), solved.record)
    };
    let plain = solve(&scene(1000, "substeps = 32", ""));
    for (integrator, said) in [("substeps = 2", "in 16 times as many substeps"), ("tolerance = 1e-2", "tighter")] {
        let (error, record) = run(1000, integrator);
        assert!(record.cost.steps < 1000, "{} steps", record.cost.steps);
        assert!(error.reference.contains("without scaling") && error.reference.contains(said), "{}", error.reference);
        if integrator == "substeps = 2" {
            let found = distance(&record.wear, &plain.wear);
            assert!(found > 1e-4, "the scaling costs {found:e}");
            near(error.value, found, 0.05);
        }
    }
    let (error, record) = run(100_000_000, "substeps = 2");
    assert!(record.cost.steps < 10_000, "{} steps", record.cost.steps);
    assert!(error.reference.contains("the error of the scaling is not in it"), "{}", error.reference);
}

#[test]
fn no_factor_pushes_a_point_through_the_gap() {
    // A held approach: at most the overlap can go.
    for (kind, loading) in [
        ("auto", "[[step]]\nduration = 1000.0\napproach = 2e-6\nvelocity = 1.0\n"),
        ("cycle", "[[cycle]]\ncount = 1000\n[[cycle.step]]\nduration = 1.0\napproach = 2e-6\nvelocity = 1.0\n"),
    ] {
        for method in ["auto", "implicit-euler"] {
            let record = solve(&format!(
                "{CYLINDER}{loading}[integrator]\nmethod = \"{method}\"\nsubsteps = 5\n\
                 [scaling]\nkind = \"{kind}\"\nsafety = 0.99\nmaximum = 1e9\n"
            ));
            let spacing = 1.2e-3 / 120.0;
            for (cell, wear) in record.wear.iter().enumerate() {
                let x = (cell as f64 - 60.0) * spacing;
                let overlap = (2e-6 - x * x / 2e-2).max(0.0);
                assert!(*wear <= overlap + 1e-15, "{kind}, {method}: cell {cell} wore {wear:e} of {overlap:e}");
                assert!(*wear >= 0.9 * (overlap - 2e-8), "{kind}, {method}: cell {cell} wore {wear:e} of {overlap:e}");
            }
        }
    }
}

#[test]
fn ten_thousand_cycles_are_a_scene_of_ten_lines() {
    let scene = "law = { use = \"archard\", constants = { K = 1e-6, H = 1e10 } }\n\
        contact = { model = \"foundation\", stiffness = 1e13 }\n\
        grid = { size = [6e-4, 6e-4], cells = [24, 24] }\n\
        surface = { shape = \"sphere\", radius = 5e-3 }\n\
        integrator = { substeps = 2 }\n\
        scaling = { kind = \"cycle\" }\n\
        cycle = [{ count = 10000, step = [{ duration = 0.1, load = 4.0, velocity = 1.0 }] }]\n";
    assert!(scene.lines().count() <= 10);
    let record = solve(scene);
    let end = last(&record);
    assert_eq!(end.cycle, 10_000.0);
    near(end.time, 1000.0, 1e-12);
    near(end.wear_volume.unwrap(), 1e-16 * 4.0 * 1000.0, 1e-9);
    assert!(record.cost.steps < 2_000, "{} steps", record.cost.steps);
}

/// Pressure and speed go up and down in every cycle of two time units.
const BREATH: &str = "time,point,pressure,velocity,area\n0,0,1e8,0.1,1e-8\n0,1,2e8,-0.1,1e-8\n1,0,3e8,0.2,1e-8\n\
    1,1,0,0.1,1e-8\n2,0,1e8,0.1,1e-8\n2,1,2e8,-0.1,1e-8\n";

#[test]
fn one_simulated_cycle_of_a_prescribed_scene_stands_for_what_is_left() {
    let law = "constants = { K = 1e-4, H = 1e10, m = 1.2 }";
    let tight = "[integrator]\ntolerance = 1e-9\n";
    let one = Case::history(law, BREATH, &format!("[[cycle]]\ncount = 1\n{tight}")).wear();
    let record = |more: &str| {
        Case::history(law, BREATH, &format!("[[cycle]]\ncount = 5000\n{tight}[scaling]\nkind = \"cycle\"\n{more}"))
            .solve(&archard())
            .record
    };
    let scaled = record("");
    let scales = |record: &Record<SolveError>| {
        let mut scales: Vec<f64> = record.history.rows.iter().map(|row| row.scale).collect();
        scales.dedup();
        scales
    };
    assert_eq!(scales(&scaled), [1.0, 4999.0]);
    let limited = record("maximum = 1500");
    assert_eq!(scales(&limited), [1.0, 1500.0, 499.0], "C2 three times, then what is left");
    for record in [&scaled, &limited] {
        columns_add_up(record);
        let end = last(record);
        assert_eq!((end.cycle, end.time), (5_000.0, 10_000.0));
        for (found, one) in record.wear.iter().zip(&one) {
            near(*found, 5e3 * one, 1e-8);
        }
    }
    near(last(&scaled).simulated_time, 4.0, 1e-9);
    near(last(&limited).simulated_time, 10.0, 1e-9);
}

#[test]
fn slip_friction_work_time_and_memory_are_those_of_the_represented_cycles() {
    let scene = |scaling: &str| format!("[[cycle]]\ncount = 20\n[integrator]\ntolerance = 1e-6\n{scaling}");
    let cycle = "[scaling]\nkind = \"cycle\"\n";
    let both = |law: &str, evaluator: &dyn wearlaw::law::Evaluator, more: &str| {
        [scene(""), scene(cycle)]
            .map(|scene| Case::history(law, BREATH, &format!("{more}{scene}")).solve(evaluator).record)
    };
    // Wear by friction work: it is the work that is scaled.
    let [plain, scaled] = both("constants = [1e-12]", &memory::<Work>(None), "friction = 0.3\n");
    plain.wear.iter().zip(&scaled.wear).for_each(|(plain, scaled)| near(*scaled, *plain, 1e-6));
    // A law that remembers its distance sees the represented one.
    let [plain, scaled] = both("constants = [1e-12, 1e-13, 0.04]", &memory::<RunningIn>(None), "");
    plain.state.iter().zip(&scaled.state).for_each(|(plain, scaled)| near(*scaled, *plain, 1e-9));
    assert!(plain.state[0] > 4.0, "{}", plain.state[0]);
    // Constants change with represented time: from one to three times the wear over all cycles, twice it on average.
    let table =
        "[[law.table]]\ntime = 0.0\nconstants = [1e-4, 1e10]\n[[law.table]]\ntime = 1000.0\nconstants = [3e-4, 1e10]\n";
    let steps = |scaling: &str| {
        format!("[[cycle]]\ncount = 500\n[[cycle.step]]\nduration = 2\npressure = 1e8\nvelocity = 0.1\n{scaling}")
    };
    for scaling in ["", cycle] {
        let wear = Case::steps(table, &steps(scaling)).wear()[0];
        near(wear, 2.0 * 1e-14 * 1e8 * 0.1 * 1000.0, 1e-9);
    }
}
