//! A wave of pressure on a periodic half-space in full contact: what is left of it is the integrator's own formula.

use std::f64::consts::TAU;

use crate::run;
use crate::solved::near;
use wearlaw::reference::modes::Step;

const CELLS: usize = 32;
const METHODS: [(&str, Step); 4] = [
    ("explicit-euler", Step::ExplicitEuler),
    ("implicit-euler", Step::ImplicitEuler),
    ("sdirk2", Step::Sdirk2),
    ("tr-bdf2", Step::TrBdf2),
];

/// What is left of the first mode, E* = 115e9, c = 1e-14, L = 1 mm: lambda = 3.612831551628 /s.
fn left(method: &str, time: f64, substeps: u32) -> f64 {
    let scene = format!(
        "[law]\nuse = \"archard\"\nconstants = [1e-14, 1.0, 1.0, 1.0]\n\
         [contact]\nmodel = \"halfspace\"\ndimension = 2\nboundary = \"periodic\"\nmodulus = 115e9\ntolerance = 1e-13\n\
         [grid]\nsize = [1e-3]\ncells = [{CELLS}]\n[surface]\nshape = \"wavy\"\namplitude = 1e-8\nwaves = [1]\n\
         [[step]]\nduration = {time}\nload = 4e3\nvelocity = 1.0\n[integrator]\nmethod = \"{method}\"\nsubsteps = {substeps}\n"
    );
    let pressure = run(&scene).record.pressure;
    let wave = |(cell, p): (usize, &f64)| p * (TAU * (cell as f64 - CELLS as f64 / 2.0) / CELLS as f64).cos();
    let amplitude = pressure.iter().enumerate().map(wave).sum::<f64>() * 2.0 / CELLS as f64;
    let first = 115e9 * (TAU / 1e-3) * 1e-8 / 2.0;
    amplitude / first
}

#[test]
fn ten_steps_leave_what_the_formula_of_the_integrator_says() {
    let known = [0.6921372491338, 0.7012366018413, 0.6967683404498, 0.6967683404498];
    for ((method, _), known) in METHODS.into_iter().zip(known) {
        near(left(method, 0.1, 10), known, 1e-10);
    }
}

#[test]
fn one_huge_step_leaves_what_the_formula_says() {
    for (method, step) in METHODS.into_iter().skip(1) {
        let found = left(method, 1.0, 1);
        near(found, step.amplification(3.612831551628), 1e-9);
    }
}

#[test]
fn orders_show_over_three_halvings() {
    let time = 0.2;
    let exact = f64::exp(-3.612831551628 * time);
    for ((method, _), (order, within)) in METHODS.into_iter().zip([(1.0, 0.05), (1.0, 0.05), (2.0, 0.1), (2.0, 0.1)]) {
        let errors = [10, 20, 40, 80].map(|substeps| (left(method, time, substeps) - exact).abs());
        for pair in errors.windows(2) {
            let found = (pair[0] / pair[1]).log2();
            assert!((found - order).abs() <= within, "{method}: order {found}, {errors:?}");
        }
    }
}
