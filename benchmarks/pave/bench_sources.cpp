// SPDX-License-Identifier: GPL-2.0-or-later
/// Sources of several faces and curved ones, meshed as a sweep meshes them and measured as one mesh in space:
/// a JSON line a case. sources.py beside this makes tables of them and compares two.
///
/// usage: bench_sources QUADS [SPEC [PICTURE]]
///   SPEC     NAME|random:SEED:NUMBER|case:FILE|SOURCE|TARGET|WALLS|raised:FILE|SOURCE|groups:FILE
///   QUADS    asked for over all source faces together
///   NAME     a member of `test::source_family()`; without one, all of them
///   random:… a member of `test::random_source()`
///   case:…   the source faces of a real case, by tags with commas
///   raised:… faces of a CAD file, exact, with walls to the same faces moved along their mean normal
///   groups:… all groups of neighbouring faces of a CAD file, each as such a source
///   PICTURE  file for nodes and quads as text, `face` after each quad

#include "support/measure_sources.h"
#include "support/random_sources.h"
#include "support/source_family.h"
#ifdef LACUNA_WITH_CAD
#include "source_face.h"

#include <lacuna/cad/load.h>
#endif

#include <lacuna/core/error.h>
#include <lacuna/quads/shared/pave.h>
#include <lacuna/surface/shared/seeds.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>

using namespace lacuna;

namespace {

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void write_picture(const surface::SourceMesh& mesh, const char* path)
{
    std::ofstream file(path);
    file << mesh.quads.nodes.size() << ' ' << mesh.quads.quads.size() << '\n';
    for (const Vec3& p : mesh.quads.nodes) file << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    for (std::size_t q = 0; q < mesh.quads.quads.size(); ++q) {
        for (const Index p : mesh.quads.quads[q]) file << p << ' ';
        file << mesh.quads.face[q] << '\n';
    }
}

/// @param least  irregular nodes that a person would draw, where that is known; else by the mesh's own rim
void measure(const std::string& name, const topology::OpenVolume& volume, double quads, int least,
             const char* picture)
{
    RunContext context;
    context.threads = 1;
    double area = 0;
    for (const FaceId face : volume.faces(topology::Role::source))
        area += topology::face_area(volume.model, face);
    const double size = std::sqrt(area / quads);
    const surface::SizeField field = [&](const Vec3&) { return size; };
    const std::vector<surface::LinkingSurface> links = surface::linking_surfaces(volume);
    // Small meshes take less than the clock's tick of some systems.
    constexpr int kRuns = 3;
    double best = 0;
    surface::SourceMesh mesh;
    for (int run = 0; run < kRuns; ++run) {
        const double start = seconds();
        const surface::Seeds seeds = surface::seed_source(volume, links, field, surface::QuadStyle::automatic,
                                                          {.curvature = 0});
        mesh = surface::mesh_source(
            volume, links, seeds, {field, {}},
            [](const quads::PlanarRegion& region, const RunContext& c) {
                return quads::pave(region, {}, c).mesh;
            },
            context);
        const double took = seconds() - start;
        best = run == 0 ? took : std::min(best, took);
    }
    const test::UnionQuality q = test::measure_union(mesh, size);
    std::string how;
    for (const std::string& note : mesh.notes) how += (how.empty() ? "" : "; ") + note;
    std::replace(how.begin(), how.end(), '"', '\'');
    using Q = test::UnionQuality;
    std::printf("{\"case\": \"%s\", \"asked\": %.0f, \"quads\": %zu, \"triangles\": %zu, \"seconds\": %.5f, "
                "\"min\": %.4f, \"mean\": %.4f, \"irregular\": %zu, \"irregular_shared\": %zu, "
                "\"least_irregular\": %d, \"row\": %.4f, \"shared_row\": %.4f, \"size\": %.4f, "
                "\"how\": \"%s\"}\n",
                name.c_str(), quads, q.quads, q.triangles, best, q.min_scaled_jacobian,
                q.mean_scaled_jacobian, q.irregular, q.irregular_shared,
                least < 0 ? q.least_irregular : least, Q::share(q.good_rows, q.rows),
                Q::share(q.good_shared_rows, q.shared_rows), Q::share(q.edges_of_size, q.edges), how.c_str());
    std::fflush(stdout);
    if (picture != nullptr) write_picture(mesh, picture);
}

void tell_failed(const std::string& name, double quads, const std::exception& error)
{
    std::string words = error.what();
    std::replace(words.begin(), words.end(), '"', '\'');
    std::printf("{\"case\": \"%s\", \"asked\": %.0f, \"failed\": \"%s\"}\n", name.c_str(), quads,
                words.c_str());
    std::fflush(stdout);
}

#ifdef LACUNA_WITH_CAD
void measure_groups(const std::string& file, double quads)
{
    const topology::Model model = cad::load({file});
    for (const std::string& tags : bench::groups_of(model)) {
        const std::string name = "raised:" + file + "|" + tags;
        try {
            measure(name, bench::raised_over(model, tags), quads, -1, nullptr);
        } catch (const Error& error) {
            tell_failed(name, quads, error);
        }
    }
}
#endif

} // namespace

int main(int argc, char** argv)
try {
    if (argc < 2) {
        std::fprintf(stderr, "usage: bench_sources QUADS [NAME|random:SEED:NUMBER|case:…|raised:FILE|SOURCE|"
                             "groups:FILE [PICTURE]]\n");
        return 2;
    }
    const double quads = std::stod(argv[1]);
    const std::string wanted = argc > 2 ? argv[2] : "";
    const char* picture = argc > 3 ? argv[3] : nullptr;
#ifdef LACUNA_WITH_CAD
    if (wanted.starts_with("case:")) {
        measure(wanted, bench::real_case(wanted.substr(5)), quads, -1, picture);
        return 0;
    }
    if (wanted.starts_with("raised:")) {
        const std::size_t bar = wanted.find('|');
        measure(wanted, bench::raised_over(cad::load({wanted.substr(7, bar - 7)}), wanted.substr(bar + 1)),
                quads, -1, picture);
        return 0;
    }
    if (wanted.starts_with("groups:")) {
        measure_groups(wanted.substr(7), quads);
        return 0;
    }
#endif
    if (wanted.starts_with("random:")) {
        const std::size_t colon = wanted.find(':', 7);
        const auto seed = static_cast<std::uint32_t>(std::stoul(wanted.substr(7, colon - 7)));
        const test::FamilySource own = test::random_source(seed, std::stoi(wanted.substr(colon + 1)));
        measure(own.name, own.volume, quads, own.least_irregular, picture);
        return 0;
    }
    bool found = false;
    for (const test::FamilySource& own : test::source_family()) {
        if (!wanted.empty() && wanted != own.name) continue;
        found = true;
        try {
            measure(own.name, own.volume, quads, own.least_irregular, picture);
        } catch (const Error& error) {
            tell_failed(own.name, quads, error);
        }
    }
    if (!found) throw std::runtime_error("no source is called " + wanted);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
