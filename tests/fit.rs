//! `wearlaw fit`: constants come back from noisy measurements within their own intervals, what the data cannot tell apart is
//! said, and bad measurements are refused.

#[path = "support/program.rs"]
mod program;
#[path = "support/random.rs"]
mod random;
#[path = "support/solved.rs"]
mod solved;

use std::fmt::Write;
use std::path::Path;

use program::{fails, folder, json, run, write};
use random::Random;
use wearlaw::fit::{Asked, Data, Noise, fit};
use wearlaw::record::FitRecord;

const STIFFNESS: f64 = 1e12;
const PRESSURE: f64 = 1e8;

/// One spring at a given approach; K and m are where the search begins.
fn scene(k: f64, m: f64) -> String {
    format!(
        "[law]\nuse = \"archard\"\nconstants = {{ K = {k:e}, H = 1e10, m = {m:?} }}\n[contact]\nmodel = \"foundation\"\n\
         stiffness = {STIFFNESS:e}\n[grid]\nsize = [1e-3, 1e-3]\ncells = [1, 1]\n[surface]\nshape = \"flat-punch\"\nwidth = 1.0\n\
         [[step]]\nduration = 3.0\napproach = {:e}\nvelocity = 1.0\n[integrator]\nsubsteps = 50\n",
        PRESSURE / STIFFNESS
    )
}

/// Its depth: p^(1-m) = p0^(1-m) - (1-m) k c t.
fn depth(k: f64, m: f64, time: f64) -> f64 {
    let c = k / 1e10;
    let p = (PRESSURE.powf(1.0 - m) - (1.0 - m) * STIFFNESS * c * time).powf((1.0 - m).recip());
    (PRESSURE - p) / STIFFNESS
}

/// A number of the normal distribution (Box and Muller, 1958).
fn normal(random: &mut Random) -> f64 {
    let (a, b) = (random.between(1e-12, 1.0), random.between(0.0, 1.0));
    (-2.0 * a.ln()).sqrt() * (std::f64::consts::TAU * b).cos()
}

fn measured(random: &mut Random, noise: f64) -> String {
    let mut text = "time,depth\n".to_owned();
    for k in 1..=25 {
        let time = 0.12 * f64::from(k);
        let value = depth(4e-5, 1.3, time) * (1.0 + noise * normal(random));
        writeln!(text, "{time:?},{value:?}").expect("a text grows");
    }
    text
}

fn fitted(here: &Path, vary: &[&str]) -> FitRecord {
    let law = solved::archard();
    let data = Data::read(&here.join("m.csv"), Noise::Relative).expect("measurements");
    let asked = Asked { vary: vary.iter().map(|name| (*name).to_owned()).collect(), noise: Noise::Relative };
    fit(&here.join("s.toml"), &[], &law, &data, &asked, &mut |_| (), &|| true).expect("a fit")
}

fn holds(record: &FitRecord, index: usize, truth: f64) -> bool {
    record.parameters[index].interval.is_some_and(|[low, high]| low <= truth && truth <= high)
}

#[test]
fn constants_come_back_within_their_own_intervals() {
    let room = folder();
    let here = room.path();
    write(here, "s.toml", &scene(1e-5, 1.0));
    let mut random = Random(20_261_201);
    let mut within = [0, 0, 0];
    for _ in 0..100 {
        write(here, "m.csv", &measured(&mut random, 0.02));
        let record = fitted(here, &["K", "m"]);
        assert!(record.undetermined.is_empty(), "{:?}", record.undetermined);
        let (k, m) = (holds(&record, 0, 4e-5), holds(&record, 1, 1.3));
        within = [within[0] + usize::from(k), within[1] + usize::from(m), within[2] + usize::from(k && m)];
        assert!((0.01..0.03).contains(&record.scatter), "{}", record.scatter);
    }
    println!("within: K {}, m {}, both {} of 100", within[0], within[1], within[2]);
    assert!(within[2] >= 90, "{within:?}");
    // Intervals that hold the truth always would be none.
    assert!(within[0] + within[1] < 200, "{within:?}");
}

#[test]
fn without_noise_the_constants_are_exact() {
    let room = folder();
    let here = room.path();
    write(here, "s.toml", &scene(1e-5, 1.0));
    write(here, "m.csv", &measured(&mut Random(1), 0.0));
    let record = fitted(here, &["K", "m"]);
    for (index, truth) in [(0, 4e-5), (1, 1.3)] {
        let value = record.parameters[index].value;
        assert!((value / truth - 1.0).abs() < 1e-2, "{value} for {truth}");
    }
    assert!(
        record.points.iter().all(|point| (point.fitted / point.measured - 1.0).abs() < 1e-4),
        "{:?}",
        record.points
    );
}

