//! Tests of the discrete foundation against closed forms and a fine rule of its own.

use super::super::super::answer::Indenter;
use super::super::parabola::{WornParabola, loaded_pressure};
use super::*;

fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance * expected.abs(), "{found:e}, expected {expected:e}");
}

/// A parabola over cells of length h around its apex.
fn parabola(cells: usize, h: f64, rate: f64) -> Springs {
    let x = |cell: usize| (cell as f64 - (cells / 2) as f64) * h;
    let gap = (0..cells).map(|cell| x(cell) * x(cell) / 20e-3).collect();
    Springs { gap, stiffness: 1e13, area: h, rate: vec![rate] }
}

fn steady(duration: f64, load: f64) -> Stretch {
    Stretch { duration, speed: 1.0, pressing: Pressing::Load([load; 2]) }
}

#[test]
fn a_fine_line_is_the_continuum() {
    let h = 1.14471424255e-4 / 15.0;
    let springs = parabola(141, h, 1e-14);
    let answers = follow(&springs, &[steady(100.0, 1000.0)], &[0.0, 10.0, 100.0]).unwrap();
    for (answer, time) in answers.iter().zip([0.0, 10.0, 100.0]) {
        let exact = WornParabola::new(Indenter::Line, 10e-3, 1e13, 1000.0, 1e-14 * time).unwrap();
        near(answer.pressure[70], exact.at(0.0).pressure, 3e-3);
        near(answer.approach, exact.approach, 3e-3);
        near(answer.wear_depth[70], exact.at(0.0).wear_depth, 3e-3);
        near(answer.pressure.iter().sum::<f64>() * h, 1000.0, 1e-13);
        near(answer.wear_depth.iter().sum::<f64>() * h, 1e-14 * time * 1000.0, 1e-12);
    }
}

#[test]
fn pressures_are_those_of_the_springs_and_cells_join_when_touched() {
    let springs = parabola(61, 1e-5, 1e-14);
    let answers = follow(&springs, &[steady(50.0, 1000.0)], &[3.0, 17.0, 50.0]).unwrap();
    let mut before = 0;
    for answer in &answers {
        let mut touching = 0;
        for cell in 0..61 {
            let pressing = answer.approach - springs.gap[cell] - answer.wear_depth[cell];
            near(answer.pressure[cell], 1e13 * pressing.max(0.0), 1e-11);
            assert!(pressing > 0.0 || answer.wear_depth[cell] == 0.0);
            assert_eq!(answer.pressure[cell].to_bits(), answer.pressure[60 - cell].to_bits(), "{cell}");
            touching += usize::from(pressing > 0.0);
        }
        assert!(touching > before && touching < 61);
        before = touching;
    }
}

#[test]
fn a_set_that_stays_decays_to_its_mean() {
    let springs = Springs { gap: vec![0.0, 3e-8, 1e-3, f64::INFINITY], ..parabola(4, 0.5, 2e-14) };
    let answer = &follow(&springs, &[steady(7.0, 1e6)], &[7.0]).unwrap()[0];
    // p0 = mean +- k 1.5e-8 on two cells of length 1/2.
    for (cell, first) in [(0, 1e6 + 1.5e5), (1, 1e6 - 1.5e5)] {
        near(answer.pressure[cell], loaded_pressure(first, 1e6, 1e13, 2e-14 * 7.0), 1e-13);
    }
    assert_eq!(answer.pressure[2..], [0.0, 0.0]);
}

#[test]
fn rates_of_their_own_decay_to_equal_wear() {
    // Two cells: p' = -k (c1 + c2)/2 (p - equilibrium), c1 p1 = c2 p2 at the end.
    let springs = Springs { gap: vec![0.0, 0.0], stiffness: 1e13, area: 1.0, rate: vec![1e-14, 3e-14] };
    let answer = &follow(&springs, &[steady(9.0, 2e6)], &[9.0]).unwrap()[0];
    let decay = (-1e13 * 2e-14 * 9.0_f64).exp();
    near(answer.pressure[0], 1.5e6 - 0.5e6 * decay, 1e-13);
    near(answer.pressure[1], 0.5e6 + 0.5e6 * decay, 1e-13);
}

#[test]
fn a_touch_comes_at_its_time() {
    // One cell under a load sinks at c p; the second joins after g / (c p), then both share.
    let (c, k, load, gap) = (1e-14, 1e13, 1e6, 2e-7);
    let springs = Springs { gap: vec![0.0, gap], stiffness: k, area: 1.0, rate: vec![c] };
    let touch = (gap - load / k) / (c * load);
    let answers = follow(&springs, &[steady(2.0 * touch, load)], &[0.5 * touch, 1.999 * touch]).unwrap();
    assert_eq!(answers[0].pressure[1], 0.0);
    near(answers[0].wear_depth[0], c * load * 0.5 * touch, 1e-13);
    let decay = (-k * c * 0.999 * touch).exp();
    near(answers[1].pressure[0], load / 2.0 * (1.0 + decay), 1e-12);
    near(answers[1].pressure[1], load / 2.0 * (1.0 - decay), 1e-12);
}

