use super::*;
use crate::solver::physics::bodies::{Bodies, Body};
use crate::solver::physics::contact::OperatingPoint;

fn close(a: f64, b: f64, relative: f64, what: &str) {
    assert!((a / b - 1.0).abs() < relative, "{what}: {a} against {b}");
}

/// Two bodies of E 206 GPa and ν 0.3.
fn steel() -> Bodies {
    Bodies(Bodies::on_plane(0.01, 1.0, 0.0).0.map(|body| Body { modulus_pa: 206e9, poisson: 0.3, ..body }))
}

#[test]
fn fzg_c_gears_have_the_published_geometry_and_pitch_point() {
    // FZG type C (ISO 14635, from memory): a 91.5 mm, tip diameters 82.46 mm and 118.36 mm, α_w 22.44°.
    let pair = GearPair::default();
    let geometry = pair.geometry().unwrap();
    close(geometry.centre_distance_m, 0.0915, 1e-5, "a");
    close(2e3 * geometry.tip_radii_m[0], 82.46, 1e-4, "tip diameter of the pinion");
    close(2e3 * geometry.tip_radii_m[1], 118.36, 1e-4, "tip diameter of the wheel");
    close(geometry.working_angle.to_degrees(), 22.44, 1e-3, "working pressure angle");
    // R 8.382 mm, u 2.194 m/s, 422.3 N/mm; E 206 GPa: p_H 1347.3 MPa, half width 199.57 µm.
    let contact = pair.contact().unwrap();
    close(contact.radius_m(), 8.382e-3, 1e-4, "R");
    close(contact.mean_speed(), 2.194, 5e-4, "u");
    close(contact.load, 422.3e3, 1e-4, "w");
    let [first, second] = contact.surfaces;
    close(first.speed_m_per_s, second.speed_m_per_s, 1e-12, "no sliding at the pitch point");
    let point = contact.operating_point(steel(), OperatingPoint::TABLE_2_1).unwrap();
    close(point.hertz().pressure_pa, 1347.3e6, 2e-4, "p_H");
    close(point.hertz().half_width_m, 199.57e-6, 2e-4, "half width");
}

#[test]
fn load_stages_of_micropitting_have_published_pressures() {
    // FVA 54/7, type C-GF (from memory): torque on the pinion [N m] and p_H at the pitch point [MPa].
    for (torque_n_m, published) in
        [(70.0, 795.1), (98.9, 945.1), (132.5, 1093.9), (171.6, 1244.9), (215.6, 1395.4), (265.1, 1547.3)]
    {
        let contact = GearPair { torque_n_m, ..GearPair::default() }.contact().unwrap();
        let point = contact.operating_point(steel(), OperatingPoint::TABLE_2_1).unwrap();
        close(1e-6 * point.hertz().pressure_pa, published, 5e-3, "p_H");
    }
}

#[test]
fn working_angles_solve_their_equation() {
    for angle in [0.05, 0.2, 0.35, 0.6, 1.0] {
        close(angle_of_involute(involute(angle)), angle, 1e-12, "inverse involute");
    }
    let pair = GearPair { teeth: (25, 40), shifts: (0.0, 0.0), helix_angle_deg: 15.0, ..GearPair::default() };
    let geometry = pair.geometry().unwrap();
    let helix = 15f64.to_radians();
    close(geometry.working_angle, (20f64.to_radians().tan() / helix.cos()).atan(), 1e-12, "α_t");
    close(geometry.centre_distance_m, 0.5 * 65.0 * 4.5e-3 / helix.cos(), 1e-12, "a");
    // Shifts of opposite sign leave the centre distance and move the path of contact.
    let moved = GearPair { shifts: (0.3, -0.3), ..pair }.geometry().unwrap();
    close(moved.centre_distance_m, geometry.centre_distance_m, 1e-12, "a");
    assert!(moved.path.1 > geometry.path.1 && moved.path.0 > geometry.path.0);
}

