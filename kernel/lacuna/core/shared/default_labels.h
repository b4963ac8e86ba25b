// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace lacuna {

/// Whether a label is a default that a CAD program writes when the user gave none: "Open CASCADE STEP
/// translator 7.6 1.1", "NONE", "Solid1", "Face 12", "Boss-Extrude1", "12". Case is ignored.
bool is_default_label(std::string_view label);

} // namespace lacuna
