//! Temperatures across the film at one abscissa: collocation of the energy equation, solved by Newton's method.
//!
//! Hρ̄ūθ_X − Ψ_Xθ_ζ = (C₁/H)θ_ζζ + HC₂τ̄²f + HC₃β̄(1 + θ)ūP_X between the surfaces, whose temperatures are those of
//! moving heat sources. Symbols: film thickness H, density ρ̄, velocity ū, temperature rise θ, stream function Ψ,
//! height ζ, stress τ̄, fluidity f, expansion coefficient β̄, pressure P; C₁ to C₃ as in
//! [`ScaledHeat`](crate::solver::physics::lubricant::ScaledHeat).

use super::across::{ACROSS, POINTS, Profile, apply, inner};
use super::film::{Drive, Sheared, StressLaw, WarmLaws};
use crate::solver::discrete::reynolds::generalized::NodeState;
use crate::solver::physics::lubricant::{Across, LimitingStress};

/// Bounds of the factor that adapts the pressure gradient to a changed viscosity, such that the pressure-driven flow
/// stays constant.
const GRADIENT_FACTOR: (f64, f64) = (0.2, 5.0);

/// Largest change of θ in one step.
const LARGEST_STEP: f64 = 0.1;

/// Maximum number of steps.
const MOST_STEPS: usize = 60;

/// Smallest share of a step if the steps oscillate. The heat source has a kink at a limiting stress.
const LEAST_SHARE: f64 = 1.0 / 32.0;

/// A step that reverses the previous one counts as an oscillation if it is longer than this share of it.
const SHORTER: f64 = 0.3;

/// Largest expected ratio of a step to the square of the previous one.
const BEND: f64 = 30.0;

/// Film at one abscissa: its temperatures and the resulting flow.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Station {
    /// θ.
    pub theta: Profile,
    /// Flow, accurate to within the last Newton step.
    pub flowing: Flowing,
    /// Heat fluxes q̄ into both bodies.
    pub flux: [f64; 2],
    /// Number of Newton steps of the last solve.
    pub steps: usize,
    /// Size of the last step if the iteration did not converge, otherwise 0.
    pub open: f64,
}

/// Upwind data from the two next stations on one side, for points at which the film flows in from there.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Side {
    /// Weights w_k of the difference quotient: (Gθ)_X − G_Xθ is ±Σ w_k G_k (θ − θ_k), where G = Hρ̄ū.
    pub weights: [Profile; 2],
    /// θ there.
    pub theta: [Profile; 2],
    /// G there.
    pub flow: [Profile; 2],
}

impl Side {
    /// Builds the data of two places at the given distances. The second place is farther, or equal to the first. The
    /// quotient is of first order where the film `leaves` towards one of them. All weights are zero if the first
    /// distance is zero.
    pub fn of(
        [near, far]: [f64; 2],
        theta: [Profile; 2],
        flow: [Profile; 2],
        leaves: impl Fn(usize, usize) -> bool,
    ) -> Self {
        let mut out = Self { theta, ..Self::default() };
        if near == 0.0 {
            return out;
        }
        let r = near / (far - near);
        let second = [(1.0 + r) / near, -r * r / (1.0 + r) / near];
        out.flow = flow;
        for j in 0..POINTS {
            let turns = far == near || (0..2).any(|k| leaves(k, j));
            let weights = if turns { [1.0 / near, 0.0] } else { second };
            (out.weights[0][j], out.weights[1][j]) = (weights[0], weights[1]);
        }
        out
    }

    /// Returns the heat convected to point `j`, and its derivative by θ. If the flow changes its direction between
    /// the stations, the flow of the point itself is used.
    #[inline]
    pub(super) fn carried(&self, j: usize, flow: f64, theta: f64) -> (f64, f64) {
        let (mut sum, mut slope) = (0.0, 0.0);
        for k in 0..2 {
            let there = self.flow[k][j];
            let weight = self.weights[k][j] * if there * flow > 0.0 { there } else { flow };
            sum += weight * (theta - self.theta[k][j]);
            slope += weight;
        }
        (sum, slope)
    }
}

