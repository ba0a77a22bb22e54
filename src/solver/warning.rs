//! Warnings that accompany an answer. Each kind is defined once, with its values and its sentence.

use crate::solver::full::transient::Ended;
use crate::solver::parameters::Outside;
use crate::solver::physics::contact::PLAUSIBLE_HERTZ_PRESSURE_PA;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// Hertzian pressure \[Pa\] above which static load ratings are exceeded (ISO 76).
pub const STATIC_RATING_PRESSURE_PA: f64 = 4.6e9;
/// Value of α* p_H (reciprocal asymptotic isoviscous pressure coefficient times Hertzian pressure) above which an
/// isothermal traction without a limiting stress is unphysical: the shear stress exceeds what lubricants can carry.
pub const PLAUSIBLE_EXPONENT: f64 = 12.0;
/// Traction coefficient above which the result is unphysical: no measured lubricant has reached it, because
/// shear-thinning or the limiting stress bounds the traction.
pub const PLAUSIBLE_TRACTION: f64 = 0.15;
/// Temperature \[K\] above which lubricants decompose: 300 °C.
pub(in crate::solver) const ENDURED_K: f64 = 573.0;
/// Péclet number u_i a/(2κ_i) (surface speed u_i, half-width a, thermal diffusivity κ_i) below which heat flows
/// upstream within a body.
const SMALLEST_PECLET: f64 = 5.0;
/// p_H/E′ beyond which the theory of small strains in half-spaces is left: a/R is 4 p_H/E′ of a line contact and
/// π p_H/E′ of a circle, and errors of a few percent begin at a/R = 0.3.
const LARGEST_STRAIN: f64 = 0.08;
/// Estimated relative time-step error above which a warning is issued.
const NOTABLE_STEP_ERROR: f64 = 0.03;
/// Relative discretisation error above which the estimate is likely to be too small.
const SATURATED: f64 = 0.1;

/// Share of the rms height of a measured surface that a grid should resolve.
const RESOLVED_HEIGHT: f64 = 0.95;

/// Film ratio h_c/σ below which the fitted flow factors leave their range and their continuation decides.
const SMALLEST_FILM_RATIO: f64 = 0.5;

