//! Mistakes that only a scene with a solved contact can hold.

use super::*;

#[track_caller]
fn each(cases: &str) {
    refused_each(HALF_SPACE, cases);
}

#[track_caller]
fn bad(from: &str, to: &str, message: &str, line: usize, column: usize) {
    refused(HALF_SPACE, from, to, message, line, column);
}

#[test]
fn keys_of_another_model() {
    each(
        r#"
            modulus = 1e11 => history = "a.csv"\nmodulus = 1 => found `contact.history` in a scene with contact.model = "halfspace", expected it only with `prescribed` => 5:1
            load = 10.0 => pressure = 1 => found `step.0.pressure` => 14:1
            load = 10.0 => load = 1\nfriction = 1 => found `step.0.friction` => 15:1
        "#,
    );
    let foundation = HALF_SPACE.replace("halfspace", "foundation").replace("modulus", "stiffness");
    assert!(parse(&foundation).is_ok());
    refused(
        &foundation,
        "stiffness",
        "boundary = \"free\"\nstiffness",
        "found `contact.boundary` in a scene with contact.model = \"foundation\"",
        5,
        1,
    );
    refused(&foundation, "stiffness = 1e11", "", "found no `stiffness` in `contact`", 3, 1 + 1);
}

#[test]
fn elasticity_is_given_once() {
    each(
        r#"
            modulus = 1e11 =>  => found no `modulus` or `bodies` in `contact` => 3:2
            modulus = 1e11 => modulus = 1\nbodies = [] => found both `contact.modulus` and `contact.bodies` => 6:1
            modulus = 1e11 => modulus = 0 => found 0.0 for `contact.modulus`, expected a number above 0 => 5:11
            modulus = 1e11 => bodies = [{ E = 1, nu = 0.3 }] => found 1 entry for `contact.bodies`, expected 2 because two bodies touch => 5:10
            modulus = 1e11 => bodies = [{ E = 1, nu = 0.3 }, { E = 1, nu = 0.6 }] => found 0.6 for `contact.bodies.1.nu`, expected a number above -1 and not above 0.5 => 5:46
            modulus = 1e11 => bodies = [{ E = 1, nu = 0.3 }, { E = 1, mu = 0.3 }] => unknown key `mu` in `contact.bodies.1`, did you mean `nu`? => 5:41
            modulus = 1e11 => modulus = 1\ntolerance = 0 => found 0.0 for `contact.tolerance` => 6:13
        "#,
    );
}

#[test]
fn the_grid_fits_the_dimension() {
    each(
        r#"
            [grid]\nsize = [1e-3, 1e-3]\ncells = [64, 64] =>  => found no `grid` in the scene, expected one because the contact is solved => 1:1
            size = [1e-3, 1e-3] => size = [1e-3] => found 1 entry for `grid.size`, expected 2 in a scene with contact.dimension = 3 => 7:8
            modulus => dimension = 2\nmodulus => found 2 entries for `grid.size`, expected 1 in a scene with contact.dimension = 2 => 8:8
            [64, 64] => [64, 0] => found 0 for `grid.cells.1`, expected a whole number not below 1 => 8:14
            [64, 64] => [2000000000, 2000000000] => expected at most 1099511627776 cells in all => 8:9
            [64, 64] => [64, 6.5] => found the number 6.5 for `grid.cells.1` => 8:14
            [1e-3, 1e-3] => [1e-3, -1e-3] => found -0.001 for `grid.size.1` => 7:15
            radius = 5e-3 => radius = 5e-3\ncenter = [0] => found 1 entry for `surface.center` => 12:10
        "#,
    );
}

#[test]
fn shapes_have_their_keys() {
    each(
        r#"
            "sphere" => "spere" => found "spere" for `surface.shape`, did you mean `sphere`? => 10:9
            "sphere" => "cone" => found `surface.radius` where surface.shape = "cone", expected it only with `sphere` or `cylinder` => 11:1
            radius = 5e-3 =>  => found no `radius` in `surface` => 9:2
            radius = 5e-3 => radius = 5e-3\nwave = 3 => unknown key `wave` in `surface`, did you mean `waves`? => 12:1
        "#,
    );
    let wavy = HALF_SPACE.replace("\"sphere\"\nradius = 5e-3", "\"wavy\"\namplitude = 1\nwaves = [1, 1]");
    refused(&wavy, "[1, 1]", "[0, 0]", "found 0 for `surface.waves`", 12, 9);
    refused(&wavy, "[1, 1]", "[1]", "found 1 entry for `surface.waves`, expected 2", 12, 9);
    let rough = "\"rough\"\nhurst = 0.8\nrms_slope = 0.1\nroll_off = 4\ncut_off = 64";
    let rough = HALF_SPACE.replace("\"sphere\"\nradius = 5e-3", rough);
    assert!(parse(&rough).is_ok());
    refused(
        &rough,
        "cut_off = 64",
        "cut_off = 2",
        "found 2.0 for `surface.cut_off`, expected a number not below 4",
        14,
        11,
    );
    refused(&rough, "hurst = 0.8", "hurst = 1.1", "above 0 and not above 1", 11, 9);
}

#[test]
fn steps_press_in_one_way() {
    each(
        r#"
            load = 10.0 => load = 10.0\napproach = 1 => found both `step.0.load` and `step.0.approach` => 15:1
            load = 10.0 =>  => found no `load` or `approach` in `step.0` => 12:1
            load = 10.0 => load = -10.0 => found -10.0 for `step.0.load` => 14:8
        "#,
    );
    let after = "load = 10.0\n[[step]]\nduration = 1\napproach = 1\nramp = [\"approach\"]";
    bad("load = 10.0", after, "found `approach` in `step.1.ramp`, expected `step.0` to give it too", 18, 1);
    let cycle = "load = 10.0\n[[cycle]]\ncount = 2\n[[cycle.step]]\nduration = 1\nload = 5\nramp = [\"load\"]\n[[cycle.step]]\nduration = 1\napproach = 5";
    bad("load = 10.0", cycle, "found `load` in `cycle.0.step.0.ramp`, expected `cycle.0.step.1` to give it too", 20, 1);
    assert!(parse(&HALF_SPACE.replace("load = 10.0", &cycle.replace("count = 2", "count = 1"))).is_ok());
}

#[test]
fn a_datum_belongs_to_flat_free_contact_under_approach() {
    let condition = "found `contact.datum`, expected it only in 2-D contact with a free boundary under `approach`";
    bad("modulus", "datum = 1\nmodulus", condition, 5, 1);
    let plane = HALF_SPACE.replace(", 1e-3]", "]").replace(", 64]", "]").replace("modulus", "dimension = 2\nmodulus");
    refused(&plane, "modulus", "datum = 1\nmodulus", condition, 6, 1);
    refused(&plane, "load", "approach", "found no `datum` in `contact`", 3, 2);
    let approach = plane.replace("load", "approach");
    assert!(parse(&approach.replace("modulus", "datum = 1\nmodulus")).is_ok());
    let periodic = approach.replace("modulus", "boundary = \"periodic\"\nmodulus");
    assert!(parse(&periodic).is_ok());
    refused(&periodic, "modulus", "datum = 1\nmodulus", condition, 7, 1);
}
