//! What validated types are written as with the feature `serde`, and how they are read: through their
//! constructors.
//!
//! Plain values and descriptions derive `Serialize` and `Deserialize` where they are defined. A type whose
//! constructor checks something is written as the numbers that its constructor takes and read back through
//! it, so that an invalid one is refused with the constructor's own [`Error`]. Numbers of `fixed` are written
//! as `fixed` writes them, as their bits; [`Limbs`] as their limbs, least first.

use embedded_graphics_core::geometry::Size;
use heapless::Vec;
use serde::de::{Deserialize, Deserializer, Error as _, SeqAccess, Visitor};
use serde::ser::{Serialize, SerializeTuple, Serializer};

use crate::Error;
use crate::escape::{Arithmetic, DeepView, Julia, JuliaSet, Mandelbrot, View};
use crate::ifs::{Affine, Ifs};
use crate::num::Complex;
use crate::num::{Limbs, Unit, Wide};
use crate::plane::{Bounds2, Window};

/// A constructor's numbers, one a field, and the two ways.
macro_rules! numbers {
    ($name:ident $([const $n:ident])? of $type:ty {$($field:ident: $kind:ty = $get:expr,)*}, $make:expr) => {
        #[derive(serde::Serialize, serde::Deserialize)]
        pub(crate) struct $name $(<const $n: usize>)? {
            $($field: $kind,)*
        }

        impl $(<const $n: usize>)? From<$type> for $name $(<$n>)? {
            fn from(made: $type) -> Self {
                Self { $($field: { let get: fn(&$type) -> $kind = $get; get(&made) },)* }
            }
        }

        impl $(<const $n: usize>)? TryFrom<$name $(<$n>)?> for $type {
            type Error = Error;

            fn try_from(numbers: $name $(<$n>)?) -> Result<Self, Error> {
                let make: fn($name $(<$n>)?) -> Result<Self, Error> = $make;
                make(numbers)
            }
        }
    };
}

numbers! { WindowNumbers of Window {
    bounds: Bounds2 = Window::bounds,
    size: (u32, u32) = |w| pair(w.size()),
}, |n| Window::stretch(n.bounds, n.size.into()) }

numbers! { ViewNumbers of View {
    centre: Complex<Wide> = View::centre,
    width: Wide = View::width,
    size: (u32, u32) = |v| pair(v.size()),
    panned: (i32, i32) = View::panned,
}, |n| View::new(n.centre, n.width, n.size.into())?.pan(n.panned.0, n.panned.1) }

numbers! { DeepViewNumbers [const LIMBS] of DeepView<LIMBS> {
    centre: Complex<Limbs<LIMBS>> = |v| *v.centre(),
    width: Limbs<LIMBS> = |v| *v.width(),
    size: (u32, u32) = |v| pair(v.size()),
    panned: (i32, i32) = DeepView::panned,
}, |n| DeepView::new(n.centre, n.width, n.size.into())?.pan(n.panned.0, n.panned.1) }

numbers! { MandelbrotNumbers of Mandelbrot {
    view: View = |m| *m.view(),
    max_dwell: u32 = Mandelbrot::max_dwell,
    arithmetic: Arithmetic = Mandelbrot::arithmetic,
}, |n| Mandelbrot::new(n.view, n.max_dwell)?.with_arithmetic(n.arithmetic) }

numbers! { JuliaNumbers of Julia {
    view: View = |j| *j.view(),
    constant: Complex<Wide> = Julia::constant,
    max_dwell: u32 = Julia::max_dwell,
    arithmetic: Arithmetic = Julia::arithmetic,
}, |n| Julia::new(n.view, n.constant, n.max_dwell)?.with_arithmetic(n.arithmetic) }

numbers! { JuliaSetNumbers of JuliaSet {
    constant: Complex<Wide> = |j| {
        let c = j.constant();
        Complex::new(c.re.into(), c.im.into())
    },
}, |n| JuliaSet::new(n.constant) }

numbers! { IfsNumbers [const N] of Ifs<N> {
    // as many as there is room for
    maps: Vec<Affine, N> = |i| i.maps().iter().copied().collect(),
    probabilities: Vec<Unit, N> = |i| i.probabilities().iter().copied().collect(),
}, |n| Ifs::new(&n.maps, &n.probabilities) }

