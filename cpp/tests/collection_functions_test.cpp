// Library functions on sequences, products, sets, bags and maps, and what ranges over them.
#include "examples.hpp"

namespace groundstate::machine {
namespace {

const Value undef, yes = Value::boolean(true), no = Value::boolean(false);
const Value zero = Value::integer(0);

TEST(LibrarySequences, AreBuiltAndTakenApart) {
    const Value three = of("[i1,i2,i3]"), empty = of("[]");
    EXPECT_EQ(seq_length(three, here), integer(3));
    EXPECT_EQ(seq_is_empty(three, here), no);
    EXPECT_EQ(seq_is_empty(empty, here), yes);
    EXPECT_EQ(first(three, here), integer(1));
    EXPECT_EQ(last(three, here), integer(3));
    EXPECT_EQ(tail(three, here), of("[i2,i3]"));
    EXPECT_EQ(tail(of("[u]"), here), empty);
    EXPECT_EQ(append(prepend(integer(0), of("[i1,i2]"), here), integer(3), here), of("[i0,i1,i2,i3]"));
    EXPECT_EQ(seq_concat(three, of("[i1]"), here), of("[i1,i2,i3,i1]"));
    EXPECT_EQ(seq_excluding(of("[i1,i2,i1]"), integer(1), here), of("[i2,i1]"));
    EXPECT_EQ(seq_excluding(three, undef, here), three);
    for (const auto function : {first, last, tail}) {
        EXPECT_FAULT(bad_operand, function(empty, here));
        EXPECT_FAULT(undefined_operand, function(undef, here));
        EXPECT_FAULT(bad_operand, function(of("{i1}"), here));
    }
    EXPECT_FAULT(undefined_operand, append(undef, integer(1), here));
    EXPECT_FAULT(undefined_operand, prepend(undef, integer(1), here)) << "any operand that is undef";
}

TEST(LibrarySequences, HavePositionsFromZero) {
    const Value two = of("[i5,i6]");
    EXPECT_EQ(seq_at(two, integer(1), here), integer(6));
    EXPECT_EQ(insert_at(two, integer(1), integer(9), here), of("[i5,i9,i6]"));
    EXPECT_EQ(insert_at(two, integer(2), integer(9), here), of("[i5,i6,i9]"));
    EXPECT_EQ(replace_at(two, integer(0), undef, here), of("[u,i6]"));
    EXPECT_EQ(sub_sequence(of("[i1,i2,i3]"), integer(1), integer(2), here), of("[i2]"));
    EXPECT_EQ(sub_sequence(two, integer(2), integer(2), here), of("[]"));
    EXPECT_EQ(seq_index_of(two, integer(6), here), integer(1));
    EXPECT_EQ(seq_index_of(two, undef, here), integer(-1));
    EXPECT_EQ(seq_contains(of("[u]"), undef, here), yes);
    EXPECT_EQ(seq_count(of("[i1,i2,i1]"), integer(1), here), integer(2));
    EXPECT_FAULT(bad_operand, seq_at(two, integer(2), here));
    EXPECT_FAULT(bad_operand, seq_at(two, integer(-1), here));
    EXPECT_FAULT(undefined_operand, seq_at(two, undef, here));
    EXPECT_FAULT(bad_operand, insert_at(two, integer(3), integer(9), here));
    EXPECT_FAULT(undefined_operand, insert_at(two, undef, integer(9), here));
    EXPECT_FAULT(bad_operand, replace_at(two, integer(2), integer(9), here));
    EXPECT_FAULT(bad_operand, sub_sequence(two, integer(1), integer(0), here));
    EXPECT_FAULT(bad_operand, sub_sequence(two, integer(0), integer(3), here));
    EXPECT_FAULT(bad_operand, sub_sequence(two, integer(-1), integer(1), here));
}

TEST(LibraryProducts, HaveComponents) {
    const Value triple = of("(i1,s1:a,u)");
    EXPECT_EQ(component(1, triple, here), text("a"));
    EXPECT_EQ(component(2, triple, here), undef);
    EXPECT_EQ(tuple_at(triple, integer(0), here), integer(1));
    EXPECT_EQ(tuple_index_of(triple, undef, here), integer(2));
    EXPECT_EQ(tuple_index_of(triple, integer(9), here), integer(-1));
    EXPECT_EQ(project(triple, 0, here), integer(1));
    EXPECT_FAULT(bad_operand, component(3, triple, here));
    EXPECT_FAULT(undefined_operand, component(0, undef, here));
    EXPECT_FAULT(bad_operand, tuple_at(triple, integer(3), here));
    EXPECT_FAULT(undefined_operand, project(undef, 0, here));
}

TEST(LibrarySets, AreCombined) {
    const Value a = of("{i1,i2}"), b = of("{i2,i3}");
    EXPECT_EQ(set_union(a, b, here), of("{i1,i2,i3}"));
    EXPECT_EQ(set_intersection(a, b, here), of("{i2}"));
    EXPECT_EQ(set_difference(a, b, here), of("{i1}"));
    EXPECT_EQ(symmetric_difference(a, b, here), of("{i1,i3}"));
    EXPECT_EQ(set_including(a, integer(0), here), of("{i0,i1,i2}"));
    EXPECT_EQ(set_including(a, integer(1), here), a);
    EXPECT_EQ(set_including(a, undef, here), of("{u,i1,i2}"));
    EXPECT_EQ(set_excluding(a, integer(1), here), of("{i2}"));
    EXPECT_EQ(set_excluding(a, integer(3), here), a);
    EXPECT_EQ(set_size(a, here), integer(2));
    EXPECT_EQ(set_is_empty(of("{}"), here), yes);
    EXPECT_EQ(set_not_empty(of("{}"), here), no);
    EXPECT_FAULT(undefined_operand, set_union(a, undef, here));
    EXPECT_FAULT(bad_operand, set_union(a, of("[i1]"), here));
    EXPECT_FAULT(undefined_operand, set_including(undef, integer(1), here));
}

TEST(LibrarySets, HaveElements) {
    const Value a = of("{u,i1,i2}");
    EXPECT_EQ(set_contains(a, undef, here), yes);
    EXPECT_EQ(set_contains(a, integer(3), here), no);
    EXPECT_EQ(set_not_in(a, integer(3), here), yes);
    EXPECT_EQ(all_in(of("{i1,i2}"), a, here), yes);
    EXPECT_EQ(all_in(of("{i1,i3}"), a, here), no);
    EXPECT_EQ(not_all_in(of("{i1,i3}"), a, here), yes);
    EXPECT_EQ(all_in(of("{}"), of("{}"), here), yes);
    EXPECT_FAULT(undefined_operand, set_contains(undef, integer(1), here));
    EXPECT_FAULT(bad_operand, set_contains(integer(1), integer(1), here));
    EXPECT_FAULT(undefined_operand, set_not_in(integer(1), undef, here));
}

TEST(LibrarySets, OfNaturals) {
    EXPECT_EQ(natural_range(integer(1), integer(3), here), of("{i1,i2,i3}"));
    EXPECT_EQ(natural_range(integer(3), integer(1), here), of("{}"));
    EXPECT_FAULT(limit, natural_range(integer(1), integer(10'000'001), here));
    EXPECT_FAULT(bad_operand, natural_range(integer(1), integer(200'000'000), here));
    EXPECT_FAULT(undefined_operand, natural_range(integer(1), undef, here));
}

TEST(LibraryCollections, AreSummedUp) {
    EXPECT_EQ(set_sum(of("{i1,i2}"), zero, here), integer(3));
    EXPECT_EQ(seq_sum(of("[i1,i1]"), zero, here), integer(2));
    EXPECT_EQ(bag_sum(of("<i5*3>"), zero, here), integer(15));
    EXPECT_EQ(set_sum(of("{}"), real(0.0), here), real(0.0)) << "the zero of the term's domain";
    EXPECT_EQ(seq_sum(Value::seq({integer(1), real(0.5)}), zero, here), real(1.5));
    EXPECT_EQ(seq_sum(Value::seq({real(0.5), Value::complex(0.0, 1.0)}), zero, here), Value::complex(0.5, 1.0));
    EXPECT_FAULT(overflow, seq_sum(of("[i9223372036854775807,i1]"), zero, here));
    EXPECT_FAULT(bad_operand, set_sum(of("{s1:a}"), zero, here));
    EXPECT_FAULT(bad_operand, set_sum(of("{u,i1}"), zero, here)) << "the set itself is defined";
    EXPECT_FAULT(undefined_operand, set_sum(undef, zero, here));
}

TEST(LibraryCollections, BecomeEachOther) {
    EXPECT_EQ(as_sequence(of("{i2,i1}"), here), of("[i1,i2]"));
    EXPECT_EQ(as_sequence(of("<i1*2,i3*1>"), here), of("[i1,i1,i3]"));
    EXPECT_EQ(as_bag(of("[i2,i1,i2]"), here), of("<i1*1,i2*2>"));
    EXPECT_EQ(as_set(of("[i2,i1,i2]"), here), of("{i1,i2}"));
    EXPECT_EQ(as_set(of("<i1*2>"), here), of("{i1}"));
    EXPECT_FAULT(undefined_operand, as_set(undef, here));
    EXPECT_FAULT(bad_operand, as_bag(of("|-|"), here));
}

TEST(LibraryBags, CountTheirElements) {
    const Value bag = of("<i1*2,i2*1>"), other = of("<i1*1,i3*4>"), set = of("{i1,i3}");
    EXPECT_EQ(bag_union(bag, other, here), of("<i1*3,i2*1,i3*4>"));
    EXPECT_EQ(bag_intersection(bag, other, here), of("<i1*1>"));
    EXPECT_EQ(bag_set_union(bag, set, here), of("<i1*3,i2*1,i3*1>"));
    EXPECT_EQ(set_bag_union(set, bag, here), of("<i1*3,i2*1,i3*1>"));
    EXPECT_EQ(bag_set_intersection(other, set, here), of("<i1*1,i3*1>"));
    EXPECT_EQ(set_bag_intersection(set, other, here), set);
    EXPECT_EQ(bag_including(of("<i1*1,i2*1>"), integer(1), here), bag);
    EXPECT_EQ(bag_including(bag, integer(3), here), of("<i1*2,i2*1,i3*1>"));
    EXPECT_EQ(bag_excluding(bag, integer(1), here), of("<i1*1,i2*1>"));
    EXPECT_EQ(bag_excluding(bag, integer(2), here), of("<i1*2>"));
    EXPECT_EQ(bag_excluding(bag, integer(7), here), bag);
    EXPECT_EQ(bag_contains(bag, integer(2), here), yes);
    EXPECT_EQ(bag_count(bag, integer(1), here), integer(2));
    EXPECT_EQ(bag_count(bag, undef, here), integer(0));
    EXPECT_EQ(bag_size(bag, here), integer(3));
    EXPECT_FAULT(undefined_operand, bag_union(bag, undef, here));
    EXPECT_FAULT(undefined_operand, bag_size(undef, here));
    EXPECT_FAULT(bad_operand, bag_count(of("[i1]"), integer(1), here));
}

TEST(LibraryBags, StayWithinTheLimit) {
    const Value full = of("<i1*10000000>");
    EXPECT_EQ(bag_size(full, here), integer(10'000'000));
    EXPECT_FAULT(limit, bag_including(full, integer(2), here));
    EXPECT_FAULT(limit, bag_union(full, full, here));
    EXPECT_FAULT(limit, bag_union(full, of("<i1*18446744073709551615>"), here)) << "counts do not wrap";
}

TEST(LibraryMaps, HaveEntries) {
    const Value map = of("|i1>s1:a,i2>u|");
    EXPECT_EQ(map_at(map, integer(1), here), text("a"));
    EXPECT_EQ(map_at(map, integer(3), here), undef);
    EXPECT_EQ(map_size(map, here), integer(2));
    EXPECT_EQ(map_keys(map, here), of("{i1,i2}"));
    EXPECT_EQ(map_values(of("|i1>i5,i2>i5|"), here), of("{i5}"));
    EXPECT_EQ(map_assign(of("|i1>s1:a|"), integer(2), undef, here), map);
    EXPECT_EQ(map_assign(map, integer(1), integer(7), here), of("|i1>i7,i2>u|"));
    EXPECT_EQ(map_assign(map, integer(0), integer(7), here), of("|i0>i7,i1>s1:a,i2>u|"));
    EXPECT_EQ(map_merge(map, of("|i0>u,i1>i9|"), here), of("|i0>u,i1>i9,i2>u|"));
    EXPECT_FAULT(undefined_operand, map_at(undef, integer(1), here));
    EXPECT_FAULT(bad_operand, map_keys(of("{i1}"), here));
    EXPECT_FAULT(undefined_operand, map_merge(map, undef, here));
}

TEST(Ranging, OverNumbers) {
    const auto numbers = [](const Value& low, const Value& high, const Value& step) {
        return range(low, high, &step, CollectionKind::seq, here);
    };
    EXPECT_EQ(range(integer(1), integer(3), nullptr, CollectionKind::set, here), of("{i1,i2,i3}"));
    EXPECT_EQ(numbers(integer(1), integer(6), integer(2)), of("[i1,i3,i5]"));
    EXPECT_EQ(numbers(integer(3), integer(1), integer(1)), of("[]"));
    const Value tenths = numbers(real(0.0), real(0.3), real(0.1));
    EXPECT_EQ(tenths, Value::seq({real(0.0), real(0.1), real(0.2), real(0.3)}));
    EXPECT_EQ(numbers(real(-0.5), real(1.5), integer(1)), Value::seq({real(-0.5), real(0.5), real(1.5)}));
    EXPECT_EQ(numbers(real(1.0), real(0.0), real(1.0)), of("[]"));
    EXPECT_FAULT(bad_operand, numbers(integer(1), integer(2), integer(0)));
    EXPECT_FAULT(bad_operand, numbers(real(1.0), real(2.0), real(-1.0)));
    EXPECT_FAULT(bad_operand, numbers(integer(1), real(2.0), integer(1)));
    EXPECT_FAULT(bad_operand, numbers(integer(1), integer(2), real(1.0)));
    EXPECT_FAULT(undefined_operand, numbers(undef, integer(2), integer(1)));
    EXPECT_FAULT(undefined_operand, numbers(real(1.0), real(2.0), undef));
    EXPECT_FAULT(limit, numbers(integer(0), integer(10'000'000), integer(1)));
    EXPECT_FAULT(limit, numbers(integer(std::numeric_limits<std::int64_t>::min()),
                                integer(std::numeric_limits<std::int64_t>::max()), integer(1)));
    EXPECT_FAULT(limit, numbers(real(0.0), real(1e30), real(1.0)));
}

TEST(Ranging, OverElements) {
    const auto in_order = [](const Value& collection) {
        Values all;
        for (const Value& element : iterable(collection, here)) all.push_back(element);
        return Value::seq(std::move(all));
    };
    EXPECT_EQ(in_order(of("{i2,i1}")), of("[i1,i2]"));
    EXPECT_EQ(in_order(of("[i2,i1]")), of("[i2,i1]"));
    EXPECT_EQ(in_order(of("<i1*2,i3*1>")), of("[i1,i1,i3]"));
    EXPECT_EQ(in_order(of("|i1>i5,i2>i4|")), of("[(i1,i5),(i2,i4)]"));
    EXPECT_FAULT(undefined_operand, iterable(undef, here));
    EXPECT_FAULT(bad_operand, iterable(of("(i1,i2)"), here));
}

TEST(Ranging, OverDomains) {
    const Values pair{integer(1), integer(2)}, letters{Value::character(U'a'), Value::character(U'b')};
    EXPECT_EQ(Value::seq(tuples({pair, letters}, here)), of("[(i1,c97),(i1,c98),(i2,c97),(i2,c98)]"));
    EXPECT_EQ(Value::seq(tuples({pair, {}}, here)), of("[]"));
    EXPECT_EQ(Value::seq(subsets(pair, here)), of("[{},{i1},{i1,i2},{i2}]"));
    const Value many = range(integer(1), integer(70), nullptr, CollectionKind::seq, here);
    EXPECT_FAULT(limit, subsets(many.items(), here));
    EXPECT_FAULT(limit, tuples({many.items(), many.items(), many.items(), many.items()}, here));
}

TEST(Ranging, CollectsElements) {
    const Values pairs{of("(i2,i1)"), of("(i1,i1)"), of("(i2,i3)")};
    EXPECT_EQ(collection(CollectionKind::set, pairs), of("{(i1,i1),(i2,i1),(i2,i3)}"));
    EXPECT_EQ(collection(CollectionKind::seq, pairs), of("[(i2,i1),(i1,i1),(i2,i3)]"));
    EXPECT_EQ(collection(CollectionKind::bag, {integer(1), integer(1)}), of("<i1*2>"));
    EXPECT_EQ(collection(CollectionKind::map, pairs), of("|i1>i1,i2>i3|"));
}

}  // namespace
}  // namespace groundstate::machine
