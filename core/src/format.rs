//! `defmt::Format` for types that hold numbers of `fixed`, which has none: what `Debug` says, formatted on
//! the target.

use core::fmt::Debug;

use defmt::{Debug2Format, Format, Formatter};

use crate::{codec, curve, escape, fif, ifs, num, patch, plane, terrain, trace};

macro_rules! as_debug {
    ($([$($generics:tt)*] $type:ty;)*) => {$(
        impl<$($generics)*> Format for $type {
            fn format(&self, f: Formatter<'_>) {
                Debug2Format(self).format(f);
            }
        }
    )*};
}

as_debug! {
    [T: Debug] num::Vec3<T>;
    [const LIMBS: usize] num::Limbs<LIMBS>;
    [] num::Reciprocal;
    [] patch::Mask;
    [] patch::CellMoments;
    [] patch::CellSlopes;
    [] patch::HeightMoments;
    [] patch::SlopeMoments;
    [] plane::Point2;
    [] plane::PathElement;
    [] plane::Bounds2;
    [] plane::Window;
    [] fif::Knot;
    [] codec::Header;
    [] fif::Cell;
    [] fif::Spread;
    [] fif::Stretch;
    [] fif::Sum;
    [] fif::Trend;
    [const N: usize, const D: usize] fif::Fif<N, D>;
    [] ifs::Affine;
    [] ifs::Disc;
    [] ifs::Moments;
    [const N: usize] ifs::Ifs<N>;
    [const S: usize] curve::Generator<S>;
    [] curve::catalogue::Curve;
    [] curve::Part;
    [] curve::Stop;
    [] curve::Elbow;
    [] curve::LineToLine;
    [] curve::OneVariable;
    [] curve::TwoVariable;
    [T: Debug] num::Complex<T>;
    [] escape::View;
    [const LIMBS: usize] escape::DeepView<LIMBS>;
    [] escape::Mandelbrot;
    [] escape::Julia;
    [] escape::JuliaSet;
    [] escape::FixedPoint;
    [] escape::FractionalDwell;
    [P: Debug] escape::Smooth<P>;
    [P: Debug] escape::Interior<P>;
    [P: Debug] escape::Distance<P>;
    [] trace::Camera;
    [] trace::Environment;
    [] trace::Light;
    [] trace::Finish;
    [] trace::Sampling;
    [] trace::Filter;
    [] trace::Hit;
    [] trace::Ray;
    [] num::Rgb;
    [] num::Affine3;
    [] terrain::Law;
    [] terrain::Magnification;
    [] terrain::Seam;
    [] terrain::Vertex;
    [] trace::Ball;
    [] trace::Crossing;
    [] trace::Extent;
    [] trace::Chart;
    [] trace::SurfacePoint;
    [] trace::Sky;
    [] trace::Tiles;
    [] trace::solid::NearRay;
    [] trace::solid::NearCrossing;
    [] trace::solid::HalfSpace;
    [] trace::solid::Torus;
    [] trace::solid::TaperedCylinder;
    [] trace::solid::Superellipsoid;
    [] trace::solid::Square;
    [] trace::solid::Sphere;
    [] trace::solid::Plane;
    [] trace::solid::Cube;
    [] trace::world::Op;
    [] trace::world::Interpenetration;
    [] trace::world::Lamp;
    [] trace::material::Anisotropic;
    [] trace::material::Tabulated<'_>;
    [] trace::material::Sight;
    [] trace::material::Clear;
    [] trace::material::Lit;
    [] trace::material::Medium;
    [] trace::material::Response;
    [] trace::material::Highlight<'_>;
    [] trace::material::TorranceSparrow;
    [] trace::material::Phong;
    [] trace::texture::Turbulence;
    [] trace::texture::Wood;
    [] trace::texture::Noise;
    [] trace::texture::Rough;
    [] trace::texture::Facets;
    [] trace::texture::Texels;
    [] trace::texture::Lookup;
    [] trace::texture::Beyond;
}
