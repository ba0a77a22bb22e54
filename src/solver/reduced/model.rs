//! What a reduced model is made of.

use super::calibration::Calibration;
use super::combined::PressureModes;
use super::minimisation::Scheme;
use super::oils::{apart, expected_film, oil_place};
use super::pod::PodBasis;
use super::sampling::{SampledRows, Sampling};
use super::shapes::Shapes;
use super::traction::TractionRule;
use crate::solver::discrete::grid::{ContactGrid, FIRST_UNKNOWN};
use crate::solver::discrete::reynolds::PENALTY;
use crate::solver::full::{GridCost, Problem};
use crate::solver::physics::contact::{ContactKind, Moes, OperatingPoint};
use crate::solver::physics::lubricant::{Cavitation, Lubricant, roelands_exponent};
use faer::Mat;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The range a model declares to be trained for: an interval each of M, L, α and p_H at its η₀, for its lubricant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Domain {
    /// Load number.
    pub m: (f64, f64),
    /// Lubricant number.
    pub l: (f64, f64),
    /// Pressure–viscosity coefficient \[1/Pa\].
    pub alpha_per_pa: (f64, f64),
    /// Largest Hertzian pressure \[Pa\].
    pub max_hertz_pressure_pa: f64,
    /// Ambient viscosity \[Pa·s\].
    pub viscosity_pa_s: f64,
    /// Laws of the lubricant.
    pub lubricant: Lubricant,
    /// What else a shear-thinning lubricant was trained for.
    pub sliding: Option<SlidingDomain>,
    /// R_y/R; (1, 1) of a model that knows circles or lines. Files keep it in a place of its own.
    #[serde(skip, default = "circles")]
    pub radius_ratio: (f64, f64),
    /// The oils of a model that knows many; none of one that knows the oils with its η₀ only. Files keep them in a place
    /// of their own.
    #[serde(skip)]
    pub oils: Option<OilDomain>,
    /// What a model of contacts with heat was trained for; its lubricant has the thermal constants. Files keep both in a
    /// place of their own.
    #[serde(skip)]
    pub heat: Option<HeatDomain>,
}

/// What a model of contacts with heat is trained for beside M, L, α and p_H: with η₀, R and E′ these say load and speed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeatDomain {
    /// |SRR|.
    pub srr: (f64, f64),
    /// R \[m\].
    pub radius_m: f64,
    /// E′ \[Pa\].
    pub modulus_pa: f64,
}

/// What a model of many oils was trained for beside M, L, α and the largest p_H; its η₀ is one in the middle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OilDomain {
    /// η₀ \[Pa·s\].
    pub viscosity_pa_s: (f64, f64),
    /// Roelands' exponent z.
    pub exponent: (f64, f64),
    /// Smallest p_H \[Pa\].
    pub lowest_hertz_pressure_pa: f64,
    /// Thinnest H_c, by [`expected_film`]; 0 where there is no limit. Files keep it in a place of its own.
    #[serde(skip)]
    pub thinnest_film: f64,
}

fn circles() -> (f64, f64) {
    CIRCLES
}

/// R_y/R of models that know circles or lines only.
pub const CIRCLES: (f64, f64) = (1.0, 1.0);

/// What a shear-thinning model is trained for beside M, L, α and p_H.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SlidingDomain {
    /// |SRR|.
    pub srr: (f64, f64),
    /// NPR.
    pub npr: (f64, f64),
    /// E′ \[Pa\]: with M and L it fixes the shear stress.
    pub modulus_pa: f64,
}

/// Whether a model was trained for a problem.
#[derive(Clone, Debug, PartialEq)]
pub enum Trust {
    /// Inside the declared domain.
    Trained,
    /// Outside, with a sentence that says in which quantity and by how much.
    Outside(String),
}

/// A training solution as the model keeps it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    /// The operating point. Files keep the radius across in a place of its own.
    #[serde(with = "without_shape")]
    pub point: OperatingPoint,
    /// Its coefficients in the pressure basis.
    pub coefficients: Vec<f64>,
    /// Its H₀.
    pub h_0: f64,
    /// Its central film H_c, from the full solution.
    pub h_c: f64,
    /// Under complementarity the first ruptured column of each line along X, in node arrays; empty under a penalty.
    /// Files keep them in a place of their own.
    #[serde(skip)]
    pub fronts: Vec<usize>,
    /// What the grid costs H_c, where the training asked. Files keep it in a place of its own.
    #[serde(skip)]
    pub grid_cost: Option<GridCost>,
}

