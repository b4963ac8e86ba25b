// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/unv.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace lacuna::io {
namespace {

bool is_mark(std::string_view line) { return line == trimmed(kUnvMark); }

/// A dataset of groups. `values`: how many numbers each entity has (type and tag; in later datasets also node
/// and component). `count_at`: which number of the header is the number of entities.
struct GroupDataset {
    int number;
    std::size_t values, count_at;
};
constexpr GroupDataset kGroupDatasets[] = {{752, 2, 5},  {2417, 2, 6}, {2429, 2, 7},
                                           {2430, 2, 7}, {2432, 2, 7}, {2435, 4, 7},
                                           {2452, 4, 7}, {2467, 4, 7}, {2477, 4, 7}};

/// The shape of an element descriptor; none for beams and other ignored elements. Only every `step`-th node
/// is read, so that cubic faces are reduced to their corners. Plane stress 41-46, plane strain 51-56, plate
/// 61-66, membrane 71-76, axisymmetric 81-86 and shell 91-96 are numbered alike: first linear, quadratic and
/// cubic triangles, then quadrilaterals.
struct ElementKind {
    std::optional<DeckShape> shape;
    std::size_t step = 1;

    [[nodiscard]] std::size_t nodes() const
    {
        return shape ? static_cast<std::size_t>(shape_info(*shape).nodes) : 0;
    }
};
ElementKind kind_of(std::int64_t descriptor)
{
    using enum DeckShape;
    if (const auto shape = shape_numbered(&ShapeWords::unv, descriptor)) return {shape};
    const std::int64_t family = descriptor / 10, member = descriptor % 10;
    if (family < 4 || family > 9 || member < 1 || member > 6) return {};
    constexpr DeckShape kFaces[] = {tri3, tri6, tri3, quad4, quad8, quad4};
    return {kFaces[member - 1], member % 3 == 0 ? std::size_t(3) : 1};
}

class UnvReader {
public:
    UnvReader(Cursor& cursor, DeckBuilder& into)
        : cursor_(cursor),
          into_(into),
          whole_(cursor.rest().data() - cursor.position(), cursor.rest().size() + cursor.position())
    {
    }

    void read()
    {
        std::size_t datasets = 0;
        std::string_view between; // the first line since the last dataset that has numbers only
        for (std::string_view line; !(line = cursor_.full_line()).empty();) {
            const std::size_t begin = cursor_.last();
            if (!is_mark(line)) {
                split(line);
                if (between.empty() &&
                    std::ranges::all_of(numbers_, [](auto word) { return parse_real(word).has_value(); }))
                    between = line;
                into_.pass_over("lines between datasets");
                continue;
            }
            ++datasets;
            const std::string_view head = cursor_.full_line();
            // If this mark ends a dataset, the numbers before it are a dataset whose first mark is missing.
            if (!between.empty() && (head.empty() || is_mark(head)))
                cursor_.fail_at(static_cast<std::size_t>(between.data() - whole_.data()),
                                "expected -1, which begins a dataset, found {}", found(shown(between)));
            between = {};
            const auto dataset = cursor_.integer_of(head);
            if (!read_dataset(static_cast<int>(std::clamp<std::int64_t>(dataset, -1, 100000))))
                text_ += whole_.substr(begin, cursor_.position() - begin);
        }
        if (datasets == 0) cursor_.fail_at(0, "expected -1, which begins a dataset, found none");
        const TagPlaces tags(into_.deck().point_tags, [&](Index, Index node) {
            cursor_.fail("{} of the file has the same tag as an earlier one", numbered("node", node + 1));
        });
        for (const auto& [frame, position] : frames_used_)
            if (frames_turned_.contains(frame))
                cursor_.fail_at(position,
                                Message(kUnreadable, "the node is in {}, which is not the global one",
                                        numbered("coordinate system", frame))
                                    .remedy("export the mesh in global coordinates"));
        into_.resolve(tags,
                      [&](std::uint64_t place, const Message& why) { cursor_.fail_at(place - 1, why); });
        if (!text_.empty()) into_.deck().texts.push_back({DeckText::Place::cards, "", std::move(text_)});
        for (const auto& [dataset, text] : others_)
            into_.deck().texts.push_back({DeckText::Place::tail, "",
                                          "    -1\n  " + std::to_string(dataset) + "\n" + text + "    -1\n"});
    }

private:
    /// Read a dataset. @return  false if it is not part of the mesh.
    bool read_dataset(int dataset)
    {
        const auto each_entry = [&](const auto& read_entry) {
            while (next_line()) read_entry();
            return true;
        };
        const auto group = std::ranges::find(kGroupDatasets, dataset, &GroupDataset::number);
        if (dataset == 15) return each_entry([&] { read_node(whole(0), 4); });
        if (dataset == 781 || dataset == 2411) return each_entry([&] { read_node_of_two_lines(); });
        if (dataset == 71 || dataset == 780 || dataset == 2412)
            return each_entry([&] { read_element(dataset); });
        if (group != std::end(kGroupDatasets)) return each_entry([&] { read_group(*group); });
        if (dataset == 2420)
            read_frames();
        else
            while (more_lines()) {}
        return false;
    }

