// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace lacuna::lua {

/// What to tell a person of an exception that no code of Lacuna meant to throw, "core.unexpected".
std::string unexpected_text(std::string_view what);

} // namespace lacuna::lua
