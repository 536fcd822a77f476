//! Laws that a contact solve has to look at closely.

use crate::laws::{Impatient, ImpatientRate, RunningIn, RunningInFirstOrder, Slowing, Work};
use crate::solved::{Case, archard, memory, near};
use wearlaw::law::memory::{MemoryInputs, MemoryLaw, MemoryOutputs};
use wearlaw::law::{Claim, Claims, Degree, Field, Flag, Flags, LawDescriptor};
use wearlaw::record::End;
use wearlaw_plugin_api::abi::WL_OK;

/// One spring cell under a law of constants [k] and degree `degree`: increment = k f(p) slip.
macro_rules! spring_law {
    ($name:ident, $text:literal, $claimed:expr, $flags:expr, $f:expr) => {
        pub struct $name;
        impl MemoryLaw for $name {
            fn descriptor() -> LawDescriptor {
                LawDescriptor {
                    name: $text.to_owned(),
                    claims: [Claim::LinearInDt].into_iter().collect::<Claims>(),
                    pressure_degree: $claimed,
                    flags: $flags,
                    ..Work::descriptor_with(&[Field::Pressure, Field::Slip])
                }
            }
            fn create(_: Option<&str>) -> Result<Self, String> {
                Ok(Self)
            }
            fn evaluate(&self, inputs: &MemoryInputs<'_>, outputs: &mut MemoryOutputs<'_>) -> i32 {
                let f: fn(f64) -> f64 = $f;
                for i in 0..inputs.points() {
                    let k = inputs.constant(0, i).expect("one constant");
                    let read = |field| inputs.scalar(field, i).expect("a field that is declared");
                    outputs.increment[i] = k * f(read(Field::Pressure)) * read(Field::Slip);
                }
                WL_OK
            }
        }
    };
}

spring_law!(FalseDegree, "false-degree", Degree::Value(1.0), Flags::EMPTY, |p| p * p);
spring_law!(Falling, "falling", Degree::Unclaimed, Flags::EMPTY, |p| 2e16 / (1e8 + p));
spring_law!(Growing, "growing", Degree::Unclaimed, [Flag::OpenPoints].into_iter().collect(), |p| if p > 0.0 {
    0.0
} else {
    1.0
});

/// One cell on a spring of 1e12 that is held at a pressure of 1e8 to begin with.
fn held(law: &str, rest: &str) -> Case {
    solved_case(law, "approach = 1e-4", 10.0, rest)
}

fn solved_case(law: &str, press: &str, duration: f64, rest: &str) -> Case {
    Case::text(&format!(
        "[law]\nuse = \"archard\"\n{law}\n[contact]\nmodel = \"foundation\"\ndimension = 2\nstiffness = 1e12\nfriction = 0.5\n\
         [grid]\nsize = [1e-3]\ncells = [1]\n[surface]\nshape = \"flat-punch\"\nwidth = 1e-3\n\
         [[step]]\nduration = {duration}\n{press}\nvelocity = 1.0\n{rest}"
    ))
}

#[test]
fn every_exponent_wears_a_spring_as_the_closed_form_says() {
    // p^(1-m) = p0^(1-m) - (1-m) k c t, and one backward-Euler step of the same.
    for (m, c, exact) in [(2.0, 1e-21, 5e7), (1.5, 1e-18, (1.05e-4_f64).powi(-2)), (0.5, 1e-9, 2.5e7)] {
        let law = format!("constants = [{c:e}, 1.0, {m}, 1.0]");
        let tight = held(&law, "[integrator]\ntolerance = 1e-8\n").solve(&archard()).record;
        // The same law through its derivative, and through difference quotients where it has none.
        near(tight.pressure[0], exact, 1e-6);
        let none = tight.cost.points_evaluated;
        assert!(none > 0 && tight.warnings.is_empty(), "{:?}", tight.warnings);
    }
    let step = held("constants = [1e-21, 1.0, 2.0, 1.0]", "[integrator]\nmethod = \"implicit-euler\"\nsubsteps = 1\n");
    let long = solved_case(
        "constants = [1e-21, 1.0, 2.0, 1.0]",
        "approach = 1e-4",
        1e3,
        "[integrator]\nmethod = \"implicit-euler\"\nsubsteps = 1\n",
    );
    near(long.solve(&archard()).record.pressure[0], 9512492.19725039, 1e-9);
    // 1e-3 p^2 / 1e5 + p = 1e8 at dt = 10: the positive root of 1e-8 p^2 + p - 1e8.
    near(step.solve(&archard()).record.pressure[0], (5.0_f64.sqrt() - 1.0) * 0.5 * 1e8, 1e-9);
}

