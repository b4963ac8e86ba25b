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

/// CAD files opened and copied into memory, as they are sent to the CAD process.
struct CadFiles {
    cad_protocol::LoadRequest request;
    std::vector<cad_protocol::Descriptor> descriptors;
    std::uint64_t bytes = 0;
    std::uint64_t digest = 0;   ///< hash of all contents and names
    std::vector<Message> notes; ///< which script commands are skipped
};

/// @throw as open_input()
CadFiles open_cad_files(const CadOrder& order, const RunContext& context);

/// Let a CAD process read the files.
/// @throw as Worker::ask()
cad_protocol::LoadReply read_cad_files(Worker& worker, const CadOrder& order, const CadFiles& files,
                                       const RunContext& context);

} // namespace lacuna::cad
