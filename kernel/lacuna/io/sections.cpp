// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/sections.h>

#include <lacuna/core/shared/bytes.h>
#include <lacuna/core/shared/parallel.h>
#include <lacuna/core/shared/progress.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstdint>
#include <memory>
#include <numeric>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include <unistd.h>

namespace lacuna::io {
namespace {

/// Size of a buffer, which stays in the second-level cache between being filled and being written. Measured
/// for 109 MB: 20 ms with 256 KiB to 1 MiB, 24 ms with 64 KiB or 4 MiB.
constexpr std::size_t kBufferBytes = std::size_t(512) * 1024;

/// Consecutive records, preceded by the section's text if they are its first.
struct Chunk {
    const Section* section;
    std::string_view text;
    std::size_t begin, end;
    std::uint64_t offset; ///< position in the file, if sizes are exact
    /// If sizes are exact: the chunk writes the bytes [skip, skip + bytes) of its text and records. A record
    /// that lies across the border of two chunks is filled for both.
    std::size_t skip = 0, bytes = 0;

    [[nodiscard]] std::size_t most_bytes() const
    {
        return text.size() + (end - begin) * section->record_bytes;
    }
};

/// This process's share of each section, cut at multiples of `kBufferBytes` in the file, so that writes fill
/// pages. The text of a section precedes its first records.
std::vector<Chunk> cut_exact(const std::vector<Section>& sections, const Team* team)
{
    const bool first = team == nullptr || team->rank == 0;
    std::vector<Chunk> chunks;
    std::uint64_t start = 0; // start of the section in the file
    for (const Section& section : sections) {
        const auto [share_begin, share_end] = share_of(team, section.records);
        const std::uint64_t records = start + section.text.size(), size = section.record_bytes;
        std::string_view text = first ? section.text : std::string_view();
        std::uint64_t at = text.empty() ? records + share_begin * size : start;
        const std::uint64_t end = std::max(records, records + share_end * size);
        while (at < end) {
            const std::uint64_t next = std::min((at / kBufferBytes + 1) * kBufferBytes, end);
            Chunk chunk{&section, {}, share_begin, share_begin, at, 0, static_cast<std::size_t>(next - at)};
            if (at < records) {
                chunk.text = text.substr(static_cast<std::size_t>(at - start));
                if (next < records) chunk.text = chunk.text.substr(0, chunk.bytes);
            } else {
                chunk.begin = static_cast<std::size_t>((at - records) / size);
                chunk.skip = static_cast<std::size_t>((at - records) % size);
            }
            if (next > records) chunk.end = static_cast<std::size_t>((next - records + size - 1) / size);
            chunks.push_back(chunk);
            at = next;
        }
        start = records + section.records * size;
    }
    return chunks;
}

std::uint64_t size_of(const std::vector<Section>& sections)
{
    std::uint64_t bytes = 0;
    for (const Section& section : sections)
        bytes += section.text.size() + section.records * section.record_bytes;
    return bytes;
}

/// Split sections with records of varying size into pieces. The text of a section precedes its first records.
std::vector<Chunk> cut(const std::vector<Section>& sections)
{
    std::vector<Chunk> chunks;
    for (const Section& section : sections) {
        const std::size_t step = section.record_bytes == 0
                                     ? 1
                                     : std::max<std::size_t>(1, kBufferBytes / section.record_bytes);
        std::string_view text = section.text;
        for (std::size_t begin = 0; begin < section.records || !text.empty(); begin += step, text = {})
            chunks.push_back({&section, text, begin, std::min(begin + step, section.records), 0});
    }
    return chunks;
}

struct Buffer {
    std::unique_ptr<char[]> bytes;
    std::size_t room = 0;

