//! The two rows of a scene of each kind: how its numbers reach what draws it.

/// Both pictures of a scene: in colour, for machines with room, and in black and white. `$size` is that of
/// the picture.
macro_rules! both {
    ($name:literal, |$stage:ident, $color:ident, $size:ident| $show:expr) => {
        [
            {
                type $color = Rgb565;
                #[allow(dead_code, reason = "not every kind lends memory by the size")]
                const $size: embedded_graphics::geometry::Size = COLOUR;
                roomy(colour($name, |$stage| $show))
            },
            {
                type $color = BinaryColor;
                #[allow(dead_code, reason = "not every kind lends memory by the size")]
                const $size: embedded_graphics::geometry::Size = MONO;
                mono($name, |$stage| $show)
            },
        ]
    };
}

macro_rules! chart {
    ($name:literal, $scene:ident) => {
        both!($name, |stage, C, S| fif::chart::<
            C,
            { of::$scene::MAPS },
            { of::$scene::DEGREE },
            { fif::cells_of_chart(of::$scene::MAPS) },
        >(stage, of::$scene::function, &of::$scene::ADDRESS, of::$scene::NAMED))
    };
}

macro_rules! surface {
    ($name:literal, $scene:ident) => {
        both!($name, |stage, C, S| fif::surface::<
            C,
            { of::$scene::MAPS },
            { of::$scene::DEGREE },
            { fif::cells_of_surface(of::$scene::MAPS, of::$scene::DEPTH, S) },
        >(
            stage,
            of::$scene::factor,
            of::$scene::DEPTH,
            of::$scene::caster,
            of::$scene::NAMED
        ))
    };
}

macro_rules! filtered {
    ($name:literal, $scene:ident) => {
        both!($name, |stage, C, S| fif::filtered::<
            C,
            { of::$scene::MAPS },
            { of::$scene::DEGREE },
            { fif::cells_of_surface(of::$scene::MAPS, of::$scene::DEPTH, S) },
            { fif::places_of_filtered(of::$scene::MAPS, of::$scene::DEPTH, S) },
        >(
            stage,
            of::$scene::factor,
            of::$scene::DEPTH,
            (of::$scene::caster, of::$scene::QUALITY),
            of::$scene::NAMED
        ))
    };
}

macro_rules! ifs {
    ($name:literal, $scene:ident) => {
        both!($name, |stage, C, S| sets::attractor::<
            C,
            { sets::room(of::$scene::SHADING, of::$scene::MAPS.len()) },
            { sets::counts_of_attractor(of::$scene::SHADING, S) },
        >(
            stage,
            of::$scene::system,
            (of::$scene::POINTS, of::$scene::SHADING, of::$scene::NAMED)
        ))
    };
}

macro_rules! copier {
    ($name:literal, $scene:ident) => {
        both!($name, |stage, C, S| sets::copies::<C>(
            stage,
            of::$scene::system,
            (&of::$scene::POLYLINE, &of::$scene::ORDERS),
            of::$scene::NAMED,
        ))
    };
}

macro_rules! julia_set {
    ($name:literal, $scene:ident) => {
        both!($name, |stage, C, S| sets::julia::<C, { sets::counts_of_julia(of::$scene::METHOD, S) }>(
            stage,
            of::$scene::set,
            (of::$scene::METHOD, of::$scene::POINTS, of::$scene::NAMED),
        ))
    };
}

macro_rules! curve {
    ($name:literal, $scene:ident) => {
        both!($name, |stage, C, S| paths::refined::<C, { paths::ground(S) }>(
            stage,
            of::$scene::generator::<LARGEST>,
            (&of::$scene::BASE, of::$scene::ORDER),
            (of::$scene::FILLED, of::$scene::PENCIL),
        ))
    };
}

macro_rules! random_curve {
    ($name:literal, $scene:ident) => {
        both!($name, |stage, C, S| paths::random::<C, _, { paths::ground(S) }>(
            stage,
            of::$scene::law,
            (&of::$scene::KNOTS, of::$scene::STOP, of::$scene::GRAPH),
            (of::$scene::FILLED, of::$scene::PENCIL),
        ))
    };
}

macro_rules! l_system {
    ($name:literal, $scene:ident) => {
        both!($name, |stage, C, S| paths::words::<C>(
            stage,
            of::$scene::system,
            of::$scene::ORDER,
            of::$scene::PENCIL
        ))
    };
}

/// A view of an escape-time set, whose colours are others where there is no colour.
macro_rules! view {
    ($name:literal, $scene:ident) => {
        [
            roomy(colour($name, |stage| {
                escape::view::<Rgb565, _, _>(stage, of::$scene::picture, of::$scene::COLOR)
            })),
            mono($name, |stage| {
                escape::view::<BinaryColor, _, _>(stage, of::$scene::picture, of::$scene::GREY)
            }),
        ]
    };
}

/// Periods of cycles.
macro_rules! periods {
    ($name:literal, $scene:ident) => {
        [
            roomy(colour($name, |stage| {
                escape::periods::<Rgb565, _, _>(stage, of::$scene::picture, of::$scene::color)
            })),
            mono($name, |stage| {
                escape::periods::<BinaryColor, _, _>(stage, of::$scene::picture, of::$scene::grey)
            }),
        ]
    };
}

