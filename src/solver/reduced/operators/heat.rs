//! Contacts with heat on reduced operators: Newton's steps for (p̃, H₀) with the temperatures held, and marches of the
//! temperatures along every few nodes of a line, or of a few lines of a plane, with pressure and film held, in turns.
//! Temperatures need no basis.

use super::support::Place;
use crate::solver::discrete::grid::{ContactGrid, INLET, stretched};
use crate::solver::discrete::heat::{ACROSS, Lines, MovingSource, Profile, RULE, Spread, WarmFilm, apply};
use crate::solver::discrete::reynolds::generalized::NodeState;
use crate::solver::full::Problem;
use crate::solver::full::heat::{Mixing, Rises, one_sided};
use crate::solver::physics::contact::ContactKind;
use crate::solver::reduced::warmth::Warmth;
use std::sync::Arc;

/// Stations along a line contact, at least. With 90 of them tractions of fast contacts that hardly slide are off by 1.5 %.
const STATIONS: usize = 120;

/// Least distance of stations along the lines of a plane: in the contact, and over −X in front of it. With 0.075, or with
/// seven lines, contacts take two thirds of the time, and films of the hottest ones are off by more than 1 %.
const SPACING: f64 = 0.055;
/// Where it ends, and the distance behind that.
const BEHIND: f64 = 1.15;
const SPACING_BEHIND: f64 = 0.15;

/// −Y of the lines of a plane that are marched, or of the nearest lines of its grid.
const ORDINATES: [f64; 11] = [1.5, 1.2, 1.05, 0.95, 0.85, 0.75, 0.62, 0.48, 0.32, 0.16, 0.0];

/// Pressures behind X = 0 up to which the film of a plane counts as ruptured where its traction is summed up: what modes leave
/// there is no more. In light contacts, whose films hardly thicken under pressure, it would add 1 % to that.
const LEFT: f64 = 1e-4;

/// The nodes of a grid at which temperatures are marched.
pub(crate) struct Stations {
    /// Columns of nodes, from the inlet to the outlet.
    columns: Vec<usize>,
    /// Lines along X, from the edge of a plane to its axis.
    lines: Vec<usize>,
    /// Nodes across.
    across: usize,
}

impl Stations {
    /// Of a grid.
    pub fn of(grid: &ContactGrid) -> Self {
        let ((xi, y), across) = (grid.abscissae(), grid.nodes().1);
        if grid.kind() == ContactKind::Line {
            return Self { columns: along_line(grid.len()), lines: vec![0], across };
        }
        let nearest =
            |wanted: f64| (0..across).min_by(|&a, &b| (y[a] + wanted).abs().total_cmp(&(y[b] + wanted).abs()));
        let mut lines: Vec<usize> = ORDINATES.into_iter().filter_map(nearest).collect();
        lines.dedup();
        Self { columns: along_plane(xi), lines, across }
    }

    /// Abscissae ξ of the columns.
    pub fn xi(&self, grid: &ContactGrid) -> Vec<f64> {
        self.columns.iter().map(|&column| grid.abscissae().0[column]).collect()
    }

    /// Ordinates of the lines in units of a.
    pub fn y(&self, grid: &ContactGrid) -> Vec<f64> {
        self.lines.iter().map(|&line| grid.abscissae().1[line]).collect()
    }

    /// Of each line the nodes at its stations.
    pub fn nodes(&self) -> impl Iterator<Item = Vec<usize>> + '_ {
        self.lines.iter().map(|line| self.columns.iter().map(|column| column * self.across + line).collect())
    }

    /// Of each line the first three nodes: at the inlet the slope is one-sided.
    pub fn inlets(&self) -> impl Iterator<Item = [usize; 3]> + '_ {
        let first = self.columns.first().copied().unwrap_or_default();
        self.lines.iter().map(move |line| [0, 1, 2].map(|k| (first + k) * self.across + line))
    }
}

/// Of a line contact, every so many of its nodes from the inlet to the outlet.
fn along_line(nodes: usize) -> Vec<usize> {
    let last = nodes - 1;
    let stride = ((last - INLET) / STATIONS).max(1);
    (INLET..last).step_by(stride).filter(|node| last - node >= stride).chain([last]).collect()
}

