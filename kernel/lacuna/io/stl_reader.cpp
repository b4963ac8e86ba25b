// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/deck_builder.h>

#include <lacuna/core/shared/large_pages.h>

#include <algorithm>
#include <numeric>

namespace lacuna::io {
namespace {

constexpr std::size_t kHeader = 80; // bytes, of any content
constexpr std::size_t kFacet = 50;  // bytes: a normal and three points as floats, and two unused bytes

/// The text at the start of a header; empty if the header does not start with text.
std::string_view name_in(std::string_view header)
{
    header = trimmed(header.substr(0, header.find('\0')));
    const bool text = std::ranges::none_of(header, [](unsigned char c) { return c < 32 || c == 127; });
    return text ? header : std::string_view();
}

std::uint32_t count_at(std::string_view bytes) { return from_bytes<std::uint32_t>(bytes.data(), false); }

class StlReader {
public:
    StlReader(Cursor& cursor, DeckBuilder& into) : cursor_(cursor), into_(into) {}

    void read_text()
    {
        do {
            cursor_.expect("solid");
            begin_solid(cursor_.line_end());
            while (same_word(cursor_.word("facet or endsolid"), "facet")) read_facet();
            end_of("solid");
            cursor_.line_end();
        } while (cursor_.more());
    }

    void read_binary()
    {
        cursor_.coding = Coding::little;
        check_counts();
        while (cursor_.rest().size() >= kHeader + 4) {
            const std::string_view header = cursor_.bytes(kHeader);
            const std::uint32_t count = count_at(cursor_.bytes(4));
            begin_solid(name_in(header));
            if (count > 0) read_binary_facets(count);
        }
        const std::string_view rest = cursor_.rest();
        if (std::ranges::any_of(rest, [](char c) { return c != 0 && c != '\n' && !is_blank(c); }))
            cursor_.fail_at(cursor_.position(),
                            "expected a header of 80 bytes and a count of facets, found only {} more bytes",
                            found(rest.size()));
    }

private:
    /// Check the counts of facets. Only correct counts lead to the header of the next solid.
    void check_counts() const
    {
        const std::string_view all = cursor_.rest();
        for (std::size_t at = 0; at + kHeader + 4 <= all.size();) {
            const std::uint64_t count = count_at(all.substr(at + kHeader)), begin = at + kHeader + 4;
            const std::uint64_t room = (all.size() - begin) / kFacet;
            if (count > room)
                cursor_.fail_at(at + kHeader,
                                "the header announces {} facets, but the bytes after it hold {}{}", count,
                                room, at == 0 ? "" : ": it or a count before it is wrong");
            at = begin + kFacet * count;
        }
    }

    void begin_solid(std::string_view name)
    {
        ++solids_;
        name_ = name;
        label_ = -1;
    }

    void read_facet()
    {
        cursor_.expect("normal");
        cursor_.line_end(); // skip the normal, which is recomputed from the corners
        cursor_.expect("outer");
        cursor_.expect("loop");
        std::array<Vec3, 3> corner;
        for (Vec3& p : corner) {
            cursor_.expect("vertex");
            p = cursor_.point();
        }
        cursor_.word("endloop");
        end_of("loop");
        cursor_.word("endfacet");
        end_of("facet");
        add(corner);
    }

    /// Check that the last word ends a block: "endloop", or "end" followed by "loop".
    void end_of(const std::string& thing)
    {
        if (same_word(cursor_.last_word(), "end"))
            cursor_.expect(thing);
        else
            cursor_.expect_last("end" + thing);
    }

    void read_binary_facets(std::size_t count)
    {
        check_room(count);
        std::vector<Vec3>& points = into_.points();
        const auto first = static_cast<Index>(points.size());
        reserve_large(points, points.size() + 3 * count);
        for (std::size_t f = 0; f < count; ++f) {
            const std::string_view bytes = cursor_.bytes(kFacet);
            for (std::size_t corner = 0; corner < 3; ++corner) {
                Vec3& p = points.emplace_back();
                for (std::size_t i = 0; i < 3; ++i)
                    p[Index(i)] = from_bytes<float>(bytes.data() + 12 + 4 * (3 * corner + i), false);
                if (!p.allFinite()) cursor_.fail("expected finite coordinates, found one that is not finite");
            }
        }
        const auto room = into_.add_elements(into_.block_of(DeckShape::tri3, ""), count, label());
        std::iota(room.nodes, room.nodes + 3 * count, first);
    }

    void add(const std::array<Vec3, 3>& corner)
    {
        check_room(1);
        std::vector<Vec3>& points = into_.points();
        const auto first = static_cast<Index>(points.size());
        points.insert(points.end(), corner.begin(), corner.end());
        into_.add_face(Triangle{first, first + 1, first + 2}, label(), cursor_);
    }

    void check_room(std::size_t facets)
    {
        if (!is_index(into_.points().size() + 3 * facets)) cursor_.fail("too many facets");
    }

    /// The region of the current solid, created with its first facet.
    int label()
    {
        if (label_ < 0) label_ = into_.add_region(solids_, name_);
        return label_;
    }

    Cursor& cursor_;
    DeckBuilder& into_;
    int solids_ = 0;
    int label_ = -1;
    std::string_view name_;
};

} // namespace

bool is_binary_stl(std::string_view bytes)
{
    return bytes.size() >= kHeader + 4 &&
           bytes.size() == kHeader + 4 + kFacet * std::uint64_t(count_at(bytes.substr(kHeader)));
}

void read_stl(Cursor& cursor, DeckBuilder& into)
{
    StlReader reader(cursor, into);
    // Headers of binary files may begin with "solid" too, but the count after them contains a zero byte.
    const bool text = !is_binary_stl(cursor.rest()) &&
                      same_word(trimmed(cursor.rest()).substr(0, 5), "solid") &&
                      cursor.rest().substr(0, kHeader + 4).find('\0') == std::string_view::npos;
    if (text)
        reader.read_text();
    else
        reader.read_binary();
}

} // namespace lacuna::io
