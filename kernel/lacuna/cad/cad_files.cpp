// SPDX-License-Identifier: MIT
#include <lacuna/cad/detail/cad_files.h>

#include <lacuna/cad/detail/script.h>
#include <lacuna/cad_protocol/shared/channel.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/list_text.h>
#include <lacuna/io/load_facets.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <functional>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace lacuna::cad {

using namespace cad_protocol;
using io::ending_of;

namespace {

constexpr std::size_t kHead = 4096; // number of leading bytes from which the format is recognised
/// Longest script that is parsed [bytes]; larger than anything written by hand or by Gmsh.
constexpr std::size_t kLongestScript = std::size_t{64} << 20;

[[noreturn]] void fail(const std::string& path, int error)
{
    throw BackendError("cad.unreadable", "{} cannot be read: {}", path, std::strerror(error));
}

/// Write bytes at an offset of a file. @param path  name for messages
void write_at(const Descriptor& file, std::string_view bytes, std::uint64_t at, const std::string& path)
{
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t now = ::pwrite(file.get(), bytes.data() + done, bytes.size() - done,
                                     static_cast<off_t>(at + done));
        if (now < 0 && errno != EINTR) fail(path, errno);
        if (now > 0) done += static_cast<std::size_t>(now);
    }
}

bool is_step(const std::string& head) { return head.find("ISO-10303-21") != std::string::npos; }
bool is_brep(const std::string& head)
{
    return head.find("CASCADE Topology") != std::string::npos ||
           head.find("DBRep_DrawableShape") != std::string::npos;
}

std::uint64_t digest_of(std::string_view bytes, std::uint64_t before)
{
    const std::hash<std::string_view> hash;
    const std::array<std::uint64_t, 2> both{before, hash(bytes)};
    return hash({reinterpret_cast<const char*>(both.data()), sizeof(both)});
}

/// Whether Gmsh runs a merged file as a script.
bool runs_as_script(const std::string& name, const std::string& head)
{
    const std::string ending = ending_of(name);
    for (const std::string_view data : {".step", ".stp", ".iges", ".igs", ".brep", ".stl", ".msh"})
        if (ending == data) return false;
    return !is_step(head) && !is_brep(head);
}

/// Copy a regular file and append the copy to the contents of the last entry of `files`. A script gets a
/// newline at its end: without one, Gmsh's parser silently drops an incomplete last command.
void add_copy(CadFiles& files, const std::string& folder, const std::string& name, int flags,
              const RunContext& context)
{
    const std::string path = folder + name;
    // O_NONBLOCK: do not wait for a writer if the file is a pipe.
    const Descriptor from(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY | flags));
    if (!from) fail(path, errno);
    struct stat status {};
    if (::fstat(from.get(), &status) != 0) fail(path, errno);
    if (!S_ISREG(status.st_mode))
        throw InvalidInput(
            Message("cad.not_a_file", "{} is not a regular file", path).remedy("name a file on a disk"));
    Descriptor copy(::memfd_create("lacuna-cad input", MFD_CLOEXEC | MFD_ALLOW_SEALING));
    if (!copy) fail(path, errno);
    std::vector<char> block(cad_protocol::kBlock);
    files.digest = digest_of(name, files.digest);
    std::uint64_t bytes = 0;
    for (;;) {
        check_cancelled(context);
        const ssize_t got = ::read(from.get(), block.data(), block.size());
        if (got == 0) break;
        if (got < 0 && errno != EINTR) fail(path, errno);
        const std::string_view some(block.data(), got > 0 ? static_cast<std::size_t>(got) : 0);
        write_at(copy, some, bytes, path);
        files.digest = digest_of(some, files.digest);
        bytes += some.size();
    }
    files.bytes += bytes;
    if (runs_as_script(name, text_of(copy, kHead))) write_at(copy, "\n", bytes, path);
    files.descriptors.push_back(std::move(copy));
    files.request.files.back().contents.push_back({name});
}

/// In an IGES file, column 73 of each line contains the letter of its section.
bool is_iges(const std::string& head)
{
    constexpr std::size_t kColumn = 72;
    return head.size() > kColumn && (head[kColumn] == 'S' || head[kColumn] == 'C' || head[kColumn] == 'B') &&
           head.find('\n') > kColumn;
}

LoadFile::Format format_of(const std::string& path, const std::string& head)
{
    const std::string ending = ending_of(path);
    const auto checked = [&](bool valid, const char* kind, LoadFile::Format format) {
        if (valid) return format;
        throw InvalidInput(Message("cad.unreadable", "{} is not a valid {} file", path, kind)
                               .remedy("check the file, or give it the file extension of its format"));
    };
    if (ending == ".step" || ending == ".stp") return checked(is_step(head), "STEP", LoadFile::step);
    if (ending == ".iges" || ending == ".igs") return checked(is_iges(head), "IGES", LoadFile::iges);
    if (ending == ".brep") return checked(is_brep(head), "BREP", LoadFile::brep);
    // A script can run commands, so only an all-lower-case or all-upper-case extension is accepted.
    const std::string written = path.substr(path.size() - ending.size());
    const bool meant = written == ending || std::none_of(written.begin(), written.end(),
                                                         [](unsigned char c) { return std::islower(c); });
    const bool text = !is_step(head) && !is_brep(head) && head.find('\0') == std::string::npos;
    return checked(meant && text, "Gmsh script", LoadFile::script);
}

