//! Conditions that a step of a lesson waits for.

use crate::app::refusal::Refusal;
use crate::app::tab::Tab;
use crate::scene::named_lubricant::{NAMED, NamedLubricant, by_name};
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::Lubricant;

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
    /// Visible tabs.
    pub tabs: Vec<Tab>,
    /// Number of pinned curves.
    pub pins: usize,
    /// True if a full solution belongs to the picture.
    pub checked: bool,
}

/// Accepted forms of a condition.
const ACCEPTED: &str = "accepted are `M between 2 and 3` (likewise L, R_y/R, SRR, NPR), `contact point`, `tab Regimes`, \
    `lubricant mineral-oil`, `pin 1`, `checked` and `read`";

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
        if words == "checked" {
            return Some(Self::Checked);
        }
        let (first, rest) = words.split_once(' ')?;
        match first {
            "contact" => {
                [ContactKind::Line, ContactKind::Point].into_iter().find(|kind| kind.name() == rest).map(Self::Kind)
            }
            "tab" => Tab::ALL.iter().find(|tab| tab.title() == rest).map(|tab| Self::Tab(*tab)),
            "lubricant" => {
                let known = by_name(rest).ok()?;
                NAMED.iter().find(|named| named.name == known.name).map(Self::Lubricant)
            }
            "pin" => rest.parse().ok().map(Self::Pins),
            _ => {
                let quantity = quantity(first)?;
                let (from, to) = rest.strip_prefix("between ")?.split_once(" and ")?;
                let (from, to): (f64, f64) = (from.trim().parse().ok()?, to.trim().parse().ok()?);
                (from < to).then_some(Self::Between(quantity, from, to))
            }
        }
    }

    /// Returns the tab that must be visible.
    pub fn tab(&self) -> Option<Tab> {
        if let Self::Tab(tab) = self { Some(*tab) } else { None }
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
            Self::Pins(count) => screen.pins >= *count,
            Self::Checked => screen.checked,
        }
    }
}

fn quantity(name: &str) -> Option<Quantity> {
    match name {
        "M" => Some(Quantity::M),
        "L" => Some(Quantity::L),
        "R_y/R" => Some(Quantity::RadiusRatio),
        "SRR" => Some(Quantity::SlideToRollRatio),
        "NPR" => Some(Quantity::NewtonianPlateauRatio),
        _ => None,
    }
}

/// Returns the accessible name of a control that a lesson names by its symbol or by that name.
pub fn control(name: &str) -> &str {
    match quantity(name) {
        Some(quantity) => quantity.label(),
        None => name,
    }
}
