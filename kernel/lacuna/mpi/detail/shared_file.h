// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/team.h>

#include <cstddef>
#include <memory>
#include <string>

/// Internal to this folder.
namespace lacuna::mpi {

/// Most bytes of one MPI call: MPI counts are 32-bit signed integers.
inline constexpr std::size_t kMostAtOnce = std::size_t(1) << 30;

/// Open an existing file through MPI-IO. @param name  for messages. @throw BackendError
std::unique_ptr<SharedFile> open_shared(const std::string& path, const std::string& name);

} // namespace lacuna::mpi
