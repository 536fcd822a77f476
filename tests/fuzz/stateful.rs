//! Laws called in any order that the contract allows: instances made, used and let go in turn and from several threads,
//! in this process and in workers, batches of any size and layout. Every answer has to be the one that a fresh instance
//! gives to each point alone, to the bit.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use wearlaw::law::build::{BuildRequest, build};
use wearlaw::law::{
    BatchBuilder, CallNumbers, Embedded, Evaluation, Evaluator, Field, IsolateOptions, IsolatedLaw, LawDescriptor,
    LawInstance, LoadOptions, OutputItem, Outputs, Plugin, Source, Values,
};

use super::random::Random;
use super::watch::Watch;

/// Rounds of the short part, and operations in a round.
const ROUNDS: usize = 6;
const OPERATIONS: usize = 40;

/// A law that is called, and how it is opened.
enum Opened {
    Here(Box<Plugin>),
    There(PathBuf),
}

/// The laws: the embedded one, and one in C with state variables.
fn library(folder: &Path) -> PathBuf {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../plugins/faulty/sound.c");
    let output = Some(folder.join("sound.so"));
    let source = source.canonicalize().expect("the sound law is there");
    build(&BuildRequest { sources: vec![source], output, ..BuildRequest::default() }).expect("a C compiler").library
}

#[allow(unsafe_code)] // reason: hands a function of this program over as the entry of a law
fn archard() -> Plugin {
    // SAFETY: the entry is made by `export_laws!`, which keeps the contract.
    let embedded = unsafe { Embedded::new("archard", wearlaw_archard::wearlaw_entry_1) };
    Plugin::from_entry(Arc::new(embedded)).expect("the embedded law is well formed")
}

/// One point: its fields, constants and state at the start.
#[derive(Clone, Debug)]
struct Point {
    fields: Vec<(Field, Vec<f64>)>,
    state: Vec<f64>,
}

fn point(about: &LawDescriptor, random: &mut Random) -> Point {
    let mut one = |field: Field| {
        let size = match field {
            Field::Pressure => 10_f64.powf(4.0 + 5.0 * random.part()),
            Field::Slip => 1e-3 * random.part(),
            _ => random.part(),
        };
        let values = match field {
            Field::Normal => vec![0.0, 0.6, 0.8],
            _ if field.shape().width() == 3 => vec![size, 0.5 * size, 0.0],
            // Some points are pressed apart, some at rest.
            _ => vec![if random.below(12) == 0 { 0.0 } else { size }],
        };
        (field, values)
    };
    let fields: Vec<_> = about.fields().iter().map(&mut one).collect();
    Point { fields, state: about.state.iter().map(|_| random.part()).collect() }
}

/// What came out, as bits.
#[derive(Clone, Debug, Default, PartialEq)]
struct Answer {
    increment: Vec<u64>,
    direction: Vec<u64>,
    state: Vec<u64>,
    d_pressure: Vec<u64>,
}

/// How a batch is laid out and what is asked for.
#[derive(Clone, Copy, Debug)]
struct Way {
    gap: usize,
    direction: bool,
    slope: bool,
    spread_constants: bool,
}

fn evaluate(law: &dyn Evaluator, points: &[Point], constants: &[f64], dt: f64, way: Way) -> Answer {
    let (about, count) = (law.descriptor(), points.len());
    let numbers = CallNumbers { dt, ..CallNumbers::default() };
    let columns: Vec<(Field, usize, Vec<f64>)> = about
        .fields()
        .iter()
        .enumerate()
        .map(|(at, field)| {
            let step = field.shape().width() + way.gap;
            let mut data = vec![f64::NAN; (step * count).max(1)];
            for (i, point) in points.iter().enumerate() {
                let values = &point.fields[at].1;
                data[i * step..i * step + values.len()].copy_from_slice(values);
            }
            (field, step, data)
        })
        .collect();
    let spread: Vec<Vec<f64>> = constants.iter().map(|constant| vec![*constant; count.max(1)]).collect();
    let state: Vec<f64> = points.iter().flat_map(|point| point.state.clone()).collect();
    let mut batch = BatchBuilder::new(about, count).numbers(numbers);
    batch = if way.spread_constants && count > 0 {
        let columns: Vec<Values<'_>> = spread.iter().map(|column| Values::PerPoint(column)).collect();
        batch.constant_values(&columns)
    } else {
        batch.constants(constants)
    };
    for (field, step, data) in &columns {
        batch = batch.field(*field, Values::Strided { data, step: *step });
    }
    if !about.state.is_empty() {
        batch = batch.state(Values::Strided { data: &state, step: about.state.len() });
    }
    let batch = batch.build().expect("every column fits");
    let (slope, direction) =
        (way.slope && about.writes(OutputItem::DPressure), way.direction && about.writes(OutputItem::Direction));
    let room = |width: usize, wanted: bool| vec![f64::NAN; if wanted { width * count } else { 0 }];
    let (mut increment, mut directions) = (room(1, true), room(3, direction));
    let (mut end, mut slopes) = (room(about.state.len(), true), room(1, slope));
    let mut outputs = Outputs::new(&mut increment);
    outputs.direction = direction.then_some(&mut directions[..]);
    outputs.state = (!about.state.is_empty()).then_some(&mut end[..]);
    outputs.d_pressure = slope.then_some(&mut slopes[..]);
    let result = law.evaluate(&batch, &mut outputs);
    assert_eq!(result, Ok(Evaluation::Good), "{}, {count} points, {way:?}", about.name);
    let bits = |values: Vec<f64>| values.into_iter().map(f64::to_bits).collect();
    Answer { increment: bits(increment), direction: bits(directions), state: bits(end), d_pressure: bits(slopes) }
}

