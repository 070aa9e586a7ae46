//! Statements about expressions, each with the text a person would type.

use std::f64::consts::PI;

use super::*;

fn of(text: &str) -> f64 {
    Expression::parse(text, &[]).unwrap_or_else(|error| panic!("{text}: {error}")).value(&[])
}

fn message(text: &str) -> String {
    Expression::parse(text, &["t", "x1"]).unwrap_err().to_string()
}

#[test]
fn precedence_is_that_of_matlab() {
    for (text, value) in [
        ("-2^2", -4.0),
        ("2^-1", 0.5),
        ("2^3^2", 64.0),
        ("2^-1^2", 0.5),
        ("1-2-3", -4.0),
        ("8/4/2", 1.0),
        ("-1/4", -0.25),
        ("2*-3", -6.0),
        ("1e-3", 0.001),
        (".5e1", 5.0),
        ("2.*3", 6.0),
        ("2./4", 0.5),
        ("2.^3", 8.0),
        ("\u{2212}3 \u{b7} 2", -6.0),
        ("2*\u{3c0}", 2.0 * PI),
        ("PI", PI),
        ("Pi", PI),
        ("1 < 2", 1.0),
        ("2 <= 1", 0.0),
        ("1 + 1 == 2", 1.0),
        ("1 ~= 1", 0.0),
        ("1 != 2", 1.0),
        ("3 >= 3", 1.0),
        ("3 > 3", 0.0),
        ("1 | 0 & 0", 1.0),
        ("~0", 1.0),
        ("!3", 0.0),
        ("1 && 2", 1.0),
        ("0 || 0", 0.0),
        ("(1+2)*3", 9.0),
        ("+4", 4.0),
        ("--4", 4.0),
    ] {
        assert_eq!(of(text), value, "{text}");
    }
}

#[test]
fn every_function_has_its_value() {
    for (text, value) in [
        ("sin(1)", 1_f64.sin()),
        ("cos(1)", 1_f64.cos()),
        ("tan(1)", 1_f64.tan()),
        ("asin(0.5)", 0.5_f64.asin()),
        ("acos(0.5)", 0.5_f64.acos()),
        ("atan(2)", 2_f64.atan()),
        ("atan2(-1, -1)", -0.75 * PI),
        ("sinh(1)", 1_f64.sinh()),
        ("cosh(1)", 1_f64.cosh()),
        ("tanh(1)", 1_f64.tanh()),
        ("exp(1)", 1_f64.exp()),
        ("log(2)", 2_f64.ln()),
        ("ln(2)", 2_f64.ln()),
        ("log10(1000)", 3.0),
        ("sqrt(2)", 2_f64.sqrt()),
        ("abs(-3)", 3.0),
        ("sign(-3)", -1.0),
        ("sign(0)", 0.0),
        ("sign(2)", 1.0),
        ("floor(-1.5)", -2.0),
        ("ceil(1.2)", 2.0),
        ("round(2.5)", 3.0),
        ("min(1, 2)", 1.0),
        ("max(1, 2)", 2.0),
        ("pow(2, 0.5)", 2_f64.sqrt()),
        ("mod(5, 3)", 2.0),
        ("mod(-1, 3)", 2.0),
        ("mod(1, -3)", -2.0),
        ("mod(5, 0)", 5.0),
        ("mod(0.3, 0.1)", 0.0),
        ("if(1 < 2, 3, 1/0)", 3.0),
        ("if(0, 3, 4)", 4.0),
        ("step(-1e-300)", 0.0),
        ("step(0)", 1.0),
        ("square(0)", 1.0),
        ("square(pi)", -1.0),
        ("square(2*pi)", 1.0),
        ("square(-pi)", -1.0),
        ("square(-1)", -1.0),
        ("square(3)", 1.0),
        ("sawtooth(0)", -1.0),
        ("sawtooth(pi)", 0.0),
        ("sawtooth(2*pi)", -1.0),
        ("pulse(1, 1, 2)", 1.0),
        ("pulse(2, 1, 2)", 0.0),
        ("pulse(0.9, 1, 2)", 0.0),
        ("ramp(-1)", 0.0),
        ("ramp(2)", 2.0),
    ] {
        assert_eq!(of(text), value, "{text}");
    }
    assert_eq!(function::FUNCTIONS.len(), 31, "a new function needs its row above and below");
}

#[test]
fn a_square_wave_has_its_edges_at_all_multiples_of_half_a_period() {
    for k in -2000..2000 {
        let wanted = if k % 2 == 0 { 1.0 } else { -1.0 };
        assert_eq!(wave::square(f64::from(k) * PI), wanted, "edge {k}");
        assert_eq!(wave::square(2.0 * PI * (f64::from(k) * 0.5)), wanted, "2 pi t at half {k}");
    }
}

