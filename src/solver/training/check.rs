//! Checks of a training specification.

use super::spec::{Plan, TrainingSpec, WindowSpec, Windows};
use crate::solver::limits::{Refused, count, interval, number, plain};
use crate::solver::parameters::Quantity;
use crate::solver::physics::lubricant::{Cavitation, LARGEST_HEATED_SRR, ShearLaw, ViscosityLaw};
use crate::solver::reduced::{LEAST_EVIDENCE, LEAST_OF_WINDOW, Sampling, Scheme};

/// Maximum number of points of a plan, or of points judged at once.
const MOST_POINTS: usize = 100_000;
/// Maximum number of full solutions of a local model.
const MOST_SNAPSHOTS: usize = 5000;

/// Maximum number of local models around anchors.
const MOST_ANCHORS: usize = 256;
/// Largest permitted error of the modes, relative to the film thickness.
const MOST_MISSING: f64 = 0.1;

/// Minimum number of rows per mode of residual minimisation.
const FEWEST_MINIMISED: f64 = 1.1;

impl TrainingSpec {
    /// Checks the specification before anything is solved.
    ///
    /// # Errors
    /// [`Refused`] with the name of the field if no training is possible.
    pub fn check(&self) -> Result<(), Refused> {
        check(self)
    }
}

/// Checks a specification; a refusal names the field.
pub(super) fn check(spec: &TrainingSpec) -> Result<(), Refused> {
    plain("title", &spec.title)?;
    spec.range.check().map_err(|refused| refused.within("range"))?;
    lubricant(spec)?;
    windows(spec)?;
    number("pressure_loss", spec.pressure_loss, 1e-15, 0.5)?;
    number("deformation_loss", spec.deformation_loss, 1e-15, 0.5)?;
    number("rows_per_mode", spec.rows_per_mode, 1.0, 20.0)?;
    scheme(spec.scheme, spec.sampling, spec.rows_per_mode)?;
    number("penalty", spec.penalty, 1e2, 1e9)?;
    // Local models around anchors are calibrated together.
    let least = match spec.windows {
        Windows::Anchored { count, .. } => LEAST_OF_WINDOW.max(LEAST_EVIDENCE.div_ceil(count.max(1))),
        Windows::Given(_) | Windows::Automatic { .. } => LEAST_EVIDENCE,
    };
    if spec.evidence > 0 && !(least..=MOST_POINTS).contains(&spec.evidence) {
        return Err(Refused::new(
            "evidence",
            format!(
                "is {}, but must lie between {least} and {MOST_POINTS}, or be 0 for a model without an error bound",
                spec.evidence
            ),
        ));
    }
    plan(spec).map_err(|refused| refused.within("plan"))
}

/// Checks that scheme and sampling match. Cubature weights belong to rows tested by V, not to residual minimisation;
/// the bases of GNAT are those of sampled equations.
pub(super) fn scheme(scheme: Scheme, sampling: Sampling, rows_per_mode: f64) -> Result<(), Refused> {
    match (scheme, sampling) {
        (Scheme::LeastSquares { .. } | Scheme::Gnat { .. }, Sampling::Cubature) => Err(Refused::new(
            "scheme",
            "minimises the residual, but the cubature's weights belong to rows tested by V; choose Greedy or QDeim",
        )),
        (Scheme::Gnat { .. }, Sampling::All) => Err(Refused::new(
            "scheme",
            "is Gnat, which samples rows; choose Greedy or QDeim, or LeastSquares of all rows",
        )),
        (Scheme::LeastSquares { .. } | Scheme::Gnat { .. }, _) if rows_per_mode < FEWEST_MINIMISED => {
            Err(Refused::new(
                "rows_per_mode",
                format!(
                    "is {rows_per_mode}, but residual minimisation needs more equations than unknowns: {FEWEST_MINIMISED} at least"
                ),
            ))
        }
        _ => Ok(()),
    }
}

