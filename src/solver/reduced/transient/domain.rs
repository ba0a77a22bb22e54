//! Trained range of a reduced transient model, and checks of a march against it.

use crate::solver::full::Problem;
use crate::solver::full::transient::{Input, Inputs, Moment, Trajectory};
use crate::solver::limits::digits;
use crate::solver::parameters::{Axis, Outside, ParameterSpace, Quantity};
use crate::solver::reduced::{Domain, Trust};
use crate::solver::warning::Warning;
use serde::{Deserialize, Serialize};

/// Accepted excess of an input beyond its trained range, in widths of the range; and accepted ratio of its rate to
/// the trained one. It allows for differences over steps of other lengths.
const ROOM: (f64, f64) = (0.01, 1.05);
/// Maximum number of steps of a planned march that are checked.
const MOST_LOOKED_AT: f64 = 4000.0;
/// Change of a constant input by rounding.
const ROUNDING: f64 = 1e-6;

/// Range and largest rate of one input, relative to its reference.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reach {
    /// Smallest and largest value.
    pub range: (f64, f64),
    /// Largest change per unit of T, as a difference over one step.
    pub rate: f64,
}

/// Trained range of a reduced transient model.
#[derive(Clone, Debug, PartialEq)]
pub struct TrajectoryDomain {
    /// Reference contacts, and the lubricant.
    pub reference: Domain,
    /// Radius R̄.
    pub radius: Reach,
    /// Entrainment speed ū.
    pub speed: Reach,
    /// Load w̄.
    pub load: Reach,
    /// Inputs, if all trainings had the same ones. Bases from a single time history hold only the states along it.
    /// For the steady film at a load that this history passes through their error may be a fifth.
    pub only: Option<Inputs>,
    /// Length of the steps \[T\]: the mean of the training with the shortest steps.
    pub step: f64,
}

/// Input: name, trained range, and access function.
type Named = (&'static str, Reach, fn(&Input) -> f64);

/// Excess of a march beyond the trained range, and its sentence.
struct Excess {
    far: f64,
    sentence: String,
}

impl Reach {
    /// Returns true if the input varied in the training.
    pub fn varies(&self) -> bool {
        self.rate > 0.0
    }

    fn of(trajectories: &[Trajectory], get: fn(&Input) -> f64) -> Self {
        let mut reach = Self { range: (f64::INFINITY, f64::NEG_INFINITY), rate: 0.0 };
        for moment in trajectories.iter().flat_map(|t| &t.moments) {
            let value = get(&moment.input);
            reach.range = (reach.range.0.min(value), reach.range.1.max(value));
        }
        for pair in trajectories.iter().flat_map(|t| t.moments.windows(2)) {
            reach.rate = reach.rate.max(get(&rate(&pair[0], &pair[1])).abs());
        }
        reach
    }

    /// Returns true if the numbers are valid.
    pub fn is_sound(&self) -> bool {
        let (low, high) = self.range;
        low.is_finite() && high.is_finite() && low <= high && self.rate.is_finite() && self.rate >= 0.0
    }

    fn value_outside(&self, name: &str, value: f64) -> Option<Excess> {
        let (low, high) = self.range;
        let beyond = (low - value).max(value - high);
        if beyond <= ROOM.0 * (high - low) + ROUNDING {
            return None;
        }
        let (value, [least, most]) = (digits(value), [low, high].map(digits));
        let sentence = if least == most {
            format!("the {name} is {value} times its reference, but was constant at {least} in training")
        } else {
            format!("the {name} is {value} times its reference, outside the trained {least}…{most}")
        };
        Some(Excess { far: beyond, sentence })
    }

    /// Returns the excess over the only trained time history, `None` if the value follows it.
    fn elsewhere(&self, name: &str, value: f64, learned: f64) -> Option<Excess> {
        let (low, high) = self.range;
        let far = (value - learned).abs();
        if far <= ROOM.0 * (high - low) + ROUNDING {
            return None;
        }
        let [value, learned] = [value, learned].map(digits);
        let sentence = format!(
            "the {name} is {value} times its reference, where the only training had {learned}: the errors of other courses \
             are unknown"
        );
        Some(Excess { far, sentence })
    }

    fn rate_outside(&self, name: &str, rate: f64) -> Option<Excess> {
        let rate = rate.abs();
        if rate <= ROOM.1 * self.rate + ROUNDING {
            return None;
        }
        let own = digits(rate);
        let sentence = if self.varies() {
            let trained = digits(self.rate);
            format!("the {name} changes by {own} times its reference per unit of T, faster than the trained {trained}")
        } else {
            format!("the {name} changes, but was constant in training")
        };
        Some(Excess { far: rate, sentence })
    }
}

/// Returns the changes of the inputs between two moments, per unit of T.
fn rate(before: &Moment, now: &Moment) -> Input {
    let (step, from, to) = (now.time - before.time, before.input, now.input);
    Input {
        radius: (to.radius - from.radius) / step,
        speed: (to.speed - from.speed) / step,
        load: (to.load - from.load) / step,
    }
}

/// Returns the inputs of all trainings, if they are equal.
pub fn only_course<'a>(mut courses: impl Iterator<Item = &'a Inputs>) -> Option<Inputs> {
    let first = courses.next()?;
    courses.all(|other| other == first).then(|| first.clone())
}

/// Returns the larger excess.
fn worse(one: Option<Excess>, other: Option<Excess>) -> Option<Excess> {
    match (one, other) {
        (Some(one), Some(other)) => Some(if other.far > one.far { other } else { one }),
        (one, other) => one.or(other),
    }
}

