//! Derivatives of the outputs of a steady contact by its inputs and parameters.
//!
//! The outputs of two contacts on both sides of the present one follow from the linearised sampled equations: one linear
//! solve per input, with the Jacobian of the present solution, whose right-hand side is a difference of residuals. The
//! derivative is the central difference of these outputs.
//!
//! Thermal models, models by residual minimisation and changes of the radius ratio have no such equations. Their
//! derivatives are fourth-order differences of four converged solutions.
//!
//! In both cases the cavitation boundary stays where it is. Its motion between nodes changes outputs in small jumps.

use super::approach::{Beyond, End};
use super::{Coupled, CoupledError, Inputs, Outputs, Pressed};
use crate::engine::answer::answer_of;
use crate::scene::Request;
use crate::solver::full::Problem;
use crate::solver::reduced::ReducedSolution;

/// Selects an input or a parameter.
pub type Input = fn(&mut Inputs) -> &mut f64;

/// Relative change of an input for linearised equations. The error of the central difference is proportional to its
/// square, the effect of rounding to its inverse.
const NEAR: f64 = 2e-5;
/// Relative change of an input for converged solutions.
const FAR: f64 = 1e-3;
/// Change of an input of zero. Tractions are linear in the slide-to-roll ratio only for very small ratios.
const FROM_ZERO: f64 = 1e-9;

/// Method of a derivative.
#[derive(Clone, Copy, PartialEq)]
enum Means {
    /// Linearised equations.
    Linearised,
    /// Converged solutions.
    Solved,
}

impl Means {
    /// Returns the relative changes of the input, and the weights of the outputs.
    fn places(self) -> &'static [(f64, f64)] {
        match self {
            Self::Linearised => &[(-NEAR, -0.5 / NEAR), (NEAR, 0.5 / NEAR)],
            Self::Solved => &[
                (-2.0 * FAR, 1.0 / (12.0 * FAR)),
                (-FAR, -8.0 / (12.0 * FAR)),
                (FAR, 8.0 / (12.0 * FAR)),
                (2.0 * FAR, -1.0 / (12.0 * FAR)),
            ],
        }
    }

    /// Returns the inputs at all places. `size` is the size of the input.
    fn moved(self, inputs: &Inputs, by: Input, size: f64) -> Vec<Inputs> {
        let moved = |(place, _): &(f64, f64)| {
            let mut moved = *inputs;
            *by(&mut moved) += place * size;
            moved
        };
        self.places().iter().map(moved).collect()
    }

    /// Returns the size of an input.
    fn size(self, inputs: &Inputs, by: Input) -> f64 {
        let value = by(&mut inputs.clone()).abs();
        let step = self.places().iter().map(|(place, _)| place.abs()).fold(0.0, f64::max);
        if value > 0.0 { value } else { FROM_ZERO / step }
    }

    /// Returns the derivative for outputs at all places.
    fn of(self, outputs: Vec<Outputs>, size: f64) -> Derivative {
        let weights = self.places().iter().map(|(_, weight)| weight / size);
        Derivative { parts: weights.zip(outputs).collect(), linearised: self == Self::Linearised }
    }
}

/// Derivative of all outputs by one input.
#[derive(Clone, Debug)]
pub struct Derivative {
    /// Outputs of contacts next to the present one, with their weights.
    parts: Vec<(f64, Outputs)>,
    /// True if it follows from the linearised equations.
    pub linearised: bool,
}

impl Derivative {
    /// Returns the derivative of one output. NaN if the output is NaN.
    pub fn of(&self, output: impl Fn(&Outputs) -> f64) -> f64 {
        self.parts.iter().map(|(weight, outputs)| weight * output(outputs)).sum()
    }

    fn times(mut self, factor: f64) -> Self {
        self.parts.iter_mut().for_each(|(weight, _)| *weight *= factor);
        self
    }

    fn plus(mut self, other: Self) -> Self {
        self.parts.extend(other.parts);
        self
    }
}

/// Contact: its inputs and its load.
type Contact = (Inputs, f64);

/// Data for derivatives, computed at first use.
#[derive(Default)]
pub(super) struct Neighbourhood {
    /// Last solution whose equations were linearised.
    base: Option<(Request, ReducedSolution)>,
}

