//! Whole scenes: the documented one, defaults, order, places, and the way back to TOML.

use super::*;
use crate::*;

/// The documented example, with some of the keys that it only mentions.
pub(super) const EXAMPLE: &str = include_str!("example.toml");

#[test]
fn the_documented_scene() {
    let scene = parse(EXAMPLE).unwrap();
    assert_eq!(scene.title.as_deref(), Some("Ball on flat, wear scar growth"));
    let sizes = scene.units.sizes();
    assert_eq!((sizes.metre, sizes.newton, sizes.second, sizes.kelvin), (1e-3, 1.0, 1.0, 1.0));
    assert_eq!(sizes.kilogram, 1e3);
    assert_eq!(scene.units.absolute_zero(), -273.15);
    let law = &scene.law;
    assert_eq!(law.plugin, "archard");
    let constants = [("K", 1e-4), ("H", 1e10), ("m", 1.0), ("n", 1.0)].map(|(name, value)| (name.to_owned(), value));
    assert_eq!(law.constants, Some(Constants::ByName(constants.into())));
    assert_eq!((law.basis, law.average, law.mode), (Some(Basis::Pressure), Some(false), Some(Mode::Apply)));
    assert_eq!((law.direction, law.share), (Some([0.0, 0.0, -1.0]), Some([0.6, 0.4])));
    let digest = "0123456789abcdef".repeat(4);
    assert_eq!((law.sha256.as_deref(), law.options.as_deref()), (Some(digest.as_str()), Some("threshold=3")));
    let body = Body { young: 2e11, poisson: 0.3 };
    let half_space = HalfSpace {
        elasticity: Elasticity::Bodies([body, body]),
        boundary: Boundary::Free,
        tolerance: 1e-8,
        datum: None,
    };
    assert!((half_space.elasticity.modulus() - 1e11 / 0.91).abs() < 1e-3);
    let contact = Contact { model: Model::HalfSpace(half_space), dimension: 3, friction: Some(0.3) };
    assert_eq!(scene.contact, contact);
    assert_eq!(scene.grid, Some(Grid { size: vec![6e-4; 2], cells: vec![256; 2] }));
    let surface = Surface { shape: Shape::Sphere { radius: 5e-3 }, center: Some(vec![3e-4; 2]) };
    assert_eq!(scene.surface, Some(surface));
    let integrator = Integrator {
        method: Method::Auto,
        accuracy: Accuracy::Tolerance(1e-4),
        beyond_limit: Some(BeyondLimit::Refuse),
        smallest_step: Some(1e-9),
        most_substeps: None,
    };
    assert_eq!(scene.integrator, integrator);
    let scaling = Scaling { kind: Some(ScalingKind::None), safety: Some(0.1), maximum: Some(1e5) };
    assert_eq!(scene.scaling, scaling);
    assert_eq!(scene.stop, Stop { wear_depth: Some(1e-5), wear_volume: Some(1e-9) });
    let fields = vec!["pressure".to_owned(), "wear".to_owned()];
    let formats = vec![Format::Csv, Format::Vtk];
    assert_eq!(
        scene.output,
        Output { fields, every: Every::End, formats, checkpoint: Some(60.0), error_estimate: false }
    );
    let target = Target::Exact("hertz-scar".to_owned());
    assert_eq!(scene.reference, Some(Reference { target, bar: Some(1e-3) }));
}

#[test]
fn the_order_of_the_file_is_the_order_of_the_loading() {
    let scene = parse(EXAMPLE).unwrap();
    let first = Step {
        duration: Some(3.5),
        drive: Some(Drive::Load(10.0)),
        sliding: Some(Sliding::Velocity { velocity: Field::Uniform(1.0) }),
        stick: Some(5e-5),
        temperature: Some(20.0),
        friction: None,
        ramp: vec![Quantity::Load],
    };
    assert_eq!(scene.steps, [first]);
    assert_eq!(scene.cycles.len(), 2);
    assert_eq!((scene.cycles[0].count, scene.cycles[1].count), (10_000, 1));
    assert_eq!(scene.cycles[0].steps[0].sliding, Some(Sliding::Stroke { stroke: 0.05, frequency: 20.0 }));
    let last = &scene.cycles[1].steps[0];
    assert_eq!((last.duration, &last.drive), (Some(1.0), &Some(Drive::Load(2.0))));
    assert_eq!(last.sliding, Some(Sliding::Velocity { velocity: Field::File("v.npy".into()) }));
    // A step that moved is found under its new key, at its old place.
    let place = scene.locate("cycle.1.step.0.load").unwrap();
    assert_eq!((place.line(), place.column()), (54, 8));
    assert_eq!(scene.locate("cycle.0.count").unwrap().line(), 45);
    assert_eq!(scene.locate("step.1.load"), None);
}

#[test]
fn a_moved_step_does_not_shift_the_places_of_later_cycles() {
    let block = "[[cycle]]\ncount = 2\n[[cycle.step]]\nduration = 1\npressure = 1\n";
    let text = format!("{block}{}{block}", PRESCRIBED.replace("[[step]]", "[[step]] #"));
    let scene = parse(&text).unwrap();
    assert!(scene.steps.is_empty());
    let counts: Vec<u64> = scene.cycles.iter().map(|cycle| cycle.count).collect();
    assert_eq!(counts, [2, 1, 2]);
    assert_eq!(scene.locate("cycle.1.step.0.pressure").unwrap().line(), 15);
    assert_eq!(scene.locate("cycle.2.count").unwrap().line(), 18);
}

