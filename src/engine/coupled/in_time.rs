//! Transient contact in a co-simulation: a reduced model whose state advances with each step.
//!
//! Within a step, inputs change linearly from their previous values to those given for the end of the step. The step is
//! divided into equal substeps no longer than those of the model's training ([`CoupledMarch`]).

use super::error::{check, check_sliding};
use super::{CoupledError, Inputs, Outputs, approach, approach_reference};
use crate::engine::answer::outside;
use crate::solver::full::transient::{Frame, Input, point_at};
use crate::solver::full::{Mesh, Problem, Report, Scalars, Solution, Termination};
use crate::solver::parameters::Outside;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Sliding;
use crate::solver::reduced::transient::{CoupledError as MarchError, CoupledMarch, MarchState, TrajectoryModel};
use crate::solver::warning::Warning;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Rate of change of constant inputs.
const AT_REST: Input = Input { radius: 0.0, speed: 0.0, load: 0.0 };

/// Transient model with work space. Use one per thread.
pub struct InTime {
    model: Arc<TrajectoryModel>,
    march: Option<CoupledMarch>,
    /// Rate of change of the inputs in the last step, per unit of T.
    rate: Input,
}

/// Complete state of a transient contact.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct InTimeState {
    /// Reference load \[N/m\]. The rest of the reference contact follows from the model.
    load: f64,
    rate: Input,
    march: MarchState,
}

impl InTimeState {
    /// Serialises the state.
    ///
    /// # Errors
    /// If it cannot be encoded.
    pub fn to_bytes(&self) -> Result<Vec<u8>, CoupledError> {
        postcard::to_allocvec(self).map_err(|_| CoupledError::Unwritable)
    }

    /// Deserialises a state. It is checked when it is restored.
    ///
    /// # Errors
    /// If the bytes are not a state.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, CoupledError> {
        match postcard::take_from_bytes(bytes) {
            Ok((state, [])) => Ok(state),
            _ => Err(CoupledError::Foreign),
        }
    }
}

impl InTime {
    /// Returns a contact that has not started yet.
    pub fn new(model: Arc<TrajectoryModel>) -> Self {
        Self { model, march: None, rate: AT_REST }
    }

    /// Returns the inputs at the start of the first training.
    pub fn first_inputs(model: &TrajectoryModel) -> Option<Inputs> {
        let start = model.starts.first()?;
        let point = point_at(&start.point, start.inputs.at(0.0));
        Some(Inputs { slide_to_roll_ratio: 0.0, ..Inputs::of(&point) })
    }

    /// Returns the duration of one unit of T for the reference contact \[s\].
    pub fn seconds_per_time(point: &OperatingPoint) -> f64 {
        point.hertz().half_width_m / point.speed_m_per_s
    }

    /// Returns true if the simulation has started.
    pub fn has_begun(&self) -> bool {
        self.march.is_some()
    }

    /// Resets to the state before the start.
    pub fn reset(&mut self) {
        (self.march, self.rate) = (None, AT_REST);
    }

    /// Starts from the steady contact under the inputs. The reference contact, which defines the scales, is the trained
    /// one with the nearest load.
    ///
    /// # Errors
    /// If an input is out of range, or if the contact is outside the trained range or not solved. The state is then
    /// unchanged.
    pub fn begin(&mut self, inputs: &Inputs) -> Result<Outputs, CoupledError> {
        check_inputs(inputs)?;
        let reference = self.reference(self.reference_load(inputs.load)?)?;
        let input = over(inputs, &reference.point);
        self.check_training(&reference, 0.0, input, AT_REST)?;
        let march = CoupledMarch::begin(&self.model, reference, input)?;
        (self.march, self.rate) = (Some(march), AT_REST);
        self.outputs(inputs)
    }

