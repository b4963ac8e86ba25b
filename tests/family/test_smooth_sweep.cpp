// SPDX-License-Identifier: MIT
#include "support/check_valid.h"
#include "support/volumes.h"

#include <lacuna/closure/close.h>
#include <lacuna/core/error.h>
#include <lacuna/matching/match.h>
#include <lacuna/quality/quality.h>
#include <lacuna/sweep/sweep.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace lacuna;
using namespace lacuna::topology;
using test::Part;
using test::PrismOptions;

namespace {

sweep::Swept swept_bend(const PrismOptions& options, const closure::CloseOptions& close, int layers,
                        double& enclosed)
{
    auto volume = test::prism(options).open();
    const bool ends = !volume.faces(Role::target).empty();
    volume = closure::close(volume, ends ? matching::match(volume) : matching::Match{}, close).volume;
    enclosed = closure::enclosed_volume(volume);
    sweep::SweepOptions sweep_options;
    sweep_options.layers.count = layers;
    sweep_options.size = [](const Vec3&) { return 0.35; };
    return sweep::sweep(volume, sweep_options);
}

} // namespace

TEST_CASE("layers follow smooth void walls round a bend")
{
    int combinations = 0;
    for (const int sides : {0, 4, 6}) {
        for (const int holes : {0, 1}) {
            for (const double bend : {30.0, 90.0, 120.0}) {
                for (const double twist : {0.0, 20.0}) {
                    PrismOptions options{.sides = sides,
                                         .height = 5,
                                         .holes = holes,
                                         .hole_sides = sides == 6 ? 0 : sides,
                                         .cuts = 4,
                                         .levels = 48,
                                         .twist = twist,
                                         .bend = bend};
                    const double whole = test::prism(options).facet_volume;
                    options.drop = test::without(false, false, true);
                    CAPTURE(sides);
                    CAPTURE(holes);
                    CAPTURE(bend);
                    CAPTURE(twist);
                    double enclosed = 0;
                    closure::CloseOptions smooth;
                    smooth.edge_shape = closure::EdgeShape::smooth;
                    const sweep::Swept swept = swept_bend(options, smooth, 24, enclosed);
                    test::check_valid(swept.mesh);
                    CHECK(swept.min_scaled_jacobian > 0.2);
                    CHECK(enclosed == doctest::Approx(whole).epsilon(0.03));
                    // Layers cut the bend, and quads the round rims, by chords.
                    const double volume = quality::measure(swept.mesh).volume;
                    CHECK(volume == doctest::Approx(enclosed).epsilon(sides == 0 ? 0.06 : 0.03));
                    ++combinations;
                }
            }
        }
    }
    MESSAGE(combinations << " bends");
}

TEST_CASE("a parallel cap is swept")
{
    for (const int sides : {0, 4, 5}) {
        for (const double bend : {0.0, 60.0}) {
            PrismOptions options{.sides = sides,
                                 .height = 3,
                                 .cuts = 6,
                                 .levels = 12,
                                 .bend = bend,
                                 .source = test::End::bowed,
                                 .lift = 0.3};
            options.drop = test::without(false, true, false);
            closure::CloseOptions parallel;
            parallel.cap = closure::Cap::parallel;
            CAPTURE(sides);
            CAPTURE(bend);
            double enclosed = 0;
            const sweep::Swept swept = swept_bend(options, parallel, 12, enclosed);
            test::check_valid(swept.mesh);
            CHECK(swept.min_scaled_jacobian > 0.2);
            CHECK(quality::measure(swept.mesh).volume ==
                  doctest::Approx(enclosed).epsilon(sides == 0 ? 0.08 : 0.02));
        }
    }
}
