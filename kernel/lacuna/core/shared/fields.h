// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <type_traits>

namespace lacuna {

/// Converts to any type. Only used to count the values that initialise a struct, so it has no definition.
struct AnyValue {
    template <class T>
    operator T() const; // NOLINT(google-explicit-constructor)
};

/// Number of members of a struct without base classes, which is the largest number of values that can
/// initialise it.
template <class T, class... Values>
consteval std::size_t field_count()
{
    if constexpr (requires { T{Values{}..., AnyValue{}}; })
        return field_count<T, Values..., AnyValue>();
    else
        return sizeof...(Values);
}

/// Call `visit(member)` for each member of a struct, in the order of their declaration.
template <class T, class Visit>
void each_field(T& of, Visit&& visit)
{
    constexpr std::size_t kCount = field_count<std::remove_const_t<T>>();
    static_assert(kCount >= 1 && kCount <= 10);
    const auto all = [&](auto&... fields) { (visit(fields), ...); };
    if constexpr (kCount == 1) {
        auto& [a] = of;
        all(a);
    } else if constexpr (kCount == 2) {
        auto& [a, b] = of;
        all(a, b);
    } else if constexpr (kCount == 3) {
        auto& [a, b, c] = of;
        all(a, b, c);
    } else if constexpr (kCount == 4) {
        auto& [a, b, c, d] = of;
        all(a, b, c, d);
    } else if constexpr (kCount == 5) {
        auto& [a, b, c, d, e] = of;
        all(a, b, c, d, e);
    } else if constexpr (kCount == 6) {
        auto& [a, b, c, d, e, f] = of;
        all(a, b, c, d, e, f);
    } else if constexpr (kCount == 7) {
        auto& [a, b, c, d, e, f, g] = of;
        all(a, b, c, d, e, f, g);
    } else if constexpr (kCount == 8) {
        auto& [a, b, c, d, e, f, g, h] = of;
        all(a, b, c, d, e, f, g, h);
    } else if constexpr (kCount == 9) {
        auto& [a, b, c, d, e, f, g, h, i] = of;
        all(a, b, c, d, e, f, g, h, i);
    } else {
        auto& [a, b, c, d, e, f, g, h, i, j] = of;
        all(a, b, c, d, e, f, g, h, i, j);
    }
}

} // namespace lacuna
