//! Advice for inputs outside the training of a linearised model. It depends on the measured errors.

use super::runs::TransientRuns;
use crate::scene::study::transient::MarchedBy;

/// Returns the advice from the errors of H_c against the full run of the same inputs.
pub fn advice(view: &TransientRuns) -> &'static str {
    let least = |of: fn(MarchedBy) -> bool| {
        let runs = view.runs.iter().filter(|run| of(run.by));
        runs.filter_map(|run| run.difference).reduce(f64::min)
    };
    let reduced = least(|by| by == MarchedBy::Reduced);
    let linearised = least(|by| matches!(by, MarchedBy::Linearised(_)));
    by_errors(reduced, linearised)
}

fn by_errors(reduced: Option<f64>, linearised: Option<f64>) -> &'static str {
    match (reduced, linearised) {
        (Some(reduced), Some(linearised)) if reduced < linearised => {
            "use the reduced model, which has smaller errors here"
        }
        (Some(_), Some(_)) => "train on inputs like these; the reduced model is not more accurate here",
        _ => "train on inputs like these, or tick Reduced model to compare both",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reduced_model_is_advised_only_if_it_was_seen_to_err_less() {
        let uses = |reduced, linearised| by_errors(reduced, linearised).starts_with("use the reduced model");
        assert!(uses(Some(0.01), Some(0.03)));
        assert!(!uses(Some(0.03), Some(0.01)) && !uses(Some(0.01), Some(0.01)));
        assert!(!uses(None, Some(0.5)) && !uses(Some(0.001), None) && !uses(None, None));
    }
}
