// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <string>
#include <vector>

namespace lacuna::topology {

/// A face of a CAD file that could not be read and is not a sliver: it leaves a hole in the model.
struct LeftOutFace {
    int tag = 0;        ///< in the file
    std::string source; ///< the file(s)
    std::string why;    ///< completes the sentence "face 6 …"
    friend bool operator==(const LeftOutFace&, const LeftOutFace&) = default;
};

/// Base class of exact curves that store which faces of the file next to their edge were left out.
class BesideLeftOut {
public:
    virtual ~BesideLeftOut() = default;
    [[nodiscard]] virtual const std::vector<LeftOutFace>& left_out() const = 0;
};

/// A face left out that shares edges with faces that were read.
struct LeftOutBeside {
    LeftOutFace face;
    std::vector<EdgeId> edges; ///< ascending
};

/// The left-out faces next to `faces`: those at edges that `faces` use only once.
/// @return sorted by their first edges.
/// @note   O(edges). The exact curves store the left-out faces, so this also works for a model that was
///         extracted from the loaded model.
std::vector<LeftOutBeside> left_out_beside(const Model& model, const std::vector<FaceId>& faces);

/// Check that no face was left out next to `faces`. Call this before an automatic search for walls or roles:
/// the search would take the hole of such a face for a part of the void.
/// @param found  name of the result of the search, for the message, such as "walls".
/// @throw InvalidInput "cad.face_left_out"  names the face, one of its edges, and a remedy.
void require_none_left_out(const Model& model, const std::vector<FaceId>& faces, std::string_view found);

/// Sentences that name the faces of the file that are missing next to the given faces of a volume and, after
/// closing, the void faces that replace them.
std::vector<std::string> left_out_in_words(const OpenVolume& volume);

} // namespace lacuna::topology
