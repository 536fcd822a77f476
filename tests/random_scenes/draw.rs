//! The generator: from a seed and three units to a scene, and what the scene is for those who judge its end.

use std::fmt::Write as _;

use crate::random::Random;

/// The laws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// The law of the program, rate = K p^m v.
    Archard(f64),
    /// A wear coefficient that falls with the sliding distance, a state variable.
    RunningIn,
    /// Wear from friction work, a rate without a derivative.
    Work,
    /// Wear at a slant to the normal, against the slip.
    Ploughing,
    /// A rate that wants short substeps.
    Impatient,
    /// A wear coefficient that grows with the temperature.
    Warm,
}

/// What temperature does in a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Heat {
    /// It is not given.
    None,
    /// It is given and nobody reads it.
    Idle,
    /// The constants depend on it, or on it and time.
    Table { time: bool },
    /// The law reads it.
    Read,
}

/// Units of a scene: everything in it is of the order of one in these.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Units {
    pub length: f64,
    pub modulus: f64,
    pub time: f64,
}

/// A scene with what is asked of it.
pub struct Drawn {
    pub text: String,
    /// Files beside it: name and text.
    pub files: Vec<(String, String)>,
    pub law: Law,
    /// Units of the scene.
    pub units: Units,
    pub flat: bool,
    pub periodic: bool,
    pub averaged: bool,
    /// K of rate = K p^m v, the largest that holds.
    pub coefficient: f64,
    /// Longest substep of an impatient law.
    pub patience: f64,
    pub method: &'static str,
    pub beyond_limit: &'static str,
    /// Fixed substeps, or a tolerance.
    pub fixed: bool,
}

/// Whole numbers are written as such, so that the generator can be told the exact units.
fn pair(flat: bool, a: impl std::fmt::Display, b: impl std::fmt::Display) -> String {
    if flat { format!("[{a}]") } else { format!("[{a}, {b}]") }
}

/// The units of a seed: anything from 1e-30 to 1e30, or close to one.
pub fn units(seed: u64) -> Units {
    let mut random = Random(seed.wrapping_mul(0x2545_f491_4f6c_dd1d));
    let mut magnitude = || if random.chance(0.5) { random.power(-30.0, 30.0) } else { random.power(-3.0, 3.0) };
    Units { length: magnitude(), modulus: magnitude(), time: magnitude() }
}

