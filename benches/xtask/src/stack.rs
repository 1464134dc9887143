//! A bound on the stack of an image: what its functions push, along the deepest path of calls.
//!
//! The functions of a Thumb image are read instruction by instruction. A function's frame is the sum of all
//! that it pushes and subtracts from the stack pointer anywhere, and a path's is the sum of its functions'
//! frames; a branch to another function is a tail call, at which the caller's frame is gone (Arm's procedure
//! call standard). A call through a register may go to any function whose address the image holds: as a word
//! of its constants or data, or as the two halves that MOVW and MOVT of one function load. An image that
//! calls itself, or moves the stack pointer by a register, has no bound of this kind. What an interrupt
//! pushes (at most 104 bytes with the FPU's registers) comes on top; the vector table calls nothing else.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::{Context, Result, bail};
use object::{Object, ObjectSection, ObjectSymbol, SectionFlags, SectionKind, SymbolKind};

/// A function: what it does to the stack and where it goes.
#[derive(Debug, Default, PartialEq, Eq)]
struct Function {
    name: String,
    frame: u64,
    calls: Vec<u64>,
    jumps: Vec<u64>,
    /// Whether it calls, or jumps, through a register.
    calls_pointer: bool,
    jumps_to_pointer: bool,
    /// What it loads into the lower and upper halves of registers.
    halves: [BTreeSet<u32>; 2],
    /// What has no bound, if anything.
    unbounded: Option<String>,
}

/// The most bytes of stack from the entry of the image at `path` on.
pub(crate) fn bound(path: &Path) -> Result<u64> {
    let bytes = std::fs::read(path).with_context(|| format!("{} cannot be read", path.display()))?;
    let file = object::File::parse(&*bytes).with_context(|| format!("{} is no image", path.display()))?;
    let mut names = BTreeMap::new();
    // $d and $t say where constants begin among the code, and where code goes on
    let mut constants = BTreeMap::new();
    for symbol in file.symbols() {
        let (name, address) = (symbol.name().unwrap_or_default(), symbol.address() & !1);
        match name.split('.').next() {
            Some("$d") => drop(constants.insert(address, true)),
            Some("$t") => drop(constants.insert(address, false)),
            // of several names the one with a size: what follows it is padding
            _ if symbol.kind() == SymbolKind::Text => {
                let known: &mut (u64, String) = names.entry(address).or_default();
                *known = (known.0.max(symbol.size()), name.to_owned());
            }
            _ => {}
        }
    }
    let mut functions = BTreeMap::new();
    let mut words = BTreeSet::new();
    for section in file.sections() {
        let SectionFlags::Elf { sh_flags, .. } = section.flags() else { continue };
        let (start, data) = (section.address(), section.data()?);
        // names and symbols are not in the microcontroller
        if (sh_flags & object::elf::SHF_ALLOC).0 != 0 && section.name() != Ok(".vector_table") {
            let aligned =
                data.get(start.next_multiple_of(4).wrapping_sub(start) as usize..).unwrap_or_default();
            words.extend(
                aligned.chunks_exact(4).filter_map(|word| Some(u32::from_le_bytes(word.try_into().ok()?))),
            );
        }
        if section.kind() != SectionKind::Text {
            continue;
        }
        let end = start + data.len() as u64;
        for (&address, (size, name)) in names.range(start..end) {
            let next = names.range(address + 1..end).next().map_or(end, |(next, _)| *next);
            let next = if *size > 0 { next.min(address + size) } else { next };
            let halfword = |at: u64| {
                let known = constants.range(..=at).next_back().filter(|(from, _)| **from >= start);
                let i = (at - start) as usize;
                let pair = data.get(i..i + 2).filter(|_| !known.is_some_and(|(_, constant)| *constant))?;
                Some(u16::from_le_bytes([pair[0], pair[1]]))
            };
            let mut function = read(address..next, halfword);
            function.name = name.clone();
            functions.insert(address, function);
        }
    }
    follow_pointers(&mut functions, &words);
    deepest(&functions, file.entry() & !1, &mut BTreeMap::new())
}

