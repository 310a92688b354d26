//! What the passes' branches depend on. A branch on uniforms alone goes one way in all of a draw: it picks a variant, and some drivers
//! compile the shader anew for each value. Variants are pipelines instead, made for `override` constants.
//!
//! How often a loop runs is data, and may come from uniforms: the number of lights does.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::Path;

use wgpu::naga::front::wgsl;
use wgpu::naga::{AddressSpace, Block, Expression, Function, Handle, Module, Span, Statement, TypeInner};

use super::accumulation::ACCUMULATION_WGSL;
use super::denoise::DENOISE_WGSL;
use super::display::DISPLAY_WGSL;
use super::enlargement::ENLARGEMENT_WGSL;
use super::fullscreen::FULLSCREEN_WGSL;
use super::outline::OUTLINE_WGSL;
use super::reprojection::REPROJECTION_WGSL;
use super::shader::{SHADOWED_WGSL, SURFACES_WGSL};

/// What something depends on: this, and maybe what stands before it here.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
enum Origin {
    /// Literals and `override` constants.
    #[default]
    Constants,
    Uniforms,
    /// What differs between invocations: inputs of the stage, textures, storage, loop counters.
    Data,
}

/// A value's origins by the members that they are of: [2, 0] is the first of the third. What is at [] is of all.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
struct Value(BTreeMap<Vec<u32>, Origin>);

impl Value {
    fn of(origin: Origin) -> Self {
        let mut value = Self::default();
        value.add(&[], origin);
        value
    }

    fn add(&mut self, path: &[u32], origin: Origin) {
        if origin > Origin::Constants {
            let held = self.0.entry(path.to_owned()).or_default();
            *held = origin.max(*held);
        }
    }

    /// The other may be what stands at the path.
    fn join(&mut self, path: &[u32], other: &Self) {
        other.0.iter().for_each(|(below, &origin)| self.add(&[path, below].concat(), origin));
    }

    fn member(&self, index: u32) -> Self {
        let mut member = Self::default();
        for (path, &origin) in &self.0 {
            match path.split_first() {
                None => member.add(&[], origin),
                Some((first, below)) if *first == index => member.add(below, origin),
                Some(_) => {}
            }
        }
        member
    }

    fn origin(&self) -> Origin {
        self.0.values().copied().max().unwrap_or_default()
    }
}

/// The branches of a module that depend on uniforms alone, in lines for the reader.
fn variants_by_uniform(source: &str) -> Vec<String> {
    let parsed = wgsl::parse_str(source);
    let module = parsed.unwrap_or_else(|error| panic!("{}", error.emit_to_string(source)));
    let mut search = Search { source, module: &module, outcomes: HashMap::new() };
    let mut found = BTreeSet::new();
    for entry in &module.entry_points {
        let arguments = vec![Value::of(Origin::Data); entry.function.arguments.len()];
        found.append(&mut search.run(&entry.name, &entry.function, arguments).found);
    }
    found.into_iter().collect()
}

/// What comes of a function.
#[derive(Clone, Default)]
struct Outcome {
    returned: Value,
    /// Its branches that depend on uniforms alone, and those of what it calls.
    found: BTreeSet<String>,
}

/// A module, and what comes of its functions by their arguments.
struct Search<'a> {
    source: &'a str,
    module: &'a Module,
    outcomes: HashMap<(Handle<Function>, Vec<Value>), Outcome>,
}

impl Search<'_> {
    fn call(&mut self, callee: Handle<Function>, arguments: Vec<Value>) -> Outcome {
        let key = (callee, arguments);
        if let Some(outcome) = self.outcomes.get(&key) {
            return outcome.clone();
        }
        let function = &self.module.functions[callee];
        let outcome = self.run(function.name.as_deref().unwrap_or_default(), function, key.1.clone());
        self.outcomes.insert(key, outcome.clone());
        outcome
    }

    fn run(&mut self, name: &str, function: &Function, arguments: Vec<Value>) -> Outcome {
        let mut run = Run {
            name,
            function,
            arguments,
            values: Vec::new(),
            variables: vec![Value::default(); function.local_variables.len()],
            results: HashMap::new(),
            outcome: Outcome::default(),
        };
        // Variables and results only gain origins from round to round. What is found in the last round, where none gains any, counts.
        loop {
            let before = (run.variables.clone(), run.results.clone());
            run.outcome = Outcome::default();
            run.evaluate(self);
            run.walk(self, &function.body, Origin::Constants);
            if (&run.variables, &run.results) == (&before.0, &before.1) {
                return run.outcome;
            }
        }
    }
}

