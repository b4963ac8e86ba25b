// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/deck_builder.h>

#include <algorithm>

namespace lacuna::io {
namespace {

/// A section of a Medit file: a count, then records with a fixed number of values.
struct MeditSection {
    std::string_view name;
    int values;
    bool elements = false;
    DeckShape shape = DeckShape::tri3; ///< shape of the section's elements
};

/// Solids and shells without middle nodes are read as they are; others are reduced to their corners.
constexpr MeditSection kSections[] = {{"Vertices", 4},
                                      {"Triangles", 4, true, DeckShape::tri3},
                                      {"TrianglesP2", 7, true, DeckShape::tri3},
                                      {"Quadrilaterals", 5, true, DeckShape::quad4},
                                      {"QuadrilateralsQ2", 10, true, DeckShape::quad4},
                                      {"Tetrahedra", 5, true, DeckShape::tet4},
                                      {"TetrahedraP2", 11, true, DeckShape::tet4},
                                      {"Hexahedra", 9, true, DeckShape::hex8},
                                      {"HexahedraQ2", 28, true, DeckShape::hex8},
                                      {"Prisms", 7, true, DeckShape::wedge6},
                                      {"Pyramids", 6, true, DeckShape::pyramid5},
                                      {"Edges", 3},
                                      {"EdgesP2", 4},
                                      {"Corners", 1},
                                      {"Ridges", 1},
                                      {"RequiredVertices", 1},
                                      {"RequiredEdges", 1},
                                      {"RequiredTriangles", 1},
                                      {"RequiredQuadrilaterals", 1},
                                      {"Normals", 3},
                                      {"NormalAtVertices", 2},
                                      {"Tangents", 3},
                                      {"TangentAtVertices", 2}};

class MeditReader {
public:
    MeditReader(Cursor& cursor, DeckBuilder& into) : cursor_(cursor), into_(into) {}

    void read()
    {
        std::string_view word = next_word();
        if (!same_word(word, "MeshVersionFormatted"))
            cursor_.fail("expected MeshVersionFormatted, found {}", found(shown(word)));
        cursor_.integer();
        while (!(word = next_word()).empty() && !same_word(word, "End")) {
            const auto section = find_word(kSections, word, &MeditSection::name);
            if (same_word(word, "Dimension")) {
                if (cursor_.integer() != 3) cursor_.fail("expected Dimension 3");
            } else if (section == std::end(kSections)) {
                cursor_.fail("expected a section such as Vertices or Triangles, found {}",
                             found(shown(word)));
            } else {
                read_section(*section);
            }
        }
    }

private:
    /// The next word that is not in a comment; empty at the end.
    std::string_view next_word()
    {
        while (cursor_.more()) {
            const std::string_view word = cursor_.word();
            if (!word.starts_with('#')) return word;
            cursor_.line_end();
        }
        return {};
    }

    void read_section(const MeditSection& section)
    {
        const std::uint64_t count = cursor_.plausible(cursor_.size(), 1,
                                                      static_cast<std::uint64_t>(section.values));
        if (!is_index(count)) cursor_.fail("too many {}", section.name);
        if (section.name == "Vertices") {
            if (!into_.points().empty()) cursor_.fail("the section Vertices occurs twice");
            into_.points().reserve(count);
            for (std::uint64_t i = 0; i < count; ++i) {
                into_.points().push_back(cursor_.point());
                cursor_.real();
            }
        } else if (section.elements) {
            const std::size_t block = into_.block_of(section.shape, section.name);
            for (std::uint64_t i = 0; i < count; ++i) read_element(section, block);
        } else {
            for (std::uint64_t i = 0; i < count * static_cast<std::uint64_t>(section.values); ++i)
                cursor_.real();
            if (section.name == "Edges" || section.name == "EdgesP2")
                into_.pass_over(std::string(section.name), count);
        }
    }

    void read_element(const MeditSection& section, std::size_t block)
    {
        std::array<Index, 8> corner{};
        const int corners = shape_info(section.shape).corners;
        for (int k = 0; k < corners; ++k) {
            corner[index(k)] = std::max(cursor_.integer(), 0) - 1;
            if (corner[index(k)] < 0 || index(corner[index(k)]) >= into_.points().size())
                cursor_.fail("expected the number of one of the {} vertices so far", into_.points().size());
        }
        for (int k = corners; k < section.values - 1; ++k) cursor_.integer();
        const int reference = cursor_.integer();
        const int dimension = shape_info(section.shape).dimension;
        into_.add_element(block, -1, into_.region_of(reference, "", dimension),
                          {corner.data(), index(corners)});
    }

    Cursor& cursor_;
    DeckBuilder& into_;
};

} // namespace

void read_medit(Cursor& cursor, DeckBuilder& into) { MeditReader(cursor, into).read(); }

} // namespace lacuna::io
