//! The histories that come with the scenes: made by the script beside this file, and true to the
//! theory that they are made from.

use std::path::{Path, PathBuf};
use std::process::Command;
use wearlaw::contact::prescribed::{Column, History, Needs, PointIds, RowView};
use wearlaw::reference::archard::{ArchardConstants, TablePoint, prescribed};
use wearlaw::reference::pieces::pieces_from_velocity;

fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes")
}

fn read(name: &str, columns: &[Column]) -> History {
    History::read(&scenes().join(name), &Needs::of(columns)).expect("a committed history")
}

fn row<'a>(history: &'a History, column: Column, k: usize) -> Vec<f64> {
    let view = history.column(column).expect("a column that was asked for");
    let row: RowView<'a> = view.row(k);
    (0..history.points()).map(|i| row.value(i)).collect()
}

#[test]
fn the_script_reproduces_the_committed_histories() {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/make_fretting_history.py");
    let folder = tempfile::tempdir().expect("a temporary folder");
    let run = match Command::new("python3").arg(&script).arg(folder.path()).output() {
        Ok(run) => run,
        Err(fault) if fault.kind() == std::io::ErrorKind::NotFound => {
            println!("NOT RUN: the_script_reproduces_the_committed_histories (no python3)");
            return;
        }
        Err(fault) => panic!("python3 cannot be started: {fault}"),
    };
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    for name in ["fretting_history.csv", "nodal_stress_history.csv"] {
        let made = std::fs::read(folder.path().join(name)).expect("a file made by the script");
        let committed = std::fs::read(scenes().join(name)).expect("a committed file");
        assert!(made == committed, "{name} differs from what its script makes");
        assert!(committed.len() < 4 << 20);
    }
}

#[test]
fn the_fretting_history_obeys_hertz_and_partial_slip() {
    let (load, friction, largest) = (18.5e3, 0.6, 0.8);
    let columns = [Column::Pressure, Column::Slip, Column::Shear, Column::X];
    let history = read("fretting_history.csv", &columns);
    assert_eq!((history.points(), history.times().len()), (201, 241));
    assert_eq!(*history.point_ids(), PointIds::Counted(201));
    assert!(history.column(Column::Pressure).unwrap().is_constant_in_time());
    let x = row(&history, Column::X, 0);
    let pressure = row(&history, Column::Pressure, 0);
    let spacing = x[1] - x[0];
    let total = |values: &[f64]| values.iter().sum::<f64>() * spacing;
    assert!((total(&pressure) / load - 1.0).abs() < 1e-3);

    let mut work = 0.0;
    for k in 0..history.times().len() {
        let (shear, slip) = (row(&history, Column::Shear, k), row(&history, Column::Slip, k));
        let phase = 2.0 * std::f64::consts::PI * k as f64 / 240.0;
        let tangential = largest * friction * load * phase.sin();
        assert!((total(&shear) - tangential).abs() < 2e-3 * friction * load, "row {k}");
        assert_eq!(slip[100], 0.0, "the centre sticks");
        for i in 0..201 {
            assert!(shear[i].abs() <= friction * pressure[i] + 1e3, "friction limit, row {k}, point {i}");
        }
        if k == 0 {
            assert!(slip.iter().chain(&shear).all(|v| *v == 0.0));
            continue;
        }
        let (shear_before, slip_before) = (row(&history, Column::Shear, k - 1), row(&history, Column::Slip, k - 1));
        for i in 0..201 {
            let mean = 0.5 * (shear[i] + shear_before[i]);
            // Friction opposes the motion of the wearing body; rounding of the digits aside.
            let piece = -mean * (slip[i] - slip_before[i]);
            assert!(piece >= -1e-13 * 2e8, "row {k}, point {i}: {piece}");
            work += piece * spacing;
        }
    }
    assert!(work > 0.0);
    // A quarter of the cycle and its reversal: at Q = -Q* the slip mirrors that at Q = Q*.
    let (top, bottom) = (row(&history, Column::Slip, 60), row(&history, Column::Slip, 180));
    assert!(top.iter().zip(&bottom).all(|(a, b)| (a + b).abs() <= 1.01e-13));
    assert!(top.iter().any(|s| *s < -1e-8), "it slips by tens of nanometres at the edges");
}

#[test]
fn nodal_stresses_balance_the_pressure() {
    let mut columns = vec![Column::Pressure, Column::Velocity, Column::Area];
    columns.extend(Column::NORMAL.iter().chain(&Column::STRESS));
    let history = read("nodal_stress_history.csv", &columns);
    assert_eq!((history.points(), history.times().len()), (21, 41));
    for k in 0..41 {
        let of = |column| row(&history, column, k);
        let (pressure, area) = (of(Column::Pressure), of(Column::Area));
        let normal = Column::NORMAL.map(of);
        let [xx, yy, zz, xy, yz, xz] = Column::STRESS.map(of);
        for i in 0..21 {
            let n = normal.each_ref().map(|component| component[i]);
            let s = [[xx[i], xy[i], xz[i]], [xy[i], yy[i], yz[i]], [xz[i], yz[i], zz[i]]];
            let traction: f64 = (0..9).map(|at| -n[at / 3] * s[at / 3][at % 3] * n[at % 3]).sum();
            assert!((traction.max(0.0) - pressure[i]).abs() <= 1e-9 * pressure[i], "{k} {i}");
        }
        let load: f64 = pressure.iter().zip(&area).map(|(p, a)| p * a).sum();
        let expected = 18.5e3 * (0.25 + 0.75 * k as f64 / 40.0);
        assert!((load / expected - 1.0).abs() < 0.05, "row {k}: {load} of {expected}");
    }
}

#[test]
fn the_pin_on_disc_gives_the_published_depth() {
    let history = read("pin_on_disc.csv", &[Column::Pressure, Column::Velocity]);
    let pressure = history.column(Column::Pressure).unwrap();
    let velocity = history.column(Column::Velocity).unwrap();
    let pieces = pieces_from_velocity(history.times(), |k| pressure.value(k, 2), |k| velocity.value(k, 2));
    let point = |time, constants| TablePoint { time, constants: ArchardConstants::from_array(constants) };
    let table = [point(0.0, [1e-4, 2e3, 1.0, 1.0]), point(1.0, [3e-4, 1e3, 1.5, 0.8])];
    let depth = prescribed(&table, &pieces).expect("a depth");
    assert!((depth / 7.322799325112124e-6 - 1.0).abs() < 1e-14, "{depth:e}");
    assert!(history.bytes() < 100, "uniform and constant columns cost nothing: {}", history.bytes());
}
