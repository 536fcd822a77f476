//! Scenes with mistakes: every message names the key and its place.

use super::program::{Room, SCENE};

/// Changes of the scene on the command line, and what the answer has to say.
const OVERRIDES: &[(&[&str], &[&str])] = &[
    (&["contact.histori=\"a.csv\""], &["unknown key `histori`", "`contact`", "did you mean `history`"]),
    (&["outptu.every=2"], &["unknown key `outptu`", "did you mean `output`"]),
    (&["contact.modulus=1e11"], &["`contact.modulus`", "contact.model = \"prescribed\"", "`halfspace`"]),
    (&["surface.radius=1"], &["`surface`", "prescribed"]),
    (&["contact.history=3"], &["the integer 3", "`contact.history`", "expected a string"]),
    (&["integrator.tolerance=\"small\""], &["\"small\"", "`integrator.tolerance`", "a number"]),
    (&["integrator.tolerance=-1"], &["-1", "`integrator.tolerance`", "above 0"]),
    (&["integrator.tolerance=nan"], &["NaN", "`integrator.tolerance`", "finite"]),
    (&["integrator.substeps=0"], &["found 0", "`integrator.substeps`", "not below 1"]),
    (&["integrator.method=\"euler\""], &["\"euler\"", "`integrator.method`"]),
    (&["law.constants.H=-3"], &["constant `H`", "-3", "(0, inf)", "--set law.constants.H=-3"]),
    (&["law.constants.HH=3"], &["no constant `HH`", "`K`, `H`, `m`, `n`", "--set law.constants.HH=3"]),
    (&["law.constants.hardness=3"], &["no constant `hardness`"]),
    (&["law.constants={K=1}"], &["constant `H`", "not given", "law.constants"]),
    (&["law.constants={K=\"a\"}"], &["\"a\"", "`law.constants.K`", "a number"]),
    (&["law.constants=[1,2,1,1,0,0,0,1,9]"], &["9 constants", "at most 8"]),
    (&["law.constants=[1,2,1,1,7]"], &["C5 = 7", "1, 10, 11 or -99"]),
    (&["law.constants=[1,2,1,1,1]", "law.basis=\"pressure\""], &["`law.basis`", "\"pressure\"", "\"nodal-stress\""]),
    (&["law.constants=[1,2,1,1,-99]", "law.mode=\"apply\""], &["`law.mode`", "\"apply\"", "\"post\""]),
    (&["law.constants=[1,2,1,1,1]"], &["nodal stress", "columns `sxx` to `sxz`", "`contact.history`"]),
    (&["law.sha256=\"00\""], &["2 characters", "`law.sha256`", "64 hexadecimal digits"]),
    (&["law.share=[0.6,0.6]"], &["1.2", "`law.share`", "sum to 1"]),
    (&["law.direction=[0,0,0]"], &["length 0", "`law.direction`"]),
    (&["law.use=\"archad\""], &["`archad`", "did you mean `archard`"]),
    (&["law.use=\"./none.so\""], &["none.so", "no file"]),
    (&["law.apdl=\"none.inp\""], &["none.inp", "law.apdl"]),
    (&["output.fields=[\"wera\"]"], &["\"wera\"", "did you mean \"wear\"", "output.fields.0"]),
    (&["output.fields=[\"temperature\"]"], &["\"temperature\"", "nothing in the scene gives"]),
    (&["output.formats=[\"vtx\"]"], &["\"vtx\"", "`output.formats.0`", "did you mean `vtk`"]),
    (&["reference.kind=\"archrd\""], &["\"archrd\"", "did you mean \"archard-prescribed\""]),
    (&["reference.file=\"none.csv\""], &["reference", "none.csv"]),
    (&["scaling.kind=\"auto\""], &["AUTS", "prescribed pressure", "scaling.kind"]),
    (&["step=[{duration=5}]"], &["load steps last 5", "history.csv", "covers 1"]),
    (&["step=[{duration=1,stroke=1}]"], &["`step.0.stroke`", "`frequency`"]),
    (
        &["step=[{duration=1,stroke=1,velocity=1,frequency=3}]"],
        &["`step.0.stroke`", "`step.0.velocity`", "one of them"],
    ),
    (&["step=[{duration=1,stroke=-1,frequency=3}]"], &["-1", "`step.0.stroke`", "not below 0"]),
    (&["step=[{duration=1,velocity=\"v.npy\"}]"], &["`step.0.velocity`", "column `velocity`"]),
    (&["step=[{duration=1,velocity=1}]"], &["`step.0.velocity`", "column `velocity`", "one of them"]),
    (&["step=[{duration=1,stroke=1,frequency=1}]"], &["`step.0.stroke`", "column `velocity`"]),
    (&["step=[{duration=1,pressure=4}]"], &["`contact.history`", "`step.0.pressure`"]),
    (&["step=[{duration=-1}]"], &["-1", "`step.0.duration`"]),
    (&["contact.model=\"halfspace\""], &["`contact.history`", "`prescribed`"]),
    (&["step.3.velocity=1"], &["entry 3 of `step`", "which has 0"]),
    (&["title.x=1"], &["`x` of `title`", "expected a section"]),
    (&["title"], &["\"title\"", "expected key=value"]),
    (&["=3"], &["\"=3\"", "expected key=value"]),
];

