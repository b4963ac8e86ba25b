// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

namespace lacuna {

/// Ask the system for large pages where memory is, before it is first touched: 100 MB then take some 50 page
/// faults and not 25,000. A wish, which changes nothing but time.
void use_large_pages(void* memory, std::size_t bytes);

/// Have the system clear the pages of memory that nothing was written to yet, until all are or it is enough.
/// So who writes there need not wait for it. What the memory holds is lost.
void clear_pages(void* memory, std::size_t bytes, const std::atomic<bool>& enough);

/// Room for `count` values, in large pages where there are many.
template <class Value>
void reserve_large(std::vector<Value>& values, std::size_t count)
{
    if (count <= values.capacity()) return;
    values.reserve(count);
    use_large_pages(values.data() + values.size(), (count - values.size()) * sizeof(Value));
}

} // namespace lacuna