    /// Advances by a time in seconds. `inputs` are the values at the end.
    ///
    /// # Errors
    /// If an input or its rate of change is out of range or outside the trained range, or if a step fails. The state is
    /// then unchanged.
    pub fn advance(&mut self, seconds: f64, inputs: &Inputs) -> Result<Outputs, CoupledError> {
        check_inputs(inputs)?;
        let march = self.march.as_ref().ok_or(CoupledError::NotBegun)?;
        let (reference, from) = (*march.reference(), march.conditions().input);
        let (span, to) = (seconds / Self::seconds_per_time(&reference.point), over(inputs, &reference.point));
        let rate = Input {
            radius: (to.radius - from.radius) / span,
            speed: (to.speed - from.speed) / span,
            load: (to.load - from.load) / span,
        };
        self.check_training(&reference, march.moment().time + span, to, rate)?;
        self.march.as_mut().ok_or(CoupledError::NotBegun)?.advance(span, to)?;
        self.rate = rate;
        self.outputs(inputs)
    }

    /// Returns the warnings for inputs at T, and rates of change per unit of T, outside the trained range.
    fn outside(&self, reference: &Problem, time: f64, input: Input, rate: Input) -> Vec<Warning> {
        let domain = &self.model.domain;
        let of_march = domain.outside(time, input, rate).into_iter();
        let of_march = of_march.map(|why| Warning::OutsideTrainedRange { outside: Outside::Other(why) });
        outside(domain.reference.trust(reference)).into_iter().chain(of_march).collect()
    }

    fn check_training(&self, reference: &Problem, time: f64, input: Input, rate: Input) -> Result<(), CoupledError> {
        let outside = self.outside(reference, time, input, rate);
        if outside.is_empty() { Ok(()) } else { Err(CoupledError::Untrained(outside)) }
    }

    /// Returns the outputs of the current state. Only the sliding of the inputs is used; it does not affect the film
    /// thickness.
    ///
    /// # Errors
    /// If the simulation has not started.
    pub fn outputs(&self, inputs: &Inputs) -> Result<Outputs, CoupledError> {
        let march = self.march.as_ref().ok_or(CoupledError::NotBegun)?;
        let (moment, reference) = (march.moment(), march.reference());
        let mut warnings = self.outside(reference, moment.time, moment.input, self.rate);
        let trained = warnings.is_empty();
        let point = point_at(&reference.point, moment.input);
        let (hertz, at) = (point.hertz(), march.conditions());
        let hertz_pressure_pa = hertz.pressure_pa;
        warnings.extend(Warning::of_hertz_pressure(hertz_pressure_pa));
        let friction_coefficient = self.friction(march, inputs.slide_to_roll_ratio, &mut warnings)?;
        let scale = reference.point.film_scale_m();
        Ok(Outputs {
            load: point.load,
            approach_m: approach(
                &point,
                march.separation() * scale,
                reference.point.hertz().half_width_m * at.scales.half_width,
            ),
            approach_reference_m: approach_reference(&point),
            half_width_m: hertz.half_width_m,
            h_c_m: moment.h_c * scale,
            h_min_m: moment.h_min * scale,
            friction_coefficient,
            friction_force: friction_coefficient * point.load,
            hertz_pressure_pa,
            error_bounds: [f64::NAN; 3],
            film_ratio_min: f64::NAN,
            asperity_load_share: f64::NAN,
            trained,
            full: false,
            warnings,
        })
    }

    /// Returns the state; `None` before the start.
    pub fn state(&self) -> Option<InTimeState> {
        let march = self.march.as_ref()?;
        let load = march.reference().point.load;
        Some(InTimeState { load, rate: self.rate, march: march.state().clone() })
    }

    /// Restores a state.
    ///
    /// # Errors
    /// If it does not belong to this model. The current state is then unchanged.
    pub fn restore(&mut self, state: &InTimeState) -> Result<(), CoupledError> {
        let InTimeState { load, rate, march: kept } = state;
        let finite = [*load, rate.radius, rate.speed, rate.load].iter().all(|value| value.is_finite());
        if !finite || self.reference_load(*load)? != *load {
            return Err(MarchError::Foreign.into());
        }
        let reference = self.reference(*load)?;
        match &mut self.march {
            Some(march) => march.restore(reference, kept)?,
            None => self.march = Some(CoupledMarch::resume(&self.model, reference, kept)?),
        }
        self.rate = *rate;
        Ok(())
    }

