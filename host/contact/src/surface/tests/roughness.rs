use super::super::rough::Spectrum;
use super::*;
use std::f64::consts::{PI, TAU};

fn spectrum() -> Spectrum {
    Spectrum { hurst: 0.8, rms_slope: 0.2, roll_off: 3.0, cut_off: 7.0, seed: 11 }
}

/// Amplitude of the wave (kx, ky) in heights, by a transform of its own.
fn amplitude(heights: &[f64], counts: [usize; 2], kx: i64, ky: i64) -> f64 {
    let (mut re, mut im) = (0.0, 0.0);
    for (at, height) in heights.iter().enumerate() {
        let (x, y) = ((at % counts[0]) as f64, (at / counts[0]) as f64);
        let angle = TAU * (kx as f64 * x / counts[0] as f64 + ky as f64 * y / counts[1] as f64);
        re += height * angle.cos();
        im += height * angle.sin();
    }
    2.0 * re.hypot(im) / heights.len() as f64
}

/// Mean of the squared gradient, wave by wave.
fn slope(heights: &[f64], cells: &Cells) -> f64 {
    let [nx, ny] = cells.counts;
    let [lx, ly] = [nx as f64 * cells.spacing[0], ny as f64 * cells.spacing[1]];
    let mut square = 0.0;
    for kx in 0..=(nx as i64 - 1) / 2 {
        for ky in -(ny as i64 - 1) / 2..=(ny as i64 - 1) / 2 {
            if kx > 0 || ky > 0 {
                let q = (TAU * kx as f64 / lx).hypot(TAU * ky as f64 / ly);
                square += (q * amplitude(heights, cells.counts, kx, ky)).powi(2) / 2.0;
            }
        }
    }
    square.sqrt()
}

#[test]
fn the_slope_is_the_one_asked_for() {
    let square = cells([17, 17], [0.3, 0.3]);
    close(slope(&spectrum().heights(&square).unwrap(), &square), 0.2, 1e-12);
    let oblong = cells([15, 31], [0.3, 0.3]);
    close(slope(&spectrum().heights(&oblong).unwrap(), &oblong), 0.2, 1e-12);
    let profile = line(33, 1e-6);
    close(slope(&spectrum().heights(&profile).unwrap(), &profile), 0.2, 1e-12);
}

#[test]
fn the_spectrum_is_flat_then_falls_then_ends() {
    let cells_of = cells([19, 19], [1.0, 1.0]);
    let heights = spectrum().heights(&cells_of).unwrap();
    let at = |kx, ky| amplitude(&heights, [19, 19], kx, ky);
    let flat = at(1, 0);
    close(at(0, 3), flat, 1e-12);
    close(at(2, -1), flat, 1e-12);
    close(at(6, 0), flat * 2.0_f64.powf(-1.8), 1e-12);
    close(at(3, -4), flat * (5.0_f64 / 3.0).powf(-1.8), 1e-12);
    assert!(at(8, 0) < 1e-12 * flat && at(5, 5) < 1e-12 * flat && at(0, 0) < 1e-12 * flat);
    let heights = spectrum().heights(&line(19, 1.0)).unwrap();
    let at = |k| amplitude(&heights, [19, 1], k, 0);
    close(at(3), at(1), 1e-12);
    close(at(6), at(1) * 2.0_f64.powf(-1.3), 1e-12);
}

#[test]
fn a_finer_grid_and_a_higher_cut_off_keep_the_surface() {
    // A third of a cell: every centre of the coarse cells is one of the fine cells.
    let (coarse, fine) = (cells([16, 20], [0.3, 0.3]), cells([48, 60], [0.1, 0.1]));
    let (low, high) = (spectrum().heights(&coarse).unwrap(), spectrum().heights(&fine).unwrap());
    for y in 0..20 {
        for x in 0..16 {
            assert!((low[y * 16 + x] - high[(3 * y + 1) * 48 + 3 * x + 1]).abs() < 1e-13);
        }
    }
    let phase = |heights: &[f64], kx: f64| {
        let turned = |trig: fn(f64) -> f64| (0..48).map(|x| heights[x] * trig(TAU * kx * x as f64 / 48.0)).sum::<f64>();
        turned(f64::sin).atan2(turned(f64::cos))
    };
    let (fine, rows) = (line(48, 0.1), 2.0);
    let few = spectrum().heights(&fine).unwrap();
    let many = Spectrum { cut_off: 20.0, ..spectrum() }.heights(&fine).unwrap();
    assert!((phase(&few, rows) - phase(&many, rows)).abs() < 1e-12);
}

