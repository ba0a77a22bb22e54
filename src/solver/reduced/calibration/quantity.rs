//! Dependence of one relative error on the features of a reduced solution.

use super::neighbours::{AROUND, Neighbours};
use super::steps::kept_surplus;
use crate::solver::reduced::dense;
use crate::solver::reduced::error_estimate::Estimated;
use faer::Mat;

/// Minimum amount of evidence for a calibration.
pub const LEAST_EVIDENCE: usize = 100;
/// Number of nearest pieces of evidence that correct the likely error.
const NEAR: usize = 16;
/// Share of the local surplus that is applied as correction.
const BELIEF: f64 = 0.8;
/// Share of the overall mean square in the local one.
const COMMON: f64 = 0.1;
/// Part of the evidence that must lie below the bound. It exceeds the promised 99 %, since new points scatter.
const QUANTILE: f64 = 0.994;

/// Weight of the scores of all local models, as an equivalent number of own scores. A few hundred own scores alone do
/// not determine a quantile of one in two hundred.
const OTHERS: f64 = 400.0;

/// Ridges for the law of one local model: equivalent numbers of additional pieces of evidence that follow the common
/// law.
const OWN_RIDGES: [f64; 6] = [1.0, 3.0, 10.0, 30.0, 100.0, 1e6];

/// Largest leverage of the law that is taken into account.
const MOST_LEVERAGE: f64 = 0.5;

/// Law of one relative error in terms of the features.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Quantity {
    /// Coefficients of the terms of a quadratic law.
    pub law: Vec<f64>,
    /// Mean of `squares` over all evidence.
    pub mean_square: f64,
    /// Bound in units of the law times the root of the local mean square.
    pub quantile: f64,
    /// Difference between the logarithms of the evidence's errors and the law; NaN if not measured.
    pub surplus: Vec<f32>,
    /// Squared ratios of the evidence's errors to the law.
    pub squares: Vec<f32>,
}

impl Quantity {
    /// Fits the common law of several local models and their own corrections to the logarithms of errors (NaN if not
    /// measured). `None` if there is too little evidence.
    pub fn fit(terms: &[Vec<Vec<f64>>], logs: &[Vec<f64>], neighbours: &[Vec<Neighbours>]) -> Option<Vec<Self>> {
        let all = terms.iter().flatten().zip(logs.iter().flatten().copied());
        let known: Vec<(&[f64], f64)> =
            all.filter(|(_, log)| log.is_finite()).map(|(terms, log)| (terms.as_slice(), log)).collect();
        if known.len() < LEAST_EVIDENCE {
            return None;
        }
        let common = least_squares(&known)?;
        let share = common.len() as f64 / known.len() as f64;
        let windows = own_laws(&common, terms, logs)?.into_iter().zip(terms).zip(logs).map(|((own, terms), logs)| {
            let surplus = terms.iter().zip(logs).map(|(terms, log)| kept_surplus(log - dot(&own.law, terms))).collect();
            let unseen = 1.0 / (1.0 - (share + own.leverage).min(MOST_LEVERAGE));
            (Self { law: own.law, ..Self::of_surplus(surplus) }, unseen)
        });
        let (mut windows, unseen): (Vec<Self>, Vec<f64>) = windows.unzip();
        measure(&mut windows, &unseen, neighbours);
        Some(windows)
    }

    /// Creates a quantity with these differences to the law; everything else has the default.
    pub fn of_surplus(surplus: Vec<f32>) -> Self {
        let squares = surplus.iter().map(|surplus| (2.0 * surplus).exp()).collect();
        Self { surplus, squares, ..Self::default() }
    }

    /// Returns true if all numbers are valid.
    pub fn sound(&self, terms: usize, evidence: usize) -> bool {
        let sizes = [self.mean_square, self.quantile].iter().all(|v| v.is_finite() && *v >= 0.0);
        let known = self.surplus.iter().zip(&self.squares).all(|(a, b)| a.is_finite() == b.is_finite());
        let lengths = [self.law.len() == terms, self.surplus.len() == evidence, self.squares.len() == evidence];
        sizes && known && lengths == [true; 3] && self.law.iter().all(|v| v.is_finite())
    }

    /// Returns the root mean square of the errors around a position, relative to the law.
    fn size(&self, near: &Neighbours) -> f64 {
        ((1.0 - COMMON) * near.mean(AROUND, &self.squares) + COMMON * self.mean_square).sqrt()
    }