/// Of a plane, columns some distance apart.
fn along_plane(xi: &[f64]) -> Vec<usize> {
    let (mut out, mut last) = (vec![0], xi[0]);
    for (column, &xi) in xi.iter().enumerate().take(xi.len() - 1) {
        let apart = if xi < BEHIND { SPACING * (-xi).max(1.0) } else { SPACING_BEHIND };
        // Spacings add up to no more than they are.
        if xi - last >= apart * (1.0 - 1e-9) {
            out.push(column);
            last = xi;
        }
    }
    out.push(xi.len() - 1);
    out
}

/// P at X as the traction with heat counts it.
pub(crate) fn carried(kind: ContactKind, x: f64, pressure: f64) -> f64 {
    if kind == ContactKind::Point && x > 0.0 && pressure <= LEFT { 0.0 } else { pressure }
}

/// Nodes that the rows of a contact with heat depend on beside their own.
pub(super) fn further_nodes(grid: &ContactGrid) -> Vec<usize> {
    let stations = Stations::of(grid);
    stations.nodes().flatten().chain(stations.inlets().flatten()).collect()
}

/// Where one line has its states from.
struct Looked {
    /// Places of its stations in the support, and of its first three nodes.
    stations: Vec<usize>,
    inlet: [usize; 3],
}

/// How some nodes have their temperatures from the lines that are marched.
pub(super) struct Interpolation {
    /// (ξ, Y) of the nodes.
    places: Vec<(f64, f64)>,
    /// The scale of the last contact, and where values come from at that one.
    scale: f64,
    spread: Spread,
}

impl Interpolation {
    /// Of nodes at these (ξ, Y).
    pub fn new(places: impl Iterator<Item = (f64, f64)>) -> Self {
        Self { places: places.collect(), scale: f64::NAN, spread: Spread::default() }
    }

    /// Finds out where values come from at a scale: line contacts alone are stretched.
    fn follow(&mut self, lines: &Lines, ordinates: &[f64], scale: f64) {
        if self.scale != scale {
            let places = self.places.iter().map(|&(xi, y)| (stretched(xi, scale), y));
            (self.scale, self.spread) = (scale, Spread::new(lines.x(), ordinates, places));
        }
    }

    /// θ at the nodes, at the points of the rule across the film.
    fn theta<'a>(&'a self, lines: &'a Lines) -> impl Iterator<Item = [f64; RULE]> + 'a {
        self.spread.profiles(lines).map(|profile| apply(&ACROSS.to_rule, &profile))
    }
}

/// Temperatures in reduced operators, and what marches them.
pub(super) struct Heated {
    looked: Vec<Looked>,
    /// ξ of the stations, and Y of the lines in units of b.
    reference: Vec<f64>,
    ordinates: Vec<f64>,
    pub(super) lines: Lines,
    /// X of the support.
    x: Vec<f64>,
    /// Places in the support at which rows want a film.
    films: Vec<usize>,
    /// How these have their temperatures, and the film's temperatures on the support.
    interpolation: Interpolation,
    film: WarmFilm,
    pub(super) mixing: Mixing,
    /// p̃, H₀ and θ before a turn and after it.
    pub(super) from: Vec<f64>,
    image: Vec<f64>,
}

impl Heated {
    /// With films wanted at some places of a support.
    pub fn new(grid: &ContactGrid, support: &[Place], films: Vec<usize>) -> Self {
        let place = |node: usize| support.partition_point(|place| place.node < node);
        let stations = Stations::of(grid);
        let looked = stations
            .nodes()
            .zip(stations.inlets())
            .map(|(nodes, inlet)| Looked { stations: nodes.into_iter().map(place).collect(), inlet: inlet.map(place) });
        let (reference, y) = (stations.xi(grid), stations.y(grid));
        let interpolation = Interpolation::new(films.iter().map(|&k| grid.place(support[k].node)));
        let film = WarmFilm { theta: vec![[0.0; RULE]; support.len()], stress: vec![0.0; support.len()] };
        Self {
            looked: looked.collect(),
            lines: Lines::new(y.clone(), &reference, &Arc::new(MovingSource::new(&reference))),
            reference,
            ordinates: y,
            x: vec![0.0; support.len()],
            films,
            interpolation,
            film,
            mixing: Mixing::default(),
            from: Vec::new(),
            image: Vec::new(),
        }
    }

