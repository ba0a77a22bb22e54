use super::*;
use std::f64::consts::PI;

fn close(a: f64, b: f64, relative: f64, what: &str) {
    assert!((a / b - 1.0).abs() < relative, "{what}: {a} against {b}");
}

fn eccentric(follower: Follower) -> CamFollower {
    CamFollower { follower, lift: Lift::Eccentric { eccentricity_m: 3e-3 }, ..CamFollower::default() }
}

const ROLLER: Follower = Follower::Roller { radius_m: 8e-3 };

#[test]
fn an_eccentric_is_a_circle_whatever_runs_on_it() {
    // A circle of radius r_b + e around a centre at the distance e from the axis.
    for contact in eccentric(Follower::Flat).path(73).unwrap() {
        close(contact.radius_m(), 23e-3, 1e-12, "R of the flat follower");
        close(contact.surfaces[0].speed_m_per_s, 157.079_632_679 * 23e-3, 1e-9, "u₁");
    }
    // The roller follower of lift e(1 + cos θ) is not driven by a circle, but its centre is: at θ = 0 and π the
    // curvature of the limaçon r = c + e cos θ is (c² ± 3ce + 2e²)/(c ± e)³.
    let cam = eccentric(ROLLER);
    let c = 0.02 + 8e-3 + 3e-3;
    for (angle, e) in [(0.0, 3e-3), (PI, -3e-3)] {
        let contact = CamFollower { angle_deg: f64::to_degrees(angle), ..cam.clone() }.contact().unwrap();
        let curvature = (c * c + 3.0 * c * e + 2.0 * e * e) / f64::powi(c + e, 3);
        close(contact.surfaces[0].along.recip(), curvature.recip() - 8e-3, 1e-9, "radius of the cam");
    }
}

#[test]
fn a_cam_without_slope_is_its_base_circle() {
    // Outside the event: a roller on a circle, both with the speed of the surface of the base circle.
    let cam = CamFollower { follower: ROLLER, angle_deg: 120.0, ..CamFollower::default() };
    let contact = cam.contact().unwrap();
    close(contact.radius_m(), 1.0 / (1.0 / 0.02 + 1.0 / 8e-3), 1e-12, "R");
    close(contact.mean_speed(), 157.079_632_679 * 0.02, 1e-9, "u");
    close(contact.load, 250.0 / 0.012, 1e-12, "w");
    let flat = CamFollower { follower: Follower::Flat, ..cam }.contact().unwrap();
    close(flat.mean_speed(), 0.5 * 157.079_632_679 * 0.02, 1e-9, "u of the flat follower");
}

#[test]
fn the_profile_by_its_points_has_the_curvature_and_speed() {
    // Independent of the formulas: points of the cam as the envelope of the follower in the frame of the cam.
    let turning = 157.079_632_679;
    for follower in [Follower::Flat, ROLLER] {
        let cam = CamFollower { follower, ..CamFollower::default() };
        let curve = cam.lift.curve().unwrap();
        let point = |angle: f64| {
            let [lift, slope, _] = curve.at(angle);
            let (radial, tangential) = match follower {
                Follower::Flat => (cam.base_radius_m + lift, slope),
                Follower::Roller { radius_m } => {
                    let radius = cam.base_radius_m + radius_m + lift;
                    let length = radius.hypot(slope);
                    (radius - radius_m * radius / length, radius_m * slope / length)
                }
            };
            let (sine, cosine) = angle.sin_cos();
            [radial * cosine - tangential * sine, radial * sine + tangential * cosine]
        };
        for k in -12..=12 {
            let (angle, h) = (0.1 * f64::from(k) + 0.013, 1e-4);
            let [[x0, y0], [x1, y1], [x2, y2]] = [angle - h, angle, angle + h].map(point);
            let [dx, dy] = [(x2 - x0) / (2.0 * h), (y2 - y0) / (2.0 * h)];
            let [ddx, ddy] = [(x2 - 2.0 * x1 + x0) / (h * h), (y2 - 2.0 * y1 + y0) / (h * h)];
            let curvature = (dx * ddy - dy * ddx) / dx.hypot(dy).powi(3);
            let contact = CamFollower { angle_deg: angle.to_degrees(), ..cam.clone() }.contact().unwrap();
            let [surface, other] = contact.surfaces;
            assert!((surface.along / curvature - 1.0).abs() < 1e-4, "{angle}: {} {curvature}", surface.along);
            // The contact moves along the cam at the rate of its arc length.
            close(surface.speed_m_per_s, turning * dx.hypot(dy), 1e-6, "u₁");
            // Sliding: the flat face sees the whole speed of the cam at the height of the contact.
            let sliding = surface.speed_m_per_s - other.speed_m_per_s;
            let expected =
                if follower == Follower::Flat { turning * (cam.base_radius_m + curve.at(angle)[0]) } else { 0.0 };
            assert!((sliding - expected).abs() < 1e-9, "{sliding} {expected}");
        }
    }
}

