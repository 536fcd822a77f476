//! `--set key=value`.

use super::*;
use crate::{Accuracy, Constants, Drive, Elasticity, Field, Model, Sliding};

#[track_caller]
fn bad(change: &str, message: &str) {
    let error = set(PRESCRIBED, &[change]).expect_err(change);
    let found = error.to_string();
    assert!(found.contains(message), "{found:?} lacks {message:?}");
    assert!(found.contains(&format!("--set {change}")), "{found:?} does not name the override");
    assert!(!found.contains("scene.toml"), "{found:?} names the file");
    let location = error.location.as_ref().unwrap();
    assert!(location.in_override());
    assert!(error.render(false).contains(change));
}

#[test]
fn values_are_toml_or_bare_words() {
    let scene = set(
        PRESCRIBED,
        &[
            "step.0.pressure=5",
            "law.constants.K = 2e-4",
            "law.use=./build/my law.so",
            "integrator.method=tr-bdf2",
            "output.fields=[\"wear\"]",
            "title=\"a = b\"",
            "law.constants.\"x.y\"=3",
            "step.0.velocity=v.npy",
        ],
    )
    .unwrap();
    assert_eq!(scene.steps[0].drive, Some(Drive::Pressure(5.0)));
    let constants = [("H", 2e3), ("K", 2e-4), ("x.y", 3.0)].map(|(name, value)| (name.to_owned(), value));
    assert_eq!(scene.law.constants, Some(Constants::ByName(constants.into())));
    assert_eq!(scene.law.plugin, "./build/my law.so");
    assert_eq!(scene.integrator.method, crate::Method::TrBdf2);
    assert_eq!(scene.output.fields, ["wear"]);
    assert_eq!(scene.title.as_deref(), Some("a = b"));
    assert_eq!(scene.steps[0].sliding, Some(Sliding::Velocity { velocity: Field::File("v.npy".into()) }));
    let place = scene.locate("law.constants.K").unwrap();
    assert_eq!(place.to_string(), "--set law.constants.K = 2e-4");
    assert_eq!(place.span(), 18..22);
}

#[test]
fn later_overrides_win_and_whole_lists_can_be_set() {
    let scene =
        set(PRESCRIBED, &["step.0.pressure=5", "step.0.pressure=6", "law.constants=[1, 2]", "law.constants.1=3"]);
    let scene = scene.unwrap();
    assert_eq!(scene.steps[0].drive, Some(Drive::Pressure(6.0)));
    assert_eq!(scene.law.constants, Some(Constants::ByPosition(vec![1.0, 3.0])));
    let steps = "step=[{ duration = 1, pressure = 2 }, { duration = 2, pressure = 3 }]";
    assert_eq!(set(PRESCRIBED, &[steps, "step.1.duration=9"]).unwrap().steps[1].duration, Some(9.0));
}

#[test]
fn an_override_takes_the_place_of_its_rival() {
    let text = format!("integrator.tolerance = 1e-3\n{PRESCRIBED}");
    assert_eq!(set(&text, &["integrator.substeps=7"]).unwrap().integrator.accuracy, Accuracy::Substeps(7));
    let scene = set(HALF_SPACE, &["step.0.approach=1e-6"]).unwrap();
    assert_eq!(scene.steps[0].drive, Some(Drive::Approach(1e-6)));
    let scene = set(PRESCRIBED, &["step.0.stroke=1", "step.0.frequency=2"]).unwrap();
    assert_eq!(scene.steps[0].sliding, Some(Sliding::Stroke { stroke: 1.0, frequency: 2.0 }));
    let scene = set(PRESCRIBED, &["law.apdl=deck.inp", "law.material=2"]).unwrap();
    assert_eq!((scene.law.constants, scene.law.material), (None, Some(2)));
    let scene = set(HALF_SPACE, &["contact.bodies=[{E=2.0,nu=0.0},{E=2.0,nu=0.0}]"]).unwrap();
    let Model::HalfSpace(half_space) = &scene.contact.model else { panic!("{:?}", scene.contact) };
    assert!(matches!(half_space.elasticity, Elasticity::Bodies(_)));
    assert!((half_space.elasticity.modulus() - 1.0).abs() < 1e-15);
    let error = set(PRESCRIBED, &["integrator.substeps=7", "integrator.tolerance=1e-3"]).unwrap_err();
    assert!(error.to_string().contains("found both"), "{error}");
}

#[test]
fn errors_name_the_override() {
    bad("step.0.load=4", "found `step.0.load` in a scene with contact.model = \"prescribed\"");
    bad("step.0.duration=-1", "found -1.0 for `step.0.duration`");
    bad("step.0.duration=soon", "found the string \"soon\" for `step.0.duration`, expected a number");
    bad("step.3.duration=1", "found entry 3 of `step`, which has 1");
    bad("cycle.0.count=1", "found entry 0 of `cycle`, which has 0");
    bad("step.duration=3", "as in step.0.duration");
    bad("law.constants.H.x=3", "found `x` of `law.constants.H`, which is the number 2000.0");
    bad("law.constants.K=\"abc", "not valid TOML");
    bad("law.constants.K=nan", "found NaN");
    bad("intgrator.method=auto", "did you mean `integrator`?");
    bad("integrator.metod=auto", "did you mean `method`?");
    bad("law.share=[0.5, 0.6]", "sum to 1.1");
}

#[test]
fn what_is_no_override() {
    for text in ["", "foo", "=5", "a=", "a..b=5", ".a=5", "a.=5", "\"a=5", "\"a\"b=5"] {
        bad(text, "expected key=value");
    }
    bad(&format!("a{}=1", ".a".repeat(1000)), "expected key=value");
}
