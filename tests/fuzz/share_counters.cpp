// SPDX-License-Identifier: MIT
//
// libFuzzer counts in this process what ran in it. For harnesses whose work is done in child processes the
// counters are shared with these, but for the parts of pages at both ends. Compiled without counters: clang
// forgets those of a file that names their bounds.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include <sys/mman.h>
#include <unistd.h>

extern "C" std::uint8_t __start___sancov_cntrs[], __stop___sancov_cntrs[];

extern "C" int LLVMFuzzerInitialize(int*, char***)
{
    const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    const std::uintptr_t first = (reinterpret_cast<std::uintptr_t>(__start___sancov_cntrs) + page - 1) / page;
    const std::uintptr_t last = reinterpret_cast<std::uintptr_t>(__stop___sancov_cntrs) / page;
    if (first >= last) return 0; // less than a page: nothing to share
    const void* const shared = mmap(reinterpret_cast<void*>(first * page), (last - first) * page,
                                    PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS | MAP_FIXED, -1, 0);
    if (shared != MAP_FAILED) return 0;
    std::perror("the counters cannot be shared");
    std::exit(1);
}
