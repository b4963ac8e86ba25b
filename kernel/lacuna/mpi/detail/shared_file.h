// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/team.h>

#include <cstddef>
#include <memory>
#include <string>

/// Internal to this folder.
namespace lacuna::mpi {

/// Bytes of one call: counts of MPI are of 31 bits.
inline constexpr std::size_t kMostAtOnce = std::size_t(1) << 30;

/// A file that is there, through MPI-IO. @param name  for messages. @throw BackendError
std::unique_ptr<SharedFile> open_shared(const std::string& path, const std::string& name);

} // namespace lacuna::mpi
