//! Known constants, and identities that no single mistake leaves intact.

use piola::Real;
use piola_tests::multiprecision::Multiprecision;

type Number = Multiprecision<6>;

fn number(value: f64) -> Number {
    Number::splat(value)
}

/// A constant from its decimal digits: `units.fraction`.
fn decimal(text: &str) -> Number {
    let ten = number(10.0);
    let places = text.split_once('.').map_or(0, |(_, fraction)| fraction.len());
    let digits = text.bytes().filter(u8::is_ascii_digit);
    let whole = digits.fold(number(0.0), |value, digit| value * ten + number(f64::from(digit - b'0')));
    (0..places).fold(whole, |value, _| value / ten)
}

/// Within `units` of the type's unit roundoff, relative to the expected value.
#[track_caller]
fn close(found: Number, expected: Number, units: f64) {
    let error = ((found - expected) / expected).abs().to_f64() / Number::UNIT_ROUNDOFF;
    assert!(error <= units, "{found:?} instead of {expected:?}: {error} units");
}

/// The constants below have 116 digits, one more than 384 bits hold; their own rounding is a unit at most.
const UNITS: f64 = 2.0;

const E: &str = "2.7182818284590452353602874713526624977572470936999595749669676277240766303535475945713821785251664274274663919320031";
const LN_2: &str = "0.69314718055994530941723212145817656807550013436025525412068000949339362196969471560586332699641868754200148102057068573";
const LN_10: &str = "2.3025850929940456840179914546843642076011014886287729760333279009675726096773524802359972050895982983419677840422862";
const SQRT_2: &str = "1.4142135623730950488016887242096980785696718753769480731766797379907324784621070388503875343276415727350138462309123";
const CBRT_2: &str = "1.2599210498948731647672106072782283505702514647015079800819751121552996765139594837293965624362550941543102560356157";

#[test]
fn known_constants() {
    close(number(1.0).exp(), decimal(E), UNITS);
    close(number(2.0).ln(), decimal(LN_2), UNITS);
    close(number(10.0).ln(), decimal(LN_10), UNITS);
    close(number(2.0).sqrt(), decimal(SQRT_2), UNITS);
    close(number(2.0).cbrt(), decimal(CBRT_2), UNITS);
    close(number(2.0).powf(number(1.0) / number(3.0)), decimal(CBRT_2), UNITS);
}

