// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/deck_builder.h>

#include <algorithm>

namespace lacuna::io {
namespace {

/// Words of a Wavefront file that do not contribute to faces. They are skipped without a note.
constexpr std::string_view kUncounted[] = {"vt", "vn", "s", "usemtl", "mtllib"};

class ObjReader {
public:
    ObjReader(Cursor& cursor, DeckBuilder& into) : cursor_(cursor), into_(into) {}

    void read()
    {
        while (!cursor_.at_end()) {
            line_ = without_comment(cursor_.line());
            const std::size_t begin = cursor_.last();
            // A line that ends with a backslash continues on the next one; a comment does not.
            std::string joined;
            while (line_.ends_with('\\')) {
                if (joined.empty()) joined = line_;
                joined.back() = ' ';
                joined += cursor_.at_end() ? std::string_view() : without_comment(cursor_.line());
                line_ = joined;
            }
            begin_ = begin;
            read_line();
        }
    }

private:
    static std::string_view without_comment(std::string_view line)
    {
        return trimmed(line.substr(0, line.find('#')));
    }

    void read_line()
    {
        const std::string_view word = next_word(line_);
        if (word.empty()) return;
        if (word == "v") {
            if (!is_index(into_.points().size() + 1)) fail("too many points");
            Vec3 p;
            for (double& x : p) x = coordinate(next_word(line_));
            into_.points().push_back(p);
        } else if (word == "f") {
            read_face();
        } else if (word == "o" || word == "g") {
            name_ = trimmed(line_);
            label_ = -1;
        } else if (std::ranges::find(kUncounted, word) == std::end(kUncounted)) {
            into_.pass_over("lines \"" + std::string(word.substr(0, 8)) + '"');
        }
    }

    void read_face()
    {
        corners_.clear();
        for (std::string_view word = next_word(line_); !word.empty(); word = next_word(line_))
            corners_.push_back(corner(word.substr(0, word.find('/'))));
        if (corners_.size() < 3)
            fail("expected a face of three corners or more, found {}", found(corners_.size()));
        if (label_ < 0) label_ = into_.add_region(++labels_, name_);
        into_.add_face(corners_, label_, cursor_);
    }

    /// The point that a number means: counted from 1 or, if it is negative, back from the last point.
    Index corner(std::string_view word) const
    {
        const auto value = parse_integer<std::int64_t>(word);
        const auto count = static_cast<std::int64_t>(into_.points().size());
        const std::int64_t place = !value ? -1 : *value > 0 ? *value - 1 : count + *value;
        if (!value || *value == 0 || place < 0 || place >= count)
            fail("expected the number of one of the {} points so far, found {}", count, found(shown(word)));
        return static_cast<Index>(place);
    }

    double coordinate(std::string_view word) const
    {
        const auto value = parse_real(word);
        if (!value) fail("expected a finite coordinate, found {}", found(shown(word)));
        return *value;
    }

    template <class... Arguments>
    [[noreturn]] void fail(lacuna::Format<sizeof...(Arguments)> format, const Arguments&... arguments) const
    {
        cursor_.fail_at(begin_, format, arguments...);
    }

    Cursor& cursor_;
    DeckBuilder& into_;
    std::string_view line_; ///< the unread rest of the line
    std::size_t begin_ = 0;
    std::vector<Index> corners_;
    std::string name_;
    int label_ = -1, labels_ = 0;
};

} // namespace

void read_obj(Cursor& cursor, DeckBuilder& into) { ObjReader(cursor, into).read(); }

} // namespace lacuna::io