/// Lets what calls through a register call all functions whose address is one of `words`, or is loaded by
/// halves in one function.
fn follow_pointers(functions: &mut BTreeMap<u64, Function>, words: &BTreeSet<u32>) {
    let loaded = |pointer: u32| {
        let [lower, upper] = [pointer & 0xffff, pointer >> 16];
        functions.values().any(|f| f.halves[0].contains(&lower) && f.halves[1].contains(&upper))
    };
    // the lowest bit of a pointer says Thumb
    let held: Vec<u64> = functions
        .keys()
        .copied()
        .filter(|address| {
            let pointer = *address as u32 | 1;
            words.contains(&pointer) || loaded(pointer)
        })
        .collect();
    for function in functions.values_mut() {
        for (through, targets) in
            [(function.calls_pointer, &mut function.calls), (function.jumps_to_pointer, &mut function.jumps)]
        {
            if through {
                targets.extend(&held);
            }
        }
    }
}

/// Reads a function. `halfword` knows nothing where constants lie.
fn read(range: std::ops::Range<u64>, halfword: impl Fn(u64) -> Option<u16>) -> Function {
    let mut function = Function::default();
    let mut at = range.start;
    while at < range.end {
        let Some(first) = halfword(at) else {
            at += 2;
            continue;
        };
        let first = u32::from(first);
        let long = first >> 11 >= 0b11101;
        let second = if long { halfword(at + 2).map_or(0, u32::from) } else { 0 };
        function.frame += if long { taken_long(first, second) } else { taken(first) };
        let target = if long { target_long(at, first, second) } else { target(at, first) };
        match target {
            Some((to, true)) => function.calls.push(to),
            Some((to, false)) if !range.contains(&to) => function.jumps.push(to),
            _ => {}
        }
        match first & 0xff87 {
            0x4780 => function.calls_pointer = true,
            0x4700 if first != 0x4770 => function.jumps_to_pointer = true,
            _ => {}
        }
        if let (true, Some((half, value))) = (long, loaded_half(first, second)) {
            function.halves[half].insert(value);
        }
        if if long { is_unbounded_long(first, second) } else { is_unbounded(first) } {
            function.unbounded = Some(format!("{first:04x} at {at:#x}"));
        }
        at += if long { 4 } else { 2 };
    }
    function
}

/// Bytes that a short instruction takes from the stack.
fn taken(first: u32) -> u64 {
    match first {
        // PUSH, SUB SP
        0xb400..=0xb5ff => 4 * u64::from((first & 0x1ff).count_ones()),
        0xb080..=0xb0ff => 4 * u64::from(first & 0x7f),
        _ => 0,
    }
}

fn taken_long(first: u32, second: u32) -> u64 {
    let constant = (first >> 10 & 1) << 11 | (second >> 12 & 7) << 8 | second & 0xff;
    match first {
        // STMDB SP!, STR and STRD [SP, #-n]!, VPUSH
        0xe92d => 4 * u64::from(second.count_ones()),
        0xf84d if second & 0xf00 == 0xd00 => u64::from(second & 0xff),
        0xe96d => 4 * u64::from(second & 0xff),
        0xed2d | 0xed6d if second & 0xe00 == 0xa00 => 4 * u64::from(second & 0xff),
        // SUB.W SP, SP and SUBW SP, SP
        0xf1ad | 0xf5ad | 0xf1bd | 0xf5bd if second & 0x8f00 == 0xd00 => u64::from(expanded(constant)),
        0xf2ad | 0xf6ad if second & 0x8f00 == 0xd00 => u64::from(constant),
        _ => 0,
    }
}

/// A modified immediate constant.
fn expanded(constant: u32) -> u32 {
    let byte = constant & 0xff;
    match constant >> 8 {
        0 => byte,
        1 => byte << 16 | byte,
        2 => byte << 24 | byte << 8,
        3 => byte * 0x0101_0101,
        _ => (0x80 | constant & 0x7f).rotate_right(constant >> 7),
    }
}

