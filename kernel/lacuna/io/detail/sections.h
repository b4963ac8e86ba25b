// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/shared/team.h>
#include <lacuna/io/whole_file.h>

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

/// Files as a list of sections, filled in parallel. Internal to this folder.
namespace lacuna::io {

/// Puts records [begin, end) at `out`, returns where they end.
using Fill = std::function<char*(std::size_t begin, std::size_t end, char* out)>;

/// One record after the other by `put_one(i, out)`.
template <class PutOne>
Fill each(PutOne put_one)
{
    return [put_one](std::size_t begin, std::size_t end, char* out) {
        for (std::size_t i = begin; i < end; ++i) out = put_one(i, out);
        return out;
    };
}

/// A piece of a file: some text, then records without number.
struct Section {
    std::string text;
    std::size_t records = 0;
    std::size_t record_bytes = 0; ///< of every record; in files of `Sizes::varying` no record is longer
    Fill fill;
};

enum class Sizes { exact, varying };

/// Write a file of sections one behind the other, whole or not at all. Memory is bounded by a few buffers,
/// whatever the file's size; the bytes are the same for any thread count. Progress is told in shares.
///
/// A team fills and writes a share of each section; it is rank 0's path that is written to. Files whose
/// records vary are filled in rounds, a share of each by each, since a share is placed once those before it
/// are filled.
/// @throw  as `WholeFile`; TeamFailed
void write_file(const OutputPath& path, const std::vector<Section>& sections, Sizes sizes,
                const RunContext& context, const Team* team = nullptr);

/// One of several files, whose sizes are exact: its sections are made when it is written.
struct FileOfSet {
    OutputPath path;
    std::function<std::vector<Section>()> sections;
};

/// Write files and one that names them: all of them whole, or none is there. A team shares out the files.
/// @param head  text of the last
/// @throw  as `write_file()`
void write_files(const std::vector<FileOfSet>& files, const OutputPath& head_path, const std::string& head,
                 const RunContext& context, const Team* team = nullptr);

/// Bytes of a value as they lie in memory.
template <class Value>
char* put(char* out, const Value& value)
{
    std::memcpy(out, &value, sizeof value);
    return out + sizeof value;
}

template <class Value>
void put(std::string& out, const Value& value)
{
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Bytes of a value, the highest first.
template <class Value>
char* put_big(char* out, Value value)
{
    char* end = put(out, value);
    if (std::endian::native == std::endian::little) std::reverse(out, end);
    return end;
}

/// A number as text, the shortest that reads back to the same bits; the same in every locale.
char* put_text(char* out, double value);
char* put_text(char* out, long long value);
template <std::integral Whole>
char* put_text(char* out, Whole value)
{
    return put_text(out, static_cast<long long>(value));
}
std::string text_of(double value);

/// No number is longer as text, a separator included.
inline constexpr std::size_t kNumberBytes = 26;

} // namespace lacuna::io