/// Data that a station receives from its neighbours along the film.
#[derive(Clone, Copy, Debug)]
pub struct Neighbours {
    /// Upstream and downstream.
    pub sides: [Side; 2],
    /// Lines farther from the axis and nearer to it, in a plane: for flow towards the axis and away from it.
    pub beside: Option<[Side; 2]>,
    /// −Ψ_X at the faces between the points; in a plane including the flow along Y.
    pub across: [f64; POINTS - 1],
    /// Influence of the fluxes at other stations on each surface temperature, and the weight of the station's own flux.
    pub surfaces: [(f64, f64); 2],
}

/// Limiting shear stress of the film, and Hertzian pressure p_H \[Pa\].
pub type Limit = (LimitingStress, f64);

/// Quantities that stay constant while a station is solved.
#[derive(Clone, Copy, Debug)]
pub struct Place<'a> {
    /// Heat and shear laws of the contact.
    pub laws: WarmLaws<'a>,
    /// Limiting shear stress, if any.
    pub limit: Option<Limit>,
    /// P, its gradient and H.
    pub state: NodeState,
    /// Mobility with which P was computed; 0 to use the film's own.
    pub mobility: f64,
    /// Pressure-driven flow over that of a smooth film: 1, or that of rough surfaces.
    pub flow_factor: f64,
}

/// Flow of a film at given temperatures.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flowing {
    /// ū.
    pub velocity: Profile,
    /// G = Hρ̄ū.
    pub flow: Profile,
    /// Hρ̄v̄, with the velocity v̄ along Y.
    pub aside: Profile,
    /// Mid-film stress τ̄_m.
    pub stress: f64,
    /// Mobility (s₀g₁/g₀ − s₁) κH³, with the moments of the film.
    pub mobility: f64,
    fluid: Across<POINTS>,
    film: Sheared<POINTS>,
}

/// Heat generated at every point of a film.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Made {
    /// Heat by shear, HC₂τ̄²f, reduced where the stress is limited.
    pub sheared: Profile,
    /// Heat by compression, HC₃β̄(1 + θ)ūP_X.
    pub compressed: Profile,
}

