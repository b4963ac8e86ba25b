// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad_protocol/shared/messages.h>
#include <lacuna/cad_worker/import_cad.h>
#include <lacuna/cad_worker/session.h>

#include <map>
#include <string>
#include <vector>

namespace lacuna::cad_worker {

/// Paths of the intermediate and final files of a solid, which only this process can open.
struct SolidFiles {
    std::string source; ///< .brep: shapes copied from a loaded model
    std::string all;    ///< .brep: all shapes of the building model
    std::string result; ///< .step or .brep: the solid
};

/// Builds a solid from exact faces of loaded models, planes, splines and filled surfaces, in its own model.
class SolidBuilder {
public:
    /// @param subject  the file to be written, for messages.
    SolidBuilder(std::string subject, SolidFiles files);

    /// Copy faces and curves of a loaded model, scaled as that model was.
    /// @return the entities that exist; faces of Gmsh's built-in kernel cannot be stored in a CAD file.
    /// @throw BackendError  an entity was lost when it was copied through a file; names it.
    cad_protocol::BeginSolidReply::Found add_source(const CadSource& source,
                                                    const cad_protocol::SolidSource& wanted);

    /// Make all faces, sew them, write the solid to the result file and read it back.
    /// @throw BackendError  a face cannot be made (names it), or the faces form no solid (gives the reason).
    cad_protocol::MakeSolidReply make(const cad_protocol::MakeSolidRequest& request,
                                      const Progress& progress);

private:
    std::vector<int> make_face(const cad_protocol::SolidFace& face);
    int plane(const cad_protocol::SolidFace& face);
    int filling(const cad_protocol::SolidFace& face);
    int wire(const std::vector<std::array<Index, 2>>& loop);
    std::vector<int> curves_of(Index edge);
    std::vector<int> make_curves(const cad_protocol::SolidEdge& edge);
    int point(Index p);
    void forget_removed();

    /// Maps tags of the source model to tags of this model.
    struct Imported {
        std::map<int, int> faces, curves;
    };

    Session session_;
    GmshModel scratch_;
    SolidFiles files_;
    const cad_protocol::MakeSolidRequest* request_ = nullptr; ///< set during make()
    std::vector<Imported> imported_;
    std::map<Index, std::vector<int>> curves_;
    std::map<Index, int> points_;
};

} // namespace lacuna::cad_worker
