//! Sweep of contacts along one quantity: the quantity, its ends, and its position on an axis.

use crate::app::document::Key;
use crate::app::in_use::question;
use crate::scene::study::{PathRow, sweep as scene};
use crate::scene::{Axis, Grid, Method, Scene, Steps, Study, StudyRow};
use crate::solver::full::{Mixed, Problem, TractionDoubt};
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::engineering::{QuantityKind, Unit, UnitSystem};
use crate::solver::physics::lubricant::{Lubricant, ShearLaw};
use crate::solver::reduced::Domain;
use serde::{Deserialize, Serialize};

/// Half of the contacts of a curve are within this |SRR| of its first one, where the traction rises.
const RISES: f64 = 0.05;

/// Ends of SRR and NPR if no model sets them.
const SRR: (f64, f64) = (0.0, 2.0);
const NPR: (f64, f64) = (0.0, 1.0);
/// Ends of R_y/R, from contacts that are long along the rolling direction to nearly line contacts.
const RADIUS_RATIO: (f64, f64) = (0.2, 20.0);

/// Quantity varied by a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Varied {
    /// |SRR|.
    SlideToRoll,
    /// NPR.
    Plateau,
    /// u_m \[m/s\] at constant load.
    Speed,
    /// R_y/R of a point contact at constant load.
    RadiusRatio,
}

/// Quantity on the horizontal axis. Speed, Stribeck number and M are the same quantity in different units.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Against {
    /// SRR.
    #[default]
    SlideToRoll,
    /// NPR.
    Plateau,
    /// u_m.
    Speed,
    /// η₀ u_m/w, the Stribeck number.
    Stribeck,
    /// M.
    LoadNumber,
    /// R_y/R.
    RadiusRatio,
}

/// Contacts between two values of a quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// Varied quantity.
    pub varied: Varied,
    /// Contact at the first value, with its laws.
    pub base: Key,
    /// First and last value.
    pub ends: (f64, f64),
    /// True if the contacts are spaced by equal ratios. Contacts of SRR are always graded.
    pub logarithmic: bool,
}

/// Reference case for comparison, contact by contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Companion {
    /// The same lubricant as a Newtonian fluid without limiting stress.
    Newtonian,
    /// The same contact without heat.
    WithoutHeat,
}

/// Contact of a sweep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Contact.
    pub point: OperatingPoint,
    /// Central film thickness \[m\].
    pub h_c_m: f64,
    /// Minimum film thickness \[m\].
    pub h_min_m: f64,
    /// Magnitude of the traction coefficient over the whole domain, (3.41).
    pub traction: f64,
    /// Traction coefficient of the companion. `None` if it is not available.
    pub companion: Option<f64>,
    /// Reason why its traction is not physical, if it is not.
    pub unphysical: Option<TractionDoubt>,
    /// Results of rough surfaces; `None` for smooth ones.
    pub mixed: Option<Mixed>,
}

impl Companion {
    /// Returns the title of its study.
    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Newtonian => "Newtonian traction",
            Self::WithoutHeat => "Traction without heat",
        }
    }

    /// Returns the name of its curve.
    pub fn name(self) -> &'static str {
        match self {
            Self::Newtonian => "if it were Newtonian",
            Self::WithoutHeat => "without heat",
        }
    }

    /// Returns the name of its column.
    pub(super) fn column(self) -> &'static str {
        match self {
            Self::Newtonian => "newtonian_traction",
            Self::WithoutHeat => "isothermal_traction",
        }
    }
}

impl Varied {
    /// Returns its value in a contact.
    pub fn of(self, key: &Key) -> f64 {
        let sliding = key.point.sliding;
        match self {
            Self::SlideToRoll => sliding.slide_to_roll_ratio.abs(),
            Self::Plateau => sliding.newtonian_plateau_ratio.unwrap_or(key.lubricant.shear.plateau()),
            Self::Speed => key.point.speed_m_per_s,
            Self::RadiusRatio => key.point.radius_ratio(),
        }
    }

