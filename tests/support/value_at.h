// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include <cstring>
#include <string>

namespace lacuna {

/// The value whose bytes, in this machine's order, begin at a place of a binary file.
template <class Value>
Value at(const std::string& bytes, std::size_t place)
{
    Value value;
    REQUIRE(place + sizeof value <= bytes.size());
    std::memcpy(&value, bytes.data() + place, sizeof value);
    return value;
}

} // namespace lacuna
