//! Selection of a sufficient grid for a contact before it is solved.
//!
//! Two lengths determine the grid. The inlet must begin where the pressure of an endless film is negligible. The
//! spacing must resolve the zone in front of the Hertzian contact in which the film thickness falls from twice to
//! once its central value; its length is t = (1.06 H_c)^(2/3). H_c is the central film thickness.
//!
//! The errors of H_c are fits to the discretisation errors of full solutions ([`GridCost`]). The second-order term is
//! (ΔX/t)² for line and point contacts alike. An inlet at X₀ lacks the pressure and the load of the half-Sommerfeld
//! tail, λ̄/|X₀|³, and for a point contact also that beyond the sides. For an elliptical contact the tail λ̄|X|/((3 +
//! 2R_x/R_y)H²) is integrated along both ends.
//!
//! [`GridCost`]: crate::solver::full::GridCost

use super::contact::GridSpec;
use super::error::GridError;
use super::line::{LONGEST_INLET, LONGEST_OUTLET, MAX_GRADED_NODES, explorer_cells, registration_scale};
use super::point::PointGridSpec;
use crate::solver::physics::contact::{Ellipse, FilmShape, Moes, OperatingPoint};
use std::f64::consts::PI;

/// Accepted relative error of H_c due to the end of the inlet.
const TRUNCATION: f64 = 0.035;
/// Accepted relative error of H_c due to the spacing.
const RESOLUTION: f64 = 0.02;
/// Accepted error of a grid whose solution is only an initial guess for another one.
const ROUGH: f64 = 0.08;
/// Minimum number of nodes along X of such a grid.
const FEWEST_ROUGH: usize = 150;
/// Length of the inlet zone below which the side lobes are narrower than those of [`PointGridSpec::EXPLORER`], and
/// their spacing across relative to it. The error of H_min is the square of the latter in isoviscous films, and about
/// three times that in piezoviscous ones.
const THIN_ZONE: f64 = 0.055;
const LOBE: f64 = 0.12;
/// Maximum error of a graded grid due to its number of nodes or its inlet, if a better grid is available.
const GRADED: f64 = 0.012;
/// Spacing in front of the contact of [`GridSpec::EXPLORER`].
const EXPLORER_SPACING: f64 = 6e-4;
/// Maximum refinement along X of a point contact's grid relative to its initial grid.
const FINEST: f64 = 16.0;
/// Accepted domain-truncation error of an elliptical contact at the initial spacing. At wider spacings it is
/// [`TRUNCATION`].
const UNCOARSENED: f64 = 0.02;
/// Maximum factor by which the number of cells may grow to extend an elliptical contact's domain.
const MOST_CELLS: f64 = 5.0;

/// Extent of a domain whose pressure continues beyond its ends, in lengths √(2H_c) of the film. There the contact's
/// contribution to the far field has fallen to 8⁻³ of it.
const FILM_LENGTHS: f64 = 8.0;

/// Load number M beyond which no film extends too far.
const HEAVIEST: f64 = 1e3;

/// α p_H up to which Moes' formula is accurate enough for the choice of a grid.
const STIFF: f64 = 50.0;

/// Quantities that determine the choice of a grid.
struct Fit {
    shape: FilmShape,
    moes: Moes,
    /// Contact ellipse; a circle for a line contact.
    ellipse: Ellipse,
    /// λ̄ of (2.23).
    lambda: f64,
    /// Piezoviscous parameter α p_H.
    alpha_hertz: f64,
    /// Length t of the inlet zone.
    zone: f64,
    /// Length √(2H_c) in which the gap grows to twice its minimum.
    width: f64,
    /// −d ln h/d ln M, sensitivity of the film thickness to the load: nearly zero in the elastic regimes, 1 or 2 in
    /// the rigid ones.
    by_load: f64,
}

impl Fit {
    fn of(point: &OperatingPoint) -> Self {
        Self::new(FilmShape::of(point), point.moes(), point.ellipse())
    }

    fn line(moes: Moes) -> Self {
        Self::new(FilmShape::Line, moes, Ellipse::CIRCLE)
    }