    /// Returns the quantity in scenes and edits.
    pub(super) fn quantity(self) -> Quantity {
        match self {
            Self::SlideToRoll => Quantity::SlideToRollRatio,
            Self::Plateau => Quantity::NewtonianPlateauRatio,
            Self::Speed => Quantity::Speed,
            Self::RadiusRatio => Quantity::RadiusRatio,
        }
    }

    /// Returns the same contact with another value of it.
    pub fn at(self, point: &OperatingPoint, value: f64) -> OperatingPoint {
        self.quantity().at(point, value)
    }

    /// Returns the contacts for which a model was trained that does not vary the quantity, in words.
    pub(super) fn trained_without(self) -> &'static str {
        match self {
            Self::RadiusRatio => "circular contacts only",
            Self::Plateau => "one plateau ratio only",
            Self::SlideToRoll | Self::Speed => "other speeds",
        }
    }

    /// Returns the values inside the trained range. Speeds apply to the load, radius and fluid of a contact. `None`
    /// if there are none.
    pub(super) fn trained(self, domain: &Domain, point: &OperatingPoint) -> Option<(f64, f64)> {
        match self {
            Self::SlideToRoll => {
                let (from, to) = domain.srr().unwrap_or(SRR);
                // A thermal model is also limited by the sliding speed.
                let fastest = domain.interval(Quantity::SlidingSpeed).map_or(f64::INFINITY, |(_, fastest)| fastest);
                Some((from, to.min(fastest / point.speed_m_per_s)))
            }
            Self::Plateau => domain.interval(Quantity::NewtonianPlateauRatio),
            Self::RadiusRatio => None,
            Self::Speed => {
                let (e, r) = (point.modulus_pa, point.radius_m);
                // Both Moes numbers depend on the speed only through 2 η₀ u/(E′ R): (3.19), (3.22).
                let speed = |group: f64| group * e * r / (2.0 * point.viscosity_pa_s);
                let of_l = |l: f64| speed((l / (point.alpha_per_pa * e)).powi(4));
                let of_m = |m: f64| {
                    if point.kind.is_line() {
                        speed((point.load / (e * r * m)).powi(2))
                    } else {
                        speed((point.load / (e * r * r * m)).powf(4.0 / 3.0))
                    }
                };
                let (m, l) = (domain.m(), domain.l());
                let ends = (of_l(l.0).max(of_m(m.1)), of_l(l.1).min(of_m(m.0)));
                (ends.0 < ends.1).then_some(ends)
            }
        }
    }

    /// Returns a range extended to the contact's own ratio. A range of speeds is returned unchanged, because it
    /// ends at the limits of M or L.
    pub(super) fn around(self, key: &Key, (from, to): (f64, f64)) -> (f64, f64) {
        match self {
            Self::SlideToRoll | Self::Plateau => (from.min(self.of(key)), to.max(self.of(key))),
            Self::Speed | Self::RadiusRatio => (from, to),
        }
    }

    /// Returns the range of values if no model sets it. For the speed these are the decades around the present one, or
    /// those of the Stribeck curve of rough surfaces.
    pub(super) fn everywhere(self, key: &Key) -> (f64, f64) {
        let point = &key.point;
        match self {
            Self::Speed if key.lubricant.is_rough() => stribeck(key),
            Self::SlideToRoll => SRR,
            Self::Plateau => NPR,
            Self::RadiusRatio => RADIUS_RATIO,
            Self::Speed => {
                let decade = point.speed_m_per_s.log10().round();
                (10f64.powf(decade - 1.0), 10f64.powf(decade + 1.0))
            }
        }
    }
}

