// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad/load.h>
#include <lacuna/core/error.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace lacuna::test {

/// A folder that goes with the object.
class TempFolder {
public:
    TempFolder();
    ~TempFolder();
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
    /// Write text to a file in it. @return its path.
    std::string write(const std::string& name, const std::string& text) const;
    /// Build in an empty Gmsh model, synchronised afterwards, and have Gmsh write it. @return the path.
    std::string gmsh(const std::string& name, const std::function<void()>& build) const;
    /// The same, but every face on its own: edges between faces come twice.
    std::string loose(const std::string& name, const std::function<void()>& build) const;

private:
    std::filesystem::path folder_;
};

/// Folder of real and hostile files beside the project; may be missing.
std::string shared_data();

/// Kill the CAD process, started if need be, and wait until it is dead.
void kill_worker();

/// A shape with what is known about it.
struct KnownShape {
    std::string name;
    std::function<void()> build; ///< with gmsh::model::occ
    int faces = 0;
    double area = 0, volume = 0;
};

/// Box, cylinder, cones with and without an apex, sphere, torus, partial ones, a tilted one, one with a hole.
std::vector<KnownShape> known_shapes();

/// Sum of the facets' areas, and the volume they enclose.
double total_area(const topology::Model& model);
double enclosed_volume(const topology::Model& model);

/// How many loops use each edge.
std::vector<int> uses_of_edges(const topology::Model& model);

/// What every model that was loaded must be: points, edges, loops and facets fit together.
void check_model(const topology::Model& model);

} // namespace lacuna::test
