//! Products of two curves.

use attractor::num::Real;
use attractor::patch::{Address, Tensor, takagi};
use attractor_reference::patch::{self as reference, Matrix};

use super::seeded::{UNIT, Words, matrix, seeded_curve, worst};

/// `Tensor::height` against the tensor product of the maps; a product of Takagi's curves to the last bit.
#[test]
fn a_product_is_within_two_units_a_digit() {
    let takagi = takagi().unwrap();
    let product = Tensor::<2, 3, 3, 9>::new(takagi, takagi).unwrap();
    let mut heights = [Real::ZERO; 9];
    heights[4] = Real::lit("0.25");
    for i in 0..=64 {
        for j in 0..=64 {
            let at = [i, j].map(|index| Address::of(index, 6).unwrap());
            let exact = reference::takagi(f64::from(i) / 64.0) * reference::takagi(f64::from(j) / 64.0);
            assert_eq!(product.height(&heights, at).to_num::<f64>(), exact);
        }
    }
    let mut words = Words(17);
    let (mut tried, mut most) = (0, 0.0_f64);
    while tried < 10 {
        let (Some(u), Some(v)) = (seeded_curve(&mut words), seeded_curve(&mut words)) else { continue };
        let Ok(product) = Tensor::<2, 3, 3, 9>::new(u, v) else { continue };
        tried += 1;
        let heights: [Real; 9] = std::array::from_fn(|_| Real::from_num(words.between(-1.0, 1.0)));
        let [u, v] = [u, v].map(|curve| curve.maps().each_ref().map(matrix));
        let maps: Vec<Matrix> =
            u.iter().flat_map(|u| v.iter().map(move |v| reference::tensor(u, v))).collect();
        let size: f64 = heights.iter().map(|h| h.to_num::<f64>().abs()).sum();
        for _ in 0..60 {
            let levels = 1 + words.next() % 16;
            let [i, j] = [(); 2].map(|()| words.next() % (1 << levels));
            let digits: Vec<usize> = reference::digits(i, 2, levels)
                .iter()
                .zip(reference::digits(j, 2, levels))
                .map(|(i, j)| 2 * i + j)
                .collect();
            let phi = reference::phi(&maps, &digits, &[1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
            let want: f64 = phi.iter().zip(heights).map(|(w, h)| w * h.to_num::<f64>()).sum();
            let at = [i, j].map(|index| Address::of(index, levels).unwrap());
            let off = (product.height(&heights, at).to_num::<f64>() - want).abs();
            let bound = 2.0 * f64::from(levels) * UNIT * size + 2.0 / f64::from(1 << 24);
            assert!(off < bound, "{off} {bound}");
            most = most.max(off / bound);
            let weights = product.weights(at);
            assert!(worst(&weights, &phi) < 8.0 * f64::from(levels));
        }
    }
    assert!(most > 0.1, "{most}");
}
