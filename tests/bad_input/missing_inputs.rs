//! Laws that read what a scene cannot give: exit code 2 before the run, naming the key that would give it.

use super::c_laws::CLaw;
use super::program::Room;

#[test]
fn the_key_that_would_give_a_missing_field_is_named() {
    let room = Room::new();
    for (field, telling) in [
        ("WL_FIELD_TEMPERATURE", &["reads `temperature`", "column `temperature`", "`step.temperature`"] as &[&str]),
        (
            "WL_FIELD_FRICTION_STRESS",
            &["reads `friction_stress`", "`contact.friction`", "column `friction` or `shear`"],
        ),
        ("WL_FIELD_FRICTION_WORK", &["reads `friction_work`", "`contact.friction`"]),
        ("WL_FIELD_FRICTION_COEFFICIENT", &["reads `friction_coefficient`", "`contact.friction`", "column `friction`"]),
        ("WL_FIELD_COORDINATES", &["reads `coordinates`", "columns `x`, `y`, `z`"]),
        ("WL_FIELD_AREA", &["reads `area`", "column `area`"]),
        ("WL_FIELD_NODAL_TRACTION", &["reads `nodal_traction`", "`sxx` to `sxz`"]),
        ("WL_FIELD_GAP", &["reads `gap`", "`contact.model`", "foundation"]),
    ] {
        let law = CLaw::with(&format!("#define READS (WL_FIELD_PRESSURE | WL_FIELD_SLIP | {field})\n"), "");
        let path = law.path();
        for command in ["run", "plan"] {
            let words =
                [command, "scene.toml", "--law", path.to_str().expect("a plain name"), "--set", "law.constants=[2]"];
            room.refused(&words, telling);
        }
    }
    assert!(room.file("notes").exists(), "these laws load; it is the scene that falls short");
}

#[test]
fn a_further_input_is_missed_by_its_name() {
    let room = Room::new();
    room.write(
        "film.c",
        r#"
#define LAW_NAME "film"
#define LAW_VERSION "1"
#define LAW_SUMMARY "a film keeps the surfaces apart"
#define LAW_READS(F) F(pressure) F(slip)
#define LAW_INPUTS(C) C(film_thickness, WL_METRE, WL_FROM(0), WL_REQUIRED, "thickness of the film")
#define LAW_CONSTANTS(C) C(k, WL_PER_PASCAL, WL_FROM(0), WL_REQUIRED, "specific wear rate")
#include "wearlaw_point.h"
WL_POINT {
    out->increment = c->k * in->pressure * in->slip * in->film_thickness;
    return WL_OK;
}
"#,
    );
    assert_eq!(room.run(&["build", "film.c", "-q", "-o", "film.so"]).code, 0);
    let words = ["run", "scene.toml", "--law", "./film.so", "--set", "law.constants=[2]"];
    room.refused(&words, &["reads `film_thickness`", "a column `film_thickness` in `contact.history`"]);
    room.write("history.csv", "time,point,pressure,velocity,film_thicknes\n0,7,1,1,1\n1,7,1,1,1\n");
    room.refused(&words, &["unknown column `film_thicknes`", "`film_thickness`"]);
    room.write("history.csv", "time,point,pressure,velocity,film_thickness\n0,7,1,1,1\n1,7,1,1,1\n");
    assert_eq!(room.run(&words).code, 0, "the column gives it");
}
