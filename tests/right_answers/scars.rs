//! Scars that grow under a constant load, on cells of a tenth of the Hertz radius.

use crate::solved::{Solved, near};
use crate::{norm, run};

struct Scar {
    dimension: u8,
    shape: &'static str,
    radius: f64,
    modulus: f64,
    load: f64,
    rate: f64,
    /// Hertz radius and pressure, unit of depth, time for tau = 1.
    units: [f64; 4],
}

/// S1.
const SPHERE: Scar = Scar {
    dimension: 3,
    shape: "sphere",
    radius: 5e-3,
    modulus: 115e9,
    load: 10.0,
    rate: 1e-14,
    units: [6.88300062715e-5, 1007826487.27, 6.03206116862e-7, 0.0352558438123],
};
/// S2.
const LINE: Scar = Scar {
    dimension: 2,
    shape: "cylinder",
    radius: 6e-3,
    modulus: 109.89011e9,
    load: 18.5e3,
    rate: 4.8e-15,
    units: [3.58622261459e-5, 328408664.339, 1.07174938678e-7, 0.0577106890096],
};

/// Runs until tau, checks pressure and depth at the centre in units of p0 and a0 p0 / E*.
#[track_caller]
fn check(scar: &Scar, tau: f64, cells: usize, pressure: f64, depth: f64, integrator: &str) -> Solved {
    let [a0, p0, unit, time] = scar.units;
    let size = cells as f64 * a0 / 10.0;
    let twice = |value: &str| if scar.dimension == 3 { format!("[{value}, {value}]") } else { format!("[{value}]") };
    let (size, counts) = (twice(&format!("{size:e}")), twice(&cells.to_string()));
    let scene = format!(
        "[law]\nuse = \"archard\"\nconstants = [{:e}, 1.0, 1.0, 1.0]\n\
         [contact]\nmodel = \"halfspace\"\ndimension = {}\nmodulus = {:e}\n[grid]\nsize = {size}\ncells = {counts}\n\
         [surface]\nshape = \"{}\"\nradius = {:e}\n[[step]]\nduration = {:e}\nload = {:e}\nvelocity = 1.0\n\
         [integrator]\n{integrator}\n[reference]\nkind = \"hertz-scar\"\n",
        scar.rate,
        scar.dimension,
        scar.modulus,
        scar.shape,
        scar.radius,
        tau * time,
        scar.load
    );
    let solved = run(&scene);
    let half = cells / 2;
    let center = if scar.dimension == 3 { half * cells + half } else { half };
    near(solved.record.pressure[center] / p0, pressure, 2e-3);
    // What is left is the error of the cells, which falls with their square: 5.7e-4 here, 1.2e-4 and 2.6e-5 at half and a
    // quarter of the size.
    near(solved.record.wear[center] / unit, depth, 6e-4);
    assert!(norm(&solved, "contact_radius_cells") < 1.0, "{:?}", solved.error);
    assert!(norm(&solved, "volume_relative") < 1e-12, "{:?}", solved.error);
    assert!(norm(&solved, "value") < 5e-3, "{:?}", solved.error);
    let last = solved.record.history.last().expect("rows");
    near(last.wear_volume.expect("cells have areas"), scar.rate * scar.load * tau * time, 1e-12);
    solved
}

#[test]
fn a_sphere() {
    let solved = check(&SPHERE, 1.0, 30, 0.719996, 0.501204, "tolerance = 1e-5");
    let approach = solved.record.history.last().and_then(|row| row.approach).expect("an approach");
    near(approach / SPHERE.units[2], 1.812351, 1e-3);
}

#[test]
fn an_old_sphere() {
    check(&SPHERE, 10.0, 44, 0.218182, 2.357775, "tolerance = 1e-5");
}

#[test]
fn a_line() {
    check(&LINE, 1.0, 40, 0.773111, 0.745136, "tolerance = 1e-5");
    check(&LINE, 10.0, 60, 0.366102, 4.431662, "tolerance = 1e-5");
}
