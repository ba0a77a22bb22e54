//! Whole numbers over a grid, sorted by how large those beside them are: numbers of one size take fewer bytes together than
//! among others, and what is known already says which kind comes next.

use crate::engine::former::packed::{packed, unpacked};
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
