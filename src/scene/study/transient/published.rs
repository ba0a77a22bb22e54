//! Published data of transient marches, for comparison.

use crate::scene::check::{Checked, count, number, refuse};
use serde::{Deserialize, Serialize};

/// Size and cost of a march, as far as published.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PublishedMarch {
    /// Name of the march: a frame, then `full`, `rnsa` or `tpwl`, as in `fixed.rnsa`; preceded by the name of further
    /// inputs if it uses these, as in `triangle.fixed.rnsa`.
    pub name: String,
    /// Number of pressure modes, or of unknowns of the reduced system if only this is published.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub modes: Option<usize>,
    /// Number of sampled equations or operating points.
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

/// Methods for which marches may be published.
pub const METHODS: [&str; 3] = ["full", "rnsa", "tpwl"];

impl PublishedMarch {
    /// Returns the time per step \[s\], as given or computed from the whole march.
    pub fn seconds_per_step(&self) -> Option<f64> {
        self.step_s.or_else(|| Some(self.march_s? / self.steps? as f64))
    }
}

/// Refuses invalid numbers, duplicate names, and names that are not those of a march. `subjects` are the names of full
/// marches.
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