    std::string_view filled(const Chunk& chunk)
    {
        const std::size_t needed = chunk.most_bytes();
        if (needed > room) {
            bytes = std::make_unique_for_overwrite<char[]>(needed);
            room = needed;
        }
        char* end = std::copy_n(chunk.text.data(), chunk.text.size(), bytes.get());
        if (chunk.end > chunk.begin) end = chunk.section->fill(chunk.begin, chunk.end, end);
        return {bytes.get(), static_cast<std::size_t>(end - bytes.get())};
    }
};

/// Reports progress in steps of one percent, on the thread that called the writer.
class Share {
public:
    Share(const RunContext& context, std::string stage, std::size_t count)
        : context_(context), stage_(std::move(stage)), count_(std::max<std::size_t>(count, 1))
    {
        report_progress(context_, stage_);
    }
    void add(std::size_t done)
    {
        const std::size_t now = done_ += done;
        if (std::this_thread::get_id() != thread_ || 100 * now < (told_ + 1) * count_) return;
        told_ = 100 * now / count_;
        report_progress(context_, stage_, static_cast<double>(told_) / 100);
    }

private:
    const RunContext& context_;
    std::string stage_;
    std::size_t count_;
    std::atomic<std::size_t> done_ = 0;
    std::size_t told_ = 0; ///< hundredths
    std::thread::id thread_ = std::this_thread::get_id();
};

using WriteAt = std::function<void(std::uint64_t offset, std::string_view bytes)>;

/// Write chunks whose offsets are known: while one thread fills, another writes.
void write_exact(const std::vector<Chunk>& chunks, const WriteAt& write, Share& share,
                 const RunContext& context)
{
    const auto grain = std::max<std::size_t>(1, chunks.size() /
                                                    (4 * static_cast<std::size_t>(thread_count(context))));
    parallel_for(context, chunks.size(), std::min<std::size_t>(grain, 8),
                 [&](std::size_t begin, std::size_t end) {
                     Buffer buffer;
                     for (std::size_t c = begin; c < end; ++c) {
                         check_cancelled(context);
                         const std::string_view all = buffer.filled(chunks[c]);
                         write(chunks[c].offset, all.substr(chunks[c].skip, chunks[c].bytes));
                         share.add(1);
                     }
                 });
}

/// Write chunks whose offsets are known only after the text before them is filled. Chunks are filled in
/// rounds, and the chunks of a round are written in order. In a team, the processes share each round. They
/// exchange the lengths of their chunks before they write, so that nothing is filled twice.
void write_varying(const std::vector<Chunk>& chunks, const WriteAt& write, Share& share,
                   const RunContext& context, const Team* team)
{
    // Number of chunks in a round. With a team, a round has at most 64 MB, about half of it text. More would
    // take memory, less would add rounds. Not measured.
    const std::size_t most = team != nullptr ? 128 : 4 * static_cast<std::size_t>(thread_count(context));
    std::uint64_t offset = 0;
    std::vector<Buffer> buffers(std::min(most, chunks.size()));
    std::vector<std::string_view> filled(buffers.size());
    const std::size_t round = most * static_cast<std::size_t>(team != nullptr ? team->size : 1);
    for (std::size_t first = 0; first < chunks.size(); first += round) {
        const auto [begin, end] = share_of(team, std::min(round, chunks.size() - first));
        const std::size_t count = end - begin;
        parallel_for(context, count, 1, [&, from = first + begin](std::size_t low, std::size_t high) {
            for (std::size_t i = low; i < high; ++i) filled[i] = buffers[i].filled(chunks[from + i]);
        });
        check_cancelled(context);
        std::uint64_t length = 0;
        for (std::size_t i = 0; i < count; ++i) length += filled[i].size();
        Writer own;
        own(length);
        const auto lengths = gathered<std::uint64_t>(team, std::move(own));
        const std::ptrdiff_t before = team != nullptr ? team->rank : 0; // processes before this one
        std::uint64_t at = std::accumulate(lengths.begin(), lengths.begin() + before, offset);
        offset = std::accumulate(lengths.begin(), lengths.end(), offset);
        for (std::size_t i = 0; i < count; at += filled[i++].size()) write(at, filled[i]);
        share.add(std::min(round, chunks.size() - first));
    }
}

void write_sections(const std::vector<Section>& sections, Sizes sizes, const WriteAt& write,
                    const std::string& stage, const RunContext& context, const Team* team)
{
    const std::vector<Chunk> chunks = sizes == Sizes::exact ? cut_exact(sections, team) : cut(sections);
    Share share(context, stage, chunks.size());
    if (sizes == Sizes::exact)
        write_exact(chunks, write, share, context);
    else
        write_varying(chunks, write, share, context, team);
    report_progress(context, stage, 1); // another thread may have written the last chunk
}

/// Reserve space for a whole file in steps, between which the host can cancel: for a file in memory,
/// reserving takes time.
void reserve(WholeFile& file, std::uint64_t bytes, const RunContext& context)
{
    constexpr std::uint64_t kStep = std::uint64_t(256) << 20; // takes tens of milliseconds in memory; not
                                                              // measured
    for (std::uint64_t begin = 0; begin < bytes; begin += kStep) {
        check_cancelled(context);
        file.reserve(begin, std::min(begin + kStep, bytes));
    }
}

/// Files of rank 0 to which all processes of a team write.
class SharedFiles {
public:
    SharedFiles(const std::vector<OutputPath>& paths, const Team* team) : team_(team)
    {
        if (team == nullptr || team->one_machine) {
            begin(paths, WholeFile::Naming::none);
            if (team == nullptr || all_can_open()) return;
        }
        begin(paths, WholeFile::Naming::named);
    }

