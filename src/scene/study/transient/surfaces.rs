//! Surfaces of a transient study as scenes write them, in metres, and their conversion to the solver's units.

use crate::host::files;
use crate::scene::check::{Checked, count, number, refuse};
use crate::scene::sampled::{MAX_SAMPLED_BYTES, SampledError};
use crate::solver::full::transient::{MovingSurface, Shape};
use crate::solver::physics::contact::OperatingPoint;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Feature on the surface of a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SurfaceFeature {
    /// Body, 1 or 2. The scene's SRR sets its speed: body 1 moves with u_m (1 − SRR/2), body 2 with u_m (1 + SRR/2).
    #[serde(default = "first", skip_serializing_if = "is_first")]
    pub body: u8,
    /// Shape and place.
    pub shape: SurfaceShape,
}

/// Shape and place of a feature. Heights and lengths are in metres; a bump has a positive height. `at` is X at T = 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum SurfaceShape {
    /// Gaussian bump or dent, see [`Shape::Gauss`].
    Gauss {
        /// Height \[m\].
        height: f64,
        /// Width \[m\].
        width: f64,
        /// X at T = 0.
        at: f64,
    },
    /// Wave packet, see [`Shape::Venner`].
    Venner {
        /// Height \[m\].
        height: f64,
        /// Wavelength and width \[m\].
        width: f64,
        /// X at T = 0.
        at: f64,
    },
    /// Wave behind a smooth front, see [`Shape::Wave`].
    Wave {
        /// Amplitude \[m\].
        height: f64,
        /// Wavelength \[m\].
        wavelength: f64,
        /// Length of the front \[m\]; one wavelength if absent.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        front: Option<f64>,
        /// X of the front's tip at T = 0.
        at: f64,
    },
    /// Dent of a ball, see [`Shape::Dent`].
    Dent {
        /// Depth \[m\].
        depth: f64,
        /// Radius \[m\].
        radius: f64,
        /// X at T = 0.
        at: f64,
    },
    /// CSV file with the columns x and height \[m\]; x is measured from X = 0 at T = 0. A relative path refers to this
    /// scene's folder.
    Profile(PathBuf),
    /// Given heights over distances from the place.
    Sampled {
        /// Distances \[m\], increasing.
        places: Vec<f64>,
        /// Height at each of them \[m\].
        heights: Vec<f64>,
        /// X of the distance 0 at T = 0.
        at: f64,
    },
}

/// Largest number of features of a study.
const MOST_FEATURES: usize = 64;
/// Largest number of points of a profile.
const MOST_POINTS: usize = 1_000_000;

fn first() -> u8 {
    1
}

fn is_first(body: &u8) -> bool {
    *body == first()
}

/// Refuses numbers that are not finite, lengths that are not positive, and other bodies.
pub(crate) fn check(surfaces: &[SurfaceFeature]) -> Checked {
    count("study.surfaces (how many)", surfaces.len(), 0, MOST_FEATURES)?;
    for (k, SurfaceFeature { body, shape }) in surfaces.iter().enumerate() {
        let field = |name: &str| format!("study.surfaces.{k}.{name}");
        count(&field("body"), usize::from(*body), 1, 2)?;
        let height = |value: f64| number(&field("shape.height"), value, -1.0, 1.0);
        let length = |name: &str, value: f64| number(&field(name), value, 1e-12, 1.0);
        let place = |value: f64| number(&field("shape.at"), value, -1e6, 1e6);
        match *shape {
            SurfaceShape::Gauss { height: h, width, at } | SurfaceShape::Venner { height: h, width, at } => {
                height(h).and_then(|()| length("shape.width", width)).and_then(|()| place(at))
            }
            SurfaceShape::Wave { height: h, wavelength, front, at } => height(h)
                .and_then(|()| length("shape.wavelength", wavelength))
                .and_then(|()| length("shape.front", front.unwrap_or(wavelength)))
                .and_then(|()| place(at)),
            SurfaceShape::Dent { depth, radius, at } => number(&field("shape.depth"), depth, 0.0, 1.0)
                .and_then(|()| length("shape.radius", radius))
                .and_then(|()| place(at)),
            SurfaceShape::Profile(ref path) if path.as_os_str().is_empty() => {
                Err(refuse(field("shape"), "names no file"))
            }
            SurfaceShape::Profile(_) => Ok(()),
            SurfaceShape::Sampled { ref places, ref heights, at } => {
                count(&field("shape.places (how many)"), places.len(), 2, MOST_POINTS)?;
                count(&field("shape.heights (how many)"), heights.len(), places.len(), places.len())?;
                let finite = |name: &str, values: &[f64]| {
                    values.iter().try_for_each(|value| number(&field(name), *value, -1.0, 1.0))
                };
                finite("shape.places", places).and_then(|()| finite("shape.heights", heights))?;
                if !places.is_sorted_by(|former, next| former < next) {
                    return Err(refuse(field("shape.places"), "must increase"));
                }
                place(at)
            }
        }?;
    }
    Ok(())
}

impl SurfaceFeature {
    /// Returns the speed of its body over u_m for a slide-to-roll ratio.
    pub fn speed(&self, slide_to_roll_ratio: f64) -> f64 {
        MovingSurface::speed_of(self.body, slide_to_roll_ratio)
    }

