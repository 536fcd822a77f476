//! What must hold for any prescribed history: wear only grows, and scaling, permuting or cutting changes what it should.

#[path = "support/solved.rs"]
mod solved;

use proptest::prelude::*;
use solved::{Case, archard};

/// Pressures and velocities [time][point] of a history, and the constants it is run with.
#[derive(Clone, Debug)]
struct Given {
    times: Vec<f64>,
    pressure: Vec<Vec<f64>>,
    velocity: Vec<Vec<f64>>,
    m: f64,
    n: f64,
}

impl Given {
    fn points(&self) -> usize {
        self.pressure[0].len()
    }

    fn csv(&self) -> String {
        let mut csv = "time,point,pressure,velocity\n".to_owned();
        for (k, time) in self.times.iter().enumerate() {
            for i in 0..self.points() {
                csv.push_str(&format!("{time:?},{i},{:?},{:?}\n", self.pressure[k][i], self.velocity[k][i]));
            }
        }
        csv
    }

    fn case(&self, scale: f64, rest: &str) -> Case {
        let law = format!("constants = [{:?}, 1e9, {:?}, {:?}]", 1e-4 * scale, self.m, self.n);
        Case::history(&law, &self.csv(), rest)
    }

    fn wear(&self, rest: &str) -> Vec<f64> {
        self.case(1.0, rest).wear()
    }

    fn map(mut self, pressure: impl Fn(f64) -> f64, velocity: impl Fn(f64) -> f64, time: impl Fn(f64) -> f64) -> Self {
        self.pressure.iter_mut().flatten().for_each(|p| *p = pressure(*p));
        self.velocity.iter_mut().flatten().for_each(|v| *v = velocity(*v));
        self.times.iter_mut().for_each(|t| *t = time(*t));
        self
    }
}

/// Histories of two to four times at one to six points; pressures and velocities of either sign, and zeros.
fn given(linear: bool) -> impl Strategy<Value = Given> {
    (2_usize..5, 1_usize..7).prop_flat_map(move |(rows, points)| {
        let column = |least: f64, most: f64| {
            let value = prop_oneof![9 => least..most, 1 => Just(0.0)];
            prop::collection::vec(prop::collection::vec(value, points), rows)
        };
        let exponent = if linear { 1.0..1.0000001 } else { 0.3..2.5 };
        let lengths = prop::collection::vec(0.1..3.0, rows);
        (lengths, column(-2e6, 5e6), column(-0.3, 0.3), exponent.clone(), exponent).prop_map(
            move |(lengths, pressure, velocity, m, n)| {
                let times = lengths.iter().scan(0.0, |time, length| Some(std::mem::replace(time, *time + length)));
                let (m, n) = if linear { (1.0, 1.0) } else { (m, n) };
                Given { times: times.collect(), pressure, velocity, m, n }
            },
        )
    })
}

const TOLERANCE: &str = "[integrator]\ntolerance = 1e-6\n";
const FIXED: &str = "[integrator]\nsubsteps = 3\n";

fn close(a: &[f64], b: &[f64], tolerance: f64) -> bool {
    let norm = |values: &[f64]| values.iter().map(|x| x * x).sum::<f64>().sqrt();
    let difference: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
    a.len() == b.len() && norm(&difference) <= tolerance * norm(b)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, ..ProptestConfig::default() })]

    #[test]
    fn wear_is_never_negative_and_never_decreases(given in given(false)) {
        let solved = given.case(1.0, TOLERANCE).solve(&archard());
        prop_assert!(solved.record.wear.iter().all(|w| *w >= 0.0 && w.is_finite()));
        let rows = &solved.record.history.rows;
        prop_assert!(rows.windows(2).all(|pair| pair[0].max_wear_depth <= pair[1].max_wear_depth));
        for i in 0..given.points() {
            if given.pressure.iter().all(|row| row[i] <= 0.0) || given.velocity.iter().all(|row| row[i] == 0.0) {
                prop_assert_eq!(solved.record.wear[i], 0.0);
            }
        }
    }

    #[test]
    fn twice_the_pressure_is_twice_the_wear_to_the_bit(given in given(true)) {
        let (one, two) = (given.wear(TOLERANCE), given.map(|p| 2.0 * p, |v| v, |t| t).wear(TOLERANCE));
        prop_assert_eq!(one.iter().map(|w| 2.0 * w).collect::<Vec<_>>(), two);
    }

    #[test]
    fn twice_the_speed_in_half_the_time_is_the_same_wear(given in given(true)) {
        for accuracy in ["[integrator]\ntolerance = 1e-13\n", FIXED] {
            let (one, two) = (given.wear(accuracy), given.clone().map(|p| p, |v| 2.0 * v, |t| 0.5 * t).wear(accuracy));
            prop_assert!(close(&two, &one, 1e-12), "{:?} {:?}", one, two);
        }
    }

    #[test]
    fn permuted_points_have_permuted_wear_to_the_bit(given in given(false), turn in 0_usize..6) {
        let mut other = given.clone();
        for row in other.pressure.iter_mut().chain(&mut other.velocity) {
            let places = row.len();
            row.rotate_left(turn % places);
            row.reverse();
        }
        for accuracy in [FIXED, TOLERANCE] {
            let (mut one, two) = (given.wear(accuracy), other.wear(accuracy));
            let places = one.len();
            one.rotate_left(turn % places);
            one.reverse();
            prop_assert_eq!(one, two);
        }
    }

    #[test]
    fn a_load_step_cut_in_two_is_the_same_within_the_tolerance(given in given(false), part in 0.05..0.95_f64) {
        let whole = given.wear(TOLERANCE);
        let first = part * given.times.last().expect("times");
        let cut = given.wear(&format!("[[step]]\nduration = {first:?}\n[[step]]\n{TOLERANCE}"));
        prop_assert!(close(&cut, &whole, 2e-6), "{:?} {:?}", whole, cut);
    }

    /// With lengths in 2^a, times in 2^b and masses in 2^c of a unit, all numbers scale by powers of two.
    #[test]
    fn units_that_are_powers_of_two_leave_every_bit(given in given(true), a in -20_i32..20, b in -20_i32..20, c in -20_i32..20) {
        let two = |power: i32| f64::from(power).exp2();
        // Pressure: mass / (length time^2); the coefficient K/H is one over a pressure.
        let pressure = two(a + 2 * b - c);
        let scaled = given.clone().map(|p| p * pressure, |v| v * two(b - a), |t| t * two(-b));
        let one = given.wear(TOLERANCE);
        let other = scaled.case(1.0 / pressure, TOLERANCE).wear();
        prop_assert_eq!(one.iter().map(|w| w * two(-a)).collect::<Vec<_>>(), other);
    }
}
