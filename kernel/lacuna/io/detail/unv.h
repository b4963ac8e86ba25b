// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

/// Common parts of reader and writer of universal files. Internal to this folder.
namespace lacuna::io {

inline constexpr int kUnvNode = 7, kUnvElement = 8; ///< types of group entities; others are ignored

inline constexpr std::string_view kUnvMark = "    -1\n"; ///< begins and ends a dataset

/// Whether an element has a second record, with the orientation of a beam.
inline bool unv_has_orientation(std::int64_t descriptor, int dataset)
{
    return dataset != 71 && (descriptor == 11 || (descriptor >= 21 && descriptor <= 24));
}

} // namespace lacuna::io
