// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/ids.h>
#include <lacuna/core/message.h>
#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>
#include <lacuna/geometry/exact.h>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace lacuna::topology {

/// Whether an entity comes from the input, or from closing it (v-Topology in @cite mukherjee_2014_open).
enum class Origin { given, made_void };

/// How the facets of a face were made (v-Geometry in @cite mukherjee_2014_open, with its algorithms).
enum class Geometry {
    given,       ///< from the input
    newell,      ///< Algorithm 4: triangulated in its Newell plane
    transfinite, ///< Algorithm 6: transfinite interpolation between four sides
    annular,     ///< Algorithm 5: between two closed edges
    followed,    ///< transfinite interpolation that follows the motion of the given walls
    parallel,    ///< the shape of the given end, moved to the rim of the walls
};

struct Vertex {
    Index point = -1; ///< index in Model::points
    int tag = 0;      ///< as shown to the user
    Origin origin = Origin::given;
};

/// A chain of model points between two vertices. A closed edge has one vertex, which is both `from` and `to`.
struct Edge {
    int tag = 0;
    Origin origin = Origin::given;
    VertexId from, to;
    std::vector<Index> points;  ///< from..to inclusive, at least 2; closed: first == last
    std::vector<double> params; ///< the curve's parameter at each point; empty without `curve`
    std::shared_ptr<const geometry::ExactCurve> curve; ///< null if only facets are known
    bool keeps_nodes = false;                          ///< its points are mesh nodes and are kept
};

/// One use of an edge by a loop: in the edge's direction, or reversed.
struct EdgeUse {
    EdgeId edge;
    bool reversed = false;
    friend constexpr auto operator<=>(const EdgeUse&, const EdgeUse&) = default;
};

/// A closed chain of edge uses with the face on its left. A seam is used twice, once in each direction.
struct Loop {
    std::vector<EdgeUse> uses;
};

/// Facets with a boundary. Facets of two faces that share an edge share the edge's points.
struct Face {
    int tag = 0;                     ///< the tag that Gmsh shows for the same file
    std::vector<int> repeated_tags;  ///< tags of equal faces that were left out
    std::string name;                ///< a physical group, part, element set; may be empty
    std::vector<std::string> groups; ///< all sets, surfaces and properties of the file that contain the face
    /// All names of the one or two regions beside the face: solids or, in files without solids, shells.
    std::vector<std::vector<std::string>> regions;
    /// "plane", "cylinder", "cone", "sphere", "torus", "bspline", "surface", "discrete" or "void".
    std::string kind = "discrete";
    Origin origin = Origin::given;
    Geometry geometry = Geometry::given;
    std::vector<Triangle> triangles;     ///< model points, counter-clockwise, oriented as the face
    std::vector<std::array<Vec2, 3>> uv; ///< surface parameters at the corners; empty without `surface`
    std::shared_ptr<const geometry::ExactSurface> surface; ///< null if only facets are known
    std::vector<Quad> given_quads; ///< the mesh that was given with the face, model points; may be empty
    bool keeps_nodes = false;      ///< given as a mesh: its quads and the nodes of its rim are kept
    bool tube = false;             ///< a tube that was divided off a smooth junction

    std::vector<Loop> loops; ///< derived from the triangles, see `with_loops()`; the longest first
};

/// A face that uses an edge, and the direction.
struct FaceUse {
    FaceId face;
    bool reversed = false;
};

/// Faces, edges and vertices over one array of points.
struct ModelParts {
    std::vector<Vec3> points;
    std::vector<Vertex> vertices;
    std::vector<Edge> edges;
    std::vector<Face> faces;
    double diagonal = 0;        ///< diagonal of the bounding box [model length]
    double tolerance = 0;       ///< points closer than this coincide [model length]
    std::string source;         ///< the file(s) it was read from, for messages
    std::vector<Message> notes; ///< entities that loading dropped or left unconnected, one sentence each
    int last_void_face = 0;     ///< highest tag of the void faces of other pieces of one volume

private:
    friend class Model;
    friend class ModelBuilder;
    std::vector<FaceUse> uses_;          ///< uses of all edges, in the order of the edges
    std::vector<std::size_t> first_use_; ///< start of each edge's uses, then the end; empty before `finish()`
};

/// Faces, edges and vertices that no longer change, and the uses of each edge. Made by
/// `ModelBuilder::finish()`. Copies of a model share its data, which exist as long as one of the copies:
/// store the model that a call returns in a variable before iterating over its faces.
class Model {
public:
    Model(); ///< an empty model
    Model(const Model&) = default;
    Model(Model&& other) noexcept;
    Model& operator=(Model other) noexcept;
    ~Model() = default;

