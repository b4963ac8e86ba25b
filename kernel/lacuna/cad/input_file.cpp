// SPDX-License-Identifier: MIT
#include <lacuna/cad/detail/input_file.h>

#include <lacuna/cad/detail/script.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/list_text.h>
#include <lacuna/io/load_facets.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace lacuna::cad {

using cad_protocol::Descriptor;
using cad_protocol::LoadFile;
using io::ending_of;

namespace {

constexpr std::size_t kHead = 4096; // bytes at the beginning, from which the format is recognised
constexpr std::size_t kBlock = std::size_t{1} << 20;
/// Longest script that is parsed [bytes]; larger than anything written by hand or by Gmsh.
constexpr std::size_t kLongestScript = std::size_t{64} << 20;
/// Most files that a script may include and merge, itself included.
constexpr std::size_t kMostContents = 100;

[[noreturn]] void fail(const std::string& path, int error)
{
    throw BackendError("cad.unreadable", "{} cannot be read: {}", path, std::strerror(error));
}

/// Write bytes at a place of a file. @param path  for messages
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

std::string name_of(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

/// Whether Gmsh treats a merged file as a script.
bool runs_as_script(const std::string& name, const std::string& head)
{
    const std::string ending = ending_of(name);
    for (const std::string_view data : {".step", ".stp", ".iges", ".igs", ".brep", ".stl", ".msh"})
        if (ending == data) return false;
    return !is_step(head) && !is_brep(head);
}

/// Append a copy of a regular file to the input. A newline is added to a script: without one, Gmsh's parser
/// silently drops an incomplete last command.
void add_copy(InputFile& input, const std::string& name, const std::string& path, int flags,
              const RunContext& context)
{
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
    std::vector<char> block(kBlock);
    std::uint64_t digest = digest_of(name, 0), bytes = 0;
    for (;;) {
        check_cancelled(context);
        const ssize_t got = ::read(from.get(), block.data(), block.size());
        if (got == 0) break;
        if (got < 0 && errno != EINTR) fail(path, errno);
        const std::span<const char> some(block.data(), got > 0 ? static_cast<std::size_t>(got) : 0);
        write_at(copy, {some.data(), some.size()}, bytes, path);
        digest = digest_of(some, digest);
        bytes += some.size();
    }
    input.bytes += bytes;
    if (runs_as_script(name_of(path), text_of(copy, kHead))) write_at(copy, "\n", bytes, path);
    input.descriptors.push_back(std::move(copy));
    input.digests.push_back(digest);
    input.file.contents.push_back({name});
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
                               .remedy("check the file, or use the ending of its format"));
    };
    if (ending == ".step" || ending == ".stp") return checked(is_step(head), "STEP", LoadFile::step);
    if (ending == ".iges" || ending == ".igs") return checked(is_iges(head), "IGES", LoadFile::iges);
    if (ending == ".brep") return checked(is_brep(head), "BREP", LoadFile::brep);
    // A script can run commands, so its ending must match exactly.
    const std::string written = path.substr(path.size() - ending.size());
    const bool meant = written == ending || std::none_of(written.begin(), written.end(),
                                                         [](unsigned char c) { return std::islower(c); });
    const bool text = !is_step(head) && !is_brep(head) && head.find('\0') == std::string::npos;
    return checked(meant && text, "Gmsh script", LoadFile::script);
}

/// Replace skipped commands by blanks in the copy of a script, and add a note that lists them.
void skip_commands(InputFile& input, const Descriptor& script, const std::string& path, std::string text,
                   const std::vector<SkippedCommand>& commands)
{
    if (commands.empty()) return;
    for (const SkippedCommand& command : commands)
        for (std::size_t k = command.begin; k < command.end; ++k)
            if (text[k] != '\n') text[k] = ' ';
    const auto with_line = [](const SkippedCommand& command) {
        return formatted("{} (line {})", command.word, command.line);
    };
    input.notes.push_back({"cad.skipped_commands",
                           "{}: only the geometry of the script is read. Skipped commands: {}", path,
                           short_list(commands, with_line)});
    write_at(script, text, 0, path);
}

/// Parse a script, and add the files that it merges, recursively.
void add_merged(InputFile& input, const std::string& path, const RunContext& context)
{
    for (std::size_t i = 0; i < input.descriptors.size(); ++i) {
        const std::string name = input.file.contents[i].name;
        if (i > 0 && !runs_as_script(name, text_of(input.descriptors[i], kHead))) continue;
        const std::string own = i == 0 ? path : path.substr(0, path.size() - name_of(path).size()) + name;
        std::string text = text_of(input.descriptors[i], kLongestScript + 1);
        if (text.size() > kLongestScript)
            throw InvalidInput("cad.script", "{} is too long for a script ({} MiB at most)", own,
                               needed(kLongestScript >> 20));
        const ScriptContent found = look_through_script(own, text);
        if (i > 0 && !found.skipped.empty() && found.skipped.back().word == "Exit")
            throw InvalidInput(
                Message("cad.script",
                        "{}, line {}: Exit in an included file also ends the script that includes it", own,
                        found.skipped.back().line)
                    .remedy("remove it"));
        skip_commands(input, input.descriptors[i], own, std::move(text), found.skipped);
        for (const ScriptFile& wanted : found.files) {
            const auto known = std::find_if(input.file.contents.begin(), input.file.contents.end(),
                                            [&](const auto& sent) { return sent.name == wanted.name; });
            if (known != input.file.contents.end()) continue;
            const std::string beside = path.substr(0, path.size() - name_of(path).size()) + wanted.name;
            if (::access(beside.c_str(), F_OK) != 0 || input.descriptors.size() == kMostContents) {
                throw InvalidInput(Message("cad.script",
                                           "{}, line {}: the script includes {}, which is not in its folder",
                                           own, wanted.line, wanted.name)
                                       .remedy("put it there"));
            }
            add_copy(input, wanted.name, beside, O_NOFOLLOW, context);
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

std::uint64_t digest_of(std::uint64_t word, std::uint64_t before)
{
    constexpr std::uint64_t kOffset = 0xcbf29ce484222325ULL, kPrime = 0x100000001b3ULL;
    const std::uint64_t mixed = ((before ^ kOffset) ^ word) * kPrime;
    return mixed ^ (mixed >> 32); // multiplication leaves low bits independent of a word's upper half
}

std::uint64_t digest_of(std::span<const char> bytes, std::uint64_t before)
{
    std::uint64_t digest = digest_of(bytes.size(), before);
    for (std::size_t i = 0; i < bytes.size(); i += sizeof(std::uint64_t)) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + i, std::min(sizeof(word), bytes.size() - i));
        digest = digest_of(word, digest);
    }
    return digest;
}

InputFile open_input(const std::string& path, const RunContext& context)
{
    InputFile input;
    add_copy(input, name_of(path), path, 0, context);
    input.file.path = path;
    input.file.format = format_of(path, text_of(input.descriptors.front(), kHead));
    if (input.file.format == LoadFile::script) add_merged(input, path, context);
    // Seal the copies: no process can modify them any more.
    for (const Descriptor& copy : input.descriptors)
        ::fcntl(copy.get(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE | F_SEAL_SEAL);
    return input;
}

} // namespace lacuna::cad
