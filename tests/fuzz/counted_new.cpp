// SPDX-License-Identifier: MIT
#include "fuzz/counted_new.h"

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>

#include <malloc.h>

namespace lacuna::fuzz {

namespace {

std::atomic<std::size_t> now{0}, most{0}, limit{SIZE_MAX};

void* give(std::size_t size)
{
    if (size > limit || now + size > limit) return nullptr;
    void* const place = std::malloc(size);
    if (place == nullptr) return nullptr;
    const std::size_t held = now += malloc_usable_size(place);
    for (std::size_t before = most; before < held && !most.compare_exchange_weak(before, held);) {}
    return place;
}

} // namespace

std::size_t held() { return now; }
std::size_t most_held() { return most; }
void count_most_anew() { most = now.load(); }
void limit_held(std::size_t bytes) { limit = bytes; }

} // namespace lacuna::fuzz

void* operator new(std::size_t size)
{
    void* const place = lacuna::fuzz::give(size);
    if (place == nullptr) throw std::bad_alloc();
    return place;
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return lacuna::fuzz::give(size); }
void operator delete(void* place) noexcept
{
    if (place != nullptr) lacuna::fuzz::now -= malloc_usable_size(place);
    std::free(place);
}
void operator delete(void* place, std::size_t) noexcept { operator delete(place); }