#[test]
fn a_point_that_is_worn_free_stays_as_it_is() {
    // m < 1 on a spring: extinct at t = 20, from then on open with the depth of the approach.
    let case =
        solved_case("constants = [1e-9, 1.0, 0.5, 1.0]", "approach = 1e-4", 40.0, "[integrator]\ntolerance = 1e-6\n");
    let record = case.solve(&archard()).record;
    assert_eq!(record.pressure[0], 0.0);
    near(record.wear[0], 1e-4, 1e-6);
    assert!(record.wear[0] <= 1e-4 + 1e-11, "{:e}", record.wear[0]);
}

#[test]
fn no_step_is_too_long() {
    // z = dt c k from 10 to 1e12 in one step: nothing is worn beyond the gap that there is.
    for z in [10.0, 1e3, 1e6, 1e12] {
        for method in ["auto", "implicit-euler", "tr-bdf2", "sdirk2"] {
            let law = format!("constants = [{:e}, 1.0, 1.0, 1.0]", z * 1e-13);
            let record =
                held(&law, &format!("[integrator]\nmethod = \"{method}\"\nsubsteps = 1\n")).solve(&archard()).record;
            let worn = record.wear[0] / 1e-4;
            assert!(worn > 0.5 && worn <= 1.0 + 1e-9, "{method} at z = {z:e}: {worn}");
            let told = record.warnings.iter().any(|warning| warning.contains("backward Euler"));
            assert_eq!(
                told,
                matches!(method, "auto" | "tr-bdf2" | "sdirk2"),
                "{method} at z = {z:e}: {:?}",
                record.warnings
            );
        }
    }
}

#[test]
fn a_false_claim_of_degree_one_is_named() {
    let record = held("constants = [1e-22]", "[integrator]\nsubsteps = 2\n").end(&memory::<FalseDegree>(None)).record;
    let End::Failed(error) = &record.end else { panic!("{:?}", record.end) };
    let text = error.to_string();
    assert!(text.contains("claims to be of pressure degree 1") && text.contains("point 0"), "{text}");
}

#[test]
fn a_law_that_falls_with_pressure_is_refused_at_its_point() {
    let record = held("constants = [1e-14]", "[integrator]\nsubsteps = 2\n").end(&memory::<Falling>(None)).record;
    let End::Failed(error) = &record.end else { panic!("{:?}", record.end) };
    let text = error.to_string();
    assert!(text.contains("wears less where the pressure is higher") && text.contains("point 0"), "{text}");
}

#[test]
fn difference_quotients_do_what_a_derivative_does() {
    // Friction work is mu p slip: the same as Archard with c = alpha mu.
    let rest = "[integrator]\nsubsteps = 4\nmethod = \"tr-bdf2\"\n";
    let work = held("constants = [2e-13]", rest).solve(&memory::<Work>(None)).record;
    let same = held("constants = [1e-13, 1.0, 1.0, 1.0]", rest).solve(&archard()).record;
    near(work.wear[0], same.wear[0], 1e-8);
    assert!(work.cost.law_calls > same.cost.law_calls);
}

