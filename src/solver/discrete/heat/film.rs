//! Film at one position with a temperature profile across it: shear stress, and the moments that define the node of
//! the Reynolds equation.
//!
//! Symbols (dimensionless): pressure P, film thickness H, height ζ, temperature rise θ, shear stress τ̄, mid-film
//! stress τ̄_m, surface speeds ū₁ and ū₂, density ρ̄, viscosity η.
//!
//! The stress is τ̄ = τ̄_m + κH P_X c with c = ζ − ½, and the fluidity f = η₀/η(P, θ, |τ|). The mid-film stress
//! follows from H∫τ̄f = ū₂ − ū₁. With R = ∫_ζ¹ρ̄, g₀ = ∫f, g₁ = ∫cf, s₀ = ∫fR, s₁ = ∫cfR and r₀ = ∫ρ̄ the mobility is
//! κH³ (s₀g₁/g₀ − s₁) and the flow r₀ū₁ + (ū₂ − ū₁) s₀/g₀. If the density is constant across the film, these are the
//! moments of an isothermal film.

use super::across::{ACROSS, POINTS, Profile, RULE, apply};
use crate::solver::discrete::grid::cubic;
use crate::solver::discrete::reynolds::Node;
use crate::solver::discrete::reynolds::film_integrals::PRODUCTION_RULE;
use crate::solver::discrete::reynolds::generalized::{NodeState, ShearNode};
use crate::solver::physics::lubricant::{Across, Fluidity, ScaledHeat, ScaledShear};

/// Shear-thinning law for stresses in units of η₀u_mR/a².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StressLaw {
    law: Fluidity,
    /// Factor that converts a stress to the law's own scale.
    per_scale: f64,
}

/// Fluidities under stress at points across the film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sheared<const N: usize> {
    /// τ̄ along X, the rolling direction.
    pub stress: [f64; N],
    /// τ̄ along Y.
    pub aside: [f64; N],
    /// f.
    pub fluidity: [f64; N],
    /// ∂f/∂τ̄ along X.
    pub slope: [f64; N],
    /// ∂f/∂τ̄ along Y.
    pub slope_aside: [f64; N],
}

impl<const N: usize> Default for Sheared<N> {
    fn default() -> Self {
        Self { stress: [0.0; N], aside: [0.0; N], fluidity: [0.0; N], slope: [0.0; N], slope_aside: [0.0; N] }
    }
}

/// Driving quantities of a film: κH(P_X, P_Y), the change of stress across it, and (ū₂ − ū₁)/H.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// κH P_X.
    pub along: f64,
    /// κH P_Y.
    pub aside: f64,
    /// (ū₂ − ū₁)/H.
    pub rate: f64,
}

/// Maximum number of iterations for the mid-film stress.
const MOST_ITERATIONS: usize = 40;

/// The iteration ends when the step is smaller than this, relative to the stress.
const LAST_STEP: f64 = 1e-11;

impl StressLaw {
    /// Converts the shear law to the stress scale of a thermal contact.
    pub fn new(shear: &ScaledShear, heat: &ScaledHeat) -> Self {
        Self { law: shear.fluidity, per_scale: heat.stress_scale_pa / shear.stress_scale_pa }
    }
}

impl<const N: usize> Sheared<N> {
    /// Evaluates the film under the stresses τ̄_m + a c along X and b (c − c₀) along Y. `rest` holds the fluidities
    /// without stress.
    fn at(
        law: Option<&StressLaw>,
        rest: &[f64; N],
        offsets: &[f64; N],
        (mid, a): (f64, f64),
        (centre, b): (f64, f64),
    ) -> Self {
        let stress = offsets.map(|c| mid + a * c);
        let mut out = Self { stress, fluidity: *rest, ..Self::default() };
        if b != 0.0 {
            out.aside = offsets.map(|c| b * (c - centre));
        }
        let Some(StressLaw { law, per_scale }) = law else { return out };
        let sizes: [f64; N] = std::array::from_fn(|i| out.size(i));
        let (g, slope) = law.at_all(&sizes.map(|size| size * per_scale));
        for i in 0..N {
            out.fluidity[i] = rest[i] * g[i];
            let (along, aside) = (out.stress[i], out.aside[i]);
            if aside != 0.0 {
                let bend = rest[i] * slope[i] / (sizes[i] * sizes[i]);
                (out.slope[i], out.slope_aside[i]) = (bend * along, bend * aside);
            } else if along != 0.0 {
                out.slope[i] = rest[i] * slope[i] / along;
            }
        }
        out
    }

