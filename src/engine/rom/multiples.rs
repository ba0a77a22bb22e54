//! Encoding of fields on a grid as integers. Each value is a multiple of 2^(exponent of its row + exponent of its
//! column). The multiple is predicted by a polynomial through earlier nodes of the same column, and the file stores the
//! difference. For smooth fields the differences are small.

use super::container::unpacked;
use crate::host::pool::on_all_cores;
use crate::solver::reduced::Multiples;
use faer::Mat;
use pco::standalone::simple_compress;
use pco::{ChunkConfig, DeltaSpec, ModeSpec, PagingSpec};
use rayon::prelude::*;

/// Accepted exponents.
const EXPONENTS: std::ops::RangeInclusive<i16> = -400..=400;
/// Exponent that marks a row without values.
const NO_VALUES: i16 = i16::MIN;
/// Highest orders of the prediction along X and across.
const MOST_ALONG: i16 = 5;
const MOST_ACROSS: i16 = 2;
/// Highest class of a row or a column.
const MOST_CLASS: i16 = 127;
/// Smallest and largest number of values that are stored together.
const FEWEST_TOGETHER: usize = 2048;
const MOST_TOGETHER: usize = 1 << 18;
/// Number of columns that are decoded before they are copied into the matrix.
const TOGETHER: usize = 32;
/// Predictions above this multiple count as zero.
const LARGEST: f64 = (1u64 << 62) as f64;

/// Encodes a matrix over a grid with `across` nodes across as three streams:
/// - exponents of the rows, then their classes,
/// - exponents of the columns, their orders along X, their orders across, and their classes,
/// - the differences of the rows with values, sorted by the sum of both classes, within a sum column after column.
///
/// Returns `None` if that fails.
pub(super) fn encode(matrix: &Mat<f64>, across: usize, multiples: &Multiples) -> Option<[Vec<u8>; 3]> {
    let rows: Vec<i16> = multiples.rows.iter().map(|exponent| exponent.unwrap_or(NO_VALUES)).collect();
    let lattice = Lattice::new(&rows, across);
    let coded = multiples.columns.par_iter().enumerate();
    let coded = coded.map(|(k, exponent)| lattice.shortest(matrix.col_as_slice(k), *exponent));
    let (orders, differences): (Vec<_>, Vec<_>) = on_all_cores(|| coded.collect::<Vec<_>>()).into_iter().unzip();
    let encoded = |classes: &Classes| {
        let mut of_rows = vec![0; rows.len()];
        for ((row, _), class) in lattice.steps.iter().zip(&classes.rows) {
            *of_rows.get_mut(*row)? = *class;
        }
        let order = |k: usize| orders.iter().filter_map(move |orders| orders.get(k).copied());
        let columns = multiples.columns.iter().copied().chain(order(0)).chain(order(1));
        let columns: Vec<i16> = columns.chain(classes.columns.iter().copied()).collect();
        let (sorted, counts) = classes.sorted(&differences);
        let settings = ChunkConfig::default();
        let plain = settings.clone().with_mode_spec(ModeSpec::Classic).with_delta_spec(DeltaSpec::NoOp);
        let plain = if counts.is_empty() { plain } else { plain.with_paging_spec(PagingSpec::Exact(counts)) };
        Some([
            simple_compress(&[rows.as_slice(), of_rows.as_slice()].concat(), &settings).ok()?,
            simple_compress(&columns, &settings).ok()?,
            simple_compress(&sorted, &plain).ok()?,
        ])
    };
    let one = encoded(&Classes::one(lattice.steps.len(), differences.len()))?;
    let several = encoded(&Classes::of(&differences, lattice.steps.len()))?;
    let size = |streams: &[Vec<u8>; 3]| streams.iter().map(Vec::len).sum::<usize>();
    Some(if size(&several) < size(&one) { several } else { one })
}

