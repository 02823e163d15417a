// Values and faults of generated code: kinds, canonical order, equality, hash, sharing.
#include "groundstate/machine/value.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <thread>
#include <unordered_set>

#include "groundstate/machine/fault.hpp"

namespace groundstate::machine {
namespace {

Value integer(std::int64_t number) { return Value::integer(number); }

Values integers(std::initializer_list<std::int64_t> numbers) {
    Values values;
    for (const std::int64_t number : numbers) values.push_back(integer(number));
    return values;
}

/// One or more of each kind, ascending in the order of the machine.
Values ascending() {
    const double infinity = std::numeric_limits<double>::infinity();
    return {
        Value{},
        Value::boolean(false),
        Value::boolean(true),
        integer(std::numeric_limits<std::int64_t>::min()),
        integer(-1),
        integer(0),
        integer(7),
        Value::real(-infinity),
        Value::real(-1.5),
        Value::real(0.0),
        Value::real(5e-324),
        Value::real(2.0),
        Value::real(infinity),
        Value::enumeration(1, 9),
        Value::enumeration(2, 0),
        Value::enumeration(2, 1),
        Value::element(0, 3),
        Value::element(1, 0),
        Value::character(U'a'),
        Value::character(U'\u00e9'),
        Value::rule(0),
        Value::rule(4),
        Value::complex(-1.0, 7.0),
        Value::complex(0.0, -1.0),
        Value::complex(0.0, 1.0),
        Value::string(""),
        Value::string("a"),
        Value::string("ab"),
        Value::string("b"),
        Value::string("\u00e9"),
        Value::tuple({}),
        Value::tuple(integers({1, 2})),
        Value::tuple(integers({2})),
        Value::seq({}),
        Value::seq(integers({1})),
        Value::seq(integers({1, 0})),
        Value::seq(integers({2})),
        Value::set({}),
        Value::set({Value{}}),
        Value::set(integers({9, 1})),
        Value::set(integers({2, 3})),
        Value::bag({}),
        Value::bag(integers({1, 2})),
        Value::bag(integers({1, 1})),
        Value::map({}),
        Value::map({{integer(1), integer(5)}}),
        Value::map({{integer(1), integer(5)}, {integer(2), integer(0)}}),
        Value::map({{integer(1), integer(6)}}),
    };
}

TEST(Value, HasTheOrderOfTheMachine) {
    const Values values = ascending();
    for (std::size_t i = 0; i < values.size(); ++i) {
        for (std::size_t j = 0; j < values.size(); ++j) {
            EXPECT_EQ(values[i] <=> values[j], i <=> j) << i << " and " << j;
            EXPECT_EQ(values[i] == values[j], i == j) << i << " and " << j;
        }
    }
}

TEST(Value, IsHashedAsItIsEqual) {
    const Values first = ascending();
    const Values again = ascending();
    std::unordered_set<Value> values;
    for (std::size_t i = 0; i < first.size(); ++i) {
        EXPECT_EQ(first[i].hash(), again[i].hash());
        values.insert(first[i]);
        values.insert(again[i]);
    }
    EXPECT_EQ(values.size(), first.size());
}

TEST(Value, ZeroIsOne) {
    EXPECT_EQ(Value::real(-0.0), Value::real(0.0));
    EXPECT_EQ(Value::real(-0.0).hash(), Value::real(0.0).hash());
    EXPECT_EQ(Value::complex(-0.0, 1.0).hash(), Value::complex(0.0, 1.0).hash());
}

TEST(Value, CollectionsAreCanonical) {
    EXPECT_EQ(Value::set(integers({3, 1, 2, 1})), Value::set(integers({1, 2, 3})));
    EXPECT_EQ(Value::set(integers({3, 1, 3})).items(), integers({1, 3}));
    EXPECT_EQ(Value::bag(integers({3, 1, 3})).as_bag(), (Counts{{integer(1), 1}, {integer(3), 2}}));
    const Value map = Value::map({{integer(2), integer(0)}, {integer(1), integer(1)}, {integer(2), integer(5)}});
    EXPECT_EQ(map.as_map(), (Entries{{integer(1), integer(1)}, {integer(2), integer(5)}})) << "the last one counts";
}

TEST(Value, SharesWhatIsCompound) {
    Value set = Value::set(integers({1, 2}));
    const Value copy = set;
    EXPECT_EQ(&copy.items(), &set.items());
    const Value& itself = set;
    set = itself;
    EXPECT_EQ(set, copy);
    const Value taken = std::move(set);
    EXPECT_EQ(taken, copy);
    set = integer(3);
    EXPECT_EQ(set.as_integer(), 3);
    EXPECT_EQ(taken.items().size(), 2u);
}

TEST(Value, IsSharedByThreads) {
    const Value whole = Value::set({Value::string("a text that is longer than what stands in a string itself"), integer(1)});
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
        threads.emplace_back([copy = whole] {
            Value mine = copy;
            for (int round = 0; round < 1'000; ++round) mine = Value::seq({mine.is(Kind::set) ? mine : copy, integer(round)});
            EXPECT_EQ(mine.items()[0], copy);
        });
    }
    for (std::thread& thread : threads) thread.join();
}

TEST(Fault, IsCaughtWithItsPlaces) {
    EXPECT_FALSE(attempt([] {}));
    EXPECT_EQ(attempt([] { fail(FaultKind::inconsistent_update, 3, 5); }), (Fault{FaultKind::inconsistent_update, 3, 5}));
    EXPECT_EQ(attempt([] { fail(FaultKind::limit, 4); }), (Fault{FaultKind::limit, 4, 4}));
    Fault inner;
    const Fault outer = attempt([&] {
        inner = attempt([] { fail(FaultKind::unbound, 1); });
        fail(FaultKind::temporal, 2);
    });
    EXPECT_EQ(inner.kind, FaultKind::unbound);
    EXPECT_EQ(outer.kind, FaultKind::temporal);
}

TEST(Fault, HasTheNameOfItsPage) {
    EXPECT_STREQ(id(FaultKind::inconsistent_update), "inconsistent-update");
    EXPECT_STREQ(id(FaultKind::out_of_domain), "value-outside-domain");
    EXPECT_STREQ(id(FaultKind::no_main), "no-main-rule");
}

}  // namespace
}  // namespace groundstate::machine
