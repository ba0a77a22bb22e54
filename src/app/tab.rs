//! The names of the tabs.

use serde::{Deserialize, Serialize};

/// A tab.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Tab {
    /// Pressure and film.
    Profiles,
    /// Film, pressure and interferogram of a point contact.
    ContactMap,
    /// The M–L chart.
    Regimes,
    /// Friction along one quantity.
    Traction,
    /// Singular values, modes, sampled rows.
    Basis,
    /// Residuals and errors.
    Accuracy,
    /// Making a reduced model.
    Training,
    /// The contact in time.
    Transient,
    /// The linearised model of it.
    Tpwl,
    /// The answer to the scene’s question.
    Results,
}

impl Tab {
    /// All tabs in their order.
    pub const ALL: [Self; 10] = [
        Self::Profiles,
        Self::ContactMap,
        Self::Regimes,
        Self::Traction,
        Self::Basis,
        Self::Accuracy,
        Self::Training,
        Self::Transient,
        Self::Tpwl,
        Self::Results,
    ];

    /// Title.
    pub fn title(self) -> &'static str {
        match self {
            Self::Profiles => "Profiles",
            Self::ContactMap => "Contact map",
            Self::Regimes => "Regimes",
            Self::Traction => "Traction",
            Self::Basis => "Reduced basis",
            Self::Accuracy => "Accuracy",
            Self::Training => "Training",
            Self::Transient => "Transient",
            Self::Tpwl => "TPWL",
            Self::Results => "Results",
        }
    }

    /// The page of the manual that is about it.
    pub fn page(self) -> &'static str {
        match self {
            Self::Profiles | Self::ContactMap => "tour.md",
            Self::Regimes | Self::Traction => "physics.md",
            Self::Basis | Self::Training => "training.md",
            Self::Accuracy => "trust.md",
            Self::Transient | Self::Tpwl => "transient.md",
            Self::Results => "scenes.md",
        }
    }

    /// Whether it has axes that can be read in ratios and in SI units; those of the others show numbers of the contact,
    /// relative errors, or what is in SI units always.
    pub fn has_units(self) -> bool {
        matches!(self, Self::Profiles | Self::ContactMap | Self::Basis | Self::Transient | Self::Tpwl)
    }

    /// What is seen in it and why it is so, in three sentences.
    pub fn why(self) -> &'static str {
        match self {
            Self::Profiles => {
                "Oil that the surfaces drag into the narrowing gap builds up so much pressure that the bodies flatten: nearly everywhere the \
                 pressure is that of the dry contact, dashed, and the film between is nearly flat. Near the outlet the film must narrow so that \
                 no more oil leaves than enters, and in front of that the pressure rises to a spike. The film is made in the inlet: more speed or \
                 viscosity thickens it, while load hardly matters."
            }
            Self::ContactMap => {
                "Seen from above the film has a flat middle and a horseshoe of thin film around its sides and its outlet, where pressure drives oil \
                 out. The thinnest places are the two side lobes: there surfaces touch first. The interferogram shows the same film as a rig with \
                 a glass disc photographs it, each colour one thickness."
            }
            Self::Regimes => {
                "Load, speed, size and stiffness act on a film only by two numbers: how heavily it is loaded, M, and how strongly its viscosity \
                 rises with pressure, L. Where bodies stay rigid or the oil stays thin other laws rule, and the colours say which one does. Every \
                 published formula fits a part of this chart, so look where you stand before you use one."
            }
            Self::Traction => {
                "Surfaces that slide shear the film, and its shear stress, summed up over the contact, is the traction. Pressure makes the oil so \
                 stiff that it would soon carry more than any lubricant can: it bends at its Eyring stress and slips at its limiting one, and the \
                 curve levels off. Where neither is known the result is Newtonian, and under high pressure it is no physics."
            }
            Self::Basis => {
                "Pressures of all contacts of a range look alike: a few dozen shapes, the modes, add up to every one of them. How fast the singular \
                 values fall says how many are needed for an error that you choose. The equations are then solved at a few places only, the \
                 sampled rows, which crowd where little is decided elsewhere: at the inlet and at the spike."
            }
            Self::Accuracy => {
                "A reduced model errs because its modes are too few, because its equations are met at some places only, and because its grid is \
                 coarse: each share can be measured. A full solution on the same grid gives the true error, and a calibrated bound predicts it \
                 without one. Random tests over the whole range show where it fails, and how often."
            }
            Self::Training => {
                "A reduced model is learnt from full solutions, its snapshots, of contacts all over a range. A plan that always adds the contact that \
                 is represented worst needs fewest of them. Outside its range a model knows nothing, so choose the range for what you are going \
                 to ask."
            }
            Self::Transient => {
                "When load, speed or curvature change quickly, oil that entered long before is still inside: the film remembers. What the inlet made \
                 travels through the contact at the mean speed of the surfaces, and arrives at the outlet later. So film and load are out of step, \
                 the more the faster they change."
            }
            Self::Tpwl => {
                "Near a state that has been seen, the contact answers a small change of load nearly in proportion: its equations can be \
    replaced by their tangents there, d/dT Σ w_i (A_i + B_i y + C_i u) = Σ w_i (D_i + E_i y + F_i u), (4.27), so that a step is one small \
    linear system. The tangents are taken at operating points along a trained trajectory, and the weights w follow the state: drag the \
    time and watch them pass from point to point. Tangents on one side of a curved path err to one side; the dual Taylor form expands \
    half about the points and half about their barycentre, which cancels that, while far from every point, under inputs steeper than the \
    trained ones, no weights help and the reduced model is the right choice."
            }
            Self::Results => {
                "A scene is an experiment with a question, and here its answer comes in while it is computed. What the scene expects, and from \
                 where, stands beside what was found. The same scene gives the same numbers from the command line."
            }
        }
    }

    /// Words for what it shows.
    pub fn subjects(self) -> &'static str {
        match self {
            Self::Profiles => "pressure film spike shear",
            Self::ContactMap => "interferogram fringes contours horseshoe side lobes",
            Self::Regimes => "chart film formulas Moes asymptotes",
            Self::Traction => "friction Stribeck slide-to-roll fluid viscosity",
            Self::Basis => "singular values modes truncation sampled rows",
            Self::Accuracy => "error failure map residuals bound",
            Self::Training => "snapshots model plan range",
            Self::Transient => "time load speed radius frames",
            Self::Tpwl => "linearised operating points weights",
            Self::Results => "study scene run expectations verdicts table",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_tab_says_why_in_three_sentences() {
        for tab in Tab::ALL {
            let why = tab.why();
            assert!(why.ends_with('.') && why.matches(". ").count() == 2, "{tab:?}");
        }
    }
}
