//! Formulas for curvature, such as `sign(s)*abs(s)^1.5`, with exact derivatives.

use std::fmt;

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
        /// Nobody writes longer ones.
        const LONGEST: usize = 1000;
        let characters: Vec<char> = text.chars().collect();
        let mut reader = Reader { text: &characters, at: 0, depth: 0 };
        if characters.len() > LONGEST {
            return Err(reader.error(format!("it is longer than {LONGEST} characters")));
        }
        let expression = reader.sum()?;
        match reader.peek() {
            None => Ok(Formula { expression }),
            Some(')') => Err(reader.error(format!("`)` at {} was never opened", reader.place()))),
            Some(_) => Err(reader.unexpected("an operator")),
        }
    }
}

/// A recursive descent through sums, products, signs, powers and atoms.
struct Reader<'a> {
    text: &'a [char],
    at: usize,
    depth: usize,
}

impl Reader<'_> {
    fn peek(&mut self) -> Option<char> {
        while self.text.get(self.at).is_some_and(|c| c.is_whitespace()) {
            self.at += 1;
        }
        self.text.get(self.at).copied()
    }

    fn place(&self) -> String {
        format!("character {}", self.at + 1)
    }

    fn error(&self, what: String) -> FormulaError {
        FormulaError { at: self.at + 1, what }
    }

    fn unexpected(&mut self, wanted: &str) -> FormulaError {
        match self.peek() {
            Some(c) => {
                let c = if c.is_control() { '\u{fffd}' } else { c };
                self.error(format!("`{c}` at {} stands where {wanted} should", self.place()))
            }
            None => self.error(format!("it ends where {wanted} should stand")),
        }
    }

    /// The next character, if it is one of these.
    fn take(&mut self, wanted: &[char]) -> Option<char> {
        let c = self.peek().filter(|c| wanted.contains(c))?;
        self.at += 1;
        Some(c)
    }

    fn sum(&mut self) -> Result<Expression, FormulaError> {
        let mut left = self.product()?;
        while let Some(operator) = self.take(&['+', '-']) {
            left = Expression::Binary(operator, Box::new([left, self.product()?]));
        }
        Ok(left)
    }

    fn product(&mut self) -> Result<Expression, FormulaError> {
        let mut left = self.signed()?;
        while let Some(operator) = self.take(&['*', '/']) {
            left = Expression::Binary(operator, Box::new([left, self.signed()?]));
        }
        Ok(left)
    }

    /// Signs, and what they stand before; every way into depth passes here.
    fn signed(&mut self) -> Result<Expression, FormulaError> {
        /// Deeper nesting might leave the stack.
        const DEEPEST: usize = 100;
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(self.error(format!("it is nested too deeply at {}", self.place())));
        }
        let expression = match self.take(&['+', '-']) {
            Some('-') => Expression::Negative(Box::new(self.signed()?)),
            Some(_) => self.signed()?,
            None => self.power()?,
        };
        self.depth -= 1;
        Ok(expression)
    }

    fn power(&mut self) -> Result<Expression, FormulaError> {
        let base = self.atom()?;
        match self.take(&['^']) {
            Some(_) => Ok(Expression::Binary('^', Box::new([base, self.signed()?]))),
            None => Ok(base),
        }
    }

    fn atom(&mut self) -> Result<Expression, FormulaError> {
        match self.peek() {
            Some('(') => self.parenthesis(),
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(),
            Some(c) if c.is_alphabetic() => self.name(),
            _ => Err(self.unexpected("a number, `s`, a function or `(`")),
        }
    }

    fn parenthesis(&mut self) -> Result<Expression, FormulaError> {
        if self.take(&['(']).is_none() {
            return Err(self.unexpected("`(`"));
        }
        let inner = self.sum()?;
        if self.take(&[')']).is_none() {
            return Err(self.unexpected("`)` or an operator"));
        }
        Ok(inner)
    }

    fn number(&mut self) -> Result<Expression, FormulaError> {
        let start = self.at;
        let mut end = start;
        let digits = |mut i: usize| {
            while self.text.get(i).is_some_and(|c| c.is_ascii_digit() || *c == '.') {
                i += 1;
            }
            i
        };
        end = digits(end);
        if self.text.get(end).is_some_and(|c| matches!(c, 'e' | 'E')) {
            let signed = self.text.get(end + 1).is_some_and(|c| matches!(c, '+' | '-'));
            let exponent = end + 1 + usize::from(signed);
            if self.text.get(exponent).is_some_and(char::is_ascii_digit) {
                end = digits(exponent);
            }
        }
        let text: String = self.text[start..end].iter().collect();
        match text.parse::<f64>() {
            Ok(number) if number.is_finite() => {
                self.at = end;
                Ok(Expression::Number(number))
            }
            _ => Err(self.error(format!("`{text}` at {} isn't a number", self.place()))),
        }
    }

    fn name(&mut self) -> Result<Expression, FormulaError> {
        let start = self.at;
        let is_part = |c: &&char| c.is_alphanumeric() || **c == '_';
        let name: String = self.text[start..].iter().take_while(is_part).collect();
        let after = start + name.chars().count();
        let known = match name.as_str() {
            "s" => Some(Expression::S),
            "pi" => Some(Expression::Number(std::f64::consts::PI)),
            "e" => Some(Expression::Number(std::f64::consts::E)),
            _ => None,
        };
        if let Some(known) = known {
            self.at = after;
            return Ok(known);
        }
        let Some(function) = FUNCTIONS.into_iter().find(|known| *known == name) else {
            return Err(self.error(format!("`{name}` at {} isn't known", self.place())));
        };
        self.at = after;
        Ok(Expression::Function(function, Box::new(self.parenthesis()?)))
    }
}
