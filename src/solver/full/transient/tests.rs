use super::*;
use crate::solver::contact::OperatingPoint;
use crate::solver::grid::GridSpec;
use crate::solver::lubricant::Lubricant;

#[test]
fn probe() {
    let transient = Transient {
        point: OperatingPoint::TABLE_2_1,
        lubricant: Lubricant::default(),
        inputs: Inputs::load(Signal::Harmonic { amplitude: 0.1, period: 4.0 }),
        frame: Frame::Fixed,
        duration: 8.0,
        time_step: TimeStep::Fixed(0.01),
        keep: Keep::Scalars,
    };
    for frame in [Frame::Fixed, Frame::ArbitraryLagrangianEulerian, Frame::Remeshed(Interpolation::CubicSpline), Frame::Remeshed(Interpolation::Linear)] {
        let clock = std::time::Instant::now();
        let t = solve(GridSpec::DISSERTATION, &Transient { frame, ..transient.clone() }, &mut ()).unwrap();
        println!("{frame:?} {:?} steps {} time/step {:.2} ms", t.ended, t.moments.len(), clock.elapsed().as_secs_f64() * 1e3 / t.moments.len() as f64);
        let newton: usize = t.moments[1..].iter().map(|m| m.effort.newton_iterations).sum();
        let linear: usize = t.moments[1..].iter().map(|m| m.effort.linear_iterations).sum();
        println!("newton {:.2} linear {:.2}", newton as f64 / t.moments.len() as f64, linear as f64 / t.moments.len() as f64);
        let w = (4.0, 8.0);
        println!("H_c {:?} {:?}  P_c {:?} {:?}  Hm {:?} {:?}", t.mean(Quantity::CentralFilm, w), t.amplitude(Quantity::CentralFilm, w), t.mean(Quantity::CentralPressure, w), t.amplitude(Quantity::CentralPressure, w), t.mean(Quantity::MinimumFilm, w), t.amplitude(Quantity::MinimumFilm, w));
    }
}
