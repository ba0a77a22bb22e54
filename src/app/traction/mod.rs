//! Traction and film along one quantity: a curve by the reduced model that follows the other sliders, and full solutions on request.

mod curve;
pub mod export;
mod full;

pub use curve::Curve;

use super::in_use::InUse;
use super::jobs::Key;
use super::numbers;
use super::state::State;
use super::task::{Standing, Task};
use crate::solver::contact::{ContactKind, OperatingPoint};
use crate::solver::full::{Problem, Solution};
use crate::solver::reduced::{Domain, Trust};
use curve::Worker;
use egui::Context;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Contacts of a curve by the reduced model.
pub const CURVE: usize = 41;
/// Full solutions that are set on it: every fourth of its contacts.
const MARKERS: usize = 11;
/// What a logarithmic axis of SRR begins with, as a share of its end.
const LOG_SRR: f64 = 5e-3;
/// What a logarithmic axis of NPR begins with at least.
const LOG_NPR: f64 = 1e-2;
/// Ends of SRR and NPR where no model sets them.
const SRR: (f64, f64) = (0.0, 2.0);
const NPR: (f64, f64) = (0.0, 1.0);

/// The quantity that a sweep varies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Varied {
    /// |SRR|.
    SlideToRoll,
    /// NPR.
    Plateau,
    /// u_m \[m/s\] at constant load.
    Speed,
}

/// What the curves are drawn against; the last three are one quantity in three units.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Against {
    /// SRR.
    #[default]
    SlideToRoll,
    /// NPR.
    Plateau,
    /// u_m.
    Speed,
    /// η₀ u_m/w, as Stribeck drew friction.
    Stribeck,
    /// M.
    LoadNumber,
}

/// The contacts between two values of a quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// What varies.
    pub varied: Varied,
    /// The contact at the first value, and the laws.
    pub base: Key,
    /// First and last value.
    pub ends: (f64, f64),
    /// Whether its contacts are spaced by equal ratios.
    pub logarithmic: bool,
}

/// One contact of a sweep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The contact.
    pub point: OperatingPoint,
    /// Central film \[m\].
    pub h_c_m: f64,
    /// Smallest film \[m\].
    pub h_min_m: f64,
    /// Size of the traction coefficient over the whole domain, (3.41).
    pub traction: f64,
}

/// Full solutions along a sweep.
pub struct Markers {
    /// The sweep.
    pub sweep: Sweep,
    /// What has been solved so far.
    pub samples: Vec<Sample>,
}

/// How the tab shows it; not part of the document.
#[derive(Clone, Copy, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Choices {
    /// What the curves are drawn against.
    pub against: Against,
    /// Logarithmic axes: along, and of traction and film.
    pub logarithmic: (bool, bool),
    /// Whether the laws of the fluid are shown in place of the traction.
    pub shows_fluid: bool,
    /// Whether the note for teaching is shown.
    pub why: bool,
}

/// What the tab knows.
#[derive(Default)]
pub struct TractionView {
    /// The last curve by the reduced model.
    pub curve: Option<Curve>,
    /// Full solutions.
    pub markers: Option<Markers>,
    /// Why there are no more of them.
    pub message: Option<String>,
    /// The largest shear stress of a solution.
    pub stress_met: Option<(Arc<Solution>, f64)>,
    worker: Option<Worker>,
    wanted: Option<(Sweep, InUse)>,
    task: Option<Task<Sample>>,
}

impl Varied {
    /// Its value of a contact.
    pub fn of(self, key: &Key) -> f64 {
        let sliding = key.point.sliding;
        match self {
            Self::SlideToRoll => sliding.slide_to_roll_ratio.abs(),
            Self::Plateau => sliding.newtonian_plateau_ratio.unwrap_or(key.lubricant.shear.plateau()),
            Self::Speed => key.point.speed_m_per_s,
        }
    }

    /// The same contact with another value of it.
    pub fn at(self, point: &OperatingPoint, value: f64) -> OperatingPoint {
        let mut point = *point;
        match self {
            Self::SlideToRoll => point.sliding.slide_to_roll_ratio = value,
            Self::Plateau => point.sliding.newtonian_plateau_ratio = Some(value),
            Self::Speed => point.speed_m_per_s = value,
        }
        point
    }

    /// The values for which a model was trained; speeds at the load, the radius and the fluid of a contact. `None` where there are none.
    fn trained(self, domain: &Domain, point: &OperatingPoint) -> Option<(f64, f64)> {
        match self {
            Self::SlideToRoll => Some(domain.sliding.map_or(SRR, |sliding| sliding.srr)),
            Self::Plateau => domain.sliding.map(|sliding| sliding.npr),
            Self::Speed => {
                let (e, r) = (point.modulus_pa, point.radius_m);
                // Both Moes numbers hold the speed in 2 η₀ u/(E′ R) only: (3.19), (3.22).
                let speed = |group: f64| group * e * r / (2.0 * point.viscosity_pa_s);
                let of_l = |l: f64| speed((l / (point.alpha_per_pa * e)).powi(4));
                let of_m = |m: f64| match point.kind {
                    ContactKind::Line => speed((point.load / (e * r * m)).powi(2)),
                    ContactKind::Point => speed((point.load / (e * r * r * m)).powf(4.0 / 3.0)),
                };
                let ends = (of_l(domain.l.0).max(of_m(domain.m.1)), of_l(domain.l.1).min(of_m(domain.m.0)));
                (ends.0 < ends.1).then_some(ends)
            }
        }
    }

