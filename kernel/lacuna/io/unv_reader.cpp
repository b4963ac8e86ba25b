// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/facet_collector.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace lacuna::io {
namespace {

constexpr std::string_view kMark = "-1"; ///< begins and ends a dataset
constexpr int kElement = 8;              ///< what an entity of a group must be to count

/// Datasets of groups: how many numbers each entity has (type, tag, and in the later ones node and component),
/// and which number of the header counts them.
struct GroupDataset {
    int number;
    std::size_t values, count_at;
};
constexpr GroupDataset kGroupDatasets[] = {{752, 2, 5},  {2417, 2, 6}, {2429, 2, 7},
                                           {2430, 2, 7}, {2432, 2, 7}, {2435, 4, 7},
                                           {2452, 4, 7}, {2467, 4, 7}, {2477, 4, 7}};

/// Corners and order of a face by its descriptor; corners 0: a solid, -1: neither.
/// Plane stress 41-46, plane strain 51-56, plate 61-66, membrane 71-76, axisymmetric 81-86 and shell 91-96 count alike:
/// triangles linear, quadratic and cubic, then quadrilaterals.
struct FaceKind {
    int corners, order;
};
FaceKind kind_of(std::int64_t descriptor)
{
    if (descriptor >= 111 && descriptor <= 119) return {0, 1};
    const std::int64_t family = descriptor / 10;
    const std::int64_t member = descriptor % 10;
    if (family < 4 || family > 9 || member < 1 || member > 6) return {-1, 1};
    return {member <= 3 ? 3 : 4, static_cast<int>((member - 1) % 3) + 1};
}

/// Elements whose second record is a beam's orientation.
bool is_beam(std::int64_t descriptor) { return descriptor >= 21 && descriptor <= 24; }
bool has_orientation(std::int64_t descriptor, int dataset)
{
    return dataset != 71 && (descriptor == 11 || is_beam(descriptor));
}

class UnvReader {
public:
    UnvReader(Cursor& cursor, FacetCollector& into) : cursor_(cursor), into_(into) {}

    void read()
    {
        for (std::string_view line; !(line = cursor_.full_line()).empty();) {
            if (line != kMark) cursor_.fail("expected -1, which begins a dataset, found " + shown(line));
            const auto dataset = cursor_.integer_of(cursor_.full_line());
            read_dataset(static_cast<int>(std::clamp<std::int64_t>(dataset, -1, 100000)));
        }
        tags_.finish([&](Index, Index node) {
            cursor_.fail("node " + std::to_string(node + 1) + " of the file has the tag of one before");
        });
        take_groups();
        faces_.resolve(tags_, into_);
        into_.sort_by_label(false);
    }

private:
    void read_dataset(int dataset)
    {
        const auto group = std::ranges::find(kGroupDatasets, dataset, &GroupDataset::number);
        if (dataset == 15)
            while (next_line()) read_node(whole(0), 4);
        else if (dataset == 781 || dataset == 2411)
            while (next_line()) read_node_of_two_lines();
        else if (dataset == 71 || dataset == 780 || dataset == 2412)
            while (next_line()) read_element(dataset);
        else if (group != std::end(kGroupDatasets))
            while (next_line()) read_group(*group);
        else
            while (more_lines()) {}
    }

    /// The next line of the dataset as `line_`; false at its end.
    bool more_lines()
    {
        if (cursor_.at_end()) cursor_.fail("the file ends within a dataset; expected -1");
        line_ = cursor_.line();
        return line_ != kMark;
    }

    /// The next line of the dataset as words.
    bool next_line()
    {
        do {
            if (!more_lines()) return false;
        } while (line_.empty());
        numbers_.clear();
        std::string_view rest = line_;
        while (!(rest = trimmed(rest)).empty()) {
            const std::size_t length = std::min(rest.find_first_of(" \t\r"), rest.size());
            numbers_.push_back(rest.substr(0, length));
            rest.remove_prefix(length);
        }
        return true;
    }

    void expect_line(const char* what)
    {
        if (!next_line()) cursor_.fail(std::string("the dataset ends where ") + what + " was expected");
    }

    void expect_numbers(std::size_t least, const char* what) const
    {
        if (numbers_.size() < least)
            cursor_.fail("expected " + std::to_string(least) + " numbers of " + what + ", found " +
                         std::to_string(numbers_.size()));
    }

    /// A tag or a small number.
    Index whole(std::size_t at) const
    {
        const auto value = parse_integer<Index>(numbers_[at]);
        if (!value) cursor_.fail("expected a whole number, found " + shown(numbers_[at]));
        return *value;
    }