    fn new(shape: FilmShape, moes: Moes, ellipse: Ellipse) -> Self {
        let Moes { m, l } = moes;
        let (lambda, alpha_hertz, film) = match shape {
            FilmShape::Line => {
                let scale = PI / (8.0 * m);
                (3.0 * PI * PI / (8.0 * m * m), l * (m / (2.0 * PI)).sqrt(), scale)
            }
            // (h/R)(2U)^(−1/2), over a²/R² = (3M/2)^(2/3) (2U)^(1/2).
            FilmShape::CIRCLE => (
                (128.0 * PI.powi(3) / (3.0 * m.powi(4))).cbrt(),
                l * (1.5 * m / PI.powi(3)).cbrt(),
                (1.5 * m).powf(-2.0 / 3.0),
            ),
            // The same with a³/R³ = (3J_x/π) M (2U)^¾ and p_H = 3w/(2πκa²).
            FilmShape::Ellipse(_) => {
                let axis = (3.0 * ellipse.integral * m / PI).cbrt();
                let lambda = 4.0 * PI * ellipse.kappa / (m * axis);
                (lambda, l * 1.5 * m / (PI * ellipse.kappa * axis * axis), axis.powi(-2))
            }
        };
        // At pressures far beyond those of real contacts, Moes' film thickness is too large, because the viscosity
        // rises less than by Barus' law.
        let stiff = (STIFF / alpha_hertz).min(1.0).powf(0.25);
        let zone = stiff * (1.06 * film * shape.film(moes)).powf(2.0 / 3.0);
        let thickness = |m: f64| shape.film(Moes { m, l });
        let by_load = (thickness(0.95 * m) / thickness(1.05 * m)).ln() / f64::ln(1.05 / 0.95);
        let width = (2.0 * film * thickness(m)).sqrt();
        Self { shape, moes, ellipse, lambda, alpha_hertz, zone, width, by_load: by_load.max(0.0) }
    }

    /// Returns the error due to an inlet at X = −`reach`.
    fn truncation(&self, reach: f64) -> f64 {
        let Self { lambda, alpha_hertz, .. } = self;
        match self.shape {
            FilmShape::Line => lambda * (4.0 / 3.0 * alpha_hertz / reach + 0.42) / (reach * reach),
            // The sides are always half as far.
            FilmShape::CIRCLE => lambda * (0.8 * alpha_hertz / reach.powi(3) + 1.2 * self.by_load / reach),
            FilmShape::Ellipse(_) => self.ends(reach, 0.5 * reach).iter().sum(),
        }
    }

    /// Returns the errors due to the inlet at X = −`reach` and due to the sides at Y = ±`side` of an elliptical
    /// contact's domain.
    fn ends(&self, reach: f64, side: f64) -> [f64; 2] {
        let curvature = self.ellipse.gap_curvature();
        // P X² R⁴/|X|³ of the tail, and the part of ∮P x·n along the ends that is load; the total load is 2π/3.
        let tail = 4.0 * self.lambda / self.shape.far_field_factor();
        let share = 1.5 / PI * self.by_load;
        let (square, edge, root) = (reach * reach, curvature * side * side, curvature.sqrt());
        let across = side / (square * (square + edge)) + (side * root / reach).atan() / (reach.powi(3) * root);
        let beside = 2.0 * side * (1.0 / edge - 1.0 / (square + edge));
        // The sides of a narrow ellipse are nearer to its centre than the inlet is.
        let narrow = 0.6 * (1.0 - self.ellipse.kappa.powi(2)).max(0.0) / (1.0 + edge).powi(2);
        [
            tail * (self.alpha_hertz / reach.powi(3) + share * square * across),
            tail * (self.alpha_hertz * narrow + share * beside),
        ]
    }

    /// Returns the inlet position, as −X, at which the end of the domain causes at most the error `share` of H_c. The
    /// result hardly exceeds the longest inlet.
    fn reach(&self, share: f64) -> f64 {
        let mut reach = 2.0;
        while self.truncation(reach) > share && reach < LONGEST_INLET {
            reach *= 1.25;
        }
        reach
    }

    /// Returns the error due to a spacing in front of the contact.
    fn resolution(&self, spacing: f64) -> f64 {
        (spacing / self.zone).powi(2)
    }

