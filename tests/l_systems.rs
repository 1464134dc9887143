//! L-systems against words that are written down and drawn in `f64`; what they refuse; the room they take.

use attractor::Error;
use attractor::curve::{Generator, LSystem, MAX_LETTERS, MAX_RULES, Turtle, turn_over};
use attractor::num::Wide;
use attractor::plane::PathElement;
use attractor_reference::l_system::{demands, rewritten, strokes};
use proptest::prelude::*;

type Rules<'a> = &'a [(char, &'a str)];

fn system<'a>(axiom: &'a str, rules: Rules<'a>, degrees: f64) -> LSystem<'a> {
    LSystem::new(axiom, rules, Wide::from_num(degrees)).unwrap()
}

/// The strokes, in steps.
fn drawn<const O: usize, const B: usize>(turtle: Turtle<'_, O, B>) -> Vec<Vec<(f64, f64)>> {
    let step = turtle.step().to_num::<f64>();
    let mut strokes: Vec<Vec<(f64, f64)>> = Vec::new();
    for each in turtle {
        let (PathElement::MoveTo(p) | PathElement::LineTo(p)) = each;
        if matches!(each, PathElement::MoveTo(_)) {
            strokes.push(Vec::new());
        }
        let point = (p.x.to_num::<f64>() / step, p.y.to_num::<f64>() / step);
        strokes.last_mut().expect("a path begins with a move").push(point);
    }
    strokes
}

/// The largest difference of a coordinate, where both have the same strokes.
fn difference(got: &[Vec<(f64, f64)>], want: &[Vec<(f64, f64)>]) -> f64 {
    assert!(got.iter().map(Vec::len).eq(want.iter().map(Vec::len)));
    let points = got.iter().flatten().zip(want.iter().flatten());
    points.fold(0.0_f64, |worst, (p, q)| worst.max((p.0 - q.0).abs()).max((p.1 - q.1).abs()))
}

const BOUND: f64 = 1.0 / 2_097_152.0;

const CANTOR: Rules<'_> = &[('F', "FfF"), ('f', "fff")];
const DRAGON: Rules<'_> = &[('X', "X+YF+"), ('Y', "-FX-Y")];
const PLANT: Rules<'_> = &[('X', "F-[[X]+X]+F[+FX]-X"), ('F', "FF")];

#[test]
fn every_point_is_within_its_bound() {
    let mut overall = 0.0_f64;
    let many = "F+".repeat(1000);
    let cases: &[(&str, Rules<'_>, f64, u32)] = &[
        ("F", CANTOR, 60.0, 7),
        ("FX", DRAGON, 90.0, 14),
        ("FX", DRAGON, 87.3, 12),
        ("X", PLANT, 22.5, 5),
        ("F", &[('F', "F[+F]F[-F]F")], 25.7, 5),
        ("F", &[('F', "FF-[-F+F+F]+[+F-F-F]")], 22.5, 4),
        ("F-G-G", &[('F', "F-G+F+G-F"), ('G', "GG")], 120.0, 7),
        ("F|F", &[('F', "F+F--F+F")], 60.0, 6),
        // headings that only grow, round and round: a million turns
        ("X", &[('X', &many), ('F', "FF+F+F")], 360.0 / 7.0, 2),
        ("F", &[('F', "F+F")], 0.001, 9),
        ("Y", &[('Y', "YYYYYYYYYYF+")], 0.37, 5),
        // one long straight line: the sine's error adds up
        ("F", &[('F', "FFFFFFFF")], 33.0, 6),
    ];
    for (axiom, rules, degrees, order) in cases {
        for heading in [0.0, 90.0, 33.0] {
            let lent = system(axiom, rules, *degrees).with_heading(Wide::from_num(heading));
            let turtle = lent.path::<14, 16>(*order).unwrap();
            let word = rewritten(axiom, rules, *order);
            assert_eq!(turtle.steps(), demands(&word).1);
            let step = turtle.step().to_num::<f64>();
            // the angle that the kernel was given
            let degrees = Wide::from_num(*degrees).to_num::<f64>();
            let error = difference(&drawn(turtle), &strokes(&word, degrees, heading)) * step;
            println!("{axiom} {rules:.20?}: 2^{:.2}", error.log2());
            assert!(error < BOUND, "{axiom} {rules:?}: {error:e}");
            overall = overall.max(error);
        }
    }
    assert!(overall > BOUND / 64.0, "{overall:e}");
}

#[test]
fn cantor_s_set_has_its_gaps() {
    for order in 0..=6 {
        let turtle = system("F", CANTOR, 90.0).path::<6, 0>(order).unwrap();
        let got = drawn(turtle);
        // the integers whose ternary digits are 0 and 2 alone
        let has_no_1 = |n: u32| (0..order).all(|digit| n / 3_u32.pow(digit) % 3 != 1);
        let want: Vec<u32> = (0..3_u32.pow(order)).filter(|n| has_no_1(*n)).collect();
        assert_eq!(got.len(), 1 << order);
        for (stroke, n) in got.iter().zip(want) {
            let line = [(f64::from(n), 0.0), (f64::from(n + 1), 0.0)];
            assert!(difference(std::slice::from_ref(stroke), &[line.to_vec()]) < 1e-4, "{n}: {stroke:?}");
        }
    }
}

#[test]
fn the_dragon_of_rewriting_letters_is_the_dragon_of_folded_paper() {
    let corners = drawn(system("FX", DRAGON, 90.0).path::<12, 0>(12).unwrap());
    assert_eq!(corners.len(), 1);
    let corners = &corners[0];
    assert_eq!(corners.len(), (1 << 12) + 1);
    for n in 1_u32..1 << 12 {
        // the fold at n: the bit above its lowest one
        let is_left = n >> n.trailing_zeros() & 2 == 0;
        let [a, b, c] = [0, 1, 2].map(|i| corners[n as usize - 1 + i]);
        let turn = (b.0 - a.0) * (c.1 - b.1) - (b.1 - a.1) * (c.0 - b.0);
        assert!((turn - if is_left { 1.0 } else { -1.0 }).abs() < 1e-3, "{n}: {turn}");
    }
}

fn error(axiom: &str, rules: Rules<'_>) -> Error {
    LSystem::new(axiom, rules, Wide::ONE).unwrap_err()
}

#[test]
fn bad_words_are_refused_with_the_character_and_its_place() {
    let letters = "is none of its letters: A to Z, a to z (F and G draw, f moves), + - | [ ]";
    for (axiom, rules, text) in [
        ("F\u{2212}F", &[][..], format!("axiom: character 2, '\u{2212}' (U+2212), {letters}")),
        ("\u{e9}F", &[], format!("axiom: character 1, '\u{e9}' (U+00E9), {letters}")),
        ("F", &[('F', "F"), ('X', "F+ F")], format!("rule [1]: character 3, ' ' (U+0020), {letters}")),
        ("F[+F", &[], "axiom: character 2, '[' (U+005B), is never closed".into()),
        ("[F]]", &[], "axiom: character 4, ']' (U+005D), closes no bracket".into()),
        ("F", &[('F', "]F[")], "rule [0]: character 1, ']' (U+005D), closes no bracket".into()),
        (
            "F",
            &[('+', "F")],
            "letter of rule [0]: character 1, '+' (U+002B), cannot be rewritten: a rule is for one of A to Z, a to z"
                .into(),
        ),
        (
            "F",
            &[('F', "F"), ('F', "FF")],
            "letter of rule [1]: character 1, 'F' (U+0046), has a rule already".into(),
        ),
    ] {
        assert_eq!(error(axiom, rules).to_string(), text);
    }
    // the same for the words of generators
    for (word, name) in [
        ("F+X", "character 3, 'X' (U+0058)"),
        ("F\u{2212}F", "character 2, '\u{2212}' (U+2212)"),
        ("FfF", "character 2, 'f' (U+0066)"),
        ("F+[F]", "character 3, '[' (U+005B)"),
    ] {
        let error = Generator::<4>::turtle(word, turn_over(4)).unwrap_err().to_string();
        let allowed = "is none of its letters: F A B a b + - (f, brackets and letters that only rewrite: in an L-system)";
        assert_eq!(error, format!("turtle word: {name}, {allowed}"));
    }
    let many: Vec<(char, &str)> = ('A'..='Z').take(MAX_RULES + 1).map(|letter| (letter, "F")).collect();
    assert!(matches!(error("F", &many), Error::Capacity { what: "rules", needed: 17, capacity: 16 }));
}

#[test]
fn room_is_asked_for_before_the_walk() {
    let lent = system("X", PLANT, 22.5);
    let refused = lent.path::<4, 20>(5).unwrap_err();
    assert_eq!(refused, Error::Capacity { what: "orders", needed: 5, capacity: 4 });
    // brackets: as many as are ever open at once, and no fewer
    for order in 1..=5 {
        let (needed, _) = demands(&rewritten("X", PLANT, order));
        assert_eq!(needed, 2 * order);
    }
    let refused = lent.path::<5, 9>(5).unwrap_err();
    assert_eq!(refused, Error::Capacity { what: "open brackets", needed: 10, capacity: 9 });
    assert!(lent.path::<5, 10>(5).is_ok());
    // growth without end, drawn or not
    for word in ["XX", "F[XX]XF", "X+X"] {
        let rules = [('X', word)];
        let turtle = system("X", &rules, 60.0).path::<40, 40>(40);
        let is_full = matches!(turtle, Err(Error::Capacity { what: "letters", .. }));
        assert!(is_full, "{word}");
    }
    const { assert!(MAX_LETTERS <= 1 << 28) };
}

#[test]
fn rules_that_draw_nothing_come_to_an_end() {
    for (axiom, rules) in [
        ("", &[][..]),
        ("X", &[('X', "")]),
        ("X", &[('X', "X")]),
        ("XY", &[('X', "Y"), ('Y', "X")]),
        ("F", &[('F', "")]),
        ("[[[]]]", &[]),
        ("X", &[('X', "[X]+[X]")]),
        ("ff", &[('f', "ff")]),
    ] {
        let mut turtle = system(axiom, rules, 60.0).path::<12, 24>(12).unwrap();
        assert!((0..3).all(|_| turtle.next().is_none()), "{axiom} {rules:?}");
    }
}

#[test]
fn a_turtle_takes_two_words_an_order_and_24_bytes_a_bracket() {
    // with pointers of 64 bits
    let size = size_of::<Turtle<'_, 12, 12>>();
    assert!(size <= 12 * 16 + 12 * 24 + 160, "{size}");
}

fn word() -> impl Strategy<Value = String> {
    prop::string::string_regex("[FGfXYA+|\\-\\[\\]]{0,8}").expect("a regular expression")
}

fn balanced() -> impl Strategy<Value = String> {
    let leaf = prop::string::string_regex("[FGfXYA+|\\-]{0,4}").expect("a regular expression");
    leaf.prop_recursive(3, 12, 3, |inner| {
        prop::collection::vec(inner, 0..3).prop_map(|parts| format!("[{}]F", parts.concat()))
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_words_are_drawn_as_written_down_or_refused(
        axiom in prop_oneof![word(), balanced()],
        x in prop_oneof![word(), balanced()],
        y in balanced(),
        f in prop_oneof![Just("F".to_owned()), word()],
        order in 0_u32..5,
        degrees in -1000.0..1000.0,
    ) {
        let rules = [('X', x.as_str()), ('Y', y.as_str()), ('f', f.as_str())];
        let is_balanced = |word: &str| {
            let open = word.chars().try_fold(0_u32, |open, letter| match letter {
                '[' => Some(open + 1),
                ']' => open.checked_sub(1),
                _ => Some(open),
            });
            open == Some(0)
        };
        let lent = LSystem::new(&axiom, &rules, Wide::from_num(degrees));
        prop_assert_eq!(lent.is_ok(), is_balanced(&axiom) && rules.iter().all(|rule| is_balanced(rule.1)));
        if let Ok(lent) = lent {
            let written = rewritten(&axiom, &rules, order);
            let (open, steps) = demands(&written);
            // brackets of rewritten words count, those of words that are gone do not
            match lent.path::<4, 6>(order) {
                Ok(turtle) => {
                    prop_assert!(open <= 6);
                    prop_assert_eq!(turtle.steps(), steps);
                    let step = turtle.step().to_num::<f64>();
                    let want = strokes(&written, Wide::from_num(degrees).to_num(), 0.0);
                    prop_assert!(difference(&drawn(turtle), &want) * step < BOUND);
                }
                Err(Error::Capacity { what, needed, .. }) => {
                    prop_assert_eq!((what, needed), ("open brackets", open as usize));
                }
                Err(other) => prop_assert!(false, "{}", other),
            }
        }
    }

    #[test]
    fn any_text_is_refused_or_a_word(axiom in any::<String>(), letter in any::<char>(), word in any::<String>()) {
        let rules = [(letter, word.as_str())];
        if let Ok(lent) = LSystem::new(&axiom, &rules, Wide::MIN) {
            let _ = lent.path::<3, 3>(3).map(Iterator::count);
        }
        if let Ok(generator) = Generator::<8>::turtle(&word, turn_over(5)) {
            prop_assert!(generator.len() >= 2);
        }
    }

    #[test]
    fn turtle_words_are_refused_or_generators(
        word in prop::string::string_regex("[FABab+\\-]{0,20}").expect("a regular expression"),
        parts in any::<u32>(),
    ) {
        if let Ok(generator) = Generator::<127>::turtle(&word, turn_over(parts)) {
            let base = attractor::curve::koch::SEGMENT;
            if let Ok(path) = generator.refined::<3>(&base, 3) {
                prop_assert!(path.take(2000).count() > 2);
            }
        }
    }
}