/// Decodes three consecutive streams. Returns `None` if they do not match the shape.
pub(super) fn decode(bytes: &[u8], parts: &[usize; 3], across: usize, shape: (usize, usize)) -> Option<Mat<f64>> {
    let mut rest = bytes;
    let mut next = |length: usize| {
        let (part, further) = rest.split_at_checked(length)?;
        rest = further;
        Some(part)
    };
    let [rows, columns, sorted] = [next(parts[0])?, next(parts[1])?, next(parts[2])?];
    let rows: Vec<i16> = unpacked(rows, shape.0.checked_mul(2)?)?;
    let columns: Vec<i16> = unpacked(columns, shape.1.checked_mul(4)?)?;
    let (rows, of_rows) = rows.split_at(shape.0);
    let (exponents, columns) = columns.split_at(shape.1);
    let (along, columns) = columns.split_at(shape.1);
    let (aside, of_columns) = columns.split_at(shape.1);
    let sane = |exponents: &[i16], or: i16| exponents.iter().all(|own| EXPONENTS.contains(own) || *own == or);
    let within = |values: &[i16], most: i16| values.iter().all(|value| (0..=most).contains(value));
    let fits = (1..=shape.0.max(1)).contains(&across)
        && (sane(rows, NO_VALUES) && sane(exponents, 0))
        && (within(along, MOST_ALONG) && within(aside, MOST_ACROSS))
        && (within(of_rows, MOST_CLASS) && within(of_columns, MOST_CLASS));
    let lattice = Some(Lattice::new(rows, across)).filter(|_| fits)?;
    let of_rows = lattice.steps.iter().filter_map(|(row, _)| of_rows.get(*row).copied()).collect();
    let classes = Classes { rows: of_rows, columns: of_columns.to_vec() };
    let sorted: Vec<i64> = unpacked(sorted, lattice.steps.len().checked_mul(shape.1)?)?;
    let places = classes.places();
    let decoded = |exponent: &i16, along: &i16, aside: &i16, mut places: Vec<usize>| {
        let mut values = vec![0.0; shape.0];
        let mut of_rows = classes.rows.iter();
        lattice.walk(&mut values, *exponent, [*along, *aside], |_, expected| {
            let place = of_rows.next().and_then(|class| places.get_mut(*class as usize));
            let difference = place.and_then(|place| {
                let own = sorted.get(*place);
                *place += 1;
                own
            });
            difference.map_or(0, |difference| expected.saturating_add(*difference))
        });
        values
    };
    let columns: Vec<_> = exponents.iter().zip(along).zip(aside).zip(places).collect();
    let (mut matrix, mut column) = (Mat::zeros(shape.0, shape.1), 0);
    // The whole matrix a second time would take as much memory as everything else here.
    for some in columns.chunks(TOGETHER) {
        let some = some.par_iter();
        let some = some.map(|(((exponent, along), aside), places)| decoded(exponent, along, aside, places.clone()));
        for values in on_all_cores(|| some.collect::<Vec<Vec<f64>>>()) {
            matrix.col_as_slice_mut(column).copy_from_slice(&values);
            column += 1;
        }
    }
    Some(matrix)
}

/// Classes of the rows with values and of the columns. Differences with the same sum of both classes have similar size.
/// Stored together, they need fewer bits.
struct Classes {
    rows: Vec<i16>,
    columns: Vec<i16>,
}

impl Classes {
    /// Returns a single class for all rows and columns.
    fn one(rows: usize, columns: usize) -> Self {
        Self { rows: vec![0; rows], columns: vec![0; columns] }
    }

    /// Returns classes by the mean logarithm of the differences, two for each factor of two.
    fn of(differences: &[Vec<i64>], rows: usize) -> Self {
        let size = |difference: &i64| 2.0 * (1.0 + difference.unsigned_abs() as f64).log2();
        let mean = |sum: f64, count: usize| sum / count.max(1) as f64;
        let mut of_rows = vec![0.0; rows];
        for column in differences {
            of_rows.iter_mut().zip(column).for_each(|(sum, difference)| *sum += size(difference));
        }
        let of_columns = differences.iter().map(|column| mean(column.iter().map(size).sum(), rows));
        let of_columns: Vec<f64> = of_columns.collect();
        let least = of_columns.iter().copied().fold(f64::INFINITY, f64::min);
        let class = |size: f64| size.round().clamp(0.0, f64::from(MOST_CLASS)) as i16;
        Self {
            rows: of_rows.into_iter().map(|sum| class(mean(sum, differences.len()))).collect(),
            columns: of_columns.into_iter().map(|size| class(size - least)).collect(),
        }
    }