    /// The film with its temperatures, at the support, and the places at which it is wanted.
    pub fn film(&mut self) -> (&mut WarmFilm, &[usize]) {
        (&mut self.film, &self.films)
    }

    /// θ of the last turns at other nodes than the rows', at the points of the rule across the film.
    pub fn theta_at<'a>(
        &'a self,
        interpolation: &'a mut Interpolation,
        scale: f64,
    ) -> impl Iterator<Item = [f64; RULE]> + 'a {
        interpolation.follow(&self.lines, &self.ordinates, scale);
        interpolation.theta(&self.lines)
    }

    /// Puts the lines as far apart as those of an ellipse lie.
    pub fn across_by(&mut self, kappa: f64) {
        self.lines.y.iter_mut().zip(&self.ordinates).for_each(|(y, own)| *y = kappa * own);
    }

    /// Begins a contact at a scale, at given temperatures where there are any.
    pub(super) fn begin(&mut self, support: &[Place], scale: f64, theta: &[Profile]) {
        for line in &mut self.lines.lines {
            line.march.begin(&self.reference, scale);
        }
        for (station, theta) in self.lines.stations_mut().zip(theta) {
            station.theta = *theta;
        }
        for (x, place) in self.x.iter_mut().zip(support) {
            *x = stretched(place.xi, scale);
        }
        self.interpolation.follow(&self.lines, &self.ordinates, scale);
        self.film.stress.fill(0.0);
        self.mixing.begin();
    }

    /// P, its gradient and H at the stations, from P, K P, P_ξ and P_Y on the support and the films there.
    pub(super) fn look(&mut self, fields: &[f64], films: &[f64], scale: f64) {
        let count = films.len();
        for (line, looked) in self.lines.lines.iter_mut().zip(&self.looked) {
            for (state, &k) in line.states.iter_mut().zip(&looked.stations) {
                let gradient = [fields[2 * count + k] / scale, fields.get(3 * count + k).copied().unwrap_or(0.0)];
                *state = NodeState { pressure: fields[k], gradient, film: films[k] };
            }
            let [x, pressure] = [&self.x, fields].map(|values| looked.inlet.map(|k| values[k]));
            if let Some(first) = line.states.first_mut() {
                // At the inlet the node outside knows nothing of the pressure.
                first.gradient[0] = one_sided(&x, pressure);
            }
        }
    }

    /// Marches once and takes a share of the change; returns the largest one.
    pub(super) fn march(&mut self, problem: &Problem, share: f64, tolerance: f64) -> f64 {
        let Some(course) = problem.course(&[]) else { return f64::NAN };
        let changed = self.lines.march(&course, (share, tolerance), false);
        for (&k, theta) in self.films.iter().zip(self.interpolation.theta(&self.lines)) {
            self.film.theta[k] = theta;
        }
        changed
    }

    pub(super) fn state(lines: &Lines, (coefficients, h_0): (&[f64], f64), out: &mut Vec<f64>) {
        out.clear();
        out.extend_from_slice(coefficients);
        out.push(h_0);
        out.extend(lines.stations().flat_map(|station| station.theta));
    }

    /// Mixes the state that a turn led to with those before it.
    pub(super) fn mix(&mut self, coefficients: &mut [f64], h_0: &mut f64) {
        Self::state(&self.lines, (coefficients, *h_0), &mut self.image);
        self.mixing.improve(&self.from, &mut self.image);
        let (mixed, rest) = self.image.split_at(coefficients.len());
        coefficients.copy_from_slice(mixed);
        *h_0 = rest[0];
        self.lines.put(&rest[1..]);
    }

    pub(super) fn warmth(&self, inlet_k: f64) -> Warmth {
        let theta = self.lines.stations().map(|station| station.theta).collect();
        Warmth { theta, central: Rises::central(&self.lines, inlet_k) }
    }
}