    /// Estimates the error of a case with these terms and neighbours. `beyond` is by how much its indicators exceed
    /// the range of the evidence, in the logarithm.
    pub fn estimate(&self, terms: &[f64], near: &Neighbours, beyond: f64) -> Estimated {
        let law = dot(&self.law, terms) + beyond;
        let likely = (law + BELIEF * near.mean(NEAR, &self.surplus)).exp();
        Estimated { likely, bound: self.quantile * law.exp() * self.size(near) }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Returns the terms 1, features, and their products.
pub(super) fn quadratic(x: &[f64]) -> Vec<f64> {
    let products = (0..x.len()).flat_map(|i| (i..x.len()).map(move |j| x[i] * x[j]));
    [1.0].into_iter().chain(x.iter().copied()).chain(products).collect()
}

/// Law of one local model.
struct OwnLaw {
    law: Vec<f64>,
    /// Mean leverage of the local model's own correction.
    leverage: f64,
    /// Sum of the squared residuals of the local model's evidence, as if it had not been used in the fit.
    missed: f64,
}

/// Fits the laws of the local models: the common law, plus linear terms from each one's own evidence. The ridge that
/// keeps them close to the common law minimises the error for unused evidence (generalised cross-validation).
fn own_laws(common: &[f64], terms: &[Vec<Vec<f64>>], logs: &[Vec<f64>]) -> Option<Vec<OwnLaw>> {
    let with = |ridge: &f64| {
        let own = terms.iter().zip(logs).map(|(terms, logs)| own_law(common, terms, logs, *ridge));
        own.collect::<Option<Vec<OwnLaw>>>()
    };
    let missed = |laws: &Vec<OwnLaw>| laws.iter().map(|own| own.missed).sum::<f64>();
    OWN_RIDGES.iter().filter_map(with).min_by(|a, b| missed(a).total_cmp(&missed(b)))
}

fn own_law(common: &[f64], terms: &[Vec<f64>], logs: &[f64], ridge: f64) -> Option<OwnLaw> {
    let known = terms.iter().zip(logs).filter(|(_, log)| log.is_finite());
    let known: Vec<(&[f64], f64)> = known.map(|(terms, log)| (terms.as_slice(), log - dot(common, terms))).collect();
    // n features have 1 + n + n(n + 1)/2 terms.
    let linear = (0..common.len()).find(|n| (n + 1) * (n + 2) / 2 == common.len())? + 1;
    let (products, rests) = moments(&known, linear);
    // Correction of the local model, and the weight of its own evidence in it.
    let right = Mat::from_fn(linear, 1 + linear, |r, c| if c == 0 { rests[(r, 0)] } else { products[(r, c - 1)] });
    let solved = dense::solved(with_ridge(products, ridge).as_ref(), right);
    let added: Vec<f64> = solved.col(0).iter().copied().collect();
    let leverage = (0..linear).map(|k| solved[(k, k + 1)]).sum::<f64>() / known.len().max(1) as f64;
    let rest = |(terms, rest): &(&[f64], f64)| (rest - dot(&added, terms)).powi(2);
    let missed = known.iter().map(rest).sum::<f64>() / (1.0 - leverage.min(MOST_LEVERAGE)).powi(2);
    let mut law = common.to_vec();
    law.iter_mut().zip(&added).for_each(|(law, own)| *law += own);
    (missed.is_finite() && law.iter().all(|v| v.is_finite())).then_some(OwnLaw { law, leverage, missed })
}

/// Computes the mean square and the quantile of several local models from the differences to the law. Errors change
/// their sign over the range and are tiny near these places. Logarithms scatter strongly there and do not indicate how
/// large an error can be. So the unit of the bound is the local root mean square of the errors, relative to the law.
///
/// The law was fitted to the same errors that it is compared with. Each residual would be `unseen` = 1/(1 − h) times
/// as large if the error had not been used in the fit. h is its leverage, on average the number of terms divided by
/// the amount of evidence (generalised cross-validation).
fn measure(windows: &mut [Quantity], unseen: &[f64], neighbours: &[Vec<Neighbours>]) {
    for own in &mut *windows {
        let squares = own.squares.iter().filter(|square| square.is_finite());
        let count = squares.clone().count();
        own.mean_square = squares.map(|square| f64::from(*square)).sum::<f64>() / count.max(1) as f64;
    }
    let scores_of = |((own, unseen), neighbours): ((&Quantity, &f64), &Vec<Neighbours>)| {
        let known = own.surplus.iter().zip(neighbours).filter(|(surplus, _)| surplus.is_finite());
        let score = |(surplus, near): (&f32, &Neighbours)| (unseen * f64::from(*surplus)).exp() / own.size(near);
        known.map(score).collect::<Vec<f64>>()
    };
    let scores: Vec<Vec<f64>> = windows.iter().zip(unseen).zip(neighbours).map(scores_of).collect();
    let all = scores.concat();
    // A single local model has no others.
    let others = if windows.len() > 1 { OTHERS / all.len().max(1) as f64 } else { 0.0 };
    for (own, scores) in windows.iter_mut().zip(&scores) {
        let weighted = |scores: &[f64], weight: f64| scores.iter().map(|score| (*score, weight)).collect::<Vec<_>>();
        own.quantile = quantile([weighted(scores, 1.0), weighted(&all, others)].concat());
    }
}

/// Returns the weighted quantile of the scores, with one more score of weight 1 assumed.
fn quantile(mut scores: Vec<(f64, f64)>) -> f64 {
    scores.sort_by(|a, b| a.0.total_cmp(&b.0));
    let wanted = QUANTILE * (1.0 + scores.iter().map(|(_, weight)| weight).sum::<f64>());
    let mut below = 0.0;
    let reached = scores.iter().find(|(_, weight)| {
        below += weight;
        below >= wanted
    });
    reached.or(scores.last()).map_or(0.0, |(score, _)| *score)
}

/// Returns the sums of products of the first terms with each other, and with the values to be fitted.
fn moments(known: &[(&[f64], f64)], count: usize) -> (Mat<f64>, Mat<f64>) {
    let product = |r: usize, c: usize| known.iter().map(|(terms, _)| terms[r] * terms[c]).sum::<f64>();
    let fitted = |r: usize, _| known.iter().map(|(terms, value)| terms[r] * value).sum::<f64>();
    (Mat::from_fn(count, count, product), Mat::from_fn(count, 1, fitted))
}

fn with_ridge(mut products: Mat<f64>, ridge: f64) -> Mat<f64> {
    (0..products.nrows()).for_each(|k| products[(k, k)] += ridge);
    products
}

/// Fits coefficients to the known logarithms, with a small ridge for features that do not vary.
fn least_squares(known: &[(&[f64], f64)]) -> Option<Vec<f64>> {
    let (products, logs) = moments(known, known.first()?.0.len());
    let solved = dense::solved(with_ridge(products, 1e-3).as_ref(), logs);
    let law: Vec<f64> = solved.col(0).iter().copied().collect();
    law.iter().all(|v| v.is_finite()).then_some(law)
}