    /// Returns the load of the reference contact for a march that starts under this load.
    fn reference_load(&self, load: f64) -> Result<f64, CoupledError> {
        let reference = self.model.reference_for(load);
        reference.map(|point| point.load).ok_or_else(|| CoupledError::NoReference(self.model.title.clone()))
    }

    /// Returns the reference problem for a load.
    fn reference(&self, load: f64) -> Result<Problem, CoupledError> {
        let point = self.model.reference_for(load);
        let point = point.ok_or_else(|| CoupledError::NoReference(self.model.title.clone()))?;
        Ok(Problem::new(&point, self.model.domain.reference.lubricant)?)
    }

    /// Returns the friction coefficient at a slide-to-roll ratio, and adds warnings about it.
    fn friction(&self, march: &CoupledMarch, sliding: f64, warnings: &mut Vec<Warning>) -> Result<f64, CoupledError> {
        let (at, moment, reference) = (march.conditions(), march.moment(), march.reference());
        // Slide-to-roll ratio relative to the speed of the reference contact. The rolling direction may be reversed.
        let slide_to_roll_ratio = sliding * at.input.speed;
        if slide_to_roll_ratio == 0.0 {
            return Ok(0.0);
        }
        let sliding = Sliding { slide_to_roll_ratio, newtonian_plateau_ratio: None };
        // Contact whose scales the fields have.
        let own = match self.model.frame {
            Frame::Fixed => reference.point,
            Frame::ArbitraryLagrangianEulerian | Frame::Remeshed(_) => {
                let speed_m_per_s = reference.point.speed_m_per_s;
                OperatingPoint { speed_m_per_s, ..point_at(&reference.point, at.input) }
            }
        };
        let problem = Problem::new(&OperatingPoint { sliding, ..own }, reference.lubricant)?;
        let fields = march.fields();
        let scalars = Scalars {
            h_c: moment.h_c / at.scales.film,
            p_max: moment.p_max / at.scales.pressure,
            ..Scalars::default()
        };
        let solution = Solution {
            problem,
            mesh: Mesh { spec: self.model.window.grid.spec(), scale: 1.0 },
            x: march.abscissae().to_vec(),
            y: self.model.window.grid.abscissae().1.to_vec(),
            pressure: fields.pressure,
            film: fields.film,
            multiplier: Vec::new(),
            fraction: Vec::new(),
            asperity_pressure: Vec::new(),
            scalars,
            report: Report { termination: Termination::Converged, ..Report::empty() },
            grid_cost: None,
            heat: None,
        };
        // Relative to the current load, not to that of the reference contact.
        let coefficient = solution.traction_coefficient() * own.load / (reference.point.load * at.input.load);
        warnings.extend(problem.doubts_traction(coefficient, &scalars).map(Warning::from));
        Ok(coefficient)
    }
}

/// Returns the inputs relative to those of a reference contact.
fn over(inputs: &Inputs, reference: &OperatingPoint) -> Input {
    Input {
        radius: inputs.radius_m / reference.radius_m,
        speed: inputs.speed_m_per_s / reference.speed_m_per_s,
        load: inputs.load / reference.load,
    }
}

