//! What a picture of a world promises, with surfaces that an outsider wrote: balls and boxes in floating
//! point.
//!
//! Each fault that is known of other ray tracers has its test: a surface seen from where a ray left it, a
//! total reflection that is black, glass in water, faces that coincide.

use core::ops::ControlFlow;

use attractor::Error;
use attractor::num::{Lumen, Real, Rgb, Unit, Vec3, Wide};
use attractor::plane::{Field, LinearRgb};
use attractor::trace::material::{Clear, Lit, Material, Medium, Mixture, Phong, Response};
use attractor::trace::texture::Texture;
use attractor::trace::world::{Difference, Intersection, Lamp, Leaf, Object, Op, Union, World, WorldCaster};
use attractor::trace::{
    Camera, Chart, Crossing, Environment, Extent, Filter, Ray, Sampling, Surface, SurfacePoint, Surroundings,
};
use embedded_graphics::geometry::Size;

fn vector([x, y, z]: [f64; 3]) -> Vec3 {
    let c = Real::saturating_from_num;
    Vec3::new(c(x), c(y), c(z))
}

fn floats(v: Vec3) -> [f64; 3] {
    [v.x, v.y, v.z].map(|c| c.to_num())
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn unit(v: [f64; 3]) -> Vec3<Unit> {
    let length = dot(v, v).sqrt();
    let [x, y, z] = v.map(|c| Unit::from_num(c / length));
    Vec3::new(x, y, z)
}

/// A surface of an outsider: a ball, or a box along the axes.
#[derive(Debug, Clone, Copy)]
enum Thing {
    Ball([f64; 3], f64),
    Box([f64; 3], [f64; 3]),
}

impl Thing {
    /// Both parameters of a ray inside, and the axis of the face for a box.
    fn span(&self, ray: &Ray) -> Option<[(f64, u8); 2]> {
        let o = floats(ray.origin());
        let d = ray.direction();
        let d = [d.x, d.y, d.z].map(|c| c.to_num::<f64>());
        match *self {
            Self::Ball(centre, radius) => {
                let w: [f64; 3] = std::array::from_fn(|k| o[k] - centre[k]);
                let (a, b, c) = (dot(d, d), dot(w, d), dot(w, w) - radius * radius);
                let under = b * b - a * c;
                (under > 0.0).then(|| [((-b - under.sqrt()) / a, 0), ((-b + under.sqrt()) / a, 0)])
            }
            Self::Box(low, high) => {
                let (mut enters, mut leaves) = ((f64::MIN, 0), (f64::MAX, 0));
                for k in 0..3 {
                    let under = if d[k] == 0.0 { 1e-12 } else { d[k] };
                    let (a, b) = ((low[k] - o[k]) / under, (high[k] - o[k]) / under);
                    if a.min(b) > enters.0 {
                        enters = (a.min(b), 2 * k as u8 + u8::from(a > b));
                    }
                    if a.max(b) < leaves.0 {
                        leaves = (a.max(b), 2 * k as u8 + u8::from(b > a));
                    }
                }
                (enters.0 < leaves.0).then_some([enters, leaves])
            }
        }
    }
}

impl Surface for Thing {
    fn extent(&self) -> Extent {
        let (low, high) = match *self {
            Self::Ball(c, r) => (c.map(|c| c - r), c.map(|c| c + r)),
            Self::Box(low, high) => (low, high),
        };
        Extent { low: vector(low), high: vector(high) }
    }

    fn is_closed(&self) -> bool {
        true
    }

    fn most_crossings(&self) -> u32 {
        2
    }

    fn faces(&self) -> u8 {
        if let Self::Ball(..) = self { 1 } else { 6 }
    }

    fn error(&self) -> Real {
        Real::from_bits(4)
    }

    fn cross(&self, ray: &Ray, _: Unit, found: &mut impl FnMut(Crossing) -> ControlFlow<()>) {
        for (k, (t, face)) in self.span(ray).into_iter().flatten().enumerate() {
            if (0.0..127.9).contains(&t) {
                let crossing = Crossing { t: Real::from_num(t), enters: k == 0, face, memo: [0; 2] };
                if found(crossing).is_break() {
                    return;
                }
            }
        }
    }

    fn value(&self, place: Vec3) -> Wide {
        let p = floats(place);
        Wide::saturating_from_num(match *self {
            Self::Ball(c, r) => {
                let w: [f64; 3] = std::array::from_fn(|k| p[k] - c[k]);
                dot(w, w) - r * r
            }
            Self::Box(low, high) => {
                (0..3).map(|k| (low[k] - p[k]).max(p[k] - high[k])).fold(f64::MIN, f64::max)
            }
        })
    }

    fn point(&self, ray: &Ray, _: Unit, crossing: &Crossing, _: bool) -> SurfacePoint {
        let position = ray.at(crossing.t);
        let p = floats(position);
        let normal = match *self {
            Self::Ball(c, _) => std::array::from_fn(|k| p[k] - c[k]),
            Self::Box(..) => {
                let mut n = [0.0; 3];
                n[usize::from(crossing.face / 2)] = if crossing.face & 1 == 0 { -1.0 } else { 1.0 };
                n
            }
        };
        SurfacePoint {
            position,
            place: position,
            normal: unit(normal),
            inward: false,
            chart: Chart::default(),
            face: crossing.face,
            width: Real::ZERO,
        }
    }
}

const SIZE: Size = Size::new(24, 24);

fn camera(eye: [f64; 3], look_at: [f64; 3]) -> Camera {
    Camera::new(vector(eye), vector(look_at), vector([0.0, 0.1, 1.0]), Real::from_num(40)).unwrap()
}

/// The picture of objects that are programs over these leaves, each leaf of the material of its number.
fn picture<L: Surface, M: Material>(
    surfaces: Vec<L>,
    programs: &[&[Op]],
    materials: &[M],
    lamps: &[Lamp],
    surroundings: impl Surroundings,
    camera: Camera,
) -> Vec<LinearRgb> {
    with_world(surfaces, programs, materials, |world| {
        let world = world.unwrap().with_lamps(lamps);
        let caster = WorldCaster::<_, _, _>::new(world, surroundings, camera, SIZE).unwrap();
        let rows: Vec<LinearRgb> = (0..SIZE.height).flat_map(|y| caster.row(y, 0..SIZE.width)).collect();
        for (k, pixel) in rows.iter().enumerate() {
            assert_eq!(caster.at(k as u32 % SIZE.width, k as u32 / SIZE.width), *pixel);
        }
        rows
    })
}

fn with_world<L: Surface, M: Material, R>(
    surfaces: Vec<L>,
    programs: &[&[Op]],
    materials: &[M],
    then: impl FnOnce(Result<World<'_, L, M>, Error>) -> R,
) -> R {
    let numbers: Vec<u8> = (0..surfaces.len() as u8).map(|k| k.min(materials.len() as u8 - 1)).collect();
    let leaves: Vec<Leaf<'_, L>> = surfaces
        .into_iter()
        .zip(numbers.chunks(1))
        .map(|(surface, materials)| Leaf { surface, materials })
        .collect();
    let mut memory: Vec<Vec<Extent>> = programs.iter().map(|ops| vec![Extent::NOTHING; ops.len()]).collect();
    let objects: Vec<Object<'_>> = programs
        .iter()
        .zip(&mut memory)
        .map(|(ops, memory)| {
            Object::new(ops, |leaf| leaves.get(leaf).map(|leaf| &leaf.surface), memory).unwrap()
        })
        .collect();
    then(World::new(&leaves, &objects, materials))
}

const ONE: &[Op] = &[Op::Leaf(0)];
const TWO: &[Op] = &[Op::Leaf(1)];

fn glass(index: f64, priority: u8) -> Mixture<Rgb, (), Option<Clear>> {
    let medium = Medium { index: Real::from_num(index), priority, fresnel: true };
    Mixture::mirror().with_reflection(Rgb::BLACK).with_interior(Clear::new(medium, Rgb::WHITE).ok())
}

fn greys(picture: &[LinearRgb]) -> (u16, u16) {
    let parts = picture.iter().flat_map(|p| [p.r, p.g, p.b]);
    (parts.clone().min().unwrap(), parts.max().unwrap())
}

/// Within 2^-10 of white, every pixel.
fn is_white(picture: &[LinearRgb]) -> bool {
    greys(picture).0 >= 65535 - 64
}

#[test]
fn a_white_furnace_is_white_for_every_material() {
    let unlit = Mixture::matt(Rgb::WHITE).with_parts(Unit::ONE, Unit::ZERO).unwrap();
    let half = Rgb::grey(Lumen::from_num(0.5));
    let halved = Mixture::matt(half).with_parts(Unit::ONE, Unit::ZERO).unwrap().with_reflection(half);
    let bent = |index| Medium { index: Real::from_num(index), priority: 0, fresnel: false };
    let materials = [
        unlit.with_interior(None),
        Mixture::mirror().with_interior(None),
        halved.with_interior(None),
        glass(1.5, 0),
        glass(0.7, 0),
        glass(2.4, 0),
        glass(10.0, 0),
        Mixture::mirror().with_reflection(half).with_interior(Clear::new(bent(1.5), half).ok()),
    ];
    for (k, material) in materials.into_iter().enumerate() {
        for thing in [Thing::Ball([0.0; 3], 1.0), Thing::Box([-1.0, -0.7, -0.6], [0.8, 0.9, 1.0])] {
            for eye in [[4.0, -3.0, 2.0], [0.2, 0.1, -0.3], [1.5, 0.0, 0.0]] {
                let look = [0.1, 0.2, 0.1];
                let white = picture(vec![thing], &[ONE], &[material], &[], Rgb::WHITE, camera(eye, look));
                assert!(is_white(&white), "material {k}, {thing:?} from {eye:?}: {:?}", greys(&white));
            }
        }
    }
    // a ball in a ball of glass, in water
    let nested = vec![
        Thing::Ball([0.0; 3], 0.5),
        Thing::Ball([0.0; 3], 1.0),
        Thing::Box([-2.0, -2.0, -2.0], [2.0, 2.0, 1.5]),
    ];
    let materials = [glass(1.0, 2), glass(1.5, 1), glass(1.33, 0)];
    for eye in [[5.0, -4.0, 2.0], [1.6, 0.1, 0.2], [0.1, 0.0, 0.2]] {
        let at = camera(eye, [0.0, 0.1, 0.0]);
        let programs: [&[Op]; 3] = [ONE, TWO, &[Op::Leaf(2)]];
        let white = picture(nested.clone(), &programs, &materials, &[], Rgb::WHITE, at);
        assert!(is_white(&white), "{eye:?}: {:?}", greys(&white));
    }
}

/// A secondary ray never meets the surface that it left: a convex mirror shows nothing but the surroundings,
/// as they are in the mirrored direction, at any size and distance; so does a matt ball lit from everywhere
/// above.
#[test]
fn no_ray_meets_the_surface_that_it_left() {
    struct Up;
    impl Surroundings for Up {
        fn light(&self, direction: Vec3<Unit>, _: Unit) -> Rgb {
            let part = |c: Unit| Lumen::from_num(c.to_num::<f64>() / 2.0 + 0.5);
            Rgb::new(part(direction.x), part(direction.y), part(direction.z))
        }
    }
    let mut seen = 0;
    for scale in [1.0 / 64.0, 0.25, 1.0, 7.0, 12.0] {
        for (k, centre) in [[0.0; 3], [20.0, -20.0, 11.0]].into_iter().enumerate() {
            let around = |v: [f64; 3]| std::array::from_fn(|k| centre[k] + scale * v[k]);
            let thing = Thing::Ball(centre, scale);
            let at = camera(around([3.0, 1.0, 0.5]), centre);
            let shown = picture(vec![thing], &[ONE], &[Mixture::mirror()], &[], Up, at);
            let lamps = [Lamp::distant(vector([3.0, 1.0, 0.5]), Rgb::WHITE).unwrap()];
            let matt = Mixture::matt(Rgb::WHITE).with_parts(Unit::ZERO, Unit::ONE).unwrap();
            let lit = picture(vec![thing], &[ONE], &[matt], &lamps, Rgb::BLACK, at);
            with_world(vec![thing], &[ONE], &[matt], |world| {
                let bare = WorldCaster::<_, _, _>::new(world.unwrap(), Rgb::WHITE, at, SIZE).unwrap();
                for (k, (shown, lit)) in shown.iter().zip(&lit).enumerate() {
                    let (x, y) = (k as u32 % SIZE.width, k as u32 / SIZE.width);
                    if bare.at(x, y).r == 65535 {
                        continue;
                    }
                    // towards the eye and the lamp alike: the light is the cosine of both
                    let cos = f64::from(lit.r) / 65535.0;
                    seen += 1;
                    // what is mirrored points away from the centre
                    let m = [shown.r, shown.g, shown.b].map(|c| f64::from(c) / 32767.5 - 1.0);
                    assert!((dot(m, m) - 1.0).abs() < 1e-3, "{scale} {x} {y}: {m:?}");
                    assert!(cos > 0.0 || dot(m, [3.0, 1.0, 0.5]) < 0.0, "a hole: {scale} {x} {y} {m:?}");
                }
            });
            assert!(k < 2);
        }
    }
    assert!(seen > 1000, "{seen}");
}

/// Two boxes that share a face: their union is one box of glass, without a trace of the face; what is taken
/// away exactly is gone.
#[test]
fn faces_that_coincide_leave_no_trace() {
    let (a, b) = (Thing::Box([-1.0; 3], [0.0, 1.0, 1.0]), Thing::Box([0.0, -1.0, -1.0], [1.0; 3]));
    let whole = Thing::Box([-1.0; 3], [1.0; 3]);
    let sky = Environment::CHECKERBOARD;
    let joined: &[Op] = &[Op::Leaf(0), Op::Leaf(1), Op::Union];
    let taken: &[Op] = &[Op::Leaf(0), Op::Leaf(1), Op::Difference];
    for eye in [[3.0, 1.0, 2.0], [0.3, 4.0, 0.7], [-0.4, 0.2, 0.1], [0.0, 0.0, 0.3]] {
        let at = camera(eye, [0.05, -0.1, 0.02]);
        let seamless = picture(vec![a, b], &[joined], &[glass(1.5, 0)], &[], sky, at);
        let one = picture(vec![whole], &[ONE], &[glass(1.5, 0)], &[], sky, at);
        let off = seamless.iter().zip(&one).filter(|(a, b)| a.r.abs_diff(b.r) > 300).count();
        assert!(off <= 2, "{off} pixels from {eye:?}");
        let typed = picture(vec![Union(a, b)], &[ONE], &[glass(1.5, 0)], &[], sky, at);
        let off = typed.iter().zip(&one).filter(|(a, b)| a.r.abs_diff(b.r) > 300).count();
        assert!(off <= 2, "as a type: {off} pixels from {eye:?}");
        for (things, material) in
            [(vec![whole, whole], Mixture::matt(Rgb::WHITE)), (vec![whole, whole], Mixture::mirror())]
        {
            let nothing = picture(things, &[taken], &[material], &[], Rgb::BLACK, at);
            assert_eq!(greys(&nothing), (0, 0), "{eye:?}");
        }
        let typed = picture(vec![Difference(whole, whole)], &[ONE], &[glass(1.5, 0)], &[], Rgb::WHITE, at);
        assert_eq!(greys(&typed), (65535, 65535));
    }
}

/// The bowl `(S1 - S2) - C` and the two rays of the text: one hits it at the first crossing of all, the other
/// at the fifth.
#[test]
fn a_ray_hits_the_bowl_at_its_first_crossing_and_another_at_the_fifth() {
    // C is a box here, over the upper half
    let parts = [
        Thing::Ball([0.0; 3], 1.0),
        Thing::Ball([0.0; 3], 0.8),
        Thing::Box([-0.7, -0.7, 0.0], [0.7, 0.7, 2.0]),
    ];
    let bowl: &[Op] = &[Op::Leaf(0), Op::Leaf(1), Op::Difference, Op::Leaf(2), Op::Difference];
    let typed = Difference(Difference(parts[0], parts[1]), parts[2]);
    for (from, towards, nth) in
        [([0.0, -3.0, -0.5], [0.0, 1.0, 0.0], 1), ([0.0, 0.1, 3.0], [0.0, 0.05, -1.0], 5)]
    {
        let ray = Ray::new(vector(from), vector(towards));
        let mut all = Vec::new();
        for part in &parts {
            part.cross(&ray, Unit::ZERO, &mut |c| {
                all.push((c.t, c.enters));
                ControlFlow::Continue(())
            });
        }
        all.sort_by_key(|(t, _)| *t);
        let mut first = None;
        typed.cross(&ray, Unit::ZERO, &mut |c| {
            first = Some(c);
            ControlFlow::Break(())
        });
        let first = first.unwrap();
        assert_eq!(all.iter().position(|(t, _)| *t == first.t), Some(nth - 1), "{all:?}");
        assert!(first.enters);
        // the same hit as data: the camera's middle ray sees the material of the part that it hits
        let colors = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(|[r, g, b]: [u32; 3]| {
            Mixture::matt(Rgb::new(Lumen::from_num(r), Lumen::from_num(g), Lumen::from_num(b)))
                .with_parts(Unit::ONE, Unit::ZERO)
                .unwrap()
        });
        let aim: [f64; 3] = std::array::from_fn(|k| from[k] + towards[k]);
        let at = Camera::new(vector(from), vector(aim), vector([1.0, 0.0, 0.0]), Real::from_num(2)).unwrap();
        let shown = picture(parts.to_vec(), &[bowl], &colors, &[], Rgb::BLACK, at);
        let middle = shown[(SIZE.width * SIZE.height / 2 + SIZE.width / 2) as usize];
        // ray 1 meets the outer ball, ray 2 the inner one, whose face it shares with what was taken away
        let expected = if nth == 1 { LinearRgb::new(65535, 0, 0) } else { LinearRgb::new(0, 65535, 0) };
        assert_eq!(middle, expected);
    }
}

/// An object as data and as a type is the same, whatever is united, cut or taken away.
#[test]
fn compounds_as_data_and_as_types_are_the_same() {
    let (a, b) = (Thing::Ball([0.0; 3], 1.0), Thing::Box([-0.2, -0.9, -0.8], [1.2, 0.8, 0.4]));
    let at = camera([2.5, -3.0, 1.8], [0.2, 0.0, 0.0]);
    let lamps = [Lamp::point(vector([3.0, -1.0, 4.0]), Rgb::WHITE)];
    let matt = Mixture::matt(Rgb::WHITE).with_highlight(Rgb::WHITE, Phong { shininess: 20 });
    let data =
        |op| picture(vec![a, b], &[&[Op::Leaf(0), Op::Leaf(1), op]], &[matt], &lamps, Environment::SKY, at);
    let mut pictures = Vec::new();
    for (data, typed) in [
        (data(Op::Union), picture(vec![Union(a, b)], &[ONE], &[matt], &lamps, Environment::SKY, at)),
        (
            data(Op::Intersection),
            picture(vec![Intersection(a, b)], &[ONE], &[matt], &lamps, Environment::SKY, at),
        ),
        (
            data(Op::Difference),
            picture(vec![Difference(a, b)], &[ONE], &[matt], &lamps, Environment::SKY, at),
        ),
    ] {
        let off = data.iter().zip(&typed).filter(|(a, b)| a != b).count();
        assert!(off <= 3, "{off}");
        pictures.push(data);
    }
    assert!(pictures[0] != pictures[1] && pictures[1] != pictures[2]);
}

/// Through a pane of glass of index 1 everything stands where it stands; light is lost by what a pane lets
/// pass, each of its two sides once.
#[test]
fn shadows_follow_the_rule_for_glass() {
    let floor = Thing::Box([-5.0, -5.0, -1.0], [5.0, 5.0, 0.0]);
    let pane = Thing::Box([-1.0, -1.0, 1.0], [1.0, 1.0, 1.2]);
    let lamps = [Lamp::distant(vector([0.0, 0.0, 1.0]), Rgb::WHITE).unwrap()];
    let white = Mixture::matt(Rgb::WHITE).with_parts(Unit::ZERO, Unit::ONE).unwrap();
    let medium = Medium { index: Real::from_num(1.5), priority: 0, fresnel: true };
    let tinted = Rgb::new(Lumen::from_num(0.5), Lumen::ONE, Lumen::ZERO);
    let stained =
        Mixture::mirror().with_reflection(Rgb::BLACK).with_interior(Clear::new(medium, tinted).ok());
    // looks at the floor below the pane, from the side
    let at = camera([0.0, -3.0, 0.6], [0.0, 0.0, 0.0]);
    let shade = |material| {
        picture(
            vec![floor, pane],
            &[ONE, TWO],
            &[white.with_interior(None), material],
            &lamps,
            Rgb::BLACK,
            at,
        )
    };
    let middle = (SIZE.width * SIZE.height / 2 + SIZE.width / 2) as usize;
    let (opaque, clear) = (shade(white.with_interior(None))[middle], shade(stained)[middle]);
    assert_eq!(opaque, LinearRgb::new(0, 0, 0));
    assert!(clear.r.abs_diff(16384) < 4 && clear.g > 65530 && clear.b == 0, "{clear:?}");
    let alone = picture(vec![floor], &[ONE], &[white], &lamps, Rgb::BLACK, at)[middle];
    assert!(alone.r > 65530, "{alone:?}");
}

/// A thing whose first part is opaque has no medium, but light goes through those of its faces that let it
/// pass: in air and under water.
#[test]
fn light_goes_through_the_panes_of_an_opaque_thing() {
    let floor = Thing::Box([-5.0, -5.0, -1.0], [5.0, 5.0, 0.0]);
    let frame = Thing::Box([2.0, -1.0, 1.0], [3.0, 1.0, 1.2]);
    let pane = Thing::Box([-1.0, -1.0, 1.0], [1.0, 1.0, 1.2]);
    let water = Thing::Box([-4.0, -1.5, 0.75], [4.0, 4.0, 1.5]);
    let lamps = [Lamp::distant(vector([0.0, 0.0, 1.0]), Rgb::WHITE).unwrap()];
    let white = Mixture::matt(Rgb::WHITE).with_parts(Unit::ZERO, Unit::ONE).unwrap().with_interior(None);
    let medium = Medium { index: Real::ONE, priority: 0, fresnel: false };
    let clear =
        |tint| Mixture::mirror().with_reflection(Rgb::BLACK).with_interior(Clear::new(medium, tint).ok());
    let stained = clear(Rgb::new(Lumen::from_num(0.5), Lumen::ONE, Lumen::ZERO));
    let window: &[Op] = &[Op::Leaf(1), Op::Leaf(2), Op::Union];
    let below = |x: f64| {
        let at = camera([x, -3.0, 0.6], [x, 0.0, 0.0]);
        let middle = (SIZE.width * SIZE.height / 2 + SIZE.width / 2) as usize;
        let materials = [white, white, stained, clear(Rgb::WHITE)];
        let air = picture(vec![floor, frame, pane], &[ONE, window], &materials, &lamps, Rgb::BLACK, at);
        let things = vec![floor, frame, pane, water];
        let wet = picture(things, &[ONE, window, &[Op::Leaf(3)]], &materials, &lamps, Rgb::BLACK, at);
        [air[middle], wet[middle]]
    };
    for light in below(0.0) {
        assert!(light.r.abs_diff(16384) < 4 && light.g > 65530 && light.b == 0, "{light:?}");
    }
    assert_eq!(below(2.5), [LinearRgb::new(0, 0, 0); 2]);
}

/// Where glass stands in water it takes the index of both; of two things that overlap the one with the higher
/// priority is there; those of equal priority are found and named.
#[test]
fn media_follow_their_priorities() {
    // a ball of water in water is not seen
    let ball = Thing::Ball([0.0; 3], 0.5);
    // round, so that nothing is reflected totally: that would end at the depth
    let water = Thing::Ball([0.0; 3], 2.0);
    let sky = Environment::SKY;
    for eye in [[4.0, 3.0, 1.0], [1.0, 0.5, 0.6]] {
        let at = camera(eye, [0.0; 3]);
        let alone = picture(vec![water], &[ONE], &[glass(1.33, 0)], &[], sky, at);
        let both = picture(vec![ball, water], &[ONE, TWO], &[glass(1.33, 1), glass(1.33, 0)], &[], sky, at);
        let off = alone.iter().zip(&both).filter(|(a, b)| a.r.abs_diff(b.r) > 700).count();
        assert!(off <= 4, "{off} from {eye:?}");
        // in the other order of priorities the water is everywhere: the ball is not even crossed
        let hidden = picture(vec![ball, water], &[ONE, TWO], &[glass(2.4, 0), glass(1.33, 1)], &[], sky, at);
        assert_eq!(hidden, alone);
        let seen = picture(vec![ball, water], &[ONE, TWO], &[glass(2.4, 1), glass(1.33, 0)], &[], sky, at);
        assert!(seen.iter().zip(&alone).filter(|(a, b)| a != b).count() > 20);
    }
    let shared = |priorities: [u8; 2], surfaces: Vec<Thing>| {
        let materials = priorities.map(|priority| glass(1.5, priority));
        with_world(surfaces, &[ONE, TWO], &materials, |world| {
            let at = camera([4.0, 3.0, 1.0], [0.0; 3]);
            let caster = WorldCaster::<_, _, _>::new(world.unwrap(), Rgb::WHITE, at, SIZE).unwrap();
            caster.interpenetration()
        })
    };
    let other = Thing::Ball([0.3, 0.0, 0.0], 0.5);
    let found = shared([1, 1], vec![ball, other]).unwrap();
    assert_eq!(found.objects, [0, 1]);
    let place = floats(found.place);
    assert!(ball.value(found.place) < 0.01 && other.value(found.place) < 0.01, "{place:?}");
    // a ball wholly inside another, named first or last
    for inner in [vec![ball, water], vec![water, ball]] {
        assert!(shared([1, 1], inner.clone()).is_some() && shared([0, 1], inner).is_none());
    }
    assert_eq!(shared([1, 2], vec![ball, other]), None);
    assert_eq!(shared([1, 1], vec![ball, Thing::Ball([3.0, 0.0, 0.0], 0.5)]), None);
}

/// A material and a texture of an outsider take part like any other; so does a choice of one's own.
#[test]
fn an_outsider_adds_a_surface_a_material_and_a_texture() {
    /// Three flat tones, as in a cartoon.
    struct Cartoon<T>(T);
    impl<T: Texture> Material for Cartoon<T> {
        fn respond(
            &self,
            point: &SurfacePoint,
            _: Vec3<Unit>,
            lights: impl Iterator<Item = Lit>,
        ) -> Response {
            let lit = lights.map(|lit| point.normal.dot(lit.towards)).max().unwrap_or(Unit::ZERO);
            let tone = if lit > 0.7 { 1.0 } else { 0.25 };
            Response { light: self.0.at(point).scaled(Unit::from_num(tone)), ..Response::default() }
        }
    }
    /// Red to the left, green to the right.
    struct Sides;
    impl Texture for Sides {
        fn at(&self, point: &SurfacePoint) -> Rgb {
            let (on, off) = (Lumen::ONE, Lumen::ZERO);
            if point.place.x < 0 { Rgb::new(on, off, off) } else { Rgb::new(off, on, off) }
        }
    }
    let lamps = [Lamp::distant(vector([0.0, -1.0, 0.3]), Rgb::WHITE).unwrap()];
    let at = camera([0.0, -4.0, 0.0], [0.0; 3]);
    let shown = picture(vec![Thing::Ball([0.0; 3], 1.0)], &[ONE], &[Cartoon(Sides)], &lamps, Rgb::BLACK, at);
    let count = |color: [u16; 3]| shown.iter().filter(|p| [p.r, p.g, p.b] == color).count();
    let (red, green) = (count([65535, 0, 0]), count([0, 65535, 0]));
    let (dark_red, dark_green) = (count([16384, 0, 0]), count([0, 16384, 0]));
    assert!(red > 20 && red == green && dark_red > 5 && dark_red == dark_green, "{red} {green} {dark_red}");
    assert_eq!(red + green + dark_red + dark_green + count([0; 3]), shown.len());
}

/// Sixteen samples are the mean of many: an edge is grey, its sum within what jitter leaves.
#[test]
fn samples_of_a_pixel_add_up_to_one() {
    let at = camera([0.0, -4.0, 0.0], [0.0; 3]);
    let unlit = Mixture::matt(Rgb::BLACK);
    with_world(vec![Thing::Ball([0.0; 3], 1.0)], &[ONE], &[unlit], |world| {
        let world = world.unwrap();
        let caster = WorldCaster::<_, _, _>::new(world, Rgb::WHITE, at, SIZE).unwrap();
        let sum = |caster: &WorldCaster<'_, Thing, Mixture, Rgb>| {
            (0..SIZE.height).flat_map(|y| caster.row(y, 0..SIZE.width)).map(|p| f64::from(p.g)).sum::<f64>()
        };
        let fine = caster.clone().with_sampling(Sampling::Grid(8), Filter::Box).unwrap();
        let jittered =
            caster.clone().with_sampling(Sampling::Jittered { n: 4, seed: 7 }, Filter::Box).unwrap();
        assert!((sum(&fine) / sum(&jittered) - 1.0).abs() < 2e-3);
        assert!((0..SIZE.width).any(|x| (1000..64_000).contains(&fine.at(x, 12).g)));
        assert_eq!(fine.at(0, 0), LinearRgb::new(65535, 65535, 65535));
        assert!(caster.clone().with_depth(5).is_ok() && caster.clone().with_depth(6).is_err());
        assert!(caster.with_sampling(Sampling::Grid(9), Filter::Box).is_err());
    });
}

/// The same balls, one in another's mirror and shadow, as programs of a leaf each and as leaves.
#[test]
fn a_world_of_leaves_is_the_world_of_their_programs() {
    let surfaces = vec![Thing::Ball([0.0; 3], 1.0), Thing::Ball([1.5, -0.5, 0.4], 0.5)];
    let grey = |tone: f64| Rgb::grey(Lumen::from_num(tone));
    let materials = [Mixture::matt(grey(0.75)), Mixture::matt(grey(0.25)).with_reflection(grey(0.5))];
    let lamps = [Lamp::distant(vector([1.0, -1.0, 1.0]), Rgb::WHITE).unwrap()];
    let at = camera([0.0, -4.0, 0.0], [0.5, 0.0, 0.0]);
    let programs = picture(surfaces.clone(), &[ONE, TWO], &materials, &lamps, grey(0.125), at);
    let leaves: Vec<Leaf<'_, Thing>> = surfaces
        .into_iter()
        .zip([&[0][..], &[1]])
        .map(|(surface, materials)| Leaf { surface, materials })
        .collect();
    let objects: Vec<Object<'_>> =
        leaves.iter().zip(0..).map(|(leaf, number)| Object::leaf(number, &leaf.surface)).collect();
    assert_eq!(objects[1].extent(), leaves[1].surface.extent());
    let world = World::of_leaves(&leaves, &objects, &materials).unwrap().with_lamps(&lamps);
    let caster = WorldCaster::<_, _, _, 4, 7, false>::new(world, grey(0.125), at, SIZE).unwrap();
    let shown: Vec<LinearRgb> = (0..SIZE.height).flat_map(|y| caster.row(y, 0..SIZE.width)).collect();
    assert_eq!(shown, programs);
    assert!(greys(&shown).1 > 40_000 && greys(&shown).0 < 9_000, "{:?}", greys(&shown));
    let mut memory = [Extent::NOTHING; 3];
    let both = [Op::Leaf(0), Op::Leaf(1), Op::Union];
    let compound = [Object::new(&both, |k| leaves.get(k).map(|leaf| &leaf.surface), &mut memory).unwrap()];
    assert!(matches!(World::of_leaves(&leaves, &compound, &materials), Err(Error::Unsupported { .. })));
}

#[test]
fn a_world_that_does_not_fit_together_is_refused() {
    let ball = Thing::Ball([0.0; 3], 1.0);
    let matt = [Mixture::matt(Rgb::WHITE)];
    let refused = |surfaces: Vec<Thing>, programs: &[&[Op]]| {
        with_world(surfaces, programs, &matt, |world| world.map(|_| ()).unwrap_err())
    };
    assert!(matches!(refused(vec![ball], &[]), Error::TooFew { .. }));
    assert!(matches!(refused(vec![ball], &[ONE, ONE]), Error::OutOfRange { .. }));
    assert!(matches!(refused(vec![ball, ball], &[ONE]), Error::LengthMismatch { given: 1, expected: 2, .. }));
    assert!(matches!(refused(vec![ball; 65], &[ONE]), Error::Capacity { needed: 65, capacity: 64, .. }));
    let leaves = [Leaf { surface: ball, materials: &[1] }];
    let mut memory = [Extent::NOTHING; 1];
    let objects = [Object::new(ONE, |leaf| leaves.get(leaf).map(|l| &l.surface), &mut memory).unwrap()];
    assert!(matches!(World::new(&leaves, &objects, &matt), Err(Error::OutOfRange { index: Some(0), .. })));
    let leaves = [Leaf { surface: ball, materials: &[] }];
    assert!(matches!(World::new(&leaves, &objects, &matt), Err(Error::LengthMismatch { .. })));
    let leaves = [Leaf { surface: ball, materials: &[0] }];
    let world = World::new(&leaves, &objects, &matt).unwrap();
    let at = camera([4.0, 0.0, 0.0], [0.0; 3]);
    let narrow = WorldCaster::<_, _, _, 1, 2>::new(world, Rgb::WHITE, at, SIZE).map(|_| ());
    assert!(matches!(narrow, Err(Error::Capacity { needed: 2, capacity: 1, .. })));
    for capacity in [0, 1] {
        let world = World::new(&leaves, &objects, &matt).unwrap();
        let few = match capacity {
            0 => WorldCaster::<_, _, _, 2, 0>::new(world, Rgb::WHITE, at, SIZE).map(|_| ()),
            _ => WorldCaster::<_, _, _, 2, 1>::new(world, Rgb::WHITE, at, SIZE).map(|_| ()),
        };
        assert_eq!(few, Err(Error::Capacity { what: "rays at a time", needed: 2, capacity }));
    }
    let lamps = [Lamp::point(vector([9.0; 3]), Rgb::WHITE); 65];
    let lit = |count: usize| {
        let world = World::new(&leaves, &objects, &matt).unwrap().with_lamps(&lamps[..count]);
        WorldCaster::<_, _, _, 2, 2>::new(world, Rgb::WHITE, at, SIZE).map(|_| ())
    };
    assert!(matches!(lit(65), Err(Error::Capacity { needed: 65, capacity: 64, .. })));
    assert_eq!(lit(64), Ok(()));
    assert!(Mixture::glass(Real::from_num(0.05)).is_err() && Mixture::glass(Real::from_num(11)).is_err());
    assert!(Mixture::glass(Real::from_num(0.1)).is_ok() && Mixture::glass(Real::from_num(10)).is_ok());
}
