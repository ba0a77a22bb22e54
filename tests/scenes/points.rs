//! Random contacts of ranges. Trainings and their models are reproducible only while these stay the same.

use crate::common::scene_files;
use ehl_explorer::scene::Study;
use ehl_explorer::solver::training::random_points;

/// R, u_m, w, E′, η₀, α and SRR of the first contacts of a training's range.
type Drawn = [[f64; 7]; 2];

fn draws(scene: &str, wanted: Drawn) {
    let Study::Training(spec) = scene_files::read(scene).study else { panic!("{scene} is no training") };
    for (point, wanted) in random_points(&spec.range, spec.contact(), 2, 1).iter().zip(wanted) {
        let [radius, speed, load, modulus, viscosity, alpha] = point.quantities();
        let own = [radius, speed, load, modulus, viscosity, alpha, point.sliding.slide_to_roll_ratio];
        // Powers differ in their last digits between machines.
        let near = own.iter().zip(wanted).all(|(own, wanted)| (own - wanted).abs() <= 1e-12 * wanted.abs());
        assert!(near, "{scene}: {own:?} instead of {wanted:?}");
    }
}

#[test]
fn a_box_of_si_quantities_draws_the_same_contacts() {
    draws(
        "fig_3_1_model",
        [
            [
                0.0034735827343977226,
                5.988407976263574,
                154049.4521378529,
                231000000000.0,
                0.01,
                1.8261805781042886e-08,
                0.0,
            ],
            [
                0.0020004623560035094,
                8.977027187236867,
                449671.556641045,
                231000000000.0,
                0.01,
                1.916571093359423e-08,
                0.0,
            ],
        ],
    );
}

#[test]
fn a_space_of_eyring_lubricants_draws_the_same_contacts() {
    draws(
        "line_sliding_oils",
        [
            [
                0.003,
                0.002547204899836161,
                265308.7994252293,
                460230022793.03613,
                0.2636924165948812,
                9.564343732620082e-09,
                0.00023117800175465053,
            ],
            [
                0.003,
                0.0018709102244942597,
                99515.56292239606,
                564339705798.6292,
                0.2501773213579386,
                1.983582593349093e-08,
                0.949442312526368,
            ],
        ],
    );
}

#[test]
fn a_space_of_thermal_contacts_draws_the_same_contacts() {
    draws(
        "line_heat",
        [
            [
                0.008874795851089802,
                0.5037948944000751,
                881957.2449189817,
                155055383910.20654,
                0.03195680115403302,
                2.9592002169837946e-08,
                0.02097394769750588,
            ],
            [
                0.0026546487198437986,
                0.058642468317989326,
                35506.917960559476,
                150364241389.59308,
                0.41575901832764195,
                1.490043555282913e-08,
                0.5358090405660738,
            ],
        ],
    );
}