/// Warning that accompanies an answer. `Display` writes its sentence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, thiserror::Error)]
#[serde(rename_all = "snake_case")]
pub enum Warning {
    /// The full solver did not converge.
    #[error(
        "the full solver {ending} ({newton_iterations} Newton steps in {attempts} attempts, residual {residual_norm:.1e})"
    )]
    NotConverged {
        /// How the solve ended, worded as the end of a sentence.
        ending: String,
        /// Number of Newton steps.
        newton_iterations: usize,
        /// Number of attempts, each with another initial guess.
        attempts: usize,
        /// 2-norm of the scaled residual.
        residual_norm: f64,
    },
    /// The boundary of the cavitated region oscillated between two sets of nodes.
    #[error("the cavitation boundary oscillated between two sets of nodes and was then moved node by node")]
    CavitationBoundaryOscillated,
    /// The discretisation error of the central film thickness H_c exceeds a few per cent.
    #[error("{}", discretisation(*relative, ends.as_ref(), spacing.as_ref()))]
    DiscretisationError {
        /// Estimated relative error of H_c.
        relative: f64,
        /// Ends of the domain, if they are too near.
        ends: Option<NearEnds>,
        /// Spacing, if it is too coarse.
        spacing: Option<WideSpacing>,
    },
    /// The discretisation error of H_c cannot be estimated.
    #[error("the discretisation error of H_c cannot be estimated; compare with a finer grid")]
    DiscretisationErrorUnknown,
    /// The time-step error of H_c exceeds a few per cent or the requested tolerance.
    #[error("{}", time_step_error(*relative, *tolerance))]
    TimeStepError {
        /// Largest estimated relative error of H_c.
        relative: f64,
        /// Requested tolerance, relative to H_c.
        tolerance: Option<f64>,
    },
    /// A transient march stopped before the end of its duration.
    #[error("the march {}", ended.describe())]
    MarchStopped {
        /// Last dimensionless time T reached.
        reached: f64,
        /// How the march ended.
        ended: Ended,
    },
    /// The grid is not sufficient at some time of a transient march.
    #[error("at T = {time:.4} {warning}; the grid is not sufficient for this march")]
    DiscretisationErrorInTime {
        /// Dimensionless time T.
        time: f64,
        /// Warning of the steady contact at this time.
        warning: Box<Self>,
    },
    /// The load at an approach is not among the trained loads and follows a power law from the last of them.
    #[error("{}", extrapolated(*load, *last))]
    LoadExtrapolated {
        /// The load \[N/m\] or \[N\].
        load: f64,
        /// Last trained load.
        last: f64,
    },
    /// The inputs of a march change faster than its linearised model can follow.
    #[error("the inputs are too steep for linearised models; {advice}")]
    TooSteep {
        /// What to do instead.
        advice: String,
    },
    /// The spacing in Y is too coarse to resolve the side lobes.
    #[error(
        "H_min is not resolved: the side lobes are too narrow for the spacing of {spacing:.3} across them; H_c is not \
         affected; take {wanted:.3} or less, or the graded grid"
    )]
    SideLobesUnresolved {
        /// ΔY at the minimum film thickness H_min.
        spacing: f64,
        /// A spacing that is sufficient.
        wanted: f64,
    },
    /// The surfaces are so close that the results depend on how the flow factors are continued.
    #[error(
        "the film ratio h_c/σ is {film_ratio:.2}: below {SMALLEST_FILM_RATIO} the flow factors are extrapolated, and asperity \
         load share and film thickness depend on how"
    )]
    SmallFilmRatio {
        /// h_c/σ.
        film_ratio: f64,
    },
    /// Asperities touch at the ends of the domain.
    #[error(
        "asperities touch at the ends of the domain, with {pressure:.1e} of the Hertzian pressure; choose a wider domain"
    )]
    AsperitiesAtEnds {
        /// Largest asperity pressure there, in units of the Hertzian pressure.
        pressure: f64,
    },
    /// The grid does not resolve short waves of a measured surface.
    #[error(
        "the spacing of {spacing:.1e} a resolves {:.0} % of the rms height of the surface: shorter waves are averaged; take \
         a finer grid to include them",
        100.0 * share
    )]
    SurfaceUnresolved {
        /// Resolved share of the rms height.
        share: f64,
        /// Widest spacing in the contact, in units of a.
        spacing: f64,
    },
    /// Heat flows upstream within a slowly moving body.
    #[error(
        "the Péclet number of body {body} is {peclet:.2}: below {SMALLEST_PECLET} heat flows upstream within it, and its \
         surface is colder than the theory of moving sources says"
    )]
    SmallPeclet {
        /// Number of the body, 1 or 2.
        body: usize,
        /// Péclet number of the body.
        peclet: f64,
    },
    /// The film is hotter than lubricants endure.
    #[error("the film reaches {temperature_k:.0} K: oils decompose above {ENDURED_K} K, and no law was measured there")]
    TooHot {
        /// Highest temperature of the film \[K\].
        temperature_k: f64,
    },
    /// The energy balance is not met: heat is lost between the nodes.
    #[error(
        "{:.1} % of the generated heat is missing in the balance: the grid is too coarse for the temperatures of this film",
        100.0 * share
    )]
    HeatLost {
        /// Share of the generated heat that is lost.
        share: f64,
    },
    /// The contact, or the change of its inputs, is outside the trained range of the reduced model.
    #[error("{outside}")]
    OutsideTrainedRange {
        /// Quantity, its value and the trained interval.
        outside: Outside,
    },
    /// The reduced model was trained with the cavitation penalty, but another cavitation model is requested.
    #[error("the reduced model uses the cavitation penalty of its training, not {asked}; this moves H_c by about 1e-7")]
    CavitationOfTraining {
        /// Requested cavitation model.
        asked: String,
    },
    /// The local model of this contact found no solution, and a neighbouring one was used.
    #[error(
        "the local model of this contact found no solution; the neighbouring one replaced it, whose errors were not \
         measured here"
    )]
    NeighbouringModel,
    /// The reduced model found no solution.
    #[error("{reason}")]
    NoReducedSolution {
        /// Reason, as a sentence.
        reason: String,
    },
    /// The full solver computed the answer instead of the reduced model.
    #[error("the full solver took over")]
    FullSolverTookOver,
    /// The Hertzian pressure exceeds what bearing steel carries.
    #[error(
        "p_H = {:.3} GPa exceeds 3.2 GPa, where bearing steel yields below the surface{}",
        1e-9 * pressure_pa,
        if *pressure_pa > STATIC_RATING_PRESSURE_PA { ", and 4.6 GPa, where static load ratings end (ISO 76)" } else { "" }
    )]
    HertzPressure {
        /// Hertzian pressure p_H \[Pa\].
        pressure_pa: f64,
    },
    /// The bodies deform more than the theory of the half-space holds for.
    #[error(
        "p_H/E' is {ratio:.3}: beyond {LARGEST_STRAIN} the strains are no longer small, and the bodies no half-spaces"
    )]
    LargeStrain {
        /// p_H/E′.
        ratio: f64,
    },
    /// Any isothermal traction without a limiting stress is unphysical at this α* p_H.
    #[error(
        "α* p_H is {exponent:.1}: beyond {PLAUSIBLE_EXPONENT} an isothermal traction without a limiting shear stress is \
         unphysical"
    )]
    UnphysicalExponent {
        /// α* p_H.
        exponent: f64,
    },
    /// The traction coefficient is larger than any measured one.
    #[error(
        "a traction coefficient of {traction:.3} is unphysical: beyond {PLAUSIBLE_TRACTION} the lubricant is \
         shear-thinning or yields"
    )]
    UnphysicalTraction {
        /// Traction coefficient.
        traction: f64,
    },
    /// The shear stress is larger than lubricants carry.
    #[error(
        "the shear stress of {:.3} GPa under {:.3} GPa is above the limit: beyond {PLAUSIBLE_TRACTION} of the pressure a \
         lubricant yields, and this one has no limiting stress",
        1e-9 * stress_pa,
        1e-9 * pressure_pa
    )]
    ShearStressAboveLimit {
        /// Shear stress at mid-film where the pressure is largest \[Pa\].
        stress_pa: f64,
        /// Largest pressure \[Pa\].
        pressure_pa: f64,
    },
}

