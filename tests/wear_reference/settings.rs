//! What the documented constants C5 to C8 ask of the host: nodal stresses, averaging, directions.

use crate::solved::{Case, archard, near};

const TIGHT: &str = "[integrator]\ntolerance = 1e-12\n";

/// Depths K/H v p t at p = 1e6, 3e6, 0, 2e6; areas 1, 2, 5, 1: the mean over the three in contact is 9/4 of the first.
#[test]
fn averaging_takes_the_mean_by_area_over_the_points_in_contact() {
    let rows = |time: u32| format!("{time},0,1e6,0.1,1\n{time},1,3e6,0.1,2\n{time},2,0,0.1,5\n{time},3,2e6,0.1,1\n");
    let csv = format!("time,point,pressure,velocity,area\n{}{}", rows(0), rows(2));
    for law in ["constants = [1e-4, 1e9, 1, 1, 10]", "constants = [1e-4, 1e9, 1, 1]\naverage = true"] {
        let solved = Case::history(law, &csv, TIGHT).solve(&archard());
        for (i, wear) in solved.record.wear.iter().enumerate() {
            let expected = if i == 2 { 0.0 } else { 1e-13 * 0.1 * 2.0 * 9e6 / 4.0 };
            near(*wear, expected, 1e-14);
        }
        near(solved.record.history.last().expect("rows").wear_volume.expect("areas"), 1e-14 * 2.0 * 9e6, 1e-14);
    }
}

/// Without areas every point counts alike; a point that lifts off in between stops to wear.
#[test]
fn averaging_follows_the_contact() {
    let csv = "time,point,pressure,velocity\n0,0,1e6,0.1\n0,1,1e6,0.1\n2,0,1e6,0.1\n2,1,-1e6,0.1\n";
    let wear = Case::history("constants = [1e-4, 1e9, 1, 1, 10]", csv, TIGHT).wear();
    // Together until t = 1, where the second one opens: the mean of 1e6 and 5e5; then the first alone.
    near(wear[1], 1e-14 * 7.5e5, 1e-13);
    near(wear[0], 1e-14 * (7.5e5 + 1e6), 1e-13);
}

/// Traction max(0, -n.s.n) by hand for three tilted normals (not of length 1) under one stress.
#[test]
fn nodal_stresses_act_by_their_traction_along_the_normal() {
    let stress = [-1.0e6, 4.0e5, -3.0e6, 2.0e5, -6.0e5, 5.0e5];
    let normals = [[0.0, 0.0, 1.0], [3.0, 0.0, 4.0], [1.0, -2.0, 2.0], [0.0, 5.0, 0.0]];
    // -szz; (9 * 1e6 + 16 * 3e6 - 24 * 5e5) / 25; by hand below; -syy is negative: none.
    let by_hand: [f64; 4] = [
        3.0e6,
        (9.0 * 1.0e6 + 16.0 * 3.0e6 - 24.0 * 5.0e5) / 25.0,
        {
            let (xx, yy, zz) = (-1.0e6, 4.0 * 4.0e5, 4.0 * -3.0e6);
            let (xy, yz, xz) = (-2.0 * 2.0e5, -4.0 * -6.0e5, 2.0 * 5.0e5);
            -(xx + yy + zz + 2.0 * (xy + yz + xz)) / 9.0
        },
        0.0,
    ];
    let mut csv = "time,point,pressure,velocity,nx,ny,nz,sxx,syy,szz,sxy,syz,sxz\n".to_owned();
    for time in [0, 3] {
        for (i, n) in normals.iter().enumerate() {
            let [xx, yy, zz, xy, yz, xz] = stress;
            csv.push_str(&format!("{time},{i},7e6,0.1,{},{},{},{xx},{yy},{zz},{xy},{yz},{xz}\n", n[0], n[1], n[2]));
        }
    }
    for m in [1.0_f64, 1.5] {
        for law in [
            format!("constants = [1e-4, 1e9, {m}, 1, 1]"),
            format!("constants = [1e-4, 1e9, {m}, 1]\nbasis = \"nodal-stress\""),
        ] {
            let solved = Case::history(&law, &csv, TIGHT).solve(&archard());
            for (wear, traction) in solved.record.wear.iter().zip(by_hand) {
                near(*wear, 1e-14 * 3.0 * traction.powf(m), 1e-13);
            }
            near(solved.record.history.last().expect("rows").max_pressure, 3.0e6, 1e-15);
        }
    }
    let averaged = Case::history("constants = [1e-4, 1e9, 1, 1, 11]", &csv, TIGHT).wear();
    near(averaged[0], 1e-14 * 3.0 * (by_hand[0] + by_hand[1] + by_hand[2]) / 3.0, 1e-13);
    assert_eq!(averaged[3], 0.0);
}

