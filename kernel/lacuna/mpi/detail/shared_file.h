// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/team.h>

#include <memory>
#include <string>

/// Internal to this folder.
namespace lacuna::mpi {

/// A file that is there, through MPI-IO. @param name  for messages. @throw BackendError
std::unique_ptr<SharedFile> open_shared(const std::string& path, const std::string& name);

} // namespace lacuna::mpi
