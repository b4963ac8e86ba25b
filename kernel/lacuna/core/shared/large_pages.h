// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

namespace lacuna {

/// Ask the system to back this memory with large pages, before its first use: 100 MB then cause about 50 page
/// faults instead of 25,000. A hint only: results do not depend on it.
void use_large_pages(void* memory, std::size_t bytes);

/// Have the system clear pages that were not written yet, until all are cleared or `enough` is set. The first
/// writer then does not wait for page faults. The contents of the memory are lost.
void clear_pages(void* memory, std::size_t bytes, const std::atomic<bool>& enough);

/// A vector of `count` values, in large pages if it is large.
template <class Value>
void reserve_large(std::vector<Value>& values, std::size_t count)
{
    if (count <= values.capacity()) return;
    values.reserve(count);
    use_large_pages(values.data() + values.size(), (count - values.size()) * sizeof(Value));
}

} // namespace lacuna
