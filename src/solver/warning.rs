//! What a reader of an answer must know besides its numbers: each kind of warning once, with its values and its sentence.

use crate::solver::full::transient::Ended;
use crate::solver::parameters::Outside;
use crate::solver::physics::contact::PLAUSIBLE_HERTZ_PRESSURE_PA;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// Hertzian pressure \[Pa\] beyond which static load ratings are exceeded (ISO 76).
pub const STATIC_RATING_PRESSURE_PA: f64 = 4.6e9;
/// α* p_H beyond which an isothermal traction without a limiting stress is no physics: viscosity then outgrows every
/// stress a lubricant can carry.
pub const PLAUSIBLE_EXPONENT: f64 = 12.0;
/// A traction coefficient beyond which no lubricant was ever measured: it would have thinned under shear or yielded.
pub const PLAUSIBLE_TRACTION: f64 = 0.15;
/// Temperature \[K\] above which lubricants decompose: 300 °C.
pub(in crate::solver) const ENDURED_K: f64 = 573.0;
/// Péclet number u_i a/(2κ_i) below which heat flows upstream within a body.
const SMALLEST_PECLET: f64 = 5.0;
/// p_H/E′ beyond which the theory of small strains in half-spaces is left: a/R is 4 p_H/E′ of a line contact and
/// π p_H/E′ of a circle, and errors of a few percent begin at a/R = 0.3.
const LARGEST_STRAIN: f64 = 0.08;
/// Estimated errors of the steps in time beyond this are warned of.
const NOTABLE_STEP_ERROR: f64 = 0.03;
/// Estimated discretisation errors beyond this are likely to be too small.
const SATURATED: f64 = 0.1;