/// A function as it is run with some arguments.
struct Run<'a> {
    name: &'a str,
    function: &'a Function,
    arguments: Vec<Value>,
    /// Of all expressions; pointers have the value of what they point to.
    values: Vec<Value>,
    /// What variables hold at any time.
    variables: Vec<Value>,
    /// What calls returned.
    results: HashMap<Handle<Expression>, Value>,
    outcome: Outcome,
}

impl Run<'_> {
    fn value(&self, expression: Handle<Expression>) -> &Value {
        &self.values[expression.index()]
    }

    fn origin(&self, expression: Handle<Expression>) -> Origin {
        self.value(expression).origin()
    }

    /// Operands stand before what they are operands of.
    fn evaluate(&mut self, search: &Search) {
        self.values.clear();
        for (handle, expression) in self.function.expressions.iter() {
            self.values.push(self.value_of(search.module, handle, expression));
            if let Expression::Select { condition, accept, reject } = *expression
                && (self.calls(accept) || self.calls(reject))
            {
                self.branch(search, condition, self.function.expressions.get_span(handle));
            }
        }
    }

    fn value_of(&self, module: &Module, handle: Handle<Expression>, expression: &Expression) -> Value {
        match *expression {
            Expression::FunctionArgument(index) => self.arguments[index as usize].clone(),
            Expression::GlobalVariable(global) => match module.global_variables[global].space {
                AddressSpace::Uniform => Value::of(Origin::Uniforms),
                _ => Value::of(Origin::Data),
            },
            Expression::LocalVariable(variable) => self.variables[variable.index()].clone(),
            Expression::Load { pointer } => self.value(pointer).clone(),
            Expression::AccessIndex { base, index } => self.value(base).member(index),
            Expression::Compose { ty, ref components }
                if matches!(module.types[ty].inner, TypeInner::Struct { .. }) =>
            {
                let mut value = Value::default();
                (0..).zip(components).for_each(|(index, component)| value.join(&[index], self.value(*component)));
                value
            }
            Expression::CallResult(_) => self.results.get(&handle).cloned().unwrap_or_default(),
            _ => match operands(expression) {
                Some(operands) => {
                    Value::of(operands.into_iter().map(|operand| self.origin(operand)).max().unwrap_or_default())
                }
                None => Value::of(Origin::Data),
            },
        }
    }

    /// Whether functions are called for a value.
    fn calls(&self, expression: Handle<Expression>) -> bool {
        let expression = &self.function.expressions[expression];
        let of_operands = || operands(expression)?.into_iter().find(|operand| self.calls(*operand));
        matches!(expression, Expression::CallResult(_)) || of_operands().is_some()
    }

    /// `under`: what decides whether the block is reached.
    fn walk(&mut self, search: &mut Search, block: &Block, under: Origin) {
        for (statement, span) in block.span_iter() {
            match statement {
                Statement::Block(inner) => self.walk(search, inner, under),
                Statement::If { condition, accept, reject } => {
                    if !is_bound_of_a_loop(accept, reject) {
                        self.branch(search, *condition, *span);
                    }
                    let under = under.max(self.origin(*condition));
                    self.walk(search, accept, under);
                    self.walk(search, reject, under);
                }
                Statement::Switch { selector, cases } => {
                    self.branch(search, *selector, *span);
                    let under = under.max(self.origin(*selector));
                    cases.iter().for_each(|case| self.walk(search, &case.body, under));
                }
                Statement::Loop { body, continuing, .. } => {
                    self.walk(search, body, under);
                    // What is counted here differs from round to round.
                    self.walk(search, continuing, Origin::Data);
                }
                Statement::Store { pointer, value } => {
                    let mut value = self.value(*value).clone();
                    value.add(&[], under);
                    self.store(*pointer, value);
                }
                Statement::Return { value } => {
                    let value = value.map(|value| self.value(value).clone()).unwrap_or_default();
                    self.outcome.returned.join(&[], &value);
                    self.outcome.returned.add(&[], under);
                }
                Statement::Call { function, arguments, result } => {
                    assert!(!arguments.iter().any(|at| self.is_place(*at)), "a variable's place is handed on");
                    let arguments = arguments.iter().map(|argument| self.value(*argument).clone()).collect();
                    let mut outcome = search.call(*function, arguments);
                    self.outcome.found.append(&mut outcome.found);
                    self.results.extend(result.map(|result| (result, outcome.returned)));
                }
                _ => {}
            }
        }
    }

    fn branch(&mut self, search: &Search, condition: Handle<Expression>, place: Span) {
        if self.origin(condition) == Origin::Uniforms {
            let rest = place.to_range().map_or("", |range| &search.source[range.start..]);
            let text = rest.split(['{', ';']).next().unwrap_or_default();
            self.outcome.found.insert(format!("{}: {}", self.name, text.trim()));
        }
    }

    fn store(&mut self, pointer: Handle<Expression>, value: Value) {
        match self.function.expressions[pointer] {
            Expression::LocalVariable(variable) => self.variables[variable.index()].join(&[], &value),
            Expression::AccessIndex { base, index } => {
                let mut outer = Value::default();
                outer.join(&[index], &value);
                self.store(base, outer);
            }
            Expression::Access { base, .. } => self.store(base, Value::of(value.origin())),
            _ => {}
        }
    }

    /// Whether this points into a variable.
    fn is_place(&self, pointer: Handle<Expression>) -> bool {
        match self.function.expressions[pointer] {
            Expression::LocalVariable(_) => true,
            Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => self.is_place(base),
            _ => false,
        }
    }
}