/// Traction that goes through zero inside a row interval, at sixty different times.
#[test]
fn nodal_stresses_that_change_sign_keep_the_tolerance() {
    let mut csv = "time,point,velocity,sxx,syy,szz,sxy,syz,sxz\n".to_owned();
    for time in [0, 1] {
        for i in 0..60 {
            let szz = if time == 0 { -1e6 } else { 2e4 * f64::from(i) };
            csv.push_str(&format!("{time},{i},0.1,0,0,{szz},0,0,0\n"));
        }
    }
    let case = Case::history("constants = [1e-4, 1e9, 1.5, 1, 1]", &csv, "[integrator]\ntolerance = 1e-8\n");
    let exact = |i: usize| 1e-14 * 1e6_f64.powf(2.5) / 2.5 / (1e6 + 2e4 * i as f64);
    let wear = case.wear();
    let (error, size) = wear
        .iter()
        .enumerate()
        .fold((0.0, 0.0), |(error, size), (i, wear)| (error + (wear - exact(i)).powi(2), size + exact(i).powi(2)));
    let error = f64::sqrt(error / size);
    assert!(error < 1e-8, "{error:e}");
}

#[test]
fn averaged_nodal_stresses_follow_the_contact_too() {
    let csv = "time,point,velocity,sxx,syy,szz,sxy,syz,sxz\n0,0,0.1,0,0,-1e6,0,0,0\n0,1,0.1,0,0,-1e6,0,0,0\n\
               2,0,0.1,0,0,-1e6,0,0,0\n2,1,0.1,0,0,2e6,0,0,0\n";
    let wear = Case::history("constants = [1e-4, 1e9, 1, 1, 11]", csv, TIGHT).wear();
    // The second point opens at t = 2/3 after a mean of 5e5; together they wear (1e6 + 5e5) / 2 until then.
    near(wear[1], 1e-14 * 7.5e5 * 2.0 / 3.0, 1e-12);
    near(wear[0], 1e-14 * (7.5e5 * 2.0 / 3.0 + 1e6 * 4.0 / 3.0), 1e-12);
}

#[test]
fn a_direction_60_degrees_off_the_normal_halves_the_depth() {
    let step = "[[step]]\nduration = 2\npressure = 1e6\nvelocity = 0.1\n";
    let (sine, straight) = (0.75_f64.sqrt(), 1e-13 * 1e6 * 0.1 * 2.0);
    for (law, factor) in [
        (format!("constants = [1e-4, 1e9, 1, 1, 0, {sine:?}, 0, -0.5]"), 0.5),
        (format!("constants = [1e-4, 1e9, 1, 1]\ndirection = [0, {:?}, {:?}]", 10.0 * sine, -5.0), 0.5),
        ("constants = [1e-4, 1e9, 1, 1]\ndirection = [0, 0, -3]".to_owned(), 1.0),
        (format!("constants = [1e-4, 1e9, 1, 1, -99, {sine:?}, 0, -0.5]"), 0.5),
    ] {
        near(Case::steps(&law, &format!("{step}{TIGHT}")).wear()[0], factor * straight, 1e-15);
    }
}

/// The normal of each point counts: straight down is 60 degrees off a normal that leans by 60 degrees.
#[test]
fn directions_are_taken_against_the_normal_of_each_point() {
    let sine = 0.75_f64.sqrt();
    let row = |time: u32| format!("{time},0,1e6,0.1,0,0,2\n{time},1,1e6,0.1,{sine:?},0,0.5\n");
    let csv = format!("time,point,pressure,velocity,nx,ny,nz\n{}{}", row(0), row(2));
    let wear = Case::history("constants = [1e-4, 1e9, 1, 1]\ndirection = [0, 0, -1]", &csv, TIGHT).wear();
    near(wear[0], 2e-8, 1e-15);
    near(wear[1], 1e-8, 1e-15);
    let grows = Case::history("constants = [1e-4, 1e9, 1, 1]\ndirection = [-1, 0, 0.6]", &csv, TIGHT);
    let end = format!("{:?}", grows.end(&archard()).record.end);
    assert!(end.contains("Direction") && end.contains("point: 0"), "{end}");
}
