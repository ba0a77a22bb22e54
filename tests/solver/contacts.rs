//! Contacts of the tests: from Moes numbers, and from reference files.

use ehl_explorer::solver::full::{ContactSolver, Solution, Start};
use ehl_explorer::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, si_from_moes};
use ehl_explorer::solver::physics::lubricant::{Lubricant, Sliding};

/// Returns the contact of Moes numbers in the default realisation.
pub fn at(kind: ContactKind, m: f64, l: f64) -> OperatingPoint {
    si_from_moes(&MoesRequest::new(kind, m, l)).unwrap()
}

/// Line contact of a reference file, in SI units.
pub fn line_of(contact: &serde_json::Value) -> OperatingPoint {
    let of = |name: &str| contact[name].as_f64().unwrap();
    OperatingPoint {
        kind: ContactKind::Line,
        radius_m: of("R"),
        speed_m_per_s: of("um"),
        load: of("w"),
        modulus_pa: of("E"),
        viscosity_pa_s: of("eta0"),
        alpha_per_pa: of("alpha"),
        sliding: Sliding::NONE,
        radius_y_m: None,
    }
}

/// Returns the cold solution, which must converge.
pub fn solved(solver: &mut ContactSolver, point: &OperatingPoint, laws: Lubricant) -> Solution {
    let solution = solver.solve(point, laws, Start::Cold, &()).unwrap();
    assert!(solution.converged(), "{:?}: {:?}", point.moes(), solution.report);
    solution
}
