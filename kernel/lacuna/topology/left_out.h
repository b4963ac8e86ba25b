// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <string>
#include <vector>

namespace lacuna::topology {

/// A face of a CAD file that could not be read, and is no sliver: where it was is a hole in the model.
struct LeftOutFace {
    int tag = 0;        ///< in the file
    std::string source; ///< the file(s)
    std::string why;    ///< goes on from "face 6 "
    friend bool operator==(const LeftOutFace&, const LeftOutFace&) = default;
};

/// What an exact curve of an edge is too, where its file had faces at that edge that were left out.
class BesideLeftOut {
public:
    virtual ~BesideLeftOut() = default;
    [[nodiscard]] virtual const std::vector<LeftOutFace>& left_out() const = 0;
};

/// A face left out that has edges of faces that were read.
struct LeftOutBeside {
    LeftOutFace face;
    std::vector<EdgeId> edges; ///< rising
};

/// Faces left out where they may be missing from `faces`: those with an edge that these use once.
/// @return in the order of their first edges.
/// @note   O(edges); exact curves of the edges know it, so that it holds in every model taken out of the one
///         that was loaded.
std::vector<LeftOutBeside> left_out_beside(const Model& model, const std::vector<FaceId>& faces);

/// A volume whose walls or roles are found takes a hole for a part of the void: refuse one where a face was
/// left out.
/// @param found  what is found, for the message, as "walls".
/// @throw InvalidInput "cad.face_left_out"  names the face and one of its edges, and what to try.
void require_none_left_out(const Model& model, const std::vector<FaceId>& faces, const std::string& found);

/// Which faces of the file are missing beside the given faces of a volume, and, once it is sealed, which void
/// faces stand there; a sentence each.
std::vector<std::string> left_out_in_words(const OpenVolume& volume);

} // namespace lacuna::topology
