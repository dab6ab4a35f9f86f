//! Each point with parameters of its own gets what it would get alone.

use piola::lanes::{Lanes, Lanes2};
use piola::material::{Blocks, Graded, MaterialError, Scaled, Sum};
use piola::{Inversion, Material, Spline};
use piola_materials::{Gent, NeoHookean, Ogden, StVenantKirchhoff, StretchSpline};

type Four = Lanes2<Lanes2<f64>>;

/// Stretches of four points, one of them inverted.
const STRETCHES: [[f64; 4]; 3] = [[1.5, 1.2, 1.0, 1.1], [1.1, 1.2, 1.0, 0.9], [0.8, 0.7, 1.0, -0.3]];

/// Energy, gradient, gradient at strains and blocks, as bits: what is NaN for one must be so for the other.
fn bits<R>(
    energy: R,
    gradients: [[R; 3]; 2],
    blocks: Blocks<R>,
    split: impl Fn(R) -> [f64; 4],
) -> Vec<[u64; 4]> {
    let Blocks { gradient, hessian, flip, twist } = blocks;
    let all = [energy].into_iter().chain(gradients.into_iter().flatten()).chain(gradient).chain(hessian);
    all.chain(flip).chain(twist).map(|number| split(number).map(f64::to_bits)).collect()
}

fn split(numbers: Four) -> [f64; 4] {
    let mut lanes = [0.0; 4];
    numbers.store(&mut lanes);
    lanes
}

#[track_caller]
fn check<M: Graded>(materials: [M; 4]) {
    let [stretches, strains] = [0.0, 1.0].map(|shift| STRETCHES.map(|l| Four::load(&l.map(|x| x - shift))));
    let each = |materials: &[M]| {
        let material = M::on_lanes(|lane| &materials[lane.min(3)]);
        let gradients = [material.gradient(stretches), material.gradient_at_strains(strains)];
        let results = bits(material.energy(stretches), gradients, material.blocks(stretches), split);
        (results, Four::bits(material.admits(stretches)))
    };
    let uniform = |material: &M| {
        let gradients = [material.gradient(stretches), material.gradient_at_strains(strains)];
        let results = bits(material.energy(stretches), gradients, material.blocks(stretches), split);
        (results, Four::bits(material.admits(stretches)))
    };
    let (found, admitted) = each(&materials);
    for (lane, material) in materials.iter().enumerate() {
        let (alone, alone_admitted) = uniform(material);
        for (k, (found, alone)) in found.iter().zip(&alone).enumerate() {
            assert_eq!(found[lane], alone[lane], "number {k} of material {lane}");
        }
        assert_eq!(admitted >> lane & 1, alone_admitted >> lane & 1, "material {lane}");
    }
}

#[test]
fn each_point_gets_what_it_would_get_alone() -> Result<(), MaterialError> {
    let extend = Inversion::Extend { epsilon: 0.25 };
    let four = |build: fn(f64) -> Result<NeoHookean, MaterialError>| {
        Ok::<_, MaterialError>([build(1.0)?, build(2.5)?, build(0.3)?, build(40.0)?])
    };
    let rubbers = four(|mu| NeoHookean::new(mu, 3.0 + mu))?;
    check(rubbers);
    let [a, b, c, d] = rubbers;
    check([
        a.with_inversion(extend)?,
        b.with_inversion(extend)?,
        c.with_inversion(extend)?,
        d.with_inversion(extend)?,
    ]);
    check([a, a, a, a]);

    let ogden = |scale: f64| {
        Ogden::new([scale, 0.2], [1.3 * scale, 3.0 + scale], 5.0 / scale)?.with_inversion(extend)
    };
    check([ogden(1.0)?, ogden(0.7)?, ogden(2.0)?, ogden(1.5)?]);

    let steel = |mu: f64| StVenantKirchhoff::new(mu, 1.5);
    check([steel(1.0)?, steel(2.0)?, steel(3.0)?, steel(4.0)?]);

    // The bound of its domain is a parameter.
    let gent = |limit: f64| Gent::new(1.0, limit, 10.0);
    check([gent(0.5)?, gent(30.0)?, gent(1.0)?, gent(2.0)?]);

    let sum = |size: f64| Ok::<_, MaterialError>(Sum::new(gent(size)?, Scaled::new(size, steel(3.0)?)?));
    check([sum(0.5)?, sum(30.0)?, sum(1.0)?, sum(2.0)?]);

    // Functions, two of them the same.
    let drawn = |scale: f64| {
        let curve = |force: f64| {
            let knots = [[0.5, -force], [1.0, 0.0], [2.0 * scale, force]];
            Spline::through(&knots)
        };
        StretchSpline::new(curve(scale)?, curve(0.1)?, curve(3.0 * scale)?)
    };
    check([drawn(1.0)?, drawn(0.7)?, drawn(1.0)?, drawn(1.5)?]);
    check([drawn(1.0)?, drawn(1.0)?, drawn(1.0)?, drawn(1.0)?]);
    let (one, other) = (drawn(1.0)?, drawn(0.7)?);
    check([&one, &other, &other, &one]);
    check([one, other.clone(), other.clone(), other].map(|drawn| Scaled::new(2.0, drawn).expect("finite")));
    Ok(())
}

#[test]
fn a_parameter_can_be_replaced_and_is_checked() -> Result<(), MaterialError> {
    let extend = Inversion::Extend { epsilon: 0.25 };
    let rubber = NeoHookean::new(1.0, 3.0)?.with_inversion(extend)?;
    assert_eq!(rubber.with_lambda(5.0)?, NeoHookean::new(1.0, 5.0)?.with_inversion(extend)?);
    assert!(matches!(rubber.with_mu(-1.0), Err(MaterialError::Violated { .. })));
    assert!(matches!(rubber.with_lambda(f64::NAN), Err(MaterialError::NotFinite { .. })));
    Ok(())
}
