// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/sections.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

/// What MSH files in parts say, of a swept mesh and of a deck. Internal to this folder.
namespace lacuna::io {

/// Puts numbers as text or as they lie in memory.
struct MshNumbers {
    bool binary;

    template <class Value>
    [[nodiscard]] char* add(char* out, Value value) const
    {
        if (binary) return put(out, value);
        if constexpr (std::is_integral_v<Value>)
            out = put_text(out, static_cast<long long>(value));
        else
            out = put_text(out, value);
        *out++ = ' ';
        return out;
    }
    [[nodiscard]] char* end(char* out) const
    {
        if (!binary) *out++ = '\n';
        return out;
    }
    template <class... Value>
    [[nodiscard]] std::string line(Value... values) const
    {
        std::string text(sizeof...(values) * kNumberBytes + 1, '\0');
        char* out = text.data();
        ((out = add(out, values)), ...);
        text.resize(static_cast<std::size_t>(end(out) - text.data()));
        return text;
    }
    [[nodiscard]] std::size_t room(std::size_t numbers, std::size_t bytes) const
    {
        return binary ? bytes : numbers * kNumberBytes + 1;
    }
};

inline std::uint64_t size_of(std::size_t count) { return count; }

/// An entity of one part: a part of another, whose groups it has.
struct MshPartEntity {
    int dimension = 3, tag = 0;
    int parent = 0; ///< of the same dimension
    int part = 0;   ///< from 0
    std::vector<int> physical;
    Eigen::AlignedBox3d box;
};

/// $PartitionedEntities. @param ghosts  tags of the volumes that ghost elements are in, one a part, or none.
std::string msh_partitioned(int parts, const std::vector<int>& ghosts,
                            const std::vector<MshPartEntity>& entities, const MshNumbers& numbers);

/// Elements that are ghosts of the same parts.
struct MshGhosts {
    std::size_t count = 0;
    int part = 0;        ///< whose they are, from 0
    std::vector<int> of; ///< the parts they are ghosts of
    std::function<std::uint64_t(std::size_t i)> number;
};
/// $GhostElements; nothing where there are none.
void add_ghosts(std::vector<Section>& sections, const std::vector<MshGhosts>& ghosts,
                const MshNumbers& numbers);

} // namespace lacuna::io
