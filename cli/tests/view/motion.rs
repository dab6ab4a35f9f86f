//! Bodies that are pulled, without sockets.

use piola_scenes::measure;
use piola_scenes::output::Summary;
use piola_viewer::protocol::Act;
use piola_viewer::session::Session;

use crate::{BACK, LEG, TAIL, bits, pull, session, steps};

#[test]
fn another_material_takes_over_where_the_body_is() {
    let mut session = session();
    session.apply(&pull(TAIL, [-3.0, 2.0, 0.5])).expect("a pull");
    steps(&mut session, 5);
    let place = |session: &Session| session.play().simulation.positions().to_vec();
    let before = place(&session);
    let mu = session.play().moduli.mu;
    session.apply(&Act::Material { name: "neo_hookean".into(), as_stiff: true }).expect("a material");
    assert_eq!(session.play().material, "neo_hookean");
    // As tight as the scaling promises.
    assert!((session.play().moduli.mu / mu - 1.0).abs() <= 1e-12);
    assert_eq!(place(&session), before);
    steps(&mut session, 1);
    assert_ne!(place(&session), before);

    let before = bits(&session);
    for act in [
        Act::Parameter { name: "mu".into(), values: vec![-1.0] },
        Act::Parameter { name: "alpha".into(), values: vec![1.0] },
        Act::Material { name: "steel".into(), as_stiff: false },
        Act::TimeStep { seconds: 0.0 },
        Act::TimeStep { seconds: f64::INFINITY },
        Act::Restore {},
        pull(1_000_000, [0.0; 3]),
        pull(TAIL, [f64::NAN, 0.0, 0.0]),
        pull(TAIL, [0.0, 1e9, 0.0]),
    ] {
        session.apply(&act).expect_err("nonsense");
        assert!(bits(&session) == before, "{act:?} left its mark");
    }
    session.apply(&Act::Material { name: "ogden".into(), as_stiff: true }).expect("a material");
    assert_eq!(session.play().moduli.mu, mu, "the scene's own material is that of the scene");
}

#[test]
fn pulls_are_numbered_and_limited() {
    let mut session = session();
    for drag in 0..64 {
        session.apply(&Act::Pull { drag, vertex: BACK, target: [0.0, 2.0, 0.0] }).expect("a pull");
    }
    session.apply(&Act::Pull { drag: 7, vertex: BACK, target: [0.0, 2.1, 0.0] }).expect("the same drag");
    let error = session.apply(&Act::Pull { drag: 64, vertex: BACK, target: [0.0; 3] }).expect_err("too many");
    assert!(error.to_string().contains("64"), "{error}");
    session.apply(&Act::ReleaseAll {}).expect("a release");
    assert_eq!(session.pulls().count(), 0);
}

/// The tail drawn across the body, five heights far, and a leg torn until elements stay inside out.
#[test]
fn pulled_several_heights_far_and_inside_out_it_comes_back() {
    let rest = session().play().geometry.mesh.clone();
    let judge = |session: &Session| {
        let positions = session.play().simulation.positions();
        let far = measure::max_distance(&rest.positions, positions) / rest.bounds().size()[1];
        (far, measure::inverted(&rest.positions, positions, &rest.tets))
    };
    for (vertex, target, distance, inside_out) in
        [(TAIL, [9.0, 2.0, 0.0], 5.0, false), (LEG, [-5.0, -0.2, -2.5], 1.5, true)]
    {
        let mut session = session();
        // The scene's own pull ends after two seconds, and the body is at rest after six.
        steps(&mut session, 180);
        session.apply(&pull(vertex, target)).expect("a pull");
        steps(&mut session, 90);
        let (far, inverted) = judge(&session);
        assert!(
            far > distance && (inverted > 0) == inside_out,
            "{vertex}: {far} heights, {inverted} inverted"
        );
        session.apply(&Act::Release { drag: 1 }).expect("a release");
        steps(&mut session, 300);
        let (far, inverted) = judge(&session);
        // As `piola run` judges it.
        assert!(far <= Summary::RECOVERED && inverted == 0, "{vertex}: {far} heights, {inverted} inverted");
    }
}
