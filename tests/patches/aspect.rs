//! Figure 2's six types, by their eigenvalues and by their own points.

use attractor::num::Near;
use attractor::patch::{Address, End, Joint, Type, standard_curve};
use attractor::plane::Point2;

#[test]
fn figure_2_has_six_types() {
    let aspects = Type::ALL.map(|of| of.curve().unwrap().aspect());
    let ends = aspects.map(|aspect| (aspect.first, aspect.last, aspect.joint));
    use End::{Alternating, HalfTangent, Spiral};
    assert_eq!(
        ends,
        [
            (HalfTangent, HalfTangent, Joint::Smooth),
            (HalfTangent, HalfTangent, Joint::Angle),
            (HalfTangent, HalfTangent, Joint::Cusp),
            (Alternating, HalfTangent, Joint::Rough),
            (HalfTangent, Spiral, Joint::Rough),
            (Spiral, Spiral, Joint::Rough),
        ]
    );
    // from the other side: the curve's own points, nearer and nearer to the joint
    let points = [Point2::lit("0", "0"), Point2::lit("0.5", "0.5"), Point2::lit("1", "0")];
    for of in &Type::ALL[..3] {
        let curve = of.curve().unwrap();
        let at = |index: u32| {
            let point = curve.point(&points, Address::of(index, 31).unwrap());
            [point.x.to_num::<f64>(), point.y.to_num::<f64>()]
        };
        let middle = at(1 << 30);
        let direction = |index: u32| (at(index)[1] - middle[1]).atan2(at(index)[0] - middle[0]);
        let step = 1 << 14;
        let (back, on) = (direction((1 << 30) - step), direction((1 << 30) + step));
        let turned = ((on - back) / std::f64::consts::TAU + 0.5).rem_euclid(1.0);
        let turn = curve.turn(&points).unwrap().to_num::<f64>();
        let off = (turn - turned + 0.5).rem_euclid(1.0) - 0.5;
        // Takagi's cusp closes as 1 / log
        let bound = if of.letter == 'c' { 0.03 } else { 0.003 };
        assert!(off.abs() < bound, "{}: {turn} {turned}", of.letter);
    }
    assert!(Type::ALL[5].curve().unwrap().turn(&points).is_none());
    // a joint of opposite eigenvalues has no line of its own
    let balanced = standard_curve([Near::ZERO, Near::lit("0.25")], [Near::lit("0.75"), Near::lit("-0.125")]);
    assert_eq!(balanced.unwrap().aspect().first, End::Balanced);
}