#[test]
fn held_approaches_ramps_and_lift_off() {
    let springs = Springs { gap: vec![0.0, 1e-7], stiffness: 1e13, area: 1.0, rate: vec![1e-14] };
    let held = Stretch { duration: 10.0, speed: 2.0, pressing: Pressing::Approach([2e-7; 2]) };
    let away = Stretch { duration: 5.0, speed: 2.0, pressing: Pressing::Approach([2e-7, 0.0]) };
    let rest = Stretch { duration: 5.0, speed: 2.0, pressing: Pressing::Load([0.0; 2]) };
    let times = [10.0, 12.0, 15.0, 20.0];
    let answers = follow(&springs, &[held, away, rest], &times).unwrap();
    let decay = (-1e13 * 2e-14 * 10.0_f64).exp();
    near(answers[0].pressure[0], 2e6 * decay, 1e-12);
    near(answers[0].pressure[1], 1e6 * decay, 1e-12);
    // Lifted off at once, for hardly any pressure was left; wear stays to the bit.
    assert_eq!(answers[1].pressure, [0.0, 0.0]);
    assert_eq!(answers[1].wear_depth, answers[3].wear_depth);
    near(answers[3].approach, answers[3].wear_depth[0], 1e-14);
    // dp/dt = k (D' - c v p) with D' = -u gives p = (p0 + u / cv) exp(-k c v t) - u / cv.
    let early = follow(&springs, &[held, away], &[10.05]).unwrap()[0].pressure[0];
    let (u, cv) = (2e-7 / 5.0, 2e-14);
    near(early, (2e6 * decay + u / cv) * (-1e13 * cv * 0.05_f64).exp() - u / cv, 1e-9);
}

#[test]
fn loads_that_rise_and_fall() {
    let springs = parabola(41, 1e-5, 1e-14);
    let ramp = |from: f64, to: f64| Stretch { duration: 4.0, speed: 1.0, pressing: Pressing::Load([from, to]) };
    let stretches = [ramp(0.0, 800.0), ramp(800.0, 0.0), steady(2.0, 0.0), ramp(300.0, 300.0)];
    let times = [1.0, 4.0, 6.0, 8.0, 9.0, 14.0];
    let answers = follow(&springs, &stretches, &times).unwrap();
    let worn = [100.0, 1600.0, 2800.0, 3200.0, 3200.0, 4400.0];
    let load = [200.0, 800.0, 400.0, 0.0, 0.0, 300.0];
    for ((answer, worn), load) in answers.iter().zip(worn).zip(load) {
        assert!((answer.pressure.iter().sum::<f64>() * 1e-5 - load).abs() < 1e-8, "{load}");
        near(answer.wear_depth.iter().sum::<f64>() * 1e-5, 1e-14 * worn, 1e-11);
    }
    assert_eq!(answers[3].wear_depth, answers[4].wear_depth);
    let touching = |at: usize| answers[at].pressure.iter().filter(|p| **p > 0.0).count();
    assert!(touching(2) < touching(1), "{} {}", touching(2), touching(1));
}

#[test]
fn a_jump_of_the_load_is_elastic() {
    let springs = parabola(41, 1e-5, 1e-14);
    let answers = follow(&springs, &[steady(4.0, 800.0), steady(4.0, 200.0)], &[3.999_999_999, 4.0]).unwrap();
    assert!(answers[1].pressure[20] < 0.5 * answers[0].pressure[20]);
    near(answers[1].wear_depth[20], answers[0].wear_depth[20], 1e-8);
}

#[test]
fn small_steps_of_another_kind_come_to_the_same() {
    // The midpoint rule over the elastic contact solved anew at every stage, with rates and gaps without any order.
    let gap = vec![3e-8, 0.0, 9e-8, 1e-7, 2.5e-7, 4e-8, 6e-7];
    let rate = vec![1e-14, 5e-14, 2e-14, 5e-15, 3e-14, 4e-14, 1e-14];
    let springs = Springs { gap, stiffness: 1e13, area: 2.0, rate };
    let ends = [1e6, 4e6];
    let stretch = Stretch { duration: 2.0, speed: 1.5, pressing: Pressing::Load(ends) };
    let back = Stretch { pressing: Pressing::Load([4e6, 2e6]), ..stretch };
    let answer = follow(&springs, &[stretch, back], &[4.0]).unwrap().remove(0);
    let mut state = State::new(&springs);
    let steps = 4000;
    for stretch in [stretch, back] {
        let Pressing::Load([start, end]) = stretch.pressing else { unreachable!() };
        for step in 0..steps {
            let h = 2.0 / f64::from(steps);
            let load = |part: f64| start + (end - start) * (f64::from(step) + part) / f64::from(steps);
            let kept = state.wear.clone();
            for (part, length) in [(0.0, 0.5), (0.5, 1.0)] {
                state.press(Pressing::Load([load(part); 2]));
                for (cell, kept) in kept.iter().enumerate() {
                    let worn = state.rate(cell) * 1.5 * h * length * state.pressure[cell];
                    state.wear[cell] = kept + worn;
                }
            }
        }
    }
    let touched = answer.pressure.iter().filter(|pressure| **pressure > 0.0).count();
    assert!((1..7).contains(&touched), "{touched}");
    for cell in 0..7 {
        let (found, expected) = (answer.wear_depth[cell], state.wear[cell]);
        assert!((found - expected).abs() <= 1e-6 * answer.approach, "{cell}: {found:e} {expected:e}");
    }
}

#[test]
fn what_cannot_be_followed_is_refused() {
    let springs = parabola(5, 1.0, 1e-14);
    let text = |springs: &Springs, stretch: Stretch| follow(springs, &[stretch], &[1.0]).unwrap_err().to_string();
    assert_eq!(text(&springs, steady(1e7, 1.0)), "k c v times the duration is 1e6, expected at most 1e5");
    assert_eq!(text(&springs, steady(1.0, -1.0)), "a load is -1e0, expected a finite number of 0 or more");
    let rates = Springs { rate: vec![0.0, 1.0], ..springs.clone() };
    assert_eq!(text(&rates, steady(1.0, 1.0)), "found 2 wear rates for 5 cells, expected one, or one for each");
    let open = Springs { gap: vec![f64::INFINITY; 5], ..springs };
    let nowhere = "found a load of 1e0 and no cell with a finite gap, expected at least one";
    assert_eq!(text(&open, steady(1.0, 1.0)), nowhere);
}
