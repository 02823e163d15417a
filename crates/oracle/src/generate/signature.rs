//! The signatures of generated models: domains and functions, and the types that terms are generated for.

/// The domain of a term, as far as the generator tells domains apart. Indices are those of [`Signature`].
#[derive(Debug, Clone, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names are those of the language")]
pub enum Type {
    Boolean,
    Integer,
    Natural,
    Real,
    Complex,
    Char,
    String,
    Enum(usize),
    /// A range of integers.
    Concrete(usize),
    /// Elements of an abstract domain or of a subset of one.
    Element(usize),
    Prod(Vec<Type>),
    Seq(Box<Type>),
    Set(Box<Type>),
    Bag(Box<Type>),
    Map(Box<Type>, Box<Type>),
    /// A rule of these parameters.
    Rule(Vec<Type>),
}

/// Enum domains and their literals.
pub const ENUMS: [(&str, &[&str]); 2] = [("Color", &["RED", "GREEN", "BLUE"]), ("Mode", &["ONN", "OFF"])];

/// A concrete domain over the integers.
#[derive(Debug, Clone)]
pub struct Range {
    /// Its name.
    pub name: &'static str,
    /// Its elements.
    pub contents: &'static [i64],
    /// As it is defined.
    pub definition: &'static str,
    /// Its contents are part of the initial state.
    pub dynamic: bool,
}

/// Concrete domains.
pub const RANGES: [Range; 3] = [
    Range { name: "Small", contents: &[-2, -1, 0, 1, 2, 3], definition: "{ -2 : 3 }", dynamic: false },
    Range { name: "Digit", contents: &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9], definition: "{ 0 : 9 }", dynamic: false },
    Range { name: "Prime", contents: &[2, 3, 5], definition: "{ 5, 2, 3 }", dynamic: true },
];

/// An abstract domain.
#[derive(Debug, Clone)]
pub struct Carrier {
    /// Its name.
    pub name: &'static str,
    /// How it is declared.
    pub declaration: &'static str,
    /// Its static elements.
    pub elements: &'static [&'static str],
    /// The carrier that it is a subset of.
    pub base: Option<usize>,
    /// May be extended.
    pub dynamic: bool,
    /// Its elements are agents.
    pub agents: bool,
}

/// Abstract domains and subsets of them.
pub const CARRIERS: [Carrier; 6] = [
    Carrier { name: "Agent", declaration: "", elements: &[], base: None, dynamic: true, agents: true },
    Carrier {
        name: "Item",
        declaration: "abstract domain Item",
        elements: &["box", "bag", "cup"],
        base: None,
        dynamic: false,
        agents: false,
    },
    Carrier {
        name: "Node",
        declaration: "dynamic abstract domain Node",
        elements: &["root"],
        base: None,
        dynamic: true,
        agents: false,
    },
    Carrier {
        name: "Worker",
        declaration: "domain Worker subsetof Agent",
        elements: &["anna", "bert"],
        base: Some(0),
        dynamic: false,
        agents: true,
    },
    Carrier {
        name: "Robot",
        declaration: "dynamic domain Robot subsetof Agent",
        elements: &["carl"],
        base: Some(0),
        dynamic: true,
        agents: true,
    },
    Carrier {
        name: "Leaf",
        declaration: "dynamic domain Leaf subsetof Node",
        elements: &[],
        base: Some(2),
        dynamic: true,
        agents: false,
    },
];

impl Type {
    /// Sets of this.
    pub fn set(self) -> Type {
        Type::Set(Box::new(self))
    }

    /// Sequences of this.
    pub fn seq(self) -> Type {
        Type::Seq(Box::new(self))
    }

    /// The domain as it is written.
    pub fn name(&self) -> String {
        let list = |types: &[Type]| types.iter().map(Type::name).collect::<Vec<_>>().join(",");
        match self {
            Type::Boolean => "Boolean".to_string(),
            Type::Integer => "Integer".to_string(),
            Type::Natural => "Natural".to_string(),
            Type::Real => "Real".to_string(),
            Type::Complex => "Complex".to_string(),
            Type::Char => "Char".to_string(),
            Type::String => "String".to_string(),
            Type::Enum(index) => ENUMS[*index].0.to_string(),
            Type::Concrete(index) => RANGES[*index].name.to_string(),
            Type::Element(index) => CARRIERS[*index].name.to_string(),
            Type::Prod(parts) => format!("Prod({})", list(parts)),
            Type::Seq(of) => format!("Seq({})", of.name()),
            Type::Set(of) => format!("Powerset({})", of.name()),
            Type::Bag(of) => format!("Bag({})", of.name()),
            Type::Map(from, to) => format!("Map({},{})", from.name(), to.name()),
            Type::Rule(parts) if parts.is_empty() => "Rule".to_string(),
            Type::Rule(parts) => format!("Rule({})", list(parts)),
        }
    }

