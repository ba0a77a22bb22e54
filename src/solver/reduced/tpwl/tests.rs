use super::*;
use crate::solver::contact::OperatingPoint;
use crate::solver::full::transient::{self, Frame, Inputs, Keep, Marching, Quantity, Signal, TimeStep, Transient};
use crate::solver::grid::GridSpec;
use crate::solver::lubricant::Lubricant;

const TABLE_4_5: OperatingPoint = OperatingPoint {
    radius_m: 0.01,
    speed_m_per_s: 2.5,
    load: 2e5,
    modulus_pa: 231e9,
    viscosity_pa_s: 0.01,
    alpha_per_pa: 2e-8,
    ..OperatingPoint::TABLE_2_1
};

fn probe_case(load: Signal, duration: f64) -> Transient {
    Transient {
        point: TABLE_4_5,
        lubricant: Lubricant::default(),
        inputs: Inputs::load(load),
        frame: Frame::Fixed,
        duration,
        time_step: TimeStep::Fixed(1.0 / 400.0),
        keep: Keep::Scalars,
    }
}

#[test]
fn probe() {
    let dx: f64 = std::env::var("DX").ok().and_then(|s| s.parse().ok()).unwrap_or(0.01);
    let spec = GridSpec::Uniform { dx, domain: (-4.0, 2.0) };
    let sine = |period| Signal::Harmonic { amplitude: 0.1, period };
    let wave = |s| Signal::TriangleToSquare { amplitude: 0.1, period: 0.5, s };
    let clock = std::time::Instant::now();
    let train = transient::solve(spec, &Transient { keep: Keep::Every(1), ..probe_case(sine(0.5), 1.5) }, &mut ()).unwrap();
    println!("full {:?} {} in {:?}", train.ended, train.moments.len(), clock.elapsed());
    let tests: Vec<(&str, Transient)> = vec![
        ("train", probe_case(sine(0.5), 1.5)),
        ("triangle", probe_case(wave(0.0), 1.5)),
        ("s0.5", probe_case(wave(0.5), 1.5)),
        ("s0.9", probe_case(wave(0.9), 1.5)),
        ("sine0.7", probe_case(sine(0.7), 1.5)),
        ("sine1/3", probe_case(sine(1.0 / 3.0), 1.5)),
        ("const", probe_case(Signal::Constant, 0.5)),
    ];
    let full: Vec<_> = tests.iter().map(|(_, t)| transient::solve(spec, t, &mut ()).unwrap()).collect();
    for modes in [85, 100] {
        for selection in [
            Selection::Distance { tolerance: 0.006 },
            Selection::Distance { tolerance: 0.004 },
            Selection::Step { tolerance: 1e-3 },
            Selection::Step { tolerance: 3e-4 },
        ] {
            let clock = std::time::Instant::now();
            let model = TpwlModel::train(&[&train], TpwlTraining { modes, selection }).unwrap();
            println!("modes {modes} {selection:?} points {} in {:?}", model.points.len(), clock.elapsed());
            for weighting in [Weighting::DualTaylor, Weighting::Dissertation] {
                print!("  {weighting:?}:");
                for ((name, t), full) in tests.iter().zip(&full) {
                    let clock = std::time::Instant::now();
                    let (got, record) = solve(&model, t, weighting, &mut ()).unwrap();
                    let per = clock.elapsed().as_secs_f64() * 1e3 / got.moments.len() as f64;
                    let (max, l2) = got.difference(full, Quantity::CentralFilm).unwrap_or((f64::NAN, f64::NAN));
                    let mut reach: Vec<f64> = record.steps().iter().map(TpwlStep::reach).collect();
                    reach.sort_by(f64::total_cmp);
                    let n = reach.len();
                    print!(" {name} {l2:.1e}/{max:.1e} (reach {:.2} {:.2} {:.2}; {per:.3} ms)", reach[n / 2], reach[n * 95 / 100], reach[n - 1]);
                    if !got.finished() {
                        print!(" [{}]", got.ended.describe());
                    }
                }
                println!();
            }
        }
    }
}