/// Ends of a domain that are too near.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct NearEnds {
    /// X of the inlet.
    pub x: f64,
    /// Y of the side; `None` for a line contact.
    pub y: Option<f64>,
    /// −X of an inlet that is sufficient; half of it for the side.
    pub wanted: f64,
}

/// Spacing that is too coarse.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WideSpacing {
    /// ΔX at X = −1.
    pub spacing: f64,
    /// A spacing that is sufficient.
    pub wanted: f64,
}

impl Warning {
    /// Returns a warning if the Hertzian pressure \[Pa\] exceeds what bearing steel carries.
    pub fn of_hertz_pressure(pressure_pa: f64) -> Option<Self> {
        (pressure_pa > PLAUSIBLE_HERTZ_PRESSURE_PA).then_some(Self::HertzPressure { pressure_pa })
    }

    /// The warning of strains that are no longer small, by the Hertzian pressure and E′ \[Pa\].
    pub fn of_strain(pressure_pa: f64, modulus_pa: f64) -> Option<Self> {
        let ratio = pressure_pa / modulus_pa;
        (ratio > LARGEST_STRAIN).then_some(Self::LargeStrain { ratio })
    }

    /// Returns a warning if the estimated relative time-step error of H_c exceeds three per cent or the requested
    /// tolerance.
    pub fn of_time_step(relative: f64, tolerance: Option<f64>) -> Option<Self> {
        let tolerance = tolerance.filter(|tolerance| relative > *tolerance);
        (relative > NOTABLE_STEP_ERROR || tolerance.is_some()).then_some(Self::TimeStepError { relative, tolerance })
    }

