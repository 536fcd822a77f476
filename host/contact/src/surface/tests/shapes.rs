use super::*;
use std::f64::consts::PI;

#[test]
fn a_sphere_touches_at_the_centre_of_the_middle_cell() {
    let cells = cells([8, 5], [0.5, 0.25]);
    let gap = gap(Shape::Sphere { radius: 3.0 }, &cells).unwrap();
    assert_eq!(gap[2 * 8 + 4], 0.0);
    for y in 0..5 {
        for x in 0..8 {
            let (dx, dy) = ((x as f64 - 4.0) * 0.5, (y as f64 - 2.0) * 0.25);
            close(gap[y * 8 + x], (dx * dx + dy * dy) / 6.0, 1e-15);
        }
    }
}

#[test]
fn a_cylinder_has_its_axis_along_y() {
    let gap = gap(Shape::Cylinder { radius: 2.0 }, &cells([4, 3], [1.0, 7.0])).unwrap();
    assert_eq!(gap, [1.0, 0.25, 0.0, 0.25].repeat(3));
}

#[test]
fn in_two_dimensions_only_x_counts() {
    let cells = line(5, 0.5);
    let parabola = [0.25, 0.0625, 0.0, 0.0625, 0.25];
    assert_eq!(gap(Shape::Sphere { radius: 2.0 }, &cells).unwrap(), parabola);
    assert_eq!(gap(Shape::Cylinder { radius: 2.0 }, &cells).unwrap(), parabola);
    assert_eq!(gap_at(Shape::Sphere { radius: 2.0 }, [1.25, 99.0], &cells, false).unwrap(), parabola);
    let wedge = gap(Shape::Cone { angle: 45.0 }, &cells).unwrap();
    wedge.iter().zip([1.0, 0.5, 0.0, 0.5, 1.0]).for_each(|(gap, x)| close(*gap, x, 1e-15));
}

#[test]
fn a_cone_rises_with_its_angle() {
    let gap = gap(Shape::Cone { angle: 30.0 }, &cells([7, 9], [3.0, 4.0])).unwrap();
    close(gap[5 * 7 + 4], 5.0 / 3.0_f64.sqrt(), 1e-15);
}

#[test]
fn the_apex_moves_with_the_centre() {
    let cells = cells([6, 6], [0.1, 0.1]);
    // On the corner between four cells.
    let gap = gap_at(Shape::Sphere { radius: 1.0 }, [0.3, 0.3], &cells, false).unwrap();
    for at in [2 * 6 + 2, 2 * 6 + 3, 3 * 6 + 2, 3 * 6 + 3] {
        close(gap[at], 0.0025, 1e-14);
        assert_eq!(gap[at].to_bits(), gap[2 * 6 + 2].to_bits());
    }
    // On a centre, whose position is not a double.
    let gap = gap_at(Shape::Sphere { radius: 1.0 }, [0.35, 0.15], &cells, false).unwrap();
    assert_eq!(gap[6 + 3], 0.0);
}

#[test]
fn on_a_periodic_grid_the_nearest_image_counts() {
    let cells = cells([8, 4], [1.0, 1.0]);
    let shape = || Shape::Sphere { radius: 0.5 };
    let wrapped = gap_at(shape(), [0.5, 2.5], &cells, true).unwrap();
    assert_eq!(wrapped[2 * 8..3 * 8], [0.0, 1.0, 4.0, 9.0, 16.0, 9.0, 4.0, 1.0]);
    let free = gap_at(shape(), [0.5, 2.5], &cells, false).unwrap();
    assert_eq!(free[2 * 8 + 7], 49.0);
}

