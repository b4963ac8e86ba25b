// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/facet_collector.h>

#include <lacuna/core/error.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/triangulate.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace lacuna::io {
namespace {

/// Whether every triangle from the first corner looks the polygon's way, so that a fan fills it.
bool fan_fills(const std::vector<Vec3>& at, const Vec3& normal)
{
    for (std::size_t k = 1; k + 1 < at.size(); ++k)
        if ((at[k] - at[0]).cross(at[k + 1] - at[0]).dot(normal) < 0) return false;
    return true;
}

/// Faces in the order of their labels; those of one label stay in their order.
template <class Cell>
void sort_cells(std::vector<Cell>& cells, std::vector<int>& labels)
{
    if (std::is_sorted(labels.begin(), labels.end())) return;
    std::vector<std::size_t> order(cells.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return labels[a] < labels[b]; });
    std::vector<Cell> sorted_cells;
    std::vector<int> sorted_labels;
    sorted_cells.reserve(order.size());
    sorted_labels.reserve(order.size());
    for (const std::size_t c : order) {
        sorted_cells.push_back(cells[c]);
        sorted_labels.push_back(labels[c]);
    }
    cells = std::move(sorted_cells);
    labels = std::move(sorted_labels);
}

} // namespace

int FacetCollector::add_label(int tag, std::string_view name)
{
    file_.label_tag.push_back(tag);
    file_.soup.label_name.emplace_back(trimmed(name));
    return static_cast<int>(file_.label_tag.size()) - 1;
}

int FacetCollector::label_of(int tag, std::string_view name, bool group)
{
    const auto [found, fresh] = labels_.try_emplace({tag, group}, static_cast<int>(file_.label_tag.size()));
    if (fresh) add_label(tag, name);
    return found->second;
}

void FacetCollector::add_face(std::span<const Index> corners, int label, const Cursor& cursor)
{
    healing::FacetSoup& soup = file_.soup;
    if (corners.size() < 3)
        cursor.fail("expected a face of three corners or more, found " + std::to_string(corners.size()));
    for (const Index p : corners)
        if (p < 0 || index(p) >= soup.points.size())
            cursor.fail("expected a point of " + std::to_string(soup.points.size()) + ", found number " +
                        std::to_string(std::int64_t(p) + 1));
    const auto add_triangle = [&](Index a, Index b, Index c) {
        soup.triangles.push_back({a, b, c});
        soup.triangle_label.push_back(label);
    };
    if (corners.size() == 3) return add_triangle(corners[0], corners[1], corners[2]);
    if (corners.size() == 4) {
        soup.quads.push_back({corners[0], corners[1], corners[2], corners[3]});
        soup.quad_label.push_back(label);
        return;
    }
    std::vector<Vec3> at;
    for (const Index p : corners) at.push_back(soup.points[index(p)]);
    if (fan_fills(at, geometry::newell_vector(at))) {
        for (std::size_t k = 1; k + 1 < corners.size(); ++k)
            add_triangle(corners[0], corners[k], corners[k + 1]);
        return;
    }
    const geometry::Plane plane = geometry::newell_plane(std::vector<std::vector<Vec3>>{at});
    std::vector<Vec2> flat;
    for (const Vec3& p : at) flat.push_back(geometry::to_plane(plane, p));
    std::vector<Index> loop(corners.size());
    std::iota(loop.begin(), loop.end(), 0);
    try {
        const auto cut = geometry::triangulate(flat, std::vector<std::vector<Index>>{loop},
                                               {.interior_points = false});
        for (const Triangle& t : cut.triangles)
            add_triangle(corners[index(t[0])], corners[index(t[1])], corners[index(t[2])]);
    } catch (const InvalidInput&) {
        cursor.fail("the polygon of " + std::to_string(corners.size()) + " corners crosses itself");
    }
}

void FacetCollector::pass_over(const std::string& what, std::size_t count)
{
    constexpr std::size_t kMostKinds = 1000; // a file of nonsense must not fill the memory with its words
    const bool known = passed_over_.size() < kMostKinds || passed_over_.contains(what);
    if (count > 0) passed_over_[known ? what : "others"] += count;
}

void FacetCollector::pass_over_solid(const std::string& what, std::size_t count)
{
    solids_ = solids_ || count > 0;
    pass_over(what, count);
}

