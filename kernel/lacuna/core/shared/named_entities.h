// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/message.h>

#include <string_view>
#include <vector>

namespace lacuna {

/// Entities named in the text of an error, in order, without repetition: `face 12 "rim"`,
/// `void edge 3 (vertices 4-9)`, `faces 1, 2 and 7`, `target loop 2`. Text in quotes is skipped.
///
/// All messages of the kernel name entities in these forms, so that programs can rely on them.
std::vector<NamedEntity> named_entities(std::string_view message);

} // namespace lacuna