    /// The least term of the type; none if it may have none.
    pub fn least(&self) -> Option<String> {
        Some(match self {
            Type::Boolean => "true".to_string(),
            Type::Integer => "0".to_string(),
            Type::Concrete(index) => RANGES[*index].contents[0].to_string(),
            Type::Natural => "0n".to_string(),
            Type::Real => "0.0".to_string(),
            Type::Complex => "0.0+i1.0".to_string(),
            Type::Char => "'a'".to_string(),
            Type::String => "\"\"".to_string(),
            Type::Enum(index) => ENUMS[*index].1[0].to_string(),
            Type::Element(index) => CARRIERS[*index].elements.first()?.to_string(),
            Type::Seq(of) => format!("[{}]", of.least()?),
            Type::Set(of) => format!("{{{}}}", of.least()?),
            Type::Bag(of) => format!("<{}>", of.least()?),
            Type::Map(from, to) => format!("{{{}->{}}}", from.least()?, to.least()?),
            Type::Prod(parts) => {
                format!("({})", parts.iter().map(Type::least).collect::<Option<Vec<_>>>()?.join(","))
            }
            Type::Rule(_) => return None,
        })
    }

    /// May the domain's elements change?
    pub fn is_dynamic(&self) -> bool {
        match self {
            Type::Concrete(index) => RANGES[*index].dynamic,
            Type::Element(index) => CARRIERS[*index].dynamic || CARRIERS[*index].base.is_some(),
            _ => false,
        }
    }

    /// The type without concrete domains and subsets: what the checker compares.
    pub fn base(&self) -> Type {
        let boxed = |of: &Type| Box::new(of.base());
        match self {
            Type::Concrete(_) => Type::Integer,
            Type::Element(index) => Type::Element(CARRIERS[*index].base.unwrap_or(*index)),
            Type::Prod(parts) => Type::Prod(parts.iter().map(Type::base).collect()),
            Type::Seq(of) => Type::Seq(boxed(of)),
            Type::Set(of) => Type::Set(boxed(of)),
            Type::Bag(of) => Type::Bag(boxed(of)),
            Type::Map(from, to) => Type::Map(boxed(from), boxed(to)),
            other => other.clone(),
        }
    }

    /// Does a term of this type have the other one's domain, subsets aside? Numbers of a smaller domain would fit in
    /// most places too, but not as elements of a collection.
    pub fn fits(&self, wanted: &Type) -> bool {
        self.base() == wanted.base()
    }
}

/// Who may change a function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names are those of the language")]
pub enum Kind {
    Static,
    Derived,
    Monitored,
    Shared,
    Controlled,
    Out,
    Local,
}

/// A declared function.
#[derive(Debug, Clone)]
pub struct Function {
    /// The name.
    pub name: String,
    /// The kind.
    pub kind: Kind,
    /// The parameters.
    pub parameters: Vec<Type>,
    /// The codomain.
    pub codomain: Type,
}

impl Function {
    /// The declaration.
    pub fn declaration(&self) -> String {
        let kind = match self.kind {
            Kind::Static => "static",
            Kind::Derived => "derived",
            Kind::Monitored => "monitored",
            Kind::Shared => "shared",
            Kind::Controlled => "controlled",
            Kind::Out => "out",
            Kind::Local => "local",
        };
        let domain = match self.parameters.as_slice() {
            [] => String::new(),
            [one] => format!("{} -> ", one.name()),
            several => format!("{} -> ", Type::Prod(several.to_vec()).name()),
        };
        format!("{kind} {}: {domain}{}", self.name, self.codomain.name())
    }
}

/// A declared rule.
#[derive(Debug, Clone)]
pub struct Rule {
    /// The name.
    pub name: String,
    /// Its parameters; those that are locations stand for locations of functions with that codomain.
    pub parameters: Vec<Parameter>,
    /// Called by value.
    pub turbo: bool,
    /// What it returns.
    pub result: Option<Type>,
}

/// A parameter of a rule.
#[derive(Debug, Clone)]
pub struct Parameter {
    /// The variable.
    pub name: String,
    /// Its type.
    pub domain: Type,
    /// Written to in the body.
    pub location: bool,
}

/// What can be used so far.
#[derive(Debug, Clone, Default)]
pub struct Signature {
    /// Functions.
    pub functions: Vec<Function>,
    /// Rules, declared before use.
    pub rules: Vec<Rule>,
}
