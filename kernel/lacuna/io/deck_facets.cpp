// SPDX-License-Identifier: MIT
//
// facets_of(): match the sides of solids with each other and with the shells.
#include <lacuna/io/shared/deck_facets.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/default_labels.h>
#include <lacuna/core/shared/large_pages.h>
#include <lacuna/core/shared/renumbered.h>
#include <lacuna/core/shared/same_corners.h>
#include <lacuna/healing/shared/add_facet.h>
#include <lacuna/healing/shared/weld.h>
#include <lacuna/io/detail/deck_builder.h>
#include <lacuna/io/detail/deck_view.h>
#include <lacuna/io/detail/texts.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace lacuna::io {
namespace {

/// The elements of one dimension, numbered over all blocks.
class Elements {
public:
    Elements(const Deck& deck, int dimension)
    {
        for (const DeckBlock& block : deck.blocks) {
            if (shape_info(block.shape).dimension != dimension) continue;
            blocks_.push_back(&block);
            first_.push_back(count_);
            count_ += block.count();
        }
    }
    [[nodiscard]] std::size_t count() const { return count_; }
    struct Element {
        const DeckBlock* block;
        std::size_t at;
        [[nodiscard]] std::span<const Index> nodes() const { return block->element(at); }
        [[nodiscard]] Index region() const { return block->regions[at]; }
    };
    [[nodiscard]] Element operator[](std::size_t e) const
    {
        const auto above = std::upper_bound(first_.begin(), first_.end(), e);
        const auto b = static_cast<std::size_t>(above - first_.begin()) - 1;
        return {blocks_[b], e - first_[b]};
    }
    /// Call `visit(number, element)` for all elements, in order.
    template <class Visit>
    void each(const Visit& visit) const
    {
        for (std::size_t b = 0; b < blocks_.size(); ++b)
            for (std::size_t at = 0; at < blocks_[b]->count(); ++at)
                visit(first_[b] + at, Element{blocks_[b], at});
    }
    [[nodiscard]] std::vector<DeckTag> tags() const
    {
        std::vector<DeckTag> all;
        all.reserve(count_);
        for (const DeckBlock* block : blocks_) all.insert(all.end(), block->tags.begin(), block->tags.end());
        return all;
    }

private:
    std::vector<const DeckBlock*> blocks_;
    std::vector<std::size_t> first_;
    std::size_t count_ = 0;
};

/// What a label stands for. Regions of shells and solids and lists of sets are given by number; region -1:
/// none.
struct Label {
    Index shell = -1;     ///< region of the shells
    int sets = 0;         ///< list of the shells' sets, or of the surfaces that contain the sides
    Index a = -1, b = -1; ///< regions of the solids on either side, a <= b if both exist
    friend auto operator<=>(const Label&, const Label&) = default;
};

constexpr Index kSingles = -2; ///< region of the label that shells share if each would be alone in its label

class Facets {
public:
    Facets(const Deck& deck, double tolerance)
        : deck_(deck), tolerance_(tolerance), shells_(deck, 2), solids_(deck, 3)
    {
        file_.soup.least_tolerance = least_tolerance(deck);
    }

    FacetFile gather()
    {
        if (shells_.count() + solids_.count() == 0) refuse();
        list_sets();
        beside_.assign(shells_.count(), {-1, -1});
        if (solids_.count() > 0) match_sides();
        label_shells();
        number_labels();
        emit();
        name_labels();
        file_.notes = deck_.notes;
        if (shared_by_many_ > 0)
            file_.notes.push_back(formatted(
                "{}: {} sides are shared by more than two solids, which overlap or are listed twice",
                deck_.path, shared_by_many_));
        if (singles_ > 0)
            file_.notes.push_back(formatted(
                "{}: {} properties or sets have one shell each and are read as one", deck_.path, singles_));
        return std::move(file_);
    }

private:
    struct Side {
        std::size_t solid;
        int face;
        Label label;
    };

    [[noreturn]] void refuse() const
    {
        throw InvalidInput(Message("io.no_faces", "{} contains no faces", deck_.path)
                               .remedy("check that its contents agree with its ending, and that it has "
                                       "triangles, quads or solids{}",
                                       deck_.notes.empty() ? "" : formatted(". {}", deck_.notes.front())));
    }

