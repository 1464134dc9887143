//! How deep pyramids are built.

use attractor::fif::Pyramid;

/// The depth at which a pyramid has at least `cells` cells at its finest level, and no more than about a
/// million in all.
pub const fn depth_for(maps: usize, cells: u32) -> u32 {
    let mut depth = 0;
    let mut finest = 1_usize;
    while finest < cells as usize
        && depth < Pyramid::MAX_DEPTH
        && maps > 1
        && Pyramid::cells(maps, depth + 1) <= 1 << 20
    {
        depth += 1;
        finest *= maps;
    }
    depth
}

/// The depth of both pyramids of a surface whose factors have so many maps, on a display whose longer side
/// has `side` pixels: as deep as wanted, else cells as fine as a pixel.
pub const fn surface_depth(maps: [usize; 2], wanted: Option<u32>, side: u32) -> u32 {
    let [f, g] = maps;
    let (fewest, most) = if f < g { (f, g) } else { (g, f) };
    let depth = match wanted {
        Some(depth) => depth,
        None => depth_for(fewest, side),
    };
    let deepest = depth_for(most, u32::MAX);
    if depth < deepest { depth } else { deepest }
}

/// The depth of the running sums of a filtered picture: cells an eighth as wide as a pixel.
pub const fn filtered_depth(maps: [usize; 2], wanted: Option<u32>, side: u32) -> u32 {
    surface_depth(maps, wanted, side.saturating_mul(8))
}