fn plan(spec: &TrainingSpec) -> Result<(), Refused> {
    match &spec.plan {
        Plan::FarthestPoint { snapshots } => count("snapshots", *snapshots, 4, MOST_SNAPSHOTS),
        Plan::Grid { .. } if !spec.range.is_si_box() => {
            Err(Refused::new("nodes", "make the grid of Table 3.2, which needs a range that is a box of SI quantities"))
        }
        Plan::Grid { nodes } => {
            nodes.iter().try_for_each(|&n| count("nodes", n, 1, 100))?;
            count("nodes (product)", nodes.iter().product(), 4, MOST_POINTS)
        }
        Plan::Adaptive { start, tolerances, successes, local_sigma, local_successes, vicinity, limit, .. } => {
            search(*start, tolerances, *limit)?;
            count("successes", *successes, 1, MOST_POINTS)?;
            number("local_sigma", *local_sigma, 1e-6, 1.0)?;
            count("local_successes", *local_successes, 0, MOST_POINTS)?;
            count("vicinity", *vicinity, 0, 10_000)
        }
        Plan::WorstOfPool { start, pool, per_round, tolerance, limit, .. } => {
            search(*start, &[*tolerance], *limit)?;
            count("pool", *pool, 1, MOST_POINTS)?;
            count("per_round", *per_round, 1, *pool)
        }
    }
}

/// Checks the fields common to all plans that search for bad approximations.
fn search(start: usize, tolerances: &[f64], limit: usize) -> Result<(), Refused> {
    count("start", start, 4, MOST_SNAPSHOTS)?;
    count("limit", limit, start, MOST_SNAPSHOTS)?;
    count("tolerances (how many)", tolerances.len(), 1, 32)?;
    tolerances.iter().try_for_each(|&tolerance| number("tolerances", tolerance, 1e-12, 1e12))?;
    match tolerances.windows(2).find(|pair| pair[0] <= pair[1]) {
        Some(pair) => {
            Err(Refused::new("tolerances", format!("must be descending, but {} follows {}", pair[1], pair[0])))
        }
        None => Ok(()),
    }
}

/// Checks that the parameter space and the lubricant match, as the reduced operators support them.
fn lubricant(spec: &TrainingSpec) -> Result<(), Refused> {
    let refuse = |field: &str, problem: &str| Err(Refused::new(field, problem));
    let (range, laws) = (&spec.range, &spec.lubricant);
    laws.check().map_err(|problem| Refused::new("lubricant", format!("is refused: {problem}")))?;
    let (heat, shear_thinning) = (spec.heats(), laws.shear != ShearLaw::Newtonian);
    let eyring = matches!(laws.shear, ShearLaw::Eyring { .. });
    match laws.cavitation {
        Cavitation::Complementarity if heat => {
            return refuse("cavitation", "is complementarity, but thermal reduced models support the penalty only");
        }
        Cavitation::MassConserving { .. } => {
            return refuse(
                "cavitation",
                "is mass-conserving, but reduced models support the penalty or complementarity",
            );
        }
        Cavitation::Complementarity if range.of_ellipses() => {
            return refuse("cavitation", "must be the penalty for a reduced model of elliptical contacts");
        }
        Cavitation::Penalty | Cavitation::Complementarity => {}
    }
    if range.of_ellipses() && spec.contact().is_line() {
        return refuse("range", "is of elliptical contacts, but the windows' grids are of line contacts");
    }
    if range.of_ellipses() && shear_thinning && !heat {
        return refuse("range.axes.RadiusRatio", "must be left out for a shear-thinning lubricant");
    }
    if range.varies_lubricant() {
        if laws.viscosity != ViscosityLaw::Roelands {
            return refuse(
                "range",
                "varies the viscosity, which needs Roelands’ law, but the lubricant has another one",
            );
        }
        if !range.is_rough() && !matches!(spec.windows, Windows::Anchored { .. }) {
            return refuse("windows", "must be `Anchored(…)` for a range that varies the viscosity");
        }
        if shear_thinning && !heat && !eyring {
            return refuse("range", "varies the viscosity, but shear-thinning by another law than Eyring’s fixes it");
        }
        if shear_thinning && !heat && !range.knows(Quantity::GradientStress) {
            return refuse("range", "needs a limit of `GradientStress` for Eyring lubricants whose viscosity varies");
        }
    }
    if spec.heats() {
        return thermal(spec);
    }
    if range.is_rough() {
        return rough(spec);
    }
    let (slides, plateau) = (range.slides(), range.varies(Quantity::NewtonianPlateauRatio));
    let modulus = range.gives(Quantity::Modulus);
    match (slides, shear_thinning) {
        _ if plateau && !shear_thinning => refuse("range", "varies NPR, but the lubricant has no shear constants"),
        (true, false) => refuse("range", "varies SRR, but the lubricant is Newtonian and isothermal"),
        (false, true) => refuse("range", "must vary SlideToRollRatio for a shear-thinning lubricant"),
        (true, true) if !modulus => refuse("range", "must vary or fix Modulus for a shear-thinning lubricant"),
        (true, true) => {
            sliding(spec, 10.0)?;
            own_coefficient(spec)
        }
        (false, false) => Ok(()),
    }
}

