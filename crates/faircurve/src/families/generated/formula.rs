//! Formulas for curvature, such as `sign(s)*abs(s)^1.5`, with exact derivatives.

use std::fmt;

use winnow::ascii::{float, multispace0};
use winnow::combinator::{
    Infix, Prefix, cut_err, delimited, dispatch, expression, fail, peek, preceded,
};
use winnow::error::ContextError;
use winnow::token::{any, take_while};
use winnow::{ModalResult, Parser};

/// Curvature as a function of arc length `s`, read from text.
///
/// Numbers, `s`, `pi`, `e`, `+ - * / ^`, parentheses and the functions of [`FUNCTIONS`]. `^` binds
/// to the right and tighter than a sign before it: `-s^2` is −(s²), `2^3^2` is 2⁹.
///
/// ```
/// use faircurve::families::generated::Formula;
/// let formula: Formula = "sign(s)*abs(s)^1.5".parse()?;
/// assert_eq!(formula.value(-4.0), -8.0);
/// let error = "s + sgn(s)".parse::<Formula>().unwrap_err();
/// assert_eq!(error.to_string(), "`sgn` at character 5 isn't known");
/// # Ok::<(), faircurve::families::generated::FormulaError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    expression: Expression,
}

/// The functions known.
pub const FUNCTIONS: [&str; 13] = [
    "abs", "sign", "sqrt", "exp", "log", "ln", "sin", "cos", "tan", "sinh", "cosh", "tanh", "atan",
];

/// Why a text isn't a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FormulaError {
    /// The character at fault, counted from 1; one past the last where something is missing.
    pub at: usize,
    /// What is wrong, in words that follow a place.
    what: String,
}

impl fmt::Display for FormulaError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.what)
    }
}

impl std::error::Error for FormulaError {}

impl FormulaError {
    /// What a formula may consist of.
    pub fn hint() -> String {
        format!("numbers, `s`, `pi`, `e`, `+ - * / ^ ( )` and the functions {}", {
            FUNCTIONS.map(|name| format!("`{name}`")).join(", ")
        })
    }
}

/// The value and the Taylor coefficients of first to third order.
type Series = [f64; 4];

#[derive(Clone, Debug, PartialEq)]
enum Expression {
    Number(f64),
    S,
    Negative(Box<Expression>),
    Function(&'static str, Box<Expression>),
    Binary(char, Box<[Expression; 2]>),
}

impl Formula {
    /// Curvature at `s`; perhaps not a number.
    pub fn value(&self, s: f64) -> f64 {
        self.expression.value(s)
    }

    /// Curvature at `s` and its first three derivatives.
    pub fn jet(&self, s: f64) -> [f64; 4] {
        let [value, first, second, third] = self.expression.series(s);
        [value, first, 2.0 * second, 6.0 * third]
    }
}

impl Expression {
    fn value(&self, s: f64) -> f64 {
        match self {
            Expression::Number(number) => *number,
            Expression::S => s,
            Expression::Negative(inner) => -inner.value(s),
            Expression::Function(name, inner) => {
                let x = inner.value(s);
                match *name {
                    "abs" => x.abs(),
                    "sign" => sign(x),
                    "sqrt" => x.sqrt(),
                    "exp" => x.exp(),
                    "sin" => x.sin(),
                    "cos" => x.cos(),
                    "tan" => x.tan(),
                    "sinh" => x.sinh(),
                    "cosh" => x.cosh(),
                    "tanh" => x.tanh(),
                    "atan" => x.atan(),
                    _ => x.ln(),
                }
            }
            Expression::Binary(operator, sides) => {
                let [a, b] = [&sides[0], &sides[1]].map(|side| side.value(s));
                match operator {
                    '+' => a + b,
                    '-' => a - b,
                    '*' => a * b,
                    '/' => a / b,
                    _ => a.powf(b),
                }
            }
        }
    }