/// The scene of a seed in these units. Numbers are drawn first and multiplied by their unit last, so that powers of two as
/// units leave all of their digits.
pub fn draw(seed: u64, units: Units) -> Drawn {
    let mut random = Random(seed);
    let random = &mut random;
    let Units { length, modulus, time } = units;
    let flat = random.chance(0.5);
    let springs = random.chance(0.35);
    let periodic = !springs && random.chance(0.4);
    let counts = [0, 1].map(|_| 4 + random.below(if flat { 29 } else { 9 }));
    let counts = if flat { [counts[0], 1] } else { counts };
    let mut files = Vec::new();
    let surface = surface(random, units, flat, counts, &mut files);
    let model = model(random, units, springs, periodic);

    let by_load = random.chance(0.7);
    // Pressure over modulus; wear over length in one load step.
    let (pressed, worn) = (random.power(-6.0, -3.0), random.power(-8.0, -1.5));
    let law = match random.below(10) {
        0 => Law::RunningIn,
        1 => Law::Work,
        2 => Law::Ploughing,
        3 if random.chance(0.3) => Law::Impatient,
        4 if random.chance(0.2) => Law::Archard(-0.5),
        _ => Law::Archard(random.one(&[1.0, 1.0, 0.5, 2.0])),
    };
    // Numbers of their own, so that scenes without temperatures stay as they are.
    let warmth = &mut Random(seed ^ 0x7e39_0a71_c5d2_64b3);
    let heat = match (law, warmth.below(12)) {
        (_, 0) => Heat::Read,
        (Law::Archard(_), 1 | 2) => Heat::Table { time: warmth.chance(0.3) },
        (_, 3) => Heat::Idle,
        _ => Heat::None,
    };
    let law = if heat == Heat::Read { Law::Warm } else { law };
    let averaged = random.chance(0.1);
    let method = random.one(&["auto", "auto", "auto", "explicit-euler", "implicit-euler", "tr-bdf2", "sdirk2"]);
    // Without stages these are refused; some are enough.
    let whole = (averaged || law == Law::RunningIn) && matches!(method, "tr-bdf2" | "sdirk2");
    let method = if whole && random.chance(0.8) { "auto" } else { method };
    let beyond_limit = if method == "explicit-euler" { random.one(&["refuse", "substep", "run"]) } else { "" };
    let fixed = random.chance(0.6) || averaged;
    let post = random.chance(0.12);
    let scaling = match random.below(10) {
        0 => "cycle",
        1 if fixed && !post => "auto",
        _ => "none",
    };
    let accuracy = match fixed {
        true => format!("substeps = {}", 1 + random.below(6)),
        false => {
            format!("tolerance = {:e}", random.one(if law == Law::RunningIn { &[1e-2] } else { &[1e-3, 1e-2, 3e-2] }))
        }
    };

    let m = if let Law::Archard(m) = law { m } else { 1.0 };
    let coefficient = (worn / pressed.powf(m)) / modulus.powf(m);
    let patience = random.between(0.05, 2.0) * time;
    let mut text = law_section((random, warmth), units, law, (coefficient, patience), heat);
    let basis = if random.chance(0.15) { "nodal-stress" } else { "pressure" };
    let mode = if post { "post" } else { "apply" };
    let _ = writeln!(text, "basis = \"{basis}\"\naverage = {averaged}\nmode = \"{mode}\"");
    if random.chance(0.1) {
        let part = random.between(0.0, 1.0);
        let _ = writeln!(text, "share = [{part}, {}]", 1.0 - part);
    }
    if law != Law::Ploughing && random.chance(0.1) {
        let direction = if flat { "[0.3, -1.0]" } else { "[0.3, 0.0, -1.0]" };
        let _ = writeln!(text, "direction = {direction}");
    }
    let _ = writeln!(text, "[contact]\ndimension = {}\n{model}\nfriction = 0.3", if flat { 2 } else { 3 });
    // A loose contact says too little of the pressure for wear to settle.
    let loosest: f64 = if fixed { 1e-6 } else { 1e-9 };
    let _ = writeln!(text, "tolerance = {:e}", random.one(&[loosest, 1e-8, 1e-9, 1e-10]).min(loosest));
    if !springs && !periodic && flat && !by_load {
        let _ = writeln!(text, "datum = {length:e}");
    }
    let size = format!("{length:e}");
    let _ = writeln!(text, "[grid]\nsize = {}\ncells = {}", pair(flat, &size, &size), pair(flat, counts[0], counts[1]));
    let _ = writeln!(text, "[surface]\n{surface}");
    text += &steps((random, warmth), units, (flat, by_load, scaling, heat), pressed, counts, &mut files);
    let _ = writeln!(text, "[integrator]\nmethod = \"{method}\"\n{accuracy}");
    if !beyond_limit.is_empty() {
        let _ = writeln!(text, "beyond_limit = \"{beyond_limit}\"");
    }
    // Few enough for a test, and many enough for what is asked.
    text += "most_substeps = 2000\n";
    if scaling != "none" {
        let _ = writeln!(text, "[scaling]\nkind = \"{scaling}\"");
    }
    if random.chance(0.05) {
        let _ = writeln!(text, "[stop]\nwear_depth = {:e}", worn * length);
    }
    let every = if random.chance(0.1) { format!("times = [{:e}]", 0.37 * time) } else { "every = 1".to_owned() };
    let _ = writeln!(text, "[output]\nfields = [\"wear\"]\n{every}");
    Drawn {
        text,
        files,
        law,
        units,
        flat,
        periodic,
        averaged,
        coefficient: 1.5 * coefficient,
        patience,
        method,
        beyond_limit,
        fixed,
    }
}

fn surface(
    random: &mut Random,
    Units { length, .. }: Units,
    flat: bool,
    counts: [usize; 2],
    files: &mut Vec<(String, String)>,
) -> String {
    match random.below(7) {
        0 => format!("shape = \"sphere\"\nradius = {:e}", random.power(0.0, 2.0) * length),
        1 => format!("shape = \"cylinder\"\nradius = {:e}", random.power(0.0, 2.0) * length),
        2 => format!("shape = \"cone\"\nangle = {:e}", random.power(-1.0, 1.0)),
        3 => format!("shape = \"flat-punch\"\nwidth = {:e}", random.between(0.6, 0.9) * length),
        4 => format!(
            "shape = \"wavy\"\namplitude = {:e}\nwaves = {}",
            random.power(-4.0, -2.0) * length,
            pair(flat, 1, random.below(2))
        ),
        5 => {
            let lowest = random.power(-4.0, -2.0);
            let mut text = String::new();
            for _ in 0..counts[1] {
                let row: Vec<String> =
                    (0..counts[0]).map(|_| format!("{:e}", (lowest * random.between(-1.0, 1.0)) * length)).collect();
                text += &row.join(",");
                text += "\n";
            }
            files.push(("heights.csv".to_owned(), text));
            "shape = \"file\"\nfile = \"heights.csv\"".to_owned()
        }
        _ => format!(
            "shape = \"rough\"\nhurst = {:.3}\nrms_slope = {:e}\nroll_off = 1.0\ncut_off = 2.0\nseed = {}",
            random.between(0.2, 1.0),
            random.power(-3.0, -1.0),
            random.below(1000)
        ),
    }
}

fn model(random: &mut Random, Units { length, modulus, .. }: Units, springs: bool, periodic: bool) -> String {
    if springs {
        return format!("model = \"foundation\"\nstiffness = {:e}", modulus / length);
    }
    let elastic = match random.chance(0.3) {
        // 1/E* = 2 (1 - nu^2) / E.
        true => {
            let nu = random.one(&[0.0, 0.25, 0.5]);
            let body = format!("{{ E = {:e}, nu = {nu} }}", 2.0 * (1.0 - nu * nu) * modulus);
            format!("bodies = [{body}, {body}]")
        }
        false => format!("modulus = {modulus:e}"),
    };
    format!("model = \"halfspace\"\nboundary = \"{}\"\n{elastic}", if periodic { "periodic" } else { "free" })
}