/// Replace skipped commands by blanks in the copy of a script, and add a note that lists them.
void skip_commands(CadFiles& files, const Descriptor& script, const std::string& path, std::string text,
                   const std::vector<SkippedCommand>& commands)
{
    if (commands.empty()) return;
    for (const SkippedCommand& command : commands)
        for (std::size_t k = command.begin; k < command.end; ++k)
            if (text[k] != '\n') text[k] = ' ';
    const auto with_line = [](const SkippedCommand& command) {
        return formatted("{} (line {})", command.word, command.line);
    };
    files.notes.push_back(Message("cad.skipped_commands",
                                  "{}: only the geometry of the script is read. Skipped commands: {}", path,
                                  short_list(commands, with_line))
                              .as_warning());
    write_at(script, text, 0, path);
}

/// Parse the script that is the last entry of `files`, and add the files that it includes or merges,
/// recursively.
/// @param first  index of the script's descriptor
void add_merged(CadFiles& files, std::size_t first, const std::string& folder, const RunContext& context)
{
    const std::vector<SentFile>& contents = files.request.files.back().contents;
    for (std::size_t i = 0; i < contents.size(); ++i) {
        const std::string name = contents[i].name;
        if (i > 0 && !runs_as_script(name, text_of(files.descriptors[first + i], kHead))) continue;
        const std::string own = folder + name;
        std::string text = text_of(files.descriptors[first + i], kLongestScript + 1);
        if (text.size() > kLongestScript)
            throw InvalidInput(Message("cad.script", "{} is too long for a script ({} MiB at most)", own,
                                       needed(kLongestScript >> 20))
                                   .remedy("split the script by Include, or export the geometry as STEP"));
        const ScriptContent found = look_through_script(own, text);
        if (i > 0 && !found.skipped.empty() && found.skipped.back().word == "Exit")
            throw InvalidInput(
                Message("cad.script",
                        "{}, line {}: Exit in an included file also ends the script that includes it", own,
                        found.skipped.back().line)
                    .remedy("remove it"));
        skip_commands(files, files.descriptors[first + i], own, std::move(text), found.skipped);
        for (const ScriptFile& wanted : found.files) {
            if (std::ranges::find(contents, wanted.name, &SentFile::name) != contents.end()) continue;
            if (files.descriptors.size() == cad_protocol::kMostDescriptors)
                throw InvalidInput(Message("cad.script",
                                           "{}, line {}: with the files that scripts include, more than {} "
                                           "files are read at once",
                                           own, wanted.line, needed(cad_protocol::kMostDescriptors))
                                       .remedy("merge some of these files into one"));
            if (::access((folder + wanted.name).c_str(), F_OK) != 0) {
                throw InvalidInput(
                    Message("cad.script",
                            "{}, line {}: the script includes {}, which is not in the script's folder", own,
                            wanted.line, wanted.name)
                        .remedy("copy it to that folder"));
            }
            add_copy(files, folder, wanted.name, O_NOFOLLOW, context);
        }
    }
}

} // namespace

std::string text_of(const Descriptor& file, std::size_t most)
{
    const off_t size = std::max<off_t>(0, ::lseek(file.get(), 0, SEEK_END));
    std::string text(std::min(most, static_cast<std::size_t>(size)), '\0');
    std::size_t got = 0;
    while (got < text.size()) {
        const ssize_t now = ::pread(file.get(), text.data() + got, text.size() - got,
                                    static_cast<off_t>(got));
        if (now <= 0) break;
        got += static_cast<std::size_t>(now);
    }
    text.resize(got);
    return text;
}

std::string subject_of(const CadOrder& order) { return full_list(order.paths, std::identity()); }

CadFiles open_cad_files(const CadOrder& order, const RunContext& context)
{
    CadFiles files;
    files.request.tolerance = order.tolerance;
    files.request.scale = order.scale;
    for (const std::string& path : order.paths) {
        const std::size_t first = files.descriptors.size();
        const std::string folder = path.substr(0, path.find_last_of('/') + 1);
        LoadFile& file = files.request.files.emplace_back();
        file.path = path;
        add_copy(files, folder, path.substr(folder.size()), 0, context);
        file.format = format_of(path, text_of(files.descriptors[first], kHead));
        if (file.format == LoadFile::script) add_merged(files, first, folder, context);
    }
    // Seal the copies, so that no process can modify them.
    for (const Descriptor& copy : files.descriptors)
        ::fcntl(copy.get(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE | F_SEAL_SEAL);
    return files;
}

LoadReply read_cad_files(Worker& worker, const CadOrder& order, const CadFiles& files,
                         const RunContext& context)
{
    Task task{subject_of(order), "reading it", order.limits};
    task.bytes = files.bytes;
    task.context = &context;
    task.stage = "load";
    std::vector<int> descriptors;
    for (const Descriptor& file : files.descriptors) descriptors.push_back(file.get());
    auto reply = worker.ask<LoadReply>(Opcode::load, files.request, task, descriptors);
    worker.charge(reply.model, files.bytes);
    return reply;
}

} // namespace lacuna::cad
