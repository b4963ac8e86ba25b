// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/error.h>

#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <vector>

namespace lacuna::test {

inline bool has(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

/// The code of the error that work ends with, its message holding all the words; "done" without one.
inline std::string refusal(const std::function<void()>& work, const std::vector<std::string>& words = {})
{
    try {
        work();
    } catch (const Error& error) {
        const std::string what = error.what();
        for (const std::string& word : words) {
            CAPTURE(what);
            CAPTURE(word);
            CHECK(what.find(word) != std::string::npos);
        }
        return error.code();
    }
    return "done";
}

} // namespace lacuna::test
