//! Operator precedence parsing, straight to a stack program.

use super::function::{Binary, Function, Operation, Unary, function};
use super::program::{Instruction, LARGE_STACK, Program};
use super::suggest::suggestion;
use super::token::{Kind, Operator, Token, tokens};
use super::{ExpressionError, ExpressionProblem, MAX_DEPTH, MAX_OPERATIONS};

type Parsing<T> = Result<T, ExpressionError>;

/// Binding power of signs: below `^`, above `*`.
const SIGN: u8 = 11;
/// Binding power of `^`.
const POWER: u8 = 13;

/// Compiles a text in the given variables.
pub(super) fn parse(text: &str, variables: &[&str]) -> Parsing<Program> {
    let characters: Vec<char> = text.chars().collect();
    let tokens = tokens(&characters)?;
    let mut parser = Parser {
        characters: &characters,
        tokens,
        next: 0,
        depth: 0,
        operations: 0,
        variables,
        program: Program::default(),
    };
    if parser.kind() == &Kind::End {
        return Err(ExpressionError { position: 0, problem: ExpressionProblem::Empty });
    }
    parser.expression(0)?;
    match parser.kind() {
        Kind::End => Ok(parser.program),
        Kind::Comma => Err(parser.error(ExpressionProblem::Comma { hint: parser.decimal_hint() })),
        _ => Err(parser.unexpected("an operator or the end of the text")),
    }
}

struct Parser<'a> {
    characters: &'a [char],
    tokens: Vec<Token>,
    next: usize,
    depth: usize,
    operations: usize,
    variables: &'a [&'a str],
    program: Program,
}