/// What a value is computed from; `None` where it is read from what differs between invocations.
fn operands(expression: &Expression) -> Option<Vec<Handle<Expression>>> {
    Some(match *expression {
        Expression::Literal(_) | Expression::Constant(_) | Expression::Override(_) | Expression::ZeroValue(_) => vec![],
        Expression::Compose { ref components, .. } => components.clone(),
        Expression::Access { base, index } => vec![base, index],
        Expression::AccessIndex { base, .. } => vec![base],
        Expression::Splat { value, .. } => vec![value],
        Expression::Swizzle { vector, .. } => vec![vector],
        Expression::Unary { expr, .. } | Expression::As { expr, .. } | Expression::Derivative { expr, .. } => {
            vec![expr]
        }
        Expression::Relational { argument, .. } => vec![argument],
        Expression::Binary { left, right, .. } => vec![left, right],
        Expression::Select { condition, accept, reject } => vec![condition, accept, reject],
        Expression::Math { arg, arg1, arg2, arg3, .. } => [Some(arg), arg1, arg2, arg3].into_iter().flatten().collect(),
        _ => return None,
    })
}

/// What `for` and `while` begin with.
fn is_bound_of_a_loop(accept: &Block, reject: &Block) -> bool {
    accept.is_empty() && matches!(reject[..], [Statement::Break])
}

#[test]
fn no_pass_picks_a_variant_by_a_uniform() {
    let passes = [
        SURFACES_WGSL,
        SHADOWED_WGSL,
        ACCUMULATION_WGSL,
        DENOISE_WGSL,
        REPROJECTION_WGSL,
        DISPLAY_WGSL,
        ENLARGEMENT_WGSL,
        FULLSCREEN_WGSL,
        OUTLINE_WGSL,
    ];
    for pass in passes {
        assert_eq!(variants_by_uniform(pass), [""; 0]);
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders/passes");
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let source = std::fs::read_to_string(&path).unwrap();
        assert!(passes.iter().any(|pass| pass.contains(&source)), "{} is in no pass", path.display());
    }
}

