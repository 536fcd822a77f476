use super::super::{Mirror, mirrors, std_of_gap};
use super::*;

#[test]
fn the_spread_of_a_gap_leaves_out_what_never_touches() {
    let three = line(4, 0.5);
    close(std_of_gap(&three, &[1.0, 2.0, f64::INFINITY, 6.0]), (14.0_f64 / 3.0).sqrt(), 1e-15);
    close(std_of_gap(&three, &[1e-200, 2e-200, f64::INFINITY, 6e-200]), (14.0_f64 / 3.0).sqrt() * 1e-200, 1e-14);
}

#[test]
fn a_flat_gap_still_has_a_length() {
    let cells = line(3, 0.5);
    assert_eq!(std_of_gap(&cells, &[0.1, 0.1, 0.1]), 0.1);
    assert_eq!(std_of_gap(&cells, &[0.0, 0.0, f64::INFINITY]), 0.5);
    assert_eq!(std_of_gap(&cells, &[f64::INFINITY; 3]), 0.5);
}

#[test]
fn a_sphere_mirrors_about_its_apex() {
    let grid = cells([9, 8], [0.1, 0.1]);
    let sphere = gap(Shape::Sphere { radius: 1.0 }, &grid).unwrap();
    let free = mirrors(&grid, &sphere, false);
    assert_eq!(free, [Some(Mirror { sum: 8, without_image: 0 }), Some(Mirror { sum: 8, without_image: 1 })]);
    let periodic = mirrors(&grid, &sphere, true);
    assert_eq!(periodic, [Some(Mirror { sum: 8, without_image: 0 }), Some(Mirror { sum: 0, without_image: 0 })]);
    let centred = gap_at(Shape::Sphere { radius: 1.0 }, [0.45, 0.4], &grid, false).unwrap();
    assert_eq!(
        mirrors(&grid, &centred, false).map(|mirror| mirror.map(|m| (m.sum, m.without_image))),
        [Some((8, 0)), Some((7, 0))]
    );
    let aside = gap_at(Shape::Sphere { radius: 1.0 }, [0.25, 0.2], &grid, false).unwrap();
    let expected = [Some(Mirror { sum: 4, without_image: 4 }), Some(Mirror { sum: 3, without_image: 4 })];
    assert_eq!(mirrors(&grid, &aside, false), expected);
}

#[test]
fn every_smooth_shape_is_symmetric_to_the_bit() {
    let grid = cells([30, 31], [1.0 / 3.0, 0.7]);
    let shapes = [
        Shape::Sphere { radius: 0.3 },
        Shape::Cylinder { radius: 0.3 },
        Shape::Cone { angle: 12.3 },
        Shape::FlatPunch { width: 5.1 },
        Shape::Wavy { amplitude: 0.1, waves: [3, 2] },
    ];
    for shape in shapes {
        let surface = gap(shape.clone(), &grid).unwrap();
        for periodic in [false, true] {
            assert!(mirrors(&grid, &surface, periodic).iter().all(Option::is_some), "{shape:?}");
        }
    }
}

#[test]
fn one_bit_breaks_a_mirror() {
    let grid = cells([9, 9], [0.1, 0.1]);
    let mut sphere = gap(Shape::Sphere { radius: 1.0 }, &grid).unwrap();
    sphere[4 * 9] = sphere[4 * 9].next_up();
    assert_eq!(mirrors(&grid, &sphere, false), [None, Some(Mirror { sum: 8, without_image: 0 })]);
    let rough = Shape::Rough { hurst: 0.5, rms_slope: 0.1, roll_off: 1.0, cut_off: 4.0, seed: 1 };
    assert_eq!(mirrors(&grid, &gap(rough, &grid).unwrap(), true), [None, None]);
}