#[test]
fn derivatives_agree_with_finite_differences() {
    let texts = [
        "sin(x)*cos(y)",
        "tan(x)",
        "asin(x/3)",
        "acos(y/3)",
        "atan(x*y)",
        "atan2(x, y)",
        "sinh(x)-cosh(y)",
        "tanh(x*y)",
        "exp(-x)",
        "log(x)*ln(2+y)",
        "log10(x)",
        "sqrt(x+y^2)",
        "abs(y)",
        "sign(x)",
        "floor(x)",
        "ceil(x)+round(y)",
        "min(x, y)*max(x, y)",
        "pow(x, y)",
        "x^y",
        "x^3",
        "x^-2",
        "2^x",
        "x^2.5",
        "mod(x, 0.4)",
        "mod(5*x, y+3)",
        "if(x > y, x^2, y)",
        "if(x < y, x^2, y)",
        "step(x)*x",
        "square(x)*y",
        "sawtooth(3*x)",
        "pulse(x, 0, 2)*y",
        "ramp(x)+ramp(y)",
        "noise(3*x, 1)",
        "x/y",
        "-x",
        "~x + (x & y) + (x | y)",
        "x <= y",
        "3*x - 2*y + 1",
    ];
    let (at, towards, h) = ([1.37, -0.42], [0.8, -1.3], 1e-6);
    for text in texts {
        let f = Expression::parse(text, &["x", "y"]).expect("these are expressions");
        let (value, derivative) = f.dual(&at, &towards);
        assert!(value == f.value(&at), "{text}: one value");
        let moved = |s: f64| f.value(&[at[0] + s * towards[0], at[1] + s * towards[1]]);
        let difference = (moved(h) - moved(-h)) / (2.0 * h);
        let same = (derivative - difference).abs() <= 1e-7 * (1.0 + difference.abs());
        assert!(same || value.is_nan(), "{text}: {derivative} and {difference}");
        assert!(!value.is_nan() || text.contains("y)") || text == "x^y", "{text} has a value at {at:?}");
    }
}

#[test]
fn nothing_that_stands_still_is_moved_by_an_infinite_slope() {
    let root = Expression::parse("sqrt(x) + t", &["x", "t"]).unwrap();
    assert_eq!(root.dual(&[0.0, 2.0], &[0.0, 1.0]), (2.0, 1.0), "only t moves");
    let square = Expression::parse("x^2", &["x"]).unwrap();
    assert_eq!(square.dual(&[0.0], &[1.0]), (0.0, 0.0), "the vertex");
    assert_eq!(Expression::parse("abs(x)", &["x"]).unwrap().dual(&[0.0], &[1.0]), (0.0, 0.0), "the kink");
}

#[test]
fn errors_say_where_what_and_what_to_do() {
    for (text, parts) in [
        ("2t", "at character 2: there is no operator between `2` and `t`; for the product write 2*t"),
        ("3 (t)", "there is no operator between `3` and `(`"),
        ("sine(t)", "unknown name `sine`; did you mean `sin`?"),
        ("qsrt(t)", "did you mean `sqrt`?"),
        ("Sin(t)", "did you mean `sin`?"),
        ("heaviside(t)", "did you mean `step`?"),
        ("2*e", "unknown name `e`; write exp(1)"),
        ("y + 1", "the variables are t, x1"),
        ("1,5", "decimals are written with a point: 1.5"),
        ("sin t", "`sin` is a function and needs parentheses: sin(x)"),
        ("sin(1, 2)", "`sin` takes 1 argument, 2 found"),
        ("max(1)", "`max` takes 2 arguments, 1 found: max(x, y)"),
        ("sin()", "`sin` takes 1 argument, 0 found"),
        ("(1 + 2", "at character 7: found the end of the text, but `)` is needed"),
        ("1 + 2)", "found `)`"),
        ("1 +", "a number, a name or `(` is needed"),
        ("t = 2", "at character 3: unexpected `=`; equality is written =="),
        ("t**2", "at character 2: unexpected `**`; the power is written ^"),
        ("1.2.3", "`1.2.3` is not a number; it has more than one point"),
        ("1e999", "too large"),
        ("\u{b5} + 1", "unknown name"),
        ("t + $", "at character 5: unexpected `$`"),
        ("  ", "there is nothing here"),
        ("t\u{b2}", "^2"),
        ("[1 2]", "only one number is needed here"),
        ("t(2)", "for the product write t*("),
    ] {
        assert!(message(text).contains(parts), "{text}: {}", message(text));
    }
}

#[test]
fn limits_are_errors() {
    for (text, part) in [
        ("(".repeat(1900), "inside each other"),
        ("-".repeat(1900), "inside each other"),
        ("2^-".repeat(600), "inside each other"),
        ("(".repeat(5000), "the text has 5000 characters"),
        ("-".repeat(5000), "the text has 5000 characters"),
        (format!("{}1", "1+".repeat(600)), "more than 500 operations"),
    ] {
        assert!(message(&text).contains(part), "{}", message(&text));
    }
    let deep = format!("{}t{}", "if(t<1+2*t^2,1,".repeat(55), ")".repeat(55));
    assert!(Expression::parse(&deep, &["t"]).is_ok_and(|f| f.value(&[1e9]) == 1.0), "fifty levels are read");
}

