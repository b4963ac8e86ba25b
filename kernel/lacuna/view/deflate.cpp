// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/view/detail/deflate.h>

#include <zlib.h>

namespace lacuna::view {

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

std::uint32_t crc32(std::string_view bytes)
{
    return static_cast<std::uint32_t>(
        ::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

} // namespace lacuna::view
