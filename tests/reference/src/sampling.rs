//! Where in a pixel rays are cast, and what each counts: `n x n` parts of a square, a sample at random in
//! each, or one in the middle.
//!
//! The places are a definition, which the kernel's are held to: two halves of a hash of the pixel, the seed
//! and the number of the sample.
//!
//! Source: Cochran, Lewis and Hart, "The Normal of a Fractal Surface", eq. 52-53; C. Wellons, "Prospecting
//! for hash functions", 2018, for the finaliser.

/// The samples of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Samples {
    /// Parts a side.
    pub n: u32,
    /// The seed of the places; none: the middles of the parts.
    pub seed: Option<u32>,
    /// Deviation and width in pixels of a Gaussian filter; none: equal weights over the pixel.
    pub gaussian: Option<[f64; 2]>,
}

impl Samples {
    /// Those of a pixel: offsets from its centre, in pixels, and weights.
    pub fn of(&self, (i, j): (u32, u32)) -> Vec<(f64, f64, f64)> {
        let n = f64::from(self.n);
        let width = self.gaussian.map_or(1.0, |[_, width]| width);
        let middle = |k: u32| (f64::from(k) + 0.5) / n * width - width / 2.0;
        let weight = |k: u32| match self.gaussian {
            Some([deviation, _]) => libm::exp(-middle(k) * middle(k) / (2.0 * deviation * deviation)),
            None => 1.0,
        };
        let sum: f64 = (0..self.n).map(weight).sum();
        let mut state = self.seed.map(|seed| hash(seed ^ hash(i.wrapping_add(hash(j)))));
        let mut all = Vec::new();
        for (row, column) in (0..self.n).flat_map(|row| (0..self.n).map(move |column| (row, column))) {
            let (mut dx, mut dy) = (middle(column), middle(row));
            if let Some(state) = &mut state {
                *state = hash(state.wrapping_add(0x9e37_79b9));
                let moved = |half: u32| (f64::from(half) / 65_536.0 - 0.5) * width / n;
                dx += moved(*state >> 16);
                dy += moved(*state & 0xffff);
            }
            all.push((dx, dy, weight(row) * weight(column) / sum / sum));
        }
        all
    }
}

fn hash(mut x: u32) -> u32 {
    x = (x ^ x >> 16).wrapping_mul(0x7feb_352d);
    x = (x ^ x >> 15).wrapping_mul(0x846c_a68b);
    x ^ x >> 16
}

#[cfg(test)]
mod tests {
    use super::Samples;

    #[test]
    fn samples_fill_their_parts_and_weights_add_up_to_1() {
        for (n, gaussian) in [(1, None), (4, None), (5, Some([0.5, 2.0]))] {
            let width = gaussian.map_or(1.0, |[_, width]| width);
            let still = Samples { n, seed: None, gaussian };
            let moved = Samples { seed: Some(7), ..still };
            for pixel in [(0, 0), (3, 200)] {
                let pairs = still.of(pixel).into_iter().zip(moved.of(pixel));
                let mut sum = 0.0;
                for (middle, sample) in pairs {
                    let half = width / f64::from(n) / 2.0;
                    assert!((sample.0 - middle.0).abs() <= half && (sample.1 - middle.1).abs() <= half);
                    assert_eq!(sample.2, middle.2);
                    sum += sample.2;
                }
                assert!((sum - 1.0).abs() < 1e-12, "{sum}");
            }
            assert_ne!(moved.of((0, 1)), moved.of((1, 0)));
        }
        assert_eq!(Samples { n: 1, seed: None, gaussian: None }.of((9, 9)), [(0.0, 0.0, 1.0)]);
    }
}
