// SPDX-License-Identifier: MIT
#include <lacuna/view/detail/png.h>

#include <lacuna/view/detail/deflate.h>

namespace lacuna::view {

namespace {

void add_number(std::string& bytes, std::uint32_t number)
{
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 0xff);
}

void add_chunk(std::string& bytes, const std::string& type, const std::string& content)
{
    add_number(bytes, static_cast<std::uint32_t>(content.size()));
    bytes += type + content;
    add_number(bytes, crc32(type + content));
}

} // namespace

std::string png_of(const Image& image)
{
    constexpr char kEightBits = 8, kColours = 2, kUp = 2;
    std::string bytes = "\x89PNG\r\n\x1a\n";
    std::string header;
    add_number(header, static_cast<std::uint32_t>(image.width));
    add_number(header, static_cast<std::uint32_t>(image.height));
    header += {kEightBits, kColours, 0, 0, 0};
    add_chunk(bytes, "IHDR", header);
    const std::size_t row = 3 * static_cast<std::size_t>(image.width);
    std::string rows;
    rows.reserve((row + 1) * static_cast<std::size_t>(image.height));
    for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y) {
        rows += kUp;
        for (std::size_t x = 0; x < row; ++x) {
            const std::uint8_t above = y > 0 ? image.rgb[(y - 1) * row + x] : 0;
            rows += static_cast<char>(image.rgb[y * row + x] - above);
        }
    }
    add_chunk(bytes, "IDAT", deflated(rows));
    add_chunk(bytes, "IEND", "");
    return bytes;
}

} // namespace lacuna::view