#[test]
fn a_mistake_in_a_scene_names_its_key() {
    let room = Room::new();
    for (overrides, telling) in OVERRIDES {
        for command in ["run", "plan"] {
            // `plan` reads neither the whole history nor a reference.
            let first = telling[0];
            if command == "plan" && (first.starts_with("load steps") || first == "reference") {
                continue;
            }
            let mut words = vec![command, "scene.toml"];
            overrides.iter().for_each(|text| words.extend(["--set", text]));
            room.refused(&words, telling);
        }
    }
}

#[test]
fn a_mistake_in_the_file_has_line_and_column() {
    let room = Room::new();
    for (old, new, telling) in [
        ("model =", "modle =", &["wrong.toml:6:1", "`modle`", "did you mean `model`", "^^^^^"] as &[&str]),
        ("m = 1.0", "m = true", &["wrong.toml:4:", "`law.constants.m`", "a number"]),
        ("H = 1.0e3", "H = 0.0", &["wrong.toml:4:", "constant `H`", "(0, inf)"]),
        ("history.csv", "none.csv", &["wrong.toml:7:11", "none.csv", "no such file"]),
        ("= \"two points\"", "= two points", &["wrong.toml:1:", "not valid TOML"]),
        ("history = \"history.csv\"\n", "", &["no `step`", "`contact.history`"]),
        ("use = \"archard\"\n", "", &["no `use`", "`law`"]),
    ] {
        room.write("wrong.toml", &SCENE.replace(old, new));
        room.refused(&["run", "wrong.toml"], telling);
        let document = room.json(&["run", "wrong.toml", "--json"], 2);
        assert_eq!(document["error"]["file"], "wrong.toml", "{new}");
        assert!(document["error"]["line"].as_u64() > Some(0) && document["error"]["column"].as_u64() > Some(0));
    }
    std::fs::write(room.file("bytes.toml"), b"title = \"\xff\"\n").expect("the folder can be written");
    room.refused(&["run", "bytes.toml"], &["UTF-8", "bytes.toml"]);
}

#[test]
fn a_scene_that_is_not_there_is_said_so() {
    let room = Room::new();
    room.refused(&["run", "none.toml"], &["none.toml", "could not read the scene"]);
    room.refused(&["plan", "none.toml"], &["none.toml"]);
    room.refused(&["run", "."], &["directory"]);
}

#[test]
fn tables_have_to_form_a_grid() {
    let room = Room::new();
    let table = |rows: &str| {
        let rest = SCENE.replace("constants = { K = 1.0e-4, H = 1.0e3, m = 1.0, n = 1.0 }\n", "");
        room.write("table.toml", &rest.replace("[contact]", &format!("{rows}\n[contact]")));
    };
    let row = |at: &str| format!("[[law.table]]\n{at}\nconstants = [1, 2, 1, 1]\n");
    table(
        &[row("time = 0\ntemperature = 20"), row("time = 1\ntemperature = 20"), row("time = 1\ntemperature = 40")]
            .concat(),
    );
    room.refused(
        &["run", "table.toml"],
        &["no row of `law.table`", "time 0", "temperature 40", "2 times and 2 temperatures"],
    );
    table(&[row("time = 0"), row("time = 0")].concat());
    room.refused(&["run", "table.toml"], &["second row", "time 0", "table.toml:"]);
    table(&[row("time = 0"), row("temperature = 0")].concat());
    room.refused(&["run", "table.toml"], &["`law.table`", "as in the first row"]);
    table(&[row("time = 0"), row("time = 1").replace("[1, 2, 1, 1]", "[1, 2, 1]")].concat());
    room.refused(&["run", "table.toml"], &["`law.table`", "as in the first row"]);
    table(&[row("time = 0"), row("time = 1").replace("[1, 2,", "[1, -2,")].concat());
    room.refused(&["run", "table.toml"], &["constant `H`", "-2", "law.table.1.constants"]);
    table(&[row("time = 0").replace("1]", "1, 10]"), row("time = 1").replace("1]", "1, -99]")].concat());
    room.refused(&["run", "table.toml"], &["C5", "row 2"]);
    table(&[row("temperature = 0"), row("temperature = 9").replace("[1, 2,", "[1, 3,")].concat());
    room.refused(&["run", "table.toml"], &["`temperature`", "column `temperature`", "`step.temperature`"]);
}

