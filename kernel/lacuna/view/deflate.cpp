// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/view/detail/deflate.h>

#include <algorithm>
#include <array>

#ifdef LACUNA_WITH_ZLIB
#include <zlib.h>
#endif

namespace lacuna::view {

#ifdef LACUNA_WITH_ZLIB

std::string deflated(std::string_view bytes)
{
    uLongf size = ::compressBound(bytes.size());
    std::string stream(size, '\0');
    if (::compress2(reinterpret_cast<Bytef*>(stream.data()), &size,
                    reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(),
                    Z_DEFAULT_COMPRESSION) != Z_OK)
        throw BackendError("view.deflate", "zlib could not compress the picture or page");
    stream.resize(size);
    return stream;
}

#else

std::string deflated(std::string_view bytes)
{
    constexpr std::size_t kBlock = 65535; // the most that a stored block holds
    constexpr std::uint32_t kAdler = 65521;
    std::string stream = {'\x78', '\x01'};
    std::uint32_t a = 1, b = 0;
    for (std::size_t at = 0; at == 0 || at < bytes.size(); at += kBlock) {
        const std::string_view block = bytes.substr(at, kBlock);
        const auto size = static_cast<std::uint32_t>(block.size());
        stream += at + kBlock >= bytes.size() ? '\1' : '\0';
        for (const std::uint32_t word : {size, ~size}) {
            stream += static_cast<char>(word & 0xff);
            stream += static_cast<char>(word >> 8 & 0xff);
        }
        stream += block;
        for (const char c : block) {
            a = (a + static_cast<unsigned char>(c)) % kAdler;
            b = (b + a) % kAdler;
        }
    }
    for (const std::uint32_t half : {b, a}) {
        stream += static_cast<char>(half >> 8);
        stream += static_cast<char>(half & 0xff);
    }
    return stream;
}

#endif

std::uint32_t crc32(std::string_view bytes)
{
    static constexpr std::array<std::uint32_t, 256> kTable = [] {
        std::array<std::uint32_t, 256> table{};
        for (std::uint32_t n = 0; n < 256; ++n) {
            std::uint32_t c = n;
            for (int bit = 0; bit < 8; ++bit) c = (c & 1) != 0 ? 0xedb88320U ^ (c >> 1) : c >> 1;
            table[n] = c;
        }
        return table;
    }();
    std::uint32_t crc = 0xffffffffU;
    for (const char c : bytes) crc = kTable[(crc ^ static_cast<unsigned char>(c)) & 0xff] ^ (crc >> 8);
    return ~crc;
}

} // namespace lacuna::view
