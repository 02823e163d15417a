// Faults where exceptions are off, as in bare generated code: they land in the innermost `attempt`, in each thread its own.
#include <cstdio>
#include <thread>

#include "groundstate/machine/fault.hpp"

using namespace groundstate::machine;

namespace {

int divide(int a, int b) {
    if (b == 0) fail(FaultKind::division_by_zero, 7);
    return a / b;
}

bool lands() {
    int quotient = -1;
    const Fault none = attempt([&] { quotient = divide(6, 3); });
    if (none || quotient != 2) return false;
    const Fault fault = attempt([&] { quotient = divide(6, 0); });
    if (fault != Fault{FaultKind::division_by_zero, 7, 7}) return false;
    Fault inner;
    const Fault outer = attempt([&] {
        inner = attempt([] { fail(FaultKind::inconsistent_update, 1, 2); });
        (void)divide(1, 0);
    });
    int written = 0;
    const Fault later = attempt([&] {
        written = 1;
        fail(FaultKind::limit, 3);
    });
    if (later.kind != FaultKind::limit || written != 1) return false;
    return inner == Fault{FaultKind::inconsistent_update, 1, 2} && outer.kind == FaultKind::division_by_zero;
}

}  // namespace

int main() {
    bool there = false;
    std::thread other{[&] {
        for (int i = 0; i < 1'000; ++i) there = lands();
    }};
    const bool here = lands();
    other.join();
    if (here && there) return 0;
    std::puts("a fault did not land where it was attempted");
    return 1;
}
