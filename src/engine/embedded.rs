//! The reduced models that are part of the program.

use super::model_file::{self, ModelFileError};
use super::trajectory_file;
use crate::solver::observer::Observer;
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::{Lubricant, ShearLaw};
use crate::solver::reduced::ReducedModel;
use crate::solver::reduced::transient::TrajectoryModel;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// One of them, by what it is for. Each is trained by a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Embedded {
    /// Line contacts of Newtonian lubricants: `scenes/training/line_oils.ron`.
    Line,
    /// Line contacts of lubricants that thin under shear: `scenes/training/embedded_shear_model.ron`.
    ThinningLine,
    /// Circular contacts: `scenes/training/point_oils.ron`.
    Circle,
    /// Circular contacts under so small a load that films reach far: `scenes/training/point_light_oils.ron`.
    LightCircle,
    /// Circular contacts of lubricants that thin under shear: `scenes/training/embedded_point_shear_model.ron`.
    ThinningCircle,
    /// Elliptical contacts: `scenes/training/embedded_ellipse_model.ron`.
    Ellipse,
    /// Line contacts of oils with heat: `scenes/training/line_heat.ron`.
    HeatedLine,
    /// Circular contacts of oils with heat: `scenes/training/point_heat.ron`.
    HeatedCircle,
    /// Line contacts of oils that thin by Eyring's law: `scenes/training/line_sliding_oils.ron`.
    EyringLine,
    /// Circular contacts of oils that thin by Eyring's law: `scenes/training/point_sliding_oils.ron`.
    EyringCircle,
    /// Those under so small a load that films reach far: `scenes/training/point_light_sliding_oils.ron`.
    LightEyringCircle,
}

/// The load number below which circles have a model of their own: there films reach beyond the domain of the other one.
const LIGHT: f64 = 12.0;

impl Embedded {
    /// All of them.
    pub const ALL: [Self; 11] = [
        Self::Line,
        Self::ThinningLine,
        Self::Circle,
        Self::LightCircle,
        Self::ThinningCircle,
        Self::Ellipse,
        Self::HeatedLine,
        Self::HeatedCircle,
        Self::EyringLine,
        Self::EyringCircle,
        Self::LightEyringCircle,
    ];

    /// The one of a kind of contact, circular where it is one of points, and of a lubricant that thins under shear by
    /// such a law.
    pub fn of_kind(kind: ContactKind, shear: ShearLaw) -> Self {
        match (kind, shear) {
            (ContactKind::Line, ShearLaw::Newtonian) => Self::Line,
            (ContactKind::Line, ShearLaw::Eyring { .. }) => Self::EyringLine,
            (ContactKind::Line, ShearLaw::Carreau { .. } | ShearLaw::Ellis { .. }) => Self::ThinningLine,
            (ContactKind::Point, ShearLaw::Newtonian) => Self::Circle,
            (ContactKind::Point, ShearLaw::Eyring { .. }) => Self::EyringCircle,
            (ContactKind::Point, ShearLaw::Carreau { .. } | ShearLaw::Ellis { .. }) => Self::ThinningCircle,
        }
    }

    /// The one of films with heat of a kind of contact, circular where it is one of points.
    pub fn with_heat(kind: ContactKind) -> Self {
        match kind {
            ContactKind::Line => Self::HeatedLine,
            ContactKind::Point => Self::HeatedCircle,
        }
    }

    /// The one that serves a contact. Ellipses of lubricants that thin under shear have none, nor have ellipses with heat:
    /// they get that of circles, which says so; as do contacts with heat whose lubricants thin.
    pub fn of(point: &OperatingPoint, lubricant: &Lubricant) -> Self {
        if lubricant.heat.is_some() {
            return Self::with_heat(point.kind);
        }
        match Self::of_kind(point.kind, lubricant.shear) {
            Self::Circle if point.radius_ratio() != 1.0 => Self::Ellipse,
            of_kind if point.radius_ratio() != 1.0 => of_kind,
            of_kind => of_kind.under_load(point.moes().m),
        }
    }

    /// The one of its kind that knows contacts of such a load number.
    pub fn under_load(self, m: f64) -> Self {
        match self {
            Self::Circle | Self::LightCircle if m < LIGHT => Self::LightCircle,
            Self::Circle | Self::LightCircle => Self::Circle,
            Self::EyringCircle | Self::LightEyringCircle if m < LIGHT => Self::LightEyringCircle,
            Self::EyringCircle | Self::LightEyringCircle => Self::EyringCircle,
            of_all => of_all,
        }
    }

    /// The content of its file.
    pub fn bytes(self) -> &'static [u8] {
        match self {
            Self::Line => include_bytes!("../../assets/line.rom"),
            Self::ThinningLine => include_bytes!("../../assets/line_shear.rom"),
            Self::Circle => include_bytes!("../../assets/point.rom"),
            Self::LightCircle => include_bytes!("../../assets/point_light.rom"),
            Self::ThinningCircle => include_bytes!("../../assets/point_shear.rom"),
            Self::Ellipse => include_bytes!("../../assets/ellipse.rom"),
            Self::HeatedLine => include_bytes!("../../assets/line_heat.rom"),
            Self::HeatedCircle => include_bytes!("../../assets/point_heat.rom"),
            Self::EyringLine => include_bytes!("../../assets/line_sliding.rom"),
            Self::EyringCircle => include_bytes!("../../assets/point_sliding.rom"),
            Self::LightEyringCircle => include_bytes!("../../assets/point_light_sliding.rom"),
        }
    }

    /// The model, which is read once. A test proves that its parts belong together; reading does not prove it again.
    ///
    /// # Errors
    /// When the program was built with a damaged asset.
    pub fn model(self) -> Result<Arc<ReducedModel>, ModelFileError> {
        self.model_watched(&())
    }

    /// The same while an observer watches.
    ///
    /// # Errors
    /// As [`Self::model`], and when the observer cancels.
    pub(super) fn model_watched(self, observer: &dyn Observer) -> Result<Arc<ReducedModel>, ModelFileError> {
        static READ: Mutex<Vec<(Embedded, Arc<ReducedModel>)>> = Mutex::new(Vec::new());
        // A thread that panicked leaves a whole list.
        let read = || READ.lock().unwrap_or_else(PoisonError::into_inner);
        let known = |read: &[(Self, Arc<ReducedModel>)]| {
            read.iter().find(|(which, _)| *which == self).map(|(_, model)| Arc::clone(model))
        };
        if let Some(model) = known(&read()) {
            return Ok(model);
        }
        let model = model_file::from_own_bytes(self.bytes(), observer).map(Arc::new)?;
        let mut read = read();
        // If another thread has read it in the meantime, everybody gets that one.
        Ok(known(&read).unwrap_or_else(|| {
            read.push((self, Arc::clone(&model)));
            model
        }))
    }
}