impl Parser<'_> {
    /// An operand and everything after it that binds at least as tightly as `minimum`.
    fn expression(&mut self, minimum: u8) -> Parsing<()> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err(self.error(ExpressionProblem::TooDeep));
        }
        self.operand()?;
        while let Some((operation, power)) = self.infix()?
            && power >= minimum
        {
            self.next += 1;
            let signed =
                matches!(self.kind(), Kind::Operator(Operator::Minus | Operator::Plus | Operator::Not));
            self.expression(if power == POWER && signed { SIGN } else { power + 1 })?;
            self.emit(Operation::Binary(operation))?;
        }
        self.depth -= 1;
        Ok(())
    }

    fn operand(&mut self) -> Parsing<()> {
        let kind = self.kind().clone();
        match kind {
            Kind::Number(value) => self.leaf(Instruction::Constant(value)),
            Kind::Name(name) => self.name(&name),
            Kind::Operator(Operator::Plus) => {
                self.next += 1;
                self.expression(SIGN)
            }
            Kind::Operator(Operator::Minus) => {
                self.next += 1;
                self.expression(SIGN)?;
                self.emit(Operation::Unary(Unary::Negative))
            }
            Kind::Operator(Operator::Not) => {
                self.next += 1;
                self.expression(SIGN)?;
                self.emit(Operation::Unary(Unary::Not))
            }
            Kind::Open => {
                self.next += 1;
                self.expression(0)?;
                self.close()
            }
            Kind::Operator(Operator::Times) if self.previous_is(Operator::Times) => {
                let problem =
                    ExpressionProblem::Character { found: "**".to_owned(), hint: "; the power is written ^" };
                Err(ExpressionError { position: self.tokens[self.next - 1].start, problem })
            }
            Kind::Operator(_) | Kind::Close | Kind::Comma | Kind::End => {
                Err(self.unexpected("a number, a name or `(`"))
            }
        }
    }

    /// A variable, `pi`, or a call.
    fn name(&mut self, name: &str) -> Parsing<()> {
        let called = self.tokens.get(self.next + 1).is_some_and(|token| token.kind == Kind::Open);
        let variable = self.variables.iter().position(|known| *known == name);
        match (variable, function(name)) {
            (_, Some(function)) if called => self.call(function),
            (Some(index), _) => self.leaf(Instruction::Variable(index)),
            (None, Some(function)) => {
                Err(self.error(ExpressionProblem::NoArguments { name: function.name, usage: function.usage }))
            }
            (None, None) if name.eq_ignore_ascii_case("pi") => {
                self.leaf(Instruction::Constant(std::f64::consts::PI))
            }
            (None, None) => Err(self.error(ExpressionProblem::UnknownName {
                name: name.to_owned(),
                hint: suggestion(name, self.variables),
            })),
        }
    }

    fn call(&mut self, function: &Function) -> Parsing<()> {
        let place = self.tokens[self.next].start;
        self.next += 2;
        let mut found = 0;
        if self.kind() != &Kind::Close {
            self.expression(0)?;
            found = 1;
            while self.kind() == &Kind::Comma {
                self.next += 1;
                self.expression(0)?;
                found += 1;
            }
        }
        self.close()?;
        let needed = function.operation.arity();
        if found == needed {
            return self.emit(function.operation);
        }
        let problem =
            ExpressionProblem::ArgumentCount { name: function.name, needed, found, usage: function.usage };
        Err(ExpressionError { position: place, problem })
    }

    /// The operator after an operand and how tightly it binds; `None` where the expression ends.
    fn infix(&self) -> Parsing<Option<(Binary, u8)>> {
        let operator = match self.kind() {
            Kind::Operator(operator) => *operator,
            Kind::Close | Kind::Comma | Kind::End => return Ok(None),
            Kind::Number(_) | Kind::Name(_) | Kind::Open => return Err(self.implicit_product()),
        };
        Ok(Some(match operator {
            Operator::Or => (Binary::Or, 1),
            Operator::And => (Binary::And, 3),
            Operator::Less => (Binary::Less, 5),
            Operator::LessEqual => (Binary::LessEqual, 5),
            Operator::Greater => (Binary::Greater, 5),
            Operator::GreaterEqual => (Binary::GreaterEqual, 5),
            Operator::Equal => (Binary::Equal, 5),
            Operator::NotEqual => (Binary::NotEqual, 5),
            Operator::Plus => (Binary::Add, 7),
            Operator::Minus => (Binary::Subtract, 7),
            Operator::Times => (Binary::Multiply, 9),
            Operator::Divide => (Binary::Divide, 9),
            Operator::Power => (Binary::Power, POWER),
            Operator::Not => return Err(self.unexpected("an operator between two values")),
        }))
    }

    fn close(&mut self) -> Parsing<()> {
        if self.kind() != &Kind::Close {
            return Err(self.unexpected("`)`"));
        }
        self.next += 1;
        Ok(())
    }

    fn leaf(&mut self, instruction: Instruction) -> Parsing<()> {
        self.next += 1;
        self.program.push(instruction);
        if self.program.highest > LARGE_STACK {
            return Err(self.error(ExpressionProblem::TooDeep));
        }
        Ok(())
    }

    fn emit(&mut self, operation: Operation) -> Parsing<()> {
        self.operations += 1;
        if self.operations > MAX_OPERATIONS {
            return Err(self.error(ExpressionProblem::TooManyOperations));
        }
        self.program.push(Instruction::Operation(operation));
        Ok(())
    }

    fn kind(&self) -> &Kind {
        self.tokens.get(self.next).map_or(&Kind::End, |token| &token.kind)
    }

    fn previous_is(&self, operator: Operator) -> bool {
        self.next > 0 && self.tokens[self.next - 1].kind == Kind::Operator(operator)
    }

    fn error(&self, problem: ExpressionProblem) -> ExpressionError {
        let position = self.tokens.get(self.next).map_or(self.characters.len(), |token| token.start);
        ExpressionError { position, problem }
    }

    fn unexpected(&self, needed: &'static str) -> ExpressionError {
        let found = match self.kind() {
            Kind::End => "the end of the text".to_owned(),
            _ => format!("`{}`", self.text(self.next)),
        };
        self.error(ExpressionProblem::Unexpected { found, needed })
    }

    fn implicit_product(&self) -> ExpressionError {
        let left = self.next.checked_sub(1).map_or_else(String::new, |previous| self.text(previous));
        self.error(ExpressionProblem::ImplicitProduct { left, right: self.text(self.next) })
    }

    /// "; decimals are written with a point: 1.5" for `1,5`.
    fn decimal_hint(&self) -> String {
        let number =
            |index: usize| self.tokens.get(index).filter(|token| matches!(token.kind, Kind::Number(_)));
        match (self.next.checked_sub(1).and_then(number), number(self.next + 1)) {
            (Some(_), Some(_)) => {
                let (left, right) = (self.text(self.next - 1), self.text(self.next + 1));
                format!("; decimals are written with a point: {left}.{right}")
            }
            _ => "; only one expression is needed here".to_owned(),
        }
    }

    /// The characters of a token.
    fn text(&self, index: usize) -> String {
        self.tokens
            .get(index)
            .map_or_else(String::new, |token| self.characters[token.start..token.end].iter().collect())
    }
}
