// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad/detail/worker.h>
#include <lacuna/cad/limits.h>
#include <lacuna/cad_protocol/messages.h>
#include <lacuna/core/run_context.h>

#include <cstdint>
#include <string>
#include <vector>

namespace lacuna::cad {

/// What is to be read, and how: all that it takes to read it again.
struct CadOrder {
    std::vector<std::string> paths;
    double tolerance = 0; ///< [model length]; 0: 1e-6 × the diagonal
    double scale = 1;     ///< model length / file length
    Limits limits{};
};

/// The files by their names, for messages.
std::string subject_of(const CadOrder& order);

/// CAD files, opened and copied, as the CAD process takes them.
struct CadFiles {
    cad_protocol::LoadRequest request;
    std::vector<cad_protocol::Descriptor> descriptors;
    std::uint64_t bytes = 0;
    std::uint64_t digest = 0;       ///< of all contents and their names
    std::vector<std::string> notes; ///< commands of scripts that are left out
};

/// @throw as open_input()
CadFiles open_cad_files(const CadOrder& order, const RunContext& context);

/// Have a process read the files.
/// @throw as Worker::ask()
cad_protocol::LoadReply read_cad_files(Worker& worker, const CadOrder& order, const CadFiles& files,
                                       const RunContext& context);

} // namespace lacuna::cad
