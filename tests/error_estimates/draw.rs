//! The generator: scenes that have an exact answer on the continuum, from a seed.

use crate::random::Random;

/// What a scene is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A scar on a half-space, by a ball.
    Ball,
    /// A scar on a half-space, by a cylinder.
    Line,
    /// A worn parabola on springs.
    Springs,
    /// A wave that decays.
    Wave,
    /// Wear around a stick zone.
    Stick,
    /// A prescribed history.
    Prescribed,
}

pub const KINDS: [Kind; 6] = [Kind::Ball, Kind::Line, Kind::Springs, Kind::Wave, Kind::Stick, Kind::Prescribed];

/// K / H, so that the wear rate is this times p v.
const COEFFICIENT: f64 = 1e-14;
const LAW: &str = "[law]\nuse = \"archard\"\nconstants = [1e-4, 1e10, 1, 1]\n";

/// How wear is advanced.
fn integrator(random: &mut Random) -> String {
    let accuracy = match random.chance(0.6) {
        true => format!("tolerance = {:e}", random.power(-4.0, -2.0)),
        false => format!("substeps = {}", 4 + random.below(29)),
    };
    let method = random.one(&["auto", "auto", "implicit-euler", "tr-bdf2", "sdirk2"]);
    format!("[integrator]\nmethod = \"{method}\"\n{accuracy}\n[output]\nerror_estimate = true\n")
}

/// The text of a scene.
pub fn draw(kind: Kind, seed: u64) -> String {
    let mut random = Random(seed);
    let random = &mut random;
    match kind {
        Kind::Ball | Kind::Line => scar(kind, random),
        Kind::Springs => springs(random),
        Kind::Wave => wave(random),
        Kind::Stick => stick(random),
        Kind::Prescribed => prescribed(random),
    }
}

/// A Hertz contact of half-width `a`, `fine` cells to it, worn until it is about `grown` times as wide.
fn scar(kind: Kind, random: &mut Random) -> String {
    let (radius, modulus, pressure) = (random.power(-3.0, -1.0), random.power(9.0, 11.5), random.power(-3.5, -2.0));
    // p0 = E* a / (2 R) under a cylinder, 2 E* a / (pi R) under a ball (Johnson 1985, section 4.2).
    let (a, load, volume, flat) = match kind {
        Kind::Line => {
            let a = 2.0 * radius * pressure;
            let load = std::f64::consts::PI * a * a * modulus / (4.0 * radius);
            (a, load, 2.0 * a.powi(3) / (3.0 * radius), true)
        }
        _ => {
            let a = std::f64::consts::PI * radius * pressure / 2.0;
            (a, 4.0 * modulus * a.powi(3) / (3.0 * radius), std::f64::consts::PI * a.powi(4) / (4.0 * radius), false)
        }
    };
    let tau = random.power(-1.0, 1.0);
    let duration = tau * volume / (COEFFICIENT * load);
    let grown = if flat { (tau + 1.0).cbrt() } else { (tau + 1.0).powf(0.25) };
    let fine = random.between(5.0, if flat { 25.0 } else { 10.0 });
    let cells = 2 * (fine * grown * random.between(1.3, 1.8)).ceil() as usize + random.below(2);
    let size = cells as f64 * a / fine;
    let (dimension, shape) = if flat { (2, "cylinder") } else { (3, "sphere") };
    let pair = |value: String| if flat { format!("[{value}]") } else { format!("[{value}, {value}]") };
    format!(
        "{LAW}[contact]\nmodel = \"halfspace\"\ndimension = {dimension}\nmodulus = {modulus:e}\n\
         [grid]\nsize = {}\ncells = {}\n[surface]\nshape = \"{shape}\"\nradius = {radius:e}\n\
         [[step]]\nduration = {duration:e}\nload = {load:e}\nvelocity = 1\n{}[reference]\nkind = \"hertz-scar\"\n",
        pair(format!("{size:e}")),
        pair(cells.to_string()),
        integrator(random)
    )
}

