// SPDX-License-Identifier: GPL-2.0-or-later
/// One mesh of one domain by one mesher, measured: a JSON line. against_gmsh.py beside this runs it.
///
/// usage: bench_pave DOMAIN QUADS MESHER [PICTURE]
///   DOMAIN   disc plate gear L comb aerofoil saddle, or FILE:FACE for a plane face of a CAD file
///   MESHER   lacuna, gmsh-8-3, gmsh-6-3, gmsh-6-s; each of Gmsh's with "+clean" and "+smooth" after it, to see what they do
///   PICTURE  file for points and quads as text

#include "gmsh_quads.h"

#include <lacuna/surface/clean_quads.h>
#include <lacuna/surface/measure_plane.h>
#include <lacuna/surface/smooth_plane.h>
#if __has_include(<lacuna/surface/pave.h>)
#include <lacuna/surface/pave.h>
#define LACUNA_BENCH_PAVE 1
#endif

#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>

using namespace lacuna;

namespace {

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

bench::GmshQuads make(const test::PlaneDomain& domain, const test::SeededDomain& seeded,
                      const std::string& mesher)
{
    const std::string name = mesher.substr(0, mesher.find('+'));
    if (name == "lacuna") {
        bench::GmshQuads made;
#ifdef LACUNA_BENCH_PAVE
        RunContext context;
        context.threads = 1;
        const double start = seconds();
        made.mesh = surface::pave(seeded.region, {}, context);
        made.seconds = seconds() - start;
#else
        throw std::runtime_error("built without pave()");
#endif
        return made;
    }
    if (name == "gmsh-8-3") return bench::gmsh_quads(domain, seeded, {8, 3, false});
    if (name == "gmsh-6-3") return bench::gmsh_quads(domain, seeded, {6, 3, false});
    if (name == "gmsh-6-s") return bench::gmsh_quads(domain, seeded, {6, 0, true});
    throw std::runtime_error("no mesher is called " + name);
}

void write_picture(const surface::PlanarQuads& mesh, const char* path)
{
    std::ofstream file(path);
    file << mesh.points.size() << ' ' << mesh.quads.size() << '\n';
    for (const Vec2& p : mesh.points) file << p.x() << ' ' << p.y() << '\n';
    for (const Quad& q : mesh.quads) file << q[0] << ' ' << q[1] << ' ' << q[2] << ' ' << q[3] << '\n';
}

void report(const char* domain, const char* mesher, const bench::GmshQuads& made,
            const surface::PlanarRegion& region)
{
    const surface::PlaneQuality q = surface::measure_plane(made.mesh, region);
    const std::string fault = surface::find_fault(made.mesh, region);
    std::printf(
        "{\"domain\": \"%s\", \"mesher\": \"%s\", \"quads\": %zu, \"triangles\": %zu, \"seconds\": %.4f, "
        "\"min_scaled_jacobian\": %.4f, \"mean_scaled_jacobian\": %.4f, \"irregular\": %zu, "
        "\"irregular_share\": %.5f, \"boundary_irregular\": %zu, \"row_share\": %.4f, "
        "\"size_share\": %.4f, \"mean_edge_ratio\": %.4f, \"fault\": \"%s\"}\n",
        domain, mesher, q.quads, made.triangles, made.seconds, q.min_scaled_jacobian, q.mean_scaled_jacobian,
        q.irregular, q.irregular_share(), q.boundary_irregular, q.row_share(), q.size_share(),
        q.mean_edge_ratio, fault.c_str());
}

} // namespace

int main(int argc, char** argv)
try {
    if (argc < 4) {
        std::fprintf(stderr, "usage: bench_pave DOMAIN QUADS MESHER [PICTURE]\n");
        return 2;
    }
    const std::string name = argv[1], mesher = argv[3];
    const auto colon = name.rfind(':');
    const test::PlaneDomain domain = colon == std::string::npos
                                         ? test::plane_domain(name)
                                         : bench::face_domain(name.substr(0, colon),
                                                              std::stoi(name.substr(colon + 1)));
    const test::SeededDomain seeded = test::seed_domain(domain, std::stod(argv[2]));
    bench::GmshQuads made = make(domain, seeded, mesher);
    const double start = seconds();
    if (mesher.find("+clean") != std::string::npos) {
        const surface::CleanReport clean = surface::clean_quads(made.mesh, seeded.region.points.size(),
                                                                {.size = seeded.region.size});
        std::fprintf(stderr, "%zu irregular -> %zu: %zu doublets, %zu patches of %zu tried, %.3f s\n",
                     clean.irregular_before, clean.irregular_after, clean.doublets, clean.patches,
                     clean.tried, seconds() - start);
    }
    if (mesher.find("+smooth") != std::string::npos) {
        const double before = seconds();
        surface::smooth_plane(made.mesh.points, made.mesh.quads, seeded.region.points.size(),
                              {.size = seeded.region.size});
        std::fprintf(stderr, "smoothed in %.3f s\n", seconds() - before);
    }
    made.seconds += seconds() - start;
    report(argv[1], argv[3], made, seeded.region);
    if (argc > 4) write_picture(made.mesh, argv[4]);
    return 0;
} catch (const std::string& error) { // Gmsh 4.8 throws text
    std::fprintf(stderr, "%s\n", error.c_str());
    return 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