/// An operating point as model files have it, without a radius across.
mod without_shape {
    use crate::solver::physics::contact::{ContactKind, OperatingPoint};
    use crate::solver::physics::lubricant::Sliding;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(point: &OperatingPoint, serializer: S) -> Result<S::Ok, S::Error> {
        (point.kind, point.quantities(), point.sliding).serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<OperatingPoint, D::Error> {
        let (kind, quantities, sliding) = <(ContactKind, [f64; 6], Sliding)>::deserialize(deserializer)?;
        Ok(OperatingPoint::from_quantities(kind, quantities, sliding))
    }
}

/// One local model: a window of M with its own grid, bases and sampled rows.
#[derive(Clone, Debug)]
pub struct Window {
    /// Range of M for which this window is used.
    pub m: (f64, f64),
    /// Of a window that serves the contacts around a place in (ln M, ln L) that place; M then says no more than how far
    /// these reach.
    pub anchor: Option<Moes>,
    /// The grid of its solutions.
    pub grid: ContactGrid,
    /// Penalty factor γ̄ of (2.36) in the reduced equations. Sampled rows of a point contact want it softer than the
    /// full system.
    pub penalty: f64,
    /// How its films rupture: of complementarity it has the solutions, the boundary that moves, and no penalty.
    pub cavitation: Cavitation,
    /// Pressure basis, with K V_p: the exact deformation operator, of a circle.
    pub pressure: PressureModes,
    /// Deformation basis (of K P in the reference coordinate ξ); windows around anchors share one.
    pub deformation: Arc<PodBasis>,
    /// K V_p of ellipses, where the window knows them.
    pub shapes: Option<Shapes>,
    /// How rows were sampled.
    pub sampling: Sampling,
    /// Sampled rows as indices of unknowns, ascending.
    pub sampled_rows: Vec<usize>,
    /// By what the online step is found.
    pub scheme: Scheme,
    /// What is made of the sampled rows' values: of Galerkin's scheme G with Vᵀ W f ≈ G f_I, modes × rows; of least
    /// squares a factor each, 1 × rows; of GNAT what the Jacobian's basis says of them, equations × rows.
    pub reconstruction: Mat<f64>,
    /// What GNAT makes of the residual's values, of the size of the former.
    pub residual_reconstruction: Option<Mat<f64>>,
    /// Training solutions.
    pub snapshots: Vec<Snapshot>,
    /// Traction from few of the nodes that these rows depend on; none where the model does not know sliding.
    pub traction: Option<TractionRule>,
    /// What it knows about its own errors, with all modes and these rows; none until it was measured.
    pub calibration: Option<Calibration>,
}

/// How large the model of a window is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ModelSize {
    /// Pressure modes.
    pub pressure: usize,
    /// Deformation modes.
    pub deformation: usize,
    /// Sampled rows.
    pub rows: usize,
}

impl std::fmt::Display for ModelSize {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { pressure, deformation, rows } = self;
        write!(f, "{pressure} pressure modes, {deformation} deformation modes, {rows} sampled rows")
    }
}

/// A reduced model of stationary contacts of one kind.
#[derive(Clone, Debug)]
pub struct ReducedModel {
    /// Title for people.
    pub title: String,
    /// What it was trained for.
    pub domain: Domain,
    /// Local models by ascending M.
    pub windows: Vec<Window>,
    /// The scene it was trained by, as text; empty for a model that was never saved.
    pub scene: String,
    /// What the training did, one sentence per line.
    pub log: Vec<String>,
}

/// The dissertation's distance of two contacts, (3.20).
pub fn distance(a: Moes, b: Moes) -> f64 {
    (a.m - b.m).powi(2) / (a.m * a.m + b.m * b.m) + 0.001 * (a.l - b.l).powi(2)
}

/// Weight of (ln of the ratio of two R_y/R)² beside (3.20).
pub const SHAPE_WEIGHT: f64 = 0.15;

/// (3.20) with what SRR and NPR add to it, and the shape.
pub fn separation(a: &OperatingPoint, b: &OperatingPoint) -> f64 {
    let shape = if a.radius_y_m == b.radius_y_m && a.radius_m == b.radius_m {
        0.0
    } else {
        SHAPE_WEIGHT * (a.radius_ratio() / b.radius_ratio()).ln().powi(2)
    };
    distance(a.moes(), b.moes()) + a.sliding.distance(b.sliding) + shape
}

