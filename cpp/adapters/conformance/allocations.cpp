// Counts what is asked of the allocator, by whomever: the program's own malloc stands before that of the C library.
#include <atomic>
#include <cerrno>
#include <cstddef>

#include "allocation_suite.hpp"

namespace {
std::atomic<std::int64_t> allocated{0};
std::atomic<std::int64_t> released{0};
}  // namespace

namespace groundstate::conformance {
std::int64_t allocations() noexcept { return allocated.load(std::memory_order_relaxed); }
std::int64_t releases() noexcept { return released.load(std::memory_order_relaxed); }
}  // namespace groundstate::conformance

// The names under which glibc keeps its own.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t size) {
    allocated.fetch_add(1, std::memory_order_relaxed);
    return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
    allocated.fetch_add(1, std::memory_order_relaxed);
    return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
    allocated.fetch_add(1, std::memory_order_relaxed);
    released.fetch_add(memory != nullptr, std::memory_order_relaxed);
    return __libc_realloc(memory, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
    allocated.fetch_add(1, std::memory_order_relaxed);
    return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
    *memory = memalign(alignment, size);
    return *memory == nullptr ? ENOMEM : 0;
}
void free(void* memory) {
    released.fetch_add(memory != nullptr, std::memory_order_relaxed);
    __libc_free(memory);
}
}