/// Where a short branch goes; it never calls.
fn target(at: u64, first: u32) -> Option<(u64, bool)> {
    let offset = match first {
        0xd000..=0xddff => i64::from(first as u8 as i8) * 2,
        0xe000..=0xe7ff => i64::from((first << 21) as i32 >> 20),
        _ => return None,
    };
    Some(((at + 4).wrapping_add_signed(offset), false))
}

/// Where a long branch goes, and whether it is a call.
fn target_long(at: u64, first: u32, second: u32) -> Option<(u64, bool)> {
    if first & 0xf800 != 0xf000 || second & 0x8000 == 0 {
        return None;
    }
    let (sign, low) = (first >> 10 & 1, (second & 0x7ff) << 1);
    let (j1, j2) = (second >> 13 & 1, second >> 11 & 1);
    let is_call = second & 0xd000 == 0xd000;
    let (value, bits) = if is_call || second & 0xd000 == 0x9000 {
        let (i1, i2) = (j1 ^ sign ^ 1, j2 ^ sign ^ 1);
        (sign << 24 | i1 << 23 | i2 << 22 | (first & 0x3ff) << 12 | low, 25)
    } else if second & 0xd000 == 0x8000 && first >> 7 & 7 != 7 {
        (sign << 20 | j2 << 19 | j1 << 18 | (first & 0x3f) << 12 | low, 21)
    } else {
        return None;
    };
    let offset = (value << (32 - bits)) as i32 >> (32 - bits);
    Some(((at + 4).wrapping_add_signed(offset.into()), is_call))
}

/// What MOVW (0) or MOVT (1) loads.
fn loaded_half(first: u32, second: u32) -> Option<(usize, u32)> {
    let half = match first & 0xfbf0 {
        0xf240 => 0,
        0xf2c0 => 1,
        _ => return None,
    };
    let value = (first & 15) << 12 | (first >> 10 & 1) << 11 | (second >> 12 & 7) << 8 | second & 0xff;
    (second & 0x8000 == 0).then_some((half, value))
}

/// MOV and ADD to the stack pointer or the program counter.
fn is_unbounded(first: u32) -> bool {
    matches!(first & 0xff87, 0x4485 | 0x4685 | 0x4487 | 0x4687)
}

/// LDR to the program counter but from the stack; SUB and ADD of a register, or to the stack pointer from
/// another register.
fn is_unbounded_long(first: u32, second: u32) -> bool {
    let loads_pc = matches!(first & 0xff70, 0xf850) && second >> 12 == 15 && first & 15 != 13;
    let (to_sp, of_sp) = (second & 0x8f00 == 0xd00, first & 15 == 13);
    let sum = matches!(first & 0xffe0, 0xeba0 | 0xeb00) && second & 0xf00 == 0xd00;
    let constant = matches!(first & 0xfbe0, 0xf1a0 | 0xf100) || matches!(first & 0xfbf0, 0xf2a0 | 0xf200);
    loads_pc || sum || constant && to_sp && !of_sp
}

