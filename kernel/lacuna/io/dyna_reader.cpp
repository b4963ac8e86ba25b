// SPDX-License-Identifier: MIT
//
// Keyword decks of LS-DYNA. Nodes, solids, shells, parts and sets are the mesh; all other cards are kept as
// text.
#include <lacuna/io/detail/dyna.h>

#include <lacuna/core/shared/same_corners.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/deck_files.h>
#include <lacuna/io/detail/deck_writer.h>
#include <lacuna/io/detail/join_sets.h>

#include <algorithm>
#include <optional>
#include <set>
#include <unordered_map>

namespace lacuna::io {

void read_dyna(Cursor& cursor, DeckBuilder& into);

namespace {

using enum DeckShape;
using namespace dyna_keyword;
using mesh::SetKind;

/// Patterns of repeated nodes that are read besides those that are written: a wedge whose triangle is swept,
/// and a tetrahedron on its first three corners.
constexpr Degenerate kReadToo[] = {{wedge6, {0, 1, 2, 2, 3, 4, 5, 5}}, {tet4, {0, 1, 2, 2, 3, 3, 3, 3}}};

class DynaReader {
public:
    DynaReader(Cursor& cursor, DeckBuilder& into) : main_(cursor), into_(into), files_(cursor) {}

    void read()
    {
        read_file(main_, 0);
        end_card();
        if (into_.points().empty()) main_.fail_at(0, "expected cards *NODE, found none");
        const TagPlaces tags(into_.deck().point_tags, [&](Index, Index node) {
            main_.fail("{} is defined twice", numbered("node", into_.deck().point_tags[index(node)]));
        });
        into_.resolve(tags, [&](std::uint64_t at, const Message& why) { files_.place_of(at).fail(why); });
        const std::vector<DeckTag> elements = element_tags(into_.deck());
        const TagPlaces unique(elements, [&](Index a, Index) {
            main_.fail(Message(kUnreadable, "{} is defined twice", numbered("element", elements[index(a)]))
                           .remedy("give each solid and each shell its own number"));
        });
        name_regions();
        find_sides();
        for (SetCard& card : sets_) add_set(card);
        std::vector<DeckText>& texts = into_.deck().texts;
        if (head_.find('*') == head_.npos) head_ += "*KEYWORD\n";
        texts.push_back({DeckText::Place::head, "", head_});
        texts.push_back({DeckText::Place::cards, "", cards_});
        texts.push_back({DeckText::Place::tail, "", "*END\n"});
    }

private:
    enum class Mode { keep, node, element, set, include };
    /// A set. Its card is kept as text if the deck cannot hold the set.
    struct SetCard {
        SetKind kind;
        bool titled, ranges;
        std::size_t width;
        std::string text;
        DeckPlace place;
    };

    void read_file(Cursor& cursor, std::uint64_t file)
    {
        while (!cursor.at_end()) {
            const std::string_view raw = cursor.raw_line();
            place_ = {&cursor, cursor.last(), file};
            std::string_view line = raw;
            if (line.ends_with('\r')) line.remove_suffix(1);
            if (line.starts_with('*')) {
                end_card();
                if (dyna_keyword_of(line) == "END") return;
                begin_card(line);
                if (keyword_ == "KEYWORD" && begun_) continue;
                begun_ = begun_ || keyword_ != "KEYWORD";
            }
            const bool is_data = !line.starts_with('*') && !line.starts_with('$');
            if (mode_ == Mode::keep) {
                (begun_ ? cards_ : head_).append(line).append("\n");
                begun_ = begun_ || line.starts_with('*');
            } else if (mode_ == Mode::set) {
                sets_.back().text.append(line).append("\n");
            } else if (is_data && !trimmed(line).empty()) {
                if (mode_ == Mode::node)
                    take_node(line);
                else if (mode_ == Mode::element)
                    take_element(line);
                else
                    take_include(trimmed(line));
            }
        }
    }

