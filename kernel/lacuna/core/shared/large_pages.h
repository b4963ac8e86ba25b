// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <vector>

namespace lacuna {

/// Ask the system to use large pages for this memory: 100 MB then cause about 50 page faults instead of
/// 25,000. Call this before the memory is first used. The system may ignore it; results do not depend on it.
void use_large_pages(void* memory, std::size_t bytes);

/// Write a byte to each page, so that the system clears the page now and the first writer need not wait for
/// page faults. Stops when all pages are done or `enough` is set. @pre the memory holds nothing yet
void clear_pages(void* memory, std::size_t bytes, const std::atomic<bool>& enough);

/// Reserve memory for `count` values in a vector, in large pages if it is large.
template <class Value>
void reserve_large(std::vector<Value>& values, std::size_t count)
{
    if (count <= values.capacity()) return;
    values.reserve(count);
    use_large_pages(values.data() + values.size(), (count - values.size()) * sizeof(Value));
}

/// Make room for `more` values at the end of a vector. Room grows geometrically, so that many small additions
/// do not each copy all values.
template <class Value>
void make_room(std::vector<Value>& values, std::size_t more)
{
    const std::size_t needed = values.size() + more;
    if (needed > values.capacity()) reserve_large(values, std::max(needed, 2 * values.capacity()));
}

} // namespace lacuna
