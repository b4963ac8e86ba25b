// SPDX-License-Identifier: GPL-2.0-or-later
//
// Skins of real CAD bodies, which are kept outside the project.
#include "made_files.h"
#include "support/check_skin.h"
#include "support/whole_families.h"

#include <lacuna/surface/shared/default_size.h>
#include <lacuna/surface/shared/skin_triangles.h>
#include <lacuna/topology/open_volume.h>

#include <algorithm>

using namespace lacuna;

TEST_CASE("real bodies get a closed skin that encloses their volume")
{
    const std::string folder = std::string(LACUNA_SOURCE_DIR) + "/../shared/data/bodies";
    if (!std::filesystem::exists(folder)) {
        MESSAGE("skipped: there is no " << folder);
        return;
    }
    std::vector<std::string> files;
    for (const auto& file : std::filesystem::directory_iterator(folder)) {
        const std::string ending = file.path().extension();
        if (ending == ".step" || ending == ".stp" || ending == ".geo") files.push_back(file.path());
    }
    std::ranges::sort(files);
    for (const std::string& file : test::members_to_run(files, 5)) {
        CAPTURE(file);
        topology::Model model = cad::load({file});
        topology::orient_consistently(model);
        const surface::SkinMesh mesh = surface::triangulate_skin(model,
                                                                 surface::even_size(model.diagonal / 20));
        test::check_closed(mesh.skin);
        CHECK(test::volume_within(mesh.skin) == doctest::Approx(test::enclosed_volume(model)).epsilon(0.01));
        CHECK(test::smallest_angle(mesh.skin) > 0);
    }
}