    /// The values where no model sets them; of the speed the decades around the present one.
    fn everywhere(self, point: &OperatingPoint) -> (f64, f64) {
        match self {
            Self::SlideToRoll => SRR,
            Self::Plateau => NPR,
            Self::Speed => {
                let decade = point.speed_m_per_s.log10().round();
                (10f64.powf(decade - 1.0), 10f64.powf(decade + 1.0))
            }
        }
    }
}

impl Against {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::SlideToRoll, Self::Plateau, Self::Speed, Self::Stribeck, Self::LoadNumber];

    /// The quantity behind it.
    pub fn varied(self) -> Varied {
        match self {
            Self::SlideToRoll => Varied::SlideToRoll,
            Self::Plateau => Varied::Plateau,
            Self::Speed | Self::Stribeck | Self::LoadNumber => Varied::Speed,
        }
    }

    /// For people.
    pub fn name(self) -> &'static str {
        match self {
            Self::SlideToRoll => "slide-to-roll ratio",
            Self::Plateau => "plateau ratio",
            Self::Speed => "speed",
            Self::Stribeck => "Stribeck number",
            Self::LoadNumber => "load number",
        }
    }

    /// What it is.
    pub fn tip(self) -> &'static str {
        match self {
            Self::SlideToRoll => "SRR = (u₂ − u₁)/u_m (3.25)",
            Self::Plateau => "Newtonian plateau ratio NPR of (3.40)",
            Self::Speed => "Mean entrainment speed u_m at constant load",
            Self::Stribeck => "η₀ u_m/w at constant load, as Stribeck drew friction",
            Self::LoadNumber => "M, (3.19) or (3.22), by the speed at constant load",
        }
    }

    /// Title of its axis, with symbols in braces.
    pub fn axis(self, kind: ContactKind) -> &'static str {
        match (self, kind) {
            (Self::SlideToRoll, _) => "Slide-to-roll ratio {SRR}",
            (Self::Plateau, _) => "Newtonian plateau ratio {NPR}",
            (Self::Speed, _) => "Speed {u_m} in m/s",
            (Self::Stribeck, ContactKind::Line) => "Stribeck number η₀{u_m}/{w}",
            (Self::Stribeck, ContactKind::Point) => "Stribeck number η₀{u_m}/{w} in 1/m",
            (Self::LoadNumber, _) => "Load number {M}",
        }
    }

    /// Where a contact stands.
    pub fn of(self, key: &Key) -> f64 {
        let point = &key.point;
        match self {
            Self::SlideToRoll | Self::Plateau | Self::Speed => self.varied().of(key),
            Self::Stribeck => point.viscosity_pa_s * point.speed_m_per_s / point.load,
            Self::LoadNumber => point.moes().m,
        }
    }

    /// The value of the quantity behind a place on the axis.
    pub fn value(self, point: &OperatingPoint, place: f64) -> f64 {
        match self {
            Self::SlideToRoll | Self::Plateau | Self::Speed => place,
            Self::Stribeck => place * point.load / point.viscosity_pa_s,
            Self::LoadNumber => {
                let exponent = if point.kind == ContactKind::Line { 0.5f64 } else { 0.75 };
                point.speed_m_per_s * (point.moes().m / place).powf(1.0 / exponent)
            }
        }
    }
}

impl Sweep {
    /// The values of so many contacts.
    pub fn values(&self, count: usize) -> impl Iterator<Item = f64> + '_ {
        let (from, to) = self.ends;
        let share = move |k: usize| k as f64 / (count - 1) as f64;
        (0..count).map(
            move |k| {
                if self.logarithmic { from * (to / from).powf(share(k)) } else { from + (to - from) * share(k) }
            },
        )
    }

    /// The contact of a value.
    pub fn point(&self, value: f64) -> OperatingPoint {
        self.varied.at(&self.base.point, value)
    }

    /// A sentence where every traction along it is no physics.
    pub fn unphysical(&self) -> Option<String> {
        Problem::new(&self.base.point, self.base.lubricant).ok()?.traction_warning()
    }
}

impl Sample {
    /// What a solution adds up to.
    fn of(point: OperatingPoint, solution: &Solution) -> Self {
        let scale = point.film_scale_m();
        Self {
            point,
            h_c_m: solution.scalars.h_c * scale,
            h_min_m: solution.scalars.h_min * scale,
            traction: solution.traction_coefficient().abs(),
        }
    }
}

