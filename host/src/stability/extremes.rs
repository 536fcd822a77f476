//! Answers of a law to extreme input: a value or a refusal for each, against the right one where it is known.

mod archard;

use serde::Serialize;

use crate::law::{
    BatchBuilder, BatchError, CallNumbers, Claim, EvaluateError, Evaluation, Evaluator, Field, Indices, Outputs, Values,
};

/// A point that a law is asked at, in the scene's units.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// The law's constants, in its order.
    pub constants: Vec<f64>,
    /// Contact pressure.
    pub pressure: f64,
    /// Sliding velocity.
    pub velocity: f64,
    /// Duration of the substep.
    pub dt: f64,
}

/// What else the law is told, the same in all cases.
#[derive(Clone, Debug, PartialEq)]
pub struct Surroundings {
    /// Numbers of a call; its duration is that of the case.
    pub numbers: CallNumbers,
    /// Temperature, for laws that read it.
    pub temperature: f64,
    /// Friction coefficient, for laws that read it.
    pub friction: f64,
    /// State variables of the point.
    pub state: Vec<f64>,
}

/// What a law answered.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Answer {
    /// An increment of wear depth.
    Value(f64),
    /// A wish for a substep shorter by this factor.
    Cut(f64),
    /// A refusal, in its own words.
    Refused(String),
}

/// What the right answer is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Expected {
    /// This value, to the relative accuracy that a check in logarithms has.
    Value(f64),
    /// A refusal.
    Refused,
}

/// One case and its answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Extreme {
    /// The input, in words.
    pub input: String,
    /// What the law answered.
    pub answer: Answer,
    /// The right answer, where it is known.
    pub expected: Option<Expected>,
    /// Whether it is the right one; `None`: not known.
    pub right: Option<bool>,
}

/// Relative accuracy of the values that are expected: logarithms of large numbers cost digits.
const ACCURACY: f64 = 1e-9;
const SMALLEST: f64 = 5e-324;

/// Asks a law for its answers to extreme input around an ordinary point.
///
/// # Errors
/// A law that reads what is not told here.
pub fn table(evaluator: &dyn Evaluator, point: &Point, around: &Surroundings) -> Result<Vec<Extreme>, BatchError> {
    let law = evaluator.descriptor();
    let archard = law.name == "archard" && law.constants.len() == 4;
    let mut cases = cases(point);
    if archard {
        cases.extend(archard::cases(point));
    }
    let no_pressure = law.claims(Claim::ZeroWithoutPressure);
    let mut rows = Vec::with_capacity(cases.len());
    for (input, point) in cases {
        let expected = match archard {
            true => Some(archard::expected(&point)),
            false if point.dt == 0.0 && law.claims(Claim::LinearInDt) => Some(Expected::Value(0.0)),
            false if no_pressure && point.pressure <= 0.0 => Some(Expected::Value(0.0)),
            false => None,
        };
        let answer = ask(evaluator, &point, around)?;
        let right = expected.map(|expected| fits(&answer, expected));
        rows.push(Extreme { input, answer, expected, right });
    }
    Ok(rows)
}

/// Cases that every law meets, in its own fields.
fn cases(point: &Point) -> Vec<(String, Point)> {
    let case = |input: &str, change: &dyn Fn(&mut Point)| {
        let mut changed = point.clone();
        change(&mut changed);
        (input.to_owned(), changed)
    };
    vec![
        case("an ordinary point", &|_| {}),
        case("pressure 0", &|p| p.pressure = 0.0),
        case("pressure -0", &|p| p.pressure = -0.0),
        case("pressure negative", &|p| p.pressure = -p.pressure),
        case("pressure 5e-324 (subnormal)", &|p| p.pressure = SMALLEST),
        case("pressure 1e300", &|p| p.pressure = 1e300),
        case("pressure NaN", &|p| p.pressure = f64::NAN),
        case("pressure infinite", &|p| p.pressure = f64::INFINITY),
        case("velocity 0", &|p| p.velocity = 0.0),
        case("velocity negative", &|p| p.velocity = -p.velocity),
        case("velocity 5e-324 (subnormal)", &|p| p.velocity = SMALLEST),
        case("velocity 1e300", &|p| p.velocity = 1e300),
        case("velocity NaN", &|p| p.velocity = f64::NAN),
        case("pressure and velocity 1e300", &|p| (p.pressure, p.velocity) = (1e300, 1e300)),
        case("dt 0", &|p| p.dt = 0.0),
        case("dt 1e300", &|p| p.dt = 1e300),
        case("dt NaN", &|p| p.dt = f64::NAN),
    ]
}

