//! Elastic foundations: points that are held, a parabola that sinks in, and every cell through any loading.

use crate::solved::near;
use crate::{norm, run};

/// One cell of stiffness 1e12 at an approach of 1e-4, p0 = 1e8; the contact tolerance counts in lengths of the cell, 1.
fn point(exponent: f64, rate: f64, time: f64, integrator: &str) -> f64 {
    let scene = format!(
        "[law]\nuse = \"archard\"\nconstants = {{ K = {rate:e}, H = 1.0, m = {exponent}, n = 1.0 }}\n\
         [contact]\nmodel = \"foundation\"\ndimension = 2\nstiffness = 1e12\ntolerance = 1e-15\n\
         [grid]\nsize = [1.0]\ncells = [1]\n[surface]\nshape = \"flat-punch\"\nwidth = 1.0\n\
         [[step]]\nduration = {time}\napproach = 1e-4\nvelocity = 1.0\n[integrator]\n{integrator}\n"
    );
    let solved = run(&scene);
    near(solved.record.wear[0] + solved.record.pressure[0] / 1e12, 1e-4, 1e-10);
    solved.record.pressure[0]
}

#[test]
fn one_spring_under_three_exponents() {
    near(point(2.0, 1e-21, 100.0, "tolerance = 1e-6"), 9090909.09090909, 1e-4);
    near(point(1.5, 1e-18, 100.0, "tolerance = 1e-6"), 44444444.4444444, 1e-5);
    near(point(0.5, 1e-9, 10.0, "tolerance = 1e-6"), 2.5e7, 1e-5);
    near(point(1.0, 1e-14, 100.0, "tolerance = 1e-6"), 1e8 * (-1.0_f64).exp(), 1e-5);
    // Extinct at t = 20: no pressure, and worn to the approach.
    assert_eq!(point(0.5, 1e-9, 25.0, "tolerance = 1e-4"), 0.0);
}

#[test]
fn one_implicit_step_solves_its_own_equation() {
    let step = "method = \"implicit-euler\"\nsubsteps = 1";
    near(point(2.0, 1e-21, 1e3, step), 9512492.19725039, 1e-9);
    near(point(1.0, 1e-14, 100.0, step), 5e7, 1e-12);
}

fn parabola(time: f64) -> String {
    // Cells of a fifteenth of the first contact radius, (1.5 P R / k)^(1/3).
    let size = 80.0 * 1.5e-12_f64.cbrt() / 15.0;
    format!(
        "[law]\nuse = \"archard\"\nconstants = [1e-14, 1.0, 1.0, 1.0]\n\
         [contact]\nmodel = \"foundation\"\ndimension = 2\nstiffness = 1e13\n\
         [grid]\nsize = [{size:e}]\ncells = [80]\n[surface]\nshape = \"cylinder\"\nradius = 10e-3\n\
         [[step]]\nduration = {time}\nload = 1000.0\nvelocity = 1.0\n[integrator]\ntolerance = 1e-5\n\
         [reference]\nkind = \"winkler-parabola\"\n"
    )
}

#[test]
fn a_parabola_sinks_in_as_a_continuum_does() {
    for (time, pressure, depth) in [(10.0, 4798179.34679, 5.60223976847e-7), (100.0, 2033213.357291, 3.037282689746e-6)]
    {
        let solved = run(&parabola(time));
        near(solved.record.pressure[40], pressure, 3e-3);
        near(solved.record.wear[40], depth, 3e-3);
        assert!(norm(&solved, "value") < 3e-3 && norm(&solved, "contact_radius_cells") < 1.0);
        assert!(norm(&solved, "volume_relative") < 1e-12);
    }
}

/// Ramps, a stick zone and unloading of a line.
fn varied(control: [&str; 4], tolerance: f64) -> String {
    let [first, second, third, fourth] = control;
    format!(
        "[law]\nuse = \"archard\"\nconstants = [1e-14, 1.0, 1.0, 1.0]\n\
         [contact]\nmodel = \"foundation\"\ndimension = 2\nstiffness = 1e13\ntolerance = 1e-13\n\
         [grid]\nsize = [5e-4]\ncells = [21]\n[surface]\nshape = \"cylinder\"\nradius = 10e-3\n\
         [[step]]\nduration = 2.0\nvelocity = 1.0\n{first}\n[[step]]\nduration = 5.0\nvelocity = 2.0\n{second}\n\
         [[step]]\nduration = 3.0\nvelocity = 1.0\nstick = 5e-5\n{third}\n[[step]]\nduration = 2.0\nvelocity = 1.0\n{fourth}\n\
         [integrator]\ntolerance = {tolerance:e}\n[reference]\nkind = \"winkler-discrete\"\n"
    )
}

const LOADS: [&str; 4] = [
    "load = 1000.0\nramp = [\"load\"]",
    "load = 1000.0\nramp = [\"velocity\"]",
    "load = 1000.0",
    "load = 100.0\nramp = [\"load\"]",
];
const APPROACHES: [&str; 4] = [
    "approach = 1e-6\nramp = [\"approach\"]",
    "approach = 1e-6\nramp = [\"velocity\"]",
    "approach = 1.5e-6",
    "approach = 1e-6\nramp = [\"approach\"]",
];

#[test]
fn every_cell_follows_the_exact_answer_to_the_tolerance() {
    for control in [LOADS, APPROACHES] {
        for tolerance in [1e-3, 1e-5] {
            let error = norm(&run(&varied(control, tolerance)), "value");
            assert!(error <= tolerance && error > 0.0, "{error:e} for {tolerance:e}");
        }
    }
}

#[test]
fn tight_tolerances_converge_to_the_exact_answer() {
    let error = norm(&run(&varied(LOADS, 1e-9)), "value");
    assert!(error <= 1e-8, "{error:e}");
}
