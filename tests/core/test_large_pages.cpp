// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/large_pages.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <vector>

using namespace lacuna;

TEST_CASE("room is that of the values asked for, and keeps those that were there")
{
    for (const std::size_t count : {std::size_t(0), std::size_t(3), std::size_t(1) << 20}) {
        std::vector<double> values{1, 2};
        reserve_large(values, count);
        CHECK(values.capacity() >= count);
        CHECK(values == std::vector<double>{1, 2});
    }
}

TEST_CASE("pages that are cleared are written to in their memory alone, and not once it is enough")
{
    constexpr std::size_t kPage = 4096;
    for (const std::size_t bytes : {std::size_t(0), std::size_t(1), kPage, 5 * kPage + 7}) {
        CAPTURE(bytes);
        std::vector<char> memory(bytes + 2 * kPage, 'x');
        std::atomic<bool> enough{true};
        clear_pages(memory.data() + kPage, bytes, enough);
        CHECK(std::count(memory.begin(), memory.end(), 'x') == static_cast<long>(memory.size()));
        enough = false;
        clear_pages(memory.data() + kPage, bytes, enough);
        const auto begin = memory.begin() + kPage, end = begin + static_cast<long>(bytes);
        CHECK(std::count(begin, end, 0) == static_cast<long>((bytes + kPage - 1) / kPage));
        CHECK(std::count(memory.begin(), begin, 'x') == begin - memory.begin());
        CHECK(std::count(end, memory.end(), 'x') == memory.end() - end);
    }
}
