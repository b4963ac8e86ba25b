// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/sections.h>

#include <algorithm>
#include <bit>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// What VTK files are made of. Internal to this folder.
namespace lacuna::io {

using Fill = std::function<char*(std::size_t, std::size_t, char*)>;

/// One record after the other by `put_one(i, out)`.
template <class PutOne>
Fill each(PutOne put_one)
{
    return [put_one](std::size_t begin, std::size_t end, char* out) {
        for (std::size_t i = begin; i < end; ++i) out = put_one(i, out);
        return out;
    };
}

/// Groups by name with what they consist of: arrays that belong to the whole file.
using VtkTable = std::vector<std::pair<std::string, std::vector<int>>>;

// ---- XML

/// An array of numbers in the order of this machine's bytes, which the head names.
struct VtuArray {
    enum class Place { points, cells, point_data, cell_data };
    Place place;
    std::string attributes;
    std::size_t bytes;
    std::vector<Section> sections;
};

/// A file of arrays: numbers raw behind the XML.
std::vector<Section> vtu_file(std::size_t points, std::size_t cells, std::vector<VtuArray> arrays,
                              const VtkTable& table);

/// What a file of pieces says of their arrays, and then of their names.
std::string pvtu_head(const std::vector<VtuArray>& arrays, int ghosts);
std::string pvtu_end(const std::vector<std::string>& pieces);
/// "mesh_2.vtu" of "folder/mesh.pvtu" and 2.
std::string piece_name(const std::string& path, std::size_t number);

// ---- Legacy

/// Version, title and, if there are names, the table.
std::string vtk_head(const VtkTable& table, bool binary);
/// A name without blanks: other characters as VTK has them, %20.
std::string vtk_name(std::string_view name);

/// Legacy files hold the highest byte first.
template <class Value>
char* put_big(char* out, Value value)
{
    char* end = put(out, value);
    if (std::endian::native == std::endian::little) std::reverse(out, end);
    return end;
}

template <class Value>
char* put_number(char* out, Value value, bool binary)
{
    if (binary) return put_big(out, value);
    if constexpr (std::is_integral_v<Value>)
        out = put_text(out, static_cast<long long>(value));
    else
        out = put_text(out, value);
    *out++ = ' ';
    return out;
}

inline char* end_line(char* out, bool binary)
{
    if (!binary) *out++ = '\n';
    return out;
}

} // namespace lacuna::io
