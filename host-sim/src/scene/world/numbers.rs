//! What a world has at a ray: crossings of its objects, and their inside-outside functions.

use std::io::Write;
use std::ops::ControlFlow;
use std::path::Path;

use attractor::num::{Real, Unit, Vec3, Wide};
use attractor::plane::Field as _;
use attractor::trace::world::Op;
use attractor::trace::{Crossing, Extent, Ray, Surface as _};

use super::super::request::{Question, Request};
use super::figure::Solid;
use super::reference::Exact;
use super::reference_world;
use super::values::{PIXEL, cells, light, values};
use super::view::WorldScene;
use crate::fail::Fail;
use crate::lines::Lines;
use crate::number::exact;

/// Height fields are as fine as for so many pixels.
const SIDE: u32 = 1024;

const RAY: [&str; 6] = ["ox", "oy", "oz", "dx", "dy", "dz"];

/// What is no ray of a world.
fn check([ox, oy, oz, dx, dy, dz]: [Real; 6]) -> Result<(), (usize, String)> {
    let beyond = |limit: i32| move |(_, part): &(usize, Real)| part.unsigned_abs() > limit as u32;
    if let Some((column, _)) = [ox, oy, oz].into_iter().enumerate().find(beyond(64)) {
        return Err((column, "allowed is -64 to 64".to_owned()));
    }
    if let Some((column, _)) = [dx, dy, dz].into_iter().enumerate().find(beyond(4)) {
        return Err((3 + column, "allowed is -4 to 4".to_owned()));
    }
    if [dx, dy, dz] == [Real::ZERO; 3] {
        return Err((3, "the ray has no direction: dx, dy and dz are 0".to_owned()));
    }
    Ok(())
}

fn ray([ox, oy, oz, dx, dy, dz]: [Real; 6]) -> Ray {
    Ray::new(Vec3::new(ox, oy, oz), Vec3::new(dx, dy, dz))
}

/// Whether a program is inside, from whether each leaf is; and its value from those of the leaves: the least
/// of a union, the greatest of an intersection.
fn value<T: Copy>(ops: &[Op], leaf: impl Fn(usize) -> T, join: impl Fn(Op, T, T) -> T) -> Option<T> {
    let mut stack = Vec::new();
    for op in ops {
        match op {
            Op::Leaf(number) => stack.push(leaf(usize::from(*number))),
            op => {
                let (right, left) = (stack.pop()?, stack.pop()?);
                stack.push(join(*op, left, right));
            }
        }
    }
    stack.pop()
}

fn is_inside(ops: &[Op], leaf: impl Fn(usize) -> bool) -> bool {
    let join = |op, left: bool, right: bool| match op {
        Op::Union => left || right,
        Op::Intersection => left && right,
        _ => left && !right,
    };
    value(ops, leaf, join).unwrap_or(false)
}

/// A place where an object begins or ends on a ray.
struct Change {
    crossing: Crossing,
    leaf: usize,
    enters: bool,
}