    void begin_card(std::string_view line)
    {
        keyword_ = dyna_keyword_of(line);
        const std::string_view end = trimmed(line.substr(0, line.find('$')));
        // In long format, each field has twice the columns.
        const auto width_of = [&](std::size_t plain) {
            return end.ends_with('+') || (long_ && !end.ends_with('-'))  ? 2 * kDynaSetField
                   : end.ends_with('%') || (ten_ && !end.ends_with('-')) ? std::max(plain, kDynaSetField)
                                                                         : plain;
        };
        width_ = width_of(kCardField);
        mode_ = Mode::keep;
        std::string base = keyword_;
        const bool titled = base.ends_with("_TITLE");
        if (titled) base.resize(base.size() - 6);
        const bool ranges = base.ends_with("_GENERATE");
        if (ranges) base.resize(base.size() - 9);
        if (base.ends_with("_LIST")) base.resize(base.size() - 5);
        if (keyword_ == "KEYWORD") {
            const std::string options = upper(line);
            const bool wide = options.find("LONG=") != options.npos,
                       ten = options.find("I10=Y") != options.npos;
            if (begun_ && (wide != long_ || ten != ten_))
                place_.fail("the fields of an included file have another width than those of the deck");
            long_ = wide, ten_ = ten;
        } else if (keyword_ == "NODE") {
            mode_ = Mode::node;
        } else if (keyword_ == kSolid || keyword_ == kSolid20 || keyword_ == kThick || keyword_ == kShell) {
            mode_ = Mode::element;
        } else if (keyword_ == "INCLUDE") {
            mode_ = Mode::include;
        } else if (keyword_.starts_with("INCLUDE") || keyword_.starts_with("NODE_TRANSFORM")) {
            place_.fail(Message(kUnreadable, "*{} is not read", keyword_)
                            .remedy("write the deck with the cards that it stands for"));
        } else if (base == "SET_NODE" || base == "SET_SOLID" || base == "SET_SHELL" ||
                   base == "SET_SEGMENT") {
            mode_ = Mode::set;
            const SetKind kind = base == "SET_NODE"      ? SetKind::nodes
                                 : base == "SET_SEGMENT" ? SetKind::sides
                                                         : SetKind::elements;
            sets_.push_back({kind, titled, ranges, width_of(kDynaSetField), {}, place_});
        } else {
            const bool element = keyword_.starts_with(kSolid) || keyword_.starts_with(kShell);
            if (element && unread_.insert(keyword_).second)
                into_.warn(formatted("elements of *{} are kept as text and have no faces", keyword_));
            into_.pass_over("*" + keyword_);
        }
    }

    /// At the next keyword, finish the card before it.
    void end_card()
    {
        if (mode_ == Mode::element && (!head_line_.empty() || !nodes_.empty()))
            place_.fail("*{} ends within an element", keyword_);
        mode_ = Mode::keep;
    }

    void take_include(std::string_view name)
    {
        if (name.ends_with(" +"))
            place_.fail(Message(kUnreadable, "INCLUDE: the name of the file continues on the next line")
                            .remedy("give it a shorter name"));
        const DeckPlace place = place_;
        Cursor& included = files_.include(std::string(name), place);
        mode_ = Mode::keep;
        read_file(included, files_.last());
        end_card();
        mode_ = Mode::include;
    }

    Index number(std::string_view field, const char* what) const
    {
        if (field.starts_with('&') || field.starts_with("-&"))
            place_.fail(Message(kUnreadable, "{} is a parameter; parameters are not read", shown(field))
                            .remedy("write its value"));
        if (field.empty()) return 0;
        const auto value = parse_integer<Index>(field);
        if (!value || *value < 0)
            place_.fail("expected the number of {}, found {}", what, found(shown(field)));
        return *value;
    }

    void take_node(std::string_view line)
    {
        const std::size_t real = std::max(width_, kLargeCardField);
        const auto fields = dyna_fields(line, width_, real, 4);
        Vec3 point = Vec3::Zero();
        if (fields.empty() || fields[0].empty()) place_.fail("expected the number of a node, found none");
        for (std::size_t k = 1; k < fields.size(); ++k) {
            const auto value = fields[k].empty() ? 0.0 : parse_real(fields[k], Exponents::fortran);
            if (!value) place_.fail("expected a coordinate, found {}", found(shown(fields[k])));
            point[static_cast<Index>(k) - 1] = *value;
        }
        into_.add_point(number(fields[0], "a node"), point, *place_.cursor);
        // The fields after the coordinates are the constraints of the node.
        std::string_view more = line.substr(std::min(width_ + 3 * real, line.size()));
        if (line.find(',') != line.npos)
            more = fields.size() < 4 ? "" : line.substr(std::min(line.size(), text_after(line, fields[3])));
        std::string text;
        for (const std::string_view field : dyna_fields(more, width_, width_, 2))
            text += std::string(kCardField - std::min(kCardField, field.size()), ' ').append(field);
        if (text.find_first_not_of(" 0.") != text.npos)
            into_.deck().point_more.emplace_back(into_.points().size() - 1, std::move(text));
    }