impl TrajectoryDomain {
    /// Computes the trained range of trajectories with one lubricant; `None` without trajectories or steps.
    pub fn of(trajectories: &[Trajectory]) -> Option<Self> {
        let problem = &trajectories.first()?.problem;
        let range = |get: fn(&Problem) -> f64| {
            let all = trajectories.iter().map(|t| get(&t.problem));
            all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)))
        };
        let step = |t: &Trajectory| {
            let steps = t.moments.len().checked_sub(1).filter(|steps| *steps > 0)?;
            Some(t.moments.last()?.time / steps as f64)
        };
        let steps = trajectories.iter().filter_map(step);
        Some(Self {
            reference: Domain {
                contact: problem.point.kind,
                space: ParameterSpace::of([
                    Axis::new(Quantity::M, range(|problem| problem.moes.m)),
                    Axis::new(Quantity::L, range(|problem| problem.moes.l)),
                    Axis::new(Quantity::Alpha, range(|problem| problem.point.alpha_per_pa)),
                ])
                .limited([(Quantity::HertzPressure, (0.0, range(|problem| problem.point.hertz().pressure_pa).1))])
                .fixing([(Quantity::Viscosity, problem.point.viscosity_pa_s)]),
                lubricant: problem.lubricant,
            },
            radius: Reach::of(trajectories, |input| input.radius),
            speed: Reach::of(trajectories, |input| input.speed),
            load: Reach::of(trajectories, |input| input.load),
            only: only_course(trajectories.iter().map(|t| &t.transient.inputs)),
            step: steps.min_by(f64::total_cmp)?,
        })
    }

    /// Returns the three inputs with name, range and access function.
    fn reaches(&self) -> [Named; 3] {
        [
            ("load", self.load, |input| input.load),
            ("speed", self.speed, |input| input.speed),
            ("radius", self.radius, |input| input.radius),
        ]
    }

    /// Returns the excess of an input over its range, or over the only trained time history.
    fn value_outside(&self, (name, reach, get): Named, time: f64, input: &Input) -> Option<Excess> {
        let other = |only: &Inputs| reach.elsewhere(name, get(input), get(&only.at(time)));
        reach.value_outside(name, get(input)).or_else(|| self.only.as_ref().and_then(other))
    }

    /// Returns one sentence for each input, or rate per unit of T, that is outside the trained range at T.
    pub fn outside(&self, time: f64, input: Input, rate: Input) -> Vec<String> {
        let of = |(name, reach, get): Named| {
            let value = self.value_outside((name, reach, get), time, &input);
            [value, reach.rate_outside(name, get(&rate))]
        };
        self.reaches().into_iter().flat_map(of).flatten().map(|excess| excess.sentence).collect()
    }

    /// Returns the warnings of a march: a reference contact outside the trained range, and the farthest value and the
    /// fastest change of each input.
    pub fn left_by(&self, trajectory: &Trajectory) -> Vec<Warning> {
        let mut left = Vec::new();
        if let Trust::Outside(outside) = self.reference.trust(&trajectory.problem) {
            left.push(Warning::OutsideTrainedRange { outside });
        }
        let moments = &trajectory.moments;
        for (name, reach, get) in self.reaches() {
            let at = |time: f64, excess: Option<Excess>| {
                excess.map(|Excess { far, sentence }| Excess { far, sentence: format!("{sentence} (T = {time:.4})") })
            };
            let values = moments
                .iter()
                .map(|moment| at(moment.time, self.value_outside((name, reach, get), moment.time, &moment.input)));
            let rates = moments
                .windows(2)
                .map(|pair| at(pair[1].time, reach.rate_outside(name, get(&rate(&pair[0], &pair[1])))));
            let farthest = [values.fold(None, worse), rates.fold(None, worse)];
            let warning = |Excess { sentence, .. }| Warning::OutsideTrainedRange { outside: Outside::Other(sentence) };
            left.extend(farthest.into_iter().flatten().map(warning));
        }
        left
    }

    /// Returns a sentence if a planned march will leave the trained range; `None` if not.
    pub fn leaves(&self, problem: &Problem, inputs: &Inputs, duration: f64) -> Option<String> {
        if let Trust::Outside(why) = self.reference.trust(problem) {
            return Some(why.to_string());
        }
        let (own, given) = (self.reference.lubricant.cavitation, problem.lubricant.cavitation);
        if own != given {
            return Some(format!(
                "the model was trained with the cavitation model {}, not {}",
                own.name(),
                given.name()
            ));
        }
        let steps = (duration / self.step).ceil().clamp(1.0, MOST_LOOKED_AT);
        let (length, mut before) = (duration / steps, inputs.at(0.0));
        (0..=steps as usize).find_map(|k| {
            let time = k as f64 * length;
            let now = inputs.at(time);
            let by = |to: f64, from: f64| (to - from) / length;
            let rate = Input {
                radius: by(now.radius, before.radius),
                speed: by(now.speed, before.speed),
                load: by(now.load, before.load),
            };
            before = now;
            self.outside(time, now, rate).into_iter().next()
        })
    }

    /// Returns true if the numbers are valid.
    pub fn is_sound(&self) -> bool {
        let reaches = [self.radius, self.speed, self.load];
        let positive = self.radius.range.0 > 0.0 && self.load.range.0 > 0.0;
        reaches.iter().all(Reach::is_sound) && positive && self.step.is_finite() && self.step > 0.0
    }
}