    /// Returns |τ̄| at point `i`.
    #[inline]
    pub fn size(&self, i: usize) -> f64 {
        let (along, aside) = (self.stress[i], self.aside[i]);
        if aside == 0.0 { along.abs() } else { along.hypot(aside) }
    }

    /// Returns c₀ = ∫cf/∫f, the height at which the stress along Y vanishes: the surfaces do not slide along Y.
    fn centre(&self, (offsets, weights): (&[f64; N], &[f64; N])) -> f64 {
        let (mut g_0, mut g_1) = (0.0, 0.0);
        for i in 0..N {
            g_0 += weights[i] * self.fluidity[i];
            g_1 += weights[i] * offsets[i] * self.fluidity[i];
        }
        g_1 / g_0
    }

    /// Solves for the mid-film stress of a film with the given driving quantities, and returns this stress and the
    /// film. `near` is the initial guess; 0 or a value that is not finite means none.
    pub fn sliding(
        law: Option<&StressLaw>,
        rest: &[f64; N],
        (offsets, weights): (&[f64; N], &[f64; N]),
        Drive { along: a, aside: b, rate }: Drive,
        near: f64,
    ) -> (f64, Self) {
        let sums = |film: &Self| {
            let (mut excess, mut stiffness) = (-rate, 0.0);
            for (i, weight) in weights.iter().enumerate() {
                excess += weight * film.stress[i] * film.fluidity[i];
                stiffness += weight * (film.fluidity[i] + film.stress[i] * film.slope[i]);
            }
            (excess, stiffness)
        };
        let Some(thinning) = law else {
            let resting = Self::at(None, rest, offsets, (0.0, a), (0.0, 0.0));
            let (excess, stiffness) = sums(&resting);
            let mid = -excess / stiffness;
            let centre = if b == 0.0 { 0.0 } else { resting.centre((offsets, weights)) };
            return (mid, Self::at(None, rest, offsets, (mid, a), (centre, b)));
        };
        let mut mid = if near.is_finite() && near != 0.0 {
            near
        } else {
            // Initial guess: the stress of pure sliding.
            let mean: f64 = rest.iter().zip(weights).map(|(f, w)| f * w).sum();
            (thinning.law.stress_near(thinning.per_scale * rate.abs() / mean) / thinning.per_scale).copysign(rate)
        };
        let mut centre = 0.0;
        let mut film = Self::at(law, rest, offsets, (mid, a), (centre, b));
        for _ in 0..MOST_ITERATIONS {
            let (excess, stiffness) = sums(&film);
            let longest = (3.0 / thinning.per_scale).max(0.5 * mid.abs());
            let step = (-excess / stiffness).clamp(-longest, longest);
            mid += step;
            // The stress along Y hardly changes: its zero c₀ is taken from the previous iterate.
            let moved = if b == 0.0 { 0.0 } else { film.centre((offsets, weights)) - centre };
            centre += moved;
            film = Self::at(law, rest, offsets, (mid, a), (centre, b));
            if step.abs() + (b * moved).abs() <= LAST_STEP * (mid.abs() + a.abs() + b.abs()) {
                break;
            }
        }
        (mid, film)
    }
}

/// Returns the offsets c and the weights of the quadrature rule.
fn rule() -> ([f64; RULE], [f64; RULE]) {
    (PRODUCTION_RULE.map(|(c, _)| c), PRODUCTION_RULE.map(|(_, w)| w))
}

/// Laws that make a film with temperatures a node of the Reynolds equation.
#[derive(Clone, Copy, Debug)]
pub struct WarmLaws<'a> {
    /// Heat in the contact.
    pub heat: &'a ScaledHeat,
    /// Shear-thinning law; `None` for a Newtonian lubricant.
    pub shear: Option<StressLaw>,
}