impl Place<'_> {
    /// Evaluates the film at the given temperatures. The pressure gradient is scaled such that the pressure-driven flow
    /// stays constant. For a Newtonian lubricant the scale follows from the temperatures; otherwise it is `factor`.
    fn flowing(&self, theta: &Profile, stress: f64, factor: f64) -> Flowing {
        let across = &*ACROSS;
        let NodeState { pressure, gradient: [gradient, gradient_y], film } = self.state;
        let heat = self.laws.heat;
        let fluid = heat.fluid.at(pressure, theta);
        let offsets = across.points.map(|zeta| zeta - 0.5);
        let rest = apply(&across.rest, &fluid.density);
        let mobility = |fluidity: &Profile| {
            let [mut g_0, mut g_1, mut s_0, mut s_1] = [0.0; 4];
            for i in 0..POINTS {
                let weighted = across.weights[i] * fluidity[i];
                g_0 += weighted;
                g_1 += offsets[i] * weighted;
                s_0 += weighted * rest[i];
                s_1 += offsets[i] * weighted * rest[i];
            }
            heat.gradient * film.powi(3) * (s_0 * g_1 / g_0 - s_1)
        };
        let law: Option<&StressLaw> = self.laws.shear.as_ref();
        let factor = if law.is_none() { self.factor(mobility(&fluid.fluidity)) } else { factor };
        let per = |gradient: f64| heat.gradient * film * gradient * factor * self.flow_factor;
        let drive = Drive { along: per(gradient), aside: per(gradient_y), rate: self.laws.slip() / film };
        let (stress, sheared) = Sheared::sliding(law, &fluid.fluidity, (&offsets, &across.weights), drive, stress);
        let rates: Profile = std::array::from_fn(|i| film * sheared.stress[i] * sheared.fluidity[i]);
        let velocity = apply(&across.primitive, &rates).map(|v| heat.speeds[0] + v);
        let flow = std::array::from_fn(|i| film * fluid.density[i] * velocity[i]);
        let mut aside = [0.0; POINTS];
        if gradient_y != 0.0 {
            let rates: Profile = std::array::from_fn(|i| film * sheared.aside[i] * sheared.fluidity[i]);
            aside = apply(&across.primitive, &rates);
            aside.iter_mut().zip(&fluid.density).for_each(|(v, density)| *v *= film * density);
        }
        Flowing { velocity, flow, aside, stress, mobility: mobility(&sheared.fluidity), fluid, film: sheared }
    }

    /// Returns the factor on the pressure gradient that keeps the pressure-driven flow constant at another mobility.
    /// For a shear-thinning lubricant, whose mobility depends on the gradient, half of the change in the logarithm is
    /// applied.
    fn factor(&self, mobility: f64) -> f64 {
        if self.mobility == 0.0 {
            return 1.0;
        }
        let ratio = (self.mobility / mobility).clamp(GRADIENT_FACTOR.0, GRADIENT_FACTOR.1);
        if self.laws.shear.is_some() { ratio.sqrt() } else { ratio }
    }

    /// Updates the flow of a station from its temperatures.
    pub fn evaluate(&self, station: &mut Station) {
        station.flowing = self.flowing(&station.theta, station.flowing.stress, 1.0);
    }

    /// Returns the heat generated at a station.
    pub fn made(&self, station: &Station) -> Made {
        let flowing = self.flowing(&station.theta, station.flowing.stress, 1.0);
        Made {
            sheared: std::array::from_fn(|j| self.shear_heat(&flowing, j).0),
            compressed: std::array::from_fn(|j| self.compression_heat(&flowing, j) * (1.0 + station.theta[j])),
        }
    }

    /// Returns the heat by shear at a point, and its derivatives by ln f at constant stress and by τ̄ along X.
    fn shear_heat(&self, flowing: &Flowing, j: usize) -> (f64, f64, f64) {
        let film = &flowing.film;
        let (stress, fluidity, slope) = (film.stress[j], film.fluidity[j], film.slope[j]);
        let scale = self.state.film * self.laws.heat.shear;
        let (size, aside) = (film.size(j), film.aside[j]);
        let whole = scale * size * size * fluidity;
        let by_size = if aside == 0.0 { stress * slope } else { size * size / stress * slope };
        let by_stress = if stress == 0.0 { 0.0 } else { scale * stress * (2.0 * fluidity + by_size) };
        let free = (whole, whole, by_stress);
        let Some((limit, hertz_pressure)) = &self.limit else { return free };
        let pascal = self.laws.heat.stress_scale_pa;
        let felt = size * pascal;
        let carried = limit.carried(felt, self.state.pressure * hertz_pressure);
        if carried >= felt {
            return free;
        }
        // A film that slips or yields carries the limiting stress at the full shear rate.
        let cut = carried / pascal;
        let value = scale * cut * size * fluidity;
        let by_stress = if aside == 0.0 {
            (fluidity + stress * slope).copysign(stress)
        } else {
            fluidity * stress / size + size * slope
        };
        (value, value, scale * cut * by_stress)
    }

    /// Returns the heat by compression at a point, divided by 1 + θ.
    fn compression_heat(&self, Flowing { fluid, velocity, aside, .. }: &Flowing, j: usize) -> f64 {
        let expansion = -fluid.density_t[j] / fluid.density[j];
        let [gradient, gradient_y] = self.state.gradient;
        let along = self.state.film * self.laws.heat.compression * expansion * velocity[j] * gradient;
        if gradient_y == 0.0 {
            return along;
        }
        along + self.laws.heat.compression * expansion * aside[j] / fluid.density[j] * gradient_y
    }

    /// Solves the station, starting from its current values, until the step in θ is smaller than `tolerance`.
    pub fn solve(&self, station: &mut Station, from: &Neighbours, tolerance: f64) {
        let across = &*ACROSS;
        let (heat, film) = (self.laws.heat, self.state.film);
        let conduction = heat.conduction / film;
        let mut factor = 1.0;
        (station.steps, station.open) = (0, 0.0);
        let mut flowing = station.flowing;
        let (mut taken, mut before, mut size) = (1.0f64, [0.0; POINTS], 0.0f64);
        loop {
            let theta = station.theta;
            let (curved, sloped) = (apply(&across.curvature, &theta), apply(&across.slope, &theta));
            let mut matrix = [[0.0; POINTS]; POINTS];
            let mut right = [0.0; POINTS];
            let mut fluxes = [[0.0; POINTS]; 2];
            // ∂τ̄_m/∂θ.
            let sheared = &flowing.film;
            let mut stiffness = 0.0;
            let mut answer = across.weights;
            for (k, answer) in answer.iter_mut().enumerate() {
                stiffness += *answer * (sheared.fluidity[k] + sheared.stress[k] * sheared.slope[k]);
                *answer *= sheared.stress[k] * sheared.fluidity[k] * flowing.fluid.log_viscosity_t[k];
            }
            let answer = answer.map(|a| a / stiffness);
            for j in 0..POINTS {
                let flow = flowing.flow[j];
                let (carried, carried_by_own) = from.sides[usize::from(flow < 0.0)].carried(j, flow, theta[j]);
                let beside = from.beside.as_ref().map_or((0.0, 0.0), |beside| {
                    let aside = flowing.aside[j];
                    beside[usize::from(aside < 0.0)].carried(j, aside, theta[j])
                });
                let (carried, carried_by_own) = (carried + beside.0, carried_by_own + beside.1);
                let (shear, shear_by_log, shear_by_stress) = self.shear_heat(&flowing, j);
                let compression = self.compression_heat(&flowing, j);
                let row = &mut matrix[j];
                for k in 0..POINTS {
                    row[k] = -conduction * across.curvature[j][k] - shear_by_stress * answer[k];
                }
                row[j] += carried_by_own - compression + shear_by_log * flowing.fluid.log_viscosity_t[j];
                right[j] = conduction * curved[j] + shear + compression * (1.0 + theta[j]) - carried;
                let per = 1.0 / across.weights[j];
                if j > 0 {
                    let below = per * from.across[j - 1].max(0.0);
                    row[j] += below;
                    row[j - 1] -= below;
                    right[j] -= below * (theta[j] - theta[j - 1]);
                }
                if j + 1 < POINTS {
                    let above = per * from.across[j].min(0.0);
                    row[j] -= above;
                    row[j + 1] += above;
                    right[j] -= above * (theta[j + 1] - theta[j]);
                }
            }
            // Heat flux into a body: conduction to its surface plus the balance of the heat in the adjacent cell.
            for (wall, sign, side) in [(0, 1.0, 0), (POINTS - 1, -1.0, 1)] {
                let (before, own) = from.surfaces[side];
                let cell = across.weights[wall] / heat.conduction;
                station.flux[side] = sign * sloped[wall] / film + cell * right[wall];
                let per_flux = heat.surfaces[side];
                for k in 0..POINTS {
                    let answer = sign * across.slope[wall][k] / film - cell * matrix[wall][k];
                    matrix[wall][k] = -per_flux * own * answer;
                    fluxes[side][k] = answer;
                }
                matrix[wall][wall] += 1.0;
                right[wall] = per_flux * (before + own * station.flux[side]) - theta[wall];
            }
            eliminate(&mut matrix, &mut right);
            let largest = right.iter().fold(0.0f64, |largest, step| largest.max(step.abs()));
            let turned = inner(&right, &before) < 0.0 && largest > SHORTER * size;
            taken = if turned { (0.5 * taken).max(LEAST_SHARE) } else { (2.0 * taken).min(1.0) };
            (before, size) = (right, largest);
            let share = if largest * taken > LARGEST_STEP { LARGEST_STEP / largest } else { taken };
            for (theta, step) in station.theta.iter_mut().zip(&right) {
                *theta += share * step;
            }
            for (flux, answer) in station.flux.iter_mut().zip(&fluxes) {
                *flux += share * inner(answer, &right);
            }
            station.steps += 1;
            if largest < tolerance {
                break;
            }
            if !largest.is_finite() || station.steps >= MOST_STEPS {
                station.open = largest;
                break;
            }
            let stress = flowing.stress + share * inner(&answer, &right);
            flowing = self.flowing(&station.theta, stress, factor);
            let wanted = self.factor(flowing.mobility);
            let moved = (wanted / factor - 1.0).abs();
            // The mobility of a shear-thinning film depends on the factor itself, so that the two may oscillate.
            let follows = taken < 1.0 && self.laws.shear.is_some();
            factor = if follows { factor * (wanted / factor).powf(taken) } else { wanted };
            // The next step is proportional to the square of this one.
            if taken == 1.0 && BEND * largest * largest < tolerance && moved < tolerance.max(1e-3) {
                break;
            }
        }
        station.flowing = flowing;
    }
}

