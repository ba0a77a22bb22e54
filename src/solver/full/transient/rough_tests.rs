//! Tests of rough contacts in time against steady ones, smooth ones, other frames, and the mass balance.

use super::*;
use crate::solver::discrete::grid::{GridSpec, PointGridSpec};
use crate::solver::full::{ContactSolver, Solution, Start};
use crate::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, si_from_moes};
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::physics::surfaces::Roughness;

const LINE: GridSpec = GridSpec::Uniform { dx: 0.02, domain: (-4.0, 2.0) };
const PLANE: GridSpec =
    GridSpec::Plane(PointGridSpec { dx: 0.08, dy: 0.1, refinement: 1.0, domain: (-4.0, 2.0, -2.0) });

fn rough(sigma: f64) -> Lubricant {
    Lubricant::default().on_rough_surfaces(Some(Roughness::new(sigma)))
}

/// Line and ball whose asperities carry a part of the load.
fn contacts() -> [(GridSpec, OperatingPoint, Lubricant); 2] {
    [(LINE, ContactKind::Line, 4.0), (PLANE, ContactKind::Point, 2.0)].map(|(spec, kind, films)| {
        let point = si_from_moes(&MoesRequest::new(kind, 40.0, 8.0)).unwrap();
        (spec, point, rough(films * point.formula_film_m()))
    })
}

fn marched(spec: GridSpec, transient: &Transient) -> Trajectory {
    let trajectory = solve(spec, transient, &()).unwrap();
    assert!(trajectory.finished(), "{}", trajectory.ended.describe());
    trajectory
}

fn steady(spec: GridSpec, point: &OperatingPoint, lubricant: Lubricant) -> Solution {
    let solution = ContactSolver::on(&spec.build().unwrap()).solve(point, lubricant, Start::Cold, &()).unwrap();
    assert!(solution.converged());
    solution
}

#[test]
fn rough_contacts_under_constant_inputs_stay_steady() {
    for (spec, point, lubricant) in contacts() {
        let transient = Transient { lubricant, ..Transient::new(point, Inputs::default(), 0.5, 0.1) };
        let trajectory = marched(spec, &transient);
        let solution = steady(spec, &point, lubricant);
        let share = solution.asperity_load_share();
        assert!((0.02..0.9).contains(&share), "{share}");
        for moment in &trajectory.moments {
            assert!((moment.h_c / solution.scalars.h_c - 1.0).abs() < 1e-5, "{} {}", moment.h_c, solution.scalars.h_c);
            assert!((moment.asperity_load_share / share - 1.0).abs() < 1e-5, "{} {share}", moment.asperity_load_share);
        }
    }
}

#[test]
fn slow_changes_of_the_speed_pass_through_steady_rough_contacts() {
    for (spec, point, lubricant) in contacts() {
        let speed = Signal::Harmonic { amplitude: 0.5, period: 4e4 };
        let inputs = Inputs { speed, ..Inputs::default() };
        let transient = Transient { lubricant, ..Transient::new(point, inputs, 1e4, 1e3) };
        let trajectory = marched(spec, &transient);
        let (first, last) = (trajectory.moments[0], trajectory.moments.last().unwrap());
        assert!((last.input.speed - 1.5).abs() < 1e-12);
        let faster = OperatingPoint { speed_m_per_s: 1.5 * point.speed_m_per_s, ..point };
        let wanted = steady(spec, &faster, lubricant);
        let share = wanted.asperity_load_share();
        assert!(share < 0.95 * first.asperity_load_share, "{share} {}", first.asperity_load_share);
        let off = [last.h_c / wanted.scalars.h_c - 1.0, last.asperity_load_share / share - 1.0];
        assert!(off.iter().all(|off| off.abs() < 1e-3), "{off:?}");
    }
}

#[test]
fn vanishing_roughness_is_a_smooth_contact_in_time() {
    let load = Signal::Harmonic { amplitude: 0.1, period: 1.0 };
    let inputs = Inputs { load, ..Inputs::default() };
    let transient =
        Transient { lubricant: rough(1e-12), ..Transient::new(OperatingPoint::TABLE_2_1, inputs, 1.0, 0.05) };
    let smooth = Lubricant { roughness: None, ..transient.lubricant };
    let [rough, smooth] =
        [transient.lubricant, smooth].map(|lubricant| marched(LINE, &Transient { lubricant, ..transient.clone() }));
    let whole = (0.0, 1.0);
    for quantity in [Quantity::CentralFilm, Quantity::CentralPressure] {
        let (greatest, _) = rough.difference(&smooth, quantity, whole).unwrap();
        assert!(greatest < 1e-7, "{quantity:?}: {greatest:e}");
    }
}

#[test]
fn rough_films_in_time_agree_between_frames_and_conserve_mass() {
    let load = Signal::Harmonic { amplitude: 0.2, period: 2.0 };
    let inputs = Inputs { load, ..Inputs::default() };
    let keep = Keep::Every(1);
    let transient =
        Transient { lubricant: rough(6e-8), keep, ..Transient::new(OperatingPoint::TABLE_2_1, inputs, 2.0, 0.01) };
    let spec = GridSpec::Uniform { dx: 0.01, domain: (-4.0, 2.0) };
    let fixed = marched(spec, &transient);
    let moving = marched(spec, &Transient { frame: Frame::ArbitraryLagrangianEulerian, ..transient });
    let (_, difference) = moving.difference(&fixed, Quantity::CentralFilm, (0.0, 2.0)).unwrap();
    assert!(difference < 5e-3, "{difference:e}");
    let (_, difference) = moving.difference(&fixed, Quantity::AsperityLoadShare, (0.0, 2.0)).unwrap();
    assert!(difference < 2e-2, "{difference:e}");
    for (name, trajectory) in [("fixed", &fixed), ("moving", &moving)] {
        let defect = trajectory.mass_balance((-1.5, 0.5)).unwrap().defect();
        assert!(defect < 0.03, "{name}: {defect:e}");
    }
}

#[test]
fn shear_flow_of_unequal_roughness_is_carried_but_not_stored() {
    let laws = Roughness { shear_flow: -0.8, ..Roughness::new(6e-8) };
    let lubricant = Lubricant::default().on_rough_surfaces(Some(laws));
    let mut point = OperatingPoint::TABLE_2_1;
    point.sliding.slide_to_roll_ratio = 1.0;
    let load = Signal::Harmonic { amplitude: 0.2, period: 2.0 };
    let inputs = Inputs { load, ..Inputs::default() };
    let transient = Transient { lubricant, keep: Keep::Every(1), ..Transient::new(point, inputs, 2.0, 0.01) };
    let trajectory = marched(GridSpec::Uniform { dx: 0.01, domain: (-4.0, 2.0) }, &transient);
    let defect = trajectory.mass_balance((-1.5, 0.5)).unwrap().defect();
    assert!(defect < 0.03, "{defect:e}");
    let refused = solve(LINE, &Transient { scheme: Scheme::Characteristic, ..transient }, &()).unwrap_err();
    assert!(refused.to_string().contains("without shear flow"), "{refused}");
}