#[test]
fn the_contact_ratio_of_standard_spur_gears() {
    // Two gears of 20 teeth, 20°: 1.557. A gear and a rack of many teeth: towards 1.98 (Niemann and Winter, Fig. 21.6).
    let of = |one, other| {
        GearPair { teeth: (one, other), shifts: (0.0, 0.0), ..GearPair::default() }.geometry().unwrap().contact_ratio
    };
    close(of(20, 20), 1.557, 1e-3, "20/20");
    assert!(of(1000, 1000) < 1.985 && of(1000, 1000) > 1.95);
}

#[test]
fn curvature_and_sliding_follow_from_the_base_circles() {
    for pair in [GearPair::default(), GearPair { helix_angle_deg: 20.0, ..GearPair::default() }] {
        let geometry = pair.geometry().unwrap();
        let path = pair.path(61).unwrap();
        let line = geometry.centre_distance_m * geometry.working_angle.sin();
        for contact in &path {
            let [first, second] = contact.surfaces;
            let radii = [first, second].map(|surface| geometry.base_helix.cos() / surface.along);
            close(radii[0] + radii[1], line, 1e-12, "ρ₁ + ρ₂ = a sin α_w");
            // Sliding is the distance from the pitch point times the sum of both angular speeds.
            let turning = pair.pinion_rpm * TAU / 60.0 * (1.0 + 16.0 / 24.0);
            let sliding = first.speed_m_per_s - second.speed_m_per_s;
            assert!((sliding - contact.position * turning).abs() < 1e-12, "{sliding}");
        }
        // The tip of the pinion leaves last, at its tip radius.
        let last = geometry.base_helix.cos() / path[60].surfaces[0].along;
        close(last.hypot(geometry.base_radii_m[0]), geometry.tip_radii_m[0], 1e-12, "tip");
        // A point moves along the path at r_b ω.
        let speed = geometry.base_radii_m[0] * pair.pinion_rpm * TAU / 60.0;
        close((path[60].position - path[0].position) / (path[60].time_s - path[0].time_s), speed, 1e-12, "speed");
    }
}

#[test]
fn teeth_in_contact_carry_the_load_together() {
    let pair = GearPair::default();
    let geometry = pair.geometry().unwrap();
    let (from, to) = geometry.path;
    for k in 0..=100 {
        let position = from + geometry.base_pitch_m * (f64::from(k) + 0.5) / 101.0;
        let next = position + geometry.base_pitch_m;
        let other = if next <= to { geometry.share(next) } else { 0.0 };
        let sum = geometry.share(position) + other;
        assert!((sum - 1.0).abs() < 1e-9, "{position}: {sum}");
    }
    close(geometry.share(from), 1.0 / 3.0, 1e-9, "first contact");
    // Helical gears with full overlap: the mean length of the lines of contact carries the normal force.
    let helical = GearPair { helix_angle_deg: 25.0, face_width_m: 0.05, ..pair };
    let geometry = helical.geometry().unwrap();
    assert!(geometry.overlap_ratio > 1.0);
    let contact = helical.contact().unwrap();
    let normal = helical.torque_n_m / geometry.base_radii_m[0] / geometry.base_helix.cos();
    let length = geometry.contact_ratio * helical.face_width_m / geometry.base_helix.cos();
    close(contact.load, normal / length, 1e-12, "w");
}

#[test]
fn gears_that_do_not_mesh_are_refused() {
    let of = |change: fn(&mut GearPair)| {
        let mut pair = GearPair::default();
        change(&mut pair);
        pair.contact().unwrap_err().to_string()
    };
    let said = |text: String, words: &str| assert!(text.contains(words), "{text}");
    said(
        of(|p| p.shifts.0 = 0.0),
        "the pinion with 16 teeth is undercut: its profile shift is 0, but must be at least 0.064",
    );
    said(of(|p| (p.teeth, p.shifts) = ((8, 24), (1.2, 0.1))), "pointed");
    said(of(|p| p.position_m = 0.02), "the position is 20.000 mm from the pitch point");
    said(of(|p| p.module_m = f64::NAN), "the module is NaN");
    said(of(|p| p.torque_n_m = 0.0), "torque");
    said(of(|p| (p.teeth, p.shifts) = ((60, 60), (-2.0, -2.0))), "must be");
    said(of(|p| (p.teeth, p.pressure_angle_deg, p.shifts) = ((7, 7), 30.0, (0.4, 0.4))), "contact ratio");
}