    /// Returns the error due to a spacing in a thick film.
    fn coarse(&self, spacing: f64) -> f64 {
        2.1 * (spacing / self.width).powi(2)
    }

    /// Creates the error for a film that does not fit into any extension of `grid`.
    fn too_wide(&self, grid: PointGridSpec) -> GridError {
        let Moes { m, l } = self.moes;
        let holds = |m: &f64| grid.domain_for(&Self::new(self.shape, Moes { m: *m, l }, self.ellipse)).is_some();
        let lowest = std::iter::successors(Some(m), |m| Some(1.02 * m)).take_while(|m| *m < HEAVIEST).find(holds);
        let own = match self.reach(TRUNCATION) {
            reach if reach < LONGEST_INLET => {
                format!("a grid of your own that reaches X = {:.0} and Y = {:.0} does", -reach, -0.5 * reach)
            }
            _ => format!("no grid that ends before X = -{LONGEST_INLET} does"),
        };
        let accepted = lowest.map_or_else(String::new, |m| format!("at this L they hold it from M = {m:.2} on, and "));
        GridError::Refused(format!(
            "the film at M = {m:.4}, L = {l:.4} reaches too far: so much of its load lies far from the contact that the \
             program's own grids do not hold it; {accepted}{own}"
        ))
    }

    fn too_thin(&self) -> GridError {
        let Moes { m, l } = self.moes;
        let spacing = self.zone * RESOLUTION.sqrt();
        GridError::Refused(format!(
            "the film at M = {m:.4}, L = {l:.4} is too thin: the zone in front of the contact wants a spacing of \
             {spacing:.1e}, finer than the program's own grids are; a smaller M or a larger L is accepted, or a grid \
             of your own with that spacing"
        ))
    }
}

/// Returns the inlet position of a contact, as −X, and the spacing in front of it, each for an error of 1 % of H_c.
pub fn that_would_do(point: &OperatingPoint) -> (f64, f64) {
    let fit = Fit::of(point);
    (fit.reach(0.01), 0.1 * fit.zone)
}

impl GridSpec {
    /// True if a uniform grid is sufficient for a contact.
    pub fn does(&self, moes: Moes) -> bool {
        let fit = Fit::line(moes);
        match *self {
            Self::Uniform { dx, domain } => fit.truncation(-domain.0) <= TRUNCATION && fit.resolution(dx) <= RESOLUTION,
            Self::Graded { .. } | Self::Following { .. } | Self::Plane(_) => false,
        }
    }

    /// Returns the explorer's grid for a line contact: [`GridSpec::EXPLORER`] if it is sufficient, otherwise one with
    /// a longer domain, by powers of two, or with more nodes.
    ///
    /// # Errors
    /// If no such grid resolves the film.
    fn line_for(moes: Moes) -> Result<Self, GridError> {
        let Self::Graded { nodes, domain, registered } = Self::EXPLORER else { return Ok(Self::EXPLORER) };
        let fit = Fit::line(moes);
        let reach = |times: f64| (times * -domain.0 - 1.0) * registration_scale(moes) + 1.0;
        let mut times = 1.0;
        while fit.truncation(reach(times)) > GRADED && 2.0 * times * -domain.0 < LONGEST_INLET {
            times *= 2.0;
        }
        let domain = (times * domain.0, times * domain.1);
        let cells = if times > 1.0 { explorer_cells(domain) } else { nodes - 1 } as f64;
        let most = (MAX_GRADED_NODES - 1) as f64 / cells;
        let wanted = (fit.resolution(EXPLORER_SPACING) / GRADED).sqrt().max(1.0).log2().ceil().exp2();
        let finer = wanted.min(most);
        if fit.resolution(EXPLORER_SPACING / finer) > RESOLUTION {
            let following = Self::Following { zone: fit.zone, finer: 1.0, domain };
            return following.check().map(|()| following).map_err(|_| fit.too_thin());
        }
        Ok(Self::Graded { nodes: (cells * finer).floor() as usize + 1, domain, registered })
    }
}