    /// Read coordinate frames, and find those that rotate or shift coordinates. The dataset has a part and
    /// its name, then for each frame a label, a name and four rows.
    void read_frames()
    {
        if (!more_lines() || !more_lines()) return;
        while (next_line()) {
            expect_numbers(2, "a coordinate system");
            const Index label = whole(0);
            bool turned = whole(1) != 0;
            if (!more_lines()) return;
            for (std::size_t row = 0; row < 4; ++row) {
                expect_line("a coordinate system's axes");
                expect_numbers(3, "a coordinate system");
                for (std::size_t k = 0; k < 3; ++k)
                    if (cursor_.real_of(numbers_[k], Exponents::fortran) != (row == k ? 1 : 0)) turned = true;
            }
            if (turned) frames_turned_.insert(label);
        }
    }

    /// Read the next line of the dataset into `line_`. @return  false at the end of the dataset.
    bool more_lines()
    {
        if (cursor_.at_end()) cursor_.fail("the file ends within a dataset; expected -1");
        line_ = cursor_.line();
        return !is_mark(line_);
    }

    /// Split the next line of the dataset into words.
    bool next_line()
    {
        do {
            if (!more_lines()) return false;
        } while (line_.empty());
        split(line_);
        return true;
    }

    void split(std::string_view rest)
    {
        numbers_.clear();
        for (auto word = next_word(rest); !word.empty(); word = next_word(rest)) numbers_.push_back(word);
    }

    void expect_line(const char* what)
    {
        if (!next_line()) cursor_.fail("the dataset ends where {} was expected", what);
    }

    void expect_numbers(std::size_t least, const char* what) const
    {
        if (numbers_.size() < least)
            cursor_.fail("expected {} numbers of {}, found {}", needed(least), what, found(numbers_.size()));
    }

    /// A tag or another small whole number.
    Index whole(std::size_t at) const
    {
        const auto value = parse_integer<Index>(numbers_[at]);
        if (!value) cursor_.fail("expected a whole number, found {}", found(shown(numbers_[at])));
        return *value;
    }

    void read_node_of_two_lines()
    {
        const Index tag = whole(0);
        if (numbers_.size() > 1) frames_used_.try_emplace(whole(1), cursor_.last());
        expect_line("a node's coordinates");
        read_node(tag, 0);
    }

    /// @param first  index of x among the numbers of the line.
    void read_node(Index tag, std::size_t first)
    {
        expect_numbers(first + 3, "a node");
        if (tag < 0) cursor_.fail("expected the tag of a node, found {}", found(tag));
        Vec3 p;
        for (std::size_t k = 0; k < 3; ++k)
            p[static_cast<Index>(k)] = cursor_.real_of(numbers_[first + k], Exponents::fortran);
        into_.add_point(tag, p, cursor_);
    }

