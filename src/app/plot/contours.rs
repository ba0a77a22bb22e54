//! Contour lines of a field on a rectangular grid by marching squares, joined to polylines.

use std::collections::HashMap;

/// Contour line: its points (X, Y) in order.
pub type Polyline = Vec<[f64; 2]>;

/// Field for contour lines: values at nodes (i, j), i along X and j along Y, with the index i·n_y + j.
pub struct Field<'a> {
    /// Abscissae.
    pub x: &'a [f64],
    /// Ordinates.
    pub y: &'a [f64],
    pub values: &'a [f64],
}

/// Edge of the grid: a node, and true for the edge to its neighbour along X or false for the one along Y.
type Edge = (usize, bool);

impl Field<'_> {
    /// Returns all contour lines of one level.
    pub fn contours(&self, level: f64) -> Vec<Polyline> {
        let ny = self.y.len();
        let mut segments: Vec<[Edge; 2]> = Vec::new();
        for i in 0..self.x.len().saturating_sub(1) {
            for j in 0..ny.saturating_sub(1) {
                let node = i * ny + j;
                let corners = [node, node + ny, node + ny + 1, node + 1];
                let above = corners.map(|k| self.values[k] > level);
                // Edges of the cell in the order of its corners. Each lies between one corner and the next.
                let edges = [(node, true), (node + ny, false), (node + 1, true), (node, false)];
                let crossed: Vec<Edge> = (0..4).filter(|&k| above[k] != above[(k + 1) % 4]).map(|k| edges[k]).collect();
                match *crossed.as_slice() {
                    [a, b] => segments.push([a, b]),
                    [a, b, c, d] => {
                        // At a saddle the value at the centre decides which corners are connected.
                        let middle = 0.25 * corners.iter().map(|&k| self.values[k]).sum::<f64>() > level;
                        if middle == above[0] {
                            segments.extend([[a, b], [c, d]]);
                        } else {
                            segments.extend([[d, a], [b, c]]);
                        }
                    }
                    _ => {}
                }
            }
        }
        self.joined(&segments, level)
    }

    /// Returns the point where the level crosses an edge.
    fn crossing(&self, (node, along_x): Edge, level: f64) -> [f64; 2] {
        let ny = self.y.len();
        let other = if along_x { node + ny } else { node + 1 };
        let (a, b) = (self.values[node], self.values[other]);
        let t = if b == a { 0.5 } else { (level - a) / (b - a) };
        let between = |nodes: &[f64], k: usize, l: usize| nodes[k] + t * (nodes[l] - nodes[k]);
        [between(self.x, node / ny, other / ny), between(self.y, node % ny, other % ny)]
    }

    /// Joins segments that share an edge to polylines.
    fn joined(&self, segments: &[[Edge; 2]], level: f64) -> Vec<Polyline> {
        let mut segments_at: HashMap<Edge, Vec<usize>> = HashMap::with_capacity(segments.len() + 1);
        for (k, segment) in segments.iter().enumerate() {
            for edge in segment {
                segments_at.entry(*edge).or_default().push(k);
            }
        }
        let mut used = vec![false; segments.len()];
        // Follows unused segments from an edge and returns the points beyond it.
        let walk = |mut edge: Edge, used: &mut Vec<bool>| {
            let mut path = Vec::new();
            while let Some(&next) = segments_at.get(&edge).and_then(|all| all.iter().find(|&&k| !used[k])) {
                used[next] = true;
                let [a, b] = segments[next];
                edge = if a == edge { b } else { a };
                path.push(self.crossing(edge, level));
            }
            path
        };
        let mut lines = Vec::new();
        for k in 0..segments.len() {
            if used[k] {
                continue;
            }
            used[k] = true;
            let [a, b] = segments[k];
            let mut line: Polyline = walk(a, &mut used);
            line.reverse();
            line.extend([self.crossing(a, level), self.crossing(b, level)]);
            line.extend(walk(b, &mut used));
            lines.push(line);
        }
        lines
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sampled(f: impl Fn(f64, f64) -> f64) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
        let x: Vec<f64> = (0..61).map(|i| -1.5 + 0.05 * f64::from(i)).collect();
        let y: Vec<f64> = (0..41).map(|j| -1.2 + 0.06 * f64::from(j)).collect();
        let values = x.iter().flat_map(|x| y.iter().map(|y| f(*x, *y)).collect::<Vec<_>>()).collect();
        (x, y, values)
    }

    #[test]
    fn a_circle_is_one_closed_line_of_the_right_length() {
        let (x, y, values) = sampled(|x, y| x * x + y * y);
        let lines = Field { x: &x, y: &y, values: &values }.contours(0.7);
        assert_eq!(lines.len(), 1);
        let line = &lines[0];
        assert_eq!(line.first(), line.last());
        let length: f64 = line.windows(2).map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1])).sum();
        assert!((length / (std::f64::consts::TAU * 0.7f64.sqrt()) - 1.0).abs() < 2e-3, "{length}");
        assert!(line.iter().all(|p| (p[0] * p[0] + p[1] * p[1] - 0.7).abs() < 2e-3));
    }

    #[test]
    fn contour_lines_end_at_edges_and_do_not_cross() {
        let (x, y, values) = sampled(|x, y| x * y);
        let lines = Field { x: &x, y: &y, values: &values }.contours(0.1);
        assert_eq!(lines.len(), 2);
        for line in &lines {
            for end in [line[0], line[line.len() - 1]] {
                let edge = (end[0].abs() - 1.5).abs() < 1e-9 || (end[1].abs() - 1.2).abs() < 1e-9;
                assert!(edge, "{end:?}");
            }
        }
        assert!(Field { x: &x, y: &y, values: &values }.contours(9.0).is_empty());
    }
}