    /// The position after a field of a line and its comma.
    static std::size_t text_after(std::string_view line, std::string_view field)
    {
        return line.find(',', static_cast<std::size_t>(field.data() - line.data()) + field.size()) + 1;
    }

    void take_element(std::string_view line)
    {
        const auto fields = dyna_fields(line, width_, width_, 10);
        std::size_t first = 0;
        if (head_line_.empty()) {
            head_line_ = {number(fields[0], "an element"),
                          number(fields.size() > 1 ? fields[1] : "", "a part")};
            element_place_ = place_;
            first = 2;
        }
        for (std::size_t k = first; k < fields.size(); ++k) nodes_.push_back(number(fields[k], "a node"));
        const bool has_nodes = std::ranges::any_of(nodes_, [](Index node) { return node > 0; });
        if (first > 0 && !has_nodes) return nodes_.clear();
        nodes_.resize((nodes_.size() + 9) / 10 * 10 - (first > 0 ? 2 : 0), 0);
        const bool twenty = keyword_ == kSolid20;
        if (twenty && nodes_.size() < 20) return;
        add_element(twenty);
        head_line_.clear();
        nodes_.clear();
    }

    void add_element(bool twenty)
    {
        const auto add = [&](DeckShape shape, std::span<const Index> nodes) {
            if (std::ranges::find(nodes, 0) != nodes.end())
                element_place_.fail("{} lacks a node", numbered("element", head_line_[0]));
            into_.add_element(into_.block_of(shape, keyword_), head_line_[0], into_.region_of(head_line_[1]),
                              nodes, element_place_.number());
        };
        const std::span<const Index> nodes(nodes_);
        if (twenty) return add(hex20, nodes.first(20));
        if (keyword_ == kShell) {
            if (nodes[4] > 0 && nodes[2] != nodes[3]) return add(quad8, nodes.first(8));
            const bool triangle = nodes[3] == 0 || nodes[3] == nodes[2];
            return add(triangle ? tri3 : quad4, nodes.first(triangle ? 3 : 4));
        }
        if (nodes.size() == 10 && nodes[8] > 0 && nodes[9] > 0) return add(tet10, nodes);
        std::array<Index, 8> eight{};
        std::ranges::copy(nodes.first(8), eight.begin());
        const auto corners_by = [&](const Degenerate& of) { return try_pattern(of, eight, add); };
        if (std::ranges::any_of(kDegenerate, corners_by) || std::ranges::any_of(kReadToo, corners_by)) return;
        element_place_.fail("{} repeats nodes, but not as a tetrahedron, pyramid or wedge does",
                            numbered("element", head_line_[0]));
    }

    /// Add an element if its repeated nodes follow a pattern, and no pattern of a simpler shape.
    template <class Add>
    static bool try_pattern(const Degenerate& of, const std::array<Index, 8>& eight, const Add& add)
    {
        const auto count = static_cast<std::size_t>(shape_info(of.shape).corners);
        std::array<Index, 8> corner{};
        for (std::size_t k = 0; k < 8; ++k) corner[of.fields[k]] = eight[k];
        for (std::size_t k = 0; k < 8; ++k)
            if (corner[of.fields[k]] != eight[k]) return false;
        for (std::size_t k = 0; k < count; ++k)
            if (std::find(corner.begin(), corner.begin() + static_cast<std::ptrdiff_t>(k), corner[k]) !=
                corner.begin() + static_cast<std::ptrdiff_t>(k))
                return false;
        add(of.shape, std::span<const Index>(corner).first(count));
        return true;
    }