impl Coupled {
    /// Returns the derivative of all outputs by an input or a parameter. `outputs` are those of the inputs.
    ///
    /// # Errors
    /// If the full solver computed the outputs, or if contacts next to this one are refused or have no solution.
    pub fn derivative(&mut self, inputs: &Inputs, outputs: &Outputs, by: Input) -> Result<Derivative, CoupledError> {
        if outputs.full {
            return Err(CoupledError::NoDerivative("the full solver computed these outputs"));
        }
        let mut derivative = self.by_means(inputs, outputs, by, Means::Linearised)?;
        if derivative.is_none() {
            derivative = self.by_means(inputs, outputs, by, Means::Solved)?;
        }
        derivative.ok_or(CoupledError::NoDerivative("the reduced model does not converge next to this contact"))
    }

    fn by_means(
        &mut self,
        inputs: &Inputs,
        outputs: &Outputs,
        by: Input,
        means: Means,
    ) -> Result<Option<Derivative>, CoupledError> {
        if self.pressed == Pressed::Load {
            return self.under_load(inputs, inputs.load, by, means);
        }
        match self.beyond(inputs)? {
            Some(end) => self.beyond_end(&end, inputs, by, means),
            None => self.at_approach(inputs, outputs.load, by, means),
        }
    }

    /// Returns the derivative under a load. By the input `load`, the load changes too.
    fn under_load(
        &mut self,
        inputs: &Inputs,
        load: f64,
        by: Input,
        means: Means,
    ) -> Result<Option<Derivative>, CoupledError> {
        let (size, by_load) = (means.size(inputs, by), selects(by, |inputs| &mut inputs.load));
        let contact = |moved: Inputs| (moved, if by_load { moved.load } else { load });
        let contacts: Vec<Contact> = means.moved(inputs, by, size).into_iter().map(contact).collect();
        Ok(self.next_to((inputs, load), &contacts, means)?.map(|outputs| means.of(outputs, size)))
    }

    /// Returns the derivative at an approach between those of the trained loads, where the load is known.
    fn at_approach(
        &mut self,
        inputs: &Inputs,
        load: f64,
        by: Input,
        means: Means,
    ) -> Result<Option<Derivative>, CoupledError> {
        let loaded = Inputs { load, ..*inputs };
        let Some(by_load) = self.under_load(&loaded, load, |inputs| &mut inputs.load, means)? else { return Ok(None) };
        let compliance = by_load.of(|outputs| outputs.approach_m);
        if selects(by, |inputs| &mut inputs.approach_m) {
            return Ok(Some(by_load.times(1.0 / compliance)));
        }
        let own = self.under_load(&loaded, load, by, means)?;
        // The load changes such that the approach does not.
        Ok(own.map(|own| {
            let load = -own.of(|outputs| outputs.approach_m) / compliance;
            own.plus(by_load.times(load))
        }))
    }

    /// Returns the derivative at an approach beyond those of the trained loads. The end moves with the inputs.
    fn beyond_end(
        &mut self,
        beyond: &Beyond,
        inputs: &Inputs,
        by: Input,
        means: Means,
    ) -> Result<Option<Derivative>, CoupledError> {
        let kind = self.model.contact();
        if selects(by, |inputs| &mut inputs.approach_m) {
            let size = beyond.end.length_m;
            let outputs = means.moved(inputs, by, size).into_iter();
            let outputs = outputs.map(|moved| beyond.outputs(&beyond.end, moved.approach_m, kind)).collect();
            return Ok(Some(means.of(outputs, size)));
        }
        let size = means.size(inputs, by);
        let moved = means.moved(inputs, by, size);
        let loads = moved.iter().map(|moved| self.load_of(beyond, moved));
        let loads: Vec<f64> = loads.collect::<Result<_, _>>()?;
        let mut next_to_end = |times: f64| {
            let contacts: Vec<Contact> = moved.iter().zip(&loads).map(|(moved, load)| (*moved, load * times)).collect();
            self.next_to((inputs, beyond.end.load * times), &contacts, means)
        };
        let Some((own, inner)) = next_to_end(1.0)?.zip(next_to_end(beyond.inwards)?) else { return Ok(None) };
        let ends = own.into_iter().zip(inner).map(|(own, inner)| End::of(own, &inner, beyond.inwards));
        let ends: Vec<End> = ends.collect::<Result<_, _>>()?;
        let outputs = ends.iter().map(|end| beyond.outputs(end, inputs.approach_m, kind)).collect();
        Ok(Some(means.of(outputs, size)))
    }