    [[nodiscard]] const Vertex& operator[](VertexId id) const { return vertices[id.index()]; }
    [[nodiscard]] const Edge& operator[](EdgeId id) const { return edges[id.index()]; }
    [[nodiscard]] const Face& operator[](FaceId id) const { return faces[id.index()]; }
    [[nodiscard]] const Vec3& at(Index point) const { return points[static_cast<std::size_t>(point)]; }
    /// Uses of an edge by the faces' loops, in the order of the faces; a seam is listed twice.
    /// @throw std::out_of_range  the model is not finished.
    [[nodiscard]] std::span<const FaceUse> uses_of_edge(EdgeId edge) const
    {
        const std::size_t first = parts_->first_use_.at(edge.index());
        return std::span(parts_->uses_).subspan(first, parts_->first_use_.at(edge.index() + 1) - first);
    }

private:
    friend class ModelBuilder;
    explicit Model(std::shared_ptr<const ModelParts> parts);
    std::shared_ptr<const ModelParts> parts_;

public:
    const std::vector<Vec3>& points;
    const std::vector<Vertex>& vertices;
    const std::vector<Edge>& edges;
    const std::vector<Face>& faces;
    const double &diagonal, &tolerance;
    const std::string& source;
    const std::vector<Message>& notes;
};

/// Makes a model, from nothing or from the parts of another model. The builder converts to a `const Model&`,
/// so that functions can read the parts made so far; this view has no uses of edges yet.
class ModelBuilder : public ModelParts {
public:
    ModelBuilder() = default;
    /// Start from the parts of a model. They are not copied if it is moved in and no other model shares them.
    explicit ModelBuilder(Model from);
    ModelBuilder(const ModelBuilder&) = delete;
    ModelBuilder& operator=(const ModelBuilder&) = delete;

    operator const Model&() const { return made_; }
    operator Model() const = delete; // a copy would change with the builder
    [[nodiscard]] Vertex& operator[](VertexId id) { return vertices[id.index()]; }
    [[nodiscard]] Edge& operator[](EdgeId id) { return edges[id.index()]; }
    [[nodiscard]] Face& operator[](FaceId id) { return faces[id.index()]; }
    [[nodiscard]] const Vertex& operator[](VertexId id) const { return vertices[id.index()]; }
    [[nodiscard]] const Edge& operator[](EdgeId id) const { return edges[id.index()]; }
    [[nodiscard]] const Face& operator[](FaceId id) const { return faces[id.index()]; }
    [[nodiscard]] const Vec3& at(Index point) const { return made_.at(point); }

    /// Add void entities, numbered after the existing ones. The caller sets the loops.
    VertexId add_void_vertex(Index point);
    EdgeId add_void_edge(VertexId from, VertexId to, std::vector<Index> chain);
    /// A face without facets yet.
    FaceId add_void_face(Geometry geometry);
    /// Set every face's loops from its triangles and the model's edges.
    /// @pre  every boundary side of a face's triangles, and every seam, lies on an edge.
    /// @throw InvalidInput  a boundary side lies on no edge, or the facets are not a manifold; names the
    ///        face. Cancelled
    void build_loops(const RunContext& context = {});
    /// Reverse the orientation of a face.
    void flip(FaceId face);
    /// The model, with the uses of its edges. The builder must not be used after it.
    [[nodiscard]] Model finish() &&;

private:
    Model made_{{std::shared_ptr<const ModelParts>(), this}}; ///< a view of the parts made so far
    int edge_tag_ = 1, face_tag_ = 1; ///< next free tags of void entities, for the first `tagged_…` entities
    std::size_t tagged_edges_ = 0, tagged_faces_ = 0;
};

// --- derived facts --------------------------------------------------------------------------------

/// First and last vertex of an edge as a loop uses it.
VertexId use_from(const Model& model, EdgeUse use);
VertexId use_to(const Model& model, EdgeUse use);
/// Points along a use, both ends included.
std::vector<Index> use_points(const Model& model, EdgeUse use);
/// Length of the edge's polyline [model length].
double edge_length(const Model& model, EdgeId edge);
/// Sum of the facet areas [model length²] and of the facets' area vectors.
double face_area(const Model& model, FaceId face);
Vec3 face_area_vector(const Model& model, FaceId face);
/// Whether the face has given quads that cover it.
bool has_quads_all_over(const Face& face);
/// Facets that are not halves of the face's given quads. O(facets log).
std::vector<Triangle> loose_triangles(const Face& face);
/// Whether the face's given cells can be its mesh. This is so if given quads cover the face, or, with
/// `wedges`, if the face was given as a mesh of quads and triangles.
bool has_cells_to_keep(const Face& face, bool wedges);
/// Every face of a model, in its order.
std::vector<FaceId> all_faces(const Model& model);
/// Area-weighted centre of the facets.
Vec3 face_centroid(const Model& model, FaceId face);

// --- making another model -------------------------------------------------------------------------

/// The model with loops as `ModelBuilder::build_loops()` sets them.
Model with_loops(Model model, const RunContext& context = {});

/// Flip faces until neighbours agree along shared edges, starting at the first face of each connected part. A
/// part that encloses a volume is oriented outward.
/// @throw InvalidInput  names a part that cannot be oriented (a Möbius band), or an edge with three faces.
void orient_consistently(Model& model);

} // namespace lacuna::topology