/// The law with constants that wear `coefficient` p^m for a length of sliding.
fn law_section(
    (random, warmth): (&mut Random, &mut Random),
    Units { length, time, .. }: Units,
    law: Law,
    (k, patience): (f64, f64),
    heat: Heat,
) -> String {
    let head = "[law]\nuse = \"archard\"\n";
    let constants = |list: &[f64]| {
        let list: Vec<String> = list.iter().map(|value| format!("{value:e}")).collect();
        format!("{head}constants = [{}]\n", list.join(", "))
    };
    match law {
        Law::Archard(m) => {
            let in_time = random.chance(0.2);
            if let Heat::Table { time: both } = heat {
                let mut rows = Vec::new();
                for at in if both { vec![0.0, 0.7 * time] } else { vec![f64::NAN] } {
                    let when = if both { format!("time = {at:e}, ") } else { String::new() };
                    for warm in [300.0, 450.0, 600.0] {
                        let k = warmth.between(0.5, 1.5) * k;
                        let constants = format!("{{ K = {k:e}, H = 1.0, m = {m}, n = 1.0 }}");
                        rows.push(format!("{{ {when}temperature = {warm}, constants = {constants} }}"));
                    }
                }
                return format!("{head}table = [{}]\n", rows.join(", "));
            }
            if in_time {
                // Break points in time are events.
                let row = |at: f64, factor: f64| {
                    let k = factor * k;
                    format!("{{ time = {at:e}, constants = {{ K = {k:e}, H = 1.0, m = {m}, n = 1.0 }} }}")
                };
                return format!("{head}table = [{}, {}]\n", row(0.0, 0.5), row(0.6 * time, 1.5));
            }
            format!("{head}constants = {{ K = {k:e}, H = 1.0, m = {m}, n = 1.0 }}\n")
        }
        Law::RunningIn => constants(&[k, 0.2 * k, 0.3 * length]),
        Law::Work => constants(&[k / 0.3]),
        Law::Ploughing => constants(&[k, random.between(0.0, 2.0)]),
        Law::Impatient => constants(&[k, patience]),
        // 1.4 k at the highest temperature.
        Law::Warm => constants(&[k, 5e-4]),
    }
}

/// Load steps, or a cycle of them.
fn steps(
    (random, warmth): (&mut Random, &mut Random),
    Units { length, modulus, time }: Units,
    (flat, by_load, scaling, heat): (bool, bool, &str, Heat),
    pressed: f64,
    counts: [usize; 2],
    files: &mut Vec<(String, String)>,
) -> String {
    let cycles = scaling == "cycle" || scaling == "none" && random.chance(0.15);
    let force = if flat { modulus * length } else { modulus * length * length };
    let (key, unit) = if by_load { ("load", force) } else { ("approach", length) };
    let mut text = String::new();
    if cycles {
        let _ = writeln!(text, "[[cycle]]\ncount = {}", 1 + random.below(20));
    }
    for index in 0..1 + random.below(3) {
        let value = random.between(0.3, 1.0) * if by_load { pressed } else { random.power(-4.0, -2.5) };
        let head = if cycles { "[[cycle.step]]" } else { "[[step]]" };
        let _ = writeln!(text, "{head}\nduration = {time:e}\n{key} = {:e}", value * unit);
        let ramps = scaling != "auto" && !(cycles && index == 0);
        let mut ramped = Vec::new();
        if heat != Heat::None {
            let _ = writeln!(text, "temperature = {:e}", warmth.between(200.0, 700.0));
            if ramps && warmth.chance(0.6) {
                ramped.push("temperature");
            }
        }
        match random.below(8) {
            0 => {
                let _ = writeln!(text, "stroke = {:e}\nfrequency = {:e}", 0.25 * length, 2.0 / time);
            }
            1 => {
                let name = format!("velocity{index}.csv");
                let row = |_| -> String {
                    let row: Vec<String> =
                        (0..counts[0]).map(|_| format!("{:e}", random.between(0.0, 1.5) * (length / time))).collect();
                    row.join(",") + "\n"
                };
                let table: String = (0..counts[1]).map(row).collect();
                let _ = writeln!(text, "velocity = \"{name}\"");
                files.push((name, table));
            }
            _ => {
                // A ramp through zero is an event.
                let sign = if random.chance(0.2) { -1.0 } else { 1.0 };
                let _ = writeln!(text, "velocity = {:e}", sign * (length / time));
                if random.chance(0.2) {
                    let _ = writeln!(text, "stick = {:e}", 0.1 * length);
                }
                if ramps && random.chance(0.2) {
                    ramped.push("velocity");
                }
            }
        }
        if ramps && !ramped.contains(&"velocity") && random.chance(0.25) {
            ramped.push(key);
        }
        if !ramped.is_empty() {
            let _ = writeln!(text, "ramp = {ramped:?}");
        }
    }
    text
}