    /// Converts the feature to the units of a contact, whose sliding sets the speed. `read` returns the points of a
    /// profile in metres.
    ///
    /// # Errors
    /// Those of `read`.
    pub fn moving<E>(
        &self,
        point: &OperatingPoint,
        read: impl Fn(&Path) -> Result<Vec<[f64; 2]>, E>,
    ) -> Result<MovingSurface, E> {
        let (a, film) = (point.hertz().half_width_m, point.film_scale_m());
        let speed = self.speed(point.sliding.slide_to_roll_ratio);
        let (at, shape) = match self.shape {
            SurfaceShape::Gauss { height, width, at } => (at, Shape::Gauss { height: height / film, width: width / a }),
            SurfaceShape::Venner { height, width, at } => {
                (at, Shape::Venner { height: height / film, width: width / a })
            }
            SurfaceShape::Wave { height, wavelength, front, at } => {
                let (front, wavelength) = (front.unwrap_or(wavelength) / a, wavelength / a);
                (at, Shape::Wave { height: height / film, wavelength, front })
            }
            SurfaceShape::Dent { depth, radius, at } => (at, Shape::Dent { depth: depth / film, radius: radius / a }),
            SurfaceShape::Profile(ref path) => {
                let (places, heights) = read(path)?.into_iter().map(|[x, height]| (x / a, height / film)).unzip();
                (0.0, Shape::Profile { places, heights })
            }
            SurfaceShape::Sampled { ref places, ref heights, at } => {
                let over = |values: &[f64], unit: f64| values.iter().map(|value| value / unit).collect();
                (at, Shape::Profile { places: over(places, a), heights: over(heights, film) })
            }
        };
        Ok(MovingSurface { speed, at, shape })
    }
}

/// Reads a profile: a title line `x,height`, then one point per line \[m\], in ascending order of x.
///
/// # Errors
/// If the file cannot be read, or with the first invalid line.
pub(crate) fn read_profile(path: &Path) -> Result<Vec<[f64; 2]>, SampledError> {
    let unreadable = |reason: String| SampledError::Read { path: path.to_owned(), reason };
    let bytes = files::read_at_most(path, MAX_SAMPLED_BYTES + 1).map_err(|error| unreadable(error.to_string()))?;
    let text = String::from_utf8(bytes).map_err(|_| unreadable("it is not UTF-8 text".to_owned()))?;
    if text.len() as u64 > MAX_SAMPLED_BYTES {
        return Err(unreadable(format!("it is larger than {} MiB", MAX_SAMPLED_BYTES >> 20)));
    }
    parsed(&text).map_err(|(line, problem)| SampledError::Line { path: path.to_owned(), line, problem })
}

/// Returns the points of a profile's text. An error is the line number, from 1, and the problem.
fn parsed(text: &str) -> Result<Vec<[f64; 2]>, (usize, String)> {
    let lines = || text.lines().enumerate().map(|(i, line)| (i + 1, line.trim())).filter(|(_, line)| !line.is_empty());
    let title = lines().next().map_or((1, Vec::new()), |(i, line)| (i, line.split(',').map(str::trim).collect()));
    if title.1 != ["x", "height"] {
        return Err((title.0, "the title line must be `x,height`, both in metres".to_owned()));
    }
    let mut points: Vec<[f64; 2]> = Vec::new();
    for (line, text) in lines().skip(1) {
        let numbers: Vec<Option<f64>> = text.split(',').map(|cell| cell.trim().parse().ok()).collect();
        let &[Some(x), Some(height)] = numbers.as_slice() else {
            return Err((line, format!("`{text}` must be two numbers, x and height")));
        };
        if !(x.is_finite() && height.is_finite()) {
            return Err((line, format!("`{text}` must be two finite numbers")));
        }
        if let Some([before, _]) = points.last().filter(|[before, _]| x <= *before) {
            return Err((line, format!("x is {x}, but must be greater than the previous {before}")));
        }
        points.push([x, height]);
    }
    if !(2..=MOST_POINTS).contains(&points.len()) {
        let problem = format!("there are {} points, but between 2 and {MOST_POINTS} are needed", points.len());
        return Err((title.0, problem));
    }
    Ok(points)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn profiles_are_read_and_refused_by_line() {
        assert_eq!(parsed("x, height\n0,1e-7\n\n1e-5,-2e-7\n").unwrap(), vec![[0.0, 1e-7], [1e-5, -2e-7]]);
        for (text, line, part) in [
            ("", 1, "title line"),
            ("x,h\n0,1\n1,1\n", 1, "title line"),
            ("x,height\n0,1\n", 1, "1 points"),
            ("x,height\n0,1\n1\n", 3, "two numbers"),
            ("x,height\n0,1\n1,NaN\n", 3, "finite"),
            ("x,height\n0,1\n0,1\n", 3, "greater than the previous 0"),
        ] {
            let (seen, problem) = parsed(text).unwrap_err();
            assert!(seen == line && problem.contains(part), "{text:?}: line {seen}: {problem}");
        }
    }

    #[test]
    fn each_body_moves_with_its_own_speed() {
        let mut point = OperatingPoint::TABLE_2_1;
        point.sliding.slide_to_roll_ratio = 0.5;
        let shape = SurfaceShape::Gauss { height: 1e-7, width: 2e-5, at: -2.0 };
        let none = |_: &Path| -> Result<Vec<[f64; 2]>, SampledError> { Ok(Vec::new()) };
        let moving = |body: u8| SurfaceFeature { body, shape: shape.clone() }.moving(&point, none).unwrap();
        assert_eq!((moving(1).speed, moving(2).speed), (0.75, 1.25));
        let Shape::Gauss { height, width } = moving(1).shape else { panic!() };
        assert!((height * point.film_scale_m() - 1e-7).abs() < 1e-20);
        assert!((width * point.hertz().half_width_m - 2e-5).abs() < 1e-18);
    }
}
