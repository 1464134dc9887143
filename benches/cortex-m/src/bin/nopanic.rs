//! Calls every public kernel with inputs the compiler knows nothing about, and links only when none of them
//! can panic; those that make pictures are in `nopanic_pictures`.
//!
//! `panic_never` refers to a symbol that does not exist from its panic handler. The feature
//! `deliberate-panic` adds an indexing that may panic: the link must fail then, which proves that it could.
#![no_std]
#![no_main]

use core::hint::black_box as bb;

use attractor::Error;
use attractor::fif::{Cell, Factor, Fif, Knot, Pyramid, Surface};
use attractor::ifs::{Ifs, catalogue};
use attractor::num::Complex;
use attractor::num::{self, Angle, Real, Scaling, Unit, Wide};
use attractor::plane::{Field, Point2, Window};
use attractor_cortex_m::{entry, semihosting};
use embedded_graphics::prelude::*;

attractor_cortex_m::never_panics!();

#[entry]
fn main() -> ! {
    numbers();
    // what is refused is refused: only panics count
    let _ = bb(functions());
    let _ = bb(systems());
    let _ = bb(curves());
    let _ = bb(copies());
    let _ = bb(julia_sets());
    let _ = bb(textures());
    // more than the 256 KiB of the Cortex-M0's board hold
    if !cfg!(all(target_arch = "arm", not(target_has_atomic = "32"))) {
        let _ = bb(shapes());
    }
    #[cfg(feature = "deliberate-panic")]
    bb([1, 2, 3][bb(0_usize)]);
    semihosting::process::exit(0)
}

