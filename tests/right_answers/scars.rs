//! Scars that grow under a constant load, on cells of a tenth of the Hertz radius.
//!
//! An old scar is deep and wide, and its depth comes out to 5e-5. A young one is as wide as 26 cells, and pressures that are
//! constant over a cell leave its depth an error of 2.9e-4 (line) or 5.7e-4 (sphere), whoever solves for them: a dense
//! solution of the same cells, extrapolated in time, is off by the same. It falls with the square of the cells.

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

/// What the centre of a scar at time tau is like, in units of p0 and a0 p0 / E*.
struct Center {
    tau: f64,
    pressure: f64,
    depth: f64,
}

const YOUNG_SPHERE: Center = Center { tau: 1.0, pressure: 0.719996, depth: 0.501204 };
const OLD_SPHERE: Center = Center { tau: 10.0, pressure: 0.218182, depth: 2.357775 };
const YOUNG_LINE: Center = Center { tau: 1.0, pressure: 0.773111, depth: 0.745136 };
const OLD_LINE: Center = Center { tau: 10.0, pressure: 0.366102, depth: 4.431662 };

/// Runs on `cells` of a tenth of the Hertz radius, or of a `finer` part of that; the depth has to be right `within`.
#[track_caller]
fn check(scar: &Scar, center: &Center, cells: usize, finer: usize, within: f64) -> Solved {
    let &Center { tau, pressure, depth } = center;
    let [a0, p0, unit, time] = scar.units;
    let size = cells as f64 * a0 / 10.0;
    let cells = cells * finer;
    let twice = |value: &str| if scar.dimension == 3 { format!("[{value}, {value}]") } else { format!("[{value}]") };
    let (size, counts) = (twice(&format!("{size:e}")), twice(&cells.to_string()));
    let scene = format!(
        "[law]\nuse = \"archard\"\nconstants = [{:e}, 1.0, 1.0, 1.0]\n\
         [contact]\nmodel = \"halfspace\"\ndimension = {}\nmodulus = {:e}\n[grid]\nsize = {size}\ncells = {counts}\n\
         [surface]\nshape = \"{}\"\nradius = {:e}\n[[step]]\nduration = {:e}\nload = {:e}\nvelocity = 1.0\n\
         [integrator]\ntolerance = 1e-5\n[reference]\nkind = \"hertz-scar\"\n",
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
    near(solved.record.wear[center] / unit, depth, within);
    assert!(norm(&solved, "contact_radius_cells") < 1.0, "{:?}", solved.error);
    assert!(norm(&solved, "volume_relative") < 1e-12, "{:?}", solved.error);
    assert!(norm(&solved, "value") < 5e-3, "{:?}", solved.error);
    let last = solved.record.history.last().expect("rows");
    near(last.wear_volume.expect("cells have areas"), scar.rate * scar.load * tau * time, 1e-12);
    solved
}

#[test]
fn a_sphere() {
    let solved = check(&SPHERE, &YOUNG_SPHERE, 30, 1, 6e-4);
    let approach = solved.record.history.last().and_then(|row| row.approach).expect("an approach");
    near(approach / SPHERE.units[2], 1.812351, 1e-3);
}

#[test]
fn an_old_sphere() {
    check(&SPHERE, &OLD_SPHERE, 44, 1, 5e-5);
}

#[test]
fn a_line() {
    check(&LINE, &YOUNG_LINE, 40, 1, 3e-4);
    check(&LINE, &YOUNG_LINE, 40, 4, 5e-5);
    check(&LINE, &OLD_LINE, 60, 1, 5e-5);
}
