//! The operators: which small faults are put into a model (spec/mutation.md).
//!
//! INVARIANT: an id never changes its meaning. The order is that of the published list: what takes most away comes first.

/// A kind of small fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Operator {
    /// A rule becomes `skip`.
    RuleDeleted,
    /// A call becomes `skip`.
    CallDeleted,
    /// A guard becomes its negation.
    GuardNegated,
    /// A guard becomes `true`.
    GuardTrue,
    /// A guard becomes `false`.
    GuardFalse,
    /// Two neighbouring branches or cases change places.
    BranchesSwapped,
    /// A call goes to another rule with the same parameters.
    CallReplaced,
    /// An update writes another function of the same domains.
    LocationReplaced,
    /// A function is replaced by another one of the same domains.
    FunctionReplaced,
    /// A variable is replaced by another one of the same domain.
    VariableReplaced,
    /// A computed truth value or enum value is replaced by a constant.
    ValueReplaced,
    /// `forall` becomes `exist`, and the other way round.
    QuantifierReplaced,
    /// `and`, `or`, `implies`, `iff`, `xor`, `not`.
    LogicalReplaced,
    /// `=`, `!=`, `<`, `<=`, `>`, `>=`, `in`, `notin`.
    RelationReplaced,
    /// `+`, `-`, `*`, `mod`, a sign.
    ArithmeticReplaced,
    /// A truth value or an enum literal becomes another one.
    LiteralReplaced,
    /// A whole number becomes one more or one less.
    ConstantShifted,
    /// `par` becomes `seq`, and the other way round.
    OrderReplaced,
    /// A constant in an initial state is replaced.
    InitialReplaced,
    /// Of a chart: an arrow ends at another shape.
    ArrowRedirected,
    /// Of a chart: the exits of a guard are exchanged.
    ExitsSwapped,
    /// Of a chart: a machine begins in another state.
    StartMoved,
    /// Of a chart: two successive phases change places.
    PhasesSwapped,
    /// Of a chart: two phases of a component exchange their channels.
    ChannelsExchanged,
    /// Of a chart: a phase takes a tick more or less.
    DurationShifted,
    /// Of a chart: a period is doubled or halved.
    PeriodScaled,
    /// Of a chart: a channel has one array or message more or less.
    SizeShifted,
    /// Of a chart: the other end is the master of a buffer.
    MasterExchanged,
    /// Of a chart: a component that awaits all of several channels awaits any of them, and the other way round.
    AwaitsExchanged,
}

use Operator::*;

impl Operator {
    /// All operators, in the order of the list.
    pub const ALL: [Operator; 29] = [
        RuleDeleted,
        CallDeleted,
        GuardNegated,
        GuardTrue,
        GuardFalse,
        BranchesSwapped,
        CallReplaced,
        LocationReplaced,
        FunctionReplaced,
        VariableReplaced,
        ValueReplaced,
        QuantifierReplaced,
        LogicalReplaced,
        RelationReplaced,
        ArithmeticReplaced,
        LiteralReplaced,
        ConstantShifted,
        OrderReplaced,
        InitialReplaced,
        ArrowRedirected,
        ExitsSwapped,
        StartMoved,
        PhasesSwapped,
        ChannelsExchanged,
        DurationShifted,
        PeriodScaled,
        SizeShifted,
        MasterExchanged,
        AwaitsExchanged,
    ];

    /// The id, as options and results name it.
    pub fn id(self) -> &'static str {
        match self {
            RuleDeleted => "rule-deleted",
            CallDeleted => "call-deleted",
            GuardNegated => "guard-negated",
            GuardTrue => "guard-true",
            GuardFalse => "guard-false",
            BranchesSwapped => "branches-swapped",
            CallReplaced => "call-replaced",
            LocationReplaced => "location-replaced",
            FunctionReplaced => "function-replaced",
            VariableReplaced => "variable-replaced",
            ValueReplaced => "value-replaced",
            QuantifierReplaced => "quantifier-replaced",
            LogicalReplaced => "logical-replaced",
            RelationReplaced => "relation-replaced",
            ArithmeticReplaced => "arithmetic-replaced",
            LiteralReplaced => "literal-replaced",
            ConstantShifted => "constant-shifted",
            OrderReplaced => "order-replaced",
            InitialReplaced => "initial-replaced",
            ArrowRedirected => "arrow-redirected",
            ExitsSwapped => "exits-swapped",
            StartMoved => "start-moved",
            PhasesSwapped => "phases-swapped",
            ChannelsExchanged => "channels-exchanged",
            DurationShifted => "duration-shifted",
            PeriodScaled => "period-scaled",
            SizeShifted => "size-shifted",
            MasterExchanged => "master-exchanged",
            AwaitsExchanged => "awaits-exchanged",
        }
    }

    /// What it does, in a few words.
    pub fn meaning(self) -> &'static str {
        match self {
            RuleDeleted => "a rule becomes `skip`",
            CallDeleted => "a call of a rule becomes `skip`",
            GuardNegated => "a guard becomes its negation",
            GuardTrue => "a guard becomes `true`",
            GuardFalse => "a guard becomes `false`",
            BranchesSwapped => "two neighbouring branches or cases change places",
            CallReplaced => "a call goes to another rule with the same parameters",
            LocationReplaced => "an update writes another function of the same domains",
            FunctionReplaced => "a function becomes another one of the same domains",
            VariableReplaced => "a variable becomes another one of the same domain",
            ValueReplaced => "a computed truth value or enum value becomes a constant",
            QuantifierReplaced => "`forall` becomes `exist`, or the other way round",
            LogicalReplaced => "`and`, `or`, `implies`, `iff` or `xor` becomes another one, `not` is left out",
            RelationReplaced => "`=`, `!=`, `<`, `<=`, `>`, `>=`, `in` or `notin` becomes another one",
            ArithmeticReplaced => "`+`, `-`, `*` or `mod` becomes another one, a sign is left out",
            LiteralReplaced => "a truth value or an enum literal becomes another one",
            ConstantShifted => "a whole number becomes one more or one less",
            OrderReplaced => "`par` becomes `seq`, or the other way round",
            InitialReplaced => "a constant of the initial state becomes another one",
            ArrowRedirected => "an arrow of a chart ends at another shape of the same kind",
            ExitsSwapped => "the exits of a guard of a chart are exchanged",
            StartMoved => "a machine or composite state of a chart begins in another state",
            PhasesSwapped => "two successive phases of a component change places",
            ChannelsExchanged => "two phases of a component exchange their channels",
            DurationShifted => "a phase takes a tick more or less",
            PeriodScaled => "a period is doubled or halved",
            SizeShifted => "a channel has one array or message more or less",
            MasterExchanged => "the other end is the master of a swinging buffer",
            AwaitsExchanged => "`awaits all` becomes `awaits any`, or the other way round",
        }
    }

    /// The operator of this id.
    pub fn of(id: &str) -> Option<Operator> {
        Operator::ALL.into_iter().find(|operator| operator.id() == id)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_name_one_operator_each() {
        for operator in Operator::ALL {
            assert_eq!(Operator::of(operator.id()), Some(operator));
        }
        assert!(Operator::ALL.windows(2).all(|pair| pair[0] < pair[1]));
        assert_eq!(Operator::of("rule"), None);
    }
}
