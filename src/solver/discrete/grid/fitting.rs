//! Which grid does for a contact, told before it is solved.
//!
//! Two lengths decide it. The inlet must begin where the pressure of an endless film is next to nothing, and the
//! spacing must resolve the zone in which the film closes from twice to once its thickness, t = (1.06 H_c)^(2/3) before
//! the Hertzian contact. What a grid costs H_c was fitted to what solutions say of themselves ([`GridCost`]): the
//! second order term is (ΔX/t)² for lines and points alike, and an inlet at X₀ lacks the pressure and the load of half
//! Sommerfeld's tail, λ̄/|X₀|³, and for a point contact that beyond the sides as well.
//!
//! [`GridCost`]: crate::solver::full::GridCost

use super::contact::GridSpec;
use super::error::GridError;
use super::line::{LONGEST_INLET, MAX_GRADED_NODES, explorer_cells, registration_scale};
use super::point::PointGridSpec;
use crate::solver::physics::contact::{ContactKind, Moes, moes_film};
use std::f64::consts::PI;

/// Relative error of H_c by the end of the inlet up to which a grid does.
const TRUNCATION: f64 = 0.035;
/// The same by the spacing.
const RESOLUTION: f64 = 0.02;
/// What a graded grid costs at most for its lack of nodes or inlet where another one is to be had.
const GRADED: f64 = 0.012;
/// Spacing in front of the contact of [`GridSpec::EXPLORER`].
const EXPLORER_SPACING: f64 = 6e-4;
/// A point contact's grid is at most this many times finer along X than the one it begins from.
const FINEST: f64 = 8.0;

/// No film of a contact beyond this load number reaches too far.
const HEAVIEST: f64 = 1e3;

/// α p_H up to which Moes' formula is good enough to choose a grid by.
const STIFF: f64 = 50.0;

/// What a grid is chosen by.
struct Fit {
    kind: ContactKind,
    moes: Moes,
    /// λ̄ of (2.23).
    lambda: f64,
    /// α p_H.
    alpha_hertz: f64,
    /// Length t of the inlet zone.
    zone: f64,
    /// Length √(2H_c) in which the gap grows to twice its smallest.
    width: f64,
    /// −d ln h/d ln M: how much the film answers to the load, next to nothing where it is elastic, 1 or 2 where rigid.
    by_load: f64,
}

impl Fit {
    fn new(kind: ContactKind, moes: Moes) -> Self {
        let Moes { m, l } = moes;
        let (lambda, alpha_hertz, film) = match kind {
            ContactKind::Line => {
                let scale = PI / (8.0 * m);
                (3.0 * PI * PI / (8.0 * m * m), l * (m / (2.0 * PI)).sqrt(), scale)
            }
            // (h/R)(2U)^(−1/2), over a²/R² = (3M/2)^(2/3) (2U)^(1/2).
            ContactKind::Point => (
                (128.0 * PI.powi(3) / (3.0 * m.powi(4))).cbrt(),
                l * (1.5 * m / PI.powi(3)).cbrt(),
                (1.5 * m).powf(-2.0 / 3.0),
            ),
        };
        // At pressures far beyond those of real contacts Moes' film is too thick: oil stiffens less than by Barus' law.
        let stiff = (STIFF / alpha_hertz).min(1.0).powf(0.25);
        let zone = stiff * (1.06 * film * moes_film(kind, moes)).powf(2.0 / 3.0);
        let thickness = |m: f64| moes_film(kind, Moes { m, l });
        let by_load = (thickness(0.95 * m) / thickness(1.05 * m)).ln() / f64::ln(1.05 / 0.95);
        let width = (2.0 * film * thickness(m)).sqrt();
        Self { kind, moes, lambda, alpha_hertz, zone, width, by_load: by_load.max(0.0) }
    }

    /// What an inlet at X = −`reach` costs.
    fn truncation(&self, reach: f64) -> f64 {
        let Self { lambda, alpha_hertz, .. } = self;
        match self.kind {
            ContactKind::Line => lambda * (4.0 / 3.0 * alpha_hertz / reach + 0.42) / (reach * reach),
            // The sides are half as far, always.
            ContactKind::Point => lambda * (0.8 * alpha_hertz / reach.powi(3) + 1.2 * self.by_load / reach),
        }
    }