#[test]
fn a_flat_punch_ends_at_its_width() {
    let infinite = f64::INFINITY;
    // The edge lies on a centre: 0.3 = 3 * 0.1 to rounding.
    let gap_of = |cells: &Cells, width| gap(Shape::FlatPunch { width }, cells);
    let inside = gap_of(&line(9, 0.1), 0.6).unwrap();
    assert_eq!(inside, [infinite, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, infinite]);
    let disc = gap_of(&cells([3, 3], [1.0, 1.0]), 2.0).unwrap();
    assert_eq!(disc, [infinite, 0.0, infinite, 0.0, 0.0, 0.0, infinite, 0.0, infinite]);
    let between = gap_at(Shape::FlatPunch { width: 0.9 }, [2.0, 2.0], &cells([4, 4], [1.0, 1.0]), false);
    let error = between.unwrap_err().to_string();
    assert!(
        error.starts_with("no centre of a cell lies within the flat punch of width 9e-1, expected a width"),
        "{error}"
    );
}

#[test]
fn waves_have_their_crest_at_the_apex() {
    let cells = cells([16, 12], [0.5, 1.0]);
    let gap = gap(Shape::Wavy { amplitude: 2.0, waves: [3, 2] }, &cells).unwrap();
    for y in 0..12 {
        for x in 0..16 {
            let (dx, dy) = (x as f64 - 8.0, y as f64 - 6.0);
            let height = 2.0 * (2.0 * PI * 3.0 * dx / 16.0).cos() * (2.0 * PI * 2.0 * dy / 12.0).cos();
            assert!((gap[y * 16 + x] - (2.0 - height)).abs() < 1e-14);
        }
    }
    assert_eq!(gap[6 * 16 + 8], 0.0);
    assert!(gap.iter().all(|gap| *gap >= 0.0));
}

#[test]
fn a_direction_without_waves_has_the_factor_one() {
    let gap = gap(Shape::Wavy { amplitude: 1.0, waves: [1, 0] }, &cells([4, 3], [1.0, 1.0])).unwrap();
    let expected = [2.0, 1.0, 0.0, 1.0].repeat(3);
    gap.iter().zip(expected).for_each(|(gap, expected)| assert!((gap - expected).abs() < 1e-15));
}

#[test]
fn small_gaps_near_a_crest_keep_their_digits() {
    let gap = gap(Shape::Wavy { amplitude: 1.0, waves: [1, 0] }, &line(1 << 20, 1.0)).unwrap();
    let phase = 2.0 * PI / f64::from(1 << 20);
    close(gap[(1 << 19) + 1], phase * phase / 2.0, 1e-11);
}

#[test]
fn numbers_that_give_no_shape_are_refused_by_name() {
    let cells = cells([8, 8], [1.0, 1.0]);
    let text = |shape| gap(shape, &cells).unwrap_err().to_string();
    let positive = "expected a finite number above 0";
    assert_eq!(text(Shape::Sphere { radius: 0.0 }), format!("`surface.radius` is 0, {positive}"));
    assert_eq!(text(Shape::Cylinder { radius: f64::NAN }), format!("`surface.radius` is NaN, {positive}"));
    assert_eq!(text(Shape::FlatPunch { width: f64::INFINITY }), format!("`surface.width` is inf, {positive}"));
    assert_eq!(text(Shape::Cone { angle: 90.0 }), "`surface.angle` is 90, expected degrees between 0 and 90");
    let waves = |amplitude, waves| text(Shape::Wavy { amplitude, waves });
    assert_eq!(waves(-1.0, [1, 1]), "`surface.amplitude` is -1, expected a finite number of 0 or more");
    let many = "`surface.waves` asks for 5 waves over the 8 cells in y, expected at most 4: a wave needs two cells";
    assert_eq!(waves(1.0, [4, 5]), many);
    let nowhere = gap_at(Shape::Sphere { radius: 1.0 }, [0.0, f64::NAN], &cells, false).unwrap_err().to_string();
    assert_eq!(nowhere, "`surface.center` is NaN, expected a finite number");
}

#[test]
fn lengths_far_from_one_keep_the_shape() {
    let gap_of = |scale: f64| gap(Shape::Sphere { radius: scale }, &line(5, scale)).unwrap();
    for scale in [1e-200, 1e-12, 1e6, 1e200] {
        gap_of(scale).iter().zip(gap_of(1.0)).for_each(|(gap, unit)| close(*gap, unit * scale, 1e-14));
    }
}
