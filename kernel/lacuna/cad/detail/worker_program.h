// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace lacuna::cad {

/// Where lacuna-cad is: what LACUNA_CAD names; beside the program or the library this code is in, or in
/// libexec/lacuna of the tree they are installed in; in the build's folder while that is being tested.
/// @throw BackendError  "cad.no_worker": in none of them; names what was tried.
std::string find_worker_program();

} // namespace lacuna::cad