/// The constants of a law, near their defaults.
fn constants(about: &LawDescriptor, random: &mut Random) -> Vec<f64> {
    let usual = |name: &str| match name {
        "K" => 1e-4,
        "H" => 2e9,
        _ => 1.0,
    };
    about.constants.iter().map(|constant| usual(&constant.name) * (1.0 + 0.2 * random.part())).collect()
}

/// Calls one law with random points and holds the batch to what a fresh instance says of every point alone.
fn call(law: &dyn Evaluator, fresh: &LawInstance, random: &mut Random) {
    let about = fresh.descriptor();
    let sizes = [0, 1, 2, 3, 7, 8, 15, 64, 65, 255, 257, 1000];
    let count = sizes[random.below(sizes.len())];
    let points: Vec<Point> = (0..count).map(|_| point(about, random)).collect();
    let (constants, dt) = (constants(about, random), 1e-3 + random.part());
    let way = Way {
        gap: [0, 0, 1, 2, 7][random.below(5)],
        direction: random.below(2) == 0,
        slope: random.below(2) == 0,
        spread_constants: random.below(3) == 0,
    };
    let together = evaluate(law, &points, &constants, dt, way);
    let plain = Way { gap: 0, spread_constants: false, ..way };
    let mut apart = Answer::default();
    for point in &points {
        let one = evaluate(fresh, std::slice::from_ref(point), &constants, dt, plain);
        apart.increment.extend(one.increment);
        apart.direction.extend(one.direction);
        apart.state.extend(one.state);
        apart.d_pressure.extend(one.d_pressure);
    }
    assert_eq!(together, apart, "{}, {count} points, {way:?}", about.name);
}

/// One round: libraries are opened and let go, instances live across that, threads call them at the same time.
fn round(library: &Path, random: &mut Random, watch: &Watch) {
    let open = || Plugin::open(library, &LoadOptions::default()).expect("the law is well formed");
    let mut opened =
        [Opened::Here(Box::new(archard())), Opened::Here(Box::new(open())), Opened::There(library.to_owned())];
    let mut laws: Vec<(Box<dyn Evaluator>, bool)> = Vec::new();
    for _ in 0..OPERATIONS {
        watch.over(|| match random.below(8) {
            0 | 1 if laws.len() < 6 => match &opened[random.below(opened.len())] {
                Opened::Here(plugin) => {
                    let law = plugin.laws()[0].create(None).expect("it has no objections");
                    let is_archard = law.descriptor().name == "archard";
                    laws.push((Box::new(law), is_archard));
                }
                Opened::There(path) => {
                    let program = Some(PathBuf::from(env!("CARGO_BIN_EXE_wearlaw")));
                    let options = IsolateOptions { program, ..IsolateOptions::new(Source::File(path.clone())) };
                    laws.push((Box::new(IsolatedLaw::open(&options).expect("the law is well formed")), false));
                }
            },
            2 if !laws.is_empty() => drop(laws.swap_remove(random.below(laws.len()))),
            // The library goes before its instances, which keep it.
            3 => opened[1] = Opened::Here(Box::new(open())),
            4 => {
                let seeds: Vec<u64> = laws.iter().map(|_| random.below(1 << 30) as u64).collect();
                std::thread::scope(|scope| {
                    for ((law, is_archard), seed) in laws.iter().zip(seeds) {
                        for thread in 0..2 {
                            scope.spawn(move || {
                                let plugin = if *is_archard { archard() } else { open() };
                                let fresh = plugin.laws()[0].create(None).expect("it has no objections");
                                call(law.as_ref(), &fresh, &mut Random(seed + thread));
                            });
                        }
                    }
                });
            }
            _ if !laws.is_empty() => {
                let (law, is_archard) = &laws[random.below(laws.len())];
                let plugin = if *is_archard { archard() } else { open() };
                let fresh = plugin.laws()[0].create(None).expect("it has no objections");
                call(law.as_ref(), &fresh, random);
            }
            _ => {}
        });
    }
}

/// Rounds until time is up, or a few; answers how many.
pub fn fuzz(seed: u64, time: Option<Duration>, watch: &Watch) -> usize {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let library = library(folder.path());
    let mut random = Random(seed);
    let end = time.map(|time| Instant::now() + time);
    let mut rounds = 0;
    while end.map_or(rounds < ROUNDS, |end| Instant::now() < end) {
        round(&library, &mut random, watch);
        rounds += 1;
    }
    rounds
}
