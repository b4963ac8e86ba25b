// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/mesh_deck.h>

#include <map>
#include <string>
#include <vector>

namespace lacuna::io {

/// Adds the sets of a mesh's groups to a deck, under names that are free. Internal to this folder.
class SetAdder {
public:
    /// @param surfaces  names of surfaces in the deck's text
    SetAdder(Deck& deck, const AddedMesh& added, DeckFormat format, const std::vector<std::string>& surfaces)
        : deck_(deck), added_(added), format_(format), surfaces_(surfaces), first_set_(deck.sets.size())
    {
    }

    /// Add a group as a set, named `wanted` if that name is free. The group extends the set of a mesh that
    /// was added before, or a set that lost all members; otherwise a new set is made.
    const DeckSet& add(DeckSet& set, const std::string& group, const std::string& wanted);
    [[nodiscard]] bool is_taken(DeckSet::Kind kind, const std::string& name);
    /// Whether a region or set of this name lost all its elements or members.
    [[nodiscard]] bool is_emptied(const std::string& name) const;
    /// Log the sets whose names were in use.
    void tell_names(const std::string& volume, const RunContext& context) const;

    /// Suffix of the keys of skin groups, to distinguish them from cell groups; it occurs in no name.
    static constexpr const char* kSkin = "\n";

private:
    /// The names of the deck's sets, with those that were added since the last call.
    SetNames& names();

    Deck& deck_;
    const AddedMesh& added_;
    DeckFormat format_;
    const std::vector<std::string>& surfaces_;
    std::map<std::string, std::string> renamed_; ///< sets whose names were in use, with their new names
    SetNames names_;                             ///< names of the deck's sets, if no mesh was added before
    std::size_t first_set_;                      ///< number of sets before the mesh was added
};

} // namespace lacuna::io
