//! The three frames of section 4.1, and the equations in each of them at one time.

use super::signal::Input;
use super::spline::Interpolation;
use crate::solver::full::{Problem, SolveError};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::surfaces::ScaledRoughness;
use serde::{Deserialize, Serialize};

/// Frame: motion of the computational domain with the contact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Frame {
    /// No motion: scales of the reference contact, (2.22), (2.23).
    #[default]
    Fixed,
    /// The nodes move with the dry contact: (4.9) with the growth of the scale of H, upwinded by the local flow
    /// direction.
    ArbitraryLagrangianEulerian,
    /// Every step has a new grid, to which the previous steps are interpolated: (4.10), (4.11).
    Remeshed(Interpolation),
}

/// Scales of the dry contact at one time, relative to those of the reference contact. All are 1 in the fixed frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scales {
    /// Hertzian half-width a/a_ref.
    pub half_width: f64,
    /// Hertzian pressure p_H/p_H,ref.
    pub pressure: f64,
    /// Scale of the film thickness H, (a²/R)/(a²/R)_ref, with the radius R.
    pub film: f64,
}

/// Equations at one time, without the time derivative.
#[derive(Clone, Copy, Debug)]
pub struct Conditions {
    /// Dimensionless time T.
    pub time: f64,
    /// Inputs at this time.
    pub input: Input,
    /// Scales of the frame.
    pub scales: Scales,
    /// Load, λ̄ and fluid in these scales.
    pub problem: Problem,
    /// 1/R̄ of (2.24), or 1 if the frame follows the contact.
    pub curvature: f64,
    /// Speed of the flow: U of (4.10), or ū in the fixed frame.
    pub speed: f64,
}

impl Frame {
    /// All frames; the first is the reference of comparisons.
    pub const ALL: [Self; 4] = [
        Self::Fixed,
        Self::ArbitraryLagrangianEulerian,
        Self::Remeshed(Interpolation::CubicSpline),
        Self::Remeshed(Interpolation::Linear),
    ];

    /// Returns the name used in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Fixed => "fixed",
            Self::ArbitraryLagrangianEulerian => "ale",
            Self::Remeshed(Interpolation::CubicSpline) => "remeshed",
            Self::Remeshed(Interpolation::Linear) => "remeshed_linear",
        }
    }

    /// Returns the frame's scales for the given inputs, (4.1).
    pub fn scales(self, input: Input) -> Scales {
        match self {
            Self::Fixed => Scales { half_width: 1.0, pressure: 1.0, film: 1.0 },
            Self::ArbitraryLagrangianEulerian | Self::Remeshed(_) => Scales {
                half_width: (input.load * input.radius).sqrt(),
                pressure: (input.load / input.radius).sqrt(),
                film: input.load,
            },
        }
    }

    /// Returns the equations at one time for a contact with the reference problem `reference`.
    ///
    /// # Errors
    /// [`SolveError`] if the inputs lead to a contact outside the accepted ranges.
    pub fn conditions(self, reference: &Problem, time: f64, input: Input) -> Result<Conditions, SolveError> {
        let scales = self.scales(input);
        let point = point_at(&reference.point, input);
        // All frames refuse the same contacts. A speed of zero for a moment is accepted.
        OperatingPoint { speed_m_per_s: reference.point.speed_m_per_s, ..point }.check()?;
        let (problem, curvature) = match self {
            Self::Fixed => (Problem { load: reference.load * input.load, ..*reference }, 1.0 / input.radius),
            Self::ArbitraryLagrangianEulerian | Self::Remeshed(_) => {
                let fluid = reference.lubricant.scaled(&point)?;
                // λ̄ = 12 η₀R²/(p_H a² t_ref) of (4.9), relative to that of (2.23).
                let growth = input.radius * input.radius / (scales.pressure * scales.half_width.powi(2));
                let inverse_lambda = reference.inverse_lambda / growth;
                let supply = reference.supply.map(|supply| supply / scales.film);
                let rough = ScaledRoughness::new(reference.lubricant.roughness, &point);
                (Problem { fluid, inverse_lambda, supply, rough, ..*reference }, 1.0)
            }
        };
        Ok(Conditions { time, input, scales, problem, curvature, speed: input.speed / scales.half_width })
    }
}

/// Returns the operating point at one time.
pub fn point_at(reference: &OperatingPoint, input: Input) -> OperatingPoint {
    OperatingPoint {
        radius_m: reference.radius_m * input.radius,
        speed_m_per_s: reference.speed_m_per_s * input.speed,
        load: reference.load * input.load,
        ..*reference
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::physics::lubricant::Lubricant;

    #[test]
    fn scales_are_those_of_the_dry_contact_of_the_moment() {
        let reference = Problem::new(&OperatingPoint::TABLE_2_1, Lubricant::default()).unwrap();
        let input = Input { radius: 1.3, speed: 0.8, load: 0.6 };
        let here = Frame::ArbitraryLagrangianEulerian.conditions(&reference, 0.0, input).unwrap();
        let (own, at_rest) = (point_at(&reference.point, input), reference.point);
        let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-13, "{a} against {b}");
        close(here.scales.half_width, own.hertz().half_width_m / at_rest.hertz().half_width_m);
        close(here.scales.pressure, own.hertz().pressure_pa / at_rest.hertz().pressure_pa);
        close(here.scales.film, own.film_scale_m() / at_rest.film_scale_m());
        // (4.10) divided by U is the steady equation with its λ̄.
        close(here.problem.inverse_lambda / here.speed, 1.0 / own.lambda_bar());
    }

    #[test]
    fn a_contact_outside_any_sense_is_refused_in_every_frame() {
        let reference = Problem::new(&OperatingPoint::TABLE_2_1, Lubricant::default()).unwrap();
        for frame in [Frame::Fixed, Frame::ArbitraryLagrangianEulerian] {
            for input in [Input { radius: 0.0, speed: 1.0, load: 1.0 }, Input { radius: 1.0, speed: 1.0, load: -1.0 }] {
                assert!(frame.conditions(&reference, 0.0, input).is_err());
            }
        }
    }
}
