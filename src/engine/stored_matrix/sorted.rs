//! Whole numbers over a grid, sorted by how large those beside them are: numbers of one size take fewer bytes together than
//! among others, and what is known already says which kind comes next.

use crate::engine::packed::{packed, unpacked};
use pco::ChunkConfig;
use serde::{Deserialize, Serialize};

/// Kinds of neighbourhoods: two for each doubling of their size.
const KINDS: usize = 2 * u64::BITS as usize;

/// Columns of whole numbers on their way to or from a file.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct Sorted {
    /// How many numbers have a neighbourhood of each kind, and these packed, for the kinds that there are.
    kinds: Vec<(usize, usize, Vec<u8>)>,
}

/// Of each place with values the places before it across and along X; one behind all places where there are none.
pub(super) struct Neighbours(Vec<[usize; 2]>);

impl Neighbours {
    /// Those of the rows that are used, on a grid with so many nodes across.
    pub fn of(used: &[bool], across: usize) -> Self {
        let count = used.iter().filter(|used| **used).count();
        let mut places = Vec::with_capacity(used.len());
        let mut before = Vec::with_capacity(count);
        for (row, &used) in used.iter().enumerate() {
            let at = |back: usize| row.checked_sub(back).map_or(count, |row| places.get(row).copied().unwrap_or(count));
            if used {
                before.push([if row % across == 0 && across > 1 { count } else { at(1) }, at(across)]);
            }
            places.push(if used { before.len() - 1 } else { count });
        }
        Self(before)
    }

    /// Goes through columns, each number of which `next` tells by the kind of its neighbourhood; `None` once it does not.
    fn walk(&self, columns: usize, mut next: impl FnMut(usize) -> Option<i64>) -> Option<Vec<i64>> {
        let count = self.0.len();
        let mut numbers = Vec::with_capacity(count.checked_mul(columns)?);
        // Those of this column as far as it is known, and of the one before.
        let mut sizes = vec![0u64; count + 1];
        for _ in 0..columns {
            for (place, [aside, back]) in self.0.iter().enumerate() {
                let size = |place: usize| sizes.get(place).copied().unwrap_or_default();
                let beside = size(place).saturating_add(size(*aside)).saturating_add(size(*back));
                let number = next(kind(beside))?;
                *sizes.get_mut(place)? = number.unsigned_abs();
                numbers.push(number);
            }
        }
        Some(numbers)
    }
}

impl Sorted {
    /// These columns, of which no more than `most` numbers take a byte; `None` where more would.
    pub fn of(
        numbers: &[i64],
        (neighbours, columns): (&Neighbours, usize),
        settings: &ChunkConfig,
        most: usize,
    ) -> Option<Self> {
        let mut kinds = vec![Vec::new(); KINDS];
        let mut rest = numbers.iter();
        neighbours.walk(columns, |kind| {
            let number = rest.next()?;
            kinds.get_mut(kind)?.push(*number);
            Some(*number)
        })?;
        let packed = |(kind, own): (usize, Vec<i64>)| Some((kind, own.len(), packed(&own, settings, usize::MAX)?));
        let kinds = kinds.into_iter().enumerate().filter(|(_, own)| !own.is_empty());
        let sorted = Self { kinds: kinds.map(packed).collect::<Option<_>>()? };
        (numbers.len() <= most.saturating_mul(sorted.bytes())).then_some(sorted)
    }

    /// Bytes of its packed numbers.
    pub fn bytes(&self) -> usize {
        self.kinds.iter().map(|(.., packed)| packed.len()).sum()
    }

