//! What marches in time cost by each method, beside what was published of them: Tables 4.4, 4.6, 4.7 and 4.9.

use crate::engine::outcome::SceneOutcome;
use crate::engine::table::Table;
use crate::scene::PublishedMarch;

/// A row of the table. Its numbers are values of the outcome, found by what their names begin with.
pub(super) struct March {
    /// What its own values begin with, which is also what the row is called.
    pub name: String,
    /// What the size of its model begins with.
    pub model: String,
    /// What values of the full march that it is measured by begin with.
    pub full: String,
    /// Its name among the published ones.
    pub published: String,
}

const COLUMNS: [&str; 13] = [
    "modes",
    "rows or points",
    "steps",
    "ms per step",
    "s",
    "times faster",
    "H_c difference",
    "published: modes",
    "rows or points",
    "steps",
    "ms per step",
    "s",
    "times faster",
];

/// The table `costs` of some marches: medians of their steps, whole marches, and how many times faster than the full one they are; the relative L2
/// difference of H_c from it.
pub(super) fn table(outcome: &SceneOutcome, marches: &[March], published: &[PublishedMarch]) -> Table {
    let mut table = Table::new("costs", &COLUMNS);
    let told = |name: &str| published.iter().find(|march| march.name == name);
    for march in marches {
        let value = |of: &str, what: &str| outcome.value(&format!("{of}{what}"), None).unwrap_or(f64::NAN);
        let own = |what: &str| value(&march.name, what);
        let size = value(&march.model, "rows");
        let march_s = own(".march_s");
        let mut row = vec![
            value(&march.model, "modes"),
            if size.is_nan() { value(&march.model, "points") } else { size },
            own(".steps"),
            1e3 * own(".step_s_median"),
            march_s,
            value(&march.full, ".march_s") / march_s,
            own(".H_c.difference_l2"),
        ];
        let (own, full) =
            (told(&march.published), march.published.rsplit_once('.').map(|(of, _)| format!("{of}.full")));
        let full = full.and_then(|name| told(&name));
        let number = |value: Option<f64>| value.unwrap_or(f64::NAN);
        let count = |value: Option<usize>| number(value.map(|value| value as f64));
        let quotient = |of: fn(&PublishedMarch) -> Option<f64>| Some(full.and_then(of)? / own.and_then(of)?);
        row.extend([
            count(own.and_then(|told| told.modes)),
            count(own.and_then(|told| told.rows)),
            count(own.and_then(|told| told.steps)),
            1e3 * number(own.and_then(PublishedMarch::seconds_per_step)),
            number(own.and_then(|told| told.march_s)),
            number(quotient(|told| told.march_s).or_else(|| quotient(PublishedMarch::seconds_per_step))),
        ]);
        table.labels.push(march.name.clone());
        table.rows.push(row);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_march_stands_beside_what_was_published_of_it() {
        let mut outcome = SceneOutcome::default();
        for (name, value) in [
            ("sine.full.steps", 400.0),
            ("sine.full.march_s", 2.0),
            ("sine.rnsa.march_s", 0.1),
            ("sine.rnsa.step_s_median", 2.5e-4),
            ("rnsa.modes", 90.0),
            ("rnsa.rows", 180.0),
        ] {
            outcome.push(name, None, value);
        }
        let march = |name: &str, model: &str| March {
            name: name.to_owned(),
            model: model.to_owned(),
            full: "sine.full".to_owned(),
            published: name.to_owned(),
        };
        let told = |name: &str, steps: usize, march_s: f64| PublishedMarch {
            name: name.to_owned(),
            modes: None,
            rows: Some(300),
            steps: Some(steps),
            step_s: None,
            march_s: Some(march_s),
        };
        let published = [told("sine.full", 1000, 800.0), told("sine.rnsa", 1200, 40.0)];
        let table = table(&outcome, &[march("sine.full", "full."), march("sine.rnsa", "rnsa.")], &published);
        assert_eq!(table.labels, ["sine.full", "sine.rnsa"]);
        let [full, reduced] = [&table.rows[0], &table.rows[1]];
        assert!(full[0].is_nan() && full[2] == 400.0 && full[5] == 1.0 && full[12] == 1.0);
        assert_eq!(reduced[..2], [90.0, 180.0]);
        assert!((reduced[3] - 0.25).abs() < 1e-12 && (reduced[5] - 20.0).abs() < 1e-12 && reduced[6].is_nan());
        assert!((reduced[10] - 1e3 * 40.0 / 1200.0).abs() < 1e-9 && reduced[12] == 20.0);
    }
}
