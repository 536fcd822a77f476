use super::*;

/// The cases that a reader should look at: `WEARLAW_PLOT_DIR=somewhere cargo test plot` keeps them.
fn shown(name: &str, figure: &Figure<'_>) -> String {
    let svg = draw(figure).unwrap();
    assert_eq!(svg, draw(figure).unwrap(), "{name}: the same record gives the same bytes");
    if let Some(folder) = std::env::var_os("WEARLAW_PLOT_DIR") {
        std::fs::write(Path::new(&folder).join(format!("{name}.svg")), &svg).unwrap();
    }
    assert!(svg.starts_with("<svg width=\"1000\" height=\"700\" stroke-linejoin"), "{svg:.200}");
    assert!(svg.trim_end().ends_with("</svg>"));
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{name}");
    check_coordinates(name, &svg);
    svg
}

/// Everything drawn lies on the sheet.
fn check_coordinates(name: &str, svg: &str) {
    let (width, height) = (f64::from(SIZE.0 * FINE), f64::from(SIZE.1 * FINE));
    for list in svg.split("points=\"").skip(1) {
        for point in list.split('"').next().unwrap().split_whitespace() {
            let (x, y) = point.split_once(',').unwrap();
            let (x, y): (f64, f64) = (x.parse().unwrap(), y.parse().unwrap());
            assert!((0.0..=width).contains(&x) && (0.0..=height).contains(&y), "{name}: {point}");
        }
    }
}

fn history(steps: usize, scale: f64, volume: bool) -> History {
    let rows = (0..=steps)
        .map(|i| {
            let time = i as f64 / steps as f64 * 3.5;
            HistoryRow {
                dt: if i == 0 { 0.0 } else { 3.5 / steps as f64 },
                sliding_distance: time * (1.0 + 0.3 * time),
                max_pressure: 1.2e9 * scale / (1.0 + time),
                max_wear_depth: 7.3e-6 * scale * time.sqrt(),
                wear_volume: volume.then_some(3.1e-14 * scale * time),
                ..HistoryRow::at(time)
            }
        })
        .collect();
    History { rows }
}

fn scar(points: usize, scale: f64) -> Profile<'static> {
    let x: Vec<f64> = (0..points).map(|i| (i as f64 / (points - 1) as f64 - 0.5) * 6e-4).collect();
    let hertz = |radius: f64, peak: f64| -> Vec<f64> {
        x.iter().map(|x| scale * peak * (1.0 - (x / radius).powi(2)).max(0.0).sqrt()).collect()
    };
    let wear = x.iter().map(|x| scale * 7.3e-6 * (1.0 - (x / 2.6e-4).powi(2)).max(0.0)).collect();
    Profile {
        axis: "x".into(),
        unit: "m".into(),
        pressure_start: hertz(1.1e-4, 1.9e9).into(),
        pressure_end: hertz(2.6e-4, 0.5e9).into(),
        wear_start: vec![0.0; points].into(),
        wear_end: std::borrow::Cow::Owned(wear),
        coordinate: x.clone().into(),
    }
}

fn figure<'a>(title: &'a str, units: &'a Units, history: &'a History, profile: Option<&'a Profile<'a>>) -> Figure<'a> {
    Figure { title, units, history, profile }
}

#[test]
fn profiles_and_histories_are_drawn_with_their_units() {
    let (units, history, profile) = (Units::default(), history(400, 1.0, true), scar(200, 1.0));
    let title = "Ball on flat, wear scar <growth> & more";
    let svg = shown("profile", &figure(title, &units, &history, Some(&profile)));
    for text in [
        "Ball on flat, wear scar &lt;growth&gt; &amp; more",
        "Contact pressure (10⁹ Pa)",
        "Wear depth (10⁻⁶ m)",
        "x (10⁻⁶ m)",
        "Largest wear depth (10⁻⁶ m)",
        "Worn volume (10⁻¹⁵ m³)",
        "Time (s)",
        "start",
        "end",
    ] {
        assert!(svg.contains(&format!(">\n{text}\n<")), "{text}");
    }
}

#[test]
fn one_point_shows_its_loading_instead_of_a_profile() {
    let (units, history) = (Units::default(), history(10, 1.0, false));
    let svg = shown("one-point", &figure("Pin on disc", &units, &history, None));
    assert!(svg.contains("Largest contact pressure (10⁹ Pa)"));
    assert!(svg.contains("Sliding velocity, mean over each step (m/s)"));
    assert!(svg.contains("Sliding distance (m)") && !svg.contains("Worn volume"));
    assert!(!svg.contains(">\nstart\n<"), "a single curve needs no legend");
}

#[test]
fn small_huge_and_no_numbers_are_drawn() {
    let mm = Units { length: "mm".into(), per_length: true, ..Units::default() };
    for (name, scale) in [("tiny", 1e-12), ("huge", 1e40), ("zeros", 0.0)] {
        let (history, profile) = (history(50, scale, true), scar(60, scale));
        let svg = shown(name, &figure(name, &mm, &history, Some(&profile)));
        assert!(svg.contains("Worn volume (10") == (scale > 0.0), "{name}");
        assert!(svg.contains("mm²)"), "{name}");
    }
}

#[test]
fn a_single_step_or_none_or_gaps_are_drawn() {
    let units = Units::default();
    let single = History { rows: history(1, 1.0, true).rows.split_off(1) };
    let svg = shown("single-step", &figure("Single step", &units, &single, None));
    assert!(svg.contains("<circle"), "a single instant is a dot");
    let two = history(1, 1.0, true);
    shown("two-rows", &figure("Start and one step", &units, &two, Some(&scar(5, 1.0))));
    let none = History::default();
    let svg = shown("none", &figure("Nothing", &units, &none, None));
    assert!(svg.contains("no step was accepted"));
    let mut gaps = history(200, 1.0, true);
    gaps.rows[100].max_wear_depth = f64::NAN;
    gaps.rows[150].wear_volume = None;
    let long = "A title that goes on and on ".repeat(8);
    let svg = shown("gaps", &figure(&long, &units, &gaps, None));
    assert!(svg.contains("A title that") && svg.contains("…"));
}

#[test]
fn a_long_history_and_noise_stay_small() {
    let (units, history) = (Units::default(), history(200_000, 1.0, true));
    let mut profile = scar(100_000, 1.0);
    for (i, wear) in profile.wear_end.to_mut().iter_mut().enumerate() {
        *wear *= 1.0 + 0.2 * (i as f64 * 1.7).sin();
    }
    let svg = shown("long", &figure("Fretting, 200 000 steps", &units, &history, Some(&profile)));
    assert!(svg.len() < 300_000, "{} bytes", svg.len());
}

#[test]
fn point_numbers_are_shown_with_dots_while_they_are_few() {
    let (units, history) = (Units::default(), history(20, 1.0, true));
    let mut profile = scar(7, 1.0);
    profile.coordinate = (1..=7).map(f64::from).collect();
    (profile.axis, profile.unit) = ("point".into(), String::new());
    let svg = shown("numbered", &figure("Nodes", &units, &history, Some(&profile)));
    assert!(svg.contains("Point number") && svg.contains("<circle"));
}

#[test]
fn the_figure_is_written_whole() {
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("plot.svg");
    let (units, history) = (Units::default(), history(3, 1.0, true));
    write_plot(&figure("Written", &units, &history, None), &path).unwrap();
    assert!(std::fs::read_to_string(&path).unwrap().contains("Written"));
    assert_eq!(std::fs::read_dir(place.path()).unwrap().count(), 1);
}
