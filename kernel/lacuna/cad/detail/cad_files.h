// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad/detail/worker.h>
#include <lacuna/cad/limits.h>
#include <lacuna/cad_protocol/shared/messages.h>
#include <lacuna/core/message.h>
#include <lacuna/core/run_context.h>

#include <cstdint>
#include <string>
#include <vector>

namespace lacuna::cad {

/// Which files to read, and how; enough to read them again.
struct CadOrder {
    std::vector<std::string> paths;
    double tolerance = 0; ///< [model length]; 0: 1e-6 × the diagonal
    double scale = 1;     ///< model length / file length
    Limits limits{};
};

/// The names of the files, for messages.
std::string subject_of(const CadOrder& order);

/// CAD files copied into memory. The copies are sent to the CAD process, so it reads exactly the bytes that
/// were checked here. The contents of a script are the script and the files that it includes or merges; any
/// other file has one content.
struct CadFiles {
    cad_protocol::LoadRequest request;                 ///< format of each file, and names of its contents
    std::vector<cad_protocol::Descriptor> descriptors; ///< one for each of the contents
    std::uint64_t bytes = 0;                           ///< size of all contents
    std::uint64_t digest = 0;                          ///< hash of all contents and names
    std::vector<Message> notes;                        ///< script commands that are skipped
};

/// The first `most` bytes of a file; all of it if it is shorter.
std::string text_of(const cad_protocol::Descriptor& file, std::size_t most);

/// Open CAD files and check that their contents agree with their file extensions. A script is parsed: files
/// of its own folder that it includes or merges are copied as well, and commands that mesh or write files are
/// removed from the copy that Gmsh runs. Commands that run programs are errors.
/// @throw InvalidInput  a file is not regular or does not have the format of its extension, or a script has a
///                      forbidden command; names file and line.
/// @throw BackendError  a file cannot be read.
/// @throw Cancelled
CadFiles open_cad_files(const CadOrder& order, const RunContext& context);

/// Let a CAD process read the files.
/// @throw as Worker::ask()
cad_protocol::LoadReply read_cad_files(Worker& worker, const CadOrder& order, const CadFiles& files,
                                       const RunContext& context);

} // namespace lacuna::cad