/// The deepest path from `address` on; `known` holds the functions that are done, and none for those on the
/// path.
fn deepest(
    functions: &BTreeMap<u64, Function>,
    address: u64,
    known: &mut BTreeMap<u64, Option<u64>>,
) -> Result<u64> {
    // hand-written code also branches into the middle of functions
    let (&address, function) = functions
        .range(..=address)
        .next_back()
        .with_context(|| format!("there is no function at {address:#x}"))?;
    match known.get(&address) {
        Some(Some(depth)) => return Ok(*depth),
        Some(None) => bail!("{} calls itself", function.name),
        None => {}
    }
    if let Some(what) = &function.unbounded {
        bail!("{} goes where only the run decides ({what})", function.name);
    }
    known.insert(address, None);
    let mut below = |targets: &[u64]| {
        targets.iter().try_fold(0, |most: u64, to| Ok(most.max(deepest(functions, *to, known)?)))
    };
    let depth: Result<u64> = below(&function.calls).and_then(|calls| {
        let jumps = below(&function.jumps)?;
        Ok((function.frame + calls).max(jumps))
    });
    let depth = depth?;
    known.insert(address, Some(depth));
    Ok(depth)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn function(code: &[u16]) -> Function {
        let end = 0x100 + 2 * code.len() as u64;
        read(0x100..end, |at| code.get(((at - 0x100) / 2) as usize).copied())
    }

    #[test]
    fn frames_are_what_the_instructions_take() {
        // push {r4, r7, lr}; sub sp, #16; pop {r4, r7, pc}
        assert_eq!(function(&[0xb590, 0xb084, 0xbd90]).frame, 12 + 16);
        // push.w {r4-r11, lr}; vpush {d8, d9}; sub.w sp, sp, #2064; subw sp, sp, #2068; str r1, [sp, #-4]!
        let long = [0xe92d, 0x4ff0, 0xed2d, 0x8b04, 0xf5ad, 0x6d01, 0xf6ad, 0x0d14, 0xf84d, 0x1d04];
        assert_eq!(function(&long).frame, 36 + 16 + 2064 + 2068 + 4);
    }

    #[test]
    fn calls_jumps_and_what_has_no_bound_are_seen() {
        // bl +0x10; b.w to 0x100 - 0x10; beq inside; bx lr
        let plain = function(&[0xf000, 0xf808, 0xf7ff, 0xbff4, 0xd0fa, 0x4770]);
        assert!(!plain.calls_pointer && !plain.jumps_to_pointer);
        assert_eq!((plain.calls, plain.jumps, plain.unbounded), (vec![0x114], vec![0xf0], None));
        for code in [&[0xebad_u16, 0x0d01][..], &[0x4685], &[0xf8df, 0xf000]] {
            assert!(function(code).unbounded.is_some(), "{code:04x?}");
        }
    }

    #[test]
    fn what_calls_a_pointer_may_call_all_that_the_image_holds() {
        // movw r3, #0x1235; movt r3, #0x0800; blx r3
        let caller = function(&[0xf241, 0x2335, 0xf6c0, 0x0300, 0x4798]);
        assert_eq!(caller.halves, [BTreeSet::from([0x1235]), BTreeSet::from([0x0800])]);
        // bx r3
        let jumper = function(&[0x4718]);
        let leaf = |frame| Function { frame, ..Default::default() };
        let mut all = BTreeMap::from([
            (0x100, caller),
            (0x200, jumper),
            (0x0800_1234, leaf(40)),
            (0x0800_2000, leaf(80)),
            (0x0800_3000, leaf(1000)),
        ]);
        // one is loaded, one is a constant; of the third the image holds no address but an even one
        follow_pointers(&mut all, &BTreeSet::from([0x0800_2001, 0x0800_3000]));
        assert_eq!(all[&0x100].calls, [0x0800_1234, 0x0800_2000]);
        assert_eq!(all[&0x200].jumps, [0x0800_1234, 0x0800_2000]);
        assert_eq!(deepest(&all, 0x100, &mut BTreeMap::new()).unwrap(), 80);
    }

    #[test]
    fn the_deepest_path_counts_and_a_circle_has_none() {
        let function = |frame, calls: &[u64], jumps: &[u64]| Function {
            frame,
            calls: calls.into(),
            jumps: jumps.into(),
            ..Default::default()
        };
        let mut all = BTreeMap::from([
            (0, function(8, &[2, 4], &[])),
            (2, function(100, &[], &[4])),
            (4, function(60, &[6], &[])),
            (6, function(50, &[], &[])),
        ]);
        // 0 calls 4 calls 6; the jump from 2 to 4 has left its 100 behind
        assert_eq!(deepest(&all, 0, &mut BTreeMap::new()).unwrap(), 8 + 60 + 50);
        all.insert(6, function(50, &[2], &[]));
        assert!(deepest(&all, 0, &mut BTreeMap::new()).is_err());
    }
}
