// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/large_pages.h>

#include <cstdint>

#include <sys/mman.h>

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
    constexpr std::size_t kPage = 4096; // the smallest page size in use
    auto* const begin = static_cast<volatile char*>(memory);
    for (std::size_t at = 0; at < bytes && !enough.load(std::memory_order_relaxed); at += kPage)
        begin[at] = 0;
}

} // namespace lacuna
