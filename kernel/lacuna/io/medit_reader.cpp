// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/facet_collector.h>

#include <algorithm>
#include <limits>

namespace lacuna::io {
namespace {

/// A section of a Medit file: a count, then records of so many numbers.
struct Section {
    std::string_view name;
    int values;
    int corners = 0; ///< of faces
    bool solid = false;
};

constexpr Section kSections[] = {{"Vertices", 4},
                                 {"Triangles", 4, 3},
                                 {"TrianglesP2", 7, 3},
                                 {"Quadrilaterals", 5, 4},
                                 {"QuadrilateralsQ2", 10, 4},
                                 {"Tetrahedra", 5, 0, true},
                                 {"TetrahedraP2", 11, 0, true},
                                 {"Hexahedra", 9, 0, true},
                                 {"HexahedraQ2", 28, 0, true},
                                 {"Prisms", 7, 0, true},
                                 {"Pyramids", 6, 0, true},
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
    MeditReader(Cursor& cursor, FacetCollector& into) : cursor_(cursor), into_(into) {}

    void read()
    {
        std::string_view word = next_word();
        if (!same_word(word, "MeshVersionFormatted"))
            cursor_.fail("expected MeshVersionFormatted, found " + shown(word));
        cursor_.integer();
        while (!(word = next_word()).empty() && !same_word(word, "End")) {
            const auto section = std::ranges::find_if(
                kSections, [&](const Section& known) { return same_word(known.name, word); });
            if (same_word(word, "Dimension")) {
                if (cursor_.integer() != 3) cursor_.fail("expected Dimension 3");
            } else if (section == std::end(kSections)) {
                cursor_.fail("expected a section, as Vertices or Triangles, found " + shown(word));
            } else {
                read_section(*section);
            }
        }
        into_.sort_by_label();
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

    void read_section(const Section& section)
    {
        const std::uint64_t count = cursor_.plausible(cursor_.size(), 1,
                                                      static_cast<std::uint64_t>(section.values));
        if (count > static_cast<std::uint64_t>(std::numeric_limits<Index>::max()))
            cursor_.fail("too many " + std::string(section.name));
        if (section.name == "Vertices") {
            if (!into_.points().empty()) cursor_.fail("a second section Vertices");
            into_.points().reserve(count);
            for (std::uint64_t i = 0; i < count; ++i) {
                into_.points().push_back(cursor_.point());
                cursor_.real();
            }
        } else if (section.corners > 0) {
            for (std::uint64_t i = 0; i < count; ++i) read_face(section);
        } else {
            for (std::uint64_t i = 0; i < count * static_cast<std::uint64_t>(section.values); ++i)
                cursor_.real();
            if (section.solid) into_.pass_over_solid(std::string(section.name), count);
        }
    }

    void read_face(const Section& section)
    {
        std::array<Index, 4> corner{};
        for (int k = 0; k < section.corners; ++k) {
            corner[index(k)] = cursor_.integer();
            if (corner[index(k)] < 1) cursor_.fail("expected the number of a vertex, from 1");
            --corner[index(k)];
        }
        for (int k = section.corners; k < section.values - 1; ++k) cursor_.integer();
        into_.add_face({corner.data(), index(section.corners)}, into_.label_of(cursor_.integer()), cursor_);
    }

    Cursor& cursor_;
    FacetCollector& into_;
};

} // namespace

void read_medit(Cursor& cursor, FacetCollector& into) { MeditReader(cursor, into).read(); }

} // namespace lacuna::io
