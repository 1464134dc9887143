//! The inputs of the kernels: tables in flash, the same values in each format, so that no loop pays for a
//! conversion.

/// How many inputs a table has.
pub(crate) const COUNT: usize = 256;

/// A word with all bits in play (Weyl sequence, then the finaliser of MurmurHash3).
pub(crate) const fn mixed(i: usize) -> u64 {
    let mut h = (i as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    h = (h ^ (h >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
    h = (h ^ (h >> 33)).wrapping_mul(0xc4ce_b9fe_1a85_ec53);
    h ^ (h >> 33)
}

/// A table of [`COUNT`] values of an expression of the index.
macro_rules! table {
    ($(#[$doc:meta])* $name:ident: $type:ty, $i:ident => $value:expr) => {
        $(#[$doc])*
        pub(crate) static $name: [$type; $crate::inputs::COUNT] = {
            let mut table = [0 as $type; $crate::inputs::COUNT];
            let mut $i = 0;
            while $i < $crate::inputs::COUNT {
                table[$i] = $value;
                $i += 1;
            }
            table
        };
    };
}
pub(crate) use table;