impl WarmLaws<'_> {
    /// Returns the sliding speed ū₂ − ū₁.
    pub fn slip(&self) -> f64 {
        self.heat.speeds[1] - self.heat.speeds[0]
    }

    /// Returns the fluidity η₀/η at P, θ and τ̄.
    pub fn fluidity(&self, pressure: f64, theta: f64, stress: f64) -> f64 {
        let rest = self.heat.fluid.at(pressure, &[theta]).fluidity;
        Sheared::at(self.shear.as_ref(), &rest, &[0.0], (stress, 0.0), (0.0, 0.0)).fluidity[0]
    }

    /// Returns τ̄ at mid-film. `theta` holds θ at the points of the quadrature rule. Returns 0 where the surfaces
    /// overlap (H ≤ 0).
    pub fn mid_stress(&self, state: NodeState, theta: &[f64; RULE]) -> f64 {
        if state.film <= 0.0 {
            return 0.0;
        }
        self.sheared(state, &self.heat.fluid.at(state.pressure, theta).fluidity, 0.0).0
    }

    /// Returns τ̄ at mid-film and the sheared film, given the fluidities without stress and an initial guess of the
    /// stress.
    fn sheared(&self, state: NodeState, rest: &[f64; RULE], near: f64) -> (f64, Sheared<RULE>) {
        let NodeState { gradient, film, .. } = state;
        let (offsets, weights) = rule();
        let [along, aside] = gradient.map(|slope| self.heat.gradient * film * slope);
        let drive = Drive { along, aside, rate: self.slip() / film };
        Sheared::sliding(self.shear.as_ref(), rest, (&offsets, &weights), drive, near)
    }

    /// Evaluates the node with its derivatives. `theta` holds θ at the points of the quadrature rule. `stress` is the
    /// initial guess of the mid-film stress on entry and the solution on return.
    pub fn node(&self, state: NodeState, theta: &[f64; RULE], stress: &mut f64) -> ShearNode {
        let NodeState { pressure, gradient: [gradient, gradient_y], film } = state;
        let kappa = self.heat.gradient;
        let fluid = self.heat.fluid.at(pressure, theta);
        if film <= 0.0 {
            // Overlapping surfaces occur only in intermediate iterates. They are treated as in an isothermal film.
            return ShearNode { node: overlapping(&fluid, kappa / 12.0, pressure, film), ..ShearNode::default() };
        }
        let (offsets, weights) = rule();
        let rate = self.slip() / film;
        let (mid, sheared) = self.sheared(state, &fluid.fluidity, *stress);
        *stress = mid;
        let (rest, rest_p) =
            (apply(&ACROSS.rest_on_rule, &fluid.density), apply(&ACROSS.rest_on_rule, &fluid.density_p));
        // Moments g₀, g₁, s₀, s₁ with their derivatives by τ̄_m, a and P; the other two are held constant each time.
        let (mut value, mut by_stress, mut by_a, mut by_p) = ([0.0; 4], [0.0; 4], [0.0; 4], [0.0; 4]);
        let (mut density, mut density_p) = (0.0, 0.0);
        let (mut stiffness, mut across, mut excess_p) = (0.0, 0.0, 0.0);
        // Derivatives by b at constant c₀, and the contribution of b to the sliding.
        let (mut by_b, mut excess_b) = ([0.0; 4], 0.0);
        let aside = if gradient_y == 0.0 { 0.0 } else { sheared.centre((&offsets, &weights)) };
        for i in 0..RULE {
            let (w, c, f, slope) = (weights[i], offsets[i], sheared.fluidity[i], sheared.slope[i]);
            let f_p = -f * fluid.log_viscosity_p[i];
            density += w * fluid.density[i];
            density_p += w * fluid.density_p[i];
            let answer = w * (f + sheared.stress[i] * slope);
            stiffness += answer;
            across += c * answer;
            excess_p += w * sheared.stress[i] * f_p;
            let kinds = [1.0, c, rest[i], c * rest[i]];
            let kinds_p = [0.0, 0.0, rest_p[i], c * rest_p[i]];
            for k in 0..4 {
                value[k] += w * f * kinds[k];
                by_stress[k] += w * slope * kinds[k];
                by_a[k] += w * c * slope * kinds[k];
                by_p[k] += w * (f_p * kinds[k] + f * kinds_p[k]);
            }
            if gradient_y != 0.0 {
                let answer = w * (c - aside) * sheared.slope_aside[i];
                excess_b += sheared.stress[i] * answer;
                by_b.iter_mut().zip(kinds).for_each(|(sum, kind)| *sum += answer * kind);
            }
        }
        // Add the derivatives through the mid-film stress.
        let (stress_a, stress_p, stress_rate) = (-across / stiffness, -excess_p / stiffness, 1.0 / stiffness);
        let [g_0, g_1, s_0, s_1] = value;
        let shift = g_1 / g_0;
        let (moment, carried) = (shift * s_0 - s_1, s_0 / g_0);
        // Derivatives of `moment` and `carried`, from those of g₀, g₁, s₀, s₁.
        let chain =
            |d: [f64; 4]| [(d[1] - shift * d[0]) / g_0 * s_0 + shift * d[2] - d[3], (d[2] - carried * d[0]) / g_0];
        let [of_stress, of_a, of_p] = [by_stress, by_a, by_p].map(chain);
        let total = |direct: [f64; 2], through: f64| [0, 1].map(|k| direct[k] + through * of_stress[k]);
        let by_a = total(of_a, stress_a);
        let by_p = total(of_p, stress_p);
        let by_b = if gradient_y == 0.0 { [0.0; 2] } else { total(chain(by_b), -excess_b / stiffness) };
        let (a_h, a_x, b_h) = (kappa * gradient, kappa * film, kappa * gradient_y);
        let by_h = [0, 1].map(|k| by_a[k] * a_h + by_b[k] * b_h - stress_rate * of_stress[k] * rate / film);
        let (slip, square) = (self.slip(), kappa * film * film);
        let flow = density * self.heat.speeds[0] + slip * carried;
        ShearNode {
            node: Node {
                pressure,
                flow: film * flow,
                flow_p: film * (density_p * self.heat.speeds[0] + slip * by_p[1]),
                flow_h: flow + film * slip * by_h[1],
                mobility: square * film * moment,
                mobility_p: square * film * by_p[0],
                mobility_h: square * (3.0 * moment + film * by_h[0]),
            },
            flow_gradient: [by_a, by_b].map(|by| film * slip * by[1] * a_x),
            mobility_gradient: [by_a, by_b].map(|by| square * film * by[0] * a_x),
            ..ShearNode::default()
        }
    }
}