/// What a reader of an answer must know. Its sentence is what it displays.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, thiserror::Error)]
#[serde(rename_all = "snake_case")]
pub enum Warning {
    /// The full solver did not converge.
    #[error(
        "the full solver {ending} ({newton_iterations} Newton steps in {attempts} attempts, residual {residual_norm:.1e})"
    )]
    NotConverged {
        /// How it ended, as the end of a sentence.
        ending: String,
        /// Newton steps.
        newton_iterations: usize,
        /// Starts that were tried.
        attempts: usize,
        /// 2-norm of the scaled residual.
        residual_norm: f64,
    },
    /// The boundary of the cavitated region cycled between two sets of nodes.
    #[error("the cavitation boundary oscillated between two sets of nodes and was then moved node by node")]
    CavitationBoundaryOscillated,
    /// The grid moves H_c by more than a few percent.
    #[error("{}", discretisation(*relative, ends.as_ref(), spacing.as_ref()))]
    DiscretisationError {
        /// Estimated relative error of H_c.
        relative: f64,
        /// The ends of the domain, where they are too near.
        ends: Option<NearEnds>,
        /// The spacing, where it is too wide.
        spacing: Option<WideSpacing>,
    },
    /// The discretisation error of H_c cannot be estimated.
    #[error("the discretisation error of H_c cannot be estimated; compare with a finer grid")]
    DiscretisationErrorUnknown,
    /// The lengths of the steps in time move H_c by more than a few percent, or by more than was asked for.
    #[error("{}", time_step_error(*relative, *tolerance))]
    TimeStepError {
        /// Estimated greatest relative error of H_c.
        relative: f64,
        /// The share of H_c that the steps were to be controlled by.
        tolerance: Option<f64>,
    },
    /// A march in time did not reach the end of its duration.
    #[error("the march {}", ended.describe())]
    MarchStopped {
        /// The last T reached.
        reached: f64,
        /// How it ended.
        ended: Ended,
    },
    /// The grid does not do for some moment of a march in time.
    #[error("at T = {time:.4} {warning}; the grid does not do for this march")]
    DiscretisationErrorInTime {
        /// T of the moment.
        time: f64,
        /// The warning of the steady contact of that moment.
        warning: Box<Self>,
    },
    /// The inputs of a march change faster than its linearised model can follow.
    #[error("the inputs are too steep for linearised models; {advice}")]
    TooSteep {
        /// What to do instead.
        advice: String,
    },
    /// The grid is too wide across to resolve the side lobes.
    #[error(
        "H_min is not resolved: the side lobes are too narrow for the spacing of {spacing:.3} across them; H_c is not \
         affected; take {wanted:.3} or less, or the graded grid"
    )]
    SideLobesUnresolved {
        /// ΔY at H_min.
        spacing: f64,
        /// One that would do.
        wanted: f64,
    },
    /// Heat flows upstream within a body that moves slowly.
    #[error(
        "the Péclet number of body {body} is {peclet:.2}: below {SMALLEST_PECLET} heat flows upstream within it, and its \
         surface is colder than the theory of moving sources says"
    )]
    SmallPeclet {
        /// 1 or 2.
        body: usize,
        /// Its Péclet number.
        peclet: f64,
    },
    /// The film is hotter than lubricants endure.
    #[error("the film reaches {temperature_k:.0} K: oils decompose above {ENDURED_K} K, and no law was measured there")]
    TooHot {
        /// Its highest temperature \[K\].
        temperature_k: f64,
    },
    /// Heat is lost between the nodes.
    #[error(
        "{:.1} % of the heat that is made goes nowhere: the grid is too coarse for this film's temperatures",
        100.0 * share
    )]
    HeatLost {
        /// Share of the heat that is made.
        share: f64,
    },
    /// The reduced model was not trained for the contact, or for how its inputs change.
    #[error("{outside}")]
    OutsideTrainedRange {
        /// The quantity, its value and the trained interval.
        outside: Outside,
    },
    /// The reduced model was trained with the cavitation penalty, and another law is asked for.
    #[error("the reduced model uses the cavitation penalty of its training, not {asked}; this moves H_c by about 1e-7")]
    CavitationOfTraining {
        /// The law that is asked for.
        asked: String,
    },
    /// The contact's own local model found no solution; its neighbour answers.
    #[error(
        "the local model that this contact belongs to found no solution; its neighbour answers, whose errors were not \
         measured here"
    )]
    NeighbouringModel,
    /// The reduced model has no solution.
    #[error("{reason}")]
    NoReducedSolution {
        /// Why, a sentence.
        reason: String,
    },
    /// The full solver answers in place of the reduced model.
    #[error("the full solver took over")]
    FullSolverTookOver,
    /// The Hertzian pressure exceeds what bearing steel carries.
    #[error(
        "p_H = {:.3} GPa exceeds 3.2 GPa, where bearing steel yields below the surface{}",
        1e-9 * pressure_pa,
        if *pressure_pa > STATIC_RATING_PRESSURE_PA { ", and 4.6 GPa, where static load ratings end (ISO 76)" } else { "" }
    )]
    HertzPressure {
        /// p_H \[Pa\].
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
    /// Every isothermal traction without a limiting stress is unphysical at this α* p_H.
    #[error(
        "α* p_H is {exponent:.1}: beyond {PLAUSIBLE_EXPONENT} an isothermal traction without a limiting shear stress is \
         unphysical"
    )]
    UnphysicalExponent {
        /// α* p_H.
        exponent: f64,
    },
    /// The traction coefficient is larger than any that was measured.
    #[error(
        "a traction coefficient of {traction:.3} is unphysical: beyond {PLAUSIBLE_TRACTION} the lubricant thins under \
         shear or yields"
    )]
    UnphysicalTraction {
        /// Traction coefficient.
        traction: f64,
    },
    /// The shear stress is larger than any that lubricants carry.
    #[error(
        "the shear stress of {:.3} GPa under {:.3} GPa is above the limit: beyond {PLAUSIBLE_TRACTION} of the pressure a \
         lubricant yields, and this one has no limiting stress",
        1e-9 * stress_pa,
        1e-9 * pressure_pa
    )]
    ShearStressAboveLimit {
        /// At mid-film, where the pressure is largest \[Pa\].
        stress_pa: f64,
        /// That pressure \[Pa\].
        pressure_pa: f64,
    },
}

/// Ends of a domain that are too near.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct NearEnds {
    /// Inlet, X.
    pub x: f64,
    /// Side, Y; `None` for a line contact.
    pub y: Option<f64>,
    /// −X of an inlet that would do; half of it for the side.
    pub wanted: f64,
}

/// A spacing that is too wide.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WideSpacing {
    /// ΔX at X = −1.
    pub spacing: f64,
    /// One that would do.
    pub wanted: f64,
}

impl Warning {
    /// The warning of a Hertzian pressure \[Pa\], if it exceeds what bearing steel carries.
    pub fn of_hertz_pressure(pressure_pa: f64) -> Option<Self> {
        (pressure_pa > PLAUSIBLE_HERTZ_PRESSURE_PA).then_some(Self::HertzPressure { pressure_pa })
    }