#[test]
fn what_cannot_be_told_apart_is_said() {
    let room = folder();
    let here = room.path();
    write(here, "s.toml", &scene(1e-5, 1.3));
    write(here, "m.csv", &measured(&mut Random(2), 0.02));
    let ended = run(here, &["fit", "s.toml", "--data", "m.csv", "--vary", "K,H"]);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    assert!(ended.stderr.contains("`K` and `H` cannot be told apart: only K / H is known, 3.9"), "{}", ended.stderr);
    assert!(ended.stdout.contains("not known by itself"), "{}", ended.stdout);
    let document = json(&std::fs::read_to_string(here.join("s.fit/fit.json")).expect("a document"));
    assert!(document["parameters"][0]["interval"].is_null() && document["undetermined"][0].is_string(), "{document}");
    let picture = std::fs::read_to_string(here.join("s.fit/fit.svg")).expect("a picture");
    assert!(picture.contains("Measured less fitted (%)") && !picture.contains("NaN"), "{picture:.300}");
    let rows = std::fs::read_to_string(here.join("s.fit/fit.csv")).expect("a table");
    assert_eq!(rows.lines().count(), 26);
    // Under a pressure that stays K and m move together.
    let steady = "[law]\nuse = \"archard\"\nconstants = [1e-4, 1e9, 1.0, 1.0]\n[contact]\nmodel = \"prescribed\"\n[[step]]\n\
        duration = 1.0\npressure = 1e6\nvelocity = 1.0\n";
    write(here, "s.toml", steady);
    write(here, "m.csv", "distance,depth,sigma\n0,0,1e-9\n0.5,5.1e-8,1e-9\n1.0,9.9e-8,1e-9\n0.25,,1e-9\n");
    let document = json(&run(here, &["fit", "s.toml", "--data", "m.csv", "--vary", "K,m", "--json"]).stdout);
    let said = document["undetermined"][0].as_str().expect("a sentence");
    assert!(
        said.contains("together changes nothing") && document["points"].as_array().map(Vec::len) == Some(3),
        "{document}"
    );
    let document = json(&run(here, &["fit", "s.toml", "--data", "m.csv", "--vary", "K", "--json"]).stdout);
    let value = document["parameters"][0]["value"].as_f64().expect("a number");
    // The weighted mean of 1.02e-4 and .99e-4: slopes .5 and 1.
    assert!((value / (1e-4 * (0.5 * 0.51 + 0.99) / 1.25) - 1.0).abs() < 1e-6, "{value}");
    let interval = |end: usize| document["parameters"][0]["interval"][end].as_f64().expect("a number");
    let width = 1.96 * 1e-9 / 1.25_f64.sqrt() / 1e-3;
    assert!(((interval(1) - interval(0)) / (2.0 * width) - 1.0).abs() < 1e-2, "{document}");
}

#[test]
fn a_profile_is_fitted_too() {
    let room = folder();
    let here = room.path();
    let line = |k: f64| {
        format!(
            "[law]\nuse = \"archard\"\nconstants = {{ K = {k:e}, H = 1e10 }}\n[contact]\nmodel = \"foundation\"\ndimension = 2\n\
         stiffness = 1e13\n[grid]\nsize = [6e-4]\ncells = [61]\n[surface]\nshape = \"cylinder\"\nradius = 10e-3\n[[step]]\n\
         duration = 10.0\nload = 1000.0\nvelocity = 1.0\n[output]\nfields = [\"wear\"]\nformats = [\"csv\"]\n"
        )
    };
    write(here, "truth.toml", &line(1e-4));
    assert_eq!(run(here, &["run", "truth.toml", "--set", "integrator.tolerance=1e-6"]).code, 0);
    let fields: Vec<_> = std::fs::read_dir(here.join("truth.out/fields")).expect("fields").collect();
    let file = fields.into_iter().filter_map(Result::ok).map(|entry| entry.path()).max().expect("a file");
    let text = std::fs::read_to_string(file).expect("a field");
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let column =
        |name: &str| names.iter().position(|found| *found == name).unwrap_or_else(|| panic!("{name} in {names:?}"));
    let (x, wear) = (column("x"), column("wear"));
    let mut profile = "x,wear\n".to_owned();
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        writeln!(profile, "{},{}", cells[x], cells[wear]).expect("a text grows");
    }
    write(here, "p.csv", &profile);
    write(here, "s.toml", &line(3e-5));
    let ended = run(here, &["fit", "s.toml", "--data", "p.csv", "--vary", "K", "--noise", "absolute", "--json"]);
    assert_eq!(ended.code, 0, "{}", ended.stderr);
    let value = json(&ended.stdout)["parameters"][0]["value"].as_f64().expect("a number");
    assert!((value / 1e-4 - 1.0).abs() < 1e-3, "{value}");
}

#[test]
fn bad_input_is_said() {
    let room = folder();
    let here = room.path();
    write(here, "s.toml", &scene(1e-5, 1.0));
    write(here, "m.csv", "time,depth\n1,2e-5\n2,3e-5\n");
    write(here, "late.csv", "time,depth\n1,2e-5\n2,3e-5\n4,3e-5\n");
    write(here, "minus.csv", "time,depth\n1,-2e-5\n2,3e-5\n");
    write(here, "x.csv", "x,wear\n0,2e-5\n1,3e-5\n2,1e-5\n");
    for (data, vary, code, expected) in [
        ("m.csv", "K,m", 2, "found 2 measurements, expected more than there are values to find: at least 3"),
        (
            "m.csv",
            "hardness",
            2,
            "--vary hardness: found nothing of that name, expected a constant of the law (K, H, m, n",
        ),
        ("m.csv", "contact.model", 2, "found no number under it"),
        ("late.csv", "K", 2, "measured at time 4, and the scene ends at 3"),
        ("minus.csv", "K", 2, "minus.csv:2: found -2e-5 in column `depth`"),
        ("x.csv", "K", 2, "found a profile over x"),
        ("none.csv", "K", 2, "none.csv"),
        ("late.csv", "K,K", 2, "--vary K: found it twice"),
    ] {
        let message = fails(here, &["fit", "s.toml", "--data", data, "--vary", vary], code, "input");
        assert!(message.contains(expected), "{message}");
    }
    assert!(!here.join("s.fit").exists(), "nothing is written before anything is known");
}
