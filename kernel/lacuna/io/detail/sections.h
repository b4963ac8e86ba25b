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

/// Files as a list of sections, which are filled in parallel. Internal to this folder.
namespace lacuna::io {

/// Writes the records [begin, end) to `out` and returns their end.
using Fill = std::function<char*(std::size_t begin, std::size_t end, char* out)>;

/// Write records one by one with `put_one(i, out)`.
template <class PutOne>
Fill each(PutOne put_one)
{
    return [put_one](std::size_t begin, std::size_t end, char* out) {
        for (std::size_t i = begin; i < end; ++i) out = put_one(i, out);
        return out;
    };
}

/// A piece of a file: text, followed by any number of records.
struct Section {
    std::string text;
    std::size_t records = 0;
    std::size_t record_bytes = 0; ///< size of each record; with `Sizes::varying` the maximum
    Fill fill;
};

enum class Sizes { exact, varying };

/// Write the sections of a file in order; the file is complete or does not appear. Memory is limited to a few
/// buffers, whatever the file's size. The bytes do not depend on the number of threads. Progress is reported
/// as a fraction.
///
/// Each process of a team fills and writes a share of each section, to the path of rank 0. If records vary in
/// size, the file is written in rounds in which each process writes one share, because the position of a
/// share is known only after the shares before it are filled.
/// @throw  as `WholeFile`; TeamFailed
void write_file(const OutputPath& path, const std::vector<Section>& sections, Sizes sizes,
                const RunContext& context, const Team* team = nullptr);

/// One of several files of exact sizes; its sections are created when it is written.
struct FileOfSet {
    OutputPath path;
    std::function<std::vector<Section>()> sections;
};

/// Write files and a head file that names them: all of them or none. A team distributes the files.
/// @param head  text of the head file
/// @throw  as `write_file()`
void write_files(const std::vector<FileOfSet>& files, const OutputPath& head_path, const std::string& head,
                 const RunContext& context, const Team* team = nullptr);

/// The bytes of a value in native order.
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

/// The bytes of a value, most significant first.
template <class Value>
char* put_big(char* out, Value value)
{
    char* end = put(out, value);
    if (std::endian::native == std::endian::little) std::reverse(out, end);
    return end;
}

/// The shortest text of a number that reads back to the same bits; the same in every locale.
char* put_text(char* out, double value);
char* put_text(char* out, long long value);
template <std::integral Whole>
char* put_text(char* out, Whole value)
{
    return put_text(out, static_cast<long long>(value));
}
inline char* put_text(char* out, std::string_view words) { return words.copy(out, words.size()) + out; }
/// Words and numbers, one after the other.
template <class First, class Second, class... Rest>
char* put_text(char* out, const First& first, const Second& second, const Rest&... rest)
{
    return put_text(put_text(out, first), second, rest...);
}
std::string text_of(double value);

/// Maximum length of a number as text, including a separator.
inline constexpr std::size_t kNumberBytes = 26;

} // namespace lacuna::io
