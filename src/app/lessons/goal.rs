//! Conditions that a step of a lesson waits for.

use crate::app::document::{Document, Edit};
use crate::app::panels::sliders::SLIDERS;
use crate::app::refusal::Refusal;
use crate::app::tab::Tab;
use crate::scene::named_lubricant::{NAMED, NamedLubricant, by_name};
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::{Cavitation, Lubricant};

/// Condition of a step.
#[derive(Clone, Debug, PartialEq)]
pub enum Goal {
    /// A quantity of the contact lies between two values.
    Between(Quantity, f64, f64),
    /// The contact is of this kind.
    Kind(ContactKind),
    /// A tab is visible.
    Tab(Tab),
    /// The lubricant is this named one.
    Lubricant(&'static NamedLubricant),
    /// The inlet is starved, with an inlet film thickness between two values \[nm\].
    Starved(f64, f64),
    /// Temperatures are computed.
    Heat,
    /// Asperities carry load.
    Mixed,
    /// The composite roughness lies between two values \[µm\].
    Roughness(f64, f64),
    /// This number of curves is pinned.
    Pins(usize),
    /// A full solution has checked the picture.
    Checked,
}

/// State of the screen.
#[derive(Clone, Debug, PartialEq)]
pub struct OnScreen {
    /// Contact of the sliders.
    pub point: OperatingPoint,
    /// Its NPR, or that of the lubricant if the contact has none.
    pub plateau_ratio: f64,
    pub lubricant: Lubricant,
    /// σ \[m\] of both surfaces.
    pub composite_roughness_m: f64,
    /// Visible tabs.
    pub tabs: Vec<Tab>,
    /// Number of pinned curves.
    pub pins: usize,
    /// True if a full solution belongs to the picture.
    pub checked: bool,
}

/// Accepted forms of a condition.
const ACCEPTED: &str = "accepted are `M between 2 and 3` (likewise L, R_y/R, SRR, NPR, u_m in m/s), `contact point`, `tab Regimes`, \
    `lubricant mineral-oil`, `starved`, `inlet film between 70 and 90` (nm), `heat`, `mixed`, `roughness between 0.1 and \
    0.2` (composite, µm), `pin 1`, `checked` and `read`";

impl Goal {
    /// Parses the conditions of a line, separated by commas. Empty for a step that is only read.
    ///
    /// # Errors
    /// A sentence with the accepted forms.
    pub fn all(words: &str) -> Result<Vec<Self>, Refusal> {
        let goals = words.split(',').map(str::trim).filter(|words| *words != "read");
        goals
            .map(|words| Self::read(words).ok_or_else(|| Refusal::new(format!("“{words}” is no goal; {ACCEPTED}"))))
            .collect()
    }

    fn read(words: &str) -> Option<Self> {
        match words {
            "checked" => return Some(Self::Checked),
            "heat" => return Some(Self::Heat),
            "mixed" => return Some(Self::Mixed),
            "starved" => return Some(Self::Starved(0.0, f64::INFINITY)),
            _ => {}
        }
        if let Some(range) = words.strip_prefix("inlet film ") {
            return between(range).map(|(from, to)| Self::Starved(from, to));
        }
        if let Some(range) = words.strip_prefix("roughness ") {
            return between(range).map(|(from, to)| Self::Roughness(from, to));
        }
        let (first, rest) = words.split_once(' ')?;
        match first {
            "contact" => ContactKind::from_name(rest).map(Self::Kind),
            "tab" => Tab::ALL.iter().find(|tab| tab.title() == rest).map(|tab| Self::Tab(*tab)),
            "lubricant" => {
                let known = by_name(rest).ok()?;
                NAMED.iter().find(|named| named.name == known.name).map(Self::Lubricant)
            }
            "pin" => rest.parse().ok().map(Self::Pins),
            _ => {
                let quantity = quantity(first)?;
                between(rest).map(|(from, to)| Self::Between(quantity, from, to))
            }
        }
    }

    /// Returns the tab that must be visible.
    pub fn tab(&self) -> Option<Tab> {
        if let Self::Tab(tab) = self { Some(*tab) } else { None }
    }

    /// Changes a document as a reader does: a quantity is set to the middle of its range.
    ///
    /// # Errors
    /// A sentence if the document refuses the change.
    pub fn carry_out(&self, document: &mut Document) -> Result<(), Refusal> {
        match self {
            Self::Between(quantity, from, to) => document.edit(Edit::Quantity(*quantity, 0.5 * (from + to))),
            Self::Lubricant(named) => document.edit(Edit::Named(named)),
            Self::Heat => document.edit(Edit::Heat(true)),
            Self::Mixed => document.edit(Edit::Mixed(true)),
            Self::Roughness(from, to) => {
                let composite_m = 0.5 * (from + to) * MICRO;
                document.edit(Edit::Surfaces([composite_m / std::f64::consts::SQRT_2; 2]))
            }
            Self::Starved(from, to) => {
                let film = 0.5 * (from + to);
                let film = if film.is_finite() { film } else { SUPPLY_NM };
                let cavitation = Cavitation::MassConserving { supply_film_m: Some(1e-9 * film) };
                document.edit(Edit::Laws(Box::new(Lubricant { cavitation, ..document.lubricant })))
            }
            Self::Kind(_) | Self::Tab(_) | Self::Pins(_) | Self::Checked => Ok(()),
        }
    }

    pub fn holds(&self, screen: &OnScreen) -> bool {
        match self {
            Self::Between(quantity, from, to) => {
                let value = quantity.of(&screen.point).unwrap_or(screen.plateau_ratio);
                (*from..=*to).contains(&value)
            }
            Self::Kind(kind) => screen.point.kind == *kind,
            Self::Tab(tab) => screen.tabs.contains(tab),
            Self::Lubricant(named) => screen.lubricant == named.laws,
            Self::Starved(from, to) => {
                let film = screen.lubricant.cavitation.supply_film_m();
                film.is_some_and(|film| (*from..=*to).contains(&(1e9 * film)))
            }
            Self::Heat => screen.lubricant.heat.is_some(),
            Self::Mixed => screen.lubricant.is_rough(),
            Self::Roughness(from, to) => (*from..=*to).contains(&(screen.composite_roughness_m / MICRO)),
            Self::Pins(count) => screen.pins >= *count,
            Self::Checked => screen.checked,
        }
    }
}

/// Parses `between A and B`.
fn between(words: &str) -> Option<(f64, f64)> {
    let (from, to) = words.strip_prefix("between ")?.split_once(" and ")?;
    let (from, to): (f64, f64) = (from.trim().parse().ok()?, to.trim().parse().ok()?);
    (from < to).then_some((from, to))
}

/// Metres per micrometre.
const MICRO: f64 = 1e-6;
/// Inlet film thickness of the switch \[nm\].
const SUPPLY_NM: f64 = 200.0;

/// Returns the quantity with this symbol, such as `u_m`, among those that a lesson may name.
fn quantity(name: &str) -> Option<Quantity> {
    let (sign, subscript) = name.strip_suffix("_m").map_or((name, ""), |sign| (sign, "m"));
    SLIDERS.into_iter().chain([Quantity::Speed]).find(|quantity| quantity.symbol() == (sign, subscript))
}

/// Returns the accessible name of a control that a lesson names by its symbol or by that name.
pub fn control(name: &str) -> &str {
    match quantity(name) {
        Some(quantity) => quantity.label(),
        None => name,
    }
}
