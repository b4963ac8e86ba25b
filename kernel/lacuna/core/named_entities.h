// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lacuna {

/// An entity as a message names it, by the tag or number that a person knows.
struct NamedEntity {
    std::string kind; ///< "face", "void face", "edge", "vertex", "source loop", "node", "cell", "element"…
    long long tag = 0;

    bool operator==(const NamedEntity&) const = default;
};

/// Entities that the words of an error name, as they are first met, each once: `face 12 "rim"`,
/// `void edge 3 (vertices 4-9)`, `faces 1, 2 and 7`, `target loop 2`. Names in quotes are passed over.
///
/// Every message writes entities this way, so programs get them from the one place that people do.
std::vector<NamedEntity> named_entities(std::string_view message);

} // namespace lacuna