#[test]
fn constants_are_finite() {
    for (text, value) in [("-1/3", -1.0 / 3.0), ("1e-3", 1e-3), ("sqrt(2)", 2_f64.sqrt()), ("2*pi", 2.0 * PI)]
    {
        assert_eq!(constant(text), Ok(value), "{text}");
    }
    let said = |text: &str| constant(text).unwrap_err().to_string();
    assert_eq!(said("1/0"), "1/0 is infinite; a finite number is needed", "infinite");
    assert_eq!(said("0/0"), "0/0 is not a number; a finite number is needed", "not a number");
    assert!(said("t").contains("write a number, such as"), "{}", said("t"));
}

#[test]
fn helpers_know_what_occurs() {
    let f = Expression::parse("2*pi*x + 0*t", &["t", "x", "y"]).unwrap();
    assert!(f.uses("x") && !f.uses("y") && !f.uses("z") && !f.is_constant(), "x occurs, y does not");
    let zero = Expression::parse("1 - 1", &["t"]).unwrap();
    assert!(zero.is_zero() && zero.is_constant(), "1 - 1 is zero");
    assert_eq!(f, f.clone(), "a clone is equal");
    assert_ne!(zero, Expression::parse("0", &["t"]).unwrap(), "equality is that of texts");
    assert!(f.value(&[]).is_nan(), "missing values are not zero");
}

#[test]
fn noise_is_the_same_everywhere_and_linear_between_samples() {
    let noise = Expression::parse("noise(x, 42)", &["x"]).unwrap();
    let (a, b) = (noise.value(&[3.0]), noise.value(&[4.0]));
    assert!((noise.value(&[3.25]) - (0.75 * a + 0.25 * b)).abs() < 1e-15, "a quarter of the way");
    assert_eq!(noise.dual(&[3.25], &[1.0]).1, b - a, "the slope");
    assert_ne!(a, of("noise(3, 43)"), "another seed, another noise");
    assert_eq!(of("noise(0, 0)"), of("noise(-0, -0)"), "one zero");
    let bits: Vec<u64> = [0.0, 1.0, -7.0].iter().map(|x| noise.value(&[*x]).to_bits()).collect();
    assert_eq!(
        bits,
        [13_832_344_246_728_065_686, 4_604_678_378_975_058_098, 13_830_699_590_237_050_613],
        "these bits are the format: a document shows the same noise for ever"
    );
}

#[test]
fn jumps_are_found_to_full_precision() {
    let jumps = |text: &str, from: f64, to: f64| Expression::parse(text, &["t"]).unwrap().jumps(from, to);
    assert!(jumps("5 + 2*sin(4*t)", 0.0, 10.0).is_empty(), "smooth");
    assert!(jumps("max(t, 1) + abs(t-2) + noise(t, 1)", 0.0, 10.0).is_empty(), "kinks are no jumps");
    assert_eq!(jumps("step(t-3)", 0.0, 10.0), [3.0], "one step");
    assert_eq!(jumps("step(t-1/3)", 0.0, 10.0), [1.0 / 3.0], "a step between the decimals");
    assert!(jumps("step(t)", 0.0, 10.0).is_empty(), "a step at the beginning has happened");
    assert_eq!(jumps("step(t)", -1.0, 1.0), [0.0], "a step at zero");
    assert_eq!(jumps("sign(t-1)", 0.0, 10.0), [1.0], "passing zero counts once");
    assert_eq!(jumps("pulse(t, 3, 3.0000001)", 0.0, 10.0), [3.0, 3.000_000_1], "a pulse within one cell");
    assert_eq!(jumps("if(t < 2, t, step(t-4))", 0.0, 10.0), [2.0, 4.0], "a branch and a step in a branch");
    assert_eq!(jumps("floor(10*t)", 0.0, 0.35), [0.1, 0.2, 0.3], "floors");
    assert_eq!(jumps("square(2*pi*t)", 0.0, 2.0), [0.5, 1.0, 1.5, 2.0], "a square wave");
    assert_eq!(jumps("mod(t, 0.25)", 0.0, 0.6), [0.25, 0.5], "a remainder");
    assert_eq!(jumps("sawtooth(2*pi*t) + (t >= 1)", 0.0, 1.5), [1.0], "together they count once");
    assert_eq!(jumps("step(sin(t))", 0.1, 10.0).len(), 3, "at pi, 2 pi, 3 pi");
    assert!((jumps("step(sin(t))", 0.1, 4.0)[0] - PI).abs() < 1e-15, "at pi");
    assert_eq!(jumps("square(1e9*t)", 0.0, 10.0).len(), 10_000, "capped");
    assert!(jumps("step(t-1)", 2.0, 0.0).is_empty(), "an empty interval");
    assert!(jumps("step(t-1)", f64::NAN, f64::INFINITY).is_empty(), "no interval");
    assert_eq!(
        jumps("sqrt(step(t-1)-1)*step(log(t-2))", 0.0, 10.0),
        [1.0, 2.0, 3.0],
        "also out of the domain"
    );
    let two = Expression::parse("step(t-1) + step(x-t)", &["x", "t"]).unwrap();
    assert_eq!(two.jumps(0.0, 5.0), [1.0], "what depends on x is not known beforehand");
}