void FacetCollector::sort_by_label(bool by_tag)
{
    healing::FacetSoup& soup = file_.soup;
    std::vector<std::size_t> order(file_.label_tag.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return by_tag && file_.label_tag[a] < file_.label_tag[b]; });
    std::vector<int> rank(order.size()), tags;
    std::vector<std::string> names;
    for (std::size_t r = 0; r < order.size(); ++r) {
        rank[order[r]] = static_cast<int>(r);
        tags.push_back(file_.label_tag[order[r]]);
        names.push_back(std::move(soup.label_name[order[r]]));
    }
    file_.label_tag = std::move(tags);
    soup.label_name = std::move(names);
    for (int& label : soup.triangle_label) label = rank[index(label)];
    for (int& label : soup.quad_label) label = rank[index(label)];
    sort_cells(soup.triangles, soup.triangle_label);
    sort_cells(soup.quads, soup.quad_label);

    std::vector<Index> number(soup.points.size(), -1);
    std::vector<Vec3> points;
    const auto meet = [&](auto& cell) {
        for (Index& p : cell) {
            if (number[index(p)] < 0) {
                number[index(p)] = static_cast<Index>(points.size());
                points.push_back(soup.points[index(p)]);
            }
            p = number[index(p)];
        }
    };
    std::size_t t = 0;
    std::size_t q = 0;
    for (int label = 0; label < static_cast<int>(rank.size()); ++label) {
        for (; t < soup.triangles.size() && soup.triangle_label[t] == label; ++t) meet(soup.triangles[t]);
        for (; q < soup.quads.size() && soup.quad_label[q] == label; ++q) meet(soup.quads[q]);
    }
    soup.points = std::move(points);
}

std::string FacetCollector::counted() const
{
    constexpr std::size_t kMostNamed = 12; // a choice: a line that can still be read
    std::string text;
    std::size_t named = 0;
    std::size_t others = 0;
    for (const auto& [what, count] : passed_over_) {
        if (named++ < kMostNamed)
            text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what;
        else
            others += count;
    }
    return others > 0 ? text + " and " + std::to_string(others) + " others" : text;
}

void FacetCollector::check_points(const std::string& path) const
{
    constexpr double kFarthest = 1e100; // a volume of such lengths is still a number
    for (std::size_t p = 0; p < file_.soup.points.size(); ++p) {
        if (file_.soup.points[p].cwiseAbs().maxCoeff() <= kFarthest) continue;
        throw InvalidInput("io.unreadable", "cannot read " + path + ": point " + std::to_string(p + 1) +
                                                " has a coordinate beyond 1e100");
    }
}

FacetFile FacetCollector::take(const std::string& path)
{
    const std::string passed = counted();
    if (file_.soup.triangles.empty() && file_.soup.quads.empty()) {
        throw InvalidInput(
            "io.no_faces",
            path + " holds no faces" +
                (solids_ ? ", only solid cells; export their skin as shells"
                         : " that can be read; check that it is what its ending says, and holds triangles "
                           "or quads") +
                (passed.empty() ? "" : ". Passed over: " + passed));
    }
    check_points(path);
    if (!passed.empty()) file_.notes.push_back(path + ": passed over " + passed);
    return std::move(file_);
}

Index NodeTags::find(std::uint64_t tag) const
{
    if (tag < dense_.size()) return dense_[tag];
    const auto found = std::lower_bound(sparse_.begin(), sparse_.end(),
                                        std::pair<std::uint64_t, Index>{tag, 0});
    return found == sparse_.end() || found->first != tag ? -1 : found->second;
}

void TaggedFaces::resolve(const NodeTags& nodes, FacetCollector& into) const
{
    for (const Face& face : faces_) {
        std::array<Index, kMostCorners> corner{};
        for (std::size_t k = 0; k < index(face.corners); ++k) {
            corner[k] = face.node[k] < 0 ? -1 : nodes.find(static_cast<std::uint64_t>(face.node[k]));
            if (corner[k] < 0)
                face.cursor->fail_at(face.position, "the face names node " + std::to_string(face.node[k]) +
                                                        ", which is not there");
        }
        into.add_face({corner.data(), index(face.corners)}, face.label, *face.cursor);
    }
}

} // namespace lacuna::io