/// Returns the speeds of a Stribeck curve: five decades below and two above the speed at which the film of smooth
/// surfaces is as thick as the composite roughness, by the film formula. They include the present speed.
fn stribeck(key: &Key) -> (f64, f64) {
    let (point, sigma) = (&key.point, key.lubricant.roughness.map_or(0.0, |roughness| roughness.sigma));
    let decade = point.at_film_m(sigma).speed_m_per_s.log10().round();
    let (from, to) = (10f64.powf(decade - 5.0), 10f64.powf(decade + 2.0));
    (from.min(point.speed_m_per_s), to.max(point.speed_m_per_s))
}

impl Against {
    /// All quantities.
    pub const ALL: [Self; 6] =
        [Self::SlideToRoll, Self::Plateau, Self::Speed, Self::Stribeck, Self::LoadNumber, Self::RadiusRatio];

    /// Returns true if the quantity exists for a kind of contact.
    pub fn is_of(self, kind: ContactKind) -> bool {
        self != Self::RadiusRatio || kind.is_point()
    }

    /// Returns the reason why a contact has no sweep of the quantity.
    pub(super) fn why_none(self) -> &'static str {
        if self == Self::RadiusRatio {
            "A roller has no radius across the rolling direction; choose Ball or Ellipse"
        } else {
            "The lubricant has no shear constants: it is Newtonian, and there is no plateau ratio to vary"
        }
    }

    /// Returns the varied quantity.
    pub fn varied(self) -> Varied {
        match self {
            Self::SlideToRoll => Varied::SlideToRoll,
            Self::Plateau => Varied::Plateau,
            Self::Speed | Self::Stribeck | Self::LoadNumber => Varied::Speed,
            Self::RadiusRatio => Varied::RadiusRatio,
        }
    }

    /// Returns the name on the screen.
    pub fn name(self) -> &'static str {
        match self {
            Self::SlideToRoll => "slide-to-roll ratio",
            Self::Plateau => "plateau ratio",
            Self::Speed => "speed",
            Self::Stribeck => "Stribeck number",
            Self::LoadNumber => "load number",
            Self::RadiusRatio => "ratio of radii",
        }
    }

    pub fn tip(self) -> &'static str {
        match self {
            Self::SlideToRoll => "SRR = (u₂ − u₁)/u_m in percent (3.25)",
            Self::Plateau => "Newtonian plateau ratio NPR of (3.40)",
            Self::Speed => "Mean entrainment speed u_m at constant load",
            Self::Stribeck => "Stribeck number η₀ u_m/w at constant load",
            Self::LoadNumber => "M, (3.19) or (3.22), varied by the speed at constant load",
            Self::RadiusRatio => {
                "R_y/R at constant load: from ellipses along the rolling direction to nearly line contacts"
            }
        }
    }

    /// Returns the title of its axis, with symbols in braces.
    pub fn axis(self, kind: ContactKind, system: UnitSystem) -> String {
        let title = match (self, kind) {
            (Self::SlideToRoll, _) => "Slide-to-roll ratio {SRR} in ",
            (Self::Plateau, _) => "Newtonian plateau ratio {NPR}",
            (Self::Speed, _) => "Speed {u_m} in ",
            (Self::Stribeck, ContactKind::Line) => "Stribeck number η₀{u_m}/{w}",
            (Self::Stribeck, ContactKind::Point) => "Stribeck number η₀{u_m}/{w} in 1/m",
            (Self::LoadNumber, _) => "Load number {M}",
            (Self::RadiusRatio, _) => "Ratio of radii {R_y}/{R}",
        };
        format!("{title}{}", self.unit(system).name)
    }

    /// Returns the unit of its axis.
    pub fn unit(self, system: UnitSystem) -> Unit {
        let kind = match self {
            Self::SlideToRoll => QuantityKind::Percent,
            Self::Speed => QuantityKind::Speed,
            Self::Plateau | Self::Stribeck | Self::LoadNumber | Self::RadiusRatio => QuantityKind::Number,
        };
        kind.unit(system)
    }

    /// Returns the value of a contact in SI units.
    pub fn of(self, key: &Key) -> f64 {
        let point = &key.point;
        match self {
            Self::SlideToRoll | Self::Plateau | Self::Speed | Self::RadiusRatio => self.varied().of(key),
            Self::Stribeck => point.viscosity_pa_s * point.speed_m_per_s / point.load,
            Self::LoadNumber => point.moes().m,
        }
    }

    /// Returns the value of the varied quantity for a value of this one.
    pub fn value(self, point: &OperatingPoint, place: f64) -> f64 {
        match self {
            Self::SlideToRoll | Self::Plateau | Self::Speed | Self::RadiusRatio => place,
            Self::Stribeck => place * point.load / point.viscosity_pa_s,
            Self::LoadNumber => point.speed_m_per_s * (point.moes().m / place).powf(1.0 / point.kind.speed_power()),
        }
    }
}