fn functions() -> Result<(), Error> {
    let zero = bb(Wide::ZERO);
    let knots = [(0, 0), (1, 1), (2, 0)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
    let f = Fif::<4, 2>::interpolating(bb(&knots[..]), bb(&[Scaling::from_bits(1 << 30); 2][..]))?;
    let xs = knots.map(|knot| knot.x);
    bb(Fif::<2, 2>::from_polynomials(bb(&xs), bb(&[Scaling::ZERO; 2]), bb(&[&xs[..], &xs[..]]))?);
    bb((f.at(zero), f.at_wide(zero), f.error_bound(), f.at_by_composition(zero, bb(Real::DELTA))));
    bb((f.error_bound_at_x(), f.oscillation(bb(40)), f.composite_at(zero, bb(Real::DELTA), bb(9))));
    bb((f.maps(), f.degree(), f.domain(), f.range(), f.max_scaling(), f.knots().last()));
    bb(f.composite(bb([0_usize, 1])).vertical_scaling());
    bb(f.derivative::<4>())?;
    let integral = bb(f.integral::<4>(zero))?;
    if let Some(dyadic) = f.dyadic::<16>() {
        bb((dyadic.at(bb(Angle::ZERO)), dyadic.error_bound()));
    }
    let compiled = bb(f.compiled())?;
    bb((compiled.at(bb(Angle::ZERO)), compiled.error_bound(), compiled.abscissa_bound()));
    bb(f.graph(bb(10)).last());
    bb(f.chaos_game(rng()).take(bb(10)).last());
    let mut memory = [Cell::ZERO; Pyramid::cells(2, 4)];
    let pyramid = Pyramid::new(&integral, bb(4), &mut memory)?;
    bb((
        pyramid.root(),
        pyramid.depth(),
        pyramid.branching(),
        pyramid.level(bb(2)),
        pyramid.bounds(zero, zero),
    ));
    let factor = Factor::<4, 4>::from_slope(&f, zero)?;
    bb(Factor::<4, 4>::new(&integral))?;
    let surface = Surface::new(&factor, &factor);
    bb((surface.height(zero, zero), surface.partials(zero, zero), surface.normal(zero, zero)));
    bb(surface.mean_normal((zero, bb(Wide::ONE)), (zero, bb(Wide::ONE))));
    Ok(())
}

fn rng() -> attractor::rand_xoshiro::Xoshiro128PlusPlus {
    use attractor::rand_xoshiro::rand_core::SeedableRng;
    SeedableRng::seed_from_u64(bb(1))
}

fn systems() -> Result<(), Error> {
    let Some(attractor) = catalogue::find(bb("barnsley-fern")) else { return Ok(()) };
    let ifs = attractor.ifs::<{ catalogue::LARGEST }>()?;
    bb(Ifs::<4>::proportional_to_determinant(bb(attractor.maps)))?;
    bb((ifs.bounds(), ifs.contraction_factor(), ifs.invariant_disc(), ifs.deviation()));
    bb((ifs.maps(), ifs.probabilities()));
    bb(ifs.seeded_chaos_game(bb(1)).take(bb(10)).last());
    bb(ifs.chaos_game(rng()).labelled().take(bb(10)).last());
    let mut walk = ifs.seeded_walk(bb(1));
    bb(ifs.resume(bb(&mut walk)).labelled().take(bb(10)).last());
    let (Some(a), Some(b)) = (attractor.maps.first(), attractor.maps.last()) else { return Ok(()) };
    let (a, b) = (bb(*a), bb(*b));
    bb((
        a.apply(point(0)),
        a.after(&b),
        a.determinant(),
        a.is_contraction(),
        a.contraction_factor(),
        a.fixed_point(),
    ));
    Ok(())
}

fn curves() -> Result<(), Error> {
    use attractor::curve::{
        Displacement, Elbow, Generator, LSystem, LineToLine, OneVariable, Orientation, Part, TwoVariable,
        dimension_of_ratio, dimension_of_spectrum, displaced, koch, turn_over,
    };
    use attractor::num::{Parameter, RandomFunction};
    let (one, seed) = (bb(Real::ONE), bb(1));
    if let Some(curve) = attractor::curve::catalogue::find(bb("gosper")) {
        refined(&curve.generator::<{ attractor::curve::catalogue::LARGEST }>()?)?;
    }
    let points = bb([[Wide::ZERO; 2], [Wide::ONE; 2], [Wide::ZERO; 2]]);
    bb(Generator::<4>::polyline(bb(&points[..])).is_ok());
    bb(Generator::<4>::oriented_polyline(bb(&points[..]), bb(&[Orientation::Reversed])).is_ok());
    refined(&Generator::<4>::turtle(bb("F+F--F+F"), turn_over(bb(6)))?)?;
    let rules = bb([('X', "F[+X]fX"), ('F', "FF")]);
    let plant = LSystem::new(bb("X"), bb(&rules), bb(Wide::ONE))?.with_heading(bb(Wide::ONE));
    let turtle = plant.path::<6, 6>(bb(5))?;
    bb((turtle.step(), turtle.steps(), turtle.last()));
    bb((koch::triangle(point(0), one), koch::length(bb(3)).map(koch::Fraction::to_wide)));
    bb((koch::snowflake_perimeter(bb(3)), koch::snowflake_area(bb(3))));
    bb((dimension_of_ratio(one).ok(), dimension_of_spectrum(one).ok()));
    let t = bb(Parameter::ONE);
    let random = RandomFunction::new(seed);
    let (along, across) = (random.at(t), random.independent().at(t));
    let part = Part { from: point(0), to: point(1), middle: t, level: bb(3), span: one };
    bb(displaced(&part, along, across));
    bb(Elbow::new(bb(Unit::ONE), one, seed)?.standard_deviation(bb(3)));
    let elbow = bb(Elbow::self_similar(one, seed))?;
    let graph = bb(LineToLine::from_spectrum(bb(Unit::ONE), one, seed))?;
    bb(LineToLine::new(bb(Unit::ONE), seed)?.extrapolated(point(0), point(1), t).is_ok());
    let plane = bb(OneVariable::from_ratio(one, seed))?;
    bb((OneVariable::new(bb(Unit::ONE), seed)?.offset(), plane.extrapolated(point(0), point(1), t).is_ok()));
    let both = bb(TwoVariable::new(bb(Unit::ONE), seed))?;
    bb(both.extrapolated(point(0), point(1), t).is_ok());
    bb((elbow.midpoint(&part), graph.midpoint(&part), plane.midpoint(&part), both.midpoint(&part)));
    divided(&elbow)?;
    divided(&graph)?;
    divided(&plane)?;
    divided(&both)
}

fn refined<const S: usize>(generator: &attractor::curve::Generator<S>) -> Result<(), Error> {
    let base = bb([point(0), point(1 << 24), point(0)]);
    bb((generator.len(), generator.is_empty(), generator.lengthening(), generator.contraction_factor()));
    bb(generator.dimension());
    let generator = generator.clone().through(bb([Unit::ONE; 2]))?;
    bb(generator.refined::<12>(bb(&base), bb(3))?.last());
    bb(generator.refined_to::<12>(bb(&base), bb(Real::ONE))?.last());
    Ok(())
}

fn divided<L: attractor::curve::Displacement>(law: &L) -> Result<(), Error> {
    use attractor::curve::{Stop, Subdivision};
    use attractor::num::Parameter;
    let knots = bb([point(0), point(1 << 24), point(2 << 24)]);
    for stop in [Stop::Parameter(Parameter::ONE), Stop::Norm(Real::ONE), Stop::Length(Real::ONE)] {
        let mut curve = Subdivision::<_, 16>::new(law, bb(&knots), bb(stop))?;
        bb((curve.next(), curve.parameter()));
        bb(curve.between(bb(Parameter::ZERO), bb(Parameter::ONE)).last());
    }
    Ok(())
}

fn copies() -> Result<(), Error> {
    use attractor::ifs::Affine;
    use attractor::plane::Density;
    let ifs = catalogue::BARNSLEY_FERN.ifs::<4>()?;
    let shape = bb([point(0), point(1)]);
    bb(ifs.copier::<12>(bb(&shape), bb(3))?.points().last());
    bb(ifs.copier::<12>(bb(&shape), bb(3))?.path().last());
    bb(ifs.moments())?;
    bb((Affine::from_thousandths(bb([1; 6])), Affine::from_millionths(bb([1; 6]))));
    bb((Affine::from_ratios(bb([1; 6]), bb(3)), Affine::new(bb([Unit::ONE; 4]), bb([Real::ONE; 2]))));
    let window = Window::fit(ifs.bounds(), bb(Size::new(8, 8)))?;
    let (mut counts, mut maps) = ([0_u16; 64], [0; 64]);
    let mut density = Density::new(window, bb(&mut counts[..]))?.with_maps(bb(&mut maps[..]))?;
    let mut game = ifs.seeded_chaos_game(bb(1));
    bb((game.next(), game.last_map()));
    density.extend(game.clone().labelled().take(bb(10)));
    density.extend(game.take(bb(10)));
    density.record(point(0));
    density.record_from(point(0), bb(1));
    bb((density.counts().last(), density.window(), density.peak(), density.quantile(bb(50))));
    bb(density.linear(bb(3)).row(bb(1), bb(0)..bb(8)).last());
    bb(density.logarithmic(bb(3)).row(bb(1), bb(0)..bb(8)).nth(bb(3)));
    let mut few = [0_u8; 64];
    let mut density = Density::new(window, bb(&mut few[..]))?;
    density.record(point(0));
    bb(density.linear(bb(3)).row(bb(1), bb(0)..bb(8)).last());
    Ok(())
}

fn julia_sets() -> Result<(), Error> {
    use attractor::escape::{JuliaCover, JuliaSet, View};
    let set = JuliaSet::new(Complex::new(bb(Wide::ZERO), bb(Wide::ZERO)))?;
    bb((set.constant().sqrt(), set.fixed_points(), set.connectedness(bb(100))?, set.simple_case()));
    let mut walk = set.seeded_backward_iteration(bb(1));
    bb((walk.next_preimage(), walk.next()));
    bb(set.backward_iteration(rng()).take(bb(10)).last());
    let middle = Complex::new(bb(Wide::ZERO), bb(Wide::ZERO));
    bb((set.radius(), set.may_meet(middle, bb(Wide::ONE)), set.sixteenths(middle, bb(Wide::ONE))));
    let view = View::new(middle, bb(Wide::ONE), Size::new(bb(8), bb(8)))?;
    bb(JuliaCover::new(view, set)?.row(bb(1), bb(0)..bb(8)).last());
    Ok(())
}

fn point(bits: i32) -> Point2 {
    Point2::new(bb(Real::from_bits(bits)), bb(Real::from_bits(bits)))
}

fn textures() -> Result<(), Error> {
    use attractor::num::{Rgb, Vec3};
    use attractor::trace::material::{Material, Mixture};
    use attractor::trace::texture::{
        Bumpy, Checker, Facets, Framed, Image, Lattice, Mapped, Marble, Mottle, Noise, Pasted, Relief, Rough,
        Slice, Spline, Texels, Texture, Turbulence, Wood,
    };
    use attractor::trace::{Panorama, Sky, Surroundings, Tiles};
    let (one, half, white) = (bb(Real::ONE), bb(Unit::ONE), bb(Rgb::WHITE));
    let up = Vec3::new(Unit::ZERO, Unit::ZERO, bb(Unit::ONE));
    let down = Vec3::new(Unit::ZERO, Unit::ZERO, bb(-Unit::ONE));
    bb(attractor::trace::refracted_direction(down, up, one));
    bb(Noise::new(bb(1)).at(Vec3::new(bb(Lattice::ZERO), bb(Lattice::ZERO), bb(Lattice::ZERO))));
    let turbulence = Turbulence::new(bb(Noise::PERLIN), one, bb(3))?;
    let undulate = Spline::<4>::new(bb(&[(Unit::ZERO, Rgb::BLACK), (Unit::ONE, Rgb::WHITE)]))?;
    let checker = Checker::cubes(bb([one; 3]), white, white);
    let bounds = attractor::plane::Bounds2 { min: point(0), max: point(1 << 24) };
    let window = Window::stretch(bb(bounds), bb(Size::new(8, 8)))?;
    let slice = Slice::new(checker, window, one);
    let place = slice.point(bb(1), bb(2));
    bb(slice.at_height(one).row(bb(1), bb(0)..bb(8)).last());
    let wood = Wood {
        colors: [white; 2],
        rings: one,
        tilt: [one; 2],
        wobble: one,
        lobes: bb(3),
        twist: one,
        rough: Some((turbulence, one)),
        soft: half,
    };
    bb((wood.at(&place), Marble { undulate, turbulence, amplitude: one, frequency: one }.at(&place)));
    bb(Mottle { undulate, turbulence }.at(&place));
    let mut texels = bb([0; 4 * 4 * 3 + 2 * 2 * 3 + 3]);
    Image::write_levels(bb(Texels::Rgb888), bb(4), bb(4), &mut texels)?;
    let image = Image::new(bb(Texels::Rgb888), bb(4), bb(4), bb(&texels))?;
    bb((image.at(&place), image.nearest(one, one), Panorama::new(image).light(place.normal, half)));
    bb((Mapped::new(image, bb([[one; 3]; 2]))?.at(&place), Mapped::repeated(image, bb(2), bb(3)).is_ok()));
    let material = Mixture::matt(white);
    let corners = bb([[Real::ZERO; 2], [Real::ONE; 2], [Real::ONE; 2]]);
    let pasted = Pasted::new(material, &corners, material)?;
    let none = core::iter::empty;
    bb(pasted.respond(&place, place.normal, none()));
    bb(Bumpy { material, bump: Rough { turbulence, height: one } }.normal(&place));
    bb(Bumpy { material, bump: Relief { image, height: one } }.normal(&place));
    bb(Bumpy { material, bump: Facets { cells: [one; 2], tilt: half, seed: bb(1) } }.normal(&place));
    bb(Framed { material, grain: (turbulence, half) }.respond(&place, place.normal, none()));
    let colors = [white; 2];
    let tiles = Tiles { ceiling: colors, floor: colors, horizon: white, scale: one, fade: half };
    bb(tiles.light(place.normal, half));
    bb(Sky { zenith: white, horizon: white, nadir: white }.light(place.normal, half));
    Ok(())
}

fn numbers() {
    bb(num::reciprocal(bb(0)));
    bb(num::reciprocal_sqrt(bb(0)));
    bb(num::sqrt(bb(0)));
    bb(num::sin_cos(bb(num::Angle::ZERO)));
    bb(num::mul_high(bb(0), bb(0)));
    bb(num::mul_high_u(bb(0), bb(0)));
    bb(num::round_shift(bb(0), bb(0)));
    bb(num::scale31(bb(0), bb(0)));
    bb((num::log2(bb(0)), num::exp_minus(bb(num::Real::ONE))));
    bb(num::Reciprocal::of(bb(0)).quotient(bb(0)));
    if let Ok(alias) = num::Alias::<8>::new(bb(&[1, 2, 3])) {
        bb(alias.pick(bb(0)));
        bb(alias.len());
    }
    bb(num::log2(bb(0)));
    let limbs = num::Limbs::<4>::from_wide(bb(Wide::ONE)).unwrap_or_default();
    bb((limbs.top64(), limbs.times_small(bb(3)).plus_units(bb(1)).divided(bb(0))));
    let v = num::Vec3::new(bb(num::Real::ONE), bb(num::Real::ONE), bb(num::Real::ONE));
    bb((v.minus(v), v.towards(v)));
    bb(v.normalised());
}

/// Every shape: placed, crossed, told what a ray met, and asked on which side a place is.
fn shapes() -> Result<(), Error> {
    use attractor::num::{Affine3, Near, Vec3};
    use attractor::trace::solid::{
        Cube, HalfSpace, Implicit, Moved, Placed, Plane, Polygon, Polyhedron, Shape, Sphere, Square,
        Superellipsoid, TaperedCylinder, Torus,
    };
    use attractor::trace::{Ball, Ray, Surface};
    use core::ops::ControlFlow;

    fn seen(surface: &impl Surface, ray: &Ray) {
        surface.cross(ray, bb(Unit::DELTA), &mut |crossing| {
            bb(surface.point(ray, bb(Unit::DELTA), &crossing, true));
            bb(ControlFlow::Continue(()))
        });
        let place = ray.origin();
        bb((surface.value(place), surface.is_clear_of(place), surface.extent(), surface.ball()));
        bb((surface.error(), surface.faces(), surface.most_crossings(), surface.is_closed()));
    }

    fn met(shape: impl Shape, map: &Affine3, ray: &Ray) -> Result<(), Error> {
        seen(&Placed::new(shape, map)?, ray);
        Ok(())
    }

    let (one, at) = (bb(Real::ONE), bb(Vec3::<Real>::X));
    let map = Affine3::rotate(at, bb(Angle::ZERO))?
        .then(&Affine3::scale(at))
        .then(&Affine3::translate(at))
        .then(&bb(Affine3::IDENTITY));
    let ray = Ray::new(at, bb(Vec3::<Real>::Y));
    met(Sphere, &map, &ray)?;
    met(Plane, &map, &ray)?;
    met(Square, &map, &ray)?;
    met(Cube, &map, &ray)?;
    met(TaperedCylinder::new(one)?, &map, &ray)?;
    met(Torus::new(bb(Near::ONE))?, &map, &ray)?;
    met(Superellipsoid::new(one, one)?, &map, &ray)?;
    let planes = [HalfSpace::new(bb(Vec3::new(Wide::ONE, Wide::ONE, Wide::ZERO)), bb(Wide::ONE))?; 4];
    met(Polyhedron::new(&planes)?, &map, &ray)?;
    met(Polygon::<8>::new(&bb([at; 3]))?, &map, &ray)?;
    let box_of =
        bb([Vec3::new(-Near::ONE, -Near::ONE, -Near::ONE), Vec3::new(Near::ONE, Near::ONE, Near::ONE)]);
    met(Implicit::new(|place: Vec3<Near>| place.z, box_of, one)?, &map, &ray)?;
    seen(&Moved::new(Placed::new(Sphere, &map)?, &map)?, &ray);
    bb(Ball::round(at, ray.origin()).centre());
    Ok(())
}