    /// Name the regions after the titles of their parts; parts without elements keep their numbers.
    void name_regions()
    {
        each_dyna_card(cards_, [&](const std::string& keyword, const std::vector<std::string_view>& lines) {
            if (keyword != "PART" && !keyword.starts_with("PART_")) return;
            const std::size_t each = keyword == "PART" ? 2 : std::max<std::size_t>(lines.size(), 2);
            for (std::size_t k = 0; k + 1 < lines.size(); k += each) {
                const auto fields = dyna_fields(lines[k + 1], kDynaSetField, kDynaSetField, 3);
                const auto part = parse_integer<int>(fields.empty() ? std::string_view() : fields[0]);
                if (!part || *part < 0) continue;
                DeckRegion& region = into_.deck().regions[index(into_.region_of(*part))];
                region.name = trimmed(lines[k]);
                if (fields.size() > 2) region.material = fields[2];
            }
        });
        std::set<std::string> names;
        for (DeckRegion& region : into_.deck().regions)
            if (region.name.empty() || !names.insert(upper(region.name)).second)
                region.name = "pid:" + std::to_string(region.tag);
    }

    /// Find the sides of elements that the segments of sets name by their nodes.
    void find_sides()
    {
        for (const SetCard& card : sets_)
            if (card.kind == SetKind::sides)
                each_row(card, [&](std::span<const Index> row) {
                    if (const auto corners = corners_of(row)) sides_.try_emplace(face_key(*corners));
                });
        if (sides_.empty()) return;
        each_element(into_.deck(), [&](const DeckBlock& block, std::size_t e, std::size_t) {
            const auto visit = [&](Quad corners, int side) {
                for (Index& k : corners)
                    k = k < 0
                            ? -1
                            : static_cast<Index>(into_.deck().point_tags[index(block.element(e)[index(k)])]);
                if (const auto at = sides_.find(face_key(corners)); at != sides_.end())
                    at->second.push_back({corners, {block.tags[e], side}});
            };
            if (shape_info(block.shape).dimension == 2) visit(shell_corners(block.shape), 0);
            int side = 0;
            for (const Quad& face : face_corners(block.shape)) visit(face, ++side);
        });
    }

    /// The side that a segment covers: the side of a solid (of two solids, the one that is oriented like the
    /// segment), else that of a shell.
    [[nodiscard]] std::optional<DeckSide> side_of(const Quad& segment) const
    {
        const auto at = sides_.find(face_key(segment));
        if (at == sides_.end() || at->second.empty()) return {};
        const auto is_along = [&](const auto& of) { return is_rotated(of.first, segment); };
        const auto is_solid = [](const auto& of) { return of.second.side > 0; };
        const auto& all = at->second;
        auto best = std::ranges::find_if(all, [&](const auto& of) { return is_solid(of) && is_along(of); });
        if (best == all.end()) best = std::ranges::find_if(all, is_solid);
        if (best != all.end()) return best->second;
        return DeckSide{all.front().second.element, is_along(all.front()) ? 0 : -1};
    }

    static bool is_rotated(const Quad& a, const Quad& b)
    {
        const std::size_t corners = a[3] < 0 ? 3 : 4;
        for (std::size_t turn = 0; turn < corners; ++turn) {
            std::size_t k = 0;
            while (k < corners && a[k] == b[(k + turn) % corners]) ++k;
            if (k == corners) return true;
        }
        return false;
    }

    /// Corners of a segment; empty if it has attributes, which a deck cannot hold.
    static std::optional<Quad> corners_of(std::span<const Index> row)
    {
        if (row.size() < 3 || std::ranges::any_of(row.subspan(std::min<std::size_t>(row.size(), 4)),
                                                  [](Index more) { return more != 0; }))
            return {};
        const Index last = row.size() > 3 && row[3] != 0 && row[3] != row[2] ? row[3] : -1;
        return Quad{row[0], row[1], row[2], last};
    }

    /// Call `take(numbers)` for each data line of a set after its head. Words that are not numbers are passed
    /// as -1.
    template <class Take>
    void each_row(const SetCard& card, const Take& take) const
    {
        std::size_t line = 0;
        const std::size_t first = card.titled ? 2 : 1;
        each_line(card.text, [&](std::string_view text) {
            if (text.starts_with('*') || text.starts_with('$') || (line >= first && trimmed(text).empty()))
                return;
            if (line++ < first) return;
            std::vector<Index> row;
            for (const std::string_view field :
                 dyna_fields(text, card.width, card.width, kCardColumns / kDynaSetField))
                row.push_back(field.empty() ? 0 : parse_integer<Index>(field).value_or(-1));
            take(row);
        });
    }

