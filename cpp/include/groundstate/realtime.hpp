// What the operating system may grant a control task: SCHED_FIFO, a processor of its own, memory that stays.
//
// A process without the permission still runs, only less punctually. So nothing here fails, and everything reports what
// it got. Ask with `ulimit -r -l`, or give the program CAP_SYS_NICE and CAP_IPC_LOCK.
#pragma once

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

namespace groundstate {

enum class Grant { not_asked, granted, refused };

/// What a task asks for.
struct Realtime {
    int priority = 0;    ///< of SCHED_FIFO, 1 (least) to 99; 0 asks for nothing
    int processor = -1;  ///< the one to run on; -1 asks for nothing
};

/// What it got. Aligned as one word: some compilers call a library for atomics of less aligned ones.
struct alignas(8) Granted {
    Grant priority = Grant::not_asked;
    Grant processor = Grant::not_asked;
};

/// Keeps all memory of the process, present and future, from being paged out. If the memory that may be locked is
/// limited, this is refused: otherwise later allocations, such as the stack of a thread, would be refused instead.
/// Who: once, at the start. Blocks: while the memory is brought in.
inline Grant lock_memory() noexcept {
    rlimit limit{};
    if (geteuid() != 0 && getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
        return Grant::refused;
    }
    return mlockall(MCL_CURRENT | MCL_FUTURE) == 0 ? Grant::granted : Grant::refused;
}

/// Applies to the calling thread. Who: a task, before its first cycle. Blocks: no.
inline Granted become_realtime(const Realtime& wish) noexcept {
    Granted granted;
    if (wish.priority > 0) {
        const sched_param parameters{.sched_priority = wish.priority};
        const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
        granted.priority = error == 0 ? Grant::granted : Grant::refused;
    }
    if (wish.processor >= 0) {
        cpu_set_t processors;
        CPU_ZERO(&processors);
        if (wish.processor < CPU_SETSIZE) {
            CPU_SET(static_cast<unsigned>(wish.processor), &processors);
        }
        const int error = pthread_setaffinity_np(pthread_self(), sizeof processors, &processors);
        granted.processor = error == 0 ? Grant::granted : Grant::refused;
    }
    return granted;
}

}  // namespace groundstate