impl Sweep {
    /// Returns the study of `count` contacts of the sweep by one method as a scene.
    pub(super) fn question(&self, title: &str, grid: Grid, count: usize, method: Method) -> Scene {
        let (from, to) = self.ends;
        let (n, half) = (count, from + RISES);
        let graded = self.varied == Varied::SlideToRoll && Steps::check_grading(from, half, to).is_ok();
        let values = match self.logarithmic {
            _ if graded => Steps::Graded { from, half, to, n },
            true => Steps::Log { from, to, n },
            false => Steps::Linear { from, to, n },
        };
        let over = vec![Axis { vary: self.varied.quantity(), values }];
        let study = scene::Sweep { over, methods: vec![method], cold: false, compare_on_model_grid: false };
        question(title, &self.base, grid, Study::Sweep(study))
    }

    /// Returns the contact of the sweep with the same value of the varied quantity as another contact. If the other
    /// contact lies on the sweep, it is returned itself.
    pub fn contact_like(&self, other: &Key) -> Key {
        let mut point = self.varied.at(&self.base.point, self.varied.of(other));
        // The sign of sliding, and a plateau ratio that comes from the lubricant, define the same sweep.
        let theirs = other.point.sliding;
        if self.varied == Varied::Plateau {
            point.sliding.newtonian_plateau_ratio = theirs.newtonian_plateau_ratio;
        }
        let key = Key { point, lubricant: self.base.lubricant };
        let srr = theirs.slide_to_roll_ratio;
        if srr < 0.0 && point.sliding.slide_to_roll_ratio == -srr { key.exchanged() } else { key }
    }

    /// Returns the companion: the isothermal contact for a thermal sweep, otherwise the Newtonian contact. `None`
    /// if the lubricant is Newtonian already, if NPR is varied, and for rough surfaces.
    pub fn companion(&self) -> Option<Companion> {
        let Lubricant { shear, limiting_stress, heat, .. } = self.base.lubricant;
        if self.base.lubricant.is_rough() {
            return None;
        }
        let bends = shear != ShearLaw::Newtonian || limiting_stress.is_some();
        match heat {
            Some(_) => Some(Companion::WithoutHeat),
            None => (bends && self.varied != Varied::Plateau).then_some(Companion::Newtonian),
        }
    }

    /// Returns the companion with its sweep.
    pub(super) fn accompanied(&self) -> Option<(Companion, Self)> {
        let companion = self.companion()?;
        let Key { mut point, lubricant } = self.base;
        let lubricant = match companion {
            Companion::WithoutHeat => Lubricant { heat: None, ..lubricant },
            Companion::Newtonian => lubricant.of_the_film(),
        };
        if companion == Companion::Newtonian && lubricant.shear != ShearLaw::Newtonian {
            point.sliding.newtonian_plateau_ratio = Some(1.0);
        }
        Some((companion, Self { base: Key { point, lubricant }, ..self.clone() }))
    }

    /// Returns true if the companion's traction is proportional to the varied quantity. Without shear-thinning and
    /// heat the film thickness does not depend on the sliding.
    fn is_proportional(&self) -> bool {
        self.varied == Varied::SlideToRoll && self.companion() == Some(Companion::Newtonian)
    }

