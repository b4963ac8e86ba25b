// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/core/ids.h>
#include <lacuna/core/types.h>

#include <cstddef>
#include <vector>

namespace lacuna::cad_worker {

/// A curve of the current Gmsh model, as far as its topology goes.
struct CadCurveInfo {
    int tag = 0;
    double low = 0, high = 0;   ///< parameters
    int from = 0, to = 0;       ///< indices in CadWire::vertices
    int uses = 0;               ///< by faces; a seam counts twice
    double length = 0;          ///< of a fine polyline [file length]
    std::vector<double> params; ///< of that fine polyline, rising
    std::vector<Vec3> points;
    std::vector<std::size_t> pieces; ///< in CadWire::pieces, as the curve runs; empty where it is but a point
};

/// A part of a curve between two vertices, and the edge of the model it belongs to. Curves that lie on
/// each other within tolerance have pieces of one edge.
struct CadPiece {
    std::size_t curve = 0;
    double low = 0, high = 0;
    Index from = -1, to = -1; ///< points of the model: sewn vertices
    std::size_t edge = 0;
    bool reversed = false; ///< runs against the edge
};

/// The edge of a sewn set of pieces; the first of them gives it its shape.
struct CadEdge {
    std::size_t master = 0; ///< in CadWire::pieces
    int tag = 0;
    std::vector<double> params; ///< of the master's curve, both ends included
    std::vector<Index> points;  ///< of the model
};

struct CadVertex {
    int tag = 0;
    Vec3 at = Vec3::Zero();
    Index point = -1; ///< of the model: vertices closer than the tolerance share it
};

/// The curves around a face, each once.
struct CadFaceInfo {
    int tag = 0;
    struct Side {
        std::size_t curve;
        int uses; ///< 2: a seam, or a slit
    };
    std::vector<Side> sides;
};

/// All curves of a Gmsh model, sewn.
struct CadWire {
    std::vector<CadFaceInfo> faces;
    std::vector<CadVertex> vertices;
    std::vector<CadCurveInfo> curves;
    std::vector<CadPiece> pieces;
    std::vector<CadEdge> edges;
    std::vector<int> point_tag; ///< tag of the lowest vertex at each sewn vertex
    std::vector<Vec3> points;   ///< of the model [file length]: sewn vertices, then what `divide()` added
};

/// How fine curves and faces are cut.
struct Fineness {
    double turn = 0;     ///< of the tangent or the normal, from one side to the next [radians]
    double max_size = 0; ///< [file length]
};

/// Read the curves of the current model and sew them: vertices closer than the tolerance become one; a curve
/// used by one face alone is cut at other faces' vertices on it; pieces with the same ends that stay within
/// the tolerance of each other become one edge.
CadWire read_wire(double tolerance);

/// Give every edge its points, `refinement` (one an edge) times as many as the fineness asks for.
void divide(CadWire& wire, const Fineness& fineness, const std::vector<double>& refinement);

/// Parameters of a piece at the points of its edge, rising with the edge's direction taken into account, and
/// those points, both in the direction of the piece.
struct PieceNodes {
    std::vector<double> params;
    std::vector<Index> points;
};
PieceNodes nodes_of(const CadWire& wire, std::size_t piece);

} // namespace lacuna::cad_worker
