//! Every mistake that a prescribed scene can hold: what is said, and where.

use super::*;
use crate::Problem;

#[track_caller]
fn each(cases: &str) {
    refused_each(PRESCRIBED, cases);
}

#[track_caller]
fn bad(from: &str, to: &str, message: &str, line: usize, column: usize) {
    refused(PRESCRIBED, from, to, message, line, column);
}

const LAW: &str = "use = \"archard\"";
const CONSTANTS: &str = "constants = { K = 1e-4, H = 2e3 }";

#[test]
fn unknown_keys_name_the_nearest_one() {
    each(
        r#"
            duration = 1.0 => durration = 1.0 => unknown key `durration` in `step.0`, did you mean `duration`? => 9:1
            [law] => [lwa] => unknown key `lwa` in the scene, did you mean `law`? => 1:2
            model => modle => unknown key `modle` in `contact`, did you mean `model`? => 6:1
            model = "prescribed" =>  => found no `model` in `contact`, expected one => 5:2
            duration = 1.0 => xylophone = 3 => unknown key `xylophone` in `step.0`, expected `duration`, `pressure`,  => 9:1
            constants = { => constant = { => did you mean `constants`? => 3:1
            [law] => [unit]\n[law] => did you mean `units`? => 1:2
        "#,
    );
    // A guess never leads to a key that the model refuses.
    each(
        r#"
            pressure => loaad => unknown key `loaad` in `step.0`, expected => 10:1
        "#,
    );
}

#[test]
fn keys_of_another_model_name_it() {
    each(
        r#"
            pressure => load => `step.0.load` in a scene with contact.model = "prescribed", expected it only with `foundation` or `halfspace` => 10:1
            [law] => [grid]\nsize = [1.0]\n[law] => found `grid` in a scene with contact.model = "prescribed" => 1:2
            [law] => [surface]\n[law] => found `surface` in a scene => 1:2
            model = => modulus = 1\nmodel = => expected it only with `halfspace`, at => 6:1
            model = => stiffness = 1\nmodel = => expected it only with `foundation`, at => 6:1
            duration = 1.0 => duration = 1\nstick = 1 => found `step.0.stick` => 10:1
            [law] => integrator.beyond_limit = "run"\n[law] => found `integrator.beyond_limit` => 1:12
        "#,
    );
}

#[test]
fn types_are_told_apart() {
    each(
        r#"
            duration = 1.0 => duration = "abc" => found the string "abc" for `step.0.duration`, expected a number => 9:12
            duration = 1.0 => duration = true => found the boolean true => 9:12
            duration = 1.0 => duration = [1, 2] => found a list of 2 entries => 9:12
            duration = 1.0 => duration = { a = 1 } => found a table for => 9:12
            duration = 1.0 => duration = 2020-01-01 => found the date 2020-01-01 => 9:12
            use = "archard" => use = 3 => found the integer 3 for `law.use`, expected a string => 2:7
            use = "archard" => use = " " => found an empty string for `law.use`, expected the name of a law => 2:7
            constants = { K = 1e-4, H = 2e3 } => constants = 7 => expected constants by name => 3:13
            constants = { K = 1e-4, H = 2e3 } => constants = { K = "x" } => found the string "x" for `law.constants.K` => 3:19
            use = "archard" => use = "archard"\naverage = 1 => found the integer 1 for `law.average`, expected true or false => 3:11
            [[step]] => [step] => found a table for `step`, expected load steps, [[step]] => 8:1
            velocity = 0.2 => velocity = true => expected a number or the path of a file => 11:12
            velocity = 0.2 => ramp = "pressure" => found the string "pressure" for `step.0.ramp`, expected a list => 11:8
            [law] => output.every = 2.5\n[law] => found the number 2.5 for `output.every`, expected "end" or a number of steps => 1:16
            [law] => stop = 1\n[law] => found the integer 1 for `stop`, expected a table => 1:8
        "#,
    );
}

#[test]
fn ranges_are_kept() {
    each(
        r#"
            duration = 1.0 => duration = -1 => found -1.0 for `step.0.duration`, expected a number not below 0 => 9:12
            duration = 1.0 => duration = nan => found NaN for `step.0.duration`, expected a finite number => 9:12
            duration = 1.0 => duration = -inf => found -inf => 9:12
            duration = 1.0 => duration = 1e999 => for `step.0.duration`, expected a finite number => 9:12
            pressure = 50.0 => pressure = -1.0 => found -1.0 for `step.0.pressure` => 10:12
            [law] => integrator.tolerance = 0\n[law] => found 0.0 for `integrator.tolerance`, expected a number above 0 and below 1 => 1:24
            [law] => integrator.substeps = 0\n[law] => found 0 for `integrator.substeps`, expected a whole number not below 1, at => 1:23
            [law] => integrator.substeps = 1.5\n[law] => expected a whole number => 1:23
            [law] => scaling.safety = 1.0\n[law] => above 0 and below 1 => 1:18
            [law] => scaling.maximum = 0.5\n[law] => not below 1 => 1:19
            [law] => stop.wear_depth = 0\n[law] => above 0 => 1:19
            [law] => output.checkpoint = -3\n[law] => found -3.0 for `output.checkpoint` => 1:21
            [law] => output.every = 0\n[law] => found 0 for `output.every` => 1:16
            [law] => output.times = [1, 2, 2]\n[law] => found 2.0 after 2.0 in `output.times` => 1:23
            [law] => reference = { kind = "x", bar = 0 }\n[law] => found 0.0 for `reference.bar` => 1:33
            model = => dimension = 4\nmodel = => found 4 for `contact.dimension`, expected a whole number not below 2 and not above 3 => 6:13
            duration = 1.0 => duration = 1\ntemperature = -1 => found -1.0 for `step.0.temperature`, expected a number not below 0 => 10:15
            [law] => units.temperature = "C"\nunits.reference_temperature = -300\n[law] => not below -273.15 => 2:31
        "#,
    );
}

#[test]
fn words_are_suggested() {
    each(
        r#"
            "prescribed" => "perscribed" => found "perscribed" for `contact.model`, did you mean `prescribed`? => 6:9
            "prescribed" => "Halfspace" => did you mean `halfspace`? => 6:9
            [law] => integrator.method = "implicit"\n[law] => expected `auto`, `explicit-euler`, `implicit-euler`, `tr-bdf2` or `sdirk2` => 1:21
            [law] => scaling.kind = "cycles"\n[law] => did you mean `cycle`? => 1:16
            [law] => output.formats = ["csv", "vkt"]\n[law] => found "vkt" for `output.formats.1`, did you mean `vtk`? => 1:26
            [law] => output.every = "ende"\n[law] => did you mean `end`? => 1:16
            use = "archard" => use = "a"\nbasis = "nodal" => found "nodal" for `law.basis`, expected `pressure` or `nodal-stress` => 3:9
            [law] => units.length = "parsec"\n[law] => expected `m`, `mm`, `um`, `µm`, `nm`, `cm` or `in` => 1:16
            [law] => units.force = "kn"\n[law] => found "kn" for `units.force` => 1:15
        "#,
    );
}

#[test]
fn required_keys_are_missed_at_their_section() {
    each(
        r#"
            duration = 1.0 =>  => found no `duration` in `step.0` => 8:1
            pressure = 50.0 =>  => found no `pressure` in `step.0`, expected one because there is no `contact.history` => 8:1
            use = "archard" =>  => found no `use` in `law` => 1:2
            [contact]\nmodel = "prescribed" =>  => found no `contact` in the scene => 1:1
            [[step]] => [[cycle]]\n[[cycle.step]] => found no `count` in `cycle.0` => 8:1
            [[step]]\nduration = 1.0\npressure = 50.0\nvelocity = 0.2 =>  => found no `step` in the scene => 1:1
            [law] => reference.bar = 1\n[law] => found no `kind` or `file` in `reference` => 1:1
            [[step]] => [[cycle]]\ncount = 3\n[[step]] => found no `step` in `cycle.0` => 8:1
        "#,
    );
}

#[test]
fn keys_that_exclude_or_need_one_another() {
    each(
        r#"
            [law] => integrator = { tolerance = 1e-3, substeps = 4 }\n[law] => found both `integrator.tolerance` and `integrator.substeps` => 1:34
            use = "archard" => use = "a"\napdl = "x.inp" => found both `law.apdl` and `law.constants` => 4:1
            use = "archard" => use = "a"\nmaterial = 2 => found `law.material` without `law.apdl` => 3:1
            velocity = 0.2 => velocity = 0.2\nstroke = 1\nfrequency = 2 => found both `step.0.velocity` and `step.0.stroke` => 12:1
            velocity = 0.2 => stroke = 1 => found `step.0.stroke` without `frequency` => 11:1
            velocity = 0.2 => frequency = 1 => found `step.0.frequency` without `stroke` => 11:1
            model = => history = "h.csv"\nmodel = => found both `contact.history` and `step.0.pressure` => 11:1
            [law] => output = { every = 2, times = [1] }\n[law] => found both `output.every` and `output.times` => 1:23
            [law] => reference = { kind = "self", file = "a" }\n[law] => found both `reference.kind` and `reference.file` => 1:30
        "#,
    );
}

#[test]
fn shares_digests_and_directions() {
    let law = |line: &str| format!("use = \"a\"\n{line}");
    bad("use = \"archard\"", &law("share = [0.6, 0.5]"), "found shares that sum to 1.1", 3, 9);
    bad("use = \"archard\"", &law("share = [1.0]"), "found 1 entry for `law.share`, expected 2", 3, 9);
    bad(
        "use = \"archard\"",
        &law("share = [1.5, -0.5]"),
        "found 1.5 for `law.share.0`, expected a number from 0 to 1",
        3,
        10,
    );
    bad(
        "use = \"archard\"",
        &law("sha256 = \"abcz\""),
        "found 4 characters with 'z' among them for `law.sha256`, expected 64 hex",
        3,
        10,
    );
    bad(
        "use = \"archard\"",
        &law(&format!("sha256 = \"{}\"", "a".repeat(63))),
        "found 63 characters for `law.sha256`",
        3,
        10,
    );
    bad(
        "use = \"archard\"",
        &law("direction = [0, 0, 0]"),
        "found a direction of length 0.0 for `law.direction`",
        3,
        13,
    );
    bad(
        "use = \"archard\"",
        &law("direction = [0, 1]"),
        "found 2 entries for `law.direction`, expected 3 in a scene with contact.dimension = 3",
        3,
        13,
    );
    bad("use = \"archard\"", &law("direction = [0, inf, 1]"), "found inf for `law.direction.1`", 3, 17);
    let plane = PRESCRIBED.replace("model =", "dimension = 2\nmodel =");
    refused(&plane, LAW, &law("direction = [0, 1, 1]"), "found a y component of 1.0", 3, 13);
    refused(&plane, LAW, &law("direction = [1]"), "found 1 entry for `law.direction`, expected 2", 3, 13);
}

#[test]
fn tables_form_a_grid() {
    let table = |rows: &[&str]| {
        let rows: Vec<String> = rows.iter().map(|row| format!("[[law.table]]\n{row}\n")).collect();
        PRESCRIBED.replace(CONSTANTS, &rows.concat())
    };
    let row = |rows: &[&str], message: &str, line, column| refused(&table(rows), LAW, LAW, message, line, column);
    row(&["constants = [1]"], "with neither `time` nor `temperature`", 3, 1);
    row(&["time = 0"], "found no `constants` in `law.table.0`", 3, 1);
    row(
        &["time = 0\nconstants = [1]", "temperature = 0\nconstants = [1]"],
        "with `temperature` alone, expected `time` alone",
        6,
        1,
    );
    row(
        &["time = 0\nconstants = [1]", "time = 1\nconstants = [1, 2]"],
        "with 2 constants by position, expected 1 constant by position as in the first row",
        6,
        1,
    );
    row(
        &["time = 0\nconstants = { K = 1 }", "time = 1\nconstants = { H = 1 }"],
        "with the constants `H`, expected the constants `K` as in the first row",
        6,
        1,
    );
    row(&["time = 0\nconstants = [1]", "time = 0.0\nconstants = [1]"], "a second row of `law.table` at time 0.0", 6, 1);
    let corner = |time, temperature| format!("time = {time}\ntemperature = {temperature}\nconstants = [1]");
    let (a, b, c) = (corner(0, 20), corner(0, 80), corner(1, 20));
    row(
        &[&a, &b, &c],
        "found no row of `law.table` at time 1.0, temperature 80.0, expected a full grid of 2 times and 2 temperatures",
        3,
        1,
    );
    assert!(parse(&table(&[&a, &b, &c, &corner(1, 80)])).is_ok());
}

#[test]
fn ramps_have_two_ends() {
    each(
        r#"
            velocity = 0.2 => ramp = ["velocity"] => found `velocity` in `step.0.ramp`, expected a quantity that this step gives => 11:1
        "#,
    );
    let two = "velocity = 0.2\n[[step]]\nduration = 1\npressure = 1\ntemperature = 3\nramp = [\"temperature\"]";
    bad("velocity = 0.2", two, "found `temperature` in `step.1.ramp`, expected `step.0` to give it too", 16, 1);
    assert!(parse(&PRESCRIBED.replace("velocity = 0.2", "ramp = [\"pressure\"]")).is_ok());
}

#[test]
fn text_that_is_no_toml() {
    each(
        r#"
            duration = 1.0 => duration =  => not valid TOML:  => 9:12
            [law] => [law => not valid TOML:  => 1:5
            [law] => [law]\nuse = "b" => not valid TOML: duplicate key => 3:1
        "#,
    );
    let deep = format!("a = {}", "[".repeat(20_000));
    assert!(parse(&deep).is_err());
    assert!(parse(&format!("a{} = 1", ".a".repeat(20_000))).is_err());
    assert!(parse("").unwrap_err().to_string().contains("found no `contact`"));
}

#[test]
fn columns_count_characters() {
    each(
        r#"
            use = "archard" => use = "µ"\noptions = "ü" # µµ\nshare = ["µ", 1] => found the string "µ" for `law.share.0` => 4:10
            constants = { K = 1e-4 => constants = { "µµ" = 1, K = nan => found NaN for `law.constants.K` => 3:29
        "#,
    );
}

#[test]
fn files_that_cannot_be_read() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("none.toml");
    let error = Scene::read(&missing, &[]).unwrap_err();
    assert_eq!(*error.problem, Problem::Read { path: missing, kind: std::io::ErrorKind::NotFound });
    assert!(error.to_string().contains("none.toml"), "{error}");
    assert!(error.render(false).contains("could not read"));
    let binary = folder.path().join("binary.toml");
    std::fs::write(&binary, b"[law]\nuse = \"\xff\"").unwrap();
    let error = Scene::read(&binary, &[]).unwrap_err();
    assert_eq!(*error.problem, Problem::NotUtf8);
    let location = error.location.as_ref().unwrap();
    assert_eq!((location.line(), location.column()), (2, 8));
    let good = folder.path().join("good.toml");
    std::fs::write(&good, PRESCRIBED).unwrap();
    let scene = Scene::read(&good, &[]).unwrap();
    assert_eq!(scene.resolve("a/b.csv"), folder.path().join("a/b.csv"));
    assert_eq!(scene.resolve("/a"), std::path::Path::new("/a"));
}