    /// Returns, for each column, the positions of the first difference of each row class in the sorted sequence.
    fn places(&self) -> Vec<Vec<usize>> {
        let mut rows = vec![0usize; MOST_CLASS as usize + 1];
        self.rows.iter().filter_map(|class| usize::try_from(*class).ok()).for_each(|class| {
            rows.get_mut(class).into_iter().for_each(|count| *count += 1);
        });
        let mut counts = vec![0usize; 2 * rows.len()];
        let add = |counts: &mut [usize], column: &i16| {
            counts.iter_mut().skip(*column as usize).zip(&rows).for_each(|(sum, count)| *sum += count);
        };
        self.columns.iter().for_each(|column| add(&mut counts, column));
        let mut before = 0;
        let first = |count: &usize| {
            before += count;
            before - count
        };
        let mut next: Vec<usize> = counts.iter().map(first).collect();
        let places = self.columns.iter().map(|column| {
            let own = next.iter().skip(*column as usize).take(rows.len()).copied().collect();
            add(&mut next, column);
            own
        });
        places.collect()
    }

    /// Returns the sorted differences, and the numbers of differences that are stored together.
    fn sorted(&self, differences: &[Vec<i64>]) -> (Vec<i64>, Vec<usize>) {
        let mut sorted = vec![0; differences.iter().map(Vec::len).sum()];
        let mut counts = vec![0usize; 2 * MOST_CLASS as usize + 1];
        for ((mut places, column), of_column) in self.places().into_iter().zip(&self.columns).zip(differences) {
            for (class, difference) in self.rows.iter().zip(of_column) {
                let place = places.get_mut(*class as usize);
                place.into_iter().for_each(|place| {
                    sorted.get_mut(*place).into_iter().for_each(|own| *own = *difference);
                    *place += 1;
                });
                counts.get_mut((class + column) as usize).into_iter().for_each(|count| *count += 1);
            }
        }
        let mut together = Vec::new();
        let mut open = 0;
        for count in counts {
            open += count;
            // At most as many as fit one page of pco, and enough to outweigh the size of the page header.
            while open > MOST_TOGETHER {
                together.push(MOST_TOGETHER);
                open -= MOST_TOGETHER;
            }
            if open >= FEWEST_TOGETHER {
                together.push(std::mem::take(&mut open));
            }
        }
        together.extend(Some(open).filter(|open| *open > 0));
        (sorted, together)
    }
}

/// Rows with values and their steps.
struct Lattice {
    across: usize,
    /// Rows with values, each with 2^(exponent).
    steps: Vec<(usize, f64)>,
}

impl Lattice {
    fn new(exponents: &[i16], across: usize) -> Self {
        let used = exponents.iter().enumerate().filter(|(_, exponent)| **exponent != NO_VALUES);
        Self { across, steps: used.map(|(row, exponent)| (row, f64::from(*exponent).exp2())).collect() }
    }

    /// Returns the orders that need the fewest bits, and the differences.
    fn shortest(&self, column: &[f64], exponent: i16) -> ([i16; 2], Vec<i64>) {
        let most_across = if self.across > 1 { MOST_ACROSS } else { 0 };
        let candidates = (0..=MOST_ALONG).flat_map(|along| (0..=most_across).map(move |across| [along, across]));
        let coded = candidates.map(|orders| {
            let (mut differences, mut values) = (Vec::with_capacity(self.steps.len()), vec![0.0; column.len()]);
            self.walk(&mut values, exponent, orders, |(row, step), expected| {
                let count = (column.get(row).copied().unwrap_or_default() / step).round_ties_even() as i64;
                differences.push(count.saturating_sub(expected));
                count
            });
            (orders, differences)
        });
        let size = |(_, differences): &([i16; 2], Vec<i64>)| differences.iter().map(|own| bits(*own)).sum::<u32>();
        coded.min_by_key(size).unwrap_or_default()
    }

    /// Fills a column row by row. `count` returns the multiple of a row, given the row, its step and the predicted
    /// multiple.
    fn walk(
        &self,
        values: &mut [f64],
        exponent: i16,
        orders: [i16; 2],
        mut count: impl FnMut((usize, f64), i64) -> i64,
    ) {
        // Prediction v − (1 − S)^along (1 − S')^across v, with the shifts S and S' by one node along X and across.
        let [along, aside] = orders.map(signed_binomials);
        let mut terms = Vec::new();
        for (i, a) in along.into_iter().enumerate() {
            for (j, b) in aside.iter().enumerate().filter(|(j, _)| i + j > 0) {
                terms.push((i * self.across + j, j, -a * b));
            }
        }
        let of_column = f64::from(exponent).exp2();
        for &(row, own) in &self.steps {
            let step = own * of_column;
            let in_line = row % self.across;
            let reached = terms.iter().filter(|(back, aside, _)| *aside <= in_line && *back <= row);
            let at = |back: usize| values.get(row - back).copied().unwrap_or_default();
            let expected: f64 = reached.map(|(back, _, factor)| factor * at(*back)).sum();
            let expected = (expected / step).round_ties_even();
            let count = count((row, step), if expected.abs() < LARGEST { expected as i64 } else { 0 });
            if let Some(value) = values.get_mut(row) {
                *value = step * count as f64;
            }
        }
    }
}

