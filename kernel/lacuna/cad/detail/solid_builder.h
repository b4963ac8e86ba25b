// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad/detail/exact_geometry.h>
#include <lacuna/cad/detail/spline_patch.h>
#include <lacuna/cad/session.h>
#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <map>
#include <string>
#include <vector>

namespace lacuna::cad {

/// Builds the faces of a sealed volume in the current Gmsh model, in lengths of the volume's own model.
///
/// Within a session, a model of ours being current when it is made; that one is current after every call.
class SolidBuilder {
public:
    /// @param workshop  a folder for files on the way, with no separator at its end.
    SolidBuilder(Session& session, const GmshModel& scratch, const topology::OpenVolume& volume,
                 std::string workshop);

    struct Built {
        std::vector<int> faces;             ///< in the scratch model
        std::size_t planes = 0, fitted = 0; ///< void faces made
    };
    /// Make every face of the volume. @throw InvalidInput, BackendError  names the face.
    Built build(const RunContext& context);

private:
    /// Tags in the source's model as tags in the scratch model.
    struct Imported {
        std::map<int, int> faces, curves;
    };
    void import_sources();
    /// Tags in a source's model.
    struct Wanted {
        std::vector<int> faces, curves;
    };
    Imported import_source(const CadSource& source, const Wanted& wanted);
    [[nodiscard]] int exact_face(const topology::Face& face) const;
    std::vector<int> make_face(FaceId face, Built& built);
    int plane(FaceId face);
    std::vector<int> patches(FaceId face, const std::vector<std::vector<topology::EdgeUse>>& sides);
    int filling(FaceId face);
    int wire(const topology::Loop& loop);
    std::vector<int> curves_of(EdgeId edge);
    std::vector<int> make_curves(EdgeId edge);
    [[nodiscard]] int exact_curve(const topology::Edge& edge) const;
    int point(Index p);
    int add_surface(const SplineSurface& surface);
    int add_curve(const SplineCurve& curve);
    void forget_removed();

    Session& session_;
    const GmshModel& scratch_;
    const topology::OpenVolume& volume_;
    const topology::Model& model_;
    std::string workshop_;
    double precision_ = 0;
    std::map<const CadSource*, Imported> imported_;
    std::map<EdgeId, std::vector<int>> curves_;
    std::map<Index, int> points_;
};

/// Gmsh's options for bringing in shapes as they are, `scale` times as large.
void set_plain_import(Session& session, double scale);

} // namespace lacuna::cad