    /// Write the sections of a file. A team shares each section.
    /// @param sharing  the team; null: this process writes alone
    void write(std::size_t f, const std::vector<Section>& sections, Sizes sizes, const std::string& stage,
               const RunContext& context, const Team* sharing)
    {
        std::unique_ptr<SharedFile> shared;
        if (team_ != nullptr)
            shared = team_->open(names_[f], shown_[f]);
        else if (sizes == Sizes::exact)
            reserve(*files[f], size_of(sections), context);
        const auto write_at = [&](std::uint64_t offset, std::string_view bytes) {
            shared ? shared->write_at(offset, bytes) : files[f]->write_at(offset, bytes);
        };
        write_sections(sections, sizes, write_at, stage, context, sharing);
        if (shared) shared->close();
    }

    std::vector<std::unique_ptr<WholeFile>> files; ///< files of rank 0; empty in other processes

private:
    void begin(const std::vector<OutputPath>& paths, WholeFile::Naming naming)
    {
        files.clear();
        Writer names;
        if (team_ == nullptr || team_->rank == 0)
            for (const OutputPath& path : paths) {
                files.push_back(std::make_unique<WholeFile>(path, naming));
                names(files.back()->unfinished_path());
            }
        if (team_ == nullptr) return;
        const std::string told = gather(team_, std::move(names).take()).front();
        Reader reader(told);
        names_.resize(paths.size());
        shown_.clear();
        for (const OutputPath& path : paths) shown_.push_back(path.text());
        for (std::string& name : names_) reader(name);
    }

    /// Whether all processes can open the files of rank 0. The system may forbid it.
    [[nodiscard]] bool all_can_open() const
    {
        Writer own;
        own(std::int8_t(::access(names_.front().c_str(), W_OK) == 0 ? 1 : 0));
        return std::ranges::count(gathered<std::int8_t>(team_, std::move(own)), 0) == 0;
    }

    const Team* team_;
    std::vector<std::string> names_, shown_; ///< names for opening the files, and names for messages
};

} // namespace

void write_file(const OutputPath& path, const std::vector<Section>& sections, Sizes sizes,
                const RunContext& context, const Team* team)
{
    SharedFiles shared({path}, team);
    shared.write(0, sections, sizes, "writing " + path.text(), context, team);
    gather(team, {}); // wait until all processes have written
    if (!shared.files.empty()) shared.files.front()->commit();
}

void write_files(const std::vector<FileOfSet>& files, const OutputPath& head_path, const std::string& head,
                 const RunContext& context, const Team* team)
{
    std::vector<OutputPath> paths;
    for (const FileOfSet& file : files) paths.push_back(file.path);
    paths.push_back(head_path);
    SharedFiles shared(paths, team);
    const auto [begin, end] = share_of(team, files.size());
    const auto share = [&](std::size_t f) {
        return static_cast<double>(f - begin) / static_cast<double>(end - begin);
    };
    for (std::size_t f = begin; f < end; ++f)
        shared.write(f, files[f].sections(), Sizes::exact, "writing " + files[f].path.text(),
                     part_of(context, share(f), share(f + 1)), nullptr);
    gather(team, {}); // wait until all processes have written
    if (shared.files.empty()) return;
    shared.files.back()->append(head);
    commit_together(shared.files);
}

char* put_text(char* out, double value) { return std::to_chars(out, out + kNumberBytes, value).ptr; }

char* put_text(char* out, long long value) { return std::to_chars(out, out + kNumberBytes, value).ptr; }

std::string text_of(double value)
{
    char text[kNumberBytes];
    return {text, put_text(text, value)};
}

} // namespace lacuna::io
