//! What must not change the answer: other units, a faster motion over a shorter time, the number of threads.

use crate::run;
use crate::solved::{Case, archard, near};

#[derive(Clone, Copy)]
struct Ball {
    length: f64,
    modulus: f64,
    load: f64,
    rate: f64,
    velocity: f64,
    duration: f64,
}

const BALL: Ball = Ball { length: 1.0, modulus: 115e9, load: 10.0, rate: 1e-14, velocity: 1.0, duration: 0.02 };

impl Ball {
    fn wear(self) -> Vec<f64> {
        let Ball { length, modulus, load, rate, velocity, duration } = self;
        let (size, radius) = (length * 1.8e-4, length * 5e-3);
        run(&format!(
            "[law]\nuse = \"archard\"\nconstants = [{rate:e}, 1.0, 1.0, 1.0]\n\
             [contact]\nmodel = \"halfspace\"\nmodulus = {modulus:e}\n\
             [grid]\nsize = [{size:e}, {size:e}]\ncells = [16, 16]\n[surface]\nshape = \"sphere\"\nradius = {radius:e}\n\
             [[step]]\nduration = {duration:e}\nload = {load:e}\nvelocity = {velocity:e}\n\
             [integrator]\nmethod = \"tr-bdf2\"\nsubsteps = 4\n"
        ))
        .record
        .wear
    }
}

#[test]
fn stiffer_bodies_under_more_load_wear_alike() {
    let plain = BALL.wear();
    let s = 3.7;
    let scaled = Ball { modulus: s * BALL.modulus, load: s * BALL.load, rate: BALL.rate / s, ..BALL }.wear();
    let largest = plain.iter().copied().fold(0.0, f64::max);
    assert!(largest > 0.0);
    for (a, b) in plain.iter().zip(&scaled) {
        assert!((a - b).abs() <= 1e-8 * largest, "{a:e}, {b:e}");
    }
}

#[test]
fn powers_of_two_do_not_change_a_bit() {
    let plain = BALL.wear();
    let s = 2.0_f64.powi(90);
    let stiff = Ball { modulus: s * BALL.modulus, load: s * BALL.load, rate: BALL.rate / s, ..BALL }.wear();
    assert!(plain == stiff);
    let l = 2.0_f64.powi(-40);
    let small = Ball { length: l, load: l * l * BALL.load, rate: l * BALL.rate, ..BALL }.wear();
    let back: Vec<f64> = small.iter().map(|wear| wear / l).collect();
    assert!(plain == back);
}

#[test]
fn twice_the_speed_in_half_the_time_wears_alike() {
    let plain = BALL.wear();
    let fast = Ball { velocity: 2.0 * BALL.velocity, duration: 0.5 * BALL.duration, ..BALL }.wear();
    for (a, b) in plain.iter().zip(&fast) {
        near(*a, *b, 1e-12);
    }
}

#[test]
fn one_and_two_threads_give_the_same_bits() {
    // As many cells as are shared between threads, in full contact, which few iterations solve.
    let scene = "[law]\nuse = \"archard\"\nconstants = [1e-14, 1.0, 1.0, 1.0]\n\
         [contact]\nmodel = \"halfspace\"\nboundary = \"periodic\"\nmodulus = 115e9\n\
         [grid]\nsize = [1e-3, 1e-3]\ncells = [512, 512]\n[surface]\nshape = \"wavy\"\namplitude = 1e-8\nwaves = [1, 2]\n\
         [[step]]\nduration = 0.1\nload = 12.0\nvelocity = 1.0\n[integrator]\nmethod = \"implicit-euler\"\nsubsteps = 1\n";
    let [one, two] = [1, 2].map(|threads| Case::text(scene).solve_on(threads, &archard()).record);
    assert!(one.wear == two.wear && one.pressure == two.pressure);
    let (least, most) = one.wear.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), w| (a.min(*w), b.max(*w)));
    assert!(least < 0.9 * most, "{least:e}, {most:e}");
}
