// Lists of small domains beside vectors: what is pushed, joined and cut comes out again, in place and on the heap.
#include "groundstate/machine/lists.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <vector>

namespace groundstate::machine {
namespace {

struct Task {
    std::uint32_t element = 0;
    friend constexpr bool operator==(const Task&, const Task&) = default;
};
using Model = std::vector<std::optional<std::uint32_t>>;

Maybe<Task> task(const std::optional<std::uint32_t>& number) {
    return number ? Maybe<Task>{Task{*number}} : Maybe<Task>{};
}

List<Task> list_of(const Model& model) {
    List<Task> list;
    for (const auto& item : model) {
        list.push_back(task(item), 0);
    }
    return list;
}

void expect_same(const List<Task>& list, const Model& model) {
    ASSERT_EQ(list.size(), model.size());
    EXPECT_EQ(is_empty(list), model.empty());
    std::size_t place = 0;
    for (const Maybe<Task> item : items(list)) {
        EXPECT_EQ(item, task(model[place]));
        EXPECT_EQ(list[place], item);
        ++place;
    }
    EXPECT_EQ(place, model.size());
    for (std::uint32_t number = 0; number < 5; ++number) {
        const auto found = std::find(model.begin(), model.end(), std::optional{number});
        EXPECT_EQ(index_of(list, Task{number}), found == model.end() ? -1 : found - model.begin());
    }
    const auto undef_at = std::find(model.begin(), model.end(), std::nullopt);
    EXPECT_EQ(contains(list, Maybe<Task>{}), undef_at != model.end());
    EXPECT_EQ(list, list_of(model));
}

TEST(List, IsWhatWasPutIntoIt) {
    std::mt19937 random{7};
    for (int round = 0; round < 2'000; ++round) {
        Model a;
        Model b;
        for (Model* model : {&a, &b}) {
            const auto size = random() % (round % 10 == 0 ? 60 : 17);
            for (std::size_t i = 0; i < size; ++i) {
                model->push_back(random() % 9 == 0 ? std::nullopt : std::optional<std::uint32_t>{random() % 4});
            }
        }
        const List<Task> first = list_of(a);
        List<Task> second = list_of(b);
        expect_same(first, a);
        Model both = a;
        both.insert(both.end(), b.begin(), b.end());
        expect_same(joined(first, second, 0), both);
        if (!both.empty()) {
            EXPECT_EQ(first_of(joined(first, second, 0), 0), task(both.front()));
            EXPECT_EQ(last_of(joined(first, second, 0), 0), task(both.back()));
            expect_same(tail_of(joined(first, second, 0), 0), Model(both.begin() + 1, both.end()));
        }
        // A copy keeps what it was.
        const List<Task> copy = second;
        second.push_back(Task{3}, 0);
        expect_same(copy, b);
        b.push_back(3);
        expect_same(second, b);
        EXPECT_EQ(first == second, a == b);
    }
}

TEST(List, AppendsItself) {
    List<Task> list = list_of({0, 1, 2, 3, 0, 1, 2, 3, 0});
    list.append(list, 0);
    EXPECT_EQ(list, list_of({0, 1, 2, 3, 0, 1, 2, 3, 0, 0, 1, 2, 3, 0, 1, 2, 3, 0}));
}

TEST(List, GivesItsItemsAsASet) {
    const List<Task> list = list_of({5, 0, 63, 5, 0});
    std::vector<std::uint32_t> found;
    for (const Task item : ItemSet<Task>{list}) {
        found.push_back(item.element);
    }
    EXPECT_EQ(found, (std::vector<std::uint32_t>{0, 5, 63}));
}

TEST(List, OfNoneHasNoFirstItem) {
    const Fault fault = attempt([] { (void)first_of(List<Task>{}, 4); }, [] {});
    EXPECT_EQ(fault.kind, FaultKind::bad_operand);
    EXPECT_EQ(fault.site, 4U);
}

}  // namespace
}  // namespace groundstate::machine