#[test]
fn memories_and_wishes_are_kept() {
    // Constant load on one cell: the pressure is 1e7 whatever wears.
    let press = "load = 1e4";
    let running = solved_case("constants = [1e-12, 1e-13, 0.04]", press, 0.1, "[integrator]\ntolerance = 1e-6\n");
    let record = running.solve(&memory::<RunningIn>(None)).record;
    near(record.wear[0], 1e7 * (1e-13 * 0.1 + 9e-13 * 0.04 * (1.0 - (-0.1_f64 / 0.04).exp())), 1e-9);
    near(record.state[0], 0.1, 1e-12);
    let slowing = solved_case("constants = [1e-13, 1e-7]", press, 0.2, "[integrator]\ntolerance = 1e-5\n");
    near(slowing.solve(&memory::<Slowing>(None)).record.wear[0], 1e-7 * (5.0_f64.sqrt() - 1.0), 2e-5);
    for accuracy in ["substeps = 2", "tolerance = 1e-4"] {
        let rest = format!("[integrator]\n{accuracy}\n");
        let case = solved_case("constants = [1e-13, 0.003]", press, 0.2, &rest);
        for record in [case.solve(&memory::<Impatient>(None)).record, case.solve(&memory::<ImpatientRate>(None)).record]
        {
            near(record.wear[0], 2e-7, 1e-9);
            assert!(record.largest_step <= 0.00301 && record.cost.rejected_steps > 0, "{}", record.largest_step);
        }
        let refused = solved_case("constants = [1e-13, 0.003]", press, 0.2, &format!("{rest}smallest_step = 0.01\n"));
        let End::Failed(error) = refused.end(&memory::<ImpatientRate>(None)).record.end else { panic!("{accuracy}") };
        assert!(error.to_string().contains("smallest step"), "{error}");
    }
}

/// Wears the same in every call, however short the substep.
pub struct PerCall;

impl MemoryLaw for PerCall {
    fn descriptor() -> LawDescriptor {
        LawDescriptor { name: "per-call".to_owned(), ..Work::descriptor_with(&[Field::Pressure]) }
    }
    fn create(_: Option<&str>) -> Result<Self, String> {
        Ok(Self)
    }
    fn evaluate(&self, inputs: &MemoryInputs<'_>, outputs: &mut MemoryOutputs<'_>) -> i32 {
        for i in 0..inputs.points() {
            outputs.increment[i] = inputs.constant(0, i).expect("one constant");
        }
        WL_OK
    }
}

#[test]
fn a_wear_that_depends_on_the_substep_ends_the_run() {
    let text = |rest: &str| {
        let case = solved_case("constants = [1e-9]", "load = 1e4", 0.2, &format!("[integrator]\n{rest}\n"));
        let record = case.end(&memory::<PerCall>(None)).record;
        let End::Failed(error) = &record.end else { panic!("{:?}", record.end) };
        // What was known before the stretch is kept.
        assert_eq!((record.wear[0], record.pressure[0]), (0.0, 1e7));
        error.to_string()
    };
    let stalled = text("tolerance = 1e-4");
    assert!(stalled.contains("depends on the length of the substep") && stalled.contains("100000"), "{stalled}");
    let few = text("tolerance = 1e-4\nmost_substeps = 30");
    assert!(few.contains("with 24 substeps") && few.contains("within 30 (`integrator.most_substeps`)"), "{few}");
}

#[test]
fn wishes_for_short_substeps_are_counted() {
    let rest = "[integrator]\nsubsteps = 2\nmost_substeps = 20\n";
    let case = solved_case("constants = [1e-13, 0.003]", "load = 1e4", 0.2, rest);
    for record in [case.end(&memory::<Impatient>(None)).record, case.end(&memory::<ImpatientRate>(None)).record] {
        let End::Failed(error) = &record.end else { panic!("{:?}", record.end) };
        assert!(error.to_string().contains("expected at most 20 (`integrator.most_substeps`)"), "{error}");
        // The twenty that were taken stand.
        assert_eq!(record.history.rows.len(), 21);
        near(record.wear[0], 1e-6 * record.history.rows[20].time, 1e-9);
    }
}