    /// Returns a warning if the film ratio h_c/σ is below the range of the flow factors.
    pub fn of_film_ratio(film_ratio: f64) -> Option<Self> {
        (film_ratio < SMALLEST_FILM_RATIO).then_some(Self::SmallFilmRatio { film_ratio })
    }

    /// Returns a warning if a grid with the given widest spacing resolves too small a share of the rms height of a
    /// measured surface.
    pub fn of_resolved_height(share: f64, spacing: f64) -> Option<Self> {
        (share < RESOLVED_HEIGHT).then_some(Self::SurfaceUnresolved { share, spacing })
    }

    /// Returns true for the two warnings about the discretisation error. Tables of many contacts summarise these in a
    /// separate sentence.
    pub fn is_of_grid(&self) -> bool {
        matches!(self, Self::DiscretisationError { .. } | Self::DiscretisationErrorUnknown)
    }

    /// Returns a warning if the Péclet number of a body (1 or 2) is so small that heat flows upstream within it.
    pub fn of_peclet((body, peclet): (usize, f64)) -> Option<Self> {
        (peclet < SMALLEST_PECLET).then_some(Self::SmallPeclet { body, peclet })
    }

    /// Returns kind, values and sentence as one JSON object: `{"kind": …, values…, "text": …}`.
    pub fn to_json(&self) -> Value {
        let mut object = Map::new();
        match serde_json::to_value(self) {
            Ok(Value::Object(tagged)) => {
                for (kind, values) in tagged {
                    object.insert("kind".to_owned(), kind.into());
                    if let Value::Object(values) = values {
                        object.extend(values.into_iter().filter(|(_, value)| !value.is_null()));
                    }
                }
            }
            Ok(kind) => drop(object.insert("kind".to_owned(), kind)),
            Err(_) => {}
        }
        object.insert("text".to_owned(), self.to_string().into());
        Value::Object(object)
    }

    /// Joins several warnings into one sentence.
    pub fn joined<'a>(warnings: impl IntoIterator<Item = &'a Self>) -> String {
        warnings.into_iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
    }

    /// Counts how many of the given answers carry each kind of warning. Keeps the last warning of each kind as an
    /// example.
    pub fn summary<'a>(answers: impl IntoIterator<Item = &'a [Self]>) -> Vec<Repeated> {
        let mut kinds: Vec<(usize, &Self)> = Vec::new();
        let mut all = 0;
        for warnings in answers {
            all += 1;
            for warning in warnings {
                let same = |(_, other): &&mut (usize, &Self)| {
                    std::mem::discriminant(*other) == std::mem::discriminant(warning)
                };
                match kinds.iter_mut().find(same) {
                    Some((count, last)) => (*count, *last) = (*count + 1, warning),
                    None => kinds.push((1, warning)),
                }
            }
        }
        kinds.into_iter().map(|(count, last)| Repeated { count, all, last: last.clone() }).collect()
    }
}

/// Kind of warning that several answers carry. `Display` writes its sentence.
#[derive(Clone, Debug, PartialEq, thiserror::Error, Serialize, Deserialize)]
#[error("{count} of {all} contacts, the last of them: {last}")]
pub struct Repeated {
    /// Number of answers that carry it.
    pub count: usize,
    /// Number of all answers.
    pub all: usize,
    /// Last warning of this kind.
    pub last: Warning,
}

/// Formats the sentence of a discretisation error, with a grid that is sufficient.
fn discretisation(relative: f64, ends: Option<&NearEnds>, spacing: Option<&WideSpacing>) -> String {
    let more = if relative > SATURATED { " or more" } else { "" };
    let ends = ends.map(|NearEnds { x, y, wanted }| match y {
        None => format!("the inlet at X = {x:.3} is too near, one at {:.0} would be sufficient", -wanted),
        Some(y) => format!(
            "the ends of the domain at X = {x:.3} and Y = {y:.3} are too near, {:.0} and {:.0} would be sufficient",
            -wanted,
            -0.5 * wanted
        ),
    });
    let spacing = spacing.map(|WideSpacing { spacing, wanted }| {
        format!("the spacing of {spacing:.2e} at X = -1 is too wide, {wanted:.1e} would be sufficient")
    });
    let parts: Vec<String> = ends.into_iter().chain(spacing).collect();
    let colon = if parts.is_empty() { "" } else { ": " };
    format!("H_c is off by about {:.0} %{more}{colon}{}", 100.0 * relative, parts.join("; "))
}

