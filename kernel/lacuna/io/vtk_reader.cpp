// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/large_pages.h>
#include <lacuna/io/detail/vtk_cells.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lacuna::io {
namespace {

/// Reads the geometry of a legacy file. The data of points and cells come after it and are ignored.
class VtkReader {
public:
    VtkReader(Cursor& cursor, DeckBuilder& into) : cursor_(cursor), into_(into) {}

    void read()
    {
        const std::string_view head = cursor_.line();
        if (!same_word(head.substr(0, 22), "# vtk DataFile Version"))
            cursor_.fail("expected \"# vtk DataFile Version\", found {}", found(shown(head)));
        into_.deck().version =
            parse_real(trimmed(head.substr(std::min<std::size_t>(22, head.size())))).value_or(0);
        cursor_.line(); // the title, which may be any text
        const std::string_view coding = cursor_.word("ASCII or BINARY");
        if (!same_word(coding, "ASCII") && !same_word(coding, "BINARY"))
            cursor_.fail("expected ASCII or BINARY, found {}", found(shown(coding)));
        cursor_.has_bytes = binary_ = same_word(coding, "BINARY");
        while (cursor_.more()) {
            const std::string_view word = cursor_.word();
            if (same_word(word, "CELL_DATA") || same_word(word, "POINT_DATA")) {
                // If the file has groups, its first cell array is `entity`; see `note_groups()`.
                const std::string_view next = cursor_.rest().substr(0, 64);
                if (next.find("\nSCALARS entity int") != std::string_view::npos) note_groups(groups_, into_);
                break;
            }
            read_section(word);
        }
        if (cells_.types.empty() && !unstructured_.empty())
            cursor_.fail("the file has CELLS and no CELL_TYPES");
        if (!unstructured_.empty()) {
            cells_.ends = std::move(unstructured_);
            cells_.points = std::move(unstructured_points_);
            take_cells();
        }
    }

private:
    void read_section(std::string_view word)
    {
        if (same_word(word, "DATASET")) {
            const std::string_view kind = cursor_.word("a kind of data set");
            if (!same_word(kind, "POLYDATA") && !same_word(kind, "UNSTRUCTURED_GRID"))
                cursor_.fail(Message(kUnreadable, "expected DATASET POLYDATA or UNSTRUCTURED_GRID, found {}",
                                     found(shown(kind)))
                                 .remedy("write it as one of them"));
        } else if (same_word(word, "POINTS")) {
            read_points();
        } else if (same_word(word, "POLYGONS") || same_word(word, "TRIANGLE_STRIPS")) {
            read_lists(cells_.ends, cells_.points);
            cells_.strips = same_word(word, "TRIANGLE_STRIPS");
            take_cells();
        } else if (same_word(word, "VERTICES") || same_word(word, "LINES")) {
            read_lists(cells_.ends, cells_.points);
            into_.pass_over(same_word(word, "LINES") ? "lines" : "vertices", cells_.ends.size());
        } else if (same_word(word, "CELLS")) {
            if (!unstructured_.empty()) cursor_.fail("the section CELLS occurs twice");
            read_lists(unstructured_, unstructured_points_);
        } else if (same_word(word, "CELL_TYPES")) {
            const std::uint64_t count = cursor_.size();
            cells_.types = read_wholes("int", count);
        } else if (same_word(word, "METADATA")) {
            for (cursor_.line(); !cursor_.at_end() && !cursor_.line().empty();) {}
        } else if (same_word(word, "FIELD")) {
            skip_field();
        } else {
            cursor_.fail("expected a section such as POINTS or CELLS, found {}", found(shown(word)));
        }
    }