    fn series(&self, s: f64) -> Series {
        match self {
            Expression::Number(number) => [*number, 0.0, 0.0, 0.0],
            Expression::S => [s, 1.0, 0.0, 0.0],
            Expression::Negative(inner) => inner.series(s).map(|c| -c),
            Expression::Function(name, inner) => {
                let inner = inner.series(s);
                compose(function_series(name, inner[0]), inner)
            }
            Expression::Binary(operator, sides) => {
                let [a, b] = [&sides[0], &sides[1]].map(|side| side.series(s));
                match operator {
                    '+' => std::array::from_fn(|i| a[i] + b[i]),
                    '-' => std::array::from_fn(|i| a[i] - b[i]),
                    '*' => product(a, b),
                    '/' => product(a, compose(power_series(b[0], -1.0), b)),
                    _ if b[1..] == [0.0; 3] => compose(power_series(a[0], b[0]), a),
                    _ => {
                        let exponent = product(b, compose(function_series("log", a[0]), a));
                        compose(function_series("exp", exponent[0]), exponent)
                    }
                }
            }
        }
    }
}

/// −1, 0 or 1.
fn sign(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.signum() }
}

fn product(a: Series, b: Series) -> Series {
    std::array::from_fn(|n| (0..=n).map(|i| a[i] * b[n - i]).sum())
}

/// f(g(s)) from the series of f about g(s).
fn compose(f: Series, g: Series) -> Series {
    let [_, a, b, c] = g;
    [f[0], f[1] * a, f[1] * b + f[2] * a * a, f[1] * c + 2.0 * f[2] * a * b + f[3] * a * a * a]
}

/// xᵖ.
fn power_series(x: f64, p: f64) -> Series {
    let mut factor = 1.0;
    std::array::from_fn(|n| {
        let n = n as f64;
        let term = if factor == 0.0 { 0.0 } else { factor * x.powf(p - n) };
        factor *= (p - n) / (n + 1.0);
        term
    })
}

fn function_series(name: &str, x: f64) -> Series {
    let (sin, cos) = x.sin_cos();
    match name {
        "abs" => [x.abs(), sign(x), 0.0, 0.0],
        "sign" => [sign(x), 0.0, 0.0, 0.0],
        "sqrt" => power_series(x, 0.5),
        "exp" => [1.0, 1.0, 0.5, 1.0 / 6.0].map(|c| c * x.exp()),
        "sin" => [sin, cos, -sin / 2.0, -cos / 6.0],
        "cos" => [cos, -sin, -cos / 2.0, sin / 6.0],
        "sinh" => [x.sinh(), x.cosh(), x.sinh() / 2.0, x.cosh() / 6.0],
        "cosh" => [x.cosh(), x.sinh(), x.cosh() / 2.0, x.sinh() / 6.0],
        "tan" => {
            let t = x.tan();
            let slope = 1.0 + t * t;
            [t, slope, t * slope, slope * (1.0 + 3.0 * t * t) / 3.0]
        }
        "tanh" => {
            let t = x.tanh();
            let slope = 1.0 - t * t;
            [t, slope, -t * slope, slope * (3.0 * t * t - 1.0) / 3.0]
        }
        "atan" => {
            let d = 1.0 / (1.0 + x * x);
            [x.atan(), d, -x * d * d, (3.0 * x * x - 1.0) * d * d * d / 3.0]
        }
        _ => [x.ln(), 1.0 / x, -0.5 / (x * x), 1.0 / (3.0 * x * x * x)],
    }
}

impl std::str::FromStr for Formula {
    type Err = FormulaError;

    fn from_str(text: &str) -> Result<Self, FormulaError> {
        /// Nobody writes longer ones, and nothing that is nested in so few leaves the stack.
        const LONGEST: usize = 500;
        if let Some((at, _)) = text.char_indices().nth(LONGEST) {
            return Err(FormulaError::new(text, at, |_| {
                format!("it is longer than {LONGEST} characters")
            }));
        }
        match sum.parse(text) {
            Ok(expression) => Ok(Formula { expression }),
            Err(error) => Err(FormulaError::at(text, error.offset(), error.inner())),
        }
    }
}

impl FormulaError {
    fn new(text: &str, offset: usize, what: impl FnOnce(&str) -> String) -> Self {
        let at = text[..offset].chars().count() + 1;
        FormulaError { at, what: what(&format!("at character {at}")) }
    }

