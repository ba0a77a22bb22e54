//! Evidence in the neighbourhood of a position.

/// Number of nearest pieces of evidence that determine the local size of errors.
pub(super) const AROUND: usize = 48;

/// Nearest evidence, sorted by squared distance.
pub(super) struct Neighbours {
    pub(super) nearest: [(f32, usize); AROUND],
    pub(super) count: usize,
}

impl Neighbours {
    /// Creates an empty list.
    pub fn none() -> Self {
        Self { nearest: [(f32::INFINITY, 0); AROUND], count: 0 }
    }

    pub fn meet(&mut self, distance: f32, index: usize) {
        if self.count == AROUND && distance >= self.nearest[AROUND - 1].0 {
            return;
        }
        let known = &self.nearest[..self.count];
        let at = known.partition_point(|(d, _)| *d <= distance);
        self.count = (self.count + 1).min(AROUND);
        self.nearest[at..self.count].rotate_right(1);
        self.nearest[at] = (distance, index);
    }

    /// Returns the mean of the finite values of the first `count` neighbours, weighted by inverse squared distance.
    pub fn mean(&self, count: usize, values: &[f32]) -> f64 {
        let (mut sum, mut weights) = (0.0, 0.0);
        for &(distance, index) in &self.nearest[..self.count.min(count)] {
            if values[index].is_finite() {
                let weight = 1.0 / (f64::from(distance) + 1e-2);
                sum += weight * f64::from(values[index]);
                weights += weight;
            }
        }
        if weights > 0.0 { sum / weights } else { 0.0 }
    }
}