/// Returns the node of a film without shear-thinning, at the mean of its temperatures.
fn overlapping(fluid: &Across<RULE>, inverse_lambda: f64, pressure: f64, film: f64) -> Node {
    let middle = RULE / 2;
    let per_cube = fluid.density[middle] * fluid.fluidity[middle] * inverse_lambda;
    let mobility = per_cube * film.powi(3);
    let slope = fluid.density_p[middle] / fluid.density[middle] - fluid.log_viscosity_p[middle];
    Node {
        pressure,
        flow: fluid.density[middle] * film,
        flow_p: fluid.density_p[middle] * film,
        flow_h: fluid.density[middle],
        mobility,
        mobility_p: mobility * slope,
        mobility_h: 3.0 * per_cube * film * film,
    }
}

/// Temperatures at every node of a contact, with the last mid-film stress at each node.
#[derive(Clone, Debug, Default)]
pub struct WarmFilm {
    /// θ at the points of the quadrature rule.
    pub theta: Vec<[f64; RULE]>,
    /// τ̄_m.
    pub stress: Vec<f64>,
}

impl WarmFilm {
    /// Interpolates θ from stations to nodes, cubically along X. Both abscissae increase; nodes before the first
    /// station take its value.
    pub fn spread(&mut self, nodes: &[f64], stations: &[f64], theta: impl Fn(usize) -> Profile) {
        self.spread_lines(nodes, stations, 1, |_, station| theta(station));
    }

