//! What a report contains in addition to the answers: title and author, the bodies and the oil as the user stated them.

use super::rows::{measured, number};
use crate::scene::contact_spec::{ContactSpec, OilGrade};
use crate::scene::named_lubricant;
use crate::solver::physics::bodies::{Bodies, Body, Material};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::engineering::{Grade, Oil, QuantityKind as K, UnitSystem};
use crate::solver::physics::lubricant::Lubricant;

/// Texts and inputs that the answers do not contain.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stated {
    /// Title.
    pub title: String,
    /// Name of the author; may be empty.
    pub author: String,
    /// Company; may be empty.
    pub company: String,
    /// Oil by its grade and temperature, or by its name; may be empty.
    pub oil: String,
    /// Bodies 1 and 2 in one line each; may be empty.
    pub bodies: [String; 2],
    /// Poisson's ratio of body 1, if stated.
    pub poisson: Option<f64>,
    /// Both bodies, if all of their values are stated, for the film ratio.
    pub pair: Option<Bodies>,
    /// System of units.
    pub system: UnitSystem,
}

impl Stated {
    /// Returns Poisson's ratio of body 1; that of steel if it is not stated.
    pub fn poisson(&self) -> f64 {
        self.poisson.unwrap_or(Material::STEEL.poisson)
    }

    /// Returns the oil and the bodies of a contact by its fields.
    pub fn of_spec(title: impl Into<String>, spec: &ContactSpec, system: UnitSystem) -> Self {
        let shown = |kind, si| measured(kind, si, system);
        let grade = spec.oil.zip(spec.temperature).map(|(OilGrade(grade), temperature)| {
            format!("ISO VG {grade}, mineral, at {}", shown(K::Temperature, temperature))
        });
        let named = spec.lubricant.map(|named| named.title.to_owned());
        let [first, second] = [spec.radius1, spec.radius2];
        let stated = first.is_some() || second.is_some();
        let body = |radius: Option<f64>, modulus: Option<f64>, poisson: Option<f64>| {
            let radius = radius.map_or_else(
                || if stated { "plane".to_owned() } else { String::new() },
                |radius| format!("radius {}", shown(K::Length, radius)),
            );
            let modulus = modulus.map_or_else(String::new, |modulus| format!("E {}", shown(K::Pressure, modulus)));
            let poisson = poisson.map_or_else(String::new, |poisson| format!("ν {}", number(poisson)));
            joined([radius, modulus, poisson])
        };
        Self {
            title: title.into(),
            oil: grade.or(named).unwrap_or_default(),
            bodies: [body(first, spec.e1, spec.nu1), body(second, spec.e2, spec.nu2)],
            poisson: spec.nu1,
            system,
            ..Self::default()
        }
    }

    /// Returns the same with the bodies and the oil of a document.
    pub fn with(self, bodies: Option<Bodies>, oil: Option<Oil>) -> Self {
        Self {
            oil: oil.map_or(self.oil, |oil| oil_words(&oil, self.system)),
            bodies: bodies.map_or(self.bodies, |Bodies(pair)| pair.map(|body| body_words(&body, self.system))),
            poisson: bodies.map(|Bodies([first, _])| first.poisson),
            pair: bodies,
            ..self
        }
    }
}

impl Stated {
    /// Returns the same with the name of the lubricant, if no oil is stated and a named lubricant has these laws.
    pub fn with_lubricant(self, point: &OperatingPoint, lubricant: &Lubricant) -> Self {
        let named =
            || named_lubricant::of_laws(lubricant, point).map_or_else(String::new, |named| named.title.to_owned());
        Self { oil: if self.oil.is_empty() { named() } else { self.oil }, ..self }
    }
}

fn joined(parts: impl IntoIterator<Item = String>) -> String {
    parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(", ")
}

fn body_words(body: &Body, system: UnitSystem) -> String {
    let shown = |kind, si| measured(kind, si, system);
    let material = body.material().map_or_else(String::new, |material| material.name.to_lowercase());
    let radius = |radius: Option<f64>| radius.map_or("plane".to_owned(), |radius| shown(K::Length, radius));
    let along = body.radius_m.map_or("plane".to_owned(), |radius| format!("radius {}", shown(K::Length, radius)));
    let across = match body.transverse_radius_m() {
        across if across == body.radius_m => String::new(),
        across => format!("across {}", radius(across)),
    };
    let elastic = format!("E {}, ν {}", shown(K::Pressure, body.modulus_pa), number(body.poisson));
    joined([material, along, across, elastic, format!("Rq {}", shown(K::FilmThickness, body.roughness_m))])
}

fn oil_words(oil: &Oil, system: UnitSystem) -> String {
    let shown = |kind, si| measured(kind, si, system);
    let grade = match oil.grade {
        Grade::IsoVg(grade) => format!("ISO VG {grade}"),
        Grade::Two((first, at), (second, other)) => format!(
            "{} at {}, {} at {}",
            shown(K::KinematicViscosity, first),
            shown(K::Temperature, at),
            shown(K::KinematicViscosity, second),
            shown(K::Temperature, other)
        ),
    };
    format!("{grade}, {}, at {}", oil.family.name().to_lowercase(), shown(K::Temperature, oil.temperature_k))
}
