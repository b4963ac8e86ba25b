// SPDX-License-Identifier: GPL-2.0-or-later
/// One mesh of one domain by one mesher, measured: a JSON line. against_gmsh.py beside this runs it.
///
/// usage: bench_pave DOMAIN QUADS MESHER [PICTURE]
///   DOMAIN   disc plate gear L comb aerofoil, "saddle plan", saddle: a curved face, or FILE:FACE for a
///            plane face of a CAD file
///   MESHER   lacuna, gmsh-8-3, gmsh-6-3, gmsh-6-s; each of Gmsh's with "+clean" and "+smooth" after it,
///            to see what they do
///   PICTURE  file for points and quads as text; of a curved face its plan

#include "gmsh_quads.h"
#ifdef LACUNA_WITH_CAD
#include "saddle_face.h"
#endif

#include <lacuna/quads/clean_quads.h>
#include <lacuna/quads/measure_plane.h>
#include <lacuna/quads/pave.h>
#include <lacuna/quads/smooth_plane.h>

#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>

using namespace lacuna;

namespace {

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

bench::GmshWay way_of(const std::string& mesher)
{
    if (mesher == "gmsh-8-3") return {8, 3, false};
    if (mesher == "gmsh-6-3") return {6, 3, false};
    if (mesher == "gmsh-6-s") return {6, 0, true};
    throw std::runtime_error("no mesher is called " + mesher);
}

bench::GmshQuads make(const test::PlaneDomain& domain, const test::SeededDomain& seeded,
                      const std::string& mesher)
{
    const std::string name = mesher.substr(0, mesher.find('+'));
    if (name == "lacuna") {
        bench::GmshQuads made;
        RunContext context;
        context.threads = 1;
        const double start = seconds();
        made.mesh = quads::pave(seeded.region, {}, context).mesh;
        made.seconds = seconds() - start;
        return made;
    }
    return bench::gmsh_quads(domain, seeded, way_of(name));
}

void write_picture(const quads::PlanarQuads& mesh, const char* path)
{
    std::ofstream file(path);
    file << mesh.points.size() << ' ' << mesh.quads.size() << '\n';
    for (const Vec2& p : mesh.points) file << p.x() << ' ' << p.y() << '\n';
    for (const Quad& q : mesh.quads) file << q[0] << ' ' << q[1] << ' ' << q[2] << ' ' << q[3] << '\n';
}

/// @param more  JSON members that only this mesh has, each with a comma after it
void report(const char* domain, const char* mesher, const quads::PlaneQuality& q, std::size_t triangles,
            double time, const std::string& more, const std::string& fault)
{
    std::printf(
        "{\"domain\": \"%s\", \"mesher\": \"%s\", \"quads\": %zu, \"triangles\": %zu, \"seconds\": %.4f, "
        "\"min_scaled_jacobian\": %.4f, \"mean_scaled_jacobian\": %.4f, \"irregular\": %zu, "
        "\"irregular_share\": %.5f, \"boundary_irregular\": %zu, \"row_share\": %.4f, "
        "\"size_share\": %.4f, \"mean_edge_ratio\": %.4f, %s\"fault\": \"%s\"}\n",
        domain, mesher, q.quads, triangles, time, q.min_scaled_jacobian, q.mean_scaled_jacobian, q.irregular,
        q.irregular_share(), q.boundary_irregular, q.row_share(), q.size_share(), q.mean_edge_ratio,
        more.c_str(), fault.c_str());
}

#ifdef LACUNA_WITH_CAD
/// The saddle by one mesher, measured in space.
void run_saddle(double quads, const char* mesher, const char* picture)
{
    const auto file = std::filesystem::temp_directory_path() /
                      ("saddle_" + std::to_string(std::random_device{}()) + ".brep");
    const bench::SeededFace seeded = bench::saddle_face(file.string(), quads);
    const bench::SurfaceQuads made = mesher == std::string("lacuna")
                                         ? bench::lacuna_quads(seeded)
                                         : bench::gmsh_quads(seeded, way_of(mesher));
    const bench::SurfaceQuality q = bench::measure_surface(made, seeded);
    std::filesystem::remove(file);
    char off[64];
    std::snprintf(off, sizeof off, "\"off_surface\": %.3g, ", q.off_surface);
    report("saddle", mesher, q.quads, made.triangles, made.seconds, off, q.fault);
    if (picture == nullptr) return;
    quads::PlanarQuads plan;
    for (const Vec3& p : made.points) plan.points.emplace_back(p.x(), p.y());
    plan.quads = made.quads;
    write_picture(plan, picture);
}
#endif

} // namespace

int main(int argc, char** argv)
try {
    if (argc < 4) {
        std::fprintf(stderr, "usage: bench_pave DOMAIN QUADS MESHER [PICTURE]\n");
        return 2;
    }
    const std::string name = argv[1], mesher = argv[3];
#ifdef LACUNA_WITH_CAD
    if (name == "saddle") {
        run_saddle(std::stod(argv[2]), argv[3], argc > 4 ? argv[4] : nullptr);
        return 0;
    }
#endif
    const auto colon = name.rfind(':');
    const test::PlaneDomain domain = colon == std::string::npos
                                         ? test::plane_domain(name)
                                         : bench::face_domain(name.substr(0, colon),
                                                              std::stoi(name.substr(colon + 1)));
    const test::SeededDomain seeded = test::seed_domain(domain, std::stod(argv[2]));
    bench::GmshQuads made = make(domain, seeded, mesher);
    const double start = seconds();
    if (mesher.find("+clean") != std::string::npos) {
        const quads::CleanReport clean = quads::clean_quads(made.mesh, seeded.region.points.size(),
                                                            {.size = seeded.region.size});
        std::fprintf(stderr, "%zu irregular -> %zu: %zu doublets, %zu patches of %zu tried, %.3f s\n",
                     clean.irregular_before, clean.irregular_after, clean.doublets, clean.patches,
                     clean.tried, seconds() - start);
    }
    if (mesher.find("+smooth") != std::string::npos) {
        const double before = seconds();
        quads::smooth_plane(made.mesh.points, made.mesh.quads, seeded.region.points.size(),
                            {.size = seeded.region.size});
        std::fprintf(stderr, "smoothed in %.3f s\n", seconds() - before);
    }
    made.seconds += seconds() - start;
    report(argv[1], argv[3], quads::measure_plane(made.mesh, seeded.region), made.triangles, made.seconds, {},
           quads::find_fault(made.mesh, seeded.region));
    if (argc > 4) write_picture(made.mesh, argv[4]);
    return 0;
} catch (const std::string& error) { // Gmsh 4.8 throws text
    std::fprintf(stderr, "%s\n", error.c_str());
    return 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