#[test]
fn seeds_give_surfaces_of_their_own() {
    let cells = cells([16, 16], [1.0, 1.0]);
    let heights = |seed| Spectrum { seed, ..spectrum() }.heights(&cells).unwrap();
    assert_eq!(heights(11), heights(11));
    assert_ne!(heights(11), heights(12));
    // Phases are spread: a surface that is one pulse would be far higher over its mean than this.
    let heights = heights(11);
    let rms = (heights.iter().map(|h| h * h).sum::<f64>() / 256.0).sqrt();
    let highest = heights.iter().copied().fold(0.0, f64::max);
    assert!(highest < 5.0 * rms, "{highest} {rms}");
}

#[test]
fn a_single_wave_is_a_cosine_of_that_slope() {
    let one = Spectrum { hurst: 1.0, rms_slope: 1.0, roll_off: 1.0, cut_off: 1.0, seed: 0 };
    let heights = one.heights(&line(64, 1.0)).unwrap();
    close(heights.iter().copied().fold(0.0, f64::max), 2.0_f64.sqrt() * 64.0 / (2.0 * PI), 3e-3);
}

#[test]
fn the_gap_hangs_from_the_highest_cell() {
    let cells = cells([16, 16], [1.0, 1.0]);
    let heights = spectrum().heights(&cells).unwrap();
    let Spectrum { hurst, rms_slope, roll_off, cut_off, seed } = spectrum();
    let gap = gap(Shape::Rough { hurst, rms_slope, roll_off, cut_off, seed }, &cells).unwrap();
    let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    assert_eq!(gap, heights.iter().map(|height| highest - height).collect::<Vec<_>>());
    assert!(gap.contains(&0.0));
}

#[test]
fn a_spectrum_that_the_grid_cannot_show_is_refused() {
    let text = |spectrum: Spectrum, cells: &Cells| spectrum.heights(cells).unwrap_err().to_string();
    let grid = cells([12, 40], [1.0, 1.0]);
    assert_eq!(
        text(spectrum(), &grid),
        "`surface.cut_off` asks for 7 waves over the 12 cells in x, expected at most 6: a wave needs two cells"
    );
    let flat = cells([40, 12], [1.0, 0.25]);
    assert_eq!(
        text(Spectrum { cut_off: 20.0, ..spectrum() }, &cells([40, 12], [1.0, 4.0])),
        "`surface.cut_off` asks for 20 waves over the 12 cells in y, expected at most 5: a wave needs two cells"
    );
    assert!(Spectrum { cut_off: 20.0, ..spectrum() }.heights(&flat).is_ok());
    let below = Spectrum { roll_off: 0.5, cut_off: 0.9, ..spectrum() };
    assert_eq!(
        text(below, &grid),
        "`surface.cut_off` is 0.9, expected at least 1: no whole wave fits between 1 and it"
    );
    let hurst = Spectrum { hurst: 1.5, ..spectrum() };
    assert_eq!(text(hurst, &grid), "`surface.hurst` is 1.5, expected above 0 and up to 1");
    let order = Spectrum { cut_off: 2.0, ..spectrum() };
    assert_eq!(text(order, &grid), "`surface.cut_off` is 2, expected a finite number not below `surface.roll_off`");
    let Spectrum { hurst, rms_slope, roll_off, cut_off, seed } = spectrum();
    let rough = Shape::Rough { hurst, rms_slope, roll_off, cut_off, seed };
    let placed = gap_at(rough, [1.0, 1.0], &flat, false).unwrap_err().to_string();
    assert!(placed.contains("a surface of shape \"rough\" has no apex"), "{placed}");
}