/// Whether a model's file would be, byte for byte, one of these.
pub(super) fn is_embedded(model: &ReducedModel) -> bool {
    model_file::to_bytes(model).is_ok_and(|bytes| Embedded::ALL.iter().any(|of| of.bytes() == bytes))
}

/// The content of the file of the model in time.
const LINE_IN_TIME: &[u8] = include_bytes!("../../assets/line_in_time.rom");

/// The model in time of line contacts whose load breathes: `scenes/training/line_in_time.ron`. It is read once, and what
/// it was trained for is asked with every picture.
///
/// # Errors
/// When the program was built with a damaged asset.
pub fn line_in_time() -> Result<Arc<TrajectoryModel>, ModelFileError> {
    static MODEL: OnceLock<Arc<TrajectoryModel>> = OnceLock::new();
    if let Some(model) = MODEL.get() {
        return Ok(Arc::clone(model));
    }
    let read = trajectory_file::from_own_bytes(LINE_IN_TIME)?;
    Ok(Arc::clone(MODEL.get_or_init(|| read)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::named_lubricant::SQUALANE_PIP;
    use crate::solver::physics::contact::{MoesRequest, Quantity, si_from_moes};
    use crate::solver::physics::lubricant::Heat;

    #[test]
    fn the_parts_of_every_model_belong_together() {
        for embedded in Embedded::ALL {
            let read = model_file::from_bytes(embedded.bytes()).unwrap_or_else(|why| panic!("{embedded:?}: {why}"));
            assert!(!read.windows.is_empty() && read.contact() == embedded.model().unwrap().contact());
        }
    }

    #[test]
    fn a_model_of_the_program_is_known_by_its_bytes_and_another_is_not() {
        let mut model = ReducedModel::clone(&Embedded::LightCircle.model().unwrap());
        assert!(is_embedded(&model));
        model.title.push('.');
        assert!(!is_embedded(&model));
    }

    #[test]
    fn the_parts_of_the_model_in_time_belong_together_and_it_survives_a_round_trip() {
        let read = trajectory_file::from_bytes(LINE_IN_TIME).unwrap();
        assert_eq!(read.domain, line_in_time().unwrap().domain);
        assert!(trajectory_file::to_bytes(&read).unwrap() == LINE_IN_TIME);
    }

    #[test]
    fn all_files_together_are_small() {
        let sizes = Embedded::ALL.map(|which| which.bytes().len());
        let all = sizes.iter().sum::<usize>() + LINE_IN_TIME.len();
        assert!(all < 25_000_000, "{all} bytes: {sizes:?} and {}", LINE_IN_TIME.len());
    }

    #[test]
    fn a_contact_is_served_by_the_model_of_its_shape_and_fluid() {
        let circle = si_from_moes(&MoesRequest::new(ContactKind::Point, 50.0, 5.0)).unwrap();
        let ellipse = Quantity::RadiusRatio.at(&circle, 2.0);
        let oil = Lubricant::default();
        assert_eq!([circle, ellipse].map(|point| Embedded::of(&point, &oil)), [Embedded::Circle, Embedded::Ellipse]);
        let light = si_from_moes(&MoesRequest::new(ContactKind::Point, 6.0, 5.0)).unwrap();
        assert_eq!(Embedded::of(&light, &oil), Embedded::LightCircle);
        let equal = Quantity::RadiusRatio.at(&circle, 1.0);
        assert_eq!(Embedded::of(&equal, &oil), Embedded::Circle);
        assert_eq!(Embedded::of(&ellipse, &SQUALANE_PIP), Embedded::ThinningCircle);
        let line = si_from_moes(&MoesRequest::new(ContactKind::Line, 50.0, 5.0)).unwrap();
        assert_eq!(Embedded::of(&line, &SQUALANE_PIP), Embedded::ThinningLine);
        let eyring = Lubricant { shear: ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 }, ..oil };
        let of_eyring = [line, circle, ellipse, light].map(|point| Embedded::of(&point, &eyring));
        let wanted =
            [Embedded::EyringLine, Embedded::EyringCircle, Embedded::EyringCircle, Embedded::LightEyringCircle];
        assert_eq!(of_eyring, wanted);
        let warm = Lubricant { heat: Some(Heat::default()), ..oil };
        let [of_line, of_circle, of_ellipse] = [line, circle, ellipse].map(|point| Embedded::of(&point, &warm));
        assert_eq!([of_line, of_circle], [Embedded::HeatedLine, Embedded::HeatedCircle]);
        assert_eq!(of_ellipse, of_circle, "it says that it knows circles only");
    }
}
