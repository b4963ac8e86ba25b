// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace lacuna {

/// Whether CAD programs write a label like this where the user gave none: "Open CASCADE STEP translator 7.6
/// 1.1", "NONE", "Solid1", "Face 12", "Boss-Extrude1", "12". Upper and lower case are one.
bool is_default_label(std::string_view label);

} // namespace lacuna
