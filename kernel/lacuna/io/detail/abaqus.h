// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/deck_files.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Keywords, parts and instances of Abaqus decks. Internal to this folder.
namespace lacuna::io {

/// A line `*KEYWORD, KEY=value, KEY`.
struct Keyword {
    std::string name;                                            ///< in capitals, without blanks
    std::vector<std::pair<std::string, std::string>> parameters; ///< keys in capitals

    [[nodiscard]] const std::string* find(std::string_view key) const;
    [[nodiscard]] std::string value(std::string_view key) const;
};

/// @param words  a keyword line from its star on, joined with its continuation lines; not empty.
Keyword parse_keyword(std::string_view words);

/// A keyword with the lines up to the next one. The first card has no name: it holds the lines before the
/// first keyword.
struct AbaqusCard {
    Keyword keyword{};
    std::string_view text{}; ///< all its lines, with comments
    std::string_view data{}; ///< from the first data line to the last, with comments between them
};
/// Split a text into cards, which refer to the text.
std::vector<AbaqusCard> abaqus_cards(std::string_view text);
/// Call `take(line)` for the data lines of a card.
template <class Take>
void each_data_line(const AbaqusCard& card, const Take& take)
{
    each_line(card.data, [&](std::string_view line) {
        if (!trimmed(line).starts_with("**")) take(line);
    });
}

/// Call `take(node, dependent)` for the node of each term of a card *EQUATION, if it is a number. An equation
/// is the number of its terms, then for each term a node or set, a direction and a coefficient; the node of
/// the first term depends on the others.
template <class Take>
void each_equation_node(const AbaqusCard& card, const Take& take)
{
    std::int64_t left = 0, at = 0; // fields of the equation that follow, and fields before
    each_data_line(card, [&](std::string_view line) {
        while (!line.empty()) {
            const std::string_view field = trimmed(next_field(line));
            const auto number = parse_integer<std::int64_t>(field);
            if (left <= 0) {
                left = 3 * number.value_or(0);
                at = 0;
            } else if (!field.empty()) {
                if (at % 3 == 0 && number) take(*number, at == 0);
                ++at, --left;
            }
        }
    });
}

/// The shape of an element by its type in capitals; empty if it is neither a shell nor a solid.
std::optional<DeckShape> abaqus_shape(std::string_view type);
/// Whether an element type (in capitals) is a hexahedron of a thin layer: a cohesive element, a gasket or a
/// continuum shell. Its nodes 5 to 8 lie above nodes 1 to 4 in the direction of the thickness.
bool is_layer(std::string_view type);
/// The type of wedges in a layer of such hexahedra; empty: there is none.
std::string layer_wedge(std::string_view type);

/// Whether a keyword assigns a section to a set of elements.
bool is_section(const Keyword& keyword);

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
