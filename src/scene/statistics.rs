//! Order statistics of measured values.

/// Returns the value below which a fraction (0…1) of the values lies, interpolated between neighbours; NaN without
/// values. NaN values sort last.
pub fn percentile(values: &[f64], fraction: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let Some(last) = sorted.len().checked_sub(1) else { return f64::NAN };
    let position = fraction.clamp(0.0, 1.0) * last as f64;
    let below = position.floor() as usize;
    let above = (below + 1).min(last);
    let t = position - below as f64;
    let at = |place: usize| sorted.get(place).copied().unwrap_or(f64::NAN);
    if t == 0.0 { at(below) } else { at(below) * (1.0 - t) + at(above) * t }
}

/// Returns the median; NaN without values.
pub fn median(values: &[f64]) -> f64 {
    percentile(values, 0.5)
}

/// Returns the mean; NaN without values.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Returns Spearman's rank correlation of pairs: 1 if both have the same order. Equal values share their mean rank. NaN
/// for fewer than two pairs, or if one side is constant.
pub fn rank_correlation(a: &[f64], b: &[f64]) -> f64 {
    let (a, b) = (ranks(a), ranks(b));
    let mean = (a.len() as f64 - 1.0) / 2.0;
    let product = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| (x - mean) * (y - mean)).sum::<f64>();
    product(&a, &b) / (product(&a, &a) * product(&b, &b)).sqrt()
}

/// Returns the rank of each value, from 0.
fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<(usize, f64)> = values.iter().copied().enumerate().collect();
    order.sort_by(|a, b| a.1.total_cmp(&b.1));
    let mut ranked: Vec<(usize, f64)> = Vec::with_capacity(values.len());
    for group in order.chunk_by(|a, b| a.1 == b.1) {
        let rank = ranked.len() as f64 + (group.len() - 1) as f64 / 2.0;
        ranked.extend(group.iter().map(|(place, _)| (*place, rank)));
    }
    ranked.sort_by_key(|(place, _)| *place);
    ranked.into_iter().map(|(_, rank)| rank).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_ignore_everything_but_the_order() {
        let a = [1.0, 2.0, 3.0, 4.0];
        assert_eq!(rank_correlation(&a, &a.map(|v| v.powi(9))), 1.0);
        assert_eq!(rank_correlation(&a, &a.map(|v| -v)), -1.0);
        // Computed by hand: ranks 0, 1.5, 1.5, 3 and 0, 1, 2, 3.
        assert!((rank_correlation(&[1.0, 5.0, 5.0, 9.0], &a) - 4.5 / (4.5f64 * 5.0).sqrt()).abs() < 1e-15);
        assert!(rank_correlation(&[1.0, 1.0], &[1.0, 2.0]).is_nan() && rank_correlation(&[], &[]).is_nan());
    }

    #[test]
    fn percentiles_interpolate() {
        assert_eq!(median(&[3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), 2.5);
        assert_eq!(percentile(&[1.0, 2.0], 1.0), 2.0);
        assert!(median(&[]).is_nan());
    }
}