#[test]
fn what_the_history_gives_is_given_once() {
    let room = Room::new();
    room.write("twice.csv", "time,point,pressure,velocity,temperature,friction\n0,7,1,1,300,0.1\n1,7,1,1,300,0.2\n");
    let history = "contact.history=\"twice.csv\"";
    for (key, value, column) in [
        ("contact.friction", "contact.friction=0.3", "friction"),
        ("step.0.friction", "step=[{ duration = 1, friction = 0.3 }]", "friction"),
        ("step.0.temperature", "step=[{ duration = 1, temperature = 300 }]", "temperature"),
        ("step.0.velocity", "step=[{ duration = 1, velocity = 1 }]", "velocity"),
    ] {
        let telling = format!("`{key}` and a column `{column}` in `contact.history`, expected one of them");
        room.refused(&["plan", "scene.toml", "--set", history, "--set", value], &[&telling]);
    }
    assert_eq!(room.run(&["plan", "scene.toml", "--set", history]).code, 0);
}

#[test]
fn results_go_only_where_they_may() {
    let room = Room::new();
    std::fs::create_dir(room.file("other")).expect("a folder");
    room.write("other/thesis.tex", "years of work");
    room.refused(&["run", "scene.toml", "--out", "other"], &["other", "thesis.tex", "expected a new or empty folder"]);
    room.refused(&["run", "scene.toml", "--out", "scene.toml"], &["scene.toml", "is a file", "expected a folder"]);
    room.fails(&["run", "scene.toml", "--out", "/proc/results"], (5, "files"), &["/proc", "could not"]);
    room.fails(&["run", "scene.toml", "--out", "history.csv/x"], (5, "files"), &["history.csv/x", "could not"]);
}

#[test]
fn a_reference_that_does_not_fit_is_said_before_the_run() {
    let room = Room::new();
    for (text, telling) in [
        ("point,depth\n7,1\n", &["reference.csv", "`point`, `depth`", "`wear`"] as &[&str]),
        ("point,wear\n7,1\n", &["reference.csv", "no row for point 8"]),
        ("point,wear\n7,1\n8,NaN\n", &["reference.csv:3", "\"NaN\"", "finite"]),
        ("point,wear\n7,1\n8,x\n", &["reference.csv:3", "\"x\"", "finite number"]),
        ("", &["reference.csv", "`point` and `wear`"]),
    ] {
        room.write("reference.csv", text);
        room.refused(&["run", "scene.toml", "--set", "reference.file=\"reference.csv\""], telling);
    }
    let average = ["--set", "law.average=true", "--set", "reference.kind=\"archard-prescribed\""];
    room.refused(
        &[&["run", "scene.toml"], &average[..]].concat(),
        &["archard-prescribed", "does not cover", "averaged"],
    );
}

#[test]
fn a_second_order_method_needs_a_law_without_memory() {
    let room = Room::new();
    let source = concat!(env!("CARGO_MANIFEST_DIR"), "/../plugins/example-cpp/running_in.cpp");
    assert_eq!(room.run(&["build", "-q", "-o", "memory.so", source]).code, 0);
    let law = room.json_of(&["inspect", "memory.so", "--json"])["laws"][0].clone();
    let constants = law["constants"].as_array().expect("its constants").iter().map(|_| "1");
    let constants = format!("law.constants=[{}]", constants.collect::<Vec<_>>().join(","));
    let words = ["run", "scene.toml", "--law", "./memory.so", "--set", &constants];
    for method in ["tr-bdf2", "sdirk2"] {
        let set = format!("integrator.method=\"{method}\"");
        let telling = [method, "whole substep", "second-order", "\"auto\"", "integrator.method"];
        room.refused(&[&words[..], &["--set", &set]].concat(), &telling);
    }
}

#[test]
fn arguments_out_of_range_are_refused() {
    let room = Room::new();
    let before = room.entries();
    for (words, telling) in [
        (&["--threads", "0"] as &[&str], &["'0'", "--threads"] as &[&str]),
        (&["--threads", "many"], &["'many'", "--threads"]),
        (&["--isolate", "--deadline", "0"], &["'0'", "--deadline", "above 0"]),
        (&["--isolate", "--deadline", "nan"], &["'nan'", "--deadline"]),
        (&["--deadline", "3"], &["--isolate"]),
        (&["--treads", "2"], &["--treads", "--threads"]),
    ] {
        let words = [&["run", "scene.toml"], words].concat();
        let ended = room.run(&words);
        assert_eq!((ended.code, ended.stdout.as_str()), (2, ""), "{words:?}: {}", ended.stderr);
        for word in telling {
            assert!(ended.stderr.contains(word), "{words:?} does not say `{word}`: {}", ended.stderr);
        }
        let document = room.json(&[&words[..], &["--json"]].concat(), 2);
        assert_eq!(document["error"]["kind"], "input");
    }
    assert_eq!(room.entries(), before);
}
