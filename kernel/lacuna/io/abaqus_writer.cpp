// SPDX-License-Identifier: MIT
#include <lacuna/core/message.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/io/detail/abaqus.h>
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/cursor.h>
#include <lacuna/io/detail/format_table.h>
#include <lacuna/io/detail/periodic_nodes.h>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <set>

// Writes a flat deck: nodes, elements by type and region, elements kept as text, sets, cards. CalculiX reads
// at most 20 characters of each number.

namespace lacuna::io {

namespace {

constexpr std::size_t kWidth = 20;   // characters of a coordinate
constexpr std::size_t kPerLine = 16; // numbers of a line, at most

using mesh::MeshView;
using mesh::Ranges;

/// Remove the prefix of the only instance from names of nodes and sets.
std::string without_instance(std::string_view text, const std::string& instance)
{
    const std::string before = instance + ".";
    std::string flat;
    for (std::size_t i = 0; i < text.size();) {
        const bool begins = i == 0 || (std::isalnum(static_cast<unsigned char>(text[i - 1])) == 0 &&
                                       text[i - 1] != '_' && text[i - 1] != '-');
        if (begins && same_word(text.substr(i, before.size()), before))
            i += before.size();
        else
            flat += text[i++];
    }
    return flat;
}

struct Cards {
    std::string elements, others;
};

/// The kept cards. Element cards are separate, because they are written before the sets that name their
/// elements.
Cards cards_of(const MeshView::KeptText& kept)
{
    Cards cards;
    for (const AbaqusCard& card : abaqus_cards(kept.cards))
        (card.keyword.name == "ELEMENT" ? cards.elements : cards.others) += card.text;
    if (!kept.instance.empty()) cards.others = without_instance(cards.others, kept.instance);
    return cards;
}

/// Numbers as ranges [first, last).
using TagRanges = std::vector<std::pair<std::size_t, std::size_t>>;

/// The same numbers, rising and in as few ranges as possible.
TagRanges merged(TagRanges ranges)
{
    std::ranges::sort(ranges);
    TagRanges all;
    for (const auto& [first, last] : ranges)
        if (!all.empty() && all.back().second == first)
            all.back().second = last;
        else
            all.emplace_back(first, last);
    return all;
}

class AbaqusWriter {
public:
    explicit AbaqusWriter(const View& view) : view_(view), same_(view->kept.has_value()) {}

    DeckFile write(const std::string& unit)
    {
        Cards cards;
        file_.add(unit_comment(*view_, "**", unit));
        if (same_) {
            file_.add(view_->kept->head);
            cards = cards_of(*view_->kept);
        }
        find_bricks_and_shells();
        find_equations();
        add_nodes();
        choose_sets();
        choose_names();
        for (std::size_t b = 0; b < view_->blocks.size(); ++b) add_elements(b);
        file_.add(cards.elements);
        if (!equations_.empty()) file_.add(equations_);
        for (std::size_t s = 0; s < view_->sets.size(); ++s)
            if (!by_elements_[s]) add_set(s);
        add_periodic();
        add_contacts();
        if (view_->frames) add_orientation();
        file_.add(cards.others);
        return std::move(file_);
    }

private:
    void add_nodes()
    {
        const auto put = [](std::size_t, DeckTag tag, const Vec3& point, char* out) {
            out = put_text(out, tag);
            for (const double x : point) out = put_real(put_text(out, ", "), x, kWidth);
            return put_text(out, "\n");
        };
        file_.sections.push_back(
            section_of_points("*NODE\n", view_, kNumberBytes + 3 * (kWidth + 2) + 1, put));
    }

