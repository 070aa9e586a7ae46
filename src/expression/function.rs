//! The operations an expression can be made of, and the names people call them by.

/// An operation on one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unary {
    Negative,
    Not,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Log,
    Log10,
    Sqrt,
    Abs,
    Sign,
    Floor,
    Ceil,
    Round,
    Step,
    Square,
    Sawtooth,
    Ramp,
}

/// An operation on two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    NotEqual,
    And,
    Or,
    Atan2,
    Min,
    Max,
    Mod,
    Noise,
}

/// An operation on three numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ternary {
    If,
    Pulse,
}

/// Any operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operation {
    Unary(Unary),
    Binary(Binary),
    Ternary(Ternary),
}

impl Operation {
    /// How many numbers it takes from the stack.
    pub(super) fn arity(self) -> usize {
        match self {
            Self::Unary(_) => 1,
            Self::Binary(_) => 2,
            Self::Ternary(_) => 3,
        }
    }
}

/// A function with a name.
#[derive(Debug)]
pub(super) struct Function {
    pub(super) name: &'static str,
    pub(super) operation: Operation,
    /// How it is called, for messages.
    pub(super) usage: &'static str,
}

const fn one(name: &'static str, operation: Unary, usage: &'static str) -> Function {
    Function { name, operation: Operation::Unary(operation), usage }
}

const fn two(name: &'static str, operation: Binary, usage: &'static str) -> Function {
    Function { name, operation: Operation::Binary(operation), usage }
}

const fn three(name: &'static str, operation: Ternary, usage: &'static str) -> Function {
    Function { name, operation: Operation::Ternary(operation), usage }
}

/// All functions that have a name.
pub(super) const FUNCTIONS: [Function; 31] = [
    one("sin", Unary::Sin, "sin(x)"),
    one("cos", Unary::Cos, "cos(x)"),
    one("tan", Unary::Tan, "tan(x)"),
    one("asin", Unary::Asin, "asin(x)"),
    one("acos", Unary::Acos, "acos(x)"),
    one("atan", Unary::Atan, "atan(x)"),
    two("atan2", Binary::Atan2, "atan2(y, x)"),
    one("sinh", Unary::Sinh, "sinh(x)"),
    one("cosh", Unary::Cosh, "cosh(x)"),
    one("tanh", Unary::Tanh, "tanh(x)"),
    one("exp", Unary::Exp, "exp(x)"),
    one("log", Unary::Log, "log(x), the natural logarithm"),
    one("ln", Unary::Log, "ln(x)"),
    one("log10", Unary::Log10, "log10(x)"),
    one("sqrt", Unary::Sqrt, "sqrt(x)"),
    one("abs", Unary::Abs, "abs(x)"),
    one("sign", Unary::Sign, "sign(x)"),
    one("floor", Unary::Floor, "floor(x)"),
    one("ceil", Unary::Ceil, "ceil(x)"),
    one("round", Unary::Round, "round(x)"),
    two("min", Binary::Min, "min(x, y)"),
    two("max", Binary::Max, "max(x, y)"),
    two("pow", Binary::Power, "pow(x, y)"),
    two("mod", Binary::Mod, "mod(x, y)"),
    three("if", Ternary::If, "if(condition, a, b)"),
    one("step", Unary::Step, "step(x), 0 for x < 0 and 1 from 0 on"),
    one("square", Unary::Square, "square(x), the sign of sin(x)"),
    one("sawtooth", Unary::Sawtooth, "sawtooth(x), from -1 to 1 with period 2*pi"),
    three("pulse", Ternary::Pulse, "pulse(t, start, stop), 1 for start <= t < stop"),
    one("ramp", Unary::Ramp, "ramp(x), the larger of x and 0"),
    two("noise", Binary::Noise, "noise(x, seed)"),
];

/// The function of that name.
pub(super) fn function(name: &str) -> Option<&'static Function> {
    FUNCTIONS.iter().find(|function| function.name == name)
}