#[test]
fn defaults() {
    let scene = parse(PRESCRIBED).unwrap();
    assert_eq!(scene.units, Units::default());
    let sizes = scene.units.sizes();
    assert_eq!((sizes.metre, sizes.newton, sizes.second, sizes.kelvin, sizes.kilogram), (1.0, 1.0, 1.0, 1.0, 1.0));
    assert_eq!(scene.units.absolute_zero(), 0.0);
    assert_eq!((scene.law.basis, scene.law.average, scene.law.mode, scene.law.direction), (None, None, None, None));
    assert_eq!(scene.contact.dimension, 3);
    assert_eq!(scene.integrator.accuracy, Accuracy::Tolerance(1e-4));
    assert_eq!(scene.integrator.method, Method::Auto);
    assert_eq!(scene.scaling, Scaling::default());
    assert_eq!(scene.output.fields, Vec::<String>::new());
    assert_eq!((scene.grid, scene.surface, scene.reference), (None, None, None));
    let asked = parse(&format!("output.formats = [\"npz\"]\n{PRESCRIBED}")).unwrap();
    assert_eq!(asked.output.fields, ["pressure", "wear"]);
}

#[test]
fn a_history_needs_no_steps() {
    let text = "law.use = \"a.so\"\ncontact = { model = \"prescribed\", history = \"h.csv\" }\n";
    let scene = parse(text).unwrap();
    assert_eq!(scene.resolve("h.csv"), std::path::Path::new("dir/h.csv"));
    let open = parse(&format!("{text}[[step]]\nvelocity = 2")).unwrap();
    assert_eq!((open.steps[0].duration, &open.steps[0].drive), (None, &None));
    let repeated = parse(&format!("{text}[[cycle]]\ncount = 1e3")).unwrap();
    assert_eq!((repeated.cycles[0].count, repeated.cycles[0].steps.len()), (1000, 0));
    refused(
        &format!("{text}[[step]]\nvelocity = 2\n[[step]]\nduration = 1\n"),
        "2",
        "2",
        "found no `duration` in `step.0`",
        3,
        1,
    );
}

#[test]
fn there_and_back() {
    let table =
        "[[law.table]]\ntime = 0.1\nconstants = [1e-4, 2e3]\n[[law.table]]\ntime = 1\nconstants = [3e-4, 1e-320]\n";
    let others = [
        EXAMPLE.to_owned(),
        PRESCRIBED.to_owned(),
        HALF_SPACE.to_owned(),
        PRESCRIBED.replace("constants = { K = 1e-4, H = 2e3 }", table),
        PRESCRIBED.replace("[law]", "output.times = [0.1, 0.3]\nreference.kind = \"self\"\n[law]"),
        PRESCRIBED.replace("[law]", "output.every = 3\nreference.file = \"r.csv\"\nintegrator.substeps = 3\n[law]"),
        HALF_SPACE.replace("\"sphere\"\nradius = 5e-3", "\"flat-punch\"\nwidth = 1"),
        HALF_SPACE.replace("\"sphere\"\nradius = 5e-3", "\"wavy\"\namplitude = 1\nwaves = [3, 0]"),
        HALF_SPACE.replace("\"sphere\"\nradius = 5e-3", "\"file\"\nfile = \"h.npy\""),
        HALF_SPACE.replace("halfspace", "foundation").replace("modulus", "stiffness"),
    ];
    for text in others {
        let scene = parse(&text).unwrap_or_else(|error| panic!("{text}\n{error}"));
        let again = parse(&scene.toml()).unwrap_or_else(|error| panic!("{}\n{error}", scene.toml()));
        assert_eq!(scene, again);
        assert_eq!(scene.toml(), again.toml());
    }
}

#[test]
fn other_modules_point_at_keys() {
    #[derive(Debug, thiserror::Error)]
    #[error("found K = {0}, expected at most 1")]
    struct TooLarge(f64);

    let scene = parse(PRESCRIBED).unwrap();
    let error = scene.error_at("law.constants.K", TooLarge(2.0));
    assert_eq!(error.to_string(), "found K = 2, expected at most 1, at dir/scene.toml:3:19 (`law.constants.K`)");
    let rendered = error.render(false);
    assert!(rendered.contains("3 | constants = { K = 1e-4"), "{rendered}");
    assert!(rendered.contains("^^^^ law.constants.K"), "{rendered}");
    // What was not written is missed at its section, or at the top.
    let error = scene.error_at("law.constants.m", TooLarge(2.0));
    assert!(error.to_string().contains("scene.toml:3:1 (`law.constants.m`)"), "{error}");
    assert_eq!(scene.error_at("stop.wear_depth", TooLarge(2.0)).location.unwrap().line(), 1);
    assert!(scene.error_at("law", TooLarge(1.0)).render(true).contains("\u{1b}["));
}

#[test]
fn words_are_written_as_they_are_read() {
    fn check<W: reader::Word + serde::Serialize>() {
        for (word, value) in W::ALL {
            assert_eq!(serde_json::to_value(value).unwrap(), *word);
        }
    }
    check::<Basis>();
    check::<Mode>();
    check::<ModelKind>();
    check::<Boundary>();
    check::<Method>();
    check::<BeyondLimit>();
    check::<ScalingKind>();
    check::<Format>();
    check::<Quantity>();
}
