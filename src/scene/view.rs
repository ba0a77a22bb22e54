//! Settings that the explorer stores with a scene, so that the scene opens as it was saved.

use super::kept_lubricant::KeptLubricant;
use super::measured_data::MeasuredTable;
use super::written::is_default;
use crate::solver::parameters::Quantity;
use crate::solver::physics::bodies::Bodies;
use crate::solver::physics::engineering::Oil;
use crate::solver::physics::machines::Machine;
use crate::solver::physics::surfaces::HeightMeasure;
use serde::{Deserialize, Serialize};

/// Explorer settings of a scene: which quantities follow when a slider moves, and how the reduced model is truncated.
/// They have no effect on `run`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, Default)]
#[serde(deny_unknown_fields, default)]
pub struct View {
    /// Quantity that follows when M moves.
    #[serde(skip_serializing_if = "is_default")]
    pub when_m_moves: LoadFollower,
    /// Quantity that follows when L moves; must be one of [`LoadFollower::partners`].
    #[serde(skip_serializing_if = "is_default")]
    pub when_l_moves: LubricantFollower,
    /// Quantity that stays constant when a line contact becomes a point contact, or the reverse.
    #[serde(skip_serializing_if = "is_default")]
    pub new_shape_keeps: ShapeKeeps,
    /// SI quantities that stay constant when M or L moves.
    #[serde(skip_serializing_if = "is_default")]
    pub held: Held,
    /// Oil from which η₀ and α were entered.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub oil: Option<Oil>,
    /// Bodies from which R, E′, u_m and SRR were entered.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bodies: Option<Bodies>,
    /// Rms roughness \[m\] of body 1 and body 2 for the film ratio, if no bodies were entered.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surfaces: Option<[f64; 2]>,
    /// Measure in which roughness is displayed and typed.
    #[serde(skip_serializing_if = "is_default")]
    pub height_measure: HeightMeasure,
    /// Bearing, gear pair or cam from which bodies and load were entered.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub machine: Option<Machine>,
    /// Measured film thicknesses and friction coefficients.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub measured: Vec<MeasuredTable>,
    /// Lubricants kept under a name, such as fitted ones.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub lubricants: Vec<KeptLubricant>,
    /// R_y \[m\] of the last elliptical contact, stored while a line or circular contact is selected.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_y_m: Option<f64>,
    /// Loss of information at which the pressure basis is truncated; `None` keeps all modes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pressure_loss: Option<f64>,
    /// Loss of information at which the deformation basis is truncated; `None` keeps all modes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub deformation_loss: Option<f64>,
    /// True to compute the deformation of the reduced model through V_δ, as in the dissertation, and not exactly.
    #[serde(skip_serializing_if = "is_default")]
    pub projected_deformation: bool,
}

/// Quantity that determines the load when a line contact becomes a point contact, or the reverse. The load itself has
/// another unit then.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
pub enum ShapeKeeps {
    /// M.
    #[default]
    LoadNumber,
    /// p_H.
    HertzPressure,
}

impl ShapeKeeps {
    /// All choices.
    pub const ALL: [Self; 2] = [Self::LoadNumber, Self::HertzPressure];

    /// Returns the name shown to users.
    pub fn name(self) -> &'static str {
        match self {
            Self::LoadNumber => "load number M",
            Self::HertzPressure => "Hertz pressure",
        }
    }
}

/// Set of SI quantities. In files, a list of their names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
#[serde(from = "Vec<Quantity>", into = "Vec<Quantity>")]
pub struct Held([bool; 7]);

impl Held {
    /// Quantities that can be held.
    const ALL: [Quantity; 7] = {
        let [radius, speed, load, modulus, viscosity, alpha] = Quantity::SI;
        [radius, speed, load, modulus, viscosity, alpha, Quantity::RadiusY]
    };

    /// Returns true if the set contains a quantity.
    pub fn contains(self, quantity: Quantity) -> bool {
        Self::ALL.iter().zip(self.0).any(|(si, held)| held && *si == quantity)
    }

    /// Adds or removes a quantity.
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

/// Quantity that follows when M moves.
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

/// Quantity that follows when L moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
pub enum LubricantFollower {
    /// α = 5/GPa · L^0.463 and speed: the default realisation, on which the embedded model is trained.
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

    /// Returns the name shown to users.
    pub fn name(self) -> &'static str {
        match self {
            Self::Load => "load w",
            Self::Radius => "radius R",
            Self::Speed => "speed u_m",
        }
    }

    /// Returns the choices for L that are consistent with this choice for M.
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
    /// Returns the name shown to users.
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
    use crate::solver::physics::contact::OperatingPoint;
    use crate::solver::physics::lubricant::Lubricant;
    use crate::solver::physics::machines::CamFollower;

    fn scene(view: View) -> Scene {
        Scene { view: Some(view), ..Scene::at_moes(40.0, 10.0) }
    }

    #[test]
    fn a_view_survives_writing_and_an_absent_one_stays_absent() {
        let view = View {
            when_m_moves: LoadFollower::Radius,
            when_l_moves: LubricantFollower::Speed,
            new_shape_keeps: ShapeKeeps::HertzPressure,
            held: vec![Quantity::Radius, Quantity::RadiusY].into(),
            oil: None,
            bodies: Some(Bodies::on_plane(0.01, 1.0, 0.1)),
            surfaces: Some([1e-7, 2e-7]),
            height_measure: HeightMeasure::Ra,
            machine: Some(Machine::Cam(CamFollower::default())),
            measured: vec![MeasuredTable { text: "speed,film [nm]\n1,60\n".to_owned() }],
            lubricants: vec![KeptLubricant::of("Oil A", &OperatingPoint::TABLE_2_1, &Lubricant::default())],
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
    fn unknown_fields_and_bad_values_are_refused() {
        let text = scene(View { pressure_loss: Some(0.25), ..View::default() }).to_ron().unwrap();
        let error = |text: String| Scene::from_ron(&text).unwrap_err().to_string();
        assert!(error(text.replace("pressure_loss", "presure_loss")).contains("presure_loss"));
        for bad in ["NaN", "inf", "-inf"] {
            assert!(error(text.replace("0.25", bad)).contains("view.pressure_loss"), "{bad}");
        }
        let message = |view: View| scene(view).check().unwrap_err().to_string();
        let base = View::default();
        assert!(message(View { pressure_loss: Some(f64::NAN), ..base.clone() }).contains("view.pressure_loss"));
        assert!(message(View { deformation_loss: Some(2.0), ..base.clone() }).contains("view.deformation_loss"));
        assert!(message(View { when_m_moves: LoadFollower::Speed, ..base }).contains("view.when_l_moves"));
    }
}
