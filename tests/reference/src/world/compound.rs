//! Compound objects: Boolean functions of the states of leaves, in reverse Polish notation.
//!
//! Source: course unit V, section 5.10.

/// A step of a program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Step {
    /// The state of a leaf.
    Leaf(usize),
    /// Of the last two values: in one of them, or in both.
    Union,
    /// In both.
    Intersection,
    /// In the first and not in the second.
    Difference,
}

/// A Boolean function.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Program(pub Vec<Step>);

impl Program {
    /// The object that is one leaf.
    pub fn leaf(leaf: usize) -> Program {
        Program(vec![Step::Leaf(leaf)])
    }

    /// In one of the two objects, or in both.
    pub fn union(self, other: Program) -> Program {
        self.joined(other, Step::Union)
    }

    /// In both objects.
    pub fn intersection(self, other: Program) -> Program {
        self.joined(other, Step::Intersection)
    }

    /// In this object and not in the other.
    pub fn difference(self, other: Program) -> Program {
        self.joined(other, Step::Difference)
    }

    fn joined(mut self, other: Program, step: Step) -> Program {
        self.0.extend(other.0);
        self.0.push(step);
        self
    }

    /// The leaves that it names.
    pub fn leaves(&self) -> impl Iterator<Item = usize> + '_ {
        self.0.iter().filter_map(|step| match step {
            Step::Leaf(leaf) => Some(*leaf),
            _ => None,
        })
    }

    /// The value for the given states, of all leaves of a world.
    ///
    /// # Panics
    /// When a step lacks an operand, or more than one value is left.
    pub fn inside(&self, states: &[bool]) -> bool {
        let mut stack = Vec::new();
        for step in &self.0 {
            if let Step::Leaf(leaf) = step {
                stack.push(states[*leaf]);
                continue;
            }
            let (b, a) = (stack.pop().expect("two operands"), stack.pop().expect("two operands"));
            stack.push(match step {
                Step::Union => a || b,
                Step::Intersection => a && b,
                Step::Difference => a && !b,
                Step::Leaf(_) => unreachable!("it was pushed"),
            });
        }
        assert_eq!(stack.len(), 1, "a program leaves one value");
        stack[0]
    }
}

#[cfg(test)]
mod tests {
    use super::Program;

    #[test]
    fn the_bowl_is_in_the_globe_and_in_neither_of_the_others() {
        let bowl = Program::leaf(0).difference(Program::leaf(1)).difference(Program::leaf(2));
        for bits in 0..8 {
            let states = [bits & 1 != 0, bits & 2 != 0, bits & 4 != 0];
            assert_eq!(bowl.inside(&states), bits == 1);
        }
        assert_eq!(bowl.leaves().collect::<Vec<_>>(), [0, 1, 2]);
    }

    #[test]
    fn union_and_intersection_are_or_and_and() {
        let (a, b) = (Program::leaf(0), Program::leaf(1));
        for states in [[false, false], [false, true], [true, false], [true, true]] {
            assert_eq!(a.clone().union(b.clone()).inside(&states), states[0] | states[1]);
            assert_eq!(a.clone().intersection(b.clone()).inside(&states), states[0] & states[1]);
        }
    }
}