    /// Returns the number of companion contacts for `count` contacts of the sweep.
    pub(super) fn companions(&self, count: usize) -> usize {
        if self.is_proportional() { 2 } else { count }
    }

    /// Stores the traction of the companion in the contacts of the sweep.
    pub(super) fn note_companions(&self, samples: &mut [Sample], companions: &[Sample]) {
        let lubricant = self.base.lubricant;
        let of = |sample: &Sample| self.varied.of(&Key { point: sample.point, lubricant });
        for sample in samples {
            let value = of(sample);
            sample.companion = if self.is_proportional() {
                companions.last().filter(|last| of(last) > 0.0).map(|last| last.traction * value / of(last))
            } else {
                companions.iter().find(|other| of(other) == value).map(|other| other.traction)
            };
        }
    }

    /// Returns a sentence if the traction is unphysical along the whole sweep.
    pub fn unphysical(&self) -> Option<String> {
        Problem::new(&self.base.point, self.base.lubricant).ok()?.traction_warning()
    }
}

impl Sample {
    /// Returns the contact of a study row. `None` if it failed.
    pub(super) fn of_row(row: &StudyRow, sweep: &Sweep) -> Option<Self> {
        if let StudyRow::Sweep(row) = row { Self::of(row, &sweep.base.lubricant) } else { None }
    }

