// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace lacuna::cad {

/// Path of lacuna-cad: the value of LACUNA_CAD; else next to the program or library that contains this code,
/// or in libexec/lacuna of its installation; else in the build folder, when tested there.
/// @throw BackendError  "cad.no_worker": not found; names the places that were searched.
std::string find_worker_program();

} // namespace lacuna::cad
