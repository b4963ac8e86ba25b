// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck_file.h>
#include <lacuna/io/detail/sections.h>

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// What the writers of decks share. Internal to this folder.
namespace lacuna::io {

/// A file to be: sections refer to the deck.
struct DeckFile {
    std::vector<Section> sections;
    std::vector<std::string> notes; ///< what the format cannot hold, a sentence each
    Sizes sizes = Sizes::varying;
};

DeckFile file_of(const Deck& deck, DeckFormat format, const DeckFileOptions& options);
DeckFile nastran_file(const Deck& deck);
DeckFile abaqus_file(const Deck& deck);
DeckFile unv_file(const Deck& deck);
DeckFile msh_of_deck(const Deck& deck, const DeckFileOptions& options);
DeckFile exodus_file(const Deck& deck);
DeckFile vtu_of_deck(const Deck& deck);
DeckFile vtk_of_deck(const Deck& deck, bool binary);

/// Text of one place, all parts.
std::string text_at(const Deck& deck, DeckText::Place place);

/// A name of Abaqus: letters, digits, - and _ , a letter first.
std::string abaqus_name(std::string_view name);

/// Whether Abaqus's word in capitals is an element of this shape.
bool is_abaqus_element(std::string_view type, DeckShape shape);

/// Numbers that the text of a deck takes.
struct TextNumbers {
    std::set<DeckTag> nodes, cells;
    DeckTag set = 0, property = 0; ///< the highest
};
TextNumbers numbers_in_text(const Deck& deck);

/// Materials that the text of a Nastran or Abaqus deck defines, as it calls them, each once.
std::vector<std::string> materials_in_text(const Deck& deck);
/// Whether the text of an Abaqus deck has a section of a set of elements.
bool has_section(const Deck& deck, std::string_view set);
/// Cards of an Abaqus deck up to its first step, and from there on.
std::pair<std::string, std::string> model_and_steps(const std::string& cards);
/// Put cards of the model before the first step of an Abaqus deck.
void add_model_cards(Deck& deck, const std::string& cards);

/// How the exponent of a real number begins: with an E, or with its sign alone, as in 1.5-3.
enum class RealForm { plain, nastran };

/// A real number of at most `width` characters, the nearest of these, with a point. @pre width >= 10
char* put_real(char* out, double value, std::size_t width, RealForm form = RealForm::plain);

inline char* put_words(char* out, std::string_view words) { return words.copy(out, words.size()) + out; }

/// An element that a format does not have. @throw InvalidInput always
[[noreturn]] void refuse_element(const DeckBlock& block, std::string_view format, std::string_view why);

} // namespace lacuna::io
