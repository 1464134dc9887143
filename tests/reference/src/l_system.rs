//! L-systems with brackets: the word is written down and then drawn.
//!
//! Source: P. Prusinkiewicz and A. Lindenmayer, "The Algorithmic Beauty of Plants", 1990, sections 1.2, 1.3
//! and 1.6.1.

/// The word after `order` rewritings: each letter that has a rule becomes its word, the others stay.
pub fn rewritten(axiom: &str, rules: &[(char, &str)], order: u32) -> String {
    let mut word = axiom.to_owned();
    for _ in 0..order {
        word = word
            .chars()
            .map(|letter| match rules.iter().find(|rule| rule.0 == letter) {
                Some(rule) => rule.1.to_owned(),
                None => letter.to_string(),
            })
            .collect();
    }
    word
}

/// The strokes that a turtle draws, each a polyline of at least two points; steps of length 1 from the
/// origin, angles in degrees.
pub fn strokes(word: &str, degrees: f64, heading: f64) -> Vec<Vec<(f64, f64)>> {
    let (mut x, mut y, mut turns, mut rounds) = (0.0, 0.0, 0_i64, 0_i64);
    let mut remembered = Vec::new();
    let mut strokes: Vec<Vec<(f64, f64)>> = Vec::new();
    let mut is_drawing = false;
    for letter in word.chars() {
        match letter {
            'F' | 'G' | 'f' => {
                // whole numbers of turns, so that they do not add up any error
                let direction = (heading + turns as f64 * degrees + rounds as f64 * 180.0) % 360.0;
                let from = (x, y);
                x += libm::cos(direction.to_radians());
                y += libm::sin(direction.to_radians());
                if letter == 'f' {
                    is_drawing = false;
                } else if is_drawing {
                    strokes.last_mut().expect("a stroke has begun").push((x, y));
                } else {
                    strokes.push(vec![from, (x, y)]);
                    is_drawing = true;
                }
            }
            '+' => turns += 1,
            '-' => turns -= 1,
            '|' => rounds += 1,
            '[' => remembered.push((x, y, turns, rounds)),
            ']' => {
                (x, y, turns, rounds) = remembered.pop().expect("brackets are balanced");
                is_drawing = false;
            }
            _ => {}
        }
    }
    strokes
}

/// The most brackets open at once, the most letters of `F`, `G` and `f`.
pub fn demands(word: &str) -> (u32, u32) {
    let (mut open, mut most, mut steps) = (0_u32, 0, 0);
    for letter in word.chars() {
        match letter {
            '[' => open += 1,
            ']' => open -= 1,
            'F' | 'G' | 'f' => steps += 1,
            _ => {}
        }
        most = most.max(open);
    }
    (most, steps)
}
