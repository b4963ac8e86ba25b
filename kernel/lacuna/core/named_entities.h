// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lacuna {

/// An entity named in a message, by the tag or number that the user knows.
struct NamedEntity {
    std::string kind; ///< "face", "void face", "edge", "vertex", "source loop", "node", "cell", "element"…
    long long tag = 0;

    bool operator==(const NamedEntity&) const = default;
};

/// Entities named in the text of an error, in order, without repetition: `face 12 "rim"`,
/// `void edge 3 (vertices 4-9)`, `faces 1, 2 and 7`, `target loop 2`. Text in quotes is skipped.
///
/// All messages of the kernel name entities in these forms, so that programs can rely on them.
std::vector<NamedEntity> named_entities(std::string_view message);

} // namespace lacuna