    /// Does the same for several lines along X, whose nodes are adjacent in the arrays. `theta` receives the line and
    /// the station.
    pub fn spread_lines(
        &mut self,
        nodes: &[f64],
        stations: &[f64],
        lines: usize,
        theta: impl Fn(usize, usize) -> Profile,
    ) {
        self.theta.clear();
        for x in nodes {
            let (first, weights) = cubic(stations, x.max(stations[0]));
            self.theta.extend((0..lines).map(|line| {
                let mut here = [0.0; POINTS];
                for (k, weight) in weights.into_iter().enumerate() {
                    for (sum, own) in here.iter_mut().zip(theta(line, first + k)) {
                        *sum += weight * own;
                    }
                }
                apply(&ACROSS.to_rule, &here)
            }));
        }
        self.stress.resize(self.theta.len(), 0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::discrete::reynolds::generalized::FilmTreatment;
    use crate::solver::full::Problem;
    use crate::solver::physics::contact::{OperatingPoint, Sliding};
    use crate::solver::physics::lubricant::{Heat, Lubricant, ShearLaw};

    fn problems() -> Vec<Problem> {
        let sliding = Sliding { slide_to_roll_ratio: 0.4, newtonian_plateau_ratio: None };
        let point = OperatingPoint { sliding, viscosity_pa_s: 0.02, ..OperatingPoint::TABLE_2_1 };
        let laws = [
            ShearLaw::Newtonian,
            ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 },
            ShearLaw::Carreau { critical_stress: 1e4, beta: 2.198, n: 0.8, npr: 0.2227 },
        ];
        let problem = |shear| {
            Problem::new(&point, Lubricant { shear, heat: Some(Heat::default()), ..Lubricant::default() }).unwrap()
        };
        laws.map(problem).to_vec()
    }

    fn laws(problem: &Problem) -> WarmLaws<'_> {
        problem.warm_laws().unwrap()
    }

    const STATE: NodeState = NodeState { pressure: 0.3, gradient: [0.8, 0.0], film: 0.12 };

    #[test]
    fn no_temperature_rise_gives_the_isothermal_node() {
        for problem in problems() {
            let warm = laws(&problem).node(STATE, &[0.0; RULE], &mut 0.0);
            let (fluid, lambda) = (&problem.fluid, problem.inverse_lambda);
            let cold = match &problem.shear {
                Some(shear) => ShearNode::new(fluid, shear, lambda, STATE, FilmTreatment::default()),
                None => {
                    let node = Node::new(fluid, lambda, STATE.pressure, STATE.film);
                    ShearNode { node, ..ShearNode::default() }
                }
            };
            for (warm, cold) in [
                (warm.node.flow, cold.node.flow),
                (warm.node.flow_p, cold.node.flow_p),
                (warm.node.flow_h, cold.node.flow_h),
                (warm.node.mobility, cold.node.mobility),
                (warm.node.mobility_p, cold.node.mobility_p),
                (warm.node.mobility_h, cold.node.mobility_h),
                (warm.flow_gradient[0], cold.flow_gradient[0]),
                (warm.mobility_gradient[0], cold.mobility_gradient[0]),
            ] {
                assert!((warm - cold).abs() <= 1e-10 * cold.abs() + 1e-16, "{:?}: {warm} {cold}", problem.shear);
            }
        }
    }

    #[test]
    fn derivatives_agree_with_finite_differences() {
        let theta: [f64; RULE] = std::array::from_fn(|i| 0.02 + 0.03 * (i as f64 * 0.7).sin());
        for problem in problems() {
            let node = |p: f64, x: f64, h: f64| {
                let state = NodeState { pressure: STATE.pressure + p, gradient: [0.8 + x, 0.0], film: 0.12 + h };
                laws(&problem).node(state, &theta, &mut 0.0)
            };
            let exact = node(0.0, 0.0, 0.0);
            let step = 1e-6;
            let slopes = |ahead: ShearNode, behind: ShearNode| {
                let per = 0.5 / step;
                [(ahead.node.flow - behind.node.flow) * per, (ahead.node.mobility - behind.node.mobility) * per]
            };
            for (found, exact) in [
                (slopes(node(step, 0.0, 0.0), node(-step, 0.0, 0.0)), [exact.node.flow_p, exact.node.mobility_p]),
                (slopes(node(0.0, 0.0, step), node(0.0, 0.0, -step)), [exact.node.flow_h, exact.node.mobility_h]),
                (
                    slopes(node(0.0, step, 0.0), node(0.0, -step, 0.0)),
                    [exact.flow_gradient[0], exact.mobility_gradient[0]],
                ),
            ] {
                for k in 0..2 {
                    let size = exact[k].abs().max(1e-6);
                    assert!((found[k] - exact[k]).abs() < 1e-5 * size, "{:?}: {found:?} {exact:?}", problem.shear);
                }
            }
        }
    }
}