    void read_element(int dataset)
    {
        const std::size_t values = dataset == 780 ? 8 : 6;
        expect_numbers(values, "an element");
        const std::size_t position = cursor_.last();
        const Index tag = whole(0);
        const std::int64_t descriptor = cursor_.integer_of(numbers_[1]);
        const Index property = whole(2);
        const Index nodes = whole(values - 1);
        if (nodes < 1) cursor_.fail("expected an element with nodes, found {}", found(nodes));
        if (unv_has_orientation(descriptor, dataset)) expect_line("a beam's orientation");
        const ElementKind kind = kind_of(descriptor);
        const std::size_t wanted = kind.nodes() * kind.step;
        if (index(nodes) < wanted)
            cursor_.fail("expected {} nodes of an element {}, found {}", needed(wanted), descriptor,
                         found(nodes));
        std::array<Index, 20> at{};
        const auto places = node_places(NodeOrder::unv, kind.shape.value_or(DeckShape::hex20));
        for (Index read = 0; read < nodes;) {
            expect_line("the nodes of an element");
            if (numbers_.size() > index(nodes - read))
                cursor_.fail("expected {} nodes, found more", needed(nodes));
            for (std::size_t k = 0; k < numbers_.size(); ++k, ++read) {
                const Index node = whole(k);
                if (index(read) < wanted && node < 0)
                    cursor_.fail("expected the tag of a node, found {}", found(node));
                if (index(read) >= wanted || index(read) % kind.step != 0) continue;
                at[places[index(read) / kind.step]] = node;
            }
        }
        if (wanted == 0) {
            others_[dataset] += whole_.substr(position, cursor_.position() - position);
            return into_.pass_over("elements " + std::to_string(descriptor));
        }
        if (tag < 0) cursor_.fail_at(position, "expected the tag of an element, found {}", found(tag));
        if (index(nodes) > wanted) into_.pass_over_nodes(std::to_string(descriptor), index(nodes) - wanted);
        into_.add_element(into_.block_of(*kind.shape, std::to_string(descriptor)), tag,
                          into_.region_of(property), {at.data(), kind.nodes()}, position + 1);
    }

    void read_group(const GroupDataset& dataset)
    {
        expect_numbers(dataset.count_at + 1, "a group");
        const Index number = whole(0);
        const Index count = whole(dataset.count_at);
        if (count < 0) cursor_.fail("expected a count of entities, found {}", found(count));
        if (!more_lines()) cursor_.fail("the dataset ends where the name of a group was expected");
        const std::string name(line_);
        std::vector<DeckTag> members[2]; // elements, nodes
        for (auto left = static_cast<std::size_t>(count); left > 0;) {
            expect_line("the entities of a group");
            if (numbers_.size() % dataset.values != 0 || numbers_.size() > left * dataset.values)
                cursor_.fail("expected {} numbers of each of {} entities, found {}", needed(dataset.values),
                             left, found(numbers_.size()));
            for (std::size_t k = 0; k < numbers_.size(); k += dataset.values, --left)
                if (const Index what = whole(k); what == kUnvElement || what == kUnvNode)
                    members[what == kUnvElement ? 0 : 1].push_back(whole(k + 1));
        }
        for (const auto kind : {DeckSet::Kind::elements, DeckSet::Kind::nodes}) {
            std::vector<DeckTag>& all = members[kind == DeckSet::Kind::elements ? 0 : 1];
            if (all.empty()) continue;
            tidy(all);
            into_.deck().sets.push_back({kind, number, name, std::move(all), {}});
        }
    }

    Cursor& cursor_;
    DeckBuilder& into_;
    std::string_view line_;
    std::vector<std::string_view> numbers_;    ///< words of the line
    std::string_view whole_;                   ///< the whole file
    std::string text_;                         ///< datasets that are not part of the mesh
    std::map<int, std::string> others_;        ///< elements that are neither shells nor solids, by dataset
    std::map<Index, std::size_t> frames_used_; ///< frames used by nodes, and the place of their first use
    std::set<Index> frames_turned_;
};

} // namespace

void read_unv(Cursor& cursor, DeckBuilder& into) { UnvReader(cursor, into).read(); }

} // namespace lacuna::io
