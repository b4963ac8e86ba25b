// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <ranges>
#include <string>
#include <string_view>

namespace lacuna::view {

/// Writes JSON that can be placed inside a `<script>` element: no text in it can end the element. Numbers do
/// not depend on the locale; numbers that are not finite become null.
class Json {
public:
    Json& begin_object() { return begin('{'); }
    Json& end_object() { return end('}'); }
    Json& begin_array() { return begin('['); }
    Json& end_array() { return end(']'); }
    /// Write the key of the next value.
    Json& key(std::string_view name);

    Json& value(std::string_view text);
    Json& value(const char* text); ///< may be null
    Json& value(bool truth);
    Json& value(double number);
    Json& value(std::integral auto number) { return raw(std::to_string(number)); }
    /// Write an array.
    template <std::ranges::input_range Values>
    requires(!std::convertible_to<Values, std::string_view>) Json& value(const Values& values)
    {
        begin_array();
        for (const auto& one : values) value(one);
        return end_array();
    }

    template <class T>
    Json& member(std::string_view name, const T& what)
    {
        return key(name).value(what);
    }
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    Json& begin(char bracket);
    Json& end(char bracket);
    Json& raw(std::string_view text);
    void comma();

    std::string text_;
    /// Whether the next value needs no comma, because brackets were just opened or a key was written.
    bool first_ = true;
};

} // namespace lacuna::view
