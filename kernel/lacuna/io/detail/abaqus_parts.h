// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/deck_files.h>

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

/// Parts and instances of Abaqus decks. Internal to this folder.
namespace lacuna::io {

/// A part of an Abaqus deck, or the entities outside all parts.
struct AbaqusPart {
    std::string name;
    DeckBuilder builder{DeckFormat::abaqus};
    std::map<std::string, std::size_t, std::less<>> sets; ///< index in the deck's sets, by kind and name in
                                                          ///< capitals
    struct Section {
        std::string name, material;
        std::vector<DeckTag> members;
    };
    std::vector<Section> sections;
    bool is_finished = false;
};

/// Collects parts, and adds a copy of a part to a deck for each of its instances.
class AbaqusParts {
public:
    /// @param main   cursor of the deck's main file; errors that have no other place name it
    AbaqusParts(const Cursor& main, DeckBuilder& into, const DeckFiles& files);

    /// The entities outside all parts.
    AbaqusPart& outside() { return *parts_.front(); }
    AbaqusPart& add(const std::string& name);
    /// The part of a name, in upper or lower case; null: there is none.
    [[nodiscard]] AbaqusPart* find(std::string_view name) const;
    /// Add a copy of a part to the deck. Its numbers are raised unless all of them are above those in the
    /// deck.
    /// @param to     placement of the instance; null: the part's own coordinates
    /// @param place  named by errors
    void place(AbaqusPart& part, const std::string& name, const Eigen::Isometry3d* to,
               const DeckPlace& place);
    /// Add what is outside all parts, and the parts themselves if the deck has no instances.
    void finish(const DeckPlace& place);

    /// Allow more generated data for a file of this size.
    void allow(std::size_t bytes) { budget_ += kMadePerByte * bytes; }
    /// Count generated data against a budget. Ranges and copies create more than the file contains, so their
    /// amount is limited by the size of the files.
    void spend(std::size_t count, const DeckPlace& place);

private:
    void finish_part(AbaqusPart& part);

    // Number of set members and copied entities that each byte of the file may generate. It allows about
    // fifty sets of all elements; not measured.
    static constexpr std::size_t kMadePerByte = 16;

    const Cursor& main_;
    DeckBuilder& into_;
    const DeckFiles& files_;
    std::size_t budget_ = 100'000;                   ///< entities that even a small deck may generate
    std::vector<std::unique_ptr<AbaqusPart>> parts_; ///< the first holds the entities outside all parts
    std::vector<Index> set_instance_; ///< index of each set's instance; sets of the assembly come last and
                                      ///< have no entry
    DeckTag highest_ = 0;             ///< highest number in the deck
};

} // namespace lacuna::io