/// The law at one point.
fn ask(evaluator: &dyn Evaluator, point: &Point, around: &Surroundings) -> Result<Answer, BatchError> {
    let law = evaluator.descriptor();
    let Point { pressure, velocity, dt, .. } = *point;
    // A negative pressure causes no friction; what is no number stays none.
    let pressing = if pressure < 0.0 { 0.0 } else { pressure };
    let shear = around.friction * pressing;
    let against = if velocity == 0.0 { 0.0 } else { -velocity.signum() };
    let up = [0.0, 0.0, 1.0];
    let batch = BatchBuilder::new(law, 1)
        .numbers(CallNumbers { dt, ..around.numbers })
        .constants(&point.constants)
        .state(Values::PerPoint(&around.state))
        .field(Field::Pressure, Values::Uniform(pressure))
        .field(Field::NodalTraction, Values::Uniform(pressure))
        // What the host makes of a signed velocity is its size.
        .field(Field::Velocity, Values::Uniform(velocity))
        .field(Field::Slip, Values::Uniform(velocity.abs() * dt))
        .field(Field::SlipVector, Values::UniformVector([velocity * dt, 0.0, 0.0]))
        .field(Field::FrictionStress, Values::UniformVector([against * shear, 0.0, 0.0]))
        .field(Field::FrictionCoefficient, Values::Uniform(around.friction))
        .field(Field::FrictionWork, Values::Uniform(shear * velocity.abs() * dt))
        .field(Field::Temperature, Values::Uniform(around.temperature))
        .field(Field::CounterTemperature, Values::Uniform(around.temperature))
        .field(Field::Normal, Values::UniformVector(up))
        .field(Field::Tangent, Values::UniformVector([1.0, 0.0, 0.0]))
        .field(Field::Coordinates, Values::UniformVector([0.0; 3]))
        .field(Field::AccumulatedWear, Values::Uniform(0.0))
        .field(Field::AccumulatedSlip, Values::Uniform(0.0))
        .field(Field::Gap, Values::Uniform(0.0))
        .field(Field::Area, Values::Uniform(1.0))
        .indices(Field::ContactState, Indices::Uniform(if pressure > 0.0 { 2 } else { 0 }))
        .indices(Field::PointId, Indices::Uniform(0))
        .indices(Field::ElementId, Indices::Uniform(0))
        .build()?;
    let (mut increment, mut direction) = ([0.0], [0.0; 3]);
    let mut state = vec![0.0; law.state.len()];
    let mut outputs = Outputs::new(&mut increment);
    outputs.state = (!state.is_empty()).then_some(&mut state[..]);
    outputs.direction = law.writes(crate::law::OutputItem::Direction).then_some(&mut direction[..]);
    Ok(match evaluator.evaluate(&batch, &mut outputs) {
        Ok(Evaluation::Good | Evaluation::Unreliable { .. }) => Answer::Value(increment[0]),
        Ok(Evaluation::CutStep { factor, .. }) => Answer::Cut(factor),
        Err(error) => Answer::Refused(words(&error)),
    })
}

fn words(error: &EvaluateError) -> String {
    error.to_string().lines().next().unwrap_or_default().to_owned()
}

fn fits(answer: &Answer, expected: Expected) -> bool {
    match (answer, expected) {
        (Answer::Refused(_), Expected::Refused) => true,
        (Answer::Value(found), Expected::Value(value)) => {
            // Below the normal range one unit of the last place is all that is left.
            (found - value).abs() <= (ACCURACY * value.abs()).max(2.0 * SMALLEST) && (value != 0.0 || *found == 0.0)
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::{Plugin, embedded};

    fn rows(constants: [f64; 4]) -> Vec<Extreme> {
        let plugin = Plugin::from_entry(embedded::entry("archard").unwrap()).unwrap();
        let law = plugin.law(None).unwrap().create(None).unwrap();
        let point = Point { constants: constants.to_vec(), pressure: 1e8, velocity: 0.5, dt: 2.0 };
        let around =
            Surroundings { numbers: CallNumbers::default(), temperature: 0.0, friction: 0.0, state: Vec::new() };
        table(&law, &point, &around).unwrap()
    }

    #[test]
    fn the_law_of_the_program_gives_the_right_answers_whatever_its_exponents() {
        for constants in [[1e-4, 1e10, 1.0, 1.0], [1e-8, 1e9, 2.0, 0.0], [1e-3, 1e9, 0.5, 1.0], [1e-4, 1e9, 0.0, 2.0]] {
            let rows = rows(constants);
            assert!(rows.len() > 25, "{}", rows.len());
            let wrong: Vec<&Extreme> = rows.iter().filter(|row| row.right != Some(true)).collect();
            assert!(wrong.is_empty(), "{constants:?}: {wrong:#?}");
        }
    }

    #[test]
    fn known_answers_stand_in_the_table() {
        let rows = rows([1e-4, 1e10, 1.0, 1.0]);
        let answer = |input: &str| rows.iter().find(|row| row.input == input).map(|row| row.answer.clone()).unwrap();
        assert_eq!(answer("an ordinary point"), Answer::Value(1e-6));
        assert_eq!(answer("velocity negative"), Answer::Value(1e-6));
        for input in ["pressure 0", "pressure negative", "velocity 0", "dt 0", "K = 0", "m = 0 and pressure 0"] {
            assert_eq!(answer(input), Answer::Value(0.0), "{input}");
        }
        for input in ["pressure NaN", "velocity NaN", "K negative", "H = 0", "m = 0 and pressure NaN"] {
            assert!(matches!(answer(input), Answer::Refused(_)), "{input}");
        }
        let Answer::Value(huge) = answer("K = 1e-300, pressure 1e9, m = 40: overflow only in between") else {
            panic!()
        };
        assert!((huge / 1e60 - 1.0).abs() < 1e-12, "{huge}");
    }

    #[test]
    fn a_wrong_answer_is_told_from_a_right_one() {
        assert!(fits(&Answer::Value(1.0 + 1e-12), Expected::Value(1.0)));
        assert!(!fits(&Answer::Value(1.0 + 1e-6), Expected::Value(1.0)));
        assert!(!fits(&Answer::Value(1e-300), Expected::Value(0.0)));
        assert!(!fits(&Answer::Value(0.0), Expected::Refused));
        assert!(!fits(&Answer::Cut(0.5), Expected::Value(0.0)));
    }
}
