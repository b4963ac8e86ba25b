// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace lacuna {

/// Ask the system for large pages where memory is, before it is first touched: 100 MB then take some 50 page
/// faults and not 25,000. A wish, which changes nothing but time.
void use_large_pages(void* memory, std::size_t bytes);

/// Room for `count` values, in large pages where there are many.
template <class Value>
void reserve_large(std::vector<Value>& values, std::size_t count)
{
    if (count <= values.capacity()) return;
    values.reserve(count);
    use_large_pages(values.data() + values.size(), (count - values.size()) * sizeof(Value));
}

} // namespace lacuna