    /// Returns the outputs of contacts next to one; `None` if the equations cannot be linearised, or if a solution does
    /// not converge.
    fn next_to(
        &mut self,
        (inputs, load): (&Inputs, f64),
        contacts: &[Contact],
        means: Means,
    ) -> Result<Option<Vec<Outputs>>, CoupledError> {
        let own = self.request(inputs, load)?;
        let Some(base) = self.base(&own)? else { return Ok(None) };
        let requests = contacts.iter().map(|(inputs, load)| self.request(inputs, *load));
        let requests: Vec<Request> = requests.collect::<Result<_, _>>()?;
        let problem = |request: &Request| Problem::new(&request.point, request.lubricant);
        let solutions = match (means, &requests[..]) {
            (Means::Linearised, [before, after]) => {
                let solutions = self.online.beside(&base, &[problem(before)?, problem(after)?])?;
                solutions.map(Vec::from)
            }
            _ => {
                let mut solved = |request| Ok(self.online.solve_beside(&base, &problem(request)?)?);
                requests.iter().map(&mut solved).collect::<Result<_, CoupledError>>()?
            }
        };
        let Some(solutions) = solutions else { return Ok(None) };
        let outputs = requests.iter().zip(solutions);
        let outputs =
            outputs.map(|(request, solution)| Ok(Outputs::of(answer_of(request, &self.online, solution)?.result)));
        outputs.collect()
    }

    /// Returns the solution of a contact; `None` if it does not converge.
    fn base(&mut self, request: &Request) -> Result<Option<ReducedSolution>, CoupledError> {
        if let Some((known, solved)) = &self.neighbourhood.base
            && known == request
        {
            return Ok(Some(solved.clone()));
        }
        self.online.forget();
        match self.online.solve(&request.point, request.lubricant) {
            Ok(solved) => {
                self.neighbourhood.base = Some((request.clone(), solved.clone()));
                Ok(Some(solved))
            }
            Err(why) if why.without_solution().is_some() => Ok(None),
            Err(why) => Err(why.into()),
        }
    }
}

