// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/large_pages.h>

#include <cstdint>

#include <sys/mman.h>
#include <unistd.h>

namespace lacuna {

void use_large_pages(void* memory, std::size_t bytes)
{
    // Size of a large page on x86 and most ARM processors. On other processors the request has no effect.
    constexpr std::size_t kLarge = std::size_t(1) << 21;
    const auto begin = (reinterpret_cast<std::uintptr_t>(memory) + kLarge - 1) / kLarge * kLarge;
    const auto end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / kLarge * kLarge;
    if (begin >= end) return;
    static_cast<void>(::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE));
}

void clear_pages(void* memory, std::size_t bytes, const std::atomic<bool>& enough)
{
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    auto* const begin = static_cast<volatile char*>(memory);
    for (std::size_t at = 0; at < bytes && !enough.load(std::memory_order_relaxed); at += page) begin[at] = 0;
}

} // namespace lacuna
