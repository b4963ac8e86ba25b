// SPDX-License-Identifier: MIT
#include "support/refusal.h"

#include <lacuna/healing/shared/added_faces.h>

#include <doctest/doctest.h>

using namespace lacuna;

namespace {

/// A unit square at a height. @param apart  in two triangles without a common corner
healing::AddedFace square(double height, bool quad, bool keep, bool apart = false)
{
    healing::AddedFace face{
        .name = "at " + std::to_string(height), .points = {}, .cells = {}, .keep_mesh = keep};
    face.points = {{0, 0, height}, {1, 0, height}, {1, 1, height}, {0, 1, height},
                   {5, 0, height}, {6, 0, height}, {5, 1, height}};
    if (quad)
        face.cells = {{1, 2, 3, 4}};
    else
        face.cells = {{1, 2, 3, 0}, apart ? std::array{5, 6, 7, 0} : std::array{1, 3, 4, 0}};
    return face;
}

} // namespace

TEST_CASE("added faces keep their order, names and quads, whatever cells they have")
{
    healing::AddedFaces faces;
    const bool quads[] = {true, false, true, false, true};
    for (std::size_t f = 0; f < std::size(quads); ++f)
        healing::add(faces, square(static_cast<double>(f), quads[f], f != 4));
    const topology::Model model = healing::model_of(faces);
    REQUIRE(model.faces.size() == std::size(quads));
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        CAPTURE(f);
        CHECK(model.faces[f].tag == static_cast<int>(f) + 1);
        CHECK(model.faces[f].name == "at " + std::to_string(static_cast<double>(f)));
        CHECK(model.faces[f].triangles.size() == 2);
        CHECK(model.faces[f].given_quads.size() == (quads[f] && f != 4 ? 1 : 0));
        CHECK(topology::face_area(model, FaceId(f)) == doctest::Approx(1));
        CHECK(topology::face_centroid(model, FaceId(f)).z() == doctest::Approx(static_cast<double>(f)));
    }
}

TEST_CASE("an added face whose cells are not connected is refused")
{
    healing::AddedFaces faces;
    healing::add(faces, square(0, false, false, true));
    CHECK(test::refusal([&] { healing::model_of(faces); }, {"connected"}) == "lua.face_in_parts");
}