/// Refuses inputs out of range. Other checks are made when the contact is solved.
fn check_inputs(inputs: &Inputs) -> Result<(), CoupledError> {
    for (name, value) in [("radius", inputs.radius_m), ("load", inputs.load)] {
        check(name, value, "", (" above zero", |value| value > 0.0))?;
    }
    check("speed", inputs.speed_m_per_s, "", ("", |_| true))?;
    check_sliding(inputs.slide_to_roll_ratio)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::SavedModel;
    use crate::solver::discrete::grid::GridSpec;
    use crate::solver::full::transient::{Frame, Inputs as Driven, Keep, Signal, Transient, march, solve};
    use crate::solver::full::{FullSolver, Start};
    use crate::solver::reduced::transient::ReducedMarch;
    use crate::solver::training::small::Made;
    use crate::solver::training::{TrajectoryTraining, train_trajectories};

    const GRID_STEP: f64 = 0.02;
    const GRID: GridSpec = GridSpec::Uniform { dx: GRID_STEP, domain: (-4.0, 2.0) };

    fn driven(load: Signal) -> Transient {
        let own = Transient::new(OperatingPoint::TABLE_4_2, Driven::load(load), 0.6, 0.01);
        Transient { keep: Keep::Every(1), ..own }
    }

    /// Trains a model with two harmonic loads.
    fn trained_at(point: OperatingPoint, frame: Frame) -> Arc<TrajectoryModel> {
        static MODELS: Made<TrajectoryModel> = Made::new();
        MODELS.of(&(point, frame), || {
            let sine = |period: f64| {
                let sine = driven(Signal::Harmonic { amplitude: 0.1, period });
                solve(GRID, &Transient { point, frame, ..sine }, &()).unwrap()
            };
            let settings = TrajectoryTraining { loss: 1e-5, ..TrajectoryTraining::default() };
            let trainings = [0.5, 1.0 / 3.0].map(sine);
            train_trajectories(&GRID.line().unwrap(), &trainings, &settings, &()).unwrap()
        })
    }

    fn trained(frame: Frame) -> Arc<TrajectoryModel> {
        trained_at(OperatingPoint::TABLE_4_2, frame)
    }

    #[test]
    fn in_seconds_and_newtons_it_is_the_march_of_the_library() {
        let model = trained(Frame::Fixed);
        let saved = SavedModel::InTime(Arc::clone(&model)).to_bytes().unwrap();
        let read = SavedModel::from_bytes(&saved).unwrap().in_time().unwrap();
        let loads: Vec<f64> = (0..=50).map(|k| 1.0 + 0.05 * (0.2 * f64::from(k)).sin()).collect();
        let times = (0..loads.len()).map(|k| 0.01 * k as f64).collect();
        let asked = Transient { duration: 0.5, ..driven(Signal::Sampled { times, values: loads.clone() }) };
        let wanted = march(&mut ReducedMarch::new(&read, &asked).unwrap(), &asked, &()).unwrap();
        let (mut own, first) = (InTime::new(read), InTime::first_inputs(&model).unwrap());
        let point = OperatingPoint::TABLE_4_2;
        let step = 0.01 * InTime::seconds_per_time(&point);
        let mut seen = vec![own.begin(&first).unwrap()];
        seen.extend(loads[1..].iter().map(|load| {
            let inputs = Inputs { load: load * point.load, ..first };
            own.advance(step, &inputs).unwrap()
        }));
        for (own, moment) in seen.iter().zip(&wanted.moments) {
            for (own, other) in [(own.h_c_m, moment.h_c), (own.h_min_m, moment.h_min)] {
                assert!((own / (other * point.film_scale_m()) - 1.0).abs() < 1e-12, "{own} against {other}");
            }
            assert!(own.trained && own.warnings.is_empty() && !own.full, "{:?}", own.warnings);
            assert!((own.load / (moment.input.load * point.load) - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn friction_and_pressure_at_rest_equal_the_full_contact() {
        let (point, sliding) = (OperatingPoint { alpha_per_pa: 7e-9, load: 1e5, ..OperatingPoint::TABLE_4_2 }, 0.02);
        for frame in [Frame::Fixed, Frame::ArbitraryLagrangianEulerian] {
            let model = trained_at(point, frame);
            let first = InTime::first_inputs(&model).unwrap();
            let inputs = Inputs { load: 1.05 * point.load, slide_to_roll_ratio: sliding, ..first };
            let own = InTime::new(Arc::clone(&model)).begin(&inputs).unwrap();

            // Compared with the full solution on the same grid and the friction force integrated in SI units.
            let heavier = Signal::Sampled { times: vec![0.0], values: vec![1.05] };
            let asked = Transient { point, frame, duration: 0.01, ..driven(heavier) };
            let full = solve(GRID, &asked, &()).unwrap();
            let (state, at_rest) = (&full.states[0], OperatingPoint { load: inputs.load, ..point });
            let scales = if frame == Frame::Fixed { point } else { at_rest };
            let fluid = full.transient.lubricant.scaled(&scales).unwrap();
            let stress = |k: usize| {
                let (p, h) = (state.pressure[k], state.film[k] * scales.film_scale_m());
                scales.viscosity_pa_s * fluid.at(p.max(0.0)).viscosity * sliding * point.speed_m_per_s / h
            };
            let dx = GRID_STEP * scales.hertz().half_width_m;
            let force: f64 = (1..full.x.len() - 1).map(|k| 0.5 * dx * (stress(k) + stress(k + 1))).sum();
            let pairs = [
                (own.friction_force, force),
                (own.friction_coefficient, force / inputs.load),
                (own.h_c_m, full.moments[0].h_c * point.film_scale_m()),
            ];
            for (own, wanted) in pairs {
                assert!((own / wanted - 1.0).abs() < 2e-3, "{frame:?}: {own} against {wanted}");
            }
            assert!((own.hertz_pressure_pa / at_rest.hertz().pressure_pa - 1.0).abs() < 1e-12);
            // The grid scaled to this contact gives the steady contact.
            let solution = FullSolver::on(GRID.line().unwrap()).solve(
                &OperatingPoint {
                    sliding: Sliding { slide_to_roll_ratio: sliding, newtonian_plateau_ratio: None },
                    ..at_rest
                },
                Default::default(),
                Start::Cold,
                &(),
            );
            let stationary = solution.unwrap().traction_coefficient() * inputs.load;
            let within = if frame == Frame::Fixed { 0.1 } else { 2e-3 };
            assert!((own.friction_force / stationary - 1.0).abs() < within, "{frame:?}: {stationary}");
        }
    }

    #[test]
    fn invalid_inputs_are_refused_and_untrained_ones_reported() {
        let model = trained(Frame::Fixed);
        let (mut own, first) = (InTime::new(Arc::clone(&model)), InTime::first_inputs(&model).unwrap());
        let step = model.domain.step * InTime::seconds_per_time(&model.starts[0].point);
        assert!(own.advance(step, &first).unwrap_err().to_string().contains("has not been initialised"));
        own.begin(&first).unwrap();
        let kept = own.outputs(&first).unwrap();
        for wrong in [
            Inputs { load: -1.0, ..first },
            Inputs { radius_m: 0.0, ..first },
            Inputs { speed_m_per_s: f64::NAN, ..first },
            Inputs { slide_to_roll_ratio: 11.0, ..first },
        ] {
            assert!(!own.advance(step, &wrong).unwrap_err().to_string().is_empty());
            assert_eq!(own.outputs(&first).unwrap().h_c_m, kept.h_c_m);
        }
        assert!(own.advance(1e9, &first).unwrap_err().to_string().contains("steps"));
        let (fast, far) = (Inputs { load: 1.05 * first.load, ..first }, Inputs { load: 3.0 * first.load, ..first });
        let quick = Inputs { speed_m_per_s: 1.1 * first.speed_m_per_s, ..first };
        for (inputs, said) in [(fast, "faster"), (far, "outside the trained"), (quick, "was constant")] {
            let refused = own.advance(step, &inputs).unwrap_err();
            assert!(matches!(refused, CoupledError::Untrained(_)) && refused.to_string().contains(said), "{refused}");
            assert_eq!(format!("{:?}", own.outputs(&first).unwrap()), format!("{kept:?}"));
        }
        // The same load is accepted if it is reached in more time.
        let rested = own.advance(20.0 * step, &fast).unwrap();
        assert!(rested.trained && rested.warnings.is_empty(), "{:?}", rested.warnings);
        let refused = InTime::new(model).begin(&far).unwrap_err().to_string();
        assert!(refused.contains("outside the trained"), "{refused}");
    }

    #[test]
    fn line_stiffness_agrees_between_two_units_and_one_march() {
        let times: Vec<f64> = (0..=20).map(|k| 0.05 * f64::from(k)).collect();
        let slow = |load: f64, by: f64| {
            let point = OperatingPoint { load, ..OperatingPoint::TABLE_4_2 };
            let values = times.iter().map(|time| 1.0 + by * time).collect();
            let signal = Signal::Sampled { times: times.clone(), values };
            solve(GRID, &Transient { point, duration: 1.0, ..driven(signal) }, &()).unwrap()
        };
        // Two reference loads, so that the scales of a contact depend on the load at the start.
        let load = OperatingPoint::TABLE_4_2.load;
        let trainings = [slow(load, 0.05), slow(1.05 * load, -0.05)];
        let settings = TrajectoryTraining { loss: 1e-7, ..TrajectoryTraining::default() };
        let model = Arc::new(train_trajectories(&GRID.line().unwrap(), &trainings, &settings, &()).unwrap());
        let first = InTime::first_inputs(&model).unwrap();
        let [light, heavy] = [1.01, 1.02].map(|by| Inputs { load: by * load, ..first });
        let mut march = InTime::new(Arc::clone(&model));
        let begun = march.begin(&light).unwrap();
        let other = InTime::new(Arc::clone(&model)).begin(&heavy).unwrap();
        // Increases the load slowly, then waits until the film is steady.
        let second = InTime::seconds_per_time(&OperatingPoint::TABLE_4_2);
        march.advance(second, &heavy).unwrap();
        let reached = march.advance(20.0 * second, &heavy).unwrap();
        let stiffness = |to: &Outputs| (to.load - begun.load) / (to.approach_m - begun.approach_m);
        let (by_units, by_march) = (stiffness(&other), stiffness(&reached));
        assert!((by_units / by_march - 1.0).abs() < 1e-2, "{by_units:e} from two units, {by_march:e} from one march");
        assert_eq!(begun.approach_reference_m, first.radius_m);
        assert!((begun.half_width_m / other.half_width_m - (1.01f64 / 1.02).sqrt()).abs() < 1e-12);
        // Steady contacts have the same reference distance.
        let stationary = |inputs: Inputs| {
            let point = OperatingPoint { load: inputs.load, ..OperatingPoint::TABLE_4_2 };
            let grid = FullSolver::on(GRID.line().unwrap());
            let solution = { grid }.solve(&point, Default::default(), Start::Cold, &()).unwrap();
            let separation = solution.scalars.h_0 * point.film_scale_m();
            approach(&point, separation, point.hertz().half_width_m)
        };
        assert!((stationary(light) / begun.approach_m - 1.0).abs() < 1e-2, "{}", stationary(light));
    }

    #[test]
    fn a_state_is_written_read_and_gone_on_from() {
        let model = trained(Frame::Fixed);
        let first = InTime::first_inputs(&model).unwrap();
        let step = 1.7 * model.domain.step * InTime::seconds_per_time(&model.starts[0].point);
        let go = |own: &mut InTime| -> Vec<Outputs> {
            let inputs = |k: i32| Inputs { load: first.load * (1.0 + 0.005 * f64::from(k)), ..first };
            (0..5).map(|k| own.advance(step, &inputs(k)).unwrap()).collect()
        };
        let mut own = InTime::new(Arc::clone(&model));
        own.begin(&first).unwrap();
        go(&mut own);
        let (state, present) = (own.state().unwrap(), own.outputs(&first).unwrap());
        let bytes = state.to_bytes().unwrap();
        let films = |all: Vec<Outputs>| -> Vec<u64> { all.iter().map(|own| own.h_c_m.to_bits()).collect() };
        let onwards = films(go(&mut own));
        let mut other = InTime::new(Arc::clone(&model));
        other.restore(&InTimeState::from_bytes(&bytes).unwrap()).unwrap();
        assert_eq!(other.outputs(&first).unwrap().h_c_m.to_bits(), present.h_c_m.to_bits());
        assert_eq!(films(go(&mut other)), onwards);
        assert!(InTimeState::from_bytes(&bytes[..bytes.len() - 1]).is_err());
        let mut foreign = InTime::new(trained(Frame::ArbitraryLagrangianEulerian));
        let mut spoiled = state.clone();
        spoiled.load *= 2.0;
        assert!(foreign.restore(&spoiled).is_err() && !foreign.has_begun());
    }
}