    /// Returns the results of a contact by its first method. `None` if it failed.
    pub(super) fn of(row: &PathRow, lubricant: &Lubricant) -> Option<Self> {
        let result = row.results().first()?;
        let (scalars, scale) = (result.scalars?, result.point.film_scale_m());
        let traction = result.traction?.abs();
        let problem = Problem::new(&result.point, *lubricant).ok()?;
        Some(Self {
            point: result.point,
            h_c_m: scalars.h_c * scale,
            h_min_m: scalars.h_min * scale,
            traction,
            companion: None,
            unphysical: problem.doubts_traction(traction, &scalars),
            mixed: result.mixed,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::embedded;
    use crate::scene::named_lubricant::{MINERAL_OIL, SQUALANE_PIP};
    use crate::solver::physics::contact::Sliding;
    use crate::solver::physics::lubricant::Heat;

    /// Returns the contact of Table 3.5 as a line or a point contact.
    fn key(kind: ContactKind) -> Key {
        let load = if kind == ContactKind::Line { 144e3 } else { 23.0 };
        let sliding = Sliding { slide_to_roll_ratio: -0.3, newtonian_plateau_ratio: None };
        let quantities = [12.7e-3, 0.74, load, 123.878213951e9, 0.0705, SQUALANE_PIP.own_coefficient().unwrap()];
        Key { point: OperatingPoint::from_quantities(kind, quantities, sliding), lubricant: SQUALANE_PIP }
    }

    #[test]
    fn trained_speeds_end_where_a_moes_number_does() {
        let model = embedded("line_shear").unwrap();
        for kind in [ContactKind::Line, ContactKind::Point] {
            let point = key(kind).point;
            let here = point.moes();
            // Range around the present contact. The speed leaves it by M at one end and by L at the other.
            let around = |m: (f64, f64)| {
                let mut domain = model.domain.clone();
                let ends = [(Quantity::M, m), (Quantity::L, (0.5 * here.l, 1.1 * here.l))];
                for (quantity, ends) in ends {
                    domain.space.axis_mut(quantity).unwrap().ends = ends;
                    domain.space.limits.retain(|(limited, _)| *limited != quantity);
                }
                domain
            };
            let domain = around((0.5 * here.m, 1.2 * here.m));
            let (from, to) = Varied::Speed.trained(&domain, &point).unwrap();
            let [slow, fast] = [from, to].map(|speed| Varied::Speed.at(&point, speed).moes());
            assert!((slow.m / domain.m().1 - 1.0).abs() < 1e-9, "{kind:?}: {slow:?}");
            assert!((fast.l / domain.l().1 - 1.0).abs() < 1e-9, "{kind:?}: {fast:?}");
            let elsewhere = around((1e3 * here.m, 2e3 * here.m));
            assert_eq!(Varied::Speed.trained(&elsewhere, &point), None);
        }
        let point = key(ContactKind::Line).point;
        assert_eq!(Varied::SlideToRoll.trained(&model.domain, &point), Some((0.0, 1.0)));
        assert_eq!(Varied::Plateau.trained(&model.domain, &point), Some((0.2, 1.0)));
        let (heated, fast) = (embedded("line_heat").unwrap(), OperatingPoint { speed_m_per_s: 10.0, ..point });
        assert_eq!(Varied::SlideToRoll.trained(&heated.domain, &fast), Some((0.0, 0.5)), "5 m/s of sliding");
    }

    #[test]
    fn half_of_the_contacts_lie_where_traction_rises() {
        let base = Key { lubricant: MINERAL_OIL, ..key(ContactKind::Line) };
        let sweep = Sweep { varied: Varied::SlideToRoll, base, ends: (0.0, 1.0), logarithmic: false };
        let Study::Sweep(study) = sweep.question("t", Grid::Graded, 41, Method::Full).study else { panic!() };
        let values = study.over[0].values.values();
        assert_eq!(values.iter().filter(|srr| **srr <= 0.05 + 1e-9).count(), 21);
        // An oil with a limiting stress has a Newtonian companion, whose traction is proportional to the sliding.
        let (companion, newtonian) = sweep.accompanied().unwrap();
        assert_eq!((companion, newtonian.base.lubricant.limiting_stress), (Companion::Newtonian, None));
        assert_eq!((newtonian.companion(), sweep.companions(41)), (None, 2));
        let sample = |srr: f64, traction| {
            let point = Varied::SlideToRoll.at(&base.point, srr);
            Sample { point, h_c_m: 1.0, h_min_m: 1.0, traction, companion: None, unphysical: None, mixed: None }
        };
        let mut samples = [sample(0.0, 0.0), sample(0.1, 0.05)];
        sweep.note_companions(&mut samples, &[sample(0.0, 0.0), sample(1.0, 8.0)]);
        assert_eq!(samples.map(|sample| sample.companion), [Some(0.0), Some(0.8)]);
        // A thermal contact has the same contact without heat as companion.
        let heat = Lubricant { heat: Some(Heat::default()), ..MINERAL_OIL };
        let sweep = Sweep { base: Key { lubricant: heat, ..base }, ..sweep };
        let (companion, cold) = sweep.accompanied().unwrap();
        assert_eq!((companion, cold.base.lubricant), (Companion::WithoutHeat, MINERAL_OIL));
        assert_eq!(sweep.companions(41), 41);
        let mut samples = [sample(0.0, 0.0), sample(0.1, 0.05)];
        sweep.note_companions(&mut samples, &[sample(0.0, 0.0), sample(0.1, 0.07)]);
        assert_eq!(samples.map(|sample| sample.companion), [Some(0.0), Some(0.07)]);
    }

    #[test]
    fn a_place_on_an_axis_leads_back_to_its_contact() {
        for kind in [ContactKind::Line, ContactKind::Point] {
            let key = key(kind);
            for against in Against::ALL.into_iter().filter(|against| against.is_of(kind)) {
                let moved = Key { point: against.varied().at(&key.point, 0.47), ..key };
                let value = against.value(&key.point, against.of(&moved));
                assert!((value / 0.47 - 1.0).abs() < 1e-12, "{against:?}: {value}");
            }
        }
        let key = key(ContactKind::Line);
        assert_eq!((Varied::SlideToRoll.of(&key), Varied::Plateau.of(&key)), (0.3, 0.2227));
    }
}