/// All of an object with these leaves, in order.
fn changes(ops: &[Op], surfaces: &[Solid<'_>], ray: &Ray) -> Vec<Change> {
    let mut inside: Vec<bool> =
        surfaces.iter().map(|one| one.is_closed() && one.value(ray.origin()) < Wide::ZERO).collect();
    let mut all = Vec::new();
    for op in ops {
        let Op::Leaf(leaf) = op else { continue };
        let leaf = usize::from(*leaf);
        surfaces[leaf].cross(ray, Unit::ZERO, &mut |crossing| {
            all.push((crossing, leaf));
            ControlFlow::Continue(())
        });
    }
    all.sort_by_key(|(crossing, _)| crossing.t);
    let mut changes = Vec::new();
    for (crossing, leaf) in all {
        let before = is_inside(ops, |leaf| inside[leaf]);
        inside[leaf] = crossing.enters;
        let after = is_inside(ops, |leaf| inside[leaf]);
        if before != after {
            changes.push(Change { crossing, leaf, enters: after });
        }
    }
    changes
}

/// Every crossing of every object by the rays of a file.
fn crossings(scene: &WorldScene, file: &Path, out: &mut dyn Write) -> Result<(), Fail> {
    let rays = Lines::of("--rays", file, RAY).read(file, check)?;
    scene.with_surfaces(SIDE, |surfaces| listed(scene, &rays, &surfaces, out))
}

fn listed(
    scene: &WorldScene,
    rays: &[[Real; 6]],
    surfaces: &[Solid<'_>],
    out: &mut dyn Write,
) -> Result<(), Fail> {
    writeln!(out, "ray,crossing,t,object,face,enters,x,y,z,nx,ny,nz,u,v,t_reference")?;
    let exact_shapes: Vec<Exact> = scene.exact(SIDE);
    for (number, given) in rays.iter().enumerate() {
        let ray = ray(*given);
        let mut all = Vec::new();
        for (object, program) in scene.world.programs.objects.iter().enumerate() {
            all.extend(changes(&program.ops, surfaces, &ray).into_iter().map(|change| (change, object)));
        }
        all.sort_by_key(|(change, _)| change.crossing.t);
        for (count, (Change { crossing, leaf, enters }, object)) in all.iter().enumerate() {
            let point = surfaces[*leaf].point(&ray, Unit::ZERO, crossing, true);
            // the outward normal of the object: a part that was taken away is turned inside out
            let sign = if *enters == crossing.enters { Unit::ONE } else { -Unit::ONE };
            let mut row = csv::Writer::from_writer(Vec::new());
            let numbers = [point.position.x, point.position.y, point.position.z].map(exact);
            let normal = [point.normal.x, point.normal.y, point.normal.z].map(|c| exact(c * sign));
            let chart = [point.chart.u, point.chart.v].map(exact);
            let reference = exact_shapes.get(*leaf).map(|shape| nearest(shape, given, crossing));
            let reference = [reference.flatten().map(|t| format!("{t:?}")).unwrap_or_default()];
            let head = [
                number.to_string(),
                count.to_string(),
                exact(crossing.t),
                scene.name(*object),
                crossing.face.to_string(),
                u8::from(*enters).to_string(),
            ];
            let written =
                row.write_record(head.iter().chain(&numbers).chain(&normal).chain(&chart).chain(&reference));
            let bytes = written.ok().and_then(|()| row.into_inner().ok()).unwrap_or_default();
            out.write_all(&bytes)?;
        }
    }
    Ok(())
}

/// The reference's crossing of the same face in the same direction that is nearest to one of core's, if it
/// has any.
fn nearest(shape: &Exact, given: &[Real; 6], crossing: &Crossing) -> Option<f64> {
    let [ox, oy, oz, dx, dy, dz] = given.map(Real::to_num::<f64>);
    let t = crossing.t.to_num::<f64>();
    let all = shape.crossings([ox, oy, oz], [dx, dy, dz]);
    let same = all
        .into_iter()
        .filter(|(_, enters, face)| *enters == crossing.enters && *face == usize::from(crossing.face));
    same.map(|(reference, ..)| reference).min_by(|a, b| (a - t).abs().total_cmp(&(b - t).abs()))
}

/// The inside-outside function of every object at places of a ray, from before the first thing with a limit
/// to behind the last.
fn along(scene: &WorldScene, text: &str, points: u32, out: &mut dyn Write) -> Result<(), Fail> {
    let rays = Lines::given("--along", RAY).parse(text, check)?;
    let [given] = rays.as_slice() else {
        return Err(Fail::new(format_args!("--along: {} lines, one ray is asked for", rays.len())));
    };
    let ray = ray(*given);
    scene.with_surfaces(SIDE, |surfaces| curve(scene, &ray, &surfaces, points, out))
}

fn curve(
    scene: &WorldScene,
    ray: &Ray,
    surfaces: &[Solid<'_>],
    points: u32,
    out: &mut dyn Write,
) -> Result<(), Fail> {
    let (from, to) = span(surfaces, ray);
    let mut head = csv::Writer::from_writer(Vec::new());
    let names = (0..scene.world.programs.objects.len()).map(|object| scene.name(object));
    let written = head.write_record(std::iter::once("t".to_owned()).chain(names));
    out.write_all(&written.ok().and_then(|()| head.into_inner().ok()).unwrap_or_default())?;
    for k in 0..points {
        let part = f64::from(k) / f64::from((points - 1).max(1));
        let t = Real::saturating_from_num(from + (to - from) * part);
        let place = ray.at(t);
        write!(out, "{}", exact(t))?;
        for object in &scene.world.programs.objects {
            let join = |op, left: Wide, right: Wide| match op {
                Op::Union => left.min(right),
                Op::Intersection => left.max(right),
                _ => left.max(right.saturating_neg()),
            };
            let value = value(&object.ops, |leaf| surfaces[leaf].value(place), join).unwrap_or_default();
            write!(out, ",{}", exact(value))?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// Where a ray is near the things that have limits, and a quarter more at each end; else its first 16 units.
fn span(surfaces: &[Solid<'_>], ray: &Ray) -> (f64, f64) {
    let boxes = surfaces.iter().map(|one| one.extent()).filter(|extent| {
        let ends = [extent.low, extent.high].map(|v| [v.x, v.y, v.z]);
        ends.iter().flatten().all(|c| c.unsigned_abs() < 100)
    });
    let hull = boxes.fold(Extent::NOTHING, Extent::hull);
    if hull.is_empty() {
        return (0.0, 16.0);
    }
    let number = |v: Vec3| [v.x, v.y, v.z].map(|c| c.to_num::<f64>());
    let (low, high, origin) = (number(hull.low), number(hull.high), number(ray.origin()));
    let d = ray.direction();
    let direction = [d.x, d.y, d.z].map(|c| c.to_num::<f64>());
    let (mut from, mut to) = (0.0_f64, 128.0_f64);
    for axis in 0..3 {
        if direction[axis] != 0.0 {
            let ends = [low[axis], high[axis]].map(|end| (end - origin[axis]) / direction[axis]);
            from = from.max(ends[0].min(ends[1]));
            to = to.min(ends[0].max(ends[1]));
        }
    }
    if from >= to {
        return (0.0, 16.0);
    }
    let more = (to - from) / 4.0;
    ((from - more).max(0.0), (to + more).min(127.0))
}

/// What is asked for.
pub(crate) fn sample(
    scene: &WorldScene,
    request: &Request,
    question: Question<'_>,
    points: u32,
    out: &mut dyn Write,
) -> Result<(), Fail> {
    match question {
        Question::Usual | Question::Pixels => pixels(scene, request, out),
        Question::Rays(file) => crossings(scene, file, out),
        Question::Along(ray) => along(scene, ray, points, out),
        Question::Places(file) => {
            let names = scene.world.texture_names.iter().map(String::as_str);
            let textures: Vec<_> = names.zip(&scene.world.textures).collect();
            if textures.is_empty() {
                return Err(Fail::new(format_args!("--at {}: the world has no texture", file.display())));
            }
            values(&textures, file, out)
        }
    }
}

/// The light of every pixel, beside the reference's; of a pixel in which that finds glass in glass nothing.
fn pixels(scene: &WorldScene, request: &Request, out: &mut dyn Write) -> Result<(), Fail> {
    let reference = reference_world::Exact::new(scene, request);
    scene.with_caster(request, |caster| {
        writeln!(out, "{PIXEL}")?;
        for j in 0..request.size.height {
            for (i, value) in (0..request.size.width).zip(caster.row(j, 0..request.size.width)) {
                writeln!(out, "{i},{j},{},{}", light(value), cells(reference.pixel(i, j).ok()))?;
            }
        }
        Ok(())
    })
}
