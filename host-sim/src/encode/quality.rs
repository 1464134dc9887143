//! How like two pictures are: PSNR, and MS-SSIM.
//!
//! MS-SSIM: Z. Wang, E. Simoncelli, A. Bovik, "Multiscale structural similarity for image quality
//! assessment",
//! 2003; windows of 11 x 11 with a Gaussian of 1.5, `K1 = 0.01`, `K2 = 0.03`, five scales, of the mean of the
//! channels. Smaller pictures have fewer scales, the weights in proportion.

/// Peak signal to noise in decibels, of the squared error of so many samples; infinite for equal ones.
pub(crate) fn decibels(error: f64, count: usize, peak: u32) -> f64 {
    10.0 * (f64::from(peak).powi(2) * count as f64 / error).log10()
}

const WEIGHTS: [f64; 5] = [0.0448, 0.2856, 0.3001, 0.2363, 0.1333];

/// A plane of numbers.
#[derive(Clone)]
struct Plane {
    width: usize,
    height: usize,
    values: Vec<f64>,
}

impl Plane {
    fn halved(&self) -> Self {
        let (width, height) = (self.width / 2, self.height / 2);
        let at = |x: usize, y: usize| self.values[y * self.width + x];
        let mean = |x, y| 0.25 * (at(x, y) + at(x + 1, y) + at(x, y + 1) + at(x + 1, y + 1));
        let values = (0..width * height).map(|i| mean(2 * (i % width), 2 * (i / width))).collect();
        Self { width, height, values }
    }
}

/// Weighted means of all windows that lie inside, of rows of a width.
fn blurred(values: &[f64], width: usize) -> Vec<f64> {
    let weights: Vec<f64> = (-5..=5).map(|k| (-f64::from(k * k) / 4.5).exp()).collect();
    let total: f64 = weights.iter().sum();
    let (height, across) = (values.len() / width, width - 10);
    let sum = |values: &[f64], start: usize, step: usize| -> f64 {
        weights.iter().enumerate().map(|(k, w)| w / total * values[start + k * step]).sum()
    };
    let rows: Vec<f64> =
        (0..height * across).map(|i| sum(values, i / across * width + i % across, 1)).collect();
    (0..(height - 10) * across).map(|i| sum(&rows, i, across)).collect()
}

/// How many rows are compared at a time.
const STRIP: usize = 64;

/// Mean luminance and structure terms of one scale.
fn terms(a: &Plane, b: &Plane, peak: f64) -> (f64, f64) {
    let (c1, c2) = ((0.01 * peak).powi(2), (0.03 * peak).powi(2));
    let (width, down) = (a.width, a.height - 10);
    let (mut light, mut structure) = (0.0, 0.0);
    for top in (0..down).step_by(STRIP) {
        let rows = top * width..((top + STRIP).min(down) + 10) * width;
        let (a, b) = (&a.values[rows.clone()], &b.values[rows]);
        let product = |x: &[f64], y: &[f64]| {
            let values: Vec<f64> = x.iter().zip(y).map(|(x, y)| x * y).collect();
            blurred(&values, width)
        };
        let (ma, mb) = (blurred(a, width), blurred(b, width));
        let (aa, bb, ab) = (product(a, a), product(b, b), product(a, b));
        for i in 0..ma.len() {
            let (x, y) = (ma[i], mb[i]);
            light += (2.0 * x * y + c1) / (x * x + y * y + c1);
            structure += (2.0 * (ab[i] - x * y) + c2) / (aa[i] - x * x + bb[i] - y * y + c2);
        }
    }
    let windows = (down * (width - 10)) as f64;
    (light / windows, structure / windows)
}

/// From 0 to 1; none for pictures below 11 x 11. Samples of `channels` channels, row after row.
pub(crate) fn ms_ssim(a: Vec<f64>, b: Vec<f64>, width: u32, channels: usize, peak: u32) -> Option<f64> {
    let grey = |samples: Vec<f64>| {
        let values: Vec<f64> = match channels {
            1 => samples,
            _ => samples.chunks_exact(channels).map(|p| p.iter().sum::<f64>() / channels as f64).collect(),
        };
        Plane { width: width as usize, height: values.len() / width as usize, values }
    };
    let (mut a, mut b) = (grey(a), grey(b));
    let scales = (0..5).take_while(|k| a.width >> k >= 11 && a.height >> k >= 11).count();
    let total: f64 = WEIGHTS[..scales].iter().sum();
    let mut product = 1.0;
    for (k, weight) in WEIGHTS[..scales].iter().enumerate() {
        let (light, structure) = terms(&a, &b, f64::from(peak));
        let term = if k + 1 == scales { light * structure } else { structure };
        product *= term.max(0.0).powf(weight / total);
        (a, b) = (a.halved(), b.halved());
    }
    (scales > 0).then_some(product)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_pictures_are_alike_and_a_known_error_has_its_decibels() {
        let a: Vec<f64> = (0..64 * 64).map(|i| f64::from(i * 37 % 251)).collect();
        assert!((ms_ssim(a.clone(), a.clone(), 64, 1, 255).unwrap() - 1.0).abs() < 1e-12);
        assert_eq!(decibels(0.0, 64, 255), f64::INFINITY);
        assert!((decibels(64.0, 64, 255) - 20.0 * 255_f64.log10()).abs() < 1e-9);
        // noise of the other sign in turn
        let c: Vec<f64> = (0..).zip(&a).map(|(i, v)| v + if i % 2 == 0 { 40.0 } else { -40.0 }).collect();
        let noisy = ms_ssim(a.clone(), c, 64, 1, 255).unwrap();
        assert!((0.3..0.99).contains(&noisy), "{noisy}");
        assert_eq!(ms_ssim(a[..100].to_vec(), a[..100].to_vec(), 10, 1, 255), None);
    }
}
