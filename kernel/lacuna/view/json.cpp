// SPDX-License-Identifier: MIT
#include <lacuna/view/detail/json.h>

#include <lacuna/core/message.h>

#include <charconv>
#include <cmath>

namespace lacuna::view {

void Json::comma()
{
    if (!first_) text_ += ',';
    first_ = false;
}

Json& Json::begin(char bracket)
{
    comma();
    text_ += bracket;
    first_ = true;
    return *this;
}

Json& Json::end(char bracket)
{
    text_ += bracket;
    first_ = false;
    return *this;
}

Json& Json::raw(std::string_view text)
{
    comma();
    text_ += text;
    return *this;
}

Json& Json::key(std::string_view name)
{
    value(name);
    text_ += ':';
    first_ = true;
    return *this;
}

Json& Json::value(std::string_view text)
{
    comma();
    text_ += '"';
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (code < 0x20 || c == '"' || c == '\\' || c == '<' || c == '>' || c == '&') {
            text_ += formatted("\\u{:04x}", code);
        } else {
            text_ += c;
        }
    }
    text_ += '"';
    return *this;
}

Json& Json::value(const char* text) { return text != nullptr ? value(std::string_view(text)) : raw("null"); }

Json& Json::value(bool truth) { return raw(truth ? "true" : "false"); }

Json& Json::value(double number)
{
    if (!std::isfinite(number)) return raw("null");
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
    return raw({digits, static_cast<std::size_t>(end - digits)});
}

} // namespace lacuna::view