    /// What is wrong where a rule of the grammar met something else.
    fn at(text: &str, offset: usize, error: &ContextError<Wanted>) -> Self {
        // Where nothing was wanted, the formula was whole.
        let wanted = error.context().next().copied().unwrap_or(Wanted("an operator"));
        let rest = &text[offset..];
        FormulaError::new(text, offset, |place| match rest.chars().next() {
            None => format!("it ends where {wanted} should stand"),
            Some(')') if wanted == Wanted("an operator") => format!("`)` {place} was never opened"),
            Some(c) if wanted == OPERAND && c.is_alphabetic() => {
                let name: String = rest.chars().take_while(|c| is_part_of_name(*c)).collect();
                format!("`{name}` {place} isn't known")
            }
            Some(c) if wanted == OPERAND && c.is_ascii_digit() => {
                let is_part = |c: &char| c.is_ascii_alphanumeric() || *c == '.';
                let number: String = rest.chars().take_while(is_part).collect();
                format!("`{number}` {place} isn't a number")
            }
            Some(c) => {
                let c = if c.is_control() { '\u{fffd}' } else { c };
                format!("`{c}` {place} stands where {wanted} should")
            }
        })
    }
}

/// What the grammar wants where it meets something else.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Wanted(&'static str);

impl fmt::Display for Wanted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }
}

const OPERAND: Wanted = Wanted("a number, `s`, a function or `(`");

type Parsed<T> = ModalResult<T, ContextError<Wanted>>;

/// The grammar: operators and how tightly each binds. A sign stands between products and powers.
fn sum(input: &mut &str) -> Parsed<Expression> {
    expression(delimited(multispace0, operand, multispace0))
        .prefix(preceded(
            multispace0,
            dispatch! {peek(any);
                '+' => any.value(Prefix(3, |_: &mut _, a| Ok(a))),
                '-' => any.value(Prefix(3, |_: &mut _, a| Ok(Expression::Negative(Box::new(a))))),
                _ => fail,
            }
            .context(OPERAND),
        ))
        .infix(dispatch! {peek(any);
            '+' => any.value(Infix::Left(1, |_: &mut _, a, b| Ok(binary('+', a, b)))),
            '-' => any.value(Infix::Left(1, |_: &mut _, a, b| Ok(binary('-', a, b)))),
            '*' => any.value(Infix::Left(2, |_: &mut _, a, b| Ok(binary('*', a, b)))),
            '/' => any.value(Infix::Left(2, |_: &mut _, a, b| Ok(binary('/', a, b)))),
            '^' => any.value(Infix::Right(4, |_: &mut _, a, b| Ok(binary('^', a, b)))),
            _ => fail,
        })
        .parse_next(input)
}

fn binary(operator: char, left: Expression, right: Expression) -> Expression {
    Expression::Binary(operator, Box::new([left, right]))
}

fn operand(input: &mut &str) -> Parsed<Expression> {
    dispatch! {peek(any);
        '(' => parenthesis,
        '0'..='9' | '.' => cut_err(number),
        c if is_part_of_name(c) => cut_err(name),
        _ => fail,
    }
    .context(OPERAND)
    .parse_next(input)
}

fn parenthesis(input: &mut &str) -> Parsed<Expression> {
    delimited(
        '('.context(Wanted("`(`")),
        cut_err(sum),
        cut_err(')').context(Wanted("`)` or an operator")),
    )
    .parse_next(input)
}

fn number(input: &mut &str) -> Parsed<Expression> {
    float.verify(|number: &f64| number.is_finite()).map(Expression::Number).parse_next(input)
}

fn is_part_of_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// A variable, a constant, or a function of what stands in parentheses after it.
fn name(input: &mut &str) -> Parsed<Expression> {
    let mut known = take_while(1.., is_part_of_name).verify_map(|name: &str| match name {
        "s" => Some(Known::Value(Expression::S)),
        "pi" => Some(Known::Value(Expression::Number(std::f64::consts::PI))),
        "e" => Some(Known::Value(Expression::Number(std::f64::consts::E))),
        _ => FUNCTIONS.into_iter().find(|known| *known == name).map(Known::Function),
    });
    match known.parse_next(input)? {
        Known::Value(value) => Ok(value),
        Known::Function(function) => preceded(multispace0, parenthesis)
            .map(|inner| Expression::Function(function, Box::new(inner)))
            .parse_next(input),
    }
}

enum Known {
    Value(Expression),
    Function(&'static str),
}