#[test]
fn open_points_reach_a_law_that_asks_for_them() {
    let case = Case::text(
        "[law]\nuse = \"archard\"\nconstants = [1e-9]\n[contact]\nmodel = \"foundation\"\ndimension = 2\nstiffness = 1e12\n\
         [grid]\nsize = [1e-3]\ncells = [16]\n[surface]\nshape = \"cylinder\"\nradius = 1.0\n\
         [[step]]\nduration = 1\nload = 10.0\nvelocity = 1.0\n[integrator]\nmethod = \"implicit-euler\"\nsubsteps = 1\n",
    );
    let record = case.solve(&memory::<Growing>(None)).record;
    for (pressure, wear) in record.pressure.iter().zip(&record.wear) {
        assert_eq!(*wear, if *pressure > 0.0 { 0.0 } else { 1e-9 });
    }
    assert!(record.wear.iter().filter(|wear| **wear > 0.0).count() > 3, "{:?}", record.wear);
}

/// Pressure beyond which [`Threshold`] wears.
const BEYOND: f64 = 5.639954e6;
spring_law!(Threshold, "threshold", Degree::Unclaimed, Flags::EMPTY, |p| (p - BEYOND).max(0.0));

/// A law that wears beyond a pressure alone leaves the worn cells at that pressure however long it goes on, to so many digits
/// that a relative error of 1e-6 in it would wear through the body.
#[test]
fn cells_at_the_threshold_of_a_law_wear_no_more_than_there_is() {
    for duration in [1e6, 1e8, 1e10] {
        let case = Case::text(&format!(
            "[law]\nuse = \"archard\"\nconstants = [1e-14]\n[contact]\nmodel = \"foundation\"\n\
             stiffness = 7.734186e12\n[grid]\nsize = [5.844455e-4, 5.844455e-4]\ncells = [24, 24]\n\
             [surface]\nshape = \"cone\"\nangle = 1.0\n[[step]]\nduration = {duration:e}\nload = 0.77\nvelocity = 1.0\n\
             [integrator]\nmethod = \"implicit-euler\"\nsubsteps = 1\n"
        ));
        let record = case.solve(&memory::<Threshold>(None)).record;
        let last = record.history.last().expect("rows");
        near(last.max_wear_depth, 3.27e-6, 2e-3);
        assert!(last.max_wear_depth < last.approach.expect("an approach"));
    }
}

#[test]
fn a_law_that_holds_its_state_over_a_substep_is_followed_where_its_rate_falls() {
    // Under a constant load w = p (k_inf s + (k_0 - k_inf) s_0 (1 - exp(-s / s_0))), and the law's rate falls one step late.
    let (pressure, way, kinf) = (1e7, 0.2, 1e-13);
    for (more, part) in [(10.0, 0.3), (10.0, 0.1), (10.0, 0.01), (1e3, 0.3), (1e3, 0.1), (1e3, 0.01)] {
        let (k0, s0) = (more * kinf, part * way);
        let exact = pressure * (kinf * way + (k0 - kinf) * s0 * (1.0 - f64::exp(-way / s0)));
        for tolerance in [0.1, 0.03, 0.01] {
            let rest = format!("[integrator]\ntolerance = {tolerance}\n");
            let case = solved_case(&format!("constants = [{k0}, {kinf}, {s0}]"), "load = 1e4", way, &rest);
            let record = case.solve(&memory::<RunningInFirstOrder>(None)).record;
            let reported = record.estimated.wear_l2_relative.expect("it wears");
            let truth = ((record.wear[0] - exact) / exact).abs();
            assert!(truth <= 1.5 * reported, "{more}, {part}, {tolerance}: {truth:.2e} off, {reported:.2e} reported");
            assert!(reported <= tolerance, "{more}, {part}, {tolerance}: {reported:.2e} reported");
        }
    }
}