/// Values with 125 digits from mpmath 1.3.
#[test]
fn known_values() {
    type Function = fn(Number) -> Number;
    let values: [(Function, f64, &str); 29] = [
        (
            Number::sin,
            2.0,
            "0.90929742682568169539601986591174484270225497144789026837897301153096730154078354462012668892495938030996789674239948626128095",
        ),
        (
            Number::sin,
            -1e5,
            "-0.035748797972016509316470500695808829009045692578108896854616736500948074286683925056026366384310563074915780204624905908657241",
        ),
        (
            Number::sin,
            0.015625,
            "0.015624364224883372174790801770746185637646783544862385355269000966794045443305247269935610569237201724256724146275200301945508",
        ),
        (
            Number::cos,
            2.0,
            "-0.41614683654714238699756822950076218976600077107554489075514997378196493612407916907453177786016914036736679136521572855928866",
        ),
        (
            Number::cos,
            1e5,
            "-0.99936080743821245189113541414480220323538658745972747644104112197277057143022204204489085957501848763831111762886552176224962",
        ),
        (
            Number::cos,
            0.015625,
            "0.99987793217100665473601600936915946136553852442848934584031652453521371060901367728504538443153142573022031095755183596822108",
        ),
        (
            Number::atan,
            0.375,
            "0.35877067027057222039592006392646049977697565588091577964039886675470318422112932874326440926942537307078406740959092939334524",
        ),
        (
            Number::atan,
            -3.0,
            "-1.2490457723982544258299170772810901230778294041298967190546692367971519657372939549576089903204171595520668738795114141752793",
        ),
        (
            Number::atan,
            1e5,
            "1.5707863267948969525646550049730847768604894614812037041473568560376988569338249566344688507754383411567325544850068752011772",
        ),
        (
            Number::erf,
            0.375,
            "0.40411690943482229832382508591912176753043404675108456036639328906146206219587022051434614911119358116813052441821774660370587",
        ),
        (
            Number::erf,
            -3.0,
            "-0.999977909503001414558627223870417679620152292912600750342761045157057543316379867732183745349184683712856553800271838764743",
        ),
        (
            Number::erf,
            6.0,
            "0.99999999999999997848026328750108688340664960081261536952248593831145789947210794894366276151507213961561139918081020707190038",
        ),
        (
            Number::sinh,
            0.375,
            "0.3838510679136145687542956764205024589560949985959473060062922192192588336306904175138400082262189549657836173531447889945581",
        ),
        (
            Number::sinh,
            -3.0,
            "-10.017874927409901898974593619465828060178104123182863464405653251046392605180887090525221458008192178813603143600527660465473",
        ),
        (
            Number::cosh,
            0.375,
            "1.0711403467045867672994980155670160493907470223684683751889491089648831206886014548227501471650854980037940341544837112531228",
        ),
        (
            Number::cosh,
            -3.0,
            "10.067661995777765841953936035115889836809803715371286679973280978652453272911086640679275702244825523340004472251421342416338",
        ),
        (
            Number::tanh,
            0.375,
            "0.3583573983507859463193602315531580424684424964391520439659034873610917503642096111928793699920196720845384102057452519403729",
        ),
        (
            Number::tanh,
            -3.0,
            "-0.99505475368673045133188018525548847509781385470028249182387881513066470278255917671939596002231175799699924447177995985233648",
        ),
        (
            Number::asinh,
            0.375,
            "0.36672460423013676549096666035862112698670014638469665711457691055166305177154437862922204607344497807776507890012003425053468",
        ),
        (
            Number::asinh,
            -3.0,
            "-1.8184464592320668234836989635607089937862539427681216174517441672330541078661757510260840443607926936308409194688453264921909",
        ),
        (
            Number::exp_m1,
            0.375,
            "0.45499141461820133605379369198751850834684202096441568119524132818414195431929187233659015539130445296957765150762850024768089",
        ),
        (
            Number::exp_m1,
            -3.0,
            "-0.95021293163213605702065758434993822336830040781157678443237227239393933226980044984594575576336665547359867134910631804913536",
        ),
        (
            Number::ln_1p,
            0.375,
            "0.31845373111853461581024721359059959559520645085665141285652768065039275800415256625746472701337872878871128282642594132119901",
        ),
        (
            Number::ln_1p,
            -0.625,
            "-0.98082925301172623685645112745200399957900984525801631062734569484268657269047517994397422617552397383803441399575419145868856",
        ),
        (
            Number::ln_1p,
            0.001953125,
            "0.0019512201312617494396740495318415385003497255250798866559231518812329839927717488822357052891679742829373912334875619729562843",
        ),
        (
            Number::softplus,
            -3.0,
            "0.048587351573742058758925919854689997941881642828108620530846980487519818661466782024599789194385859958184991256102865517215911",
        ),
        (
            Number::softplus,
            0.375,
            "0.89812326413984004361904166852690650665659100463104075332744887269972685399226430433667691349612407935849017790837899061399062",
        ),
        (
            Number::sigmoid,
            -3.0,
            "0.047425873177566780878848151771752201386179432420609100717888008774448711502710233885783654491060039005918076966750433446886982",
        ),
        (
            Number::sigmoid,
            0.375,
            "0.59266659995406975876605998751241393672808214491280142275132841591156921112817685174893356549608913058155184752932833176702723",
        ),
    ];
    for (function, x, digits) in values {
        let (sign, digits) = digits.strip_prefix('-').map_or((1.0, digits), |digits| (-1.0, digits));
        let expected = number(sign) * decimal(digits);
        // The reduction of x for sin and cos, and the 1 that ln(1 + x) adds, are absolute errors.
        let condition = (1.0 + x.abs()) * (1.0 + 1.0 / expected.to_f64().abs());
        close(function(number(x)), expected, UNITS * condition);
    }
}

#[test]
fn functions_of_small_numbers_keep_their_digits() {
    let x = number(2f64.powi(-150));
    let one = number(1.0);
    // The next term of each series is less than 2⁻²⁹⁹ of the first.
    let next = 2f64.powi(-299) / Number::UNIT_ROUNDOFF;
    let (square, half) = (x * x / number(2.0), x / number(2.0));
    close(x.exp_m1(), x + square, next);
    close((-x).exp_m1(), square - x, next);
    close(x.ln_1p(), x - square, next);
    close((-x).ln_1p(), -x - square, next);
    close(x.cosh() - one, square, 2f64.powi(301)); // digits that 1 takes
    for odd in [Number::sinh, Number::tanh, Number::asinh, Number::sin, Number::atan] {
        close(odd(x), x, next);
        close(odd(-x), -x, next);
    }
    close(x.erf(), x / one.atan().sqrt(), next);
    close(x.sigmoid(), (one + half) / number(2.0), UNITS * 2.0);
    for vanishing in [Number::exp_m1, Number::ln_1p, Number::sinh, Number::sin, Number::atan, Number::erf] {
        assert_eq!(vanishing(number(0.0)).to_f64(), 0.0);
    }
}