    void add_set(const SetCard& card)
    {
        DeckSet set;
        set.kind = card.kind;
        std::vector<std::string_view> lines;
        each_line(card.text, [&](std::string_view line) {
            if (!line.starts_with('*') && !line.starts_with('$')) lines.push_back(line);
        });
        const std::size_t at = card.titled ? 1 : 0;
        bool holds = lines.size() > at;
        if (holds) {
            const auto head = dyna_fields(lines[at], card.width, card.width, kCardColumns / kDynaSetField);
            set.tag = parse_integer<int>(head.empty() ? std::string_view() : head[0]).value_or(-1);
            holds = set.tag >= 0;
            for (std::size_t k = 1; k < head.size(); ++k)
                if (!head[k].empty() && head[k] != "MECH" && parse_real(head[k]) != 0.0) holds = false;
        }
        if (holds && card.titled) set.name = trimmed(lines[0]);
        if (set.name.empty())
            set.name = (card.kind == SetKind::nodes   ? "nodes_"
                        : card.kind == SetKind::sides ? "segments_"
                                                      : "elements_") +
                       std::to_string(set.tag);
        each_row(card, [&](std::span<const Index> row) {
            if (std::ranges::any_of(row, [](Index number) { return number < 0; })) {
                holds = false;
            } else if (card.kind == SetKind::sides) {
                const auto corners = corners_of(row);
                const auto side = corners ? side_of(*corners) : std::nullopt;
                if (side) set.sides.push_back(*side);
                if (!side) holds = false;
            } else if (card.ranges) {
                for (std::size_t k = 0; k + 1 < row.size(); k += 2) add_range(row[k], row[k + 1], set);
            } else {
                std::ranges::copy_if(row, std::back_inserter(set.members), [](Index of) { return of > 0; });
            }
        });
        if (!holds || (set.members.empty() && set.sides.empty())) {
            cards_ += card.text;
            into_.pass_over("sets that are kept as text");
            return;
        }
        tidy(set);
        into_.deck().sets.push_back(std::move(set));
    }

    void add_range(Index first, Index last, DeckSet& set)
    {
        std::vector<DeckTag>& known = set.kind == SetKind::nodes ? sorted_nodes_ : sorted_elements_;
        if (known.empty()) {
            known = set.kind == SetKind::nodes ? into_.deck().point_tags : element_tags(into_.deck());
            std::ranges::sort(known);
        }
        const auto begin = std::ranges::lower_bound(known, first),
                   end = std::ranges::upper_bound(known, last);
        if (begin < end) set.members.insert(set.members.end(), begin, end);
    }

    Cursor& main_;
    DeckBuilder& into_;
    DeckFiles files_;
    DeckPlace place_, element_place_;
    std::string keyword_, head_, cards_;
    Mode mode_ = Mode::keep;
    std::set<std::string> unread_; ///< keywords of elements that are kept as text
    bool begun_ = false, long_ = false, ten_ = false;
    std::size_t width_ = kCardField;
    std::vector<Index> head_line_, nodes_; ///< the element that is being read: its number and part, and
                                           ///< its nodes
    std::vector<SetCard> sets_;
    std::unordered_map<Quad, std::vector<std::pair<Quad, DeckSide>>, CornerHash<4>> sides_;
    std::vector<DeckTag> sorted_nodes_, sorted_elements_;
};

} // namespace

std::string dyna_keyword_of(std::string_view line)
{
    std::string word = upper(next_word(line, " \t\r,"));
    word.erase(0, 1);
    while (word.ends_with('+') || word.ends_with('-') || word.ends_with('%')) word.pop_back();
    return word;
}

std::vector<std::string_view> dyna_fields(std::string_view line, std::size_t first, std::size_t width,
                                          std::size_t count)
{
    std::vector<std::string_view> fields = split_fields(line, first, width);
    fields.resize(std::min(fields.size(), count));
    return fields;
}

void read_dyna(Cursor& cursor, DeckBuilder& into) { DynaReader(cursor, into).read(); }

} // namespace lacuna::io
