// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace lacuna::lua {

/// Text of the error "core.unexpected", for an exception that no code of Lacuna throws on purpose.
std::string unexpected_text(std::string_view what);

} // namespace lacuna::lua