    /// The warning of strains that are no longer small, by the Hertzian pressure and E′ \[Pa\].
    pub fn of_strain(pressure_pa: f64, modulus_pa: f64) -> Option<Self> {
        let ratio = pressure_pa / modulus_pa;
        (ratio > LARGEST_STRAIN).then_some(Self::LargeStrain { ratio })
    }

    /// The warning of the estimated error that steps in time leave in H_c, if it is more than three percent, or more
    /// than the tolerance that was to control them.
    pub fn of_time_step(relative: f64, tolerance: Option<f64>) -> Option<Self> {
        let tolerance = tolerance.filter(|tolerance| relative > *tolerance);
        (relative > NOTABLE_STEP_ERROR || tolerance.is_some()).then_some(Self::TimeStepError { relative, tolerance })
    }

    /// Whether it is of the discretisation error, of which tables of many contacts make a sentence of their own.
    pub fn is_of_grid(&self) -> bool {
        matches!(self, Self::DiscretisationError { .. } | Self::DiscretisationErrorUnknown)
    }

    /// The warning about the Péclet number of a body, 1 or 2, if heat flows upstream within it.
    pub fn of_peclet((body, peclet): (usize, f64)) -> Option<Self> {
        (peclet < SMALLEST_PECLET).then_some(Self::SmallPeclet { body, peclet })
    }

    /// Its kind, values and sentence as one JSON object: `{"kind": …, values…, "text": …}`.
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

    /// Several of them as one sentence.
    pub fn joined<'a>(warnings: impl IntoIterator<Item = &'a Self>) -> String {
        warnings.into_iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
    }

    /// Returns how many of some answers carry each kind, with the last warning of the kind as an example.
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

/// A kind of warning that several answers carry. Its sentence is what it displays.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{count} of {all} contacts, the last of them: {last}")]
pub struct Repeated {
    /// How many carry it.
    pub count: usize,
    /// Of how many.
    pub all: usize,
    /// The last of them.
    pub last: Warning,
}

/// The sentence of a discretisation error, with a grid that would do.
fn discretisation(relative: f64, ends: Option<&NearEnds>, spacing: Option<&WideSpacing>) -> String {
    let more = if relative > SATURATED { " or more" } else { "" };
    let ends = ends.map(|NearEnds { x, y, wanted }| match y {
        None => format!("the inlet at X = {x:.3} is too near, one at {:.0} would do", -wanted),
        Some(y) => format!(
            "the ends of the domain at X = {x:.3} and Y = {y:.3} are too near, {:.0} and {:.0} would do",
            -wanted,
            -0.5 * wanted
        ),
    });
    let spacing = spacing.map(|WideSpacing { spacing, wanted }| {
        format!("the spacing of {spacing:.2e} at X = -1 is too wide, {wanted:.1e} would do")
    });
    let parts: Vec<String> = ends.into_iter().chain(spacing).collect();
    let colon = if parts.is_empty() { "" } else { ": " };
    format!("H_c is off by about {:.0} %{more}{colon}{}", 100.0 * relative, parts.join("; "))
}

/// The sentence of an error of the steps in time.
fn time_step_error(relative: f64, tolerance: Option<f64>) -> String {
    let percent = 100.0 * relative;
    match tolerance {
        None => format!(
            "the time steps leave H_c off by about {percent:.2} %: take shorter ones, or let a tolerance control them"
        ),
        Some(tolerance) => format!(
            "the time steps leave H_c off by about {percent:.2} %, and could not be made short enough for the {} % asked \
             for",
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
            "H_c is off by about 20 % or more: the inlet at X = -4.000 is too near, one at -9 would do; the spacing of \
             2.00e-2 at X = -1 is too wide, 5.0e-3 would do"
        );
        let one = Warning::DiscretisationError { relative: 0.04, ends: None, spacing };
        assert!(one.to_string().starts_with("H_c is off by about 4 %: the spacing"));
    }

    #[test]
    fn an_error_of_the_time_step_is_warned_of_beyond_three_percent_or_the_tolerance() {
        assert_eq!(Warning::of_time_step(0.029, None), None);
        assert_eq!(Warning::of_time_step(0.009, Some(0.01)), None);
        let far = Warning::of_time_step(0.18, None).unwrap().to_string();
        assert!(far.starts_with("the time steps leave H_c off by about 18.00 %: take shorter"), "{far}");
        let missed = Warning::of_time_step(0.02, Some(0.01)).unwrap().to_string();
        assert!(missed.contains("2.00 %") && missed.contains("the 1 % asked for"), "{missed}");
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