/// Checks the parameter space of a training with rough surfaces: steady line or circular contacts without sliding or
/// shear-thinning.
fn rough(spec: &TrainingSpec) -> Result<(), Refused> {
    let (range, laws) = (&spec.range, &spec.lubricant);
    let refuse = |field: &str, problem: &str| Err(Refused::new(field, problem));
    if laws.roughness.is_none() {
        return refuse("range.axes.SmoothFilmRatio", "needs the laws of rough surfaces");
    }
    if spec.contact().is_point() && laws.roughness.is_some_and(|roughness| roughness.peklenik != 1.0) {
        return refuse("roughness.peklenik", "must be 1 for a reduced model of rough circular contacts");
    }
    if range.slides() || laws.shear != ShearLaw::Newtonian {
        return refuse("range.axes.SmoothFilmRatio", "is supported for Newtonian lubricants without SRR only");
    }
    if matches!(spec.windows, Windows::Automatic { .. }) {
        return refuse("windows", "must be `Given` or `Anchored` for a range that varies the film ratio");
    }
    if spec.scheme != Scheme::Galerkin {
        return refuse("scheme", "must be Galerkin for rough surfaces");
    }
    Ok(())
}

/// Refuses negative SRR, since film thickness is even in SRR, and SRR above `most`.
fn sliding(spec: &TrainingSpec, most: f64) -> Result<(), Refused> {
    let srr = spec.range.interval(Quantity::SlideToRollRatio, spec.contact()).unwrap_or_default();
    interval("range.axes.SlideToRollRatio", srr, 0.0, most)
}

/// Refuses a fixed α that differs from that of the viscosity law.
fn own_coefficient(spec: &TrainingSpec) -> Result<(), Refused> {
    match spec.range.fixed(Quantity::Alpha).zip(spec.lubricant.own_coefficient()) {
        Some((alpha, own)) if (alpha / own - 1.0).abs() > 1e-3 => Err(Refused::new(
            "range.fixed.Alpha",
            format!("is {alpha:.4e} 1/Pa, but the lubricant's viscosity law determines {own:.4e} 1/Pa; write that"),
        )),
        _ => Ok(()),
    }
}

/// Checks the parameter space of a thermal training. It must contain SRR, R and E′, on which temperatures depend at
/// equal M and L.
fn thermal(spec: &TrainingSpec) -> Result<(), Refused> {
    let range = &spec.range;
    for quantity in [Quantity::SlideToRollRatio, Quantity::Radius, Quantity::Modulus] {
        if !range.gives(quantity) {
            return Err(Refused::new(
                "range",
                format!("must vary or fix {quantity:?} for thermal contacts; or leave heat out"),
            ));
        }
    }
    sliding(spec, LARGEST_HEATED_SRR)?;
    if let Some(why) = spec.domain().other_constants(&spec.lubricant) {
        return Err(Refused::new("range.constants", format!("must contain the scene's own constants: {why}")));
    }
    if spec.scheme != Scheme::Galerkin {
        return Err(Refused::new("scheme", "must be Galerkin for a thermal reduced model"));
    }
    own_coefficient(spec)
}