#[test]
fn the_force_balances_spring_inertia_and_the_pressure_angle() {
    let cam = CamFollower { follower: ROLLER, angle_deg: 40.0, ..CamFollower::default() };
    let state = cam.state().unwrap();
    let [lift, slope, second] = cam.lift.curve().unwrap().at(40f64.to_radians());
    let turning = 1500.0 * TAU / 60.0;
    let axial = 250.0 + 25e3 * lift + 0.1 * turning * turning * second;
    close(state.force_n * state.pressure_angle.cos(), axial, 1e-12, "axial force");
    close(state.pressure_angle.tan(), slope / (0.028 + lift), 1e-12, "pressure angle");
    // Virtual work: the torque on the cam times the angle is the work of the follower.
    let torque = axial * slope;
    let arm = (0.028 + lift) * state.pressure_angle.sin();
    close(state.force_n * arm, torque, 1e-12, "torque");
}

#[test]
fn a_table_of_a_law_gives_the_contact_of_the_law() {
    let law = CamFollower::default();
    let curve = law.lift.curve().unwrap();
    let points = (-150..=150).map(|k| (0.5 * f64::from(k), curve.at((0.5 * f64::from(k)).to_radians())[0]));
    let table = CamFollower { lift: Lift::Table(points.collect()), ..law.clone() };
    for angle_deg in [-60.0, -20.0, 0.0, 33.0] {
        let [a, b] = [&law, &table].map(|cam| CamFollower { angle_deg, ..cam.clone() }.contact().unwrap());
        close(a.radius_m(), b.radius_m(), 5e-3, "R");
        close(a.load, b.load, 5e-3, "w");
    }
}

#[test]
fn entrainment_reverses_and_the_bodies_are_turned_with_it() {
    use crate::solver::physics::bodies::Bodies;
    let path = CamFollower::default().path(301).unwrap();
    assert!(path.iter().any(|contact| contact.mean_speed() < 0.0) && path.iter().any(|c| c.mean_speed() > 0.0));
    for contact in path {
        let (mean, _) = contact.bodies(Bodies::on_plane(0.01, 1.0, 0.0)).entrainment().unwrap();
        close(mean, contact.mean_speed().abs(), 1e-12, "u");
    }
}

#[test]
fn cams_that_lose_their_follower_are_refused_with_the_angle() {
    let of = |change: fn(&mut CamFollower)| {
        let mut cam = CamFollower::default();
        change(&mut cam);
        cam.contact().unwrap_err().to_string()
    };
    let said = |text: String, words: &str| assert!(text.contains(words), "{text}");
    said(of(|c| c.rpm = 6000.0), "at a cam angle of 0.0° the follower leaves the cam: the spring gives 425.0 N");
    said(of(|c| c.base_radius_m = 0.015), "at a cam angle of 0.0° the cam has a radius of curvature of -2.5");
    said(of(|c| (c.follower, c.base_radius_m) = (Follower::Roller { radius_m: 0.03 }, 0.005)), "undercuts");
    said(of(|c| c.width_m = f64::NAN), "the width is NaN");
    said(of(|c| c.lift = Lift::Table(Vec::new())), "the lift table has 0 points");
    said(of(|c| c.lift = Lift::Polynomial { lift_m: -1.0, half_event_deg: 75.0 }), "lift");
}