    void list_sets()
    {
        sets_of_shell_.assign(shells_.count(), 0);
        const bool any = std::ranges::any_of(
            deck_.sets, [](const DeckSet& set) { return set.kind != DeckSet::Kind::nodes; });
        if (!any) return;
        const TagPlaces shells(shells_.tags());
        const TagPlaces solids(solids_.tags());
        for (std::size_t s = 0; s < deck_.sets.size(); ++s) {
            const DeckSet& set = deck_.sets[s];
            const auto put = [&](Index shell) {
                int& list = sets_of_shell_[index(shell)];
                const bool there = list != 0 && lists_[list].back() == static_cast<int>(s);
                if (!there) list = lists_.extended(list, static_cast<int>(s));
            };
            if (set.members.size() > 1)
                for (const DeckTag tag : set.members)
                    if (const Index shell = shells.find(tag);
                        shell >= 0 && set.kind == DeckSet::Kind::elements)
                        put(shell);
            for (const DeckSide& side : set.sides) {
                if (const Index shell = shells.find(side.element); shell >= 0 && side.side <= 0) put(shell);
                const Index solid = solids.find(side.element);
                if (solid < 0 || side.side < 1) continue;
                surfaces_.emplace_back(std::pair(index(solid), side.side - 1), static_cast<int>(s));
            }
        }
        std::sort(surfaces_.begin(), surfaces_.end());
    }

    /// The number of the list of surfaces that contain a side of a solid.
    int surfaces_of(std::size_t solid, int face)
    {
        const std::pair<std::size_t, int> key(solid, face);
        int list = 0;
        for (auto at = std::lower_bound(surfaces_.begin(), surfaces_.end(), std::pair(key, 0));
             at != surfaces_.end() && at->first == key; ++at)
            list = lists_.extended(list, at->second);
        return list;
    }

    void match_sides()
    {
        const std::vector<Index> joined = weld();
        const auto corners_of = [&](std::span<const Index> nodes, Quad corner) {
            for (Index& k : corner)
                if (k >= 0) k = joined[index(nodes[index(k)])];
            return corner;
        };
        const auto each = [&](const auto& visit) {
            solids_.each([&](std::size_t e, const Elements::Element& element) {
                const auto faces = face_corners(element.block->shape);
                const auto nodes = element.nodes();
                for (std::size_t f = 0; f < faces.size(); ++f)
                    visit(corners_of(nodes, faces[f]), std::uint64_t(e) * 8 + f);
            });
            shells_.each([&](std::size_t e, const Elements::Element& element) {
                visit(corners_of(element.nodes(), shell_corners(element.block->shape)),
                      (solids_.count() + std::uint64_t(e)) * 8);
            });
        };
        each_with_same_corners(deck_.points.size(), each,
                               [&](std::span<const NumberedCell> group) { take_group(group); });
        std::sort(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) {
            return std::pair(a.solid, a.face) < std::pair(b.solid, b.face);
        });
    }

    [[nodiscard]] std::vector<Index> weld() const
    {
        Eigen::AlignedBox3d box;
        for (const Vec3& p : deck_.points) box.extend(p);
        return healing::weld(deck_.points, tolerance_ > 0 ? tolerance_
                                                          : std::max(kFileAccuracy * box.diagonal().norm(),
                                                                     file_.soup.least_tolerance));
    }

    /// Process the sides and shells with the same corners, solids first.
    void take_group(std::span<const NumberedCell> group)
    {
        std::size_t solids = 0;
        while (solids < group.size() && group[solids].number / 8 < solids_.count()) ++solids;
        if (solids == 0) return;
        const auto region = [&](std::size_t i) { return solids_[group[i].number / 8].region(); };
        std::size_t other = 1;
        while (other < solids && region(other) == region(0)) ++other;
        Label label{.a = region(0), .b = other < solids ? region(other) : -1};
        if (label.b >= 0 && label.b < label.a) std::swap(label.a, label.b);
        if (solids > 2) ++shared_by_many_;
        for (std::size_t i = solids; i < group.size(); ++i)
            beside_[group[i].number / 8 - solids_.count()] = {label.a, label.b};
        const bool inside = solids == 2 && label.b < 0;
        if (inside || group.size() > solids) return;
        // Between two regions, the side of the region with the lower number is used. The face points out of
        // that region.
        const std::size_t shown = region(0) == label.a ? 0 : other;
        const std::size_t solid = group[shown].number / 8;
        const auto face = static_cast<int>(group[shown].number % 8);
        label.sets = surfaces_of(solid, face);
        if (label.sets == 0 && other < solids)
            label.sets = surfaces_of(group[shown == 0 ? other : 0].number / 8,
                                     static_cast<int>(group[shown == 0 ? other : 0].number % 8));
        sides_.push_back({solid, face, label});
    }