    /// Write periodic faces: as a cyclic symmetry if the mesh is a sector, otherwise as equations.
    void add_periodic()
    {
        if (view_->periodic.empty()) return;
        if (const CyclicSector sector = cyclic_sector(*view_); sector.sectors > 0) {
            std::string text = "*SURFACE, TYPE=NODE, NAME=periodic_1_master\nperiodic_1_a,\n"
                               "*SURFACE, TYPE=NODE, NAME=periodic_1_slave\nperiodic_1_b,\n"
                               "*TIE, CYCLIC SYMMETRY, NAME=periodic_1\nperiodic_1_slave, periodic_1_master\n"
                               "*CYCLIC SYMMETRY MODEL, N=" +
                               std::to_string(sector.sectors) + ", NGRAPH=1, TIE=periodic_1\n";
            const Vec3 end = sector.point + sector.axis;
            for (std::size_t i = 0; i < 6; ++i)
                text += real(i < 3 ? sector.point[static_cast<Eigen::Index>(i)]
                                   : end[static_cast<Eigen::Index>(i - 3)]) +
                        (i < 5 ? ", " : "\n");
            file_.add(std::move(text));
            return;
        }
        const PeriodicEquations all = periodic_equations(*view_);
        std::string text;
        for (std::size_t p = 0; p < all.number.size(); ++p) {
            if (all.number[p] == kNoIndex) continue;
            text += formatted("*NODE, NSET=periodic_{}\n{}", p + 1, all.tag(p));
            for (const double x : all.references[all.number[p]]) text += ", " + real(x);
            text += "\n";
        }
        for (const std::vector<PeriodicTerm>& terms : all.equations) {
            text += "*EQUATION\n" + std::to_string(terms.size()) + "\n";
            for (std::size_t t = 0; t < terms.size(); ++t) {
                text += formatted("{}, {}, {}{}", terms[t].tag, terms[t].direction + 1, real(terms[t].factor),
                                  t + 1 == terms.size() || t % 4 == 3 ? "\n" : ", ");
            }
        }
        file_.add(std::move(text));
    }
    void add_contacts()
    {
        for (const mesh::ContactPair& pair : view_->contacts) {
            const std::string name = abaqus_name(pair.name);
            file_.add(pair.tied ? "*TIE, NAME=" + name + ", POSITION TOLERANCE=" + real(pair.tolerance) +
                                      ", ADJUST=NO\n"
                                : "*SURFACE INTERACTION, NAME=" + name +
                                      "\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n"
                                      "*CONTACT PAIR, INTERACTION=" +
                                      name + ", TYPE=SURFACE TO SURFACE\n");
            file_.add(names_[pair.sets[0]] + ", " + names_[pair.sets[1]] + "\n");
        }
    }
    /// For each region, add a distribution with the axes of its cells, and an orientation that uses it, for
    /// *SOLID SECTION.
    void add_orientation()
    {
        file_.add("*DISTRIBUTION TABLE, NAME=axes\nCOORD3D, COORD3D\n");
        for (std::size_t r = 0; r < region_names_.size(); ++r) {
            if (dimensions_[r] != 3) continue;
            const std::string name = (region_names_[r].empty() ? "volume" : region_names_[r]) +
                                     "_orientation";
            file_.add("*DISTRIBUTION, NAME=" + name +
                      "_of, LOCATION=ELEMENT, TABLE=axes\n"
                      ", 1., 0., 0., 0., 1., 0.\n");
            for (std::size_t b = 0; b < view_->blocks.size(); ++b) {
                const MeshView::Block& block = view_->blocks[b];
                if ((*view_->frames)[b].empty()) continue;
                mesh::each_run(
                    block.regions, 0, block.count, [&](std::size_t first, std::size_t last, Index region) {
                        if (region < 0 || index(region) != r) return;
                        file_.sections.push_back(
                            {{},
                             last - first,
                             kNumberBytes + 6 * (kWidth + 2) + 1,
                             [view = view_, b, first](std::size_t begin, std::size_t end, char* out) {
                                 return put_axes(*view, b, first + begin, first + end, out);
                             }});
                    });
            }
            file_.add("*ORIENTATION, NAME=" + name + ", SYSTEM=RECTANGULAR\n" + name + "_of\n");
        }
    }
    static char* put_axes(const MeshView& view, std::size_t b, std::size_t begin, std::size_t end, char* out)
    {
        view.blocks[b].tags.each(begin, end, [&](std::size_t i, DeckTag tag) {
            if ((*view.frames)[b][i].column.isZero()) return;
            const std::array<Vec3, 3> axes = (*view.frames)[b][i].material();
            out = put_text(out, tag);
            for (const std::size_t a : {std::size_t(0), std::size_t(1)})
                for (const double x : axes[a]) out = put_real(put_text(out, ", "), x, kWidth);
            out = put_text(out, "\n");
        });
        return out;
    }

    static std::string real(double value) { return real_text(value, kWidth); }