/// Solves a small dense system in place by Gaussian elimination with row pivoting.
fn eliminate(matrix: &mut [Profile; POINTS], right: &mut Profile) {
    for k in 0..POINTS {
        let pivot = (k..POINTS).max_by(|&i, &j| matrix[i][k].abs().total_cmp(&matrix[j][k].abs())).unwrap_or(k);
        matrix.swap(k, pivot);
        right.swap(k, pivot);
        let head = matrix[k];
        let inverse = 1.0 / head[k];
        for i in k + 1..POINTS {
            let factor = matrix[i][k] * inverse;
            if factor != 0.0 {
                for j in k + 1..POINTS {
                    matrix[i][j] -= factor * head[j];
                }
                right[i] -= factor * right[k];
            }
        }
    }
    for k in (0..POINTS).rev() {
        let sum: f64 = (k + 1..POINTS).map(|j| matrix[k][j] * right[j]).sum();
        right[k] = (right[k] - sum) / matrix[k][k];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::full::Problem;
    use crate::solver::physics::contact::{OperatingPoint, Sliding};
    use crate::solver::physics::lubricant::{Heat, Lubricant, OilHeat};

    /// Film without gradients whose viscosity does not depend on temperature, between surfaces of constant temperature.
    fn conducted(lower: f64, upper: f64) -> (Station, Made, f64) {
        let sliding = Sliding { slide_to_roll_ratio: 0.4, newtonian_plateau_ratio: None };
        let point = OperatingPoint { sliding, viscosity_pa_s: 0.02, ..OperatingPoint::TABLE_2_1 };
        let oil = OilHeat { viscosity_temperature: 0.0, density_temperature: 0.0, ..OilHeat::default() };
        let lubricant = Lubricant { heat: Some(Heat { oil, ..Heat::default() }), ..Lubricant::default() };
        let problem = Problem::new(&point, lubricant).unwrap();
        let laws = problem.warm_laws().unwrap();
        let state = NodeState { pressure: 0.2, gradient: [0.0; 2], film: 0.1 };
        let place = Place { laws, limit: None, state, mobility: 0.0, flow_factor: 1.0 };
        let [d_1, d_2] = laws.heat.surfaces;
        let neighbours = Neighbours {
            sides: [Side::default(); 2],
            beside: None,
            across: [0.0; POINTS - 1],
            surfaces: [(lower / d_1, 0.0), (upper / d_2, 0.0)],
        };
        let mut station = Station::default();
        place.evaluate(&mut station);
        place.solve(&mut station, &neighbours, 1e-12);
        // θ″ = −C₂τ̄²f H²/C₁ with τ̄ = (ū₂ − ū₁)/(H f).
        let fluid = laws.heat.fluid.at(0.2, &[0.0]);
        let bend = laws.heat.shear * 0.4 * 0.4 / (fluid.fluidity[0] * laws.heat.conduction);
        (station, place.made(&station), bend)
    }

    #[test]
    fn heat_that_is_only_conducted_makes_a_parabola() {
        for (lower, upper) in [(0.0, 0.0), (0.01, 0.04)] {
            let (station, made, bend) = conducted(lower, upper);
            for (theta, zeta) in station.theta.iter().zip(ACROSS.points) {
                let wanted = lower + (upper - lower) * zeta + 0.5 * bend * zeta * (1.0 - zeta);
                assert!((theta - wanted).abs() < 1e-10 * bend, "{theta} {wanted}");
            }
            assert!(inner(&ACROSS.weights, &made.sheared) > 0.0 && made.compressed == [0.0; POINTS]);
        }
    }

    #[test]
    fn into_the_bodies_goes_what_shear_makes() {
        let (station, _, bend) = conducted(0.01, 0.04);
        // In units of C₁: bend/H.
        assert!(((station.flux[0] + station.flux[1]) * 0.1 / bend - 1.0).abs() < 1e-10);
    }

    #[test]
    fn small_systems_are_solved_exactly() {
        let matrix: [Profile; POINTS] = std::array::from_fn(|i| {
            std::array::from_fn(|j| ((3 * i + 7 * j) % 11) as f64 - if i == j { 0.0 } else { 4.0 })
        });
        let x: Profile = std::array::from_fn(|i| (i as f64).cos());
        let (mut rows, mut right) = (matrix, apply(&matrix, &x));
        eliminate(&mut rows, &mut right);
        assert!(right.iter().zip(&x).all(|(a, b)| (a - b).abs() < 1e-9), "{right:?}");
    }
}
