// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/// Numbers in messages. Internal to this folder.
namespace lacuna::sweep {

/// Two significant digits: "0.034", for reports.
std::string in_short(double value);

/// The fewest digits that read back as the same number: "0.1", for refusals.
std::string in_full(double value);

} // namespace lacuna::sweep
