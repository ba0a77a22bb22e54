//! What the explorer keeps with a scene so that nothing is lost when it is saved and opened again.

use super::written::is_default;
use crate::solver::parameters::Quantity;
use crate::solver::physics::bodies::Bodies;
use crate::solver::physics::engineering::Oil;
use serde::{Deserialize, Serialize};

/// How the explorer edits a scene: what follows when a slider moves, and how the reduced model is truncated. Running a
/// scene without a screen does not use it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Default)]
#[serde(deny_unknown_fields, default)]
pub struct View {
    /// What follows when M moves.
    #[serde(skip_serializing_if = "is_default")]
    pub when_m_moves: LoadFollower,
    /// What follows when L moves; must be one of [`LoadFollower::partners`].
    #[serde(skip_serializing_if = "is_default")]
    pub when_l_moves: LubricantFollower,
    /// Quantities in SI units that stay when M or L moves.
    #[serde(skip_serializing_if = "is_default")]
    pub held: Held,
    /// The oil that η₀ and α were entered as.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub oil: Option<Oil>,
    /// The bodies that R, E′, u_m and SRR were entered as.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bodies: Option<Bodies>,
    /// R_y \[m\] of the ellipse that a roller or a ball was chosen instead of.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_y_m: Option<f64>,
    /// Loss of information the pressure basis may neglect; `None` keeps every mode.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pressure_loss: Option<f64>,
    /// Loss of information the deformation basis may neglect; `None` keeps every mode.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub deformation_loss: Option<f64>,
    /// Deformation of the reduced model through V_δ (the dissertation's) instead of exactly.
    #[serde(skip_serializing_if = "is_default")]
    pub projected_deformation: bool,
}

/// A set of quantities in SI units, in files a list of their names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
#[serde(from = "Vec<Quantity>", into = "Vec<Quantity>")]
pub struct Held([bool; 7]);

impl Held {
    /// What can be held.
    const ALL: [Quantity; 7] = {
        let [radius, speed, load, modulus, viscosity, alpha] = Quantity::SI;
        [radius, speed, load, modulus, viscosity, alpha, Quantity::RadiusY]
    };

    /// Whether a quantity is in it.
    pub fn contains(self, quantity: Quantity) -> bool {
        Self::ALL.iter().zip(self.0).any(|(si, held)| held && *si == quantity)
    }

    /// Takes a quantity in, or out.
    pub fn set(&mut self, quantity: Quantity, held: bool) {
        for (si, place) in Self::ALL.iter().zip(&mut self.0) {
            if *si == quantity {
                *place = held;
            }
        }
    }
}

impl From<Vec<Quantity>> for Held {
    fn from(quantities: Vec<Quantity>) -> Self {
        let mut held = Self::default();
        quantities.into_iter().for_each(|quantity| held.set(quantity, true));
        held
    }
}

impl From<Held> for Vec<Quantity> {
    fn from(held: Held) -> Self {
        Held::ALL.into_iter().filter(|quantity| held.contains(*quantity)).collect()
    }
}

/// The quantity that follows when M moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
pub enum LoadFollower {
    /// Load w.
    #[default]
    Load,
    /// Radius R.
    Radius,
    /// Speed u_m (α then follows L).
    Speed,
}

/// The quantity that follows when L moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
pub enum LubricantFollower {
    /// α = 5/GPa · L^0.463 and the speed: the default realisation, along which the embedded model is trained.
    #[default]
    Realisation,
    /// Speed u_m at constant α.
    Speed,
    /// α at constant speed.
    Alpha,
    /// Radius R at constant speed and α.
    Radius,
}

impl LoadFollower {
    /// All choices.
    pub const ALL: [Self; 3] = [Self::Load, Self::Radius, Self::Speed];

    /// For people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Load => "load w",
            Self::Radius => "radius R",
            Self::Speed => "speed u_m",
        }
    }

    /// The choices for L that leave exactly M and L to follow.
    pub fn partners(self) -> &'static [LubricantFollower] {
        match self {
            Self::Load => &[
                LubricantFollower::Realisation,
                LubricantFollower::Speed,
                LubricantFollower::Alpha,
                LubricantFollower::Radius,
            ],
            Self::Radius => &[LubricantFollower::Realisation, LubricantFollower::Speed, LubricantFollower::Alpha],
            Self::Speed => &[LubricantFollower::Alpha],
        }
    }
}

impl LubricantFollower {
    /// For people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Realisation => "α and speed together",
            Self::Speed => "speed u_m",
            Self::Alpha => "coefficient α",
            Self::Radius => "radius R",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Scene;
    use super::*;

    fn scene(view: View) -> Scene {
        Scene { view: Some(view), ..Scene::at_moes(40.0, 10.0) }
    }

    #[test]
    fn a_view_survives_writing_and_an_absent_one_stays_absent() {
        let view = View {
            when_m_moves: LoadFollower::Radius,
            when_l_moves: LubricantFollower::Speed,
            held: vec![Quantity::Radius, Quantity::RadiusY].into(),
            oil: None,
            bodies: Some(Bodies::on_plane(0.01, 1.0, 0.1)),
            radius_y_m: Some(0.02),
            pressure_loss: Some(1.25e-7),
            deformation_loss: Some(3e-9),
            projected_deformation: true,
        };
        for scene in [scene(view), scene(View::default()), Scene::at_moes(40.0, 10.0)] {
            let text = scene.to_ron().unwrap();
            assert_eq!(Scene::from_ron(&text).unwrap(), scene, "{text}");
            assert_eq!(text.contains("view"), scene.view.is_some(), "{text}");
        }
        let short = Scene::at_moes(40.0, 10.0)
            .to_ron()
            .unwrap()
            .replace("    study:", "    view: (pressure_loss: 1e-6),\n    study:");
        let wanted = View { pressure_loss: Some(1e-6), ..View::default() };
        assert_eq!(Scene::from_ron(&short).unwrap().view, Some(wanted));
    }

    #[test]
    fn unknown_fields_and_values_outside_any_sense_are_refused_by_name() {
        let text = scene(View { pressure_loss: Some(0.25), ..View::default() }).to_ron().unwrap();
        let error = |text: String| Scene::from_ron(&text).unwrap_err().to_string();
        assert!(error(text.replace("pressure_loss", "presure_loss")).contains("presure_loss"));
        for bad in ["NaN", "inf", "-inf"] {
            assert!(error(text.replace("0.25", bad)).contains("view.pressure_loss"), "{bad}");
        }
        let message = |view: View| scene(view).check().unwrap_err().to_string();
        let base = View::default();
        assert!(message(View { pressure_loss: Some(f64::NAN), ..base }).contains("view.pressure_loss"));
        assert!(message(View { deformation_loss: Some(2.0), ..base }).contains("view.deformation_loss"));
        assert!(message(View { when_m_moves: LoadFollower::Speed, ..base }).contains("view.when_l_moves"));
    }
}
