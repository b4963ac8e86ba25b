// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/large_pages.h>
#include <lacuna/io/detail/inflate.h>
#include <lacuna/io/detail/vtk_cells.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lacuna::io {
namespace {

/// A begin or end tag; attributes keep their order.
struct XmlTag {
    std::string_view name; ///< begins with '/' for an end tag
    std::vector<std::pair<std::string_view, std::string_view>> attributes;
    bool empty = false; ///< has no content and no end tag

    [[nodiscard]] std::string_view operator[](std::string_view attribute) const
    {
        for (const auto& [key, value] : attributes)
            if (key == attribute) return value;
        return {};
    }
};

/// The value of a base64 digit; -1 for other characters.
int base64_value(char c)
{
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// Decode base64 text up to the first invalid character; blanks and line ends are skipped. The text may
/// consist of several pieces, each padded with '='.
/// @param most  number of bytes that are needed; no more are decoded.
std::string from_base64(std::string_view text, std::uint64_t most)
{
    std::string bytes;
    bytes.reserve(std::min<std::uint64_t>(most, text.size() / 4 * 3 + 3));
    std::uint32_t bits = 0;
    int held = 0;
    for (const char c : text) {
        if (bytes.size() >= most) break;
        if (c == '=') {
            held = 0;
            bits = 0;
            continue;
        }
        const int value = base64_value(c);
        if (value < 0) {
            if (is_blank(c) || c == '\n') continue;
            break;
        }
        bits = (bits << 6 | static_cast<std::uint32_t>(value)) & 0xFFFFFF;
        held += 6;
        if (held >= 8) {
            held -= 8;
            bytes += static_cast<char>(bits >> held & 0xFF);
        }
    }
    return bytes;
}

class VtuReader {
public:
    VtuReader(Cursor& cursor, DeckBuilder& into) : cursor_(cursor), into_(into) {}

    void read()
    {
        XmlTag tag;
        while (next_tag(tag)) {
            if (tag.name == "VTKFile")
                read_head(tag);
            else if (!headed_)
                cursor_.fail("expected <VTKFile>, found <{}>", found(tag.name.substr(0, 40)));
            else if (tag.name == "Piece")
                pieces_.push_back(
                    {count(tag, "NumberOfPoints"), count(tag, "NumberOfCells"), {}, {}, {}, {}});
            else if (tag.name == "Points" || tag.name == "Cells" || tag.name == "FieldData" ||
                     tag.name == "CellData")
                section_ = tag.empty ? std::string_view() : tag.name;
            else if (tag.name.starts_with('/') && tag.name.substr(1) == section_)
                section_ = {};
            else if (tag.name == "DataArray")
                take_array(tag);
            else if (tag.name == "AppendedData") {
                read_appended(tag);
                break;
            }
        }
        if (!headed_) cursor_.fail("expected <VTKFile>, found none");
        for (const Piece& piece : pieces_) read_piece(piece);
        if (has_entities_) note_groups(groups_, into_);
    }

private:
    struct Array {
        const VtkType* type = nullptr;
        std::string_view format, text; ///< `text`: the content between its begin and end tags
        std::uint64_t offset = 0;
        std::size_t position = 0;
    };
    struct Piece {
        std::uint64_t points, cells;
        Array at, connectivity, offsets, types;
    };

    /// Read the next tag, skipping comments and declarations. @return  false at the end of the file.
    bool next_tag(XmlTag& tag)
    {
        while (cursor_.skip_past("<")) {
            if (cursor_.rest().starts_with("!--")) {
                if (!cursor_.skip_past("-->")) cursor_.fail("the file ends within a comment");
                continue;
            }
            const std::string_view rest = cursor_.rest();
            const std::size_t end = tag_end(rest);
            if (end == std::string_view::npos)
                cursor_.fail_at(cursor_.position(), "the file ends within a tag");
            std::string_view inside = cursor_.bytes(end + 1).substr(0, end);
            if (inside.starts_with('?') || inside.starts_with('!')) continue;
            tag = {};
            tag.empty = inside.ends_with('/');
            if (tag.empty) inside.remove_suffix(1);
            const std::size_t name = std::min(inside.find_first_of(" \t\r\n"), inside.size());
            tag.name = inside.substr(0, name);
            read_attributes(inside.substr(name), tag);
            return true;
        }
        return false;
    }

    /// The end of a tag; a `>` inside a quoted attribute does not end it.
    static std::size_t tag_end(std::string_view text)
    {
        char quote = '\0';
        for (std::size_t i = 0; i < text.size(); ++i) {
            const char c = text[i];
            if (quote != '\0')
                quote = c == quote ? '\0' : quote;
            else if (c == '"' || c == '\'')
                quote = c;
            else if (c == '>')
                return i;
        }
        return std::string_view::npos;
    }

    void read_attributes(std::string_view text, XmlTag& tag) const
    {
        while (!(text = trimmed(text)).empty()) {
            const std::size_t equals = text.find('=');
            if (equals == std::string_view::npos)
                cursor_.fail("expected an attribute, found {}", found(shown(text)));
            const std::string_view key = trimmed(text.substr(0, equals));
            text = trimmed(text.substr(equals + 1));
            const std::size_t end = text.empty() || (text[0] != '"' && text[0] != '\'')
                                        ? std::string_view::npos
                                        : text.find(text[0], 1);
            if (end == std::string_view::npos)
                cursor_.fail("expected a value in quotes, found {}", found(shown(text)));
            tag.attributes.emplace_back(key, text.substr(1, end - 1));
            text.remove_prefix(end + 1);
        }
    }

    void read_head(const XmlTag& tag)
    {
        if (tag["type"] != "UnstructuredGrid")
            cursor_.fail("expected type=\"UnstructuredGrid\", found {}", found(shown(tag["type"])));
        big_ = tag["byte_order"] == "BigEndian";
        if (!big_ && tag["byte_order"] != "LittleEndian" && !tag["byte_order"].empty())
            cursor_.fail("expected byte_order LittleEndian or BigEndian, found {}",
                         found(shown(tag["byte_order"])));
        compressor_ = tag["compressor"];
        const std::string_view header = tag["header_type"].empty() ? "UInt32" : tag["header_type"];
        if (header != "UInt32" && header != "UInt64")
            cursor_.fail("expected header_type UInt32 or UInt64, found {}", found(shown(header)));
        header_ = vtk_type(header);
        headed_ = true;
    }

    std::uint64_t count(const XmlTag& tag, std::string_view attribute) const
    {
        const auto value = parse_integer<Index>(trimmed(tag[attribute]));
        if (!value || *value < 0)
            cursor_.fail("expected a count {}, found {}", attribute, found(shown(tag[attribute])));
        return static_cast<std::uint64_t>(*value);
    }

    void take_array(const XmlTag& tag)
    {
        Array array{vtk_type(tag["type"]), tag["format"], {}, 0, cursor_.last()};
        if (!tag.empty) {
            // The text ends at the next tag, even an inner one such as <InformationKey>.
            array.text = cursor_.rest().substr(0, cursor_.rest().find('<'));
        }
        if (section_ == "FieldData" && tag["type"] == "Int32") groups_.push_back(tag["Name"]);
        if (section_ == "CellData" && tag["Name"] == "entity") has_entities_ = true;
        if ((section_ != "Points" && section_ != "Cells") || pieces_.empty()) return;
        if (array.format == "appended") {
            const auto offset = parse_integer<std::uint64_t>(trimmed(tag["offset"]));
            if (!offset) cursor_.fail("expected an offset, found {}", found(shown(tag["offset"])));
            array.offset = *offset;
        }
        Piece& piece = pieces_.back();
        Array* const own = section_ == "Points"            ? &piece.at
                           : tag["Name"] == "connectivity" ? &piece.connectivity
                           : tag["Name"] == "offsets"      ? &piece.offsets
                           : tag["Name"] == "types"        ? &piece.types
                                                           : nullptr;
        if (own != nullptr) *own = array;
    }

    void read_appended(const XmlTag& tag)
    {
        base64_ = tag["encoding"] == "base64";
        if (!base64_ && tag["encoding"] != "raw")
            cursor_.fail("expected encoding raw or base64, found {}", found(shown(tag["encoding"])));
        if (!cursor_.skip_past("_")) cursor_.fail("expected _ before the appended data");
        appended_ = cursor_.rest();
    }

    void read_piece(const Piece& piece)
    {
        VtkCells cells;
        std::vector<Vec3>& points = into_.points();
        if (!is_index(points.size() + piece.points)) cursor_.fail("too many points");
        cells.first_point = static_cast<Index>(points.size());
        read_points(piece);
        cells.last_point = static_cast<Index>(points.size());
        cells.ends = wholes(piece.offsets, "offsets", piece.cells);
        cells.types = wholes(piece.types, "types", piece.cells);
        const std::int64_t all = cells.ends.empty() ? 0 : cells.ends.back();
        if (all < 0) cursor_.fail_at(piece.offsets.position, "expected increasing offsets");
        read_places(piece.connectivity, static_cast<std::uint64_t>(all), cells.points);
        cells.first_cell = cells_;
        cells_ += static_cast<DeckTag>(piece.cells);
        take_vtk_cells(cells, into_, cursor_);
    }

    void read_points(const Piece& piece)
    {
        std::vector<Vec3>& points = into_.points();
        const std::size_t first = points.size();
        std::size_t done = 0; // numbers read so far
        each_part<double>(piece.at, "Points", 3 * piece.points, [&](std::span<const double> values) {
            const std::size_t more = (done + values.size() + 2) / 3 - (points.size() - first);
            make_room(points, more);
            points.resize(points.size() + more);
            std::ranges::copy(values, points[first].data() + done);
            done += values.size();
        });
        for (std::size_t p = first; p < points.size(); ++p)
            if (!points[p].allFinite()) cursor_.fail_at(piece.at.position, "expected finite coordinates");
    }

    std::vector<std::int64_t> wholes(const Array& array, const char* name, std::uint64_t count)
    {
        std::vector<std::int64_t> all;
        each_part<std::int64_t>(array, name, count, [&](std::span<const std::int64_t> values) {
            make_room(all, values.size());
            all.insert(all.end(), values.begin(), values.end());
        });
        return all;
    }

    void read_places(const Array& array, std::uint64_t count, std::vector<Index>& places)
    {
        each_part<std::int64_t>(array, "connectivity", count, [&](std::span<const std::int64_t> values) {
            make_room(places, values.size());
            for (const std::int64_t value : values) {
                places.push_back(static_cast<Index>(value));
                if (places.back() != value)
                    cursor_.fail_at(array.position, "expected the number of a point, found {}", found(value));
            }
        });
    }

    /// Call `take(numbers)` for all `count` numbers of an array, some at a time. Whole numbers may be stored
    /// as floating-point numbers.
    template <class Number, class Take>
    void each_part(const Array& array, const char* name, std::uint64_t count, const Take& take)
    {
        const auto take_real = [&](double value) {
            // a double can represent every whole number of as many bits as it has digits
            if (std::is_integral_v<Number> &&
                (value != std::floor(value) ||
                 std::abs(value) > std::ldexp(1, std::numeric_limits<double>::digits)))
                cursor_.fail_at(array.position, "expected whole numbers as {}", name);
            const auto number = static_cast<Number>(value);
            take(std::span(&number, 1));
        };
        each_run(array, name, count, take_real, [&](std::string_view bytes) {
            if (std::is_integral_v<Number> && array.type->wholes == nullptr)
                io::each_part<double>(*array.type, bytes, big_, [&](std::span<const double> values) {
                    std::ranges::for_each(values, take_real);
                });
            else
                io::each_part<Number>(*array.type, bytes, big_, take);
        });
    }

    /// Read all `count` values of an array in any encoding. Values in text are passed one by one to
    /// `take(value)`, binary values to `run(bytes)`, some at a time.
    template <class Take, class Run>
    void each_run(const Array& array, const char* name, std::uint64_t count, const Take& take, const Run& run)
    {
        const auto fail = [&]<class... Arguments>(lacuna::Format<sizeof...(Arguments)> format,
                                                  const Arguments&... arguments) {
            cursor_.fail_at(array.position, Message(kUnreadable, format, arguments...).about(name));
        };
        if (count == 0) return;
        if (array.type == nullptr) fail("expected an array of numbers, found none");
        if (array.format == "ascii") {
            Cursor text = cursor_.part(array.text);
            for (std::uint64_t i = 0; i < count; ++i) take(text.text_real());
            if (text.more()) fail("expected {} numbers, found more", needed(count));
            return;
        }
        if (array.format != "binary" && array.format != "appended")
            fail("expected format ascii, binary or appended, found {}", found(shown(array.format)));
        const bool appended = array.format == "appended";
        if (appended && array.offset > appended_.size())
            fail("the array begins after the end of the appended data");
        const std::string_view from = appended ? appended_.substr(array.offset) : array.text;
        if (!compressor_.empty() && compressor_ != "vtkZLibDataCompressor")
            cursor_.fail_at(array.position,
                            Message(kUnreadable, "data compressed by {} are not read", shown(compressor_))
                                .remedy("write the file with another compressor or none")
                                .about(name));
        if (!compressor_.empty()) return each_compressed(array, from, appended && !base64_, count, fail, run);
        // Reject a count that the text cannot hold.
        if (count > from.size()) fail("the file is cut off: expected {} numbers", needed(count));
        const std::uint64_t least = header_->bytes + count * array.type->bytes;
        const std::string decoded = appended && !base64_ ? std::string() : from_base64(from, least);
        const std::string_view bytes = appended && !base64_ ? from : std::string_view(decoded);
        if (bytes.size() < least)
            fail("the file is cut off: expected {} bytes, found {}", needed(least), found(bytes.size()));
        const std::uint64_t announced = header_number(bytes.data());
        if (announced != count * array.type->bytes)
            fail("expected {} bytes, found {}", needed(count * array.type->bytes), found(announced));
        run(bytes.substr(header_->bytes, count * array.type->bytes));
    }

    /// A number of the type that the file's header declares.
    [[nodiscard]] std::uint64_t header_number(const char* bytes) const
    {
        std::int64_t number = 0;
        header_->wholes(bytes, big_, 1, &number);
        return static_cast<std::uint64_t>(number);
    }

    /// Read values from blocks that are compressed separately. A list of their lengths precedes them.
    template <class Fail, class Run>
    void each_compressed(const Array& array, std::string_view from, bool raw, std::uint64_t count,
                         const Fail& fail, const Run& run)
    {
        const std::size_t width = header_->bytes;
        const auto decoded = [&](std::uint64_t most) {
            return raw ? std::string(from.substr(0, most)) : from_base64(from, most);
        };
        const auto whole = [&](const std::string& bytes, std::uint64_t k) {
            if (bytes.size() < (k + 1) * width) fail("the file is cut off in a list of compressed blocks");
            return header_number(bytes.data() + k * width);
        };
        const std::string head = decoded(3 * width);
        const std::uint64_t blocks = whole(head, 0);
        const std::uint64_t size = whole(head, 1);
        const std::uint64_t last = whole(head, 2);
        if (blocks > from.size()) fail("the file is cut off: expected {} blocks", needed(blocks));
        const std::string list = decoded((3 + blocks) * width);
        std::uint64_t packed = (3 + blocks) * width;
        for (std::uint64_t b = 0; b < blocks; ++b) {
            const std::uint64_t length = whole(list, 3 + b);
            if (length > from.size()) fail("the file is cut off: a block has {} bytes", length);
            packed += length;
        }
        const std::string bytes = raw ? std::string() : decoded(packed);
        const std::string_view all = raw ? from.substr(0, packed) : std::string_view(bytes);
        if (all.size() < packed)
            fail("the file is cut off: expected {} bytes, found {}", needed(packed), found(all.size()));
        std::string left; // the start of a value that continues in the next block
        std::uint64_t taken = 0;
        for (std::uint64_t b = 0, at = (3 + blocks) * width; b < blocks; ++b) {
            const std::uint64_t length = whole(list, 3 + b);
            const std::uint64_t wanted = b + 1 == blocks && last > 0 ? last : size;
            const auto plain = inflate(all.substr(at, length), wanted);
            if (!plain) fail("block {} of the compressed data is damaged", b + 1);
            at += length;
            left += *plain;
            const std::uint64_t here = std::min<std::uint64_t>(count - taken,
                                                               left.size() / array.type->bytes);
            run(std::string_view(left).substr(0, here * array.type->bytes));
            taken += here;
            left.erase(0, here * array.type->bytes);
            if (taken == count && !left.empty()) break;
        }
        if (taken != count || !left.empty())
            fail("expected {} numbers in the compressed data, found {}", needed(count),
                 found(taken == count ? "more" : std::to_string(taken)));
    }

    Cursor& cursor_;
    DeckBuilder& into_;
    std::vector<Piece> pieces_;
    std::string_view section_, appended_;
    const VtkType* header_ = nullptr;
    std::string_view compressor_;          ///< empty: none
    std::vector<std::string_view> groups_; ///< names of lists of entities
    bool has_entities_ = false;
    DeckTag cells_ = 0;
    bool headed_ = false, big_ = false, base64_ = false;
};

} // namespace

void read_vtu(Cursor& cursor, DeckBuilder& into) { VtuReader(cursor, into).read(); }

} // namespace lacuna::io
