// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/inflate.h>

#ifdef LACUNA_WITH_ZLIB
#include <zlib.h>
#endif

namespace lacuna::io {

#ifdef LACUNA_WITH_ZLIB

bool can_inflate() { return true; }

std::optional<std::string> inflate(std::string_view bytes, std::uint64_t size)
{
    constexpr std::uint64_t kMostRatio = 1032; // of deflate
    if (size > kMostRatio * (bytes.size() + 64)) return {};
    std::string plain(size, '\0');
    uLongf found = size;
    const int status = ::uncompress(reinterpret_cast<Bytef*>(plain.data()), &found,
                                    reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
    if (status != Z_OK || found != size) return {};
    return plain;
}

#else

bool can_inflate() { return false; }

std::optional<std::string> inflate(std::string_view, std::uint64_t) { return {}; }

#endif

} // namespace lacuna::io