/// A^3 = (3 P R / 2)(1/k + c t) under a cylinder, A^4 = (4 P R / pi)(1/k + c t) under a ball, from the volume of the overlap.
fn springs(random: &mut Random) -> String {
    let flat = random.chance(0.5);
    let (radius, stiffness, load) = (random.power(-3.0, -1.0), random.power(11.0, 14.0), random.power(1.0, 4.0));
    let softer = random.power(-1.0, 1.5);
    let duration = softer / (stiffness * COEFFICIENT);
    let soft = (1.0 + softer) / stiffness;
    let a = match flat {
        true => (1.5 * load * radius * soft).cbrt(),
        false => (4.0 * load * radius * soft / std::f64::consts::PI).powf(0.25),
    };
    let fine = random.between(6.0, if flat { 40.0 } else { 16.0 });
    let cells = 2 * (fine * random.between(1.3, 1.8)).ceil() as usize + random.below(2);
    let size = cells as f64 * a / fine;
    let (dimension, shape) = if flat { (2, "cylinder") } else { (3, "sphere") };
    let pair = |value: String| if flat { format!("[{value}]") } else { format!("[{value}, {value}]") };
    format!(
        "{LAW}[contact]\nmodel = \"foundation\"\ndimension = {dimension}\nstiffness = {stiffness:e}\n\
         [grid]\nsize = {}\ncells = {}\n[surface]\nshape = \"{shape}\"\nradius = {radius:e}\n\
         [[step]]\nduration = {duration:e}\nload = {load:e}\nvelocity = 1\n{}[reference]\nkind = \"winkler-parabola\"\n",
        pair(format!("{size:e}")),
        pair(cells.to_string()),
        integrator(random)
    )
}

fn wave(random: &mut Random) -> String {
    let (length, modulus) = (random.power(-4.0, -2.0), random.power(9.0, 11.5));
    let waves = 1 + random.below(3);
    let amplitude = length * random.power(-6.0, -4.0);
    // The mean pressure keeps it closed: it exceeds E* pi k A / L.
    let closing = modulus * std::f64::consts::PI * waves as f64 * amplitude / length;
    let load = closing * random.between(1.5, 4.0) * length;
    let decay = COEFFICIENT * modulus * std::f64::consts::PI * waves as f64 / length;
    let duration = random.between(0.2, 2.0) / decay;
    let cells = waves * (16 + 2 * random.below(25));
    let cells = cells + cells % 2;
    format!(
        "{LAW}[contact]\nmodel = \"halfspace\"\ndimension = 2\nboundary = \"periodic\"\nmodulus = {modulus:e}\n\
         tolerance = 1e-10\n[grid]\nsize = [{length:e}]\ncells = [{cells}]\n\
         [surface]\nshape = \"wavy\"\namplitude = {amplitude:e}\nwaves = [{waves}]\n\
         [[step]]\nduration = {duration:e}\nload = {load:e}\nvelocity = 1\n{}[reference]\nkind = \"mode-decay\"\n",
        integrator(random)
    )
}

/// Held at a fixed approach until nothing wears any more.
fn stick(random: &mut Random) -> String {
    let (radius, modulus) = (random.power(-3.0, -1.0), random.power(9.0, 11.5));
    let a = radius * random.power(-3.0, -2.0);
    let approach = a * a / radius;
    let stick = a * random.between(0.4, 0.8);
    let fine = random.between(8.0, 16.0);
    let cells = 4 * (fine * 0.75).ceil() as usize;
    let size = cells as f64 * a / fine;
    format!(
        "{LAW}[contact]\nmodel = \"halfspace\"\nmodulus = {modulus:e}\n\
         [grid]\nsize = [{size:e}, {size:e}]\ncells = [{cells}, {cells}]\n\
         [surface]\nshape = \"sphere\"\nradius = {radius:e}\ncenter = [{half:e}, {half:e}]\n\
         [[step]]\nduration = 1e20\napproach = {approach:e}\nvelocity = 1\nstick = {stick:e}\n\
         [integrator]\nmethod = \"implicit-euler\"\nsubsteps = 2\n[output]\nerror_estimate = true\n\
         [reference]\nkind = \"stick-limit\"\n",
        half = size / 2.0
    )
}

/// Tables in time and a pressure that goes linearly from one to another.
fn prescribed(random: &mut Random) -> String {
    let mut text = "[law]\nuse = \"archard\"\n".to_owned();
    for time in [0.0, 0.5, 1.0] {
        let (k, h) = (random.power(-5.0, -3.0), random.power(2.0, 4.0));
        let (m, n) = (random.between(0.6, 2.0), random.between(0.5, 1.5));
        text += &format!("[[law.table]]\ntime = {time:?}\nconstants = [{k:e}, {h:e}, {m}, {n}]\n");
    }
    text += "[contact]\nmodel = \"prescribed\"\n";
    for _ in 0..1 + random.below(3) {
        let (p, v, length) = (random.power(0.0, 3.0), random.power(-2.0, 0.0), random.between(0.1, 0.6));
        text += &format!("[[step]]\nduration = {length}\npressure = {p}\nvelocity = {v}\nramp = [\"pressure\"]\n");
    }
    format!("{text}{}[reference]\nkind = \"archard-prescribed\"\n", integrator(random))
}