    /// The type word for the elements of a block.
    [[nodiscard]] std::string_view type_of(const MeshView::Block& block) const
    {
        const bool own = is_abaqus_element(block.type, block.shape) || is_brick(block.shape, block.type);
        return own ? std::string_view(block.type) : words_of(block.shape).abaqus;
    }
    /// Whether cells of this shape and type word are written as bricks with merged corners.
    static bool is_brick(DeckShape shape, std::string_view type)
    {
        const std::optional<DeckShape> brick = merged_brick(shape);
        return brick && is_abaqus_element(type, *brick);
    }
    [[nodiscard]] bool is_brick(const MeshView::Block& block) const
    {
        return is_brick(block.shape, type_of(block));
    }
    /// Collect the numbers of elements whose sides have special names: pyramids that are written as bricks,
    /// because their sides are numbered like those of a brick, and shells, because their edges are E1, E2, …
    /// instead of S1, S2, … as in plane elements.
    void find_bricks_and_shells()
    {
        bricks_ = tags_of_blocks(*view_, [&](const MeshView::Block& block) { return is_brick(block); });
        shells_ = tags_of_blocks(*view_, [&](const MeshView::Block& block) {
            return shape_info(block.shape).dimension == 2 &&
                   type_of(block).substr(0, 2).find('C') == std::string_view::npos;
        });
    }

    /// Add equations that make the displacement linear along the base sides of pyramids of order 2. If the
    /// middle node of a side lies off the chord, its displacement is that of the affine map through four
    /// corners (the ends of the side, a third corner of the base, and the apex), so that rigid motions stay
    /// free.
    void find_equations()
    {
        const auto is_wanted = [&](const MeshView::Block& block) {
            return block.shape == DeckShape::pyramid13 && is_brick(block);
        };
        if (std::ranges::none_of(view_->blocks, is_wanted)) return;
        std::vector<Vec3> points;
        view_->each_point(0, view_->points, [&](std::span<const Vec3> some) {
            points.insert(points.end(), some.begin(), some.end());
        });
        std::set<DeckTag> known = dependent_nodes();
        for (const MeshView::Block& block : view_->blocks) {
            if (!is_wanted(block)) continue;
            block.each_cell(0, block.count, [&](std::size_t, std::span<const Index> nodes) {
                for (std::size_t k = 0; k < 4; ++k)
                    add_equation(points, nodes[5 + k],
                                 {nodes[k], nodes[(k + 1) % 4], nodes[(k + 2) % 4], nodes[4]}, known);
            });
        }
        if (equations_.empty()) return;
        equations_ = "** Middle nodes of the bases of pyramids, which are bricks with a repeated apex\n"
                     "*EQUATION\n" +
                     equations_;
        if (!same_) leave_out_of_sets(known);
    }

    /// The nodes that depend on others through equations in the deck.
    [[nodiscard]] std::set<DeckTag> dependent_nodes() const
    {
        std::set<DeckTag> nodes;
        if (!same_) return nodes;
        for (const AbaqusCard& card : abaqus_cards(view_->kept->cards))
            if (card.keyword.name == "EQUATION")
                each_equation_node(card, [&](DeckTag node, bool dependent) {
                    if (dependent) nodes.insert(node);
                });
        return nodes;
    }

    /// @param corners  corners of a pyramid; the first two are the ends of the side
    void add_equation(const std::vector<Vec3>& points, Index middle, const std::array<Index, 4>& corners,
                      std::set<DeckTag>& known)
    {
        const auto place = [&](std::size_t k) { return points[index(corners[k])]; };
        const DeckTag own = view_->point_tags[index(middle)];
        if (!known.insert(own).second) return;
        Eigen::Matrix3d edges;
        for (std::size_t k = 1; k < 4; ++k) edges.col(static_cast<int>(k) - 1) = place(k) - place(0);
        const Vec3 bend = points[index(middle)] - (place(0) + place(1)) / 2;
        Vec3 shares(0.5, 0, 0); // coefficients of the corners after the first
        if (bend.norm() > kFileAccuracy * (place(1) - place(0)).norm()) shares += edges.inverse() * bend;
        const bool straight = shares[1] == 0 && shares[2] == 0;
        for (int axis = 1; axis <= 3; ++axis) {
            equations_ += formatted("{}\n{}, {}, 1.", straight ? 3 : 5, own, axis);
            for (std::size_t k = 0; k < (straight ? 2u : 4u); ++k) {
                const double share = k == 0 ? 1 - shares.sum() : shares[static_cast<int>(k) - 1];
                equations_ += formatted("{}{}, {}, {}", k == 3 ? ",\n" : ", ",
                                        view_->point_tags[index(corners[k])], axis, real(-share));
            }
            equations_ += '\n';
        }
    }