fn pair(size: Size) -> (u32, u32) {
    size.into()
}

impl<const LIMBS: usize> Serialize for Limbs<LIMBS> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut tuple = serializer.serialize_tuple(LIMBS)?;
        for limb in self.limbs() {
            tuple.serialize_element(limb)?;
        }
        tuple.end()
    }
}

impl<'de, const LIMBS: usize> Deserialize<'de> for Limbs<LIMBS> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Words<const LIMBS: usize>;
        impl<'de, const LIMBS: usize> Visitor<'de> for Words<LIMBS> {
            type Value = Limbs<LIMBS>;

            fn expecting(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                write!(f, "{LIMBS} limbs, least first")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut words: A) -> Result<Self::Value, A::Error> {
                let mut limbs = [0; LIMBS];
                for (index, limb) in limbs.iter_mut().enumerate() {
                    *limb = words.next_element()?.ok_or_else(|| A::Error::invalid_length(index, &self))?;
                }
                Ok(Limbs::from_limbs(limbs))
            }
        }
        deserializer.deserialize_tuple(LIMBS, Words)
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Debug;
    use std::format;
    use std::string::{String, ToString};

    use serde::de::DeserializeOwned;

    use super::*;
    use crate::ifs::catalogue;
    use crate::num::{Real, Vec3};
    use crate::plane::{PathElement, Point2};
    use crate::{curve, draw, escape, fif, ifs, num, plane, trace};

    /// Written, read and the same; what was written.
    fn there_and_back<T: serde::Serialize + DeserializeOwned + PartialEq + Debug>(value: T) -> String {
        let text = serde_json::to_string(&value).unwrap();
        let back: T = serde_json::from_str(&text).unwrap_or_else(|e| panic!("{text}: {e}"));
        assert_eq!(back, value, "{text}");
        text
    }

    /// What a reader says to `text`.
    fn refused<T: DeserializeOwned + Debug>(text: &str) -> String {
        serde_json::from_str::<T>(text).unwrap_err().to_string()
    }

    fn point(x: f32, y: f32) -> Point2 {
        Point2::new(Real::from_num(x), Real::from_num(y))
    }

    fn complex(re: f64, im: f64) -> Complex<Wide> {
        Complex::new(Wide::from_num(re), Wide::from_num(im))
    }

    #[test]
    fn values_and_plain_descriptions_come_back() {
        there_and_back(point(1.5, -2.0));
        there_and_back(PathElement::LineTo(point(0.25, 3.0)));
        there_and_back(Bounds2 { min: point(0.0, 0.0), max: point(1.0, 2.0) });
        there_and_back(Vec3::new(Real::ONE, Real::ZERO, Real::MIN));
        there_and_back(complex(-0.75, 0.1));
        there_and_back(Limbs::<12>::from_limbs([7; 12]));
        there_and_back(fif::Knot::new(Wide::MAX, Wide::MIN));
        there_and_back(fif::Cell { min: Real::MIN, ..fif::Cell::ZERO });
        there_and_back(catalogue::BARNSLEY_FERN.maps[1]);
        there_and_back(ifs::Disc { centre: point(1.0, 2.0), radius: Real::ONE });
        there_and_back(plane::Hits { count: 3, tone: 4, map: 5 });
        there_and_back(catalogue::BARNSLEY_FERN.ifs::<4>().unwrap().moments().unwrap());
        there_and_back(curve::Orientation::Reversed);
        there_and_back(curve::Stop::Length(Real::DELTA));
        there_and_back(num::RandomFunction::new(u64::MAX - 5));
        there_and_back(curve::koch::Fraction { numerator: 1, denominator: 3 });
        let (from, to) = (point(0.0, 1.0), point(2.0, 3.0));
        let middle = num::Parameter::ONE / 2;
        there_and_back(curve::Part { from, to, middle, level: 1, span: Real::ONE });
        there_and_back(escape::Dwell { count: 3, max: 100 });
        there_and_back(escape::Period::new(4));
        there_and_back(escape::Arithmetic::Word29);
        there_and_back(escape::Arithmetic::PerturbedLong);
        there_and_back(escape::Connectedness::Dust(7));
        there_and_back(escape::SimpleCase::Segment);
        there_and_back(JuliaSet::new(complex(0.25, 0.5)).unwrap().fixed_points()[1]);
        let view = View::home(Size::new(24, 20)).unwrap();
        let smooth = escape::Smooth(Mandelbrot::new(view, 100).unwrap());
        there_and_back(smooth.value_at(complex(0.5, 0.0)));
        there_and_back(smooth);
        there_and_back(escape::Interior(view));
        there_and_back(escape::Distance(view));
        there_and_back(trace::Environment::CHECKERBOARD);
        there_and_back(trace::Finish::PHONG);
        there_and_back(trace::Sampling::Jittered { n: 3, seed: 9 });
        there_and_back(trace::Filter::Gaussian { deviation: Real::ONE, width: Real::ONE });
        there_and_back(trace::Statistics { rays: 1, box_tests: 2, stack: 3 });
        there_and_back(plane::Tone::from_bits(77));
        there_and_back(draw::Level::from_bits(99));
    }

    #[test]
    fn validated_types_come_back_through_their_constructors() {
        let size = Size::new(24, 20);
        let view =
            View::new(complex(-0.7453, 0.1127), Wide::from_num(0.0065), size).unwrap().pan(-3, 4).unwrap();
        there_and_back(view);
        there_and_back(Mandelbrot::new(view, 100).unwrap().with_arithmetic(Arithmetic::Word29).unwrap());
        there_and_back(Julia::new(view, complex(-0.8, 0.156), 1000).unwrap());
        there_and_back(JuliaSet::new(complex(-0.8, 0.156)).unwrap());
        there_and_back(DeepView::<12>::parse("0", "1", "1e-60", size).unwrap().pan(5, -6).unwrap());
        let bounds = Bounds2 { min: point(-1.0, -1.0), max: point(2.0, 2.0) };
        there_and_back(Window::fit(bounds, Size::new(128, 64)).unwrap());
        for attractor in catalogue::ALL {
            there_and_back(attractor.ifs::<{ catalogue::LARGEST }>().unwrap());
            there_and_back(
                Ifs::<{ catalogue::LARGEST }>::proportional_to_determinant(attractor.maps).unwrap(),
            );
        }
    }

    #[test]
    fn an_invalid_description_is_refused_with_the_constructors_words() {
        let view = View::home(Size::new(24, 20)).unwrap();
        let written = there_and_back(view);
        let none = refused::<View>(&written.replace("[24,20]", "[0,20]"));
        assert!(none.starts_with("width is 0, it must lie between 1 and 16384"), "{none}");
        let far = refused::<View>(&written.replace("[0,0]", "[40000,0]"));
        assert!(far.starts_with("pixels to pan is "), "{far}");
        let written = there_and_back(Mandelbrot::new(view, 100).unwrap());
        let idle = refused::<Mandelbrot>(&written.replace("\"max_dwell\":100", "\"max_dwell\":0"));
        assert!(idle.starts_with("0 iterations a pixel given, at least 1 needed"), "{idle}");
        let two = serde_json::to_string(&complex(2.0, 2.0)).unwrap();
        let dust = refused::<JuliaSet>(&format!("{{\"constant\":{two}}}"));
        assert!(dust.starts_with("|c| is 2.8284"), "{dust}");
        let flat = Bounds2 { min: point(0.0, 0.0), max: point(0.0, 1.0) };
        let flat = format!("{{\"bounds\":{},\"size\":[8,8]}}", serde_json::to_string(&flat).unwrap());
        assert!(refused::<Window>(&flat).starts_with("area of the window is zero"));
        let fern = catalogue::BARNSLEY_FERN;
        let written = there_and_back(fern.ifs::<4>().unwrap());
        let maps = refused::<Ifs<3>>(&written);
        assert!(maps.starts_with("invalid length"), "{maps}");
        let wide = Affine { a: Unit::ONE + Unit::DELTA, ..fern.maps[0] };
        let [first, wide] = [fern.maps[0], wide].map(|map| serde_json::to_string(&map).unwrap());
        let grows = refused::<Ifs<4>>(&written.replacen(&first, &wide, 1));
        assert!(grows.starts_with("map 0 is not a contraction"), "{grows}");
        let deep = there_and_back(DeepView::<2>::parse("0", "1", "1e-9", Size::new(8, 8)).unwrap());
        assert!(refused::<DeepView<3>>(&deep).contains("3 limbs, least first"));
    }
}