#[test]
fn functions_of_large_numbers_reach_their_limits() {
    let (large, one) = (number(1e30), number(1.0));
    for (function, limit) in
        [(Number::tanh as fn(Number) -> Number, one), (Number::erf, one), (Number::sigmoid, one)]
    {
        close(function(large), limit, UNITS);
    }
    close(large.softplus(), large, UNITS);
    assert_eq!((-large).softplus().to_f64(), 0.0);
    assert_eq!((-large).sigmoid().to_f64(), 0.0);
    close((-large).exp_m1(), -one, UNITS);
    assert!(!large.sin().is_finite() && !(-one - one).ln_1p().is_finite());
}

#[test]
fn arithmetic_inverts_itself() {
    let (a, b) = (decimal(E), -decimal(SQRT_2));
    for (a, b) in [(a, b), (b, a), (a * a, b * b), (number(1e-200), a), (a, number(1e-300) * b)] {
        close(a * b / b, a, 1.0);
        close(a / b * b, a, 1.0);
        close((a + b) * (a - b) + b * b, a * a, 4.0 * (1.0 + (b / a * (b / a)).to_f64().abs()));
        close(a.abs().sqrt() * a.abs().sqrt(), a.abs(), 1.0);
        close(a.cbrt() * a.cbrt() * a.cbrt(), a, 1.0);
    }
}

#[test]
fn subtraction_of_close_numbers_is_exact() {
    let tiny = number(2f64.powi(-300));
    let one = number(1.0);
    assert_eq!(((one + tiny) - one).to_f64(), tiny.to_f64());
    assert_eq!((one - (one - tiny)).to_f64(), tiny.to_f64());
    assert_eq!((one - one).to_f64(), 0.0);
    // Below the last bit of the larger one, the smaller disappears.
    assert_eq!(((one + number(2f64.powi(-500))) - one).to_f64(), 0.0);
}

#[test]
fn exponential_and_logarithm_invert_each_other() {
    for x in [1e-30, 0.1, 0.5, 1.0 - 1e-16, 1.0 + 1e-15, 3.0, 1e10, 1e300] {
        let x = number(x);
        let logarithm = x.ln();
        close(logarithm.exp(), x, 2.0 * (1.0 + logarithm.to_f64().abs()));
        close((number(0.3) * logarithm).exp(), x.powf(number(0.3)), 2.0 * (1.0 + logarithm.to_f64().abs()));
    }
    // ln(1 + t) = t − t²/2 + … keeps its relative accuracy where 1 + t keeps t.
    let t = number(2f64.powi(-150));
    let series = t - t * t / number(2.0) + t * t * t / number(3.0);
    close((number(1.0) + t).ln(), series, 2f64.powi(150));
}

#[test]
fn product_and_error_are_exact() {
    let (a, b) = (decimal(E), decimal(LN_10));
    let (product, error) = a.two_product(b);
    assert!(error.abs().to_f64() <= product.to_f64() * 2f64.powi(-383));
    // The same product in twice the precision.
    let widen = |mut x: Number| {
        let mut wide = Multiprecision::<12>::splat(0.0);
        while x.to_f64() != 0.0 {
            let part = x.to_f64();
            (wide, x) = (wide + Multiprecision::splat(part), x - number(part));
        }
        wide
    };
    let difference = widen(a) * widen(b) - (widen(product) + widen(error));
    assert_eq!(difference.to_f64(), 0.0);
}

#[test]
fn conversion_keeps_every_f64() {
    for x in [0.1, -1.5, f64::MAX, f64::MIN_POSITIVE, 5e-324, -1e-310, 0.0] {
        assert_eq!(number(x).to_f64(), x);
    }
    assert!(number(f64::NAN).to_f64().is_nan());
    assert_eq!((number(f64::MAX) * number(2.0)).to_f64(), f64::INFINITY);
}

#[test]
fn order_signs_and_what_is_not_a_number() {
    let nan = number(1.0) / number(0.0);
    assert!(!nan.is_finite() && !nan.less(number(1.0)) && !number(1.0).less(nan));
    assert_eq!(nan.max(number(2.0)).to_f64(), 2.0);
    assert_eq!(number(2.0).min(nan).to_f64(), 2.0);
    let ascending = [-3.0, -0.5, -1e-300, 0.0, 1e-300, 0.5, 0.75, 3.0];
    for (i, &a) in ascending.iter().enumerate() {
        for (j, &b) in ascending.iter().enumerate() {
            assert_eq!(number(a).less(number(b)), i < j, "{a} < {b}");
            assert_eq!(number(a).max(number(b)).to_f64(), a.max(b));
            assert_eq!(number(a).min(number(b)).to_f64(), a.min(b));
        }
    }
    assert_eq!(number(2.0).copysign(number(-0.0)).to_f64(), -2.0);
    assert!(!number(-1.0).ln().is_finite() && !number(-1.0).sqrt().is_finite());
    let (scale, back) = number(-12.0).power_of_two_scale();
    assert_eq!((scale.to_f64(), back.to_f64()), (0.125, 8.0));
}