    void read_points()
    {
        if (!into_.points().empty()) cursor_.fail("the section POINTS occurs twice");
        const std::uint64_t count = cursor_.size();
        if (!is_index(count)) cursor_.fail("too many points");
        const VtkType& type = needed_type(cursor_.word("a type of numbers"));
        plausible(count, 3 * type.bytes, 3);
        std::vector<Vec3>& points = into_.points();
        reserve_large(points, count);
        points.resize(count);
        double* out = count > 0 ? points.front().data() : nullptr;
        each_part<double>(type, 3 * count, [&](std::span<const double> values) {
            if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); }))
                cursor_.fail("expected finite coordinates, found one that is not finite");
            out = std::ranges::copy(values, out).out;
        });
    }

    /// Read lists of points. Each list follows its length; from version 5.1 on, all offsets come first, then
    /// all points.
    void read_lists(std::vector<std::int64_t>& ends, std::vector<Index>& points)
    {
        ends.clear();
        points.clear();
        const std::uint64_t lists = cursor_.size();
        const std::uint64_t values = cursor_.size();
        Cursor ahead = cursor_;
        if (ahead.more() && same_word(ahead.word(), "OFFSETS")) {
            cursor_.expect("OFFSETS");
            ends = read_wholes(cursor_.word("a type of numbers"), lists);
            cursor_.expect("CONNECTIVITY");
            read_places(cursor_.word("a type of numbers"), values, points);
            if (!ends.empty() && ends.front() != 0) cursor_.fail("expected the first offset to be 0");
            if (!ends.empty() && ends.back() != static_cast<std::int64_t>(points.size()))
                cursor_.fail("expected the last offset to be {}, found {}", points.size(),
                             found(ends.back()));
            if (!ends.empty()) ends.erase(ends.begin());
            return;
        }
        plausible(values, 4, 1);
        reserve_large(ends, std::min(lists, values));
        reserve_large(points, values - std::min(lists, values));
        const std::string_view bytes = binary_ ? array_bytes(needed_type("int"), values) : std::string_view();
        const auto number = [&](std::uint64_t i) {
            return binary_ ? from_bytes<std::int32_t>(bytes.data() + 4 * i, true) : cursor_.text_integer();
        };
        std::int64_t left = 0;
        for (std::uint64_t i = 0; i < values;) {
            left = number(i++);
            if (left < 0) cursor_.fail("expected the length of a list, found {}", found(left));
            ends.push_back(static_cast<std::int64_t>(points.size()) + left);
            for (; left > 0 && i < values; --left) points.push_back(place_of(number(i++)));
        }
        if (left != 0 || ends.size() != lists)
            cursor_.fail("expected {} lists in {} numbers, found {}", needed(lists), values,
                         found(ends.size()));
    }

    void take_cells()
    {
        cells_.last_point = static_cast<Index>(into_.points().size());
        take_vtk_cells(cells_, into_, cursor_);
    }

    /// Skip arrays that belong to the whole file.
    void skip_field()
    {
        cursor_.word("a name");
        const std::uint64_t arrays = cursor_.size();
        for (std::uint64_t a = 0; a < arrays; ++a) {
            const std::string_view name = cursor_.word("the name of an array");
            if (same_word(name, "METADATA")) {
                for (cursor_.line(); !cursor_.at_end() && !cursor_.line().empty();) {}
                --a;
                continue;
            }
            const std::uint64_t components = cursor_.size();
            const std::uint64_t tuples = cursor_.size();
            const std::string_view kind = cursor_.word("a type of numbers");
            if (components != 0 && tuples > std::numeric_limits<std::uint64_t>::max() / 64 / components)
                cursor_.fail("expected a smaller array");
            const std::uint64_t count = components * tuples;
            if (same_word(kind, "int") && components == 1) groups_.push_back(name);
            if (same_word(kind, "string"))
                for (std::uint64_t i = 0; i < count; ++i) skip_string();
            else
                each_part<double>(needed_type(kind), count, [](std::span<const double>) {});
        }
    }

    void skip_string()
    {
        if (cursor_.at_end()) cursor_.fail("the file ends where a text was expected");
        if (binary_)
            cursor_.fail(
                Message(kUnreadable, "texts in binary files are not read").remedy("write the file as text"));
        cursor_.line();
    }

    /// A point number, checked to be an `Index`.
    Index place_of(std::int64_t value) const
    {
        const auto place = static_cast<Index>(value);
        if (place != value) cursor_.fail("expected the number of a point, found {}", found(value));
        return place;
    }

    void read_places(std::string_view name, std::uint64_t count, std::vector<Index>& places)
    {
        const VtkType& type = needed_type(name);
        reserve_large(places, plausible(count, type.bytes, 1));
        each_part<std::int64_t>(type, count, [&](std::span<const std::int64_t> values) {
            for (const std::int64_t value : values) places.push_back(place_of(value));
        });
    }

    std::vector<std::int64_t> read_wholes(std::string_view name, std::uint64_t count)
    {
        const VtkType& type = needed_type(name);
        std::vector<std::int64_t> all;
        reserve_large(all, plausible(count, type.bytes, 1));
        each_part<std::int64_t>(type, count, [&](std::span<const std::int64_t> values) {
            all.insert(all.end(), values.begin(), values.end());
        });
        return all;
    }

    const VtkType& needed_type(std::string_view name) const
    {
        const VtkType* type = vtk_type(name);
        if (type == nullptr)
            cursor_.fail("expected a number type such as float, found {}", found(shown(name)));
        return *type;
    }

    /// A count that the rest of the file can hold.
    std::uint64_t plausible(std::uint64_t count, std::uint64_t bytes, std::uint64_t values)
    {
        cursor_.coding = binary_ ? Coding::big : Coding::text;
        cursor_.plausible(count, bytes, values);
        cursor_.coding = Coding::text;
        return count;
    }

    /// The bytes of an array, which begin on the line after its header.
    std::string_view array_bytes(const VtkType& type, std::uint64_t count)
    {
        cursor_.line();
        return cursor_.bytes(type.bytes * count);
    }

    /// Call `take(numbers)` for the next `count` numbers, some at a time.
    template <class Number, class Take>
    void each_part(const VtkType& type, std::uint64_t count, const Take& take)
    {
        plausible(count, type.bytes, 1);
        if (std::is_integral_v<Number> && type.wholes == nullptr)
            cursor_.fail("expected whole numbers, found type {}", type.legacy);
        if (binary_) return io::each_part<Number>(type, array_bytes(type, count), true, take);
        for (std::uint64_t i = 0; i < count; ++i) {
            const Number value = std::is_integral_v<Number> ? Number(cursor_.text_integer())
                                                            : Number(cursor_.text_real());
            take(std::span(&value, 1));
        }
    }

    Cursor& cursor_;
    DeckBuilder& into_;
    bool binary_ = false;
    VtkCells cells_;
    std::vector<std::string_view> groups_;   ///< names of fields of whole numbers
    std::vector<std::int64_t> unstructured_; ///< ends of the lists in CELLS, kept until the cells' types are
                                             ///< known
    std::vector<Index> unstructured_points_;
};

} // namespace

void read_vtk(Cursor& cursor, DeckBuilder& into) { VtkReader(cursor, into).read(); }

} // namespace lacuna::io