    void label_shells()
    {
        std::map<Label, int> shells;
        label_of_shell_.resize(shells_.count());
        shells_.each([&](std::size_t e, const Elements::Element& element) {
            label_of_shell_[e] = {element.region(), sets_of_shell_[e], beside_[e].first, beside_[e].second};
            ++shells[label_of_shell_[e]];
        });
        const auto singles = std::ranges::count(shells, 1, &std::pair<const Label, int>::second);
        if (singles <= kMostListed) return; // more labels of one shell each would be hard to tell apart
        singles_ = static_cast<std::size_t>(singles);
        for (Label& label : label_of_shell_)
            if (shells[label] == 1) label = {kSingles, 0, label.a, label.b};
    }

    /// Tag of a label: the tag of its set. In MSH files it is the tag of its region, because there a region
    /// is a surface and its sets are the surface's groups.
    [[nodiscard]] int tag_of(const Label& label) const
    {
        const bool by_set = deck_.format != DeckFormat::msh;
        for (const int s : lists_[label.sets])
            if (const int tag = deck_.sets[index(s)].tag; by_set && tag > 0) return tag;
        const Index region = label.shell >= 0 ? label.shell : label.shell == kSingles ? -1 : label.a;
        const bool between = label.shell == -1 && label.b >= 0;
        return region < 0 || between ? 0 : deck_.regions[index(region)].tag;
    }

    /// Number the labels: those of shells first, then by tag, then by content.
    void number_labels()
    {
        for (const Label& label : label_of_shell_) numbers_.try_emplace(label, 0);
        for (const Side& side : sides_) numbers_.try_emplace(side.label, 0);
        for (const auto& [label, number] : numbers_) labels_.push_back(label);
        std::stable_sort(labels_.begin(), labels_.end(), [&](const Label& x, const Label& y) {
            return std::tuple(x.shell == -1, tag_of(x)) < std::tuple(y.shell == -1, tag_of(y));
        });
        for (std::size_t n = 0; n < labels_.size(); ++n) numbers_[labels_[n]] = static_cast<int>(n);
    }

    /// Emit the facets label by label; points are numbered in order of first use.
    void emit()
    {
        std::vector<std::vector<std::uint64_t>> of_label(labels_.size());
        for (std::size_t e = 0; e < shells_.count(); ++e)
            of_label[index(numbers_[label_of_shell_[e]])].push_back(e);
        for (std::size_t s = 0; s < sides_.size(); ++s)
            of_label[index(numbers_[sides_[s].label])].push_back(shells_.count() + s);
        for (std::size_t label = 0; label < labels_.size(); ++label) {
            for (const std::uint64_t who : of_label[label]) {
                if (who >= shells_.count()) {
                    emit_side(sides_[who - shells_.count()], static_cast<int>(label));
                    continue;
                }
                const Elements::Element shell = shells_[who];
                const auto corners = static_cast<std::size_t>(shape_info(shell.block->shape).corners);
                healing::add_facet(file_.soup, shell.nodes().first(corners), static_cast<int>(label));
            }
            of_label[label] = {};
        }
        number_points();
    }

    /// Emit a side facing away from the centre of its solid, whatever the solid's numbering.
    void emit_side(const Side& side, int label)
    {
        const Elements::Element solid = solids_[side.solid];
        const auto nodes = solid.nodes();
        const auto corners = static_cast<std::size_t>(shape_info(solid.block->shape).corners);
        Vec3 middle = Vec3::Zero();
        for (std::size_t k = 0; k < corners; ++k) middle += deck_.points[index(nodes[k])];
        middle /= static_cast<double>(corners);
        const Quad& face = face_corners(solid.block->shape)[index(side.face)];
        std::array<Index, 4> at{};
        const std::size_t count = face[3] < 0 ? 3 : 4;
        for (std::size_t k = 0; k < count; ++k) at[k] = nodes[index(face[k])];
        const Vec3& p = deck_.points[index(at[0])];
        const Vec3& q = deck_.points[index(at[count / 2])];
        const Vec3 area = count == 3 ? (deck_.points[index(at[1])] - p).cross(deck_.points[index(at[2])] - p)
                                     : (q - p).cross(deck_.points[index(at[3])] - deck_.points[index(at[1])]);
        if (area.dot(p + q - 2 * middle) < 0)
            std::reverse(at.begin() + 1, at.begin() + std::ptrdiff_t(count));
        healing::add_facet(file_.soup, {at.data(), count}, label);
    }

