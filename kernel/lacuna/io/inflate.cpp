// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/inflate.h>

#include <zlib.h>

namespace lacuna::io {

std::optional<std::string> inflate(std::string_view bytes, std::uint64_t size)
{
    if (size > kDeflateRatio * (bytes.size() + 64)) return {};
    std::string plain(size, '\0');
    uLongf found = size;
    const int status = ::uncompress(reinterpret_cast<Bytef*>(plain.data()), &found,
                                    reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
    if (status != Z_OK || found != size) return {};
    return plain;
}

} // namespace lacuna::io