/// Coefficients of (1 − s)^order.
fn signed_binomials(order: i16) -> Vec<f64> {
    let mut term = 1.0;
    let rest = (1..=order).map(|k| {
        term *= -f64::from(order - k + 1) / f64::from(k);
        term
    });
    std::iter::once(1.0).chain(rest).collect()
}

/// Returns the number of bits of an integer, including the sign.
fn bits(value: i64) -> u32 {
    i64::BITS - ((value << 1) ^ (value >> 63)).leading_zeros()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::reduced::PodBasis;

    /// Returns modes on 30 × 5 nodes that vanish in the first seven rows and have decreasing singular values.
    fn basis() -> PodBasis {
        let value = |i: usize, k: usize| ((i / 5 + 3 * k) as f64 * 0.2).sin() * (1.0 + 0.1 * (i % 5) as f64);
        let modes = Mat::from_fn(150, 4, |i, k| if i < 7 { 0.0 } else { value(i, k) });
        PodBasis { modes, singular_values: vec![20.0, 1.0, 1e-2, 1e-4, 1e-6] }
    }

    type Streams = [Vec<u8>; 3];

    fn coded(basis: &PodBasis, across: usize, accuracy: f64) -> Streams {
        let (multiples, kept) = Multiples::keep(basis.modes.clone(), &basis.scales(), accuracy, 0.0);
        encode(&kept, across, &multiples).unwrap()
    }

    fn read(streams: &Streams, across: usize, shape: (usize, usize)) -> Option<Mat<f64>> {
        decode(&streams.concat(), &streams.each_ref().map(Vec::len), across, shape)
    }

    #[test]
    fn modes_keep_the_accuracy_of_the_fields_they_make() {
        let basis = basis();
        for (across, accuracy) in [(5, 1e-6), (1, 1e-9)] {
            let streams = coded(&basis, across, accuracy);
            let again = read(&streams, across, (150, 4)).unwrap();
            for (k, sigma) in basis.singular_values.iter().take(4).enumerate() {
                let off = (0..150).map(|i| (again[(i, k)] - basis.modes[(i, k)]).abs()).fold(0.0, f64::max);
                // The first mode determines the size of the fields.
                let size = |i: usize| {
                    (0..4).map(|k| (basis.modes[(i, k)] * basis.singular_values[k]).powi(2)).sum::<f64>().sqrt()
                };
                let largest = (0..150).map(size).fold(0.0, f64::max);
                let field = off * sigma / largest;
                assert!(field > 0.0 && field <= accuracy, "mode {k}: {field:e}");
                assert!((0..7).all(|i| again[(i, k)] == 0.0));
            }
            // Values that were rounded before are stored exactly, as the same bytes.
            assert!(coded(&PodBasis { modes: again, ..basis.clone() }, across, accuracy) == streams);
        }
        let bytes = coded(&basis, 5, 1e-6).concat().len();
        assert!(bytes < 3 * 4 * 143, "{bytes} bytes");
    }

    #[test]
    fn parts_that_do_not_fit_each_other_are_refused() {
        let streams = coded(&basis(), 5, 1e-6);
        let shape = (150, 4);
        assert!(read(&streams, 5, shape).is_some());
        for (across, shape) in [(0, shape), (151, shape), (5, (149, 4)), (5, (150, 5)), (5, (150, 1 << 62))] {
            assert!(read(&streams, across, shape).is_none(), "{across} {shape:?}");
        }
        let packed = |numbers: &[i16]| simple_compress(numbers, &ChunkConfig::default()).unwrap();
        let spoiled = |part: usize, stream: Vec<u8>| {
            let mut streams = streams.clone();
            streams[part] = stream;
            read(&streams, 5, shape).is_none()
        };
        let columns =
            |k: usize, value: i16| packed(&std::array::from_fn::<i16, 16, _>(|i| if i == k { value } else { 0 }));
        let rows = |value: i16| packed(&std::array::from_fn::<i16, 300, _>(|i| if i == 200 { value } else { 0 }));
        assert!(spoiled(0, packed(&[i16::MAX; 300])) && spoiled(0, packed(&[NO_VALUES; 300])));
        assert!(spoiled(0, rows(-1)) && spoiled(0, rows(MOST_CLASS + 1)) && spoiled(0, packed(&[0; 299])));
        for (k, value) in [(0, 500), (4, 6), (5, -1), (8, 3), (11, -1), (12, -1), (15, MOST_CLASS + 1)] {
            assert!(spoiled(1, columns(k, value)), "{k}: {value}");
        }
        assert!(spoiled(1, packed(&[0; 15])));
        assert!(spoiled(2, simple_compress(&[7i64; 571], &ChunkConfig::default()).unwrap()));
        assert!(spoiled(2, streams[2][..streams[2].len() / 2].to_vec()) && spoiled(2, vec![0x55; streams[2].len()]));
        let parts = streams.each_ref().map(Vec::len);
        assert!(decode(&streams.concat()[1..], &parts, 5, shape).is_none());
    }

    #[test]
    fn differences_refer_to_the_polynomial_through_earlier_nodes() {
        // A cubic along X times a parabola across is predicted exactly from the fifth line on.
        let (rows, across) = (40, 6);
        let value = |i: usize, j: usize| (i * i * i) as f64 - 40.0 + (j * j) as f64 * (i + 1) as f64;
        let column: Vec<f64> = (0..rows * across).map(|k| value(k / across, k % across)).collect();
        let lattice = Lattice::new(&vec![0; rows * across], across);
        let (orders, differences) = lattice.shortest(&column, 0);
        assert!(orders[0] >= 3, "{orders:?}");
        let (mut values, mut missed) = (vec![0.0; rows * across], Vec::new());
        lattice.walk(&mut values, 0, [4, 2], |(row, _), expected| {
            missed.push(column[row] as i64 - expected);
            column[row] as i64
        });
        let within = |k: usize| k / across >= 4 && k % across >= 2;
        assert!(missed.iter().enumerate().filter(|(k, _)| within(*k)).all(|(_, miss)| *miss == 0));
        let size = |differences: &[i64]| differences.iter().map(|own| bits(*own)).sum::<u32>();
        assert!(size(&differences) <= size(&missed));
        // Random numbers are stored without prediction.
        let mut rng = fastrand::Rng::with_seed(7);
        let noise: Vec<f64> = (0..rows * across).map(|_| f64::from(rng.i32(-506..=506))).collect();
        assert_eq!(lattice.shortest(&noise, 0).0, [0, 0]);
        for (value, size) in
            [(0, 0), (-1, 1), (1, 2), (-2, 2), (2, 3), (63, 7), (-64, 7), (i64::MAX, 64), (i64::MIN, 64)]
        {
            assert_eq!(bits(value), size);
        }
    }
    #[test]
    fn sorted_numbers_of_mixed_size_take_fewer_bytes() {
        let mut rng = fastrand::Rng::with_seed(4);
        let size = |i: usize, k: usize| (7.0 + 6.0 * (0.02 * i as f64).sin() + 0.05 * k as f64).exp2() as i64;
        let column = |k: usize, rng: &mut fastrand::Rng| -> Vec<i64> {
            (0..400).map(|i| size(i, k)).map(|size| rng.i64(-size..=size)).collect()
        };
        let differences: Vec<Vec<i64>> = (0..60).map(|k| column(k, &mut rng)).collect();
        let classes = Classes::of(&differences, 400);
        let (sorted, together) = classes.sorted(&differences);
        assert!(together.len() > 4 && together.iter().sum::<usize>() == 24_000);
        let mut sums: Vec<(i16, usize)> = Vec::new();
        for (k, column) in classes.columns.iter().enumerate() {
            sums.extend(classes.rows.iter().enumerate().map(|(i, row)| (row + column, 400 * k + i)));
        }
        sums.sort_unstable();
        let all = differences.concat();
        assert!(sums.iter().map(|(_, place)| all[*place]).eq(sorted.iter().copied()), "sorted by the sum of classes");
        let plain = ChunkConfig::default().with_delta_spec(DeltaSpec::NoOp);
        let [own, other] = [(&sorted, Some(together)), (&all, None)].map(|(numbers, together)| {
            let settings = plain.clone();
            let settings = together.map_or(settings.clone(), |n| settings.with_paging_spec(PagingSpec::Exact(n)));
            simple_compress(numbers, &settings).unwrap().len()
        });
        assert!(own < other * 9 / 10, "{own} and {other}");
    }
}