impl TractionView {
    /// Takes in what came since the last frame.
    pub fn receive(&mut self) {
        if let Some(curve) = self.worker.as_ref().and_then(Worker::latest) {
            self.curve = Some(curve);
        }
        let (Some(task), Some(markers)) = (&mut self.task, &mut self.markers) else { return };
        if let Some(ending) = task.poll(|sample| markers.samples.push(sample)) {
            self.message = ending.err();
            self.task = None;
        }
    }

    /// How far the full solutions are.
    pub fn standing(&self) -> Option<Standing> {
        self.task.as_ref().map(Task::standing)
    }

    /// Stops the full solutions; what has been solved stays.
    pub fn stop(&self) {
        if let Some(task) = &self.task {
            task.stop();
        }
    }

    /// Whether the curve that is drawn is the one that was asked for last.
    pub fn curve_is_current(&self) -> bool {
        matches!((&self.curve, &self.wanted), (Some(curve), Some((sweep, in_use)))
            if curve.sweep == *sweep && curve.in_use == *in_use)
    }
}

impl State {
    /// The sweep through the contact of the sliders, and the reduced model that serves all of it or why none does. `None` where the fluid does
    /// not answer to the quantity.
    pub fn sweep(&self) -> Option<(Sweep, Result<InUse, String>)> {
        let varied = self.display.traction.against.varied();
        let key = self.key();
        let mut point = key.point;
        point.sliding.slide_to_roll_ratio = point.sliding.slide_to_roll_ratio.abs();
        Problem::new(&varied.at(&point, varied.of(&key)), key.lubricant).ok()?;
        let (ends, served) = match self.in_use() {
            None => (varied.everywhere(&point), Err("there is no reduced model of this contact".to_owned())),
            Some(in_use) => match varied.trained(&in_use.model.domain, &point) {
                Some(ends) => match outside(&in_use, &key, varied, ends) {
                    None => (ends, Ok(in_use)),
                    Some(why) => (ends, Err(why)),
                },
                None => (varied.everywhere(&point), Err("the reduced model was trained for no such speed".to_owned())),
            },
        };
        let logarithmic = self.display.traction.logarithmic.0;
        let ends = match varied {
            Varied::SlideToRoll if logarithmic => (ends.0.max(LOG_SRR * ends.1), ends.1),
            Varied::Plateau if logarithmic => (ends.0.max(LOG_NPR), ends.1),
            _ => ends,
        };
        let base = Key { point: varied.at(&point, ends.0), lubricant: key.lubricant };
        Some((Sweep { varied, base, ends, logarithmic }, served))
    }

    /// Asks for the curve of a sweep, unless it has been asked for.
    pub fn follow_sweep(&mut self, ctx: &Context, sweep: &Sweep, in_use: &InUse) {
        let view = &mut self.traction;
        let asked = view.wanted.as_ref().is_some_and(|(wanted, by)| wanted == sweep && by == in_use);
        if !asked {
            view.wanted = Some((sweep.clone(), in_use.clone()));
            view.worker.get_or_insert_with(Worker::default).ask(ctx, sweep.clone(), in_use.clone());
        }
    }

    /// Solves contacts of a sweep in full, one from the other.
    pub fn start_markers(&mut self, ctx: &Context, sweep: &Sweep) {
        let serves = self.passed_over.is_none() || self.plane().is_none();
        let model = self.model().filter(|_| serves).cloned();
        self.traction.message = None;
        self.traction.markers = Some(Markers { sweep: sweep.clone(), samples: Vec::new() });
        self.traction.task = Some(full::start(ctx, sweep.clone(), model, self.plane()));
    }

    /// Goes to a place on the axis.
    ///
    /// # Errors
    /// A sentence when the contact would be refused; the document is unchanged then.
    pub fn go_along(&mut self, place: f64) -> Result<(), String> {
        let value = numbers::rounded(self.display.traction.against.value(&self.document.point, place), 3);
        match self.display.traction.against.varied() {
            Varied::SlideToRoll => {
                let srr = self.document.point.sliding.slide_to_roll_ratio;
                self.document.set_slide_to_roll_ratio(value.max(0.0).copysign(srr))
            }
            Varied::Plateau => self.document.set_plateau_ratio(Some(value.clamp(0.0, 1.0))),
            Varied::Speed => self.document.set_quantity(super::document::Quantity::Speed, value),
        }
    }
}

/// Why a model does not serve a sweep, where it does not.
fn outside(in_use: &InUse, key: &Key, varied: Varied, ends: (f64, f64)) -> Option<String> {
    [ends.0, ends.1].into_iter().find_map(|value| {
        let problem = Problem::new(&varied.at(&key.point, value), key.lubricant);
        match problem.map(|problem| in_use.model.trust(&problem)) {
            Ok(Trust::Trained) => None,
            Ok(Trust::Outside(why)) => Some(why),
            Err(refused) => Some(refused.to_string()),
        }
    })
}
