// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace lacuna::io {

/// The length of a unit in metres: um, mm, cm, m, in or ft.
/// @throw InvalidInput "io.unit"  another name.
double metres_of(std::string_view unit);

/// Whether `metres_of()` knows a unit.
bool is_unit(std::string_view unit);

/// The common unit of two models or meshes that are joined. If only one of them has a declared unit, that
/// unit applies to both. Empty: neither has one.
/// @param a,b            declared units; empty: none.
/// @param what_a,what_b  names of the two, for the message.
/// @throw InvalidInput "io.units_differ"  both have one, and they differ; names both.
std::string common_unit(const std::string& a, const std::string& what_a, const std::string& b,
                        const std::string& what_b);

} // namespace lacuna::io
