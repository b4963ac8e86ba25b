// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/mesh/tet_mesh.h>

#include <array>
#include <functional>
#include <map>
#include <optional>

namespace lacuna::sweep {

/// Middle nodes of the skins of meshes of order 2, found by the exact positions of corners.
class SharedMiddles {
public:
    /// Add the nodes of a mesh. O(skin log).
    /// @param wanted  whether the quads of a patch are shared; of other patches only the middles of their
    ///         borders are added.
    /// @return  false if a known side or quad has another middle node in this mesh.
    [[nodiscard]] bool add(const mesh::HexMesh& mesh, const std::function<bool(Index patch)>& wanted);
    [[nodiscard]] bool add(const mesh::TetPart& mesh); ///< add the whole skin of a mesh

    /// The middle node of a side, found by the positions of its ends; or the centre of a quad, found by the
    /// positions of two opposite corners. Empty: unknown.
    [[nodiscard]] std::optional<Vec3> side(const Vec3& a, const Vec3& b) const
    {
        return find(sides_, key_of(a, b));
    }
    [[nodiscard]] std::optional<Vec3> centre(const std::array<Vec3, 4>& corners) const
    {
        return find(centres_, key_of(corners));
    }

private:
    using Key = std::array<double, 6>;
    using Places = std::map<Key, Vec3>; // +0 and -0 are the same place
    template <class Mesh, class Wanted>
    bool add_quad(const Mesh& mesh, std::size_t i, const Wanted& wanted);
    static Key key_of(const Vec3& a, const Vec3& b);
    static Key key_of(const std::array<Vec3, 4>& corners);
    static std::optional<Vec3> find(const Places& places, const Key& key);

    Places sides_, centres_;
};

} // namespace lacuna::sweep