/// What the snippets of the tests below stand in.
fn in_a_pass(statements: &str) -> Vec<String> {
    let source = format!(
        "struct Frame {{ model: u32, count: u32, weight: f32 }}
        struct Surface {{ color: f32, model: u32 }}
        @group(0) @binding(0) var<uniform> frame: Frame;
        @group(0) @binding(1) var<storage, read> models: array<u32>;
        @group(0) @binding(2) var image: texture_2d<f32>;
        override SHEEN: bool = true;
        override MODEL: u32 = 0;
        fn plain(x: f32) -> f32 {{ return 2.0 * x; }}
        fn rich(x: f32) -> f32 {{ return pow(x, 5.0); }}
        fn model() -> u32 {{ return frame.model; }}
        fn is_rich(model: u32) -> bool {{ return model == 1u; }}
        fn shaded(surface: Surface) -> f32 {{ if is_rich(surface.model) {{ return rich(surface.color); }} return 0.0; }}
        @fragment fn shade(@location(0) x: f32) -> @location(0) vec4f {{ var y = x; {statements} return vec4f(y); }}"
    );
    variants_by_uniform(&source)
}

#[test]
fn variants_by_uniform_are_found() {
    for (statements, expected) in [
        ("if frame.model == 1u { return vec4f(rich(x)); }", "shade: if frame.model == 1u"),
        ("if frame.weight > 0.0 { y = rich(x); } else { y = plain(x); }", "shade: if frame.weight > 0.0"),
        ("switch frame.model { case 1u: { y = rich(x); } default: {} }", "shade: switch frame.model"),
        ("switch model() { case 1u: { y = rich(x); } default: {} }", "shade: switch model()"),
        ("let on = is_rich(frame.model); if on { y = rich(x); }", "shade: if on"),
        ("var on = SHEEN; on = frame.weight != 0.0; if on { y = rich(x); }", "shade: if on"),
        ("var on = SHEEN; if MODEL == frame.model { on = false; }", "shade: if MODEL == frame.model"),
        ("y = shaded(Surface(x, frame.model));", "shaded: if is_rich(surface.model)"),
        ("var s: Surface; s.color = x; s.model = model(); y = shaded(s);", "shaded: if is_rich(surface.model)"),
        (
            "y = select(plain(x), 1.0 + rich(x), frame.model == 1u);",
            "shade: select(plain(x), 1.0 + rich(x), frame.model == 1u)",
        ),
        ("for (var i = 0u; i < 4u; i++) { if frame.model == 1u { y += rich(x); } }", "shade: if frame.model == 1u"),
        ("for (var i = 0u; i < frame.count; i++) { let on = is_rich(frame.model); if on { y += x; } }", "shade: if on"),
    ] {
        assert_eq!(in_a_pass(statements), [expected], "{statements}");
    }
    // Either side of `&&` is a branch of its own.
    assert_eq!(in_a_pass("if frame.model == 1u && x > 0.0 { y = rich(x); }"), ["shade: frame.model == 1u && x > 0.0"]);
    let curve = DISPLAY_WGSL.replace("override DISPLAY_TONE_CURVE: u32 = 0;", "");
    let curve =
        curve.replace("gain: f32,", "gain: f32, curve: u32").replace("DISPLAY_TONE_CURVE", "display_uniforms.curve");
    assert_eq!(variants_by_uniform(&curve), ["display_tone: switch display_uniforms.curve"]);
}

#[test]
fn data_and_constants_may_decide() {
    for statements in [
        "if SHEEN && MODEL == 1u { y = rich(x); }",
        "switch MODEL { case 1u: { y = rich(x); } default: {} }",
        "if x > frame.weight { y = rich(x); }",
        "if models[frame.model] == 1u { y = rich(x); }",
        "if textureLoad(image, vec2u(0u), 0).x > frame.weight { y = rich(x); }",
        "y = shaded(Surface(x, models[0])); y += shaded(Surface(frame.weight, MODEL));",
        "y = select(x, 2.0 * x, frame.model == 1u);",
        "y = select(plain(x), rich(x), x > frame.weight);",
        "for (var i = 0u; i < frame.count; i++) { y += rich(x); if i + 1u == frame.count { y += x; } }",
        "var i = 0u; while i < frame.count { y += rich(x); i++; }",
        "var m = frame.model; for (var i = 0u; i < 4u; i++) { y += shaded(Surface(x, m)); m = u32(y); }",
        "var rest = frame.weight; if x > 0.0 { rest = 0.0; } if rest > 0.0 { y = rich(x); }",
    ] {
        assert_eq!(in_a_pass(statements), [""; 0], "{statements}");
    }
}