    void number_points()
    {
        healing::FacetSoup& soup = file_.soup;
        Renumbered<Vec3> points(deck_.points);
        reserve_large(points.used, deck_.points.size());
        const auto meet = [&](auto& cell) {
            for (Index& p : cell) p = points(p);
        };
        std::size_t t = 0;
        std::size_t q = 0;
        for (int label = 0; label < static_cast<int>(labels_.size()); ++label) {
            for (; t < soup.triangles.size() && soup.triangle_label[t] == label; ++t) meet(soup.triangles[t]);
            for (; q < soup.quads.size() && soup.quad_label[q] == label; ++q) meet(soup.quads[q]);
        }
        soup.points = std::move(points.used);
    }

    /// All names of a region: its own, its part's, and those of sets that contain all of it.
    void name_regions()
    {
        names_.resize(deck_.regions.size());
        std::vector<std::size_t> elements(deck_.regions.size(), 0);
        for (const DeckBlock& block : deck_.blocks)
            for (const Index region : block.regions) ++elements[index(region)];
        for (std::size_t r = 0; r < names_.size(); ++r) {
            const DeckRegion& region = deck_.regions[r];
            for (const std::string& name : {region.name, region.part}) add_once(names_[r], name);
        }
        const TagPlaces solids(solids_.tags());
        for (const DeckSet& set : deck_.sets) {
            if (set.kind != DeckSet::Kind::elements || set.name.empty()) continue;
            std::map<Index, std::size_t> held;
            for (const DeckTag tag : set.members)
                if (const Index solid = solids.find(tag); solid >= 0) ++held[solids_[index(solid)].region()];
            for (const auto& [region, count] : held)
                if (count == elements[index(region)]) add_once(names_[index(region)], set.name);
        }
        for (std::size_t r = 0; r < names_.size(); ++r)
            if (names_[r].empty()) names_[r].push_back("region:" + std::to_string(deck_.regions[r].tag));
    }

    void name_labels()
    {
        if (solids_.count() > 0) name_regions();
        std::set<int> tags;
        for (const Label& label : labels_) {
            const int tag = tag_of(label);
            file_.label_tag.push_back(tag > 0 && tags.insert(tag).second ? tag : 0);
            FacetFile::Label about;
            for (const int s : lists_[label.sets])
                if (const std::string& name = deck_.sets[index(s)].name; !name.empty())
                    about.groups.push_back(name);
            if (label.shell >= 0) add_once(about.groups, deck_.regions[index(label.shell)].name);
            for (const Index region : {label.a, label.b})
                if (region >= 0) about.regions.push_back(names_[index(region)]);
            if (about.regions.empty() && !about.groups.empty()) {
                // A shell with no solid beside it belongs to its own region.
                about.regions.push_back({about.groups.back()});
                if (label.shell >= 0 && !deck_.regions[index(label.shell)].part.empty())
                    about.regions.back().push_back(deck_.regions[index(label.shell)].part);
            }
            std::string name = about.groups.empty() ? "" : about.groups.front();
            const bool facets = deck_.format == DeckFormat::stl || deck_.format == DeckFormat::obj;
            if (facets && is_default_label(name)) name.clear();
            if (label.shell == -1 && name.empty())
                for (const auto& region : about.regions) name += (name.empty() ? "" : "|") + region.front();
            file_.soup.label_name.push_back(std::move(name));
            file_.labels.push_back(std::move(about));
        }
    }

    const Deck& deck_;
    double tolerance_;
    Elements shells_, solids_;
    SetLists lists_;
    std::vector<int> sets_of_shell_;                                    ///< list of sets of each shell
    std::vector<std::pair<std::pair<std::size_t, int>, int>> surfaces_; ///< (solid, face), set
    std::vector<std::pair<Index, Index>> beside_;                       ///< regions of the solids on either
                                                                        ///< side of each shell
    std::vector<Side> sides_;
    std::vector<Label> label_of_shell_, labels_;
    std::map<Label, int> numbers_;
    std::vector<std::vector<std::string>> names_; ///< all names of each region
    std::size_t shared_by_many_ = 0, singles_ = 0;
    FacetFile file_;
};

} // namespace

FacetFile facets_of(const Deck& deck, double tolerance) { return Facets(deck, tolerance).gather(); }

FacetFile read_facets(const std::string& name, std::string_view bytes)
{
    return facets_of(read_deck(name, bytes));
}

FacetFile read_facets(const std::string& path) { return facets_of(read_deck(path)); }

} // namespace lacuna::io
