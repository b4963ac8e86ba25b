// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/cursor.h>
#include <lacuna/io/load_facets.h>

#include <algorithm>
#include <map>
#include <span>

/// What the readers of facets share. Internal to this folder.
namespace lacuna::io {

/// Gathers what a reader finds.
class FacetCollector {
public:
    std::vector<Vec3>& points() { return file_.soup.points; }

    /// A new label.
    int add_label(int tag, std::string_view name);
    /// The label of this tag, new where it is the first time. @param group  of two numberings in one file the second.
    int label_of(int tag, std::string_view name = {}, bool group = false);
    /// Add a face of three corners or more; more than four are split into triangles.
    /// @throw InvalidInput  fewer corners, a point that is not there, a polygon that crosses itself.
    void add_face(std::span<const Index> corners, int label, const Cursor& cursor);
    /// Count what is not taken.
    void pass_over(const std::string& what, std::size_t count = 1);
    void pass_over_solid(const std::string& what, std::size_t count = 1);

    /// Put the faces in the order of their labels, these in the order of their tags or as they came, and number the
    /// points as they are met; unused points go.
    void sort_by_label(bool by_tag = true);
    /// What was gathered. @throw InvalidInput "io.no_faces", "io.unreadable" (a point too far away)
    FacetFile take(const std::string& path);

private:
    void check_points(const std::string& path) const;
    std::string counted() const;

    FacetFile file_;
    std::map<std::pair<int, bool>, int> labels_;
    std::map<std::string, std::size_t> passed_over_;
    bool solids_ = false;
};

/// Positions of nodes by the tags the file gives them, which need not be dense.
class NodeTags {
public:
    void reserve(std::size_t count) { tags_.reserve(count); }
    void add(std::uint64_t tag) { tags_.push_back(tag); }

    /// Call when all are there; `twice(a, b)` is told of nodes with the same tag, of which the first counts.
    template <class Twice>
    void finish(const Twice& twice);
    /// -1 where there is none.
    [[nodiscard]] Index find(std::uint64_t tag) const;

private:
    std::vector<std::uint64_t> tags_;
    std::vector<Index> dense_;
    std::vector<std::pair<std::uint64_t, Index>> sparse_;
};

/// Faces of formats that may name nodes before they come.
class TaggedFaces {
public:
    static constexpr std::size_t kMostCorners = 4;
    struct Face {
        std::array<Index, kMostCorners> node{}; ///< tags
        int corners = 0;
        int label = 0;
        const Cursor* cursor = nullptr; ///< of its file, for messages
        std::size_t position = 0;
    };
    void add(const Face& face) { faces_.push_back(face); }
    /// Hand all to the collector. @throw InvalidInput  a node that is not there; names file and line.
    void resolve(const NodeTags& nodes, FacetCollector& into) const;
    std::vector<Face>& all() { return faces_; }

private:
    std::vector<Face> faces_;
};

void read_stl(Cursor& cursor, FacetCollector& into);
void read_obj(Cursor& cursor, FacetCollector& into);
void read_msh_facets(Cursor& cursor, FacetCollector& into);
void read_unv(Cursor& cursor, FacetCollector& into);
void read_nastran(Cursor& cursor, FacetCollector& into);
void read_vtk(Cursor& cursor, FacetCollector& into);
void read_vtu(Cursor& cursor, FacetCollector& into);
void read_medit(Cursor& cursor, FacetCollector& into);
/// Whether bytes are a binary STL file of one solid, to the byte.
bool is_binary_stl(std::string_view bytes);

template <class Twice>
void NodeTags::finish(const Twice& twice)
{
    std::uint64_t highest = 0;
    for (const std::uint64_t tag : tags_) highest = std::max(highest, tag);
    // A table up to the highest tag, where it is not much longer than the tags themselves: 4 × is a choice.
    if (highest / 4 <= tags_.size()) {
        dense_.assign(highest + 1, -1);
        for (std::size_t i = 0; i < tags_.size(); ++i) {
            Index& place = dense_[tags_[i]];
            if (place >= 0)
                twice(place, static_cast<Index>(i));
            else
                place = static_cast<Index>(i);
        }
        return;
    }
    for (std::size_t i = 0; i < tags_.size(); ++i) sparse_.push_back({tags_[i], static_cast<Index>(i)});
    std::sort(sparse_.begin(), sparse_.end());
    for (std::size_t i = 1; i < sparse_.size(); ++i)
        if (sparse_[i].first == sparse_[i - 1].first) twice(sparse_[i - 1].second, sparse_[i].second);
}

} // namespace lacuna::io
