// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad_protocol/shared/messages.h>
#include <lacuna/cad_worker/exact_geometry.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lacuna::cad_worker {

/// Called with the fraction of the work done, in [0, 1].
using Progress = std::function<void(double)>;

/// A file of a request, opened in this process.
struct OpenedFile {
    std::uint8_t format = 0; ///< cad_protocol::LoadFile::Format
    std::string path;        ///< path as the user gave it
    std::string at;          ///< path by which this process opens it
};

struct Imported {
    std::unique_ptr<CadSource> source;
    cad_protocol::LoadReply reply; ///< the reply, still without a handle
};

/// Read CAD files into one model. Tags continue from file to file, as in Gmsh.
/// @throw InvalidInput, BackendError  the error of Gmsh, with the name of the file.
Imported import_cad(const std::vector<OpenedFile>& files, double tolerance, double scale,
                    const Progress& progress);

} // namespace lacuna::cad_worker