/// Weights under which deformations are decomposed: the cell sizes, with the neighbour's at the nodes that carry no
/// pressure.
pub fn deformation_weights(grid: &ContactGrid) -> Vec<f64> {
    let weights = grid.weights();
    let n = weights.len();
    match grid {
        ContactGrid::Line(_) => (0..n).map(|i| weights[i.clamp(FIRST_UNKNOWN, n - 2)]).collect(),
        ContactGrid::Point(grid) => {
            let (nx, ny) = (grid.nx(), grid.ny());
            (0..n).map(|node| weights[(node / ny).clamp(1, nx - 2) * ny + (node % ny).max(1)]).collect()
        }
    }
}

/// How many times the largest residual that was measured in training an answer may have where the model was not
/// trained.
const FAR_RESIDUAL: f64 = 10.0;

impl Window {
    /// Assembles a window from its bases, with the penalty of the full system.
    pub fn new(
        m: (f64, f64),
        grid: ContactGrid,
        pressure: PressureModes,
        deformation: impl Into<Arc<PodBasis>>,
        snapshots: Vec<Snapshot>,
        sampling: Sampling,
        rows: SampledRows,
    ) -> Self {
        let deformation = deformation.into();
        let SampledRows { rows: sampled_rows, reconstruction, scheme, residual } = rows;
        Self {
            m,
            anchor: None,
            grid,
            penalty: PENALTY,
            cavitation: Cavitation::Penalty,
            pressure,
            deformation,
            shapes: None,
            sampling,
            sampled_rows,
            scheme,
            reconstruction,
            residual_reconstruction: residual,
            snapshots,
            traction: None,
            calibration: None,
        }
    }

    /// Why an iteration outside the model's range has found no solution, by its residual e_f^I: it is far beyond those
    /// of the training.
    pub fn residual_doubt(&self, residual: f64) -> Option<String> {
        let largest = self.calibration.as_ref().map_or(f64::INFINITY, Calibration::largest_residual);
        let far = residual.is_nan() || residual > FAR_RESIDUAL * largest;
        far.then(|| {
            format!("its residual of {residual:.1e} is far beyond those of the training, {largest:.1e} at most")
        })
    }

    /// R_y/R that it serves: all of a window that knows one shape.
    pub fn served_ratios(&self) -> (f64, f64) {
        self.shapes.as_ref().map_or((0.0, f64::INFINITY), |shapes| shapes.radius_ratio)
    }

    /// How large it is with all its modes.
    pub fn size(&self) -> ModelSize {
        let (pressure, deformation) = (self.pressure.count(), self.deformation.modes.ncols());
        ModelSize { pressure, deformation, rows: self.sampled_rows.len() }
    }

    /// Replaces the sampled rows, which ends a calibration and the rule for the traction on their nodes.
    pub fn set_rows(&mut self, sampling: Sampling, rows: SampledRows) {
        self.sampling = sampling;
        self.sampled_rows = rows.rows;
        (self.scheme, self.reconstruction, self.residual_reconstruction) =
            (rows.scheme, rows.reconstruction, rows.residual);
        (self.traction, self.calibration) = (None, None);
    }

