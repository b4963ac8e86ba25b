// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad_protocol/messages.h>
#include <lacuna/cad_worker/import_cad.h>
#include <lacuna/cad_worker/session.h>

#include <map>
#include <string>
#include <vector>

namespace lacuna::cad_worker {

/// The files a solid goes through on its way: names this process can write and read, and no one else sees.
struct SolidFiles {
    std::string source; ///< .brep: shapes on their way from a loaded model
    std::string all;    ///< .brep: everything made
    std::string result; ///< .step or .brep: the solid
};

/// Makes a solid of exact faces of loaded models, planes, splines and fillings, in a model of its own.
class SolidBuilder {
public:
    /// @param subject  the file to be written, for messages.
    SolidBuilder(std::string subject, SolidFiles files);

    /// Bring in faces and curves of a loaded model, scaled as that model was.
    /// @return those there are; Gmsh's own kernel has faces too, which no CAD file can hold.
    /// @throw BackendError  one got lost on its way through a file; names it.
    cad_protocol::BeginSolidReply::Found add_source(const CadSource& source,
                                                    const cad_protocol::SolidSource& wanted);

    /// Make every face, sew them, write the solid to the result file and read it back.
    /// @throw BackendError  names the face that cannot be made, or says why no solid came of it.
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

    /// Tags in the source's model as tags in this one.
    struct Imported {
        std::map<int, int> faces, curves;
    };

    Session session_;
    GmshModel scratch_;
    SolidFiles files_;
    const cad_protocol::MakeSolidRequest* request_ = nullptr; ///< while it is made
    std::vector<Imported> imported_;
    std::map<Index, std::vector<int>> curves_;
    std::map<Index, int> points_;
};

} // namespace lacuna::cad_worker