    /// Remove dependent nodes from the sets of nodes, because CalculiX refuses boundary conditions on them.
    void leave_out_of_sets(const std::set<DeckTag>& nodes)
    {
        MeshView own = *view_;
        for (MeshView::Set& set : own.sets) {
            if (set.kind != mesh::SetKind::nodes) continue;
            Ranges kept;
            set.members.each_range(0, set.count, [&](std::size_t first, std::size_t last) {
                for (auto out = nodes.lower_bound(static_cast<DeckTag>(first));
                     out != nodes.end() && static_cast<std::size_t>(*out) < last; ++out) {
                    kept.add(first, static_cast<std::size_t>(*out));
                    first = static_cast<std::size_t>(*out) + 1;
                }
                kept.add(first, last);
            });
            set.count = kept.count();
            set.members = mesh::Numbers(std::move(kept));
        }
        view_ = std::make_shared<const MeshView>(std::move(own));
        file_.notes.push_back(formatted("{} middle nodes of pyramid bases depend on corners through "
                                        "equations, so they are in no set of nodes",
                                        nodes.size()));
    }

    /// Whether a set of elements has exactly the elements of a region.
    [[nodiscard]] bool is_region(const MeshView::Set& set, std::size_t region) const
    {
        TagRanges members, own;
        const auto add_to = [](TagRanges& all) {
            return [&all](std::size_t first, std::size_t last) { all.emplace_back(first, last); };
        };
        set.members.each_range(0, set.count, add_to(members));
        for (const MeshView::Block& block : view_->blocks)
            mesh::each_run(block.regions, 0, block.count, [&](std::size_t first, std::size_t last, Index of) {
                if (of >= 0 && index(of) == region) block.tags.each_range(first, last, add_to(own));
            });
        return merged(std::move(members)) == merged(std::move(own));
    }

    /// Find the sets that equal a region. They are written as the ELSET of the region's elements.
    void choose_sets()
    {
        const std::vector<MeshView::Region>& regions = view_->regions;
        by_elements_.assign(view_->sets.size(), false);
        region_names_.resize(regions.size());
        dimensions_.assign(regions.size(), 0);
        set_of_region_.assign(regions.size(), -1);
        makes_set_.assign(regions.size(), !same_);
        for (const MeshView::Block& block : view_->blocks)
            for (const auto& [end, region] : block.regions)
                if (region >= 0) dimensions_[index(region)] = shape_info(block.shape).dimension;
        for (std::size_t r = 0; r < regions.size(); ++r)
            for (std::size_t s = 0; s < by_elements_.size(); ++s) {
                const MeshView::Set& set = view_->sets[s];
                if (set.kind != mesh::SetKind::elements || !same_word(set.name, regions[r].name) ||
                    !is_region(set, r))
                    continue;
                // Write the set either on a card of its own or as ELSET of the elements. With both, CalculiX
                // would list each element of the set twice.
                makes_set_[r] = by_elements_[s] = !set.listed;
                set_of_region_[r] = static_cast<Index>(s);
            }
    }

    /// Choose distinct names of sets and regions. Surfaces are named first, then node sets, then element
    /// sets. Within each kind, sets whose names are valid in Abaqus come first, so that they keep these
    /// names.
    void choose_names()
    {
        using enum mesh::SetKind;
        std::vector<std::pair<mesh::SetKind, std::string>> taken;
        const auto choose = [&](mesh::SetKind kind, const std::string& name) {
            if (same_) return name;
            const std::string free = free_name(name, DeckFormat::abaqus, [&](const std::string& other) {
                return std::ranges::any_of(taken, [&](const auto& of) {
                    return share_names(DeckFormat::abaqus, kind, of.first) && same_word(of.second, other);
                });
            });
            if (free != abaqus_name(name))
                file_.notes.push_back(formatted("the set {} is called {}", name, free));
            taken.emplace_back(kind, free);
            return free;
        };
        names_.resize(view_->sets.size());
        for (const auto kind : {sides, nodes, elements})
            for (const bool stays : {true, false})
                for (std::size_t s = 0; s < names_.size(); ++s)
                    if (const MeshView::Set& set = view_->sets[s];
                        set.kind == kind && (abaqus_name(set.name) == set.name) == stays)
                        names_[s] = choose(kind, set.name);
        for (std::size_t r = 0; r < dimensions_.size(); ++r) {
            if (dimensions_[r] == 0) continue; // no elements
            std::string name = view_->regions[r].name;
            // A region from another format that has only a number gets a name from that number.
            if (name.empty() && !same_)
                name = (dimensions_[r] != 2 ? "volume:" : "surface:") + std::to_string(view_->regions[r].tag);
            region_names_[r] = set_of_region_[r] >= 0 ? names_[index(set_of_region_[r])]
                               : name.empty()         ? ""
                                                      : choose(elements, name);
        }
    }

