// SPDX-License-Identifier: MIT
#include <lacuna/view/detail/base64.h>

#include <lacuna/view/detail/deflate.h>

#include <cstdint>

namespace lacuna::view {

std::string base64(std::string_view bytes)
{
    constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k)
            three = three << 8 | (at + k < bytes.size() ? static_cast<unsigned char>(bytes[at + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += at + k <= bytes.size() ? kLetters[three >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string pack(std::span<const Index> numbers, std::size_t stride, bool linear)
{
    std::string bytes;
    bytes.reserve(numbers.size() * 2);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        std::int64_t expected = 0;
        if (linear && i >= 2 * stride)
            expected = 2 * std::int64_t{numbers[i - stride]} - numbers[i - 2 * stride];
        else if (i >= stride)
            expected = numbers[i - stride];
        else if (i > 0)
            expected = numbers[i - 1];
        const std::int64_t missed = numbers[i] - expected;
        auto code = static_cast<std::uint64_t>(missed < 0 ? -2 * missed - 1 : 2 * missed);
        for (; code > 127; code >>= 7) bytes += static_cast<char>((code & 127) | 128);
        bytes += static_cast<char>(code);
    }
    return base64(deflated(bytes));
}

} // namespace lacuna::view