/// Formats the sentence of an extrapolated load.
fn extrapolated(load: f64, last: f64) -> String {
    let (side, law) = if load < last { ("below", "an open gap") } else { ("above", "a dry contact") };
    let [load, last] = [load, last].map(crate::solver::limits::digits);
    format!("the load {load} is {side} the trained {last}, from where it follows the power law of {law}")
}

/// Formats the sentence of a time-step error.
fn time_step_error(relative: f64, tolerance: Option<f64>) -> String {
    let percent = 100.0 * relative;
    match tolerance {
        None => format!(
            "the time-step error of H_c is about {percent:.2} %: take shorter steps, or let a tolerance control them"
        ),
        Some(tolerance) => format!(
            "the time-step error of H_c is about {percent:.2} %; the steps could not be made short enough for the \
             requested {} %",
            100.0 * tolerance
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn json_has_kind_values_and_sentence() {
        let heavy = Warning::of_hertz_pressure(15e9).unwrap();
        let text = heavy.to_string();
        assert!(text.contains("3.2 GPa") && text.contains("4.6 GPa") && text.contains("ISO 76"), "{text}");
        let wanted = serde_json::json!({"kind": "hertz_pressure", "pressure_pa": 15e9, "text": text});
        assert_eq!(heavy.to_json(), wanted);
        let yields = Warning::of_hertz_pressure(3.3e9).unwrap().to_string();
        assert!(yields.contains("yields") && !yields.contains("4.6"), "{yields}");
        assert_eq!(Warning::of_hertz_pressure(3.2e9), None);
        let took_over = Warning::FullSolverTookOver.to_json();
        assert_eq!((&took_over["kind"], took_over.as_object().unwrap().len()), (&"full_solver_took_over".into(), 2));
    }

    #[test]
    fn an_error_of_the_grid_names_what_would_do() {
        let ends = Some(NearEnds { x: -4.0, y: None, wanted: 9.0 });
        let spacing = Some(WideSpacing { spacing: 0.02, wanted: 0.005 });
        let both = Warning::DiscretisationError { relative: 0.2, ends, spacing };
        assert_eq!(
            both.to_string(),
            "H_c is off by about 20 % or more: the inlet at X = -4.000 is too near, one at -9 would be sufficient; the \
             spacing of 2.00e-2 at X = -1 is too wide, 5.0e-3 would be sufficient"
        );
        let one = Warning::DiscretisationError { relative: 0.04, ends: None, spacing };
        assert!(one.to_string().starts_with("H_c is off by about 4 %: the spacing"));
    }

    #[test]
    fn large_time_step_errors_are_warned_of() {
        assert_eq!(Warning::of_time_step(0.029, None), None);
        assert_eq!(Warning::of_time_step(0.009, Some(0.01)), None);
        let far = Warning::of_time_step(0.18, None).unwrap().to_string();
        assert!(far.starts_with("the time-step error of H_c is about 18.00 %: take shorter"), "{far}");
        let missed = Warning::of_time_step(0.02, Some(0.01)).unwrap().to_string();
        assert!(missed.contains("2.00 %") && missed.contains("the requested 1 %"), "{missed}");
    }

    #[test]
    fn a_summary_counts_each_kind() {
        let [a, b] = [3.3e9, 5e9].map(|pressure_pa| vec![Warning::HertzPressure { pressure_pa }]);
        let c = vec![Warning::FullSolverTookOver, Warning::HertzPressure { pressure_pa: 4e9 }];
        let summary: Vec<String> = Warning::summary([&a[..], &[], &b, &c]).iter().map(ToString::to_string).collect();
        assert!(summary[0].starts_with("3 of 4 contacts, the last of them: p_H = 4.000 GPa"), "{summary:?}");
        assert!(summary[1].starts_with("1 of 4") && summary.len() == 2);
    }
}
