// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/core/ids.h>
#include <lacuna/core/types.h>

#include <cstddef>
#include <vector>

namespace lacuna::cad_worker {

/// A curve of the current Gmsh model: its topology and a polyline.
struct CadCurveInfo {
    int tag = 0;
    double low = 0, high = 0;   ///< range of the curve's parameter
    int from = 0, to = 0;       ///< indices in CadWire::vertices
    int uses = 0;               ///< number of uses by faces; a seam counts twice
    double length = 0;          ///< length of a fine polyline [file length]
    std::vector<double> params; ///< parameters of that polyline, ascending
    std::vector<Vec3> points;
    std::vector<std::size_t> pieces; ///< indices in CadWire::pieces, in order along the curve; empty if the
                                     ///< curve is a point
};

/// A part of a curve between two vertices. Pieces that coincide within the tolerance are sewn to one edge of
/// the model.
struct CadPiece {
    std::size_t curve = 0;
    double low = 0, high = 0;
    Index from = -1, to = -1; ///< model points of its end vertices, after sewing
    std::size_t edge = 0;
    bool reversed = false; ///< opposite to the direction of the edge
};

/// The edge of a set of sewn pieces; the master piece defines its shape.
struct CadEdge {
    std::size_t master = 0; ///< index in CadWire::pieces
    int tag = 0;
    std::vector<double> params; ///< parameters on the master's curve, both ends included
    std::vector<Index> points;  ///< model points
};

struct CadVertex {
    int tag = 0;
    Vec3 at = Vec3::Zero();
    Index point = -1; ///< model point; vertices closer than the tolerance share a model point
};

/// The curves around a face, each listed once.
struct CadFaceInfo {
    int tag = 0;
    struct Side {
        std::size_t curve;
        int uses; ///< 2: a seam or a slit
    };
    std::vector<Side> sides;
};

/// All curves of a Gmsh model, sewn into edges.
struct CadWire {
    std::vector<CadFaceInfo> faces;
    std::vector<CadVertex> vertices;
    std::vector<CadCurveInfo> curves;
    std::vector<CadPiece> pieces;
    std::vector<CadEdge> edges;
    std::vector<int> point_tag; ///< for each sewn vertex, the lowest tag among the vertices merged into it
    std::vector<Vec3> points;   ///< model points [file length]: sewn vertices, then those added by `divide()`
};

/// How finely curves and faces are divided.
struct Fineness {
    double turn = 0;     ///< largest turn of the tangent or the normal over one segment [radians]
    double max_size = 0; ///< [file length]
};

/// Read the curves of the current model and sew them. Vertices closer than the tolerance are merged. A curve
/// used by one face only is split where the end of another such curve lies on it. Pieces with the same ends
/// that coincide within the tolerance become one edge.
CadWire read_wire(double tolerance);

/// Place points on every edge: `refinement` times as many as the fineness requires, with one factor for each
/// edge.
void divide(CadWire& wire, const Fineness& fineness, const std::vector<double>& refinement);

/// For each point of the edge to which a piece was sewn, in the direction of the piece: its parameter on the
/// piece's curve, and its model point.
struct PieceNodes {
    std::vector<double> params;
    std::vector<Index> points;
};
PieceNodes nodes_of(const CadWire& wire, std::size_t piece);

} // namespace lacuna::cad_worker
