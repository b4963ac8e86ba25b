// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/sections.h>

#include <lacuna/core/parallel.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <memory>

namespace lacuna::io {
namespace {

/// A buffer that stays in the second-level cache between being filled and being written: measured 20 ms for
/// 109 MB in blocks of 256 KiB to 1 MiB, 24 ms in blocks of 64 KiB or 4 MiB.
constexpr std::size_t kBufferBytes = std::size_t(512) * 1024;

struct Chunk {
    const Section* section;
    std::size_t begin, end;
    std::uint64_t offset; ///< in the file, where sizes are exact
};

std::vector<Chunk> cut(const std::vector<Section>& sections)
{
    std::vector<Chunk> chunks;
    std::uint64_t offset = 0;
    for (const Section& section : sections) {
        // The text goes with the first records.
        const std::size_t step = section.record_bytes == 0
                                     ? 1
                                     : std::max<std::size_t>(1, kBufferBytes / section.record_bytes);
        std::size_t begin = 0;
        do {
            const std::size_t end = std::min(begin + step, section.records);
            chunks.push_back({&section, begin, end, offset});
            offset += (begin == 0 ? section.text.size() : 0) + (end - begin) * section.record_bytes;
            begin = end;
        } while (begin < section.records);
    }
    return chunks;
}

struct Buffer {
    std::unique_ptr<char[]> bytes;
    std::size_t room = 0;

    std::string_view filled(const Chunk& chunk)
    {
        const Section& section = *chunk.section;
        const std::size_t text = chunk.begin == 0 ? section.text.size() : 0;
        const std::size_t needed = text + (chunk.end - chunk.begin) * section.record_bytes;
        if (needed > room) {
            bytes = std::make_unique_for_overwrite<char[]>(needed);
            room = needed;
        }
        char* end = std::copy_n(section.text.data(), text, bytes.get());
        if (chunk.end > chunk.begin) end = section.fill(chunk.begin, chunk.end, end);
        return {bytes.get(), static_cast<std::size_t>(end - bytes.get())};
    }
};

} // namespace

void write_sections(WholeFile& file, const std::vector<Section>& sections, Sizes sizes,
                    const RunContext& context)
{
    const std::vector<Chunk> chunks = cut(sections);
    if (sizes == Sizes::exact) {
        // Every chunk knows its place: while one thread fills, another writes.
        const auto grain = std::max<std::size_t>(
            1, chunks.size() / (4 * static_cast<std::size_t>(thread_count(context))));
        parallel_for(context, chunks.size(), std::min<std::size_t>(grain, 8),
                     [&](std::size_t begin, std::size_t end) {
                         Buffer buffer;
                         for (std::size_t c = begin; c < end; ++c) {
                             check_cancelled(context);
                             file.write_at(chunks[c].offset, buffer.filled(chunks[c]));
                         }
                     });
        return;
    }
    // Places are known once the text before is: fill a wave of chunks together, then write them in order.
    std::vector<Buffer> buffers(4 * static_cast<std::size_t>(thread_count(context)));
    std::vector<std::string_view> filled(buffers.size());
    for (std::size_t first = 0; first < chunks.size(); first += buffers.size()) {
        const std::size_t count = std::min(buffers.size(), chunks.size() - first);
        parallel_for(context, count, 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) filled[i] = buffers[i].filled(chunks[first + i]);
        });
        for (std::size_t i = 0; i < count; ++i) file.append(filled[i]);
    }
}

char* put_text(char* out, double value) { return std::to_chars(out, out + kNumberBytes, value).ptr; }

char* put_text(char* out, long long value) { return std::to_chars(out, out + kNumberBytes, value).ptr; }

std::string text_of(double value)
{
    char text[kNumberBytes];
    return {text, put_text(text, value)};
}

} // namespace lacuna::io