    /// The numbers of so many columns; `None` where they are not as many, or more than `most` of them take a byte.
    pub fn into_numbers(self, neighbours: &Neighbours, columns: usize, most: usize) -> Option<Vec<i64>> {
        let count = neighbours.0.len().checked_mul(columns)?;
        let said = self.kinds.iter().try_fold(0usize, |sum, (_, own, _)| sum.checked_add(*own))?;
        if said != count || count > most.saturating_mul(self.bytes()) {
            return None;
        }
        let mut kinds: Vec<std::vec::IntoIter<i64>> = (0..KINDS).map(|_| Vec::new().into_iter()).collect();
        for (kind, own, packed) in self.kinds {
            *kinds.get_mut(kind)? = unpacked(own, &packed, usize::MAX)?.into_iter();
        }
        neighbours.walk(columns, |kind| kinds.get_mut(kind)?.next())
    }
}

/// The kind of a neighbourhood of such a size, less than [`KINDS`].
fn kind(size: u64) -> usize {
    match size.checked_ilog2() {
        None | Some(0) => size as usize,
        Some(doublings) => 2 * doublings as usize + usize::from((size >> (doublings - 1)) & 1 == 1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers over 60 × 7 nodes, some of which are left out, that are larger here than there.
    fn uneven() -> (Neighbours, Vec<i64>) {
        let used: Vec<bool> = (0..420).map(|row| row % 11 != 3 && row > 9).collect();
        let mut rng = fastrand::Rng::with_seed(4);
        let rows: Vec<usize> = (0..420).filter(|row| used[*row]).collect();
        let size = |k: usize, row: usize| (7.0 + 6.0 * (0.02 * row as f64 + 0.2 * k as f64).sin()).exp2() as i64;
        let numbers = (0..60).flat_map(|k| rows.iter().map(move |row| size(k, *row))).map(|size| rng.i64(-size..=size));
        (Neighbours::of(&used, 7), numbers.collect())
    }

    #[test]
    fn sorted_numbers_come_back_in_fewer_bytes() {
        let (neighbours, numbers) = uneven();
        let settings = ChunkConfig::default();
        let sorted = Sorted::of(&numbers, (&neighbours, 60), &settings, 4).unwrap();
        let together = packed(&numbers, &settings, 4).unwrap();
        assert!(sorted.bytes() < together.len(), "{} instead of {}", sorted.bytes(), together.len());
        assert_eq!(sorted.into_numbers(&neighbours, 60, 4).unwrap(), numbers);
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let (neighbours, numbers) = uneven();
        let of = |numbers: &[i64], most| Sorted::of(numbers, (&neighbours, 60), &ChunkConfig::default(), most);
        let sorted = of(&numbers, 4).unwrap();
        assert!(sorted.clone().into_numbers(&neighbours, 59, 4).is_none());
        assert!(sorted.clone().into_numbers(&neighbours, usize::MAX, 4).is_none());
        assert!(sorted.clone().into_numbers(&neighbours, 60, 0).is_none(), "few bytes must not ask for much memory");
        let spoiled = |spoil: &dyn Fn(&mut Sorted)| {
            let mut sorted = sorted.clone();
            spoil(&mut sorted);
            sorted.into_numbers(&neighbours, 60, 4).is_none()
        };
        assert!(spoiled(&|sorted| sorted.kinds[0].0 = KINDS));
        assert!(spoiled(&|sorted| sorted.kinds[1].1 = usize::MAX));
        assert!(spoiled(&|sorted| sorted.kinds[2].2.truncate(3)));
        assert!(spoiled(
            &|sorted| (sorted.kinds[2].1, sorted.kinds[3].1) = (sorted.kinds[2].1 + 1, sorted.kinds[3].1 - 1)
        ));
        assert!(spoiled(&|sorted| sorted.kinds.truncate(4)));
        // Numbers that are all alike take next to no bytes.
        assert!(of(&vec![7; numbers.len()], 4).is_none());
        assert!(of(&numbers[1..], 4).is_none(), "some are missing");
    }

    #[test]
    fn kinds_are_two_for_each_doubling() {
        let kinds: Vec<usize> = (0..13).map(kind).collect();
        assert_eq!(kinds, [0, 1, 2, 3, 4, 4, 5, 5, 6, 6, 6, 6, 7]);
        assert_eq!(kind(u64::MAX), KINDS - 1);
    }
}