impl PointGridSpec {
    /// Returns this grid for a point contact: unchanged if it is sufficient, otherwise with a larger domain or finer
    /// along X. The grid of a circular contact keeps its number of nodes except for thick films. That of an
    /// elliptical contact keeps its spacing.
    ///
    /// # Errors
    /// If no such grid resolves the film.
    pub fn for_contact(self, point: &OperatingPoint) -> Result<Self, GridError> {
        let fit = Fit::of(point);
        let Some(Stretched { domain, times, cells }) = self.domain_for(&fit) else {
            return self.continued_for(&fit).ok_or_else(|| fit.too_wide(self));
        };
        let mut finer = 1.0;
        while fit.resolution(self.dx * times / finer) > RESOLUTION {
            if finer >= FINEST {
                return Err(fit.too_thin());
            }
            // 1, 2, 4, 5, 6 …
            finer = if finer < 4.0 { 2.0 * finer } else { finer + 1.0 };
        }
        let dy = self.dy * times / cells;
        let refinement = match dy / (LOBE * fit.zone) {
            wanted if fit.zone < THIN_ZONE && wanted > self.refinement => wanted,
            _ => self.refinement,
        };
        Ok(Self { dx: self.dx * times / f64::max(finer, cells), dy, domain, refinement })
    }

    /// Returns a grid for a film much longer than the contact. It covers the film, and the pressure continues beyond
    /// its ends.
    fn continued_for(&self, fit: &Fit) -> Option<Self> {
        // The film determines the length; if it is short, the contact does.
        let length = fit.width.max(1.5);
        let cells = |dx: f64, x: f64| (x * length / dx).ceil() * dx;
        // A refined or halved grid keeps its refinement relative to the usual one.
        let dx = length / 30.0 * (self.dx / Self::DISSERTATION.dx).min(1.0);
        let dy = length / 14.0 * (self.dy / Self::DISSERTATION.dy).min(1.0);
        let domain = (-cells(dx, FILM_LENGTHS), cells(dx, 3.0), -cells(dx, FILM_LENGTHS));
        (FILM_LENGTHS * length < LONGEST_INLET).then_some(Self { dx, dy, domain, refinement: 1.0 / 9.0 })
    }

    /// Returns how often the spacing along X may be doubled such that a contact is still resolved well enough for an
    /// initial guess.
    pub fn coarsening_for(&self, point: &OperatingPoint) -> usize {
        let fit = Fit::of(point);
        let holds = |times: &u32| {
            let coarser = Self { dx: self.dx * f64::from(2u32.pow(*times)), ..*self };
            fit.resolution(coarser.dx) <= ROUGH && coarser.nodes().is_ok_and(|(nx, _)| nx >= FEWEST_ROUGH)
        };
        (1..=FINEST.log2() as u32 + 1).take_while(holds).count()
    }

    /// Returns the extended domain for a contact, or `None` if it would need too many nodes.
    fn domain_for(&self, fit: &Fit) -> Option<Stretched> {
        let (from, to, edge) = self.domain;
        let (mut times, mut cells) = (1.0, 1.0);
        if fit.ellipse == Ellipse::CIRCLE {
            while fit.truncation(-from * times) > TRUNCATION {
                times *= 2.0;
                cells = if fit.coarse(self.dx * times) > RESOLUTION { 2.0 } else { 1.0 };
                if fit.coarse(self.dx * times / cells) > RESOLUTION {
                    return None;
                }
            }
            return Some(Stretched { domain: (from * times, to * times, edge * times), times, cells });
        }
        let fine = self.ellipse_domain(fit, UNCOARSENED).filter(|stretched| stretched.times == 1.0);
        fine.or_else(|| self.ellipse_domain(fit, TRUNCATION))
    }

    /// Returns the extended domain for an elliptical contact whose truncation error may be `most`.
    fn ellipse_domain(&self, fit: &Fit, most: f64) -> Option<Stretched> {
        let (from, to, edge) = self.domain;
        // The shape determines which end causes the larger error, and this end is moved.
        let (mut reach, mut side, mut times) = (-from, -edge, 1.0f64);
        loop {
            let [inlet, sides] = fit.ends(reach, side);
            if inlet + sides <= most {
                break;
            }
            let end = if inlet >= sides { &mut reach } else { &mut side };
            *end = (2.5 * *end).ceil() / 2.0;
            if reach > LONGEST_INLET || side > LONGEST_OUTLET {
                return None;
            }
        }
        let to = to.max((10.0 * (1.0 + fit.width)).ceil() / 10.0);
        let more = (reach + to) * side / ((self.domain.1 - from) * -edge);
        while more > MOST_CELLS * times * times {
            // 1, 1.5, 2, 3, 4, 6 …
            times *= if times.log2().fract() == 0.0 { 1.5 } else { 4.0 / 3.0 };
            if fit.coarse(self.dx * times) > RESOLUTION {
                return None;
            }
        }
        Some(Stretched { domain: (-reach, to, -side), times, cells: 1.0 })
    }
}