fn windows(spec: &TrainingSpec) -> Result<(), Refused> {
    match &spec.windows {
        Windows::Given(windows) => given(spec, windows),
        Windows::Automatic { modes } => count("windows.modes", *modes, 8, 1000),
        Windows::Anchored { count: windows, modes, grid, shared, missing, missing_of_any, divided_by } => {
            count("windows.count", *windows, 1, MOST_ANCHORS)?;
            count("windows.modes", *modes, 8, 1000)?;
            if *shared > 0 {
                count("windows.shared", *shared, *modes, 1000)?;
            }
            if *divided_by > 0 {
                count("windows.divided_by", *divided_by, 8, 1000)?;
            }
            let missed = [("windows.missing", missing), ("windows.missing_of_any", missing_of_any)];
            if let Some((field, missing)) = missed.iter().find(|(_, missing)| !(0.0..=MOST_MISSING).contains(*missing))
            {
                return Err(Refused::new(*field, format!("is {missing}; it must be within 0…{MOST_MISSING}")));
            }
            grid.check().map_err(|problem| Refused::new("windows.grid", format!("makes no sense: {problem}")))?;
            if !spec.range.varies_lubricant() {
                let why = "are anchored in M and L, which needs a range that varies Viscosity";
                return Err(Refused::new("windows", why));
            }
            if matches!(spec.plan, Plan::Grid { .. }) {
                return Err(Refused::new("plan", "is a grid, but anchored windows share solutions at farthest points"));
            }
            Ok(())
        }
    }
}

fn given(spec: &TrainingSpec, windows: &[WindowSpec]) -> Result<(), Refused> {
    let refuse = |problem: String| Err(Refused::new("windows", problem));
    count("windows (how many)", windows.len(), 1, 64)?;
    windows.iter().try_for_each(|window| interval("windows.m", window.m, 1e-3, 1e6))?;
    for window in windows {
        window.grid.check().map_err(|problem| Refused::new("windows.grid", format!("makes no sense: {problem}")))?;
    }
    if windows.iter().any(|w| w.grid.kind() != spec.contact()) {
        return refuse("must be of one kind of contact: all grids Plane, or none".to_owned());
    }
    let descend = |pair: &[WindowSpec]| pair[0].has_shapes_of(&pair[1]) && pair[0].m.1 > pair[1].m.0;
    if windows.iter().any(|w| w.m.0 >= w.m.1) || windows.windows(2).any(descend) {
        return refuse("must be non-empty intervals of M in ascending order".to_owned());
    }
    let shapes = spec.range.radius_ratio();
    let apart = |pair: &[WindowSpec]| match (pair[0].radius_ratio, pair[1].radius_ratio) {
        (None, None) => false,
        (Some(one), Some(other)) => one != other && one.1 > other.0,
        _ => true,
    };
    for (low, high) in windows.iter().filter_map(|window| window.radius_ratio) {
        if !(shapes.0 <= low && low < high && high <= shapes.1) {
            return refuse(format!(
                "have radius_ratio {low}…{high}, but must have non-empty intervals within the range's, {}…{}",
                shapes.0, shapes.1
            ));
        }
    }
    if windows.windows(2).any(apart) {
        return refuse("must have their intervals of radius_ratio in ascending order, or none of them any".to_owned());
    }
    for loss in windows.iter().filter_map(|window| window.pressure_loss) {
        number("windows.pressure_loss", loss, 1e-15, 0.5)?;
    }
    let (low, high) = spec.domain().m();
    match windows.iter().find(|w| w.m.1 < low || w.m.0 > high) {
        Some(WindowSpec { m: (from, to), .. }) => {
            refuse(format!("contain M {from}…{to}, outside the range, whose M is {low:.4}…{high:.4}"))
        }
        None => Ok(()),
    }
}
