// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/sections.h>
#include <lacuna/mesh/shared/mesh_view.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

/// Common parts of the writer of MSH files. Internal to this folder.
namespace lacuna::io {

/// Writes numbers as text or binary.
struct MshNumbers {
    bool binary;

    template <class Value>
    [[nodiscard]] char* add(char* out, Value value) const
    {
        if (binary) return put(out, value);
        out = put_text(out, value);
        *out++ = ' ';
        return out;
    }
    /// End a line that contains at least one number.
    [[nodiscard]] char* end(char* out) const
    {
        if (!binary) out[-1] = '\n';
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
    /// Append a box and lists of tags to the last line of `text`. Each list follows its length.
    void add_lists(std::string& text, const Eigen::AlignedBox3d& box,
                   std::initializer_list<std::vector<int>> lists) const
    {
        const auto go_on = [&] {
            if (!binary) text.back() = ' ';
        };
        go_on();
        const Vec3 low = box.min(), high = box.max();
        text += line(low.x(), low.y(), low.z(), high.x(), high.y(), high.z());
        for (const std::vector<int>& list : lists) {
            go_on();
            text += line(size_of(list.size()));
            for (const int tag : list) {
                go_on();
                text += line(tag);
            }
        }
    }
    [[nodiscard]] std::size_t room(std::size_t numbers, std::size_t bytes) const
    {
        return binary ? bytes : numbers * kNumberBytes + 1;
    }
    /// Separates a block of numbers from the end of its section.
    [[nodiscard]] std::string gap() const { return binary ? "\n" : ""; }
    static std::uint64_t size_of(std::size_t count) { return count; }
};

struct PhysicalName {
    int dimension;
    int tag;
    std::string name;
};

/// The physical groups of a view's entities.
struct MshGroups {
    std::vector<std::vector<int>> tags; ///< group tags of each entity, ascending
    std::vector<PhysicalName> names;
    std::string changed{}; ///< note about groups that lack elements; empty: none
};
/// Assign physical groups to entities.
/// @param used  whether an entity has elements
/// @param all   each entity gets all its groups, not only one
MshGroups msh_groups(const mesh::MeshView& view, const std::vector<char>& used, bool all);

} // namespace lacuna::io