/// Extended domain.
struct Stretched {
    domain: (f64, f64, f64),
    /// Factor by which the spacing may be wider.
    times: f64,
    /// Factor of the number of cells in each direction relative to that spacing.
    cells: f64,
}

impl GridSpec {
    /// Returns the expected relative error of H_c on this grid, by the ends of its domain and by its spacing together.
    pub fn expected_cost(&self, point: &OperatingPoint) -> f64 {
        let [truncation, resolution] = self.expected_errors(point);
        truncation + resolution
    }

    /// Returns the expected relative errors of H_c on this grid by the ends of its domain and by its spacing.
    pub fn expected_errors(&self, point: &OperatingPoint) -> [f64; 2] {
        let (fit, moes) = (Fit::of(point), point.moes());
        let (reach, spacing) = match *self {
            Self::Uniform { dx, domain } => (-domain.0, dx),
            Self::Graded { nodes, domain, registered } => {
                let scale = if registered { registration_scale(moes) } else { 1.0 };
                let coarser = explorer_cells(domain) as f64 / (nodes - 1) as f64;
                ((-domain.0 - 1.0) * scale + 1.0, EXPLORER_SPACING * coarser)
            }
            Self::Following { zone, finer, domain } => (-domain.0, 0.09 * zone / finer),
            Self::Plane(PointGridSpec { dx, .. }) if self.continues() => (LONGEST_INLET, dx),
            Self::Plane(PointGridSpec { dx, domain, .. }) => (f64::min(-domain.0, -2.0 * domain.2), dx),
        };
        [fit.truncation(reach), fit.resolution(spacing)]
    }

    /// True if the pressure continues beyond the ends of the domain.
    fn continues(&self) -> bool {
        matches!(self, Self::Plane(spec) if spec.continues())
    }