    /// The inlet, as −X, from which on the end of the domain costs at most a share of H_c; at most about the longest.
    fn reach(&self, share: f64) -> f64 {
        let mut reach = 2.0;
        while self.truncation(reach) > share && reach < LONGEST_INLET {
            reach *= 1.25;
        }
        reach
    }

    /// What a spacing in front of the contact costs.
    fn resolution(&self, spacing: f64) -> f64 {
        (spacing / self.zone).powi(2)
    }

    /// What a spacing costs a thick film.
    fn coarse(&self, spacing: f64) -> f64 {
        2.1 * (spacing / self.width).powi(2)
    }

    /// A film that does not fit into `grid` however it is stretched.
    fn too_wide(&self, grid: PointGridSpec) -> GridError {
        let Moes { m, l } = self.moes;
        let holds = |m: &f64| grid.stretched_for(Moes { m: *m, l }).is_some();
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

/// Where a contact's inlet may end, as −X, and how wide its spacing may be in front of the contact, each at the cost of
/// a hundredth of H_c.
pub fn that_would_do(kind: ContactKind, moes: Moes) -> (f64, f64) {
    let fit = Fit::new(kind, moes);
    (fit.reach(0.01), 0.1 * fit.zone)
}

impl GridSpec {
    /// Whether a uniform grid from X = `inlet` does for a contact.
    pub fn does(&self, moes: Moes) -> bool {
        let fit = Fit::new(ContactKind::Line, moes);
        match *self {
            Self::Uniform { dx, domain } => fit.truncation(-domain.0) <= TRUNCATION && fit.resolution(dx) <= RESOLUTION,
            Self::Graded { .. } | Self::Plane(_) => false,
        }
    }

    /// The explorer's grid for a contact: [`GridSpec::EXPLORER`] wherever that does, else one that reaches farther, by
    /// powers of two, or has more nodes.
    ///
    /// # Errors
    /// When no such grid resolves the film.
    fn line_for(moes: Moes) -> Result<Self, GridError> {
        let Self::Graded { nodes, domain, registered } = Self::EXPLORER else { return Ok(Self::EXPLORER) };
        let fit = Fit::new(ContactKind::Line, moes);
        let reach = |times: f64| (times * -domain.0 - 1.0) * registration_scale(moes) + 1.0;
        let mut times = 1.0;
        while fit.truncation(reach(times)) > GRADED && times < 64.0 {
            times *= 2.0;
        }
        let domain = (times * domain.0, times * domain.1);
        let cells = if times > 1.0 { explorer_cells(domain) } else { nodes - 1 } as f64;
        let most = (MAX_GRADED_NODES - 1) as f64 / cells;
        let wanted = (fit.resolution(EXPLORER_SPACING) / GRADED).sqrt().max(1.0).log2().ceil().exp2();
        let finer = wanted.min(most);
        if fit.resolution(EXPLORER_SPACING / finer) > RESOLUTION {
            return Err(fit.too_thin());
        }
        Ok(Self::Graded { nodes: (cells * finer).floor() as usize + 1, domain, registered })
    }
}

impl PointGridSpec {
    /// This grid for a contact: as it is wherever it does, else one that reaches farther with as many nodes, or is finer
    /// along X.
    ///
    /// # Errors
    /// When no such grid resolves the film.
    pub fn for_contact(self, moes: Moes) -> Result<Self, GridError> {
        let fit = Fit::new(ContactKind::Point, moes);
        let (from, to, edge) = self.domain;
        let (times, cells) = self.stretched_for(moes).ok_or_else(|| fit.too_wide(self))?;
        let mut finer = 1.0;
        while fit.resolution(self.dx * times / finer) > RESOLUTION {
            if finer >= FINEST {
                return Err(fit.too_thin());
            }
            finer *= 2.0;
        }
        let domain = (from * times, to * times, edge * times);
        let dx = self.dx * times / finer.max(cells);
        Ok(Self { dx, dy: self.dy * times / cells, domain, ..self })
    }

    /// How many times farther its domain must reach for a contact, and how many times more nodes it then has in each
    /// direction; none where that would take too many.
    fn stretched_for(&self, moes: Moes) -> Option<(f64, f64)> {
        let fit = Fit::new(ContactKind::Point, moes);
        let (mut times, mut cells) = (1.0, 1.0);
        while fit.truncation(-self.domain.0 * times) > TRUNCATION {
            times *= 2.0;
            cells = if fit.coarse(self.dx * times) > RESOLUTION { 2.0 } else { 1.0 };
            if fit.coarse(self.dx * times / cells) > RESOLUTION {
                return None;
            }
        }
        Some((times, cells))
    }
}

impl GridSpec {
    /// The share of H_c that this grid is expected to cost a contact, by the ends of its domain and by its spacing.
    pub fn expected_cost(&self, moes: Moes) -> f64 {
        let fit = Fit::new(self.kind(), moes);
        let (reach, spacing) = match *self {
            Self::Uniform { dx, domain } => (-domain.0, dx),
            Self::Graded { nodes, domain, registered } => {
                let scale = if registered { registration_scale(moes) } else { 1.0 };
                let coarser = explorer_cells(domain) as f64 / (nodes - 1) as f64;
                ((-domain.0 - 1.0) * scale + 1.0, EXPLORER_SPACING * coarser)
            }
            Self::Plane(PointGridSpec { dx, domain, .. }) => (f64::min(-domain.0, -2.0 * domain.2), dx),
        };
        fit.truncation(reach) + fit.resolution(spacing)
    }

    /// The explorer's grid for a contact.
    ///
    /// # Errors
    /// When no grid of its kind resolves the film.
    pub fn explorer_for(kind: ContactKind, moes: Moes) -> Result<Self, GridError> {
        match kind {
            ContactKind::Line => Self::line_for(moes),
            ContactKind::Point => PointGridSpec::EXPLORER.for_contact(moes).map(Self::Plane),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn usual_contacts_keep_the_usual_grids_and_others_get_longer_or_finer_ones() {
        for (m, l) in [(2.0, 5.0), (40.0, 10.0), (500.0, 3.0)] {
            assert_eq!(GridSpec::explorer_for(ContactKind::Line, Moes { m, l }), Ok(GridSpec::EXPLORER));
        }
        for (m, l) in [(12.8, 1.7), (200.0, 10.0)] {
            let spec = PointGridSpec::DISSERTATION;
            assert_eq!(spec.for_contact(Moes { m, l }), Ok(spec));
        }
        for (m, l, does) in [(40.0, 10.0, true), (0.5, 10.0, false), (2000.0, 1.0, false)] {
            assert_eq!(GridSpec::DISSERTATION.does(Moes { m, l }), does);
        }
        let Ok(GridSpec::Graded { domain, .. }) = GridSpec::explorer_for(ContactKind::Line, Moes { m: 0.1, l: 10.0 })
        else {
            panic!()
        };
        assert!(domain.0 <= -160.0 && domain.1 > 20.0);
        let Ok(GridSpec::Graded { nodes, .. }) = GridSpec::explorer_for(ContactKind::Line, Moes { m: 3e3, l: 1.0 })
        else {
            panic!()
        };
        assert!(nodes > 1000);
        assert_eq!(PointGridSpec::DISSERTATION.for_contact(Moes { m: 860.0, l: 5.0 }).unwrap().dx, 0.01);
    }

    #[test]
    fn a_point_contact_reaches_farther_at_low_loads_until_no_grid_holds_it() {
        let wide = PointGridSpec::DISSERTATION.for_contact(Moes { m: 5.0, l: 5.0 }).unwrap();
        assert!(wide.domain.0 < -4.0 && wide.check().is_ok(), "{wide:?}");
        let refused = PointGridSpec::DISSERTATION.for_contact(Moes { m: 1.1, l: 11.2 }).unwrap_err().to_string();
        assert!(refused.contains("reaches too far"), "{refused}");
        let lowest: f64 = refused.split("from M = ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
        let accepted = |m: f64| PointGridSpec::DISSERTATION.for_contact(Moes { m, l: 11.2 }).is_ok();
        assert!(accepted(lowest + 0.01) && !accepted(0.97 * lowest), "{refused}");
        let far = PointGridSpec::DISSERTATION.for_contact(Moes { m: 0.3, l: 1.0 }).unwrap_err().to_string();
        assert!(far.contains("no grid that ends before X = -2000 does"), "{far}");
    }

    #[test]
    fn a_film_too_thin_for_any_grid_is_refused() {
        for kind in [ContactKind::Line, ContactKind::Point] {
            let message = GridSpec::explorer_for(kind, Moes { m: 1e5, l: 0.1 }).unwrap_err().to_string();
            assert!(message.contains("too thin"), "{message}");
        }
    }
}