/// Equalised colours.
macro_rules! equalised {
    ($name:literal, $scene:ident) => {
        [
            roomy(colour($name, |stage| {
                escape::equalised::<Rgb565, _, _, { of::$scene::COUNTS }>(
                    stage,
                    of::$scene::picture,
                    of::$scene::color,
                )
            })),
            mono($name, |stage| {
                escape::equalised::<BinaryColor, _, _, { of::$scene::COUNTS }>(
                    stage,
                    of::$scene::picture,
                    of::$scene::grey,
                )
            }),
        ]
    };
}

/// A view that needs an orbit in many limbs.
macro_rules! deep {
    ($name:literal, $scene:ident) => {
        [
            roomy(colour($name, |stage| {
                escape::deep::<Rgb565, _, { of::$scene::ORBIT }>(
                    stage,
                    of::$scene::picture,
                    of::$scene::COLOR,
                )
            })),
            mono($name, |stage| {
                escape::deep::<BinaryColor, _, { of::$scene::ORBIT }>(
                    stage,
                    of::$scene::picture,
                    of::$scene::GREY,
                )
            }),
        ]
    };
}

macro_rules! world {
    ($name:literal, $scene:ident) => {
        both!($name, |stage, C, S| {
            let leaves = of::$scene::leaves()?;
            cast!($scene, stage, C, &leaves, 0)
        })
    };
}

/// A world with height fields, all of one profile.
macro_rules! field_world {
    ($name:literal, $scene:ident) => {
        both!($name, |stage, C, S| {
            const MAPS: usize = of::$scene::PROFILE_0_MAPS;
            const DEPTH: u32 = fif::depth_of_surface(MAPS, None, S);
            let f = of::$scene::profile_0::<MAPS, { of::$scene::PROFILE_0_DEGREE }>()?;
            let mut cells = [attractor::fif::Cell::ZERO; fif::cells_of_surface(MAPS, None, S)];
            let lent = size_of_val(&f) + size_of_val(&cells);
            let fields = of::$scene::fields(&[attractor::fif::Pyramid::new(&f, DEPTH, &mut cells)?])?;
            let leaves = of::$scene::leaves(&fields)?;
            cast!($scene, stage, C, &leaves, lent + size_of_val(&fields))
        })
    };
}

/// The picture of a world with these leaves, which borrow so many bytes.
macro_rules! cast {
    ($scene:ident, $stage:ident, $color:ident, $leaves:expr, $lent:expr) => {{
        let leaves = $leaves;
        let (materials, lamps) = (of::$scene::materials()?, of::$scene::lamps()?);
        let mut boxes = [attractor::trace::Extent::NOTHING; of::$scene::BOXES];
        let objects = of::$scene::objects(leaves, &mut boxes)?;
        let world = of::$scene::world(leaves, &objects, &materials, &lamps)?;
        let caster = of::$scene::caster(world, $stage.size(), SEED as u32)?;
        let bytes = $lent
            + size_of_val(leaves)
            + size_of_val(&materials)
            + size_of_val(&lamps)
            + size_of::<[attractor::trace::Extent; of::$scene::BOXES]>()
            + size_of_val(&objects)
            + size_of_val(&caster);
        worlds::light::<$color>($stage, caster, of::$scene::CONTRAST, bytes)
    }};
}

macro_rules! texture {
    ($name:literal, $scene:ident) => {
        both!($name, |stage, C, S| worlds::texture::<C, _>(stage, of::$scene::picture))
    };
}

/// A landscape under the ray caster.
macro_rules! terrain {
    ($name:literal, $scene:ident) => {
        both!($name, |stage, C, S| terrain::land::<
            C,
            { of::$scene::PICTURE.heights() },
            { of::$scene::PICTURE.words() },
            { of::$scene::PICTURE.ranges() },
        >(stage, &of::$scene::PICTURE))
    };
}

/// A surface by its lines.
macro_rules! lines {
    ($name:literal, $scene:ident) => {
        both!($name, |stage, C, S| terrain::lines::<C>(
            stage,
            &of::$scene::PICTURE,
            (of::$scene::LINES, of::$scene::PENCIL)
        ))
    };
}

/// An encoded picture.
macro_rules! image {
    ($name:literal, $scene:ident) => {
        both!($name, |stage, C, S| image::decoded::<
            C,
            of::$scene::Sample,
            { image::samples(of::$scene::SAMPLES, of::$scene::SIZE, S, of::$scene::PICTURE.sweeps.len()) },
        >(stage, &of::$scene::PICTURE))
    };
}

/// A curve by control points.
macro_rules! patch_curve {
    ($name:literal, $scene:ident) => {
        both!($name, |stage, C, S| patches::curve::<C, { of::$scene::POINTS.len() }>(
            stage,
            of::$scene::curve,
            (of::$scene::POINTS, of::$scene::LEVELS),
            of::$scene::PENCIL
        ))
    };
}

/// A surface by control points.
macro_rules! lattice {
    ($name:literal, $scene:ident) => {
        both!($name, |stage, C, S| patches::lattice::<C, _>(stage, of::$scene::scheme, of::$scene::picture))
    };
}

macro_rules! patch_surface {
    ($name:literal, $scene:ident) => {
        both!($name, |stage, C, S| patches::surface::<C, _, _>(
            stage,
            of::$scene::scheme,
            of::$scene::picture
        ))
    };
}