    /// Returns the explorer's grid for a contact.
    ///
    /// # Errors
    /// If no grid of its kind resolves the film.
    pub fn explorer_for(point: &OperatingPoint) -> Result<Self, GridError> {
        if point.kind.is_line() {
            Self::line_for(point.moes())
        } else {
            PointGridSpec::EXPLORER.for_contact(point).map(Self::Plane)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::parameters::Quantity;
    use crate::solver::physics::contact::{ContactKind, MoesRequest, si_from_moes};

    fn at(kind: ContactKind, m: f64, l: f64) -> OperatingPoint {
        si_from_moes(&MoesRequest::new(kind, m, l)).unwrap()
    }

    #[test]
    fn unusual_contacts_get_longer_or_finer_grids() {
        for (m, l) in [(2.0, 5.0), (40.0, 10.0), (500.0, 3.0)] {
            assert_eq!(GridSpec::explorer_for(&at(ContactKind::Line, m, l)), Ok(GridSpec::EXPLORER));
        }
        for (m, l) in [(12.8, 1.7), (200.0, 10.0)] {
            let spec = PointGridSpec::DISSERTATION;
            assert_eq!(spec.for_contact(&at(ContactKind::Point, m, l)), Ok(spec));
        }
        for (m, l, does) in [(40.0, 10.0, true), (0.5, 10.0, false), (2000.0, 1.0, false)] {
            assert_eq!(GridSpec::DISSERTATION.does(Moes { m, l }), does);
        }
        let Ok(GridSpec::Graded { domain, .. }) = GridSpec::explorer_for(&at(ContactKind::Line, 0.1, 10.0)) else {
            panic!()
        };
        assert!(domain.0 <= -160.0 && domain.1 > 20.0);
        let Ok(GridSpec::Graded { nodes, .. }) = GridSpec::explorer_for(&at(ContactKind::Line, 3e3, 1.0)) else {
            panic!()
        };
        assert!(nodes > 1000);
        assert_eq!(PointGridSpec::DISSERTATION.for_contact(&at(ContactKind::Point, 860.0, 5.0)).unwrap().dx, 0.01);
    }

    #[test]
    fn light_point_contacts_get_longer_domains() {
        let wide = PointGridSpec::DISSERTATION.for_contact(&at(ContactKind::Point, 5.0, 5.0)).unwrap();
        assert!(wide.domain.0 < -4.0 && wide.check().is_ok(), "{wide:?}");
        for (m, l) in [(1.1, 11.2), (0.3, 1.0), (1e-3, 0.0)] {
            let light = PointGridSpec::DISSERTATION.for_contact(&at(ContactKind::Point, m, l)).unwrap();
            assert!(light.continues() && light.check().is_ok_and(|(nx, ny)| nx * ny < 20_000), "M {m}: {light:?}");
            let film = FilmShape::CIRCLE.film(Moes { m, l }) * (1.5 * m).powf(-2.0 / 3.0);
            assert!(-light.domain.0 >= 7.9 * (2.0 * film).sqrt(), "M {m}: {light:?}");
        }
    }

    #[test]
    fn ellipses_of_equal_radii_have_the_end_errors_of_circles() {
        for (m, l) in [(5.0, 5.0), (20.0, 2.0), (100.0, 10.0)] {
            let fit = Fit::of(&at(ContactKind::Point, m, l));
            for reach in [3.0, 4.0, 8.0] {
                let [inlet, sides] = fit.ends(reach, 0.5 * reach);
                let ratio = (inlet + sides) / fit.truncation(reach);
                assert!((0.75..1.3).contains(&ratio), "M {m}, L {l}, X = −{reach}: {ratio}");
            }
            let near = Fit::of(&Quantity::RadiusRatio.at(&at(ContactKind::Point, m, l), 1.0 + 1e-9));
            for (own, other) in [
                (fit.lambda, near.lambda),
                (fit.alpha_hertz, near.alpha_hertz),
                (fit.zone, near.zone),
                (fit.width, near.width),
            ] {
                assert!((own / other - 1.0).abs() < 1e-6, "{own} {other}");
            }
            let point = Quantity::RadiusRatio.at(&at(ContactKind::Point, m, l), 7.0);
            let wide = Fit::of(&point);
            assert!((wide.lambda / point.lambda_bar() - 1.0).abs() < 1e-12);
            assert!((wide.alpha_hertz / point.alpha_hertz() - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn wide_and_light_ellipses_get_longer_inlets() {
        let domain = |ratio: f64, m: f64| {
            let point = Quantity::RadiusRatio.at(&at(ContactKind::Point, m, 6.0), ratio);
            PointGridSpec::DISSERTATION.for_contact(&point).unwrap().domain
        };
        assert_eq!(domain(0.2, 100.0), (-4.0, 2.0, -2.0));
        assert!((-10.0..-4.0).contains(&domain(20.0, 60.0).0), "{:?}", domain(20.0, 60.0));
        assert!(domain(20.0, 30.0).0 < domain(20.0, 60.0).0);
    }

    #[test]
    fn grids_follow_thin_films_up_to_a_limit() {
        let thin = at(ContactKind::Line, 1e5, 0.1);
        let spec = GridSpec::explorer_for(&thin).unwrap();
        let grid = spec.line().unwrap();
        let zone = Fit::of(&thin).zone;
        let steps: Vec<f64> = grid.xi.windows(2).map(|w| w[1] - w[0]).collect();
        let near = |x: f64| steps[grid.xi.partition_point(|&node| node < x) - 1] / zone;
        assert!(near(-1.0) < 0.1 && near(1.0) < 0.1 && grid.xi.len() < 2000, "{spec:?}: {}", near(-1.0));
        assert!(steps.windows(2).all(|w| (0.9..1.12).contains(&(w[1] / w[0]))), "{spec:?}");
        let message = GridSpec::explorer_for(&at(ContactKind::Point, 1e5, 0.1)).unwrap_err().to_string();
        assert!(message.contains("too thin"), "{message}");
    }
}