    void add_elements(std::size_t b)
    {
        const MeshView::Block& block = view_->blocks[b];
        const std::string_view type = type_of(block);
        if (type.empty()) refuse_element(block, "Abaqus", "there is no such element");
        const bool brick = is_brick(block);
        const auto nodes = static_cast<std::size_t>(
            shape_info(brick ? *merged_brick(block.shape) : block.shape).nodes);
        const auto put = [view = view_, nodes, brick](DeckTag tag, std::span<const Index> own, char* out) {
            return put_element(*view, tag, own, nodes, brick, out);
        };
        for (auto& [region, elements] : cells_by_region(block))
            file_.sections.push_back(section_of_cells(head_of(type, region), view_, b, elements,
                                                      (nodes + 1) * kNumberBytes + 4, put));
    }

    [[nodiscard]] std::string head_of(std::string_view type, Index region) const
    {
        std::string head = "*ELEMENT, TYPE=" + std::string(type);
        if (region >= 0 && makes_set_[index(region)] && !region_names_[index(region)].empty())
            head += ", ELSET=" + region_names_[index(region)];
        return head + "\n";
    }

    /// @param count  number of nodes to write
    /// @param brick  whether a pyramid is written as a brick with merged corners
    static char* put_element(const MeshView& view, DeckTag tag, std::span<const Index> nodes,
                             std::size_t count, bool brick, char* out)
    {
        out = put_text(out, tag);
        for (std::size_t k = 0; k < count; ++k)
            out = put_text(out, (k + 1) % kPerLine == 0 ? ",\n" : ", ",
                           view.point_tags[index(nodes[brick ? kMergedBrick[k] : k])]);
        return put_text(out, "\n");
    }

    void add_set(std::size_t s)
    {
        const MeshView::Set& set = view_->sets[s];
        if (set.kind == mesh::SetKind::sides) {
            const auto put = [sides = set.sides, bricks = bricks_, shells = shells_](std::size_t i,
                                                                                     char* out) {
                DeckSide side = sides[i];
                if (side.side > 1 && std::ranges::binary_search(bricks, side.element)) ++side.side;
                return put_side(side, std::ranges::binary_search(shells, side.element), out);
            };
            file_.sections.push_back({"*SURFACE, TYPE=ELEMENT, NAME=" + names_[s] + "\n", set.sides.size(),
                                      2 * kNumberBytes, each(put)});
            return;
        }
        const std::string word = set.kind == mesh::SetKind::nodes ? "NSET" : "ELSET";
        const auto put = [count = set.count](std::size_t i, DeckTag tag, char* out) {
            return put_text(out, tag, (i + 1) % kPerLine == 0 || i + 1 == count ? "\n" : ", ");
        };
        file_.sections.push_back(section_of_members("*" + word + ", " + word + "=" + names_[s] + "\n", view_,
                                                    s, kNumberBytes + 2, put));
    }

    static char* put_side(const DeckSide& side, bool of_shell, char* out)
    {
        if (side.side < 1) return put_text(out, side.element, side.side == 0 ? ", SPOS\n" : ", SNEG\n");
        return put_text(out, side.element, of_shell ? ", E" : ", S", side.side, "\n");
    }

    View view_;
    bool same_; ///< the deck was read from this format, so names and kept text are unchanged
    DeckFile file_;
    std::vector<DeckTag> bricks_, shells_; ///< see `find_bricks_and_shells()`
    std::string equations_;                ///< the card of equations, see `find_equations()`; empty: none
    std::vector<bool> by_elements_;        ///< for each set, whether it is written as the ELSET of a region
    std::vector<bool> makes_set_;          ///< for each region: its elements create a set
    std::vector<Index> set_of_region_;     ///< set that each region creates; -1: none
    /// Dimension of the elements of each region; 0: there are none.
    std::vector<int> dimensions_;
    std::vector<std::string> names_, region_names_; ///< names of sets and of regions in the file
};

} // namespace

DeckFile abaqus_file(const View& view, const MeshFileOptions& options, const mesh::ViewParts* /*parts*/)
{
    return AbaqusWriter(view).write(options.unit);
}

} // namespace lacuna::io
