// SPDX-License-Identifier: MIT
#include "support/blocks.h"

#include <lacuna/core/error.h>
#include <lacuna/view/detail/png.h>
#include <lacuna/view/detail/raster.h>
#include <lacuna/view/detail/scene.h>
#include <lacuna/view/detail/stroke_font.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace lacuna;

namespace {

using Rgb = std::array<int, 3>;

Rgb pixel(const view::Image& image, int x, int y)
{
    const auto at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                         static_cast<std::size_t>(x));
    return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

/// Share of the picture that is not white.
double covered(const view::Image& image)
{
    std::size_t count = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) count += pixel(image, x, y) != Rgb{255, 255, 255} ? 1 : 0;
    return static_cast<double>(count) / (image.width * image.height);
}

view::Image draw(const mesh::HexMesh& mesh, view::PictureOptions options, int threads = 1)
{
    const view::Region regions[] = {{&mesh, "block"}};
    RunContext context;
    context.threads = threads;
    options.legend = false;
    return view::rasterise(view::scene_of(regions, options, context), options, context);
}

view::PictureOptions from(const Vec3& direction)
{
    view::PictureOptions options;
    options.width = 300;
    options.height = 200;
    options.direction = direction;
    return options;
}

} // namespace

TEST_CASE("a cube seen square covers the square that the margin leaves, from every side")
{
    const auto cube = test::block();
    for (const Vec3& direction :
         {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -2, 0), Vec3(0, 0, 3), Vec3(0, 0, -1)}) {
        CAPTURE(direction.transpose());
        CHECK(covered(draw(cube, from(direction))) ==
              doctest::Approx(0.9 * 200 * 0.9 * 200 / 60'000).epsilon(0.01));
    }
}

TEST_CASE("a cut shows whole cells and hides nothing of those kept")
{
    const auto cube = test::block({.columns = 4, .rows = 4, .layers = 4});
    for (const double at : {0.3, 0.6, 0.9}) {
        auto options = from({0, 0, 1});
        options.cut = view::CutPlane{{at, 0, 0}, Vec3::UnitX()};
        const view::Region regions[] = {{&cube, ""}};
        const auto scene = view::scene_of(regions, options, {});
        // Columns whose middle, at an odd eighth, lies behind the plane.
        const int kept = static_cast<int>(std::floor(at * 4 + 0.5));
        CHECK(scene.sides.size() == std::size_t(2 * 16 + 4 * 4 * kept));
        double most = 0;
        for (const auto& side : scene.sides)
            for (std::size_t k = 0; k < side.count; ++k) most = std::max(most, side.corner[k].x());
        CHECK(most == doctest::Approx(kept / 4.0));
    }
}

TEST_CASE("layers can be shown alone")
{
    const auto cube = test::block({.columns = 2, .rows = 2, .layers = 5});
    auto options = from({1, 1, 1});
    options.layers = {{2, 3}};
    const view::Region regions[] = {{&cube, ""}};
    CHECK(view::scene_of(regions, options, {}).sides.size() == 2 * 4 + 2 * 8);
    options.layers = {{5, 6}};
    CHECK(view::scene_of(regions, options, {}).sides.size() == 2 * 4 + 8);
    options.layers = {{6, 6}};
    CHECK_THROWS_AS(view::scene_of(regions, options, {}), InvalidInput);
}

TEST_CASE("wedges are drawn with their triangles")
{
    const auto mesh = test::with_wedges(test::block({.columns = 3, .rows = 3, .layers = 2}), 1);
    const view::Region regions[] = {{&mesh, ""}};
    const auto scene = view::scene_of(regions, from({1, 1, 1}), {});
    std::size_t triangles = 0;
    for (const auto& side : scene.sides) triangles += side.count == 3 ? 1 : 0;
    CHECK(triangles == 2 * 18);
    CHECK(scene.sides.size() == mesh.skin_count());
}

TEST_CASE("nearer parts hide those behind, in whatever order they come")
{
    view::Scene scene;
    for (const double z : {0.0, 1.0}) {
        view::DrawnSide side;
        side.corner = {Vec3(0, 0, z), Vec3(1, 0, z), Vec3(1, 1, z), Vec3(0, 1, z)};
        side.hidden = 15;
        side.colour = z > 0 ? view::Colour{200, 0, 0} : view::Colour{0, 0, 200};
        scene.sides.push_back(side);
    }
    for (int turn = 0; turn < 2; ++turn) {
        const auto image = view::rasterise(scene, from({0, 0, 1}), {});
        CHECK(pixel(image, 150, 100)[0] > 100);
        CHECK(pixel(image, 150, 100)[2] == 0);
        std::swap(scene.sides[0], scene.sides[1]);
    }
}

TEST_CASE("the same picture for any number of threads, and a file that is whole")
{
    const auto block = test::block({.columns = 7, .rows = 5, .layers = 6, .map = [](const Vec3& p) -> Vec3 {
                                        return p + 0.05 * Vec3(p.y() * p.z(), p.x(), p.x() * p.y());
                                    }});
    const auto one = draw(block, from({1, -2, 1}), 1), three = draw(block, from({1, -2, 1}), 3);
    CHECK(one.rgb == three.rgb);
    const std::string png = view::png_of(one);
    CHECK(png.starts_with("\x89PNG\r\n\x1a\n"));
    CHECK(png.ends_with(std::string("IEND\xae\x42\x60\x82")));
}

TEST_CASE("sizes, directions and cuts that make no picture are refused by name")
{
    const auto cube = test::block();
    auto options = from({1, 1, 1});
    options.width = 8;
    CHECK_THROWS_AS(draw(cube, options), InvalidInput);
    CHECK_THROWS_AS(draw(cube, from({0, 0, 0})), InvalidInput);
    options = from({1, 1, 1});
    options.cut = view::CutPlane{{-1, 0, 0}, Vec3::UnitX()};
    CHECK_THROWS_AS(draw(cube, options), InvalidInput);
}

TEST_CASE("every letter is drawn within its line, and no two are the same")
{
    std::set<std::vector<double>> seen;
    for (char c = ' '; c <= '~'; ++c) {
        CAPTURE(c);
        const auto letter = view::stroked(std::string(1, c));
        CHECK(letter.strokes.empty() == (c == ' '));
        CHECK(letter.width >= 0);
        std::vector<double> places;
        for (const auto& [from, to] : letter.strokes)
            for (const Vec2& at : {from, to}) {
                CHECK(at.x() >= 0);
                CHECK(at.x() <= letter.width);
                CHECK(at.y() >= 0);
                CHECK(at.y() <= 8 / 6.0);
                places.insert(places.end(), {at.x(), at.y()});
            }
        CHECK(seen.insert(places).second);
    }
}

TEST_CASE("a line is as wide as its letters and the gaps between them, and other letters are boxes")
{
    const double one = view::stroked("n").width, two = view::stroked("nn").width;
    CHECK(view::stroked("nnnn").width == doctest::Approx(one + 3 * (two - one)));
    CHECK(view::stroked("\xc3\xa9").strokes.size() == 4); // an e with an accent
    CHECK(view::stroked("\xc3\xa9").width == view::stroked("\xe2\x82\xac").width);
    CHECK(view::stroked("\n").strokes.size() == 4);
    CHECK(view::stroked("").width == 0);
}

TEST_CASE("a legend stands on the picture, beside what is shown, however many keys it has")
{
    view::Legend legend;
    legend.title = "Block";
    for (const int keys : {0, 1, 5, 100}) {
        legend.keys.resize(static_cast<std::size_t>(keys), {view::kGiven, "a group's name"});
        const auto placed = view::place_legend(legend, 600, 400);
        for (const auto& mark : placed.marks)
            for (const Vec2& at : {mark.from, mark.to}) {
                CHECK(at.x() >= 0);
                CHECK(at.x() <= 600);
                CHECK(at.y() >= 0);
                CHECK(at.y() <= 400);
                const bool above = at.y() <= placed.above, below = at.y() >= 400 - placed.below;
                CHECK((above || below));
            }
        CHECK(placed.above + placed.below < 200);
    }
}

TEST_CASE("a colour's key is there where the picture has the colour")
{
    const auto block = test::block({.columns = 2, .rows = 2, .layers = 3});
    const view::Region regions[] = {{&block, "block"}};
    for (const auto by : {view::ColourBy::quality, view::ColourBy::layer, view::ColourBy::group,
                          view::ColourBy::region, view::ColourBy::origin}) {
        auto options = from({1, 1, 1});
        options.colour = by;
        options.legend = true;
        const auto legend = view::scene_of(regions, options, {}).legend;
        CHECK(legend.title == "block: 12 cells, 3 layers");
        CHECK(legend.ramp.empty() == legend.quantity.empty());
        CHECK(legend.ramp.empty() == !legend.keys.empty());
        const auto inside = [](const view::Legend& own) {
            return std::any_of(own.keys.begin(), own.keys.end(),
                               [](const view::Key& key) { return key.text == "inside"; });
        };
        CHECK(!inside(legend));
        options.layers = {{1, 2}};
        options.title = "Two layers";
        const auto cut = view::scene_of(regions, options, {}).legend;
        CHECK(cut.title == "Two layers");
        CHECK(inside(cut) == (by == view::ColourBy::group || by == view::ColourBy::origin));
        CHECK(view::rasterise(view::scene_of(regions, options, {}), options, {}).rgb.size() == 3 * 300 * 200);
    }
}
