//! Published size and cost of transient marches. A scene lists them, and the results show them next to the computed
//! values.

use crate::scene::check::{Checked, count, number, refuse};
use serde::{Deserialize, Serialize};

/// Size and cost of one march. Values that were not published are `None`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PublishedMarch {
    /// Name of the march: frame and method, as in `fixed.rnsa`. A march with further inputs begins with the name of
    /// these, as in `triangle.fixed.rnsa`.
    pub name: String,
    /// Number of pressure modes, or of unknowns of the reduced system if only this number is published.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub modes: Option<usize>,
    /// Number of sampled equations of a reduced model (`rnsa`), or of operating points of a linearised one (`tpwl`).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rows: Option<usize>,
    /// Number of time steps.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub steps: Option<usize>,
    /// Time per step \[s\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub step_s: Option<f64>,
    /// Time of the whole march \[s\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub march_s: Option<f64>,
}

/// Accepted methods: full solver, reduced model, and linearised (trajectory-piecewise-linear) model.
pub const METHODS: [&str; 3] = ["full", "rnsa", "tpwl"];

impl PublishedMarch {
    /// Returns the time per step \[s\] as given, or else the time of the march divided by its steps. `None` if neither
    /// is published.
    pub fn seconds_per_step(&self) -> Option<f64> {
        self.step_s.or_else(|| Some(self.march_s? / self.steps? as f64))
    }
}

/// Refuses invalid numbers, duplicate names, and names that do not consist of a subject and a method. `subjects` are
/// the names of the marches of the study without the method, such as `fixed`.
pub(super) fn check<'a>(published: &[PublishedMarch], subjects: impl Iterator<Item = &'a str> + Clone) -> Checked {
    for (i, march) in published.iter().enumerate() {
        let field = |name: &str| format!("study.published.{i}.{name}");
        let known =
            |(subject, method): (&str, &str)| METHODS.contains(&method) && subjects.clone().any(|s| s == subject);
        if !march.name.rsplit_once('.').is_some_and(known) {
            let names: Vec<&str> = subjects.clone().collect();
            let sentence = format!("must be one of {} with .full, .rnsa or .tpwl behind it", names.join(", "));
            return Err(refuse(field("name"), sentence));
        }
        if published[..i].iter().any(|other| other.name == march.name) {
            return Err(refuse(field("name"), "must not be given twice"));
        }
        for (name, value) in [("modes", march.modes), ("rows", march.rows), ("steps", march.steps)] {
            value.iter().try_for_each(|&value| count(&field(name), value, 1, 100_000_000))?;
        }
        for (name, value) in [("step_s", march.step_s), ("march_s", march.march_s)] {
            value.iter().try_for_each(|&value| number(&field(name), value, 1e-12, 1e12))?;
        }
    }
    Ok(())
}