    /// The nearest training solution by [`separation`], or by what tells oils apart where it knows many.
    pub fn nearest(&self, point: &OperatingPoint) -> Option<(&Snapshot, f64)> {
        if self.anchor.is_some() {
            let place = oil_place(point);
            let all = self.snapshots.iter().map(|snapshot| (snapshot, apart(place, oil_place(&snapshot.point))));
            return all.min_by(|a, b| a.1.total_cmp(&b.1));
        }
        self.snapshots.iter().map(|s| (s, separation(point, &s.point))).min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

impl ReducedModel {
    /// Index of the window that serves a contact: by the nearest anchor, or by its shape, then by M.
    pub fn window_for(&self, point: &OperatingPoint) -> usize {
        let moes = point.moes();
        if let Some(nearest) = self.nearest_anchor(moes) {
            return nearest;
        }
        let (ratio, m) = (point.radius_ratio(), moes.m);
        let aside = |window: &Window| {
            let (low, high) = window.shapes.as_ref().map_or(CIRCLES, |shapes| shapes.radius_ratio);
            (low / ratio).max(ratio / high).max(1.0)
        };
        let nearest = self.windows.iter().map(aside).fold(f64::INFINITY, f64::min);
        let beside = |w: &&Window| aside(w) <= nearest;
        let own = self.windows.iter().position(|w| beside(&w) && m <= w.m.1);
        own.or_else(|| self.windows.iter().rposition(|w| beside(&w))).unwrap_or(0)
    }

    /// The window that serves a contact.
    pub fn window_at(&self, point: &OperatingPoint) -> &Window {
        &self.windows[self.window_for(point)]
    }

    /// The kind of contact it is a model of.
    pub fn contact(&self) -> ContactKind {
        self.windows.first().map_or_else(ContactKind::default, |window| window.grid.kind())
    }

    /// Whether it is a model of ellipses.
    pub fn of_ellipses(&self) -> bool {
        self.domain.radius_ratio != CIRCLES
    }

    /// Whether its rows want gradients of the pressure: of a lubricant that thins under shear, and of films with heat.
    pub(crate) fn slides(&self) -> bool {
        self.domain.sliding.is_some() || self.domain.heat.is_some()
    }

    /// Whether it is a model of this kind of contact: of lines, of circles, or of ellipses.
    pub fn is_of(&self, point: &OperatingPoint) -> bool {
        self.contact() == point.kind && self.of_ellipses() == (point.radius_ratio() != 1.0)
    }

    /// Whether the model was trained for a problem.
    pub fn trust(&self, problem: &Problem) -> Trust {
        self.domain.trust(problem)
    }
}

impl Domain {
    /// Whether errors are measured against converged full solutions, since a few Newton steps do not tell them
    /// everywhere: where a lubricant thins under shear, with heat, and over the wide windows of many oils.
    pub fn measured_in_full(&self) -> bool {
        self.sliding.is_some() || self.heat.is_some() || self.oils.is_some()
    }

    /// |SRR| that was trained; none where films know no sliding.
    pub fn srr(&self) -> Option<(f64, f64)> {
        self.sliding.map(|sliding| sliding.srr).or(self.heat.map(|heat| heat.srr))
    }

    /// Whether a problem lies inside; boundaries count as inside to rounding.
    pub fn trust(&self, problem: &Problem) -> Trust {
        if let Some(other) = self.other_laws(problem) {
            return Trust::Outside(other.to_owned());
        }
        if problem.supply.is_some() {
            return Trust::Outside("the model was trained with a flooded inlet, not with a supplied film".to_owned());
        }
        let point = &problem.point;
        if let Some(why) = self.no_circle(point) {
            return Trust::Outside(why);
        }
        if let Some(oils) = &self.oils {
            if let Some(outside) = oils.outside(point).or_else(|| self.thinner_film(problem)) {
                return Trust::Outside(outside);
            }
        } else if (point.viscosity_pa_s / self.viscosity_pa_s - 1.0).abs() > 1e-6 {
            return Trust::Outside(format!(
                "the model was trained at an ambient viscosity of {} Pa·s, not {} Pa·s",
                self.viscosity_pa_s, point.viscosity_pa_s
            ));
        }
        let sliding = self.sliding.and_then(|sliding| sliding.outside(point));
        if let Some(outside) = sliding.or_else(|| self.heat.and_then(|heat| heat.outside(problem))) {
            return Trust::Outside(outside);
        }
        let [m, l, ratio, p_h] = self.shapes(problem);
        let alpha =
            Bounded { name: "α", value: point.alpha_per_pa, range: self.alpha_per_pa, scale: 1e9, unit: "/GPa" };
        [m, l, ratio, alpha, p_h].iter().find_map(Bounded::outside).map_or(Trust::Trained, Trust::Outside)
    }

    /// A sentence where a problem has other laws than those the model was trained with.
    fn other_laws(&self, problem: &Problem) -> Option<&'static str> {
        let (asked, own) = (problem.lubricant, self.lubricant);
        match (asked.heat, own.heat) {
            (Some(_), None) => return Some("the model was trained without heat"),
            (None, Some(_)) => return Some("the model was trained with heat"),
            _ => {}
        }
        let without_heat = |laws: Lubricant| Lubricant { heat: None, ..laws.of_the_liquid() };
        if without_heat(asked) != without_heat(own) {
            return Some("the model was trained with other lubricant laws");
        }
        // Under heat a limit cuts the heat that shear makes.
        if asked.heat.is_some() && asked.limiting_stress != own.limiting_stress {
            return Some("the model was trained with another limiting stress, which with heat changes the film");
        }
        (asked.heat != own.heat).then_some("the model was trained with other thermal constants of oil or bodies")
    }

    /// A sentence where M, L or p_H lie outside, or the contact is an ellipse, with any fluid: pressures and films of
    /// such shapes were never trained. Of another fluid inside, the bases still know the shapes, and the reduced
    /// equations are its own.
    pub fn strange_shape(&self, problem: &Problem) -> Option<String> {
        let outside = || self.shapes(problem).iter().find_map(Bounded::outside);
        self.no_circle(&problem.point).or_else(outside).or_else(|| self.thinner_film(problem))
    }

    /// A sentence where a film is thinner than the model's grid was made for.
    fn thinner_film(&self, problem: &Problem) -> Option<String> {
        let (least, film) = (self.oils?.thinnest_film, expected_film(problem.point.kind, problem.moes));
        (film < least * (1.0 - 1e-6)).then(|| {
            let [film, least] = [film, least].map(digits);
            format!(
                "by Moes’ formula its film is H_c = {film}, thinner than {least}, the thinnest that the model was trained for"
            )
        })
    }

    /// A sentence where a contact is an ellipse, and the model knows circles only.
    fn no_circle(&self, point: &OperatingPoint) -> Option<String> {
        let ellipse = self.radius_ratio == CIRCLES && point.radius_ratio() != 1.0;
        ellipse.then(|| "the model was trained for circular contacts only".to_owned())
    }

    /// What the shapes of pressure and film depend on most.
    fn shapes(&self, problem: &Problem) -> [Bounded; 4] {
        let ratio = problem.point.radius_ratio();
        let (p_h, highest) = (problem.point.hertz().pressure_pa, self.max_hertz_pressure_pa);
        let lowest = self.oils.map_or(0.0, |oils| oils.lowest_hertz_pressure_pa);
        [
            Bounded { name: "M", value: problem.moes.m, range: self.m, scale: 1.0, unit: "" },
            Bounded { name: "L", value: problem.moes.l, range: self.l, scale: 1.0, unit: "" },
            Bounded { name: "the ratio of radii", value: ratio, range: self.radius_ratio, scale: 1.0, unit: "" },
            Bounded { name: "p_H", value: p_h, range: (lowest, highest), scale: 1e-9, unit: " GPa" },
        ]
    }
}

/// A quantity with the range it was trained in.
struct Bounded {
    name: &'static str,
    value: f64,
    range: (f64, f64),
    /// Shown units per SI unit.
    scale: f64,
    unit: &'static str,
}

impl Bounded {
    /// A sentence where it lies outside.
    fn outside(&self) -> Option<String> {
        let Self { name, value, range: (low, high), scale, unit } = *self;
        if value >= low * (1.0 - 1e-6) && value <= high * (1.0 + 1e-6) {
            return None;
        }
        let range = if low > 0.0 {
            format!("outside the trained range {}…{}{unit}", digits(low * scale), digits(high * scale))
        } else {
            format!("above the trained {}{unit}", digits(high * scale))
        };
        Some(format!("{name} = {}{unit} lies {range}", digits(value * scale)))
    }
}

impl OilDomain {
    /// A sentence that says in what an oil lies outside.
    fn outside(&self, point: &OperatingPoint) -> Option<String> {
        let viscosity =
            Bounded {
                name: "η₀", value: point.viscosity_pa_s, range: self.viscosity_pa_s, scale: 1e3, unit: " mPa·s"
            };
        let exponent = roelands_exponent(point);
        let exponent = Bounded { name: "Roelands’ z", value: exponent, range: self.exponent, scale: 1.0, unit: "" };
        [viscosity, exponent].iter().find_map(Bounded::outside)
    }
}

/// A sentence where a contact has another reduced modulus \[Pa\].
fn other_modulus(trained: f64, given: f64) -> Option<String> {
    if (given / trained - 1.0).abs() <= 1e-3 {
        return None;
    }
    let [own, given] = [trained, given].map(|modulus| digits(modulus * 1e-9));
    Some(format!("the model was trained with a reduced modulus of {own} GPa, not {given} GPa"))
}

impl HeatDomain {
    /// A sentence that says in what a contact lies outside.
    fn outside(&self, problem: &Problem) -> Option<String> {
        let point = &problem.point;
        if let Some(other) = other_modulus(self.modulus_pa, point.modulus_pa) {
            return Some(other);
        }
        if (point.radius_m / self.radius_m - 1.0).abs() > 1e-3 {
            let [own, given] = [self.radius_m, point.radius_m].map(|radius| digits(radius * 1e3));
            return Some(format!(
                "the model was trained with a radius of {own} mm, not {given} mm; with heat that is another contact at \
                 equal M and L"
            ));
        }
        let plateau = problem.lubricant.shear.plateau();
        let given = point.sliding.newtonian_plateau_ratio.unwrap_or(plateau);
        if problem.shear.is_some() && given != plateau {
            return Some(format!("the model was trained with an NPR of {plateau}, not {given}"));
        }
        // Which body is the faster one matters where they are of two materials.
        let alike = problem.heat.is_none_or(|heat| heat.heat.bodies[0] == heat.heat.bodies[1]);
        let srr = point.sliding.slide_to_roll_ratio;
        let srr = if alike { srr.abs() } else { srr };
        Bounded { name: "SRR", value: srr, range: self.srr, scale: 1.0, unit: "" }.outside()
    }
}

impl SlidingDomain {
    /// A sentence that says in what a point lies outside.
    fn outside(&self, point: &OperatingPoint) -> Option<String> {
        if let Some(other) = other_modulus(self.modulus_pa, point.modulus_pa) {
            return Some(other);
        }
        let npr = point.sliding.newtonian_plateau_ratio.unwrap_or(1.0);
        let checks = [("SRR", point.sliding.slide_to_roll_ratio.abs(), self.srr), ("NPR", npr, self.npr)];
        checks
            .into_iter()
            .find(|(_, value, (low, high))| *value < low - 1e-9 || *value > high + 1e-9)
            .map(|(name, value, (low, high))| format!("{name} = {value} lies outside the trained range {low}…{high}"))
    }
}

/// Four significant digits without trailing zeros.
pub(super) fn digits(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let decimals = (3 - value.abs().log10().floor() as i32).clamp(0, 12) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::physics::contact::{MoesRequest, si_from_moes};
    use crate::solver::physics::lubricant::ViscosityLaw;

    #[test]
    fn what_lies_outside_is_said_with_sensible_digits() {
        let domain = Domain {
            m: (2.0, 500.0),
            l: (1.0, 21.2),
            alpha_per_pa: (5e-9, 20e-9),
            max_hertz_pressure_pa: 3.2e9,
            viscosity_pa_s: 0.01,
            lubricant: Lubricant::default(),
            sliding: None,
            radius_ratio: CIRCLES,
            oils: None,
            heat: None,
        };
        let trust = |m, l| {
            let point = si_from_moes(&MoesRequest::new(ContactKind::Line, m, l)).unwrap();
            domain.trust(&Problem::new(&point, Lubricant::default()).unwrap())
        };
        assert_eq!(trust(40.0, 10.0), Trust::Trained);
        assert_eq!(trust(1.0, 10.0), Trust::Outside("M = 1 lies outside the trained range 2…500".to_owned()));
        let Trust::Outside(why) = trust(200.0, 15.0) else { panic!("beyond the pressure limit") };
        assert!(why.starts_with("p_H = 4.8") && why.ends_with("GPa lies above the trained 3.2 GPa"), "{why}");
        // Another fluid, or another α, may have shapes that are known.
        let barus = Lubricant { viscosity: ViscosityLaw::Barus, ..Lubricant::default() };
        let shape = |m, l, lubricant| {
            let point = si_from_moes(&MoesRequest::new(ContactKind::Line, m, l)).unwrap();
            let domain = Domain { alpha_per_pa: (1e-9, 2e-9), ..domain.clone() };
            let problem = Problem::new(&point, lubricant).unwrap();
            assert!(matches!(domain.trust(&problem), Trust::Outside(_)));
            domain.strange_shape(&problem)
        };
        assert_eq!(shape(40.0, 10.0, barus), None);
        assert_eq!(shape(40.0, 10.0, Lubricant::default()), None);
        assert!(shape(1.0, 10.0, barus).is_some_and(|why| why.starts_with("M = 1 lies outside")));
        assert!(shape(200.0, 15.0, barus).is_some_and(|why| why.starts_with("p_H")));
    }

    #[test]
    fn the_distance_is_the_dissertations() {
        let d = distance(Moes { m: 10.0, l: 5.0 }, Moes { m: 20.0, l: 8.0 });
        assert!((d - (100.0 / 500.0 + 0.009)).abs() < 1e-15);
    }
}