    void read_node_of_two_lines()
    {
        const Index tag = whole(0);
        expect_line("a node's coordinates");
        read_node(tag, 0);
    }

    /// @param first  which number of the line is x.
    void read_node(Index tag, std::size_t first)
    {
        expect_numbers(first + 3, "a node");
        if (tag < 0) cursor_.fail("expected the tag of a node, found " + std::to_string(tag));
        if (into_.points().size() >= static_cast<std::size_t>(std::numeric_limits<Index>::max()))
            cursor_.fail("too many nodes");
        Vec3 p;
        for (std::size_t k = 0; k < 3; ++k)
            p[static_cast<Index>(k)] = cursor_.real_of(numbers_[first + k], Exponents::fortran);
        tags_.add(static_cast<std::uint64_t>(tag));
        into_.points().push_back(p);
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
        if (nodes < 1) cursor_.fail("expected an element with nodes, found " + std::to_string(nodes));
        if (has_orientation(descriptor, dataset)) expect_line("a beam's orientation");
        const FaceKind kind = kind_of(descriptor);
        TaggedFaces::Face face{
            .corners = kind.corners, .label = property, .cursor = &cursor_, .position = position};
        if (kind.corners > 0 && nodes < kind.corners * kind.order)
            cursor_.fail("expected " + std::to_string(kind.corners * kind.order) + " nodes of a face " +
                         std::to_string(descriptor) + ", found " + std::to_string(nodes));
        for (Index read = 0; read < nodes;) {
            expect_line("the nodes of an element");
            if (numbers_.size() > index(nodes - read))
                cursor_.fail("expected " + std::to_string(nodes) + " nodes, found more");
            for (std::size_t k = 0; k < numbers_.size(); ++k, ++read) {
                // Nodes follow each other along the rim: corners have the mid-nodes between them.
                if (kind.corners > 0 && read % kind.order == 0 && read / kind.order < kind.corners)
                    face.node[index(read / kind.order)] = whole(k);
                else
                    whole(k);
            }
        }
        if (kind.corners > 0) {
            faces_.add(face);
            elements_.push_back(tag);
        } else {
            const std::string what = "elements " + std::to_string(descriptor);
            kind.corners == 0 ? into_.pass_over_solid(what) : into_.pass_over(what);
        }
    }

    void read_group(const GroupDataset& dataset)
    {
        expect_numbers(dataset.count_at + 1, "a group");
        const Index number = whole(0);
        const Index count = whole(dataset.count_at);
        if (count < 0) cursor_.fail("expected a count of entities, found " + std::to_string(count));
        if (!more_lines()) cursor_.fail("the dataset ends where the name of a group was expected");
        const auto group = static_cast<Index>(groups_.size());
        groups_.push_back({number, line_});
        for (auto left = static_cast<std::size_t>(count); left > 0;) {
            expect_line("the entities of a group");
            if (numbers_.size() % dataset.values != 0 || numbers_.size() > left * dataset.values)
                cursor_.fail("expected " + std::to_string(dataset.values) + " numbers of each of " +
                             std::to_string(left) + " entities, found " + std::to_string(numbers_.size()));
            for (std::size_t k = 0; k < numbers_.size(); k += dataset.values, --left)
                if (whole(k) == kElement) group_of_.try_emplace(whole(k + 1), group);
        }
    }

    /// Faces have had their property for a label so far; labels come in its order, then in the file's.
    void take_groups()
    {
        std::vector<TaggedFaces::Face>& faces = faces_.all();
        std::vector<std::size_t> order(faces.size());
        std::iota(order.begin(), order.end(), std::size_t(0));
        std::ranges::stable_sort(order, {}, [&](std::size_t f) { return faces[f].label; });
        for (const std::size_t f : order) {
            const auto found = group_of_.find(elements_[f]);
            const Group* group = found == group_of_.end() ? nullptr : &groups_[index(found->second)];
            faces[f].label = group == nullptr ? into_.label_of(faces[f].label)
                                              : into_.label_of(group->number, group->name, true);
        }
    }

    struct Group {
        int number;
        std::string_view name;
    };

    Cursor& cursor_;
    FacetCollector& into_;
    std::string_view line_;
    std::vector<std::string_view> numbers_; ///< words of the line
    NodeTags tags_;
    TaggedFaces faces_;
    std::vector<Index> elements_; ///< tag of each face
    std::vector<Group> groups_;
    std::unordered_map<Index, Index> group_of_; ///< of an element, by tag; the first counts
};

} // namespace

void read_unv(Cursor& cursor, FacetCollector& into) { UnvReader(cursor, into).read(); }

} // namespace lacuna::io
