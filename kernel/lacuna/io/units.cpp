// SPDX-License-Identifier: MIT
#include <lacuna/io/shared/units.h>

#include <lacuna/core/error.h>

#include <algorithm>
#include <utility>

namespace lacuna::io {

namespace {

constexpr std::pair<std::string_view, double> kUnits[] = {{"um", 1e-6}, {"mm", 1e-3},   {"cm", 1e-2},
                                                          {"m", 1.0},   {"in", 0.0254}, {"ft", 0.3048}};

} // namespace

bool is_unit(std::string_view unit)
{
    return std::ranges::any_of(kUnits, [&](const auto& known) { return known.first == unit; });
}

double metres_of(std::string_view unit)
{
    for (const auto& [name, metres] : kUnits)
        if (name == unit) return metres;
    throw InvalidInput(Message("io.unit", "the unit \"{}\" is unknown", found(unit))
                           .remedy("use one of {}", needed("um, mm, cm, m, in, ft")));
}

std::string common_unit(const std::string& a, const std::string& what_a, const std::string& b,
                        const std::string& what_b)
{
    if (a.empty() || b.empty() || a == b) return a.empty() ? b : a;
    throw InvalidInput(
        Message("io.units_differ", "{} is in {}, and {} is in {}", what_a, found(a), what_b, found(b))
            .remedy("declare the same unit where both are loaded"));
}

} // namespace lacuna::io