/// Returns true if both select the same input.
fn selects(by: Input, own: Input) -> bool {
    let mut probe = Inputs::NONE;
    *by(&mut probe) = 1.0;
    *own(&mut probe) == 1.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::embedded;

    /// Inputs of units under a load, and at an approach.
    const LOADED: [Input; 6] = [
        |i| &mut i.radius_m,
        |i| &mut i.speed_m_per_s,
        |i| &mut i.slide_to_roll_ratio,
        |i| &mut i.load,
        |i| &mut i.modulus_pa,
        |i| &mut i.viscosity_pa_s,
    ];
    const APPROACHED: [Input; 3] = [|i| &mut i.radius_m, |i| &mut i.speed_m_per_s, |i| &mut i.approach_m];

    const OUTPUTS: [fn(&Outputs) -> f64; 7] = [
        |o| o.load,
        |o| o.approach_m,
        |o| o.half_width_m,
        |o| o.h_c_m,
        |o| o.h_min_m,
        |o| o.friction_force,
        |o| o.hertz_pressure_pa,
    ];

    fn unit(which: &str, pressed: Pressed) -> (Coupled, Inputs) {
        let model = embedded(which).unwrap();
        let inputs = Coupled::first_inputs(&model).unwrap();
        (Coupled::new(model, pressed).unwrap(), Inputs { slide_to_roll_ratio: 0.05, ..inputs })
    }

    /// Returns the largest difference between derivatives and fourth-order differences of solutions, relative to the
    /// output over the input. Also returns whether all derivatives are those of linearised equations.
    fn deviation(unit: &mut Coupled, inputs: &Inputs, by: &[Input], step: f64) -> (f64, bool) {
        let outputs = unit.solve(inputs).unwrap();
        let (mut largest, mut linearised) = (0.0f64, true);
        for input in by {
            let own = unit.derivative(inputs, &outputs, *input).unwrap();
            linearised &= own.linearised;
            let size = input(&mut inputs.clone()).abs();
            let mut at = |times: f64| {
                let mut moved = *inputs;
                *input(&mut moved) += times * step * size;
                unit.solve(&moved).unwrap()
            };
            let near = [-2.0, -1.0, 1.0, 2.0].map(&mut at);
            for output in OUTPUTS {
                let [a, b, c, d] = near.each_ref().map(output);
                let wanted = (8.0 * (c - b) - (d - a)) / (12.0 * step);
                let deviation = (own.of(output) * size - wanted) / output(&outputs).abs();
                largest = largest.max(deviation.abs());
            }
        }
        (largest, linearised)
    }

    #[test]
    fn derivatives_under_a_load_match_differences_of_solutions() {
        for which in ["line", "point", "line_shear", "ellipse"] {
            let (mut unit, inputs) = unit(which, Pressed::Load);
            let (deviation, linearised) = deviation(&mut unit, &inputs, &LOADED, 3e-5);
            assert!(linearised && deviation < 1e-5, "{which}: {deviation:e}, linearised: {linearised}");
        }
    }

    #[test]
    fn derivatives_at_an_approach_match_differences_of_solutions() {
        for which in ["line", "point"] {
            // A gap that opens, the middle of the trained range, and a load beyond it.
            for place in [-0.5, 1.0, 8.0] {
                let (mut unit, inputs) = unit(which, Pressed::Approach);
                let inputs = Inputs { approach_m: place * inputs.approach_m, ..inputs };
                let (deviation, linearised) = deviation(&mut unit, &inputs, &APPROACHED, 3e-5);
                assert!(linearised && deviation < 1e-5, "{which} at {place}: {deviation:e}");
            }
        }
    }

    #[test]
    fn rough_contacts_have_a_derivative_by_their_roughness() {
        let (mut unit, inputs) = unit("line_rough", Pressed::Load);
        let by: [Input; 3] = [|i| &mut i.roughness_m, |i| &mut i.speed_m_per_s, |i| &mut i.load];
        let (deviation, linearised) = deviation(&mut unit, &inputs, &by, 3e-5);
        assert!(linearised && deviation < 1e-5, "{deviation:e}");
        let outputs = unit.solve(&inputs).unwrap();
        let share = unit.derivative(&inputs, &outputs, by[0]).unwrap().of(|outputs| outputs.asperity_load_share);
        assert!(share > 0.0, "rougher surfaces carry more: {share:e}");
    }

    #[test]
    fn thermal_contacts_and_radius_ratios_use_differences() {
        let (mut warm, inputs) = unit("line_heat", Pressed::Load);
        let (deviation, linearised) = deviation(&mut warm, &inputs, &LOADED[..4], 3e-5);
        assert!(!linearised && deviation < 1e-5, "{deviation:e}");
        let (mut unit, inputs) = unit("ellipse", Pressed::Load);
        let inputs = Inputs { radius_ratio: 2.0, ..inputs };
        let outputs = unit.solve(&inputs).unwrap();
        let by_ratio = unit.derivative(&inputs, &outputs, |i| &mut i.radius_ratio).unwrap();
        assert!(!by_ratio.linearised && by_ratio.of(|outputs| outputs.h_c_m).is_finite());
    }

    #[test]
    fn tractions_have_a_derivative_without_sliding() {
        let (mut unit, inputs) = unit("line_shear", Pressed::Load);
        let at_rest = Inputs { slide_to_roll_ratio: 0.0, ..inputs };
        let outputs = unit.solve(&at_rest).unwrap();
        let by: Input = |i| &mut i.slide_to_roll_ratio;
        let derivative = unit.derivative(&at_rest, &outputs, by).unwrap();
        let little = unit.solve(&Inputs { slide_to_roll_ratio: 1e-8, ..inputs }).unwrap();
        let wanted = little.friction_coefficient / 1e-8;
        let own = derivative.of(|outputs| outputs.friction_coefficient);
        assert!((own / wanted - 1.0).abs() < 1e-3, "{own:e} against {wanted:e}");
        assert!(derivative.of(|outputs| outputs.h_c_m).abs() < 1e-6 * outputs.h_c_m);
    }
}
