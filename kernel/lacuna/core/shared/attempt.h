// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/error.h>

#include <exception>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

namespace lacuna {

/// What an action returned, or the error by which it was refused.
template <class T>
struct Outcome {
    std::optional<T> value; ///< empty if the action was refused
    std::optional<Message> why;
    std::exception_ptr error;

    explicit operator bool() const { return value.has_value(); }
    T& operator*() { return *value; }
    const T& operator*() const { return *value; }
    T* operator->() { return &*value; }
    const T* operator->() const { return &*value; }
    [[noreturn]] void raise() const { std::rethrow_exception(error); }
};

/// Do an action that errors of type `Refusal` may refuse. Other errors, and `Cancelled`, pass through.
template <class Refusal = Error, class Do>
auto attempt(const Do& action)
{
    using Result = decltype(action());
    using Value = std::conditional_t<std::is_void_v<Result>, std::monostate, std::decay_t<Result>>;
    Outcome<Value> outcome;
    try {
        if constexpr (std::is_void_v<Result>) {
            action();
            outcome.value.emplace();
        } else {
            outcome.value = action();
        }
    } catch (const Cancelled&) {
        throw;
    } catch (const Refusal& error) {
        outcome.why = error.message();
        outcome.error = std::current_exception();
    }
    return outcome;
}

/// The result of an action; empty if it is refused, for instance because the faces do not permit it.
template <class Do>
auto unless_refused(const Do& action)
{
    return attempt(action).value;
}

} // namespace lacuna
